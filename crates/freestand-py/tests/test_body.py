"""Bodies by their shape: scans, cylinders, feet."""

import pickle
from types import SimpleNamespace

import freestand as fs
import numpy as np
import pytest

FACES = [
    [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
    [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
]  # fmt: skip


def corners(scale=1.0):
    """A box of 0.2 m × 0.3 m × 1 m around the origin."""
    return np.array([[(2 * (at >> axis & 1) - 1) * half * scale for axis, half in enumerate((0.1, 0.15, 0.5))] for at in range(8)])


def motion(peak_g, name=None):
    accel = np.where(np.arange(200) < 100, peak_g, -peak_g) * 9.80665
    return fs.Motion(accel, 0.01, name) if name else fs.Motion(accel, 0.01)


def test_a_mesh_in_memory_is_the_box_of_its_file(tmp_path):
    path = tmp_path / "box.obj"
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in corners(1e3))
    path.write_text(vertices + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES))
    of_file = fs.Body.from_mesh(path, "mm", mass_kg=140, base="measured")
    in_memory = fs.Body.from_mesh(SimpleNamespace(vertices=corners(), faces=np.array(FACES)), "m", mass_kg=140, base="measured")
    box = fs.Body(height_m=1, thickness_m=0.2, width_m=0.3, mass_kg=140)
    found = [fs.rock(body, motion(0.15), history=True) for body in (of_file, in_memory, box)]
    for one in found:
        assert one.outcome == "stood"
        assert one.body["volume_m3"] == pytest.approx(0.06, abs=1e-12)
        # On the grid of the barrier, 1/80 of a degree.
        assert one.body["tip_angle_rad"] == pytest.approx(np.arctan(0.1 / 0.5), abs=3e-4)
        assert one.contact_points_m.shape == (4, 3)
        assert one.history["tilt_rad"].max() == pytest.approx(one.peak_tilt_rad, rel=0.05)
    assert pickle.loads(pickle.dumps(in_memory)) == in_memory


def test_several_motions_give_a_result_each():
    column = fs.Body(height_m=1, diameter_m=0.2)
    weak, strong = motion(0.15, "weak"), motion(0.6, "strong")
    both = column.rock_each([weak, strong])
    assert [one.outcome for one in both] == ["stood", "overturned"]
    alone = column.rock(strong)
    assert alone.peak_tilt_rad == both[1].peak_tilt_rad
    assert both[1].motion == "strong"
    turned = column.rock(strong, orientation_rad=0.7, across=weak, friction=0.8)
    assert turned.outcome == "overturned"


def test_an_object_may_be_a_body():
    column = fs.Body(height_m=1, diameter_m=0.2, feet_m=[(-0.09, 0), (0.05, 0.07), (0.05, -0.07)])
    found = fs.check_object(body=column, motions=motion(0.6))
    assert (found.model, found.model_bias, found.decision) == ("hull-3d", True, "restrain")
    scan = SimpleNamespace(vertices=corners(), faces=np.array(FACES))
    found = fs.check_object(body=fs.Body.from_mesh(scan, "m", base="measured"), motions=motion(0.15))
    assert found.motions_overturned == 0
    with pytest.raises(fs.BadValue, match="is lower than the object"):
        fs.check_object(body=column, motions=motion(0.6), wall_gap_m=0.1, wall_height_m=0.5)


def test_what_is_no_body_is_refused():
    for bad, words in [
        (lambda: fs.Body.from_mesh(3, "m"), "must be a path or a mesh"),
        (lambda: fs.Body.from_mesh(SimpleNamespace(vertices=[1, 2], faces=FACES), "m"), "has the shape"),
        (lambda: fs.Body(height_m=1, diameter_m=0.2, feet_m=[1, 2, 3]), "must be points"),
        (lambda: fs.Body(height_m=1, diameter_m=0.2, feet_m=[(0, 0)]).rock(motion(0.1)), "3 to 100 feet"),
        (lambda: fs.Body(height_m=1, shape="sphere").rock(motion(0.1)), "rolls away"),
        (lambda: fs.Body(height_m=1).rock(motion(0.1)), "thickness_m is missing"),
        (lambda: fs.Body(height_m=1, diameter_m=0.2).rock(motion(0.1), restitution=0.9), "does not apply"),
    ]:
        with pytest.raises(fs.BadValue, match=words):
            bad()
    open_box = SimpleNamespace(vertices=corners(), faces=np.array(FACES[1:]))
    with pytest.raises(fs.FreestandError, match="holes"):
        fs.Body.from_mesh(open_box, "m").rock(motion(0.1))
    assert fs.Body.from_mesh(open_box, "m", use_hull=True).rock(motion(0.1)).body["is_hull_of_scan"]
    beyond = SimpleNamespace(vertices=corners(), faces=np.array([[0, 1, 8], *FACES]))
    with pytest.raises(fs.FreestandError, match="8 vertices"):
        fs.Body.from_mesh(beyond, "m").rock(motion(0.1))
