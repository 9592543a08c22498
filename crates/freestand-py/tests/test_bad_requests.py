"""Bad requests have the problems of the table that all shells share."""

import json
from pathlib import Path

import freestand as fs
import pytest
from freestand import _freestand

# A motion of Python has been read before it is asked; the others ask nothing, or are no function.
NO_FUNCTION = {
    "check", "motion info", "motion spectrum", "motion convert", "motion match", "motion rotate", "motion rotd",
    "motion simulate", "tolerance list", "tolerance show", "tolerance search",
    "cushion list", "cushion show", "cushion search", "cushion curve", "cushion recovery", "cushion simulate",
    "inventory convert", "inventory template", "place list", "place show", "shard plan", "shard run", "shard merge",
    "validate",
}  # fmt: skip
TABLE = Path(__file__).parents[2] / "freestand-app" / "tests" / "requests.jsonl"


def test_every_request_has_the_problems_of_the_table() -> None:
    lines = [json.loads(line) for line in TABLE.read_text(encoding="utf-8").splitlines()]
    assert len(lines) > 300
    for line in lines:
        if line["command"] in NO_FUNCTION:
            continue
        # These files are on the disk, where one that is not there has another message.
        if line["command"] not in {"rock", "shock", "spectrum"} and {"file", "files", "spectrum"} & line["request"].keys():
            continue
        with pytest.raises(fs.FreestandError) as caught:
            if line["command"] == "rock":
                _freestand.rock(line["request"], [], None, None, {}, False)
            elif line["command"] == "object":
                _freestand.check_object([], line["request"], {}, 1)
            elif line["command"] == "restrain":
                _freestand.restrain(line["request"], {})
            elif line["command"] == "assess":
                _freestand.assess(line["request"], {}, ("unused", False), 1, None)
            elif line["command"] == "run":
                _freestand.run(line["request"], {}, ("unused", False), 1, None)
            elif line["command"] == "inventory check":
                _freestand.check_inventory(line["request"], {}, None)
            elif line["command"] == "fragility":
                _freestand.fragility(line["request"], {}, 1)
            elif line["command"] == "risk":
                _freestand.risk(line["request"], {}, 1)
            elif line["command"] == "shock":
                _freestand.shock(line["request"], {})
            elif line["command"] == "shock-spectrum":
                _freestand.shock_spectrum(None, b"", line["request"])
            elif line["command"] == "floor":
                _freestand.floor([], b"", line["request"], 1)
            elif line["command"] == "motion synth":
                _freestand.synth(line["request"], 1)
            elif line["command"] == "motion code-spectrum":
                _freestand.code_spectrum(b"", line["request"])
            elif line["command"] == "cushion drop":
                _freestand.drop_test(line["request"])
            elif line["command"] == "cushion static":
                _freestand.static_test(line["request"])
            else:
                _freestand.spectrum([], b"", b"", line["request"], {}, 1)
        told = [problem.message for problem in caught.value.problems]
        assert told == [problem["argument"] for problem in line["problems"]], line


def test_arguments_of_a_problem_are_named() -> None:
    with pytest.raises(fs.FreestandError) as caught:
        fs.rock(fs.Block(2, 0.5), initial_rotation_rad=0.01, gravity_m_s2=float("nan"), cg_rise_m=0.1)
    assert [list(problem.arguments) for problem in caught.value.problems] == [["gravity_m_s2"], ["cg_rise_m"]]
