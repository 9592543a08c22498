"""The lines of Python in the README and in docs/python.md: they run, and print what they say."""

import contextlib
import io
import re

import pytest
from conftest import ROOT


def matches(printed, said):
    """Words are equal; a number has the digits that are said."""
    found, expected = printed.split(), said.split()
    if len(found) != len(expected):
        return False
    for ours, theirs in zip(found, expected):
        try:
            # Half a unit of the last digit that is said.
            digits = len(theirs.partition(".")[2])
            if abs(float(ours) - float(theirs)) > 0.5 * 10.0**-digits * (1 + 1e-9) and float(ours) != float(theirs):
                return False
        except ValueError:
            if ours != theirs:
                return False
    return True


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_examples(page, monkeypatch):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.S)
    assert blocks
    names, said = {}, 0
    for block in blocks:
        for line in block.splitlines():
            code, _, comment = line.partition("  #")
            output = io.StringIO()
            with contextlib.redirect_stdout(output):
                exec(code, names)
            if code.startswith("print") and comment.strip():
                said += 1
                assert matches(output.getvalue(), comment.strip()), f"{line}\nprints {output.getvalue()}"
    assert said >= 3
