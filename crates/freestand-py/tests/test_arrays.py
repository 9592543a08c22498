"""Motions: every kind of array of numbers goes in, and nothing else."""

import freestand as fs
import numpy as np
import pytest
from conftest import FLOOR, ROOT, same, told

SAMPLES = np.sin(np.arange(400) / 7.0)


def misaligned(values):
    raw = np.zeros(len(values) * 8 + 1, "u1")
    raw[1:] = np.frombuffer(values.tobytes(), "u1")
    found = raw[1:].view("f8")
    assert not found.flags.aligned
    return found


def read_only(values):
    values = values.copy()
    values.flags.writeable = False
    return values


@pytest.mark.parametrize(
    "given",
    [
        SAMPLES, SAMPLES.astype(">f8"), SAMPLES.tolist(), tuple(SAMPLES), misaligned(SAMPLES), read_only(SAMPLES),
        np.repeat(SAMPLES, 2)[::2], SAMPLES[::-1][::-1], np.stack([SAMPLES, SAMPLES], axis=1)[:, 1],
    ],
    ids=["doubles", "big-endian", "list", "tuple", "misaligned", "read-only", "every second", "reversed", "column"],
)  # fmt: skip
def test_arrays_of_any_layout_are_the_same_motion(given):
    motion = fs.Motion(given, 0.01)
    np.testing.assert_array_equal(motion.accel_m_s2, SAMPLES)
    assert motion.accel_m_s2.dtype == np.float64 and motion.accel_m_s2.shape == (400,)


@pytest.mark.parametrize("dtype", ["f4", "f2", "i8", "u1"])
def test_other_numbers_are_converted(dtype):
    given = np.array([0, 1, 2, 3], dtype)
    np.testing.assert_array_equal(fs.Motion(given, 0.5).accel_m_s2, [0.0, 1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    "given",
    [[1.0], [], [1.0, np.nan], [1.0, np.inf], [[1.0, 2.0]], ["a", "b"], [1j, 2j], [None, 1.0], [[1.0], [2.0, 3.0]], None],
)
def test_what_is_not_a_motion_is_refused(given):
    with pytest.raises(fs.BadValue) as raised:
        fs.Motion(given, 0.01)
    assert raised.value.hint
    assert "--" not in str(raised.value)


@pytest.mark.parametrize("dt_s", [0, -1, np.nan, "a", None])
def test_steps_are_checked(dt_s):
    with pytest.raises(fs.BadValue):
        fs.Motion(SAMPLES, dt_s)


def test_samples_are_a_read_only_view(floor_motion):
    with pytest.raises(ValueError, match="read-only"):
        floor_motion.accel_m_s2[0] = 1
    assert floor_motion.accel_m_s2 is floor_motion.accel_m_s2
    np.testing.assert_allclose(np.diff(floor_motion.time_s), floor_motion.dt_s, rtol=1e-9)  # rounding of k × dt


def test_measures_and_spectra_equal_the_command(floor_motion):
    theirs = told("motion", "info", FLOOR, "--scale", 3.5)["motions"][0]
    ours = floor_motion.measures()
    assert len(ours) > 15 and ours == {key: theirs[key] for key in ours}
    theirs = told("motion", "spectrum", FLOOR, "--scale", 3.5, "--damping", "2 %", "--periods", "0.1 s, 0.5 s, 1 s")
    ours = floor_motion.spectrum([0.1, 0.5, 1.0], 0.02)
    same(ours.to_dict(), theirs, ("schema", "path", "plots", "warnings"))
    np.testing.assert_array_equal(ours.psa_g, theirs["psa_g"])


def test_processing_equals_the_command():
    raw = fs.read_motion(FLOOR)
    ours = raw.process(low_cut_hz=0.2, high_cut_hz=20, filter_order=4, scale_to_g=0.3)
    theirs = fs.read_motion(FLOOR, low_cut_hz=0.2, high_cut_hz=20, filter_order=4, scale_to_g=0.3)
    np.testing.assert_array_equal(ours.accel_m_s2, theirs.accel_m_s2)
    assert ours.pga_g == pytest.approx(0.3, rel=1e-12)  # one rounding of the factor
    assert raw.scale(2).pga_g == 2 * raw.pga_g


def test_files_round_trip(tmp_path, floor_motion):
    floor_motion.write(tmp_path / "m.csv")
    np.testing.assert_array_equal(fs.read_motion(tmp_path / "m.csv").accel_m_s2, floor_motion.accel_m_s2)
    floor_motion.write(tmp_path / "m.AT2")
    again = fs.read_motion(tmp_path / "m.AT2").accel_m_s2
    np.testing.assert_allclose(again, floor_motion.accel_m_s2, rtol=1e-7, atol=1e-12)  # AT2 has 8 digits
    with pytest.raises(fs.BadValue, match="neither"):
        floor_motion.write(tmp_path / "m.txt")


def test_patterns_and_lists_of_files():
    found = fs.read_motions(str(ROOT / "validation/rocking/records/onesine_*.csv"))
    assert [motion.name for motion in found] == ["onesine_T0.4", "onesine_T1.0"]
    assert fs.read_motions([FLOOR])[0].warnings
    with pytest.raises(fs.BadValue, match="no file"):
        fs.read_motions("nothing-*.csv")


def test_an_obspy_trace_needs_its_unit():
    class Stats:
        delta = 0.01

    class Trace:
        data = np.array([0, 1, 2], "i4")
        stats = Stats()
        id = "NZ.WEL..HNZ"

    motion = fs.Motion.from_obspy(Trace(), unit="g")
    np.testing.assert_allclose(motion.accel_m_s2, [0, 9.80665, 19.6133], rtol=1e-15)
    assert (motion.name, motion.dt_s) == ("NZ.WEL..HNZ", 0.01)
    with pytest.raises(fs.BadValue, match="unit"):
        fs.Motion.from_obspy(Trace())


def test_an_xarray_array_states_its_unit():
    import xarray

    time = np.arange(5) * 0.02
    array = xarray.DataArray([0.0, 1, 2, 1, 0], {"time": time}, "time", "h1", {"units": "cm/s2"})
    motion = fs.Motion.from_xarray(array)
    np.testing.assert_allclose(motion.accel_m_s2, np.array([0, 1, 2, 1, 0]) / 100, rtol=1e-15)
    assert motion.dt_s == pytest.approx(0.02, rel=1e-12) and motion.name == "h1"
    array.attrs = {}
    with pytest.raises(fs.BadValue, match="unit"):
        fs.Motion.from_xarray(array)
