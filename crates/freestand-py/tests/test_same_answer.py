"""The same question has the same answer in Python as in every command: the objects and their falls are those of the
test of the commands."""

import csv

import freestand as fs
import pytest
from conftest import ROOT, told

DATA = ROOT / "crates" / "freestand-cli" / "tests" / "same_answer"
MOTIONS = ("sine", "weak", "decaying")


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


FALLS = {row["id"]: [row[name] == "1" for name in MOTIONS] for row in rows(DATA / "falls.csv")}
#: Each object by its cells in SI; what is a text or has no unit stays as it is.
FACTORS = {"mm": 1e-3, "kg": 1, "N/mm": 1e3}


def thing(row):
    cells = {}
    for heading, text in row.items():
        key, _, unit = heading.rstrip("]").partition(" [")
        if text and key not in ("id", "level_ratio"):
            cells[key] = float(text) * FACTORS[unit] if unit else text if key == "casters" else float(text)
    return cells


THINGS = {row["id"]: thing(row) for row in rows(DATA / "list.csv")}


@pytest.fixture(scope="module")
def motions():
    return [fs.read_motion(DATA / f"{name}.csv") for name in MOTIONS]


@pytest.fixture(scope="module")
def fragile(tmp_path_factory):
    out = tmp_path_factory.mktemp("fragile") / "out"
    runs = ["fragility", DATA / "study.toml", "--inventory", DATA / "list.csv", "--method", "cloud", "--bootstrap", 0]
    told(*runs, "--out", out)
    return out / "outcomes.csv"


def test_assess(tmp_path):
    result = fs.assess(DATA / "study.toml", DATA / "list.csv", outcomes=True)
    falls = {name: [False] * len(MOTIONS) for name in FALLS}
    for row in rows(result.save(tmp_path / "saved") / "outcomes.csv"):
        falls[row["id"]][int(row["world"])] |= row["fell"] == "1"
    assert falls == FALLS


UNITS = {"mass": "_kg", "stiffness": "_n_m", "upper_mass": "_kg", "friction": "", "casters": "", "wall_restitution": ""}


#: The side of the one wall behind an object belongs to its id, which one object alone has not.
ALONE = [name for name, cells in THINGS.items() if "wall_gap" not in cells]


@pytest.mark.parametrize("name", ALONE)
def test_check_object(name, motions):
    cells = {key + UNITS.get(key, "_m"): value for key, value in THINGS[name].items()}
    found = fs.check_object(motions=motions, **cells)
    assert found.motions_overturned == sum(FALLS[name])


OF_BLOCKS = {"height", "thickness", "width", "mass", "stiffness"}
ROCKS = [name for name, cells in THINGS.items() if cells.keys() <= OF_BLOCKS]


@pytest.mark.parametrize("name", ROCKS)
def test_rock(name, motions):
    """In either plane, and on pads as well: the worse one counts."""
    cells = THINGS[name]
    falls = [False] * len(MOTIONS)
    for side in [cells[key] for key in ("thickness", "width") if key in cells]:
        ways = [({}, "rigid")]
        if "mass" in cells:
            pads = fs.Cushion(stiffness_n_m=cells["stiffness"], law="kelvin-voigt", damping_ratio=0.1)
            ways.append(({"mass_kg": cells["mass"], "cushion": pads}, "compliant"))
        for body, base in ways:
            block = fs.Block(cells["height"], side, **body)
            outcomes = [fs.rock(block, motion, base=base).outcome for motion in motions]
            falls = [fell or outcome == "overturned" for fell, outcome in zip(falls, outcomes)]
    assert falls == FALLS[name]


def test_fragility_and_risk(fragile):
    found = fs.fragility(fragile, bootstrap=0)
    counts = {one["id"]: one["counts"]["overturned"] for one in found.objects}
    assert counts == {name: sum(falls) for name, falls in FALLS.items()}
    hazard = {"hazard_power": "k0=1e-2 /yr, k=2.5, reference=0.5 m/s", "hazard_im": "pfv"}
    rates = fs.risk(outcomes=fragile, bootstrap=0, **hazard)
    flags = ["--hazard-power", hazard["hazard_power"], "--hazard-im", "pfv", "--bootstrap", 0]
    assert rates.objects == told("risk", "--outcomes", fragile, *flags)["objects"]
