#!/usr/bin/env python3
"""Runs the study by every model and prints how many worlds fall: run.py [FREESTAND] [FOLDER] [WORDS]. With words only the
models that have them in their name, such as "wall"."""

import csv
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
# Name; keys of [assessment], of [worlds], of [ground]; columns of the list.
NO_SLIP = {"friction": "10"}
VARIANTS = [
    ("planar, about the thickness only", {}, {}, {}, {"width [mm]": ""}),
    ("planar, both axes", {}, {}, {}, {}),
    ("three dimensions, no slip", {"dimensions": '"3d"'}, {}, {}, NO_SLIP),
    ("three dimensions, one component", {"dimensions": '"3d"'}, {"components": "1"}, {}, NO_SLIP),
    ("three dimensions, friction 0.2 to 0.8", {"dimensions": '"3d"'}, {}, {}, {}),
    ("three dimensions, friction 0.5", {"dimensions": '"3d"'}, {}, {}, {"friction": "0.5"}),
    ("three dimensions, friction 0.3", {"dimensions": '"3d"'}, {}, {}, {"friction": "0.3"}),
    ("planar, wall behind, touching", {}, {}, {}, {"wall_gap [mm]": "0"}),
    ("planar, wall behind at 50 mm", {}, {}, {}, {"wall_gap [mm]": "50"}),
    ("three dimensions, wall behind, touching", {"dimensions": '"3d"'}, {}, {}, {**NO_SLIP, "wall_gap [mm]": "0"}),
    ("three dimensions, wall behind at 50 mm", {"dimensions": '"3d"'}, {}, {}, {**NO_SLIP, "wall_gap [mm]": "50"}),
    ("planar, vertical 0.6", {}, {}, {"vertical": "0.6"}, {}),
    ("three dimensions, no slip, vertical 0.6", {"dimensions": '"3d"'}, {}, {"vertical": "0.6"}, NO_SLIP),
    ("three dimensions, friction 0.5, wall touching", {"dimensions": '"3d"'}, {}, {},
     {"friction": "0.5", "wall_gap [mm]": "0"}),
    ("three dimensions, friction 0.5, wall at 50 mm", {"dimensions": '"3d"'}, {}, {},
     {"friction": "0.5", "wall_gap [mm]": "50"}),
]
# Level and the acceleration of the ground.
FLOORS = [("ground", "0", "0.3 g"), ("roof", "1", "0.15 g")]


def prepared(folder, floor, variant):
    _, level, ground = floor
    _, assessment, worlds, motions, columns = variant
    folder.mkdir(parents=True, exist_ok=True)
    text = (HERE / "study.toml").read_text().replace('"0.3 g"', f'"{ground}"')
    for table, keys in [("assessment", assessment), ("worlds", worlds), ("ground", motions)]:
        lines = "".join(f"{key} = {value}\n" for key, value in keys.items())
        text = text.replace(f"[{table}]\n", f"[{table}]\n{lines}")
    (folder / "study.toml").write_text(text)
    with open(HERE / "list.csv", newline="") as source, open(folder / "list.csv", "w", newline="") as target:
        rows = csv.DictReader(source)
        out = csv.DictWriter(target, rows.fieldnames)
        out.writeheader()
        for row in rows:
            out.writerow({**row, "level_ratio": level, **columns})


def chance(row, name):
    if not row.get(name):
        return "–"
    value, low, high = (float(row[name + end]) for end in ("", "_low", "_high"))
    return f"{value:.2f} ({low:.2f} to {high:.2f})"


def number(row, name, factor):
    text = row.get(name, "")
    return text if text in ("", "overturned") else f"{factor * float(text):.3g}"


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else "freestand"
    base = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "models-out")
    words = sys.argv[3] if len(sys.argv) > 3 else ""
    print("| floor | model | object | P on a rigid base | P on its pads | tilt, median [deg] | walk, median [mm] |")
    print("|---|---|---|---|---|---|---|")
    for floor in FLOORS:
        for number_, variant in enumerate(VARIANTS):
            if words not in variant[0]:
                continue
            folder = base / f"{floor[0]}-{number_}"
            prepared(folder, floor, variant)
            command = [binary, "assess", folder / "study.toml", "--inventory", folder / "list.csv", "--outcomes"]
            command += ["--out", folder / "out", "--resume"]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            if done.returncode not in (0, 1):
                sys.exit(done.stdout)
            for row in csv.DictReader(open(folder / "out" / "objects.csv", newline="")):
                cells = [floor[0], variant[0], row["id"], chance(row, "p_overturn_rigid"),
                         chance(row, "p_overturn_compliant"), number(row, "tilt_rad_median", 57.29578),
                         number(row, "slide_m_median", 1e3)]
                print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
