"""The docstrings of what the package exports: every argument is described, and the examples print what they say."""

import doctest
import inspect
import re

import freestand as fs
import numpy as np
import pytest
from conftest import FLOOR, ROOT

FUNCTIONS = [name for name in fs.__all__ if inspect.isfunction(getattr(fs, name)) and name != "study_toml"]
CLASSES = ["Block", "Cushion", "Motion", "Sliding", "Walls"]
METHODS = [fs.Table.quantile, fs.IdaResult.capacities]


def described(text, heading):
    """The lines of a section of a docstring."""
    found = re.search(rf"^{heading}\n-+\n(.*?)(?=^\w+\n-+$|\Z)", text, re.S | re.M)
    return found[1] if found else ""


@pytest.mark.parametrize("name", [*FUNCTIONS, *CLASSES])
def test_every_argument_is_described(name):
    found = getattr(fs, name)
    text = inspect.getdoc(found)
    rows = [line for line in described(text, "Parameters").splitlines() if line and not line.startswith(" ")]
    told = {part.strip().strip("*") for line in rows for part in line.split(" : ")[0].split(",")}
    arguments = set(inspect.signature(found).parameters)
    assert told == arguments
    assert name in CLASSES or described(text, "Returns").strip()
    assert described(text, "Examples").strip()


@pytest.mark.parametrize("found", [*(getattr(fs, name) for name in [*FUNCTIONS, *CLASSES]), *METHODS],
                         ids=lambda found: found.__qualname__)  # fmt: skip
def test_examples_print_what_they_say(found, monkeypatch):
    monkeypatch.chdir(ROOT)
    motion = fs.read_motion(FLOOR, scale=3.5)
    names = {"fs": fs, "np": np, "motion": motion}
    names["motions"] = [fs.Motion(factor * motion.accel_m_s2, motion.dt_s) for factor in (0.7, 0.9, 1, 1.1, 1.4)]
    (test,) = doctest.DocTestFinder(recurse=False).find(found, found.__qualname__, globs=names)
    assert test.examples or found in METHODS
    told = []
    doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=told.append)
    assert not told, "".join(told)
