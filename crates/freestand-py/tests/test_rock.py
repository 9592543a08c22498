"""One object under one motion: the same numbers as the command."""

import pickle

import freestand as fs
import numpy as np
import pytest
from conftest import CABINET, FLOOR, RECORDS, same, told

WITHOUT = ("schema", "processing", "warnings")
RECORD = ["--motion", FLOOR, "--scale", "3.5"]


@pytest.mark.parametrize("record", ["synthfloor", "onecosine_T0.8", "onesine_T0.4", "onesine_T1.0", "decsine_f1.25", "bench4000"])
@pytest.mark.parametrize("size", [(2.3, 0.6), (1.8, 0.4), (2.4, 0.3), (0.5, 0.6)])
def test_a_corpus_equals_the_command(record, size):
    path = RECORDS / f"{record}.csv"
    theirs = told("rock", "--motion", path, "--scale", 1.5, "--height", f"{size[0]} m", "--thickness", f"{size[1]} m",
                  "--mass", "140 kg", "--stiffness", "4380 N/mm")  # fmt: skip
    block = fs.Block(*size, mass_kg=140, stiffness_n_m=4.38e6)
    result = block.rock(fs.read_motion(path, scale=1.5))
    same(result.to_dict(), theirs, WITHOUT)


@pytest.mark.parametrize(
    ("flags", "options"),
    [
        (["--restitution", 0.7], {"restitution": 0.7}),
        (["--restitution-factor", 0.9], {"restitution_factor": 0.9}),
        (["--accuracy", "fast"], {"accuracy": "fast"}),
        (["--model", "linear"], {"model": "linear"}),
        (["--duration", "40 s"], {"duration_s": 40}),
        (["--gravity", "9.81 m/s2"], {"gravity_m_s2": 9.81}),
        (["--friction", 0.2], {"friction": 0.2}),
        (["--wall-gap-left", "20 mm", "--wall-restitution", 0.5, "--wall-stiffness", "2000 N/mm"],
         {"walls": fs.Walls(left_m=0.02, restitution=0.5, stiffness_n_m=2e6)}),
    ],
)  # fmt: skip
def test_options_equal_flags(cabinet, floor_motion, flags, options):
    theirs = told("rock", *RECORD, *CABINET, *flags)
    result = fs.rock(cabinet, floor_motion, **options)
    same(result.to_dict(), theirs, WITHOUT)
    # The command also warns of how the file was read.
    assert theirs["warnings"][-len(result.warnings) :] == result.warnings or not result.warnings


def test_free_rocking_equals_the_command(cabinet):
    theirs = told("rock", *CABINET, "--initial-rotation", "0.1 rad", "--duration", "10 s")
    same(cabinet.rock(initial_rotation_rad=0.1, duration_s=10).to_dict(), theirs, WITHOUT)


def test_sliding_equals_the_command(floor_motion):
    size = ["--height", "1 m", "--thickness", "0.6 m"]
    theirs = told("rock", *RECORD, *size, "--sliding", "--friction", 0.1, "--clearance-left", "10 mm")
    sliding = fs.Sliding(friction=0.1, clearance_left_m=0.01)
    result = fs.rock(fs.Block(1, 0.6), floor_motion, sliding=sliding, history=True)
    same(result.to_dict(), theirs, WITHOUT)
    assert result.slide_peak_m == theirs["slide_peak_m"]
    assert list(result.history) == ["time_s", "slide_m", "velocity_m_s", "base_accel_m_s2"]


def test_a_compliant_base_equals_the_command(cabinet):
    theirs = told("rock", *CABINET, "--base", "compliant", "--cg-rise", "16 mm", "--at", "0.3 m, 1.2 m")
    result = fs.rock(cabinet, base="compliant", cg_rise_m=0.016, at_m=(0.3, 1.2), history=True)
    same(result.to_dict(), theirs, WITHOUT)
    assert result.impacts["edge"][0] in ("left", "right")
    assert "at_horizontal_g" in result.history


