"""Each exception, and messages that name arguments."""

import inspect
import io
import json
import pickle
import re
import warnings

import freestand as fs
import numpy as np
import pytest
from conftest import FLOOR, ROOT


RISK = ROOT / "examples" / "risk"


def caught(kind, call):
    with pytest.raises(kind) as raised:
        call()
    assert type(raised.value) is kind
    assert isinstance(raised.value, fs.FreestandError)
    assert "--" not in str(raised.value), "a flag in a message of Python"
    assert raised.value.problems and all(isinstance(problem, fs.Problem) for problem in raised.value.problems)
    again = pickle.loads(pickle.dumps(raised.value))
    assert type(again) is kind and str(again) == str(raised.value) and again.problems == raised.value.problems
    return raised.value


@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lambda: fs.Block(-1, 0.5), "height_m"),
        (lambda: fs.Block("1", 0.5), "height_m"),
        (lambda: fs.Block(True, 0.5), "height_m"),
        (lambda: fs.Block(1, float("nan")), "thickness_m"),
        (lambda: fs.Block(1, 0.5, 1e19), 'mass_kg: "1e19" is too large'),
        (lambda: fs.Block(1, 0.5, inertia_kg_m2=3), "mass_kg"),
        (lambda: fs.Block(1, 0.5, base_width_m=0.6), "base"),
        (lambda: fs.Block(1, 0.5, 100, stiffness_n_m=-4), "stiffness_n_m"),
        (lambda: fs.Block(1, 0.5, 100, cushion=fs.Cushion(pad_stiffness_n_m=2e6)), "pads_per_edge"),
        (lambda: fs.Block(1, 0.5, 100, cushion=fs.Cushion(stiffness_n_m=2e6, law="rubber")), "law"),
        (lambda: fs.Block(1, 0.5).rock(), "initial_rotation_rad"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), restitution=1.5), "restitution"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), restitution=0.5, restitution_factor=0.5), "restitution"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), accuracy="good"), "standard"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), base="soft"), "compliant"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), base="compliant"), "stiffness_n_m"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), walls=fs.Walls(height_m=1)), "left_m"),
        (lambda: fs.Block(1, 0.5).rock([0, 1, 0]), "Motion"),
        (lambda: fs.rock("a", fs.Motion([0, 1, 0], 0.1)), "Block"),
        (lambda: fs.rock(fs.Block(1, 0.5), fs.Motion([0, 1, 0], 0.1), cg_rise_m=0.1), "cg_rise_m"),
        (lambda: fs.rock(fs.Block(1, 0.5), fs.Motion([0, 1], 0.1), vertical=fs.Motion([0, 1, 0], 0.1)), "resample"),
        (lambda: fs.Block(1, 0.5, 100).shock(cg_rise_m=0.01), "stiffness_n_m"),
        (lambda: fs.Block(1, 0.5, stiffness_n_m=1e6).shock(cg_rise_m=0.01), "mass"),
        (lambda: fs.Block(1, 0.5, 100, stiffness_n_m=1e6).shock(cg_rise_m=0.5), "scenario"),
        (lambda: fs.Block(1, 0.5, 100, stiffness_n_m=1e6).shock(cg_rise_m=0.01, uplift_m=0.1), "uplift_m"),
        (lambda: fs.code_spectrum(code="as9999"), "as1170.4"),
        (lambda: fs.code_spectrum(code="asce7"), "sds_g"),
        (lambda: fs.read_motion(FLOOR, unit="furlong"), "unit"),
        (lambda: fs.read_motion(FLOOR, low_cut_hz=-1), "low_cut_hz"),
        (lambda: fs.synth(0), "count"),
        (lambda: fs.floor(fs.Motion([0, 1, 0], 0.1), levels=[2]), "levels"),
        (lambda: fs.shock_spectrum([0, 1, 0]), "dt_s"),
        (lambda: fs.check_inventory({"a": 1}), "pandas"),
        (lambda: fs.check_object(2, 0.3, study=5), "study cannot be of type int"),
        (lambda: fs.fragility(5), "outcomes cannot be of type int"),
        (lambda: fs.risk(options=5, outcomes=RISK / "outcomes.csv"), "options cannot be of type int"),
        (lambda: fs.risk(RISK / "curves.csv", outcomes=RISK / "outcomes.csv", hazard=RISK / "hazard.csv"), "fragility and outcomes exclude each other"),
        (lambda: fs.assess({"building": {"storeys": object()}}), "storeys"),
        (lambda: fs.assess(out=5), "out"),
        (lambda: fs.assess(progress=5), "progress"),
        (lambda: fs.run(""), "study"),
        (lambda: fs.Motion([0, 1], "0.1"), "dt_s"),
        (lambda: fs.Motion([0, 1], True), "dt_s"),
        (lambda: fs.Motion([0, 1], 0.1, 5), "name"),
        (lambda: fs.Motion(None, 0.1), "accel_m_s2"),
        (lambda: fs.Motion(np.ma.masked_array([1.0, 2.0], mask=[0, 1]), 0.1), "accel_m_s2"),
        (lambda: fs.Motion([0, 1], 0.1).scale("2"), "factor"),
        (lambda: fs.Motion([0, 1], 0.1).write(5), "path"),
        (lambda: fs.Motion.from_obspy(5, unit="g"), "trace"),
        (lambda: fs.Motion.from_xarray(5), "array"),
        (lambda: fs.read_motion(b"a.csv"), "paths"),
        (lambda: fs.read_motion("a\0b"), "paths"),
        (lambda: fs.read_motions(7), "paths"),
        (lambda: fs.drop_test([]), "files"),
        (lambda: fs.drop_test(io.StringIO("1,2")), "files"),
        (lambda: fs.static_test(5), "files"),
        (lambda: fs.Block(1, 0.5, 100, cushion=5), "cushion"),
        (lambda: fs.shock(5, cg_rise_m=0.01), "block"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), walls=0.02), "walls"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), sliding=True), "sliding"),
        (lambda: fs.Block(1, 0.5).rock(fs.Motion([0, 1, 0], 0.1), history="no"), "history"),
        (lambda: fs.floor(5), "motions"),
        (lambda: fs.floor(fs.Motion([0, 1, 0], 0.1), levels=[]), "levels"),
        (lambda: fs.spectrum(fs.Motion([0, 1, 0], 0.1), [], [0.3]), "heights_m"),
        (lambda: fs.spectrum(fs.Motion([0, 1, 0], 0.1), [1], [float("nan")]), "thicknesses_m"),
        (lambda: fs.spectrum(fs.Motion([0, 1, 0], 0.1), [1], [0.3], vertical=3), "vertical"),
        # Every thread takes memory; a typing error once took all of it.
        (lambda: fs.spectrum(fs.Motion([0, 1, 0], 0.1), [1], [0.3], threads=10**9), "threads"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", friction=(0.4, 0.3)), "friction"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", friction="0.3 m"), "friction"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", friction="0.4 to 0.3"), "friction"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", stiffness_n_m=-5), "stiffness_n_m"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", cushion="5 N/mm"), "cushion"),
        (lambda: fs.check_object(2, 0.3, place="Melbourne", cushion="rubber-foot", stiffness_n_m=5), "cushion"),
    ],
)  # fmt: skip
def test_bad_values_name_arguments(call, names):
    error = caught(fs.BadValue, call)
    assert isinstance(error, ValueError)
    assert names in str(error)
    assert error.hint or "must be" in str(error), "neither a remedy nor what is expected"


