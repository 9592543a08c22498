"""The object, its cushion, its walls and what is under it."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, fields
from typing import Any, TypeAlias

from . import _freestand
from ._convert import Given, PathLike, bad, given, of_kind, plain, sizes_m, words
from ._results import DropTestResult, RockResult


#: Files by the keys that name them: a path, or the text of the file; or the arrays of a mesh.
Files: TypeAlias = "dict[str, tuple[PathLike | None, str | None] | tuple[bytes, bytes]]"


@dataclass(frozen=True, kw_only=True)
class Cushion:
    """The cushion under one edge: of the whole edge (`stiffness_n_m`), or of one pad of several.

    Parameters
    ----------
    stiffness_n_m : float or str, optional
        Stiffness of everything under one edge [N/m]; of a power law a text such as "2e7 N/m^1.5".
    pad_stiffness_n_m : float or str, optional
        Stiffness of one pad [N/m]; needs `pads_per_edge`, as do `pad` and `file`.
    pads_per_edge : int, optional
        Pads that share the landing of one edge.
    series_stiffness_n_m : float or tuple of float, optional
        Layers in series: legs, floor covering [N/m].
    pad_thickness_m : float, optional
        Thickness of the pad [m], for warnings.
    law : str, optional
        "linear" (default), "power", "kelvin-voigt", "hunt-crossley" or "tangent".
    exponent, damping_ratio, damping_n_s_m, dissipation_s_m, bottoming_m : float, optional
        Of these laws.
    pad : DropTestResult, optional
        A pad from its drop tests.
    file : path, optional
        A cushion file.

    Examples
    --------
    >>> feet = fs.Cushion(pad_stiffness_n_m=2.19e6, pads_per_edge=2)
    >>> print(f"{fs.Block(2.3, 0.6, 140, cushion=feet).shock(cg_rise_m=0.016).edge_acceleration_g:.2f}")
    4.53
    """

    #: Stiffness of everything under one edge [N/m]; of a power law a text such as "2e7 N/m^1.5".
    stiffness_n_m: float | str | None = None
    #: Stiffness of one pad [N/m].
    pad_stiffness_n_m: float | str | None = None
    #: Pads that share the landing of one edge: 2 for a cabinet on four feet.
    pads_per_edge: int | None = None
    #: Layers in series: legs, floor covering [N/m].
    series_stiffness_n_m: float | tuple[float, ...] | None = None
    #: Thickness of the pad, for warnings [m].
    pad_thickness_m: float | None = None
    law: str | None = None
    exponent: float | None = None
    #: Damping ratio of the object on the cushion (kelvin-voigt).
    damping_ratio: float | None = None
    #: Damping [N s/m] (kelvin-voigt).
    damping_n_s_m: float | None = None
    #: Dissipation [s/m] (hunt-crossley).
    dissipation_s_m: float | None = None
    #: Compression at which a tangent law bottoms [m].
    bottoming_m: float | None = None
    pad: DropTestResult | None = None
    file: PathLike | None = None

    def _given(self) -> Given:
        if self.damping_ratio is not None and self.damping_n_s_m is not None:
            raise bad("damping_ratio and damping_n_s_m exclude each other", "keep one of them")
        if self.pad is not None and self.file is not None:
            raise bad("pad and file exclude each other", "keep one of them")
        of_kind("pad", self.pad, DropTestResult, "a DropTestResult")
        toml = None
        if self.pad is not None:
            toml = self.pad.cushion_toml
            if toml is None:
                raise bad("these drop tests give no pad", "see their pooled[\"reason\"]")
        keys = {one.name: getattr(self, one.name) for one in fields(self) if one.name not in ("pad", "file")}
        return given(cushion=words(**keys, cushion=self.file), pad_toml=toml)


def cushion_given(
    cushion: Cushion | DropTestResult | PathLike | None, stiffness_n_m: float | str | None, pads_per_edge: int | None
) -> Given:
    """What describes the cushion, from the arguments of a call."""
    if cushion is None:
        if stiffness_n_m is None and pads_per_edge is None:
            return {}
        return Cushion(stiffness_n_m=stiffness_n_m, pads_per_edge=pads_per_edge)._given()
    if stiffness_n_m is not None:
        raise bad("cushion and stiffness_n_m exclude each other", "keep one of them")
    if isinstance(cushion, DropTestResult):
        return Cushion(pad=cushion, pads_per_edge=pads_per_edge)._given()
    if isinstance(cushion, str | os.PathLike):
        return Cushion(file=cushion, pads_per_edge=pads_per_edge)._given()
    of_kind("cushion", cushion, Cushion, "a freestand.Cushion, a DropTestResult or the path of a cushion file")
    if pads_per_edge is not None:
        raise bad("cushion states pads_per_edge itself", "leave pads_per_edge out")
    return cushion._given()


def pad_asked(cushion: Given) -> tuple[Given, Files]:
    """The values of a request that describe the cushion, and the file of the pad."""
    values = dict(cushion.get("cushion", {}))
    path, text = values.pop("cushion", None), cushion.get("pad_toml")
    return values, {} if path is None and text is None else {"cushion": (path, text)}


@dataclass(frozen=True)
class Block:
    """A free-standing object: a rigid block that rocks about the edges of its base.

    Frozen and hashable; it pickles. A size above 50 m is refused: it was meant in other units.

    Parameters
    ----------
    height_m, thickness_m : float
        Size in the plane in which it rocks [m].
    mass_kg : float, optional
        Mass [kg]; the shock needs it.
    width_m : float, optional
        Horizontal size across the thickness [m].
    base_width_m : float, optional
        Distance between the two edges [m], if the feet are inset.
    cg_height_m, cg_offset_m : float, optional
        Centre of gravity: its height, and its distance to the right of the middle [m].
    inertia_kg_m2 : float, optional
        Moment of inertia about the left edge [kg m²]; needs the mass.
    stiffness_n_m : float, optional
        Stiffness of everything under one edge [N/m].
    cushion : Cushion or path, optional
        In place of `stiffness_n_m`.

    Examples
    --------
    >>> cabinet = fs.Block(height_m=1.8, thickness_m=0.4, mass_kg=150, stiffness_n_m=4.38e6)
    >>> print(f"{cabinet.uplift_threshold_g:.3f} g")
    0.222 g
    """

    height_m: float
    thickness_m: float
    mass_kg: float | None = None
    #: Horizontal size across the thickness.
    width_m: float | None = None
    #: Distance between the two edges, if the feet are inset.
    base_width_m: float | None = None
    cg_height_m: float | None = None
    #: Positive to the right.
    cg_offset_m: float | None = None
    #: About the left edge; needs the mass.
    inertia_kg_m2: float | None = None
    stiffness_n_m: float | None = None
    cushion: Cushion | PathLike | None = None
    _body: _freestand.Body = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in (*_SIZES, "stiffness_n_m"):
            object.__setattr__(self, name, plain(getattr(self, name)))
        sizes_m(**{name: getattr(self, name) for name in _LENGTHS if getattr(self, name) is not None})
        values = given(**{name: getattr(self, name) for name in _SIZES}) | cushion_given(self.cushion, self.stiffness_n_m, None)
        object.__setattr__(self, "_body", _freestand.Body(values))

    def _asked(self, cushion: Given | None = None) -> tuple[Given, Files]:
        """The values of a request, and the file of the pad; with another cushion, if there is one."""
        values, files = pad_asked(cushion or cushion_given(self.cushion, self.stiffness_n_m, None))
        return given(**{name: getattr(self, name) for name in _SIZES if name != "width_m"}) | values, files

    def _result(self, document: Given, history: tuple[str, bytes] | None, motion: Any) -> RockResult:
        return RockResult(document, history, motion)

    def __reduce__(self) -> tuple[Any, ...]:
        return Block, tuple(getattr(self, one.name) for one in fields(self) if one.init)

    @property
    def half_diagonal_m(self) -> float:
        """R: from the edge to the centre of gravity [m]."""
        return self._body.half_diagonal_m

    @property
    def slenderness_angle_rad(self) -> float:
        """α: between R and the vertical [rad]."""
        return self._body.slenderness_angle_rad

    @property
    def frequency_parameter_rad_s(self) -> float:
        """p: the frequency parameter, √(3g/4R) of a uniform block [rad/s]."""
        return self._body.frequency_rad_s

    @property
    def frequency_rad_s(self) -> float:
        """The earlier name of `frequency_parameter_rad_s`."""
        return self._body.frequency_rad_s

    @property
    def restitution_ratio(self) -> float:
        """Housner's ratio of the angular velocities after and before an impact."""
        return self._body.restitution_ratio

    @property
    def uplift_threshold_g(self) -> float:
        """Acceleration of the floor that lifts an edge [g]."""
        return self._body.lift_acceleration_g

    @property
    def lift_acceleration_g(self) -> float:
        """The earlier name of `uplift_threshold_g`."""
        return self._body.lift_acceleration_g

    def _repr_html_(self) -> str:
        import html

        given = [(one.name, getattr(self, one.name)) for one in fields(self) if one.init]
        derived = ("half_diagonal_m", "slenderness_angle_rad", "frequency_parameter_rad_s", "restitution_ratio", "uplift_threshold_g")
        facts = [(name, str(value)) for name, value in given if value is not None]
        facts += [(name, f"{getattr(self, name):.6g}") for name in derived]
        rows = "".join(f"<tr><th>{name}</th><td>{html.escape(value)}</td></tr>" for name, value in facts)
        return f"<table><caption>Block</caption><tbody>{rows}</tbody></table>"

    def rock(self, motion: Any = None, **options: Any) -> Any:
        """Its response to a motion: the same as `freestand.rock(block, motion, …)`."""
        from ._rocking import rock

        return rock(self, motion, **options)

    def shock(self, **options: Any) -> Any:
        """One landing: the same as `freestand.shock(block, …)`."""
        from ._rocking import shock

        return shock(self, **options)