def test_impacts_and_history(cabinet, floor_motion, tmp_path):
    result = cabinet.rock(floor_motion, history=True)
    assert result.impacts.dtype.names == (
        "time_s", "omega_before_rad_s", "omega_after_rad_s", "edge_acceleration_impact_velocity_g",
    )  # fmt: skip
    assert result.impacts.shape == (result.impact_count,) and result.impact_count > 10
    assert set(result.history) == {"time_s", "theta_rad", "omega_rad_s", "uplift_m", "base_accel_m_s2"}
    told("rock", *RECORD, *CABINET, "--history", tmp_path / "history.csv")
    theirs = np.genfromtxt(tmp_path / "history.csv", delimiter=",", names=True)
    for name, ours in result.history.items():
        np.testing.assert_array_equal(ours, theirs[name])
    assert cabinet.rock(floor_motion).history is None


def test_the_documented_attributes_are_those_of_the_document(cabinet, floor_motion):
    result = cabinet.rock(floor_motion)
    documented = set(fs.RockResult.__annotations__) - {"history"}
    documented = {name for name in documented if not name.startswith("_")}
    assert documented | {"schema", "impacts", "wall_impacts", "warnings"} == set(result.to_dict())


def test_a_block_is_a_value(cabinet):
    assert cabinet == fs.Block(2.3, 0.6, 140, stiffness_n_m=4.38e6)
    assert hash(cabinet) == hash(pickle.loads(pickle.dumps(cabinet)))
    assert pickle.loads(pickle.dumps(cabinet)) == cabinet
    with pytest.raises(AttributeError):
        cabinet.height_m = 3
    # By hand: R = √(2.3² + 0.6²)/2, α = atan(0.6/2.3), lift = 0.6/2.3 g.
    assert cabinet.half_diagonal_m == pytest.approx(1.188486, abs=1e-6)
    assert cabinet.slenderness_angle_rad == pytest.approx(0.255182, abs=1e-6)
    assert cabinet.lift_acceleration_g == pytest.approx(0.6 / 2.3, rel=1e-12)
    theirs = told("rock", *CABINET, "--initial-rotation", "0.1 rad", "--duration", "1 s")
    assert cabinet.frequency_rad_s == theirs["frequency_parameter_rad_s"]


def test_results_pickle(cabinet, floor_motion):
    result = cabinet.rock(floor_motion, history=True)
    again = pickle.loads(pickle.dumps(result))
    assert again.to_dict() == result.to_dict()
    np.testing.assert_array_equal(again.history["theta_rad"], result.history["theta_rad"])
    motion = pickle.loads(pickle.dumps(floor_motion))
    np.testing.assert_array_equal(motion.accel_m_s2, floor_motion.accel_m_s2)
    assert (motion.name, motion.dt_s, motion.processing) == (floor_motion.name, floor_motion.dt_s, floor_motion.processing)


def test_conversions(cabinet, floor_motion):
    result = cabinet.rock(floor_motion, history=True)
    dataset = result.to_xarray()
    assert dataset.sizes["time_s"] == len(result.history["time_s"])
    assert result.to_pandas()["outcome"] == result.outcome
    assert "edge_acceleration_g" in result._repr_html_() and "rocked" in repr(result)
    with pytest.raises(fs.BadValue, match="history=True"):
        cabinet.rock(floor_motion).to_xarray()


def test_the_object_is_followed_until_it_rests_or_lies():
    """A pulse that ends while the object is beyond its balance point, with zeros after it and without."""
    sine = 0.5 * 9.80665 * np.sin(2 * np.pi * np.arange(101) * 0.01)
    bare, padded = fs.Motion(sine, 0.01), fs.Motion(np.append(sine, np.zeros(2000)), 0.01)
    block = fs.Block(1.5, 0.3)
    assert [block.rock(motion).outcome for motion in (bare, padded)] == ["overturned"] * 2
    assert block.rock(bare, duration_s=1).outcome == "unresolved"
    assert block.rock(initial_rotation_rad=0.1).outcome == "rocked"
    assert list(fs.spectrum(bare, [1.5], [0.3]).column("outcome")) == ["overturned"]