def hints(call):
    with pytest.raises(fs.FreestandError) as raised:
        call()
    return " ".join(str(problem) for problem in raised.value.problems)


def test_hints_name_arguments_that_there_are(tmp_path):
    """Every word of a hint that looks like an assignment or has a unit is an argument of the function."""
    two = tmp_path / "two.csv"
    two.write_text((RISK / "outcomes.csv").read_text())
    calls = [
        (fs.fragility, lambda: fs.fragility(two, at="floor"), "at"),
        (fs.risk, lambda: fs.risk(RISK / "curves.csv", hazard=RISK / "hazard.csv", inventory=RISK / "costs.csv",
                                  options=RISK / "options.csv"), "horizon_years"),
        (fs.check_object, lambda: fs.check_object(1.8, 0.4, place="Wellington", tolerance_g=2), "cushion"),
    ]  # fmt: skip
    for function, call, expected in calls:
        said = hints(call)
        names = set(inspect.signature(function).parameters)
        assert re.search(rf"\b{expected}\b", said), said
        named = set(re.findall(r"\b([a-z_]+)=", said)) | set(re.findall(r"\b[a-z_]+_(?:m|kg|g|years|ratio|deg|n_m)\b", said))
        assert named <= names, (named - names, said)


def test_a_table_is_named_by_its_argument():
    import pandas

    said = hints(lambda: fs.fragility(pandas.DataFrame({"a": [1]})))
    assert "/tmp" not in said and ".csv" not in said and "outcomes" in said, said