_LENGTHS = ("height_m", "thickness_m", "width_m", "base_width_m", "cg_height_m", "cg_offset_m")
_SIZES = (
    "height_m", "thickness_m", "mass_kg", "width_m", "base_width_m", "cg_height_m", "cg_offset_m", "inertia_kg_m2",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Walls:
    """Walls beside the object.

    Parameters
    ----------
    left_m, right_m : float, optional
        Gaps [m], 0 where they touch; None: no wall on this side.
    height_m : float, optional
        Height of the walls [m]; None: taller than the object.
    restitution : float, optional
        Angular velocity after an impact on a wall divided by the one before, 0 to below 1.
    stiffness_n_m : float, optional
        At the point of contact [N/m]; with the mass it gives the shock there.
    damping_ratio : float, optional
        c/(2√(k m)) of the walls of an object on cushions; None: that under an edge.

    Examples
    --------
    >>> result = fs.rock(fs.Block(1.8, 0.4), motion, walls=fs.Walls(left_m=0.02, restitution=0.5))
    >>> result.wall_impact_count > 0
    True
    """

    left_m: float | None = None
    right_m: float | None = None
    #: Height of the walls; None: taller than the object.
    height_m: float | None = None
    #: Angular velocity after an impact on a wall divided by the one before, 0 to below 1.
    restitution: float | None = None
    #: At the point of contact; with the mass it gives the shock there.
    stiffness_n_m: float | None = None
    #: c/(2√(k m)) of the walls of an object on cushions; None: that under an edge.
    damping_ratio: float | None = None

    def _asked(self) -> Given:
        keys = {"left_m": "wall_gap_left_m", "right_m": "wall_gap_right_m"}
        return {keys.get(name, name): value for name, value in self._given().items()}

    def _given(self) -> Given:
        return given(
            left_m=self.left_m,
            right_m=self.right_m,
            wall_height_m=self.height_m,
            wall_restitution=self.restitution,
            wall_stiffness_n_m=self.stiffness_n_m,
            wall_damping=self.damping_ratio,
        )


@dataclass(frozen=True, kw_only=True)
class Sliding:
    """The object slides on its base, or stands on casters and rolls.

    Parameters
    ----------
    friction, friction_kinetic : float, optional
        Coefficient of friction at rest and while it slides, of the base or of braked wheels.
    casters, brakes : bool, optional
        Whether it stands on casters, and whether these are braked.
    rolling_resistance : float, optional
        Of free casters.
    clearance_left_m, clearance_right_m : float, optional
        Room beside it [m]: the time and the speed at which it is reached are reported.
    stop_stiffness_n_m : float, optional
        Of the stop at the end of the clearance [N/m]; with the mass it gives the shock there.

    Examples
    --------
    >>> fs.rock(fs.Block(0.8, 0.6), motion.scale(3), sliding=fs.Sliding(friction=0.2)).outcome
    'slid'
    """

    #: Coefficient of friction at rest, of the base or of braked wheels.
    friction: float | None = None
    friction_kinetic: float | None = None
    casters: bool | None = None
    rolling_resistance: float | None = None
    brakes: bool | None = None
    #: Room beside it: the time and the speed at which it is reached are reported.
    clearance_left_m: float | None = None
    clearance_right_m: float | None = None
    #: Stiffness of the stop at the end of the clearance; with the mass it gives the shock there.
    stop_stiffness_n_m: float | None = None

    def _given(self) -> Given:
        return given(**{one.name: getattr(self, one.name) for one in fields(self)})
