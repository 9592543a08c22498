"""What the tests share: records and lists of the repository, and the command of the installed wheel."""

import json
import subprocess
import sys
from pathlib import Path

import freestand as fs
import matplotlib
import pytest

matplotlib.use("Agg")

ROOT = Path(__file__).parents[3]
RECORDS = ROOT / "validation" / "rocking" / "records"
FLOOR = RECORDS / "synthfloor.csv"
#: A cabinet as arguments of the command.
CABINET = ["--height", "2.3 m", "--thickness", "600 mm", "--mass", "140 kg", "--stiffness", "4380 N/mm"]


def program() -> str:
    """The command that the wheel has put beside Python."""
    name = "freestand.exe" if sys.platform == "win32" else "freestand"
    return str(Path(sys.executable).parent / name)


def told(*arguments):
    """The document of a command; status 1 says that an item failed, and prints it too."""
    done = subprocess.run([program(), *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


def same(ours, theirs, without=("schema",)):
    """Equal documents, without keys that only a file has."""
    ours = {key: value for key, value in ours.items() if key not in without}
    theirs = {key: value for key, value in theirs.items() if key not in without}
    assert ours == theirs


@pytest.fixture
def cabinet():
    return fs.Block(2.3, 0.6, mass_kg=140, stiffness_n_m=4.38e6)


@pytest.fixture(scope="session")
def floor_motion():
    return fs.read_motion(FLOOR, scale=3.5)
