"""Bodies by their shape: a scan, a cylinder, a polygon, a box on feet."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._base import Columns, Result
from ._block import Files
from ._convert import Array, Given, bad, data, given, path_text

#: The coordinates of the vertices of a mesh, and the numbers of those of its triangles.
_Mesh = tuple[bytes, bytes]


@dataclass(frozen=True, kw_only=True)
class Body:
    """An object of any shape, followed on the points of its hull, in three dimensions, on a stiff floor.

    What decides whether it falls is the true shape of its base: a base that is slightly curved rolls where a flat
    one strikes and loses energy. In tests of two scanned rocks on a shake table the model underestimated overturning
    (docs/validation.md): the `model_bias` of its results is True.

    `Body.from_mesh` takes a scan. Otherwise give the sizes.

    Parameters
    ----------
    height_m : float, optional
        Height [m].
    diameter_m : float, optional
        Diameter of a cylinder, or of the circle through the corners of a polygon [m].
    thickness_m, width_m : float, optional
        Sizes of a box along x and y [m].
    shape : str, optional
        "box", "cylinder" or "polygon:N"; by default a cylinder where there is a diameter, else a box.
    feet_m : sequence of (x, y), optional
        Points on which it stands, from the middle of its outline; of a scan in its axes [m].
    cg_height_m : float, optional
        Height of the centre of gravity [m]; half of the height by default.
    mass_kg : float, optional
        Mass [kg]; it changes nothing but what is reported.

    Examples
    --------
    >>> column = fs.Body(height_m=1.8, diameter_m=0.3)
    >>> result = fs.rock(column, motion)
    >>> print(f"{result.body['tip_angle_rad']:.3f} rad")
    0.165 rad
    """

    height_m: float | None = None
    diameter_m: float | None = None
    thickness_m: float | None = None
    width_m: float | None = None
    shape: str | None = None
    feet_m: tuple[tuple[float, float], ...] | None = None
    cg_height_m: float | None = None
    mass_kg: float | None = None
    scan: str | None = None
    scan_unit: str | None = None
    scan_base: str | None = None
    scan_error_m: float | None = None
    scan_hull: bool | None = None
    stand_on: int | None = None
    _mesh: _Mesh | None = None

    def __post_init__(self) -> None:
        if self.feet_m is not None:
            object.__setattr__(self, "feet_m", _points("feet_m", self.feet_m))

    @classmethod
    def from_mesh(
        cls,
        mesh: Any,
        unit: str,
        *,
        mass_kg: float | None = None,
        base: str | None = None,
        error_m: float | None = None,
        use_hull: bool = False,
        stand_on: int | None = None,
        feet_m: Iterable[Sequence[float]] | None = None,
    ) -> Body:
        """A body in the shape of a scan, z upward.

        Parameters
        ----------
        mesh : path or trimesh.Trimesh
            An OBJ, STL, PLY or binary glTF file, or what has `vertices` and triangular `faces`.
        unit : str
            Unit of length of the scan: "m", "cm", "mm", "in" or "ft".
        mass_kg : float, optional
            Mass [kg].
        base : str, optional
            "measured" where its underside was scanned as well, to less than 1 mm; "flat" by default.
        error_m : float, optional
            Error of the surface [m]: what is this near to the lowest point of a flat base is on the floor; 0.002 by default.
        use_hull : bool, default False
            Whether the convex hull takes the place of a mesh with holes or in several parts.
        stand_on : int, optional
            The stable pose in which it stands, 1 the most upright one; others need a measured base.
        feet_m : sequence of (x, y), optional
            Points on which it stands, in the axes of the scan [m].

        Examples
        --------
        >>> statue = fs.Body.from_mesh("statue.glb", unit="mm", mass_kg=42)  # doctest: +SKIP
        >>> fs.rock(statue, motion).outcome  # doctest: +SKIP
        'stood'
        """
        arrays = None
        if isinstance(mesh, str | os.PathLike):
            name = path_text("mesh", mesh)
        elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            name, arrays = "scan", (_triples("vertices", mesh.vertices), _triples("faces", mesh.faces))
        else:
            raise bad(f"mesh must be a path or a mesh, not {type(mesh).__name__}", "give a path or a trimesh.Trimesh")
        return cls(
            scan=name, scan_unit=unit, scan_base=base, scan_error_m=error_m, scan_hull=use_hull or None, stand_on=stand_on,
            mass_kg=mass_kg, feet_m=None if feet_m is None else _points("feet_m", feet_m), _mesh=arrays,
        )  # fmt: skip

    def _asked(self) -> tuple[Given, Files]:
        """The values of a request, and the scan."""
        values = given(**{name: getattr(self, name) for name in _NAMES})
        if self.feet_m is not None:
            values["feet"] = "; ".join(f"{x!r} m, {y!r} m" for x, y in self.feet_m)
        if self._mesh is not None:
            return values, {"scan": self._mesh}
        if not {"shape", "diameter_m", "feet"} & values.keys() and self.scan is None:
            values["shape"] = "box"
        return values, {} if self.scan is None else {"scan": (self.scan, None)}

    def _result(self, document: Given, history: tuple[str, bytes] | None, motion: Any) -> BodyResult:
        return BodyResult(document, history)

    def rock(self, motion: Any, **options: Any) -> BodyResult:
        """Its response to a motion: the same as `freestand.rock(body, motion, …)`."""
        from ._rocking import rock

        return rock(self, motion, **options)

    def rock_each(self, motions: Any, **options: Any) -> list[BodyResult]:
        """Its response to each of several motions, several at once; its shape is read once."""
        from ._rocking import rock_each

        return rock_each(self, motions, **options)


_NAMES = (
    "height_m", "diameter_m", "thickness_m", "width_m", "shape", "cg_height_m", "mass_kg",
    "scan_unit", "scan_base", "scan_error_m", "scan_hull", "stand_on",
)  # fmt: skip


def _points(name: str, points: Iterable[Sequence[float]]) -> tuple[tuple[float, float], ...]:
    try:
        found = tuple((float(x), float(y)) for x, y in points)
    except (TypeError, ValueError):
        raise bad(f"{name} must be points (x, y)", f"give {name} such as [(-0.2, -0.1), (0.2, -0.1), (0, 0.2)]") from None
    return found


def _triples(name: str, values: Any) -> bytes:
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != 3:
        raise bad(f"{name} of the mesh has the shape {array.shape}, not (n, 3)", "give a mesh of triangles")
    if name == "faces" and array.dtype.kind not in "iu":
        raise bad("the faces of the mesh are not whole numbers", "give a mesh of triangles")
    if name == "faces" and array.size and array.min() < 0:
        raise bad("a triangle of the mesh has a negative number", "number the vertices from 0")
    return data(name, array.reshape(-1).astype("f8")) or b""


class BodyResult(Result):
    """The response of a body on the points of its hull.

    `outcome` is `stood`, `shifted` (it rests in another stable pose, which counts as a fall), `overturned` or `unresolved`.
    """

    outcome: str
    shifted_to: int | None
    end_time_s: float
    peak_tilt_rad: float
    #: The largest tilt divided by that at which it tips over its weakest side.
    peak_tilt_ratio: float
    peak_tilt_time_s: float
    overturn_time_s: float | None
    moved_x_m: float
    moved_y_m: float
    #: Its volume, tip angle, energy barrier, contact points and stable poses, by name.
    body: dict[str, Any]
    #: time_s, tilt_x_rad, tilt_y_rad, tilt_rad, yaw_rad, base_x_m, base_y_m, base_z_m; None if not recorded.
    history: Columns | None

    def __init__(self, document: dict[str, Any], history: tuple[str, bytes] | None) -> None:
        self._document = document
        self.__dict__.update(document)
        self.history = None if history is None else Columns(*history)

    @property
    def contact_points_m(self) -> Array:
        """The points on which it is followed, from its centre of gravity, one row each [m]."""
        return np.array(self.body["contact_points"])

