"""Motions without a name, sizes in other units, and one name for one thing."""

import pickle

import freestand as fs
import numpy as np
import pytest

WAVE = [0, 3.0, -3.0, 0]


def test_motions_without_a_name_get_numbers():
    bare = [fs.Motion(WAVE, 0.1), fs.Motion(WAVE, 0.1)]
    assert fs.spectrum(bare, [1], [0.1]).column("motion").tolist() == ["motion 1", "motion 2"]
    # By their place in the list, also after what keeps a motion unnamed.
    mixed = [fs.Motion(WAVE, 0.1, "a"), bare[0].scale(2), pickle.loads(pickle.dumps(bare[1])), bare[0].process(scale=3)]
    assert fs.spectrum(mixed, [1], [0.1]).column("motion").tolist() == ["a", "motion 2", "motion 3", "motion 4"]
    assert fs.spectrum(bare[0], [1], [0.1]).column("motion").tolist() == ["motion"]
    assert fs.ida(fs.Block(1, 0.1), bare, [1]).motions == ["motion 1", "motion 2"]
    assert [one["motion"] for one in fs.floor(bare, storeys=2).to_dict()["motions"]] == ["motion 1", "motion 2"]
    assert fs.check_object(1, 0.1, motions=[bare[0], bare[1].scale(2)]).motions == 2
    with pytest.raises(fs.BadValue, match="are called a"):
        fs.spectrum([mixed[0], mixed[0]], [1], [0.1])


@pytest.mark.parametrize(
    "call",
    [
        lambda: fs.Block(1800, 400),
        lambda: fs.Block(180, 40),
        lambda: fs.Block(1.8, 0.4, cg_height_m=900),
        lambda: fs.spectrum(fs.Motion(WAVE, 0.1), [1.2, 1800], [0.3]),
        lambda: fs.check_object(1800, 400, pga_g=0.3),
        lambda: fs.restrain(150, 1800, 400, floor_acceleration_g=0.5),
    ],
)
def test_sizes_in_other_units_are_refused(call):
    with pytest.raises(fs.BadValue, match="no free-standing object is so large") as raised:
        call()
    assert "in meters" in str(raised.value)


def test_the_largest_obelisk_is_an_object():
    assert fs.Block(42, 4.2).height_m == 42


def test_a_property_has_the_name_that_results_have():
    block = fs.Block(1.8, 0.4)
    result = fs.rock(block, fs.Motion(WAVE, 0.1))
    for name in ("half_diagonal_m", "slenderness_angle_rad", "frequency_parameter_rad_s", "restitution_ratio",
                 "uplift_threshold_g"):  # fmt: skip
        # Two orders of the same sum differ in the last digit.
        assert getattr(block, name) == pytest.approx(getattr(result, name), rel=1e-14)
    assert block.frequency_rad_s == block.frequency_parameter_rad_s
    assert block.lift_acceleration_g == block.uplift_threshold_g


def test_the_time_step_is_dt_s():
    ours = fs.synth(1, seed=7, site="Ce", shaking_s=20, dt_s=0.01).records[0]
    assert ours.dt_s == 0.01
    earlier = fs.synth(1, seed=7, site="Ce", shaking_s=20, time_step_s=0.01).records[0]
    np.testing.assert_array_equal(earlier.accel_m_s2, ours.accel_m_s2)
    with pytest.raises(fs.BadValue, match="keep dt_s"):
        fs.synth(1, dt_s=0.01, time_step_s=0.01)


@pytest.mark.parametrize(
    "call",
    [
        lambda slides: fs.spectrum(fs.Motion(WAVE, 0.1), [0.8], [0.6], sliding=slides, restitution=0.9),
        lambda slides: fs.spectrum(fs.Motion(WAVE, 0.1), [0.8], [0.6], sliding=slides, restitution_factor=0.9),
        lambda slides: fs.spectrum(fs.Motion(WAVE, 0.1), [0.8], [0.6], sliding=slides, model="linear"),
        lambda _: fs.code_spectrum([0, 1], building_height_m=30),
    ],
)
def test_arguments_without_effect_are_refused(call):
    with pytest.raises(fs.BadValue, match="no effect|needs parts"):
        call(fs.Sliding(friction=0.25))


def test_html_shows_the_object_and_the_warnings():
    block = fs.Block(1.8, 0.4, mass_kg=150)
    assert "uplift_threshold_g" in block._repr_html_() and "150" in block._repr_html_()
    assert "pga_g" in fs.Motion(WAVE, 0.1, "<b>")._repr_html_() and "<b>" not in fs.Motion(WAVE, 0.1, "<b>")._repr_html_()
    # h/t < 0.7071 is calculated with a warning.
    flat = fs.rock(fs.Block(0.3, 0.6), fs.Motion([0, 30.0, -30.0, 0], 0.1))
    assert flat.warnings and "Warnings" in flat._repr_html_()