def test_a_result_names_tables_by_their_arguments():
    import pandas

    table = pandas.read_csv
    ours = fs.risk(outcomes=table(RISK / "outcomes.csv"), hazard=RISK / "hazard.csv", bootstrap=0, years=50,
                   inventory=table(RISK / "costs.csv"))  # fmt: skip
    assert {"outcomes", "inventory"} <= {one["path"] for one in ours.inputs}
    assert "freestand-" not in json.dumps([ours.inputs, ours.warnings])
    listed = fs.check_inventory(pandas.DataFrame({"id": ["a"], "height [mm]": [2000], "thickness [mm]": [300]}))
    assert listed.path == "inventory" and "freestand-" not in json.dumps(listed.to_dict())


def test_numbers_of_numpy_are_numbers(floor_motion):
    """NumPy scalars and zero-dimensional arrays are numbers everywhere, and the block remains hashable."""
    block = fs.Block(np.array(1.8), np.float64(0.4), np.int64(150), stiffness_n_m=np.float64(4.38e6))
    assert block == fs.Block(1.8, 0.4, 150, stiffness_n_m=4.38e6) and hash(block)
    ours = fs.spectrum(floor_motion, 1.8, np.array(0.4), threads=np.int64(1))
    assert ours["uplift_m"].tolist() == fs.spectrum(floor_motion, [1.8], [0.4], threads=1)["uplift_m"].tolist()
    at = [block.shock(cg_rise_m=0.01, at_m=at).to_dict() for at in ((0.1, 1.2), [0.1, 1.2], np.array([0.1, 1.2]))]
    assert at[0] == at[1] == at[2]


def test_files_that_cannot_be_read(tmp_path):
    error = caught(fs.ReadError, lambda: fs.read_motion("nothing.csv"))
    assert error.path == "nothing.csv" and error.line is None and error.hint
    broken = tmp_path / "broken.csv"
    broken.write_text("time [s],acceleration [g]\n0,0\n0.1,0.2\n0.2,x\n")
    error = caught(fs.ReadError, lambda: fs.read_motion(broken))
    assert (error.path, error.line) == (str(broken), 4)
    several = caught(fs.ReadError, lambda: fs.read_motions(["a.csv", "b.csv"]))
    assert [problem.path for problem in several.problems] == ["a.csv", "b.csv"]
    caught(fs.ReadError, lambda: fs.Block(1, 0.5, 100, cushion=tmp_path / "pad.toml"))
    caught(fs.ReadError, lambda: fs.check_inventory(tmp_path / "list.csv"))
    caught(fs.ReadError, lambda: fs.Motion([0, 1], 0.1).write(tmp_path / "no" / "m.csv"))


def test_studies_tell_all_that_is_wrong(tmp_path):
    text = "[building]\nstoreys = -1\nstory_height = \"3 m\"\n"
    error = caught(fs.StudyError, lambda: fs.run(text))
    assert len(error.problems) == 2 and error.problems[0].line == 2
    path = tmp_path / "study.toml"
    path.write_text(text)
    error = caught(fs.StudyError, lambda: fs.assess(path, ROOT / "examples/hospital/inventory.csv"))
    assert {problem.path for problem in error.problems} == {str(path)}
    caught(fs.StudyError, lambda: fs.assess())


def test_calculations_that_fail():
    block = fs.Block(2, 0.4)
    # Restitution 1 loses nothing: a history of many impacts has a limit.
    wave = fs.Motion([0.0, 5.0, -5.0, 0.0] * 50, 0.01)
    up = fs.Motion([-30.0] * 200, 0.01)
    error = caught(fs.SolveError, lambda: block.rock(wave, vertical=up))
    assert error.hint


def test_warnings_point_to_the_caller(floor_motion):
    squat = fs.Block(0.3, 0.6)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        result = squat.rock(floor_motion)
    assert [str(one.message) for one in seen] == result.warnings
    assert seen[0].category is fs.FreestandWarning and seen[0].filename == __file__


def test_exceptions_have_a_common_root():
    for kind in (fs.BadValue, fs.ReadError, fs.StudyError, fs.SolveError, fs.Interrupted):
        assert issubclass(kind, fs.FreestandError)
    assert issubclass(fs.BadValue, ValueError) and issubclass(fs.Interrupted, KeyboardInterrupt)
