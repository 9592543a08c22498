#!/usr/bin/env python3
"""Runs `freestand assess` on an inventory of N made-up objects: time, peak memory, rocking histories.

    cargo build --release && python3 benches/portfolio.py [N] [--padded 0.2] [--threads 2] [-- more flags of assess]

The objects are furniture-like, drawn from a fixed seed, on the 31 floors of a building in Melbourne. The share
`--padded` of them stand on pads, with a mass and a tolerance; of the others only the size is known.
"""

import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = (
    "id,item,quantity,location,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],stiffness [N/mm],"
    "tolerance [g],tolerance_duration [ms],life_safety,notes"
)


def inventory(path: Path, count: int, padded: float) -> None:
    """Writes `count` objects."""
    numbers = random.Random(1)
    with path.open("w", encoding="utf-8", newline="") as file:
        print(HEADER, file=file)
        for i in range(count):
            height, thickness = numbers.uniform(400, 2400), numbers.uniform(250, 1000)
            width = thickness * numbers.uniform(1.0, 2.5)
            mass = 250e-9 * height * thickness * width * numbers.uniform(0.4, 1.6)
            level, rating = numbers.randrange(31) / 30, numbers.choice("HML")
            stiffness, tolerance = 10 ** numbers.uniform(2.5, 4.0), numbers.uniform(1.5, 30)
            duration = "11" if numbers.random() < 0.3 else ""
            shock = f"{mass:.1f},{stiffness:.0f},{tolerance:.2f},{duration}" if numbers.random() < padded else ",,,"
            print(
                f"o{i:07},box,1,room {i % 97},{level:.4f},{height:.0f},{thickness:.0f},{width:.0f},{shock},{rating},",
                file=file,
            )


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("count", nargs="?", type=int, default=10_000)
    arguments.add_argument("--padded", type=float, default=0.2)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument("--program", default=str(ROOT / "target/release/freestand"))
    arguments.add_argument("more", nargs="*")
    wanted = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        inventory(folder / "objects.csv", wanted.count, wanted.padded)
        study = '[ground]\nplace = "Melbourne"\n\n[building]\nstoreys = 30\n'
        (folder / "study.toml").write_text(study, encoding="utf-8")
        command = [wanted.program, "assess", "study.toml", "--inventory", "objects.csv", "--out", "out", "--json", "-q"]
        command += ["--threads", str(wanted.threads), *wanted.more]
        start = time.perf_counter()
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        seconds = time.perf_counter() - start
        if done.returncode not in (0, 1):
            sys.exit(done.stderr)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        peak_mb = used.ru_maxrss / 1024
        report = json.loads(done.stdout)
        size_mb = sum(os.path.getsize(folder / "out" / name) for name in report["files"]) / 1e6
        print(
            f"{wanted.count} objects on {wanted.threads} threads: {seconds:.1f} s ({used.ru_utime:.1f} s of processor time), "
            f"{peak_mb:.0f} MB at most, "
            f"{report['histories'] / 1e6:.2f} million histories "
            f"({1e6 * seconds / max(report['histories'], 1):.1f} µs each, all told), outputs {size_mb:.0f} MB; "
            f"{report['decisions']}, tiers {report['tiers']}"
        )


if __name__ == "__main__":
    main()
