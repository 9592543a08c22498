"""One object or a grid of them under motions, and the shock of a landing."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import Any, Protocol, TypeVar

import numpy as np

from . import _freestand
from ._body import Body, BodyResult
from ._block import Block, Cushion, Files, Sliding, Walls, cushion_given, pad_asked
from ._convert import Given, Numbers, PathLike, bad, data, given, of_kind, sizes_m, threads_given, warn
from ._motion import Motion, record, several
from ._results import DropTestResult, RockResult, ShockResult
from ._table import Table, _Column


R = TypeVar("R", covariant=True)


class Rocks(Protocol[R]):
    """What rocks: a block or a body."""

    def _asked(self) -> tuple[Given, Files]: ...

    def _result(self, document: Given, history: tuple[str, bytes] | None, motion: Motion | None) -> R: ...


def rock(
    block: Rocks[R],
    motion: Motion | None = None,
    *,
    vertical: Motion | None = None,
    restitution: float | None = None,
    restitution_factor: float | None = None,
    model: str | None = None,
    accuracy: str | None = None,
    base: str | None = None,
    initial_rotation_rad: float | None = None,
    initial_velocity_rad_s: float | None = None,
    duration_s: float | None = None,
    history: bool = False,
    walls: Walls | None = None,
    sliding: Sliding | None = None,
    friction: float | None = None,
    gravity_m_s2: float | None = None,
    cg_rise_m: float | None = None,
    contacts: int | None = None,
    at_m: tuple[float, float] | None = None,
    tangential_stiffness_n_m: float | None = None,
    tangential_ratio: float | None = None,
    across: Motion | None = None,
    orientation_rad: float | None = None,
    contact_damping: float | None = None,
    contact_sinking_m: float | None = None,
    rolling_friction: float | None = None,
) -> R:
    """How an object responds to a motion of its floor.

    After the last sample the floor does not move, and the object is followed until it rests or lies.

    Parameters
    ----------
    block : Block or Body
        The object; with mass and cushion the result of a block has the shock.
    motion : Motion, optional
        Without one, give `initial_rotation_rad` or `initial_velocity_rad_s`.
    vertical : Motion, optional
        Vertical motion of the floor, positive upward, with the step and length of `motion`.
    restitution, restitution_factor : float, optional
        In (0, 1]: replaces Housner's ratio of the velocities after and before an impact, or multiplies it.
    model : str, optional
        "rigid" (default) or "linear".
    accuracy : str, optional
        "fast", "standard" (default) or "tight".
    base : str, optional
        "rigid" (default), or "compliant": the object on its cushions.
    initial_rotation_rad, initial_velocity_rad_s : float, optional
        How it begins [rad, rad/s].
    duration_s : float, optional
        When to stop [s]; the outcome may then be `unresolved`.
    history : bool, default False
        Whether the result has arrays over time.
    walls : Walls, optional
        Walls beside it.
    sliding : Sliding, optional
        The object slides or stands on casters.
    friction : float, optional
        Coefficient of friction of the base.
    gravity_m_s2 : float, optional
        Gravity [m/s²], 9.80665 by default.
    cg_rise_m, contacts, at_m, tangential_stiffness_n_m, tangential_ratio : optional
        Of a compliant base alone: the rise from which the object is released [m], the number of contacts, a point (x, z)
        whose acceleration is reported [m], and the tangential stiffness [N/m] or its ratio to the vertical one.
    across, orientation_rad : optional
        Of a body, or of an object that slides: the motion to the left of `motion`, and the angle by which it is turned,
        anticlockwise from above [rad].
    contact_damping, contact_sinking_m, rolling_friction : optional
        Of a body alone: the damping ratio of its contacts with the floor (0.2) and how far three of them sink under its weight [m] (0.0001 of a scan, 0.00001 of a shape);
        the coefficient of rolling friction of a cylinder, lever arm over radius (0).

    Returns
    -------
    RockResult or BodyResult
        `outcome`, `peak_rotation_rad`, `uplift_m`, `edge_acceleration_g`, `impacts`, `history` and more.

    Examples
    --------
    >>> result = fs.rock(fs.Block(1.8, 0.4, mass_kg=150, stiffness_n_m=4.38e6), motion)
    >>> result.outcome, result.impact_count
    ('rocked', 269)
    """
    if not isinstance(block, Body):
        check_block(block)
    of_kind("walls", walls, Walls, "a freestand.Walls")
    of_kind("sliding", sliding, Sliding, "a freestand.Sliding")
    of_kind("history", history, (bool, np.bool_), "True or False")
    history = bool(history)
    asked, files = block._asked()
    asked |= given(
        restitution=restitution, restitution_factor=restitution_factor, model=model, accuracy=accuracy, base=base,
        initial_rotation_rad=initial_rotation_rad, initial_velocity_rad_s=initial_velocity_rad_s, duration_s=duration_s,
        friction=friction, gravity_m_s2=gravity_m_s2, cg_rise_m=cg_rise_m, contacts=contacts, at_m=at_m,
        tangential_stiffness_n_m=tangential_stiffness_n_m, tangential_ratio=tangential_ratio,
        orientation_rad=orientation_rad, contact_damping=contact_damping, contact_sinking_m=contact_sinking_m,
        rolling_friction=rolling_friction,
    )  # fmt: skip
    if walls is not None:
        asked |= walls._asked()
    if sliding is not None:
        asked |= sliding._given() | {"sliding": not sliding.casters}
        if not sliding.brakes:
            # What slides or rolls does not land on its cushion; on brakes that hold, it may.
            asked, files = {name: value for name, value in asked.items() if name not in _OF_CUSHION}, {}
    motions = [] if motion is None else [motion]
    return _followed(block, asked, files, motions, vertical, across, history)[0]


def rock_each(
    body: Body,
    motions: Iterable[Motion],
    *,
    friction: float | None = None,
    orientation_rad: float | None = None,
    contact_damping: float | None = None,
    contact_sinking_m: float | None = None,
    rolling_friction: float | None = None,
    gravity_m_s2: float | None = None,
    history: bool = False,
) -> list[BodyResult]:
    """How a body responds to each of several motions; the options are as those of `rock`."""
    of_kind("history", history, (bool, np.bool_), "True or False")
    asked, files = body._asked()
    asked |= given(
        friction=friction, orientation_rad=orientation_rad, contact_damping=contact_damping,
        contact_sinking_m=contact_sinking_m, rolling_friction=rolling_friction, gravity_m_s2=gravity_m_s2,
    )  # fmt: skip
    return _followed(body, asked, files, several(motions), None, None, bool(history))


def _followed(
    block: Rocks[R],
    asked: Given,
    files: Files,
    motions: Sequence[Motion],
    vertical: Motion | None,
    across: Motion | None,
    history: bool,
) -> list[R]:
    upward = None if vertical is None else record("vertical", vertical)
    to_left = None if across is None else record("across", across)
    horizontal = [record("motion", one) for one in motions]
    text, columns = _freestand.rock(asked, horizontal, upward, to_left, files, history)
    document = json.loads(text)
    warn(document["warnings"])
    shared = {name: value for name, value in document.items() if name != "rows"}
    rows = [row | shared for row in document.get("rows", [])] or [document]
    each = [motions[at] if motions else None for at in range(len(rows))]
    return [block._result(row, columns[at] if columns else None, each[at]) for at, row in enumerate(rows)]


_OF_CUSHION = (
    "stiffness_n_m", "pad_stiffness_n_m", "pads_per_edge", "series_stiffness_n_m", "pad_thickness_m", "law", "exponent",
    "damping_ratio", "damping_n_s_m", "dissipation_s_m", "bottoming_m",
)  # fmt: skip


def check_block(block: object) -> None:
    if not isinstance(block, Block):
        raise bad(f"block must be a freestand.Block, not {type(block).__name__}", "make one: Block(height_m, thickness_m)")


def spectrum(
    motions: Motion | Iterable[Motion],
    heights_m: Numbers,
    thicknesses_m: Numbers,
    *,
    mass_kg: float | None = None,
    stiffness_n_m: float | None = None,
    cushion: Cushion | DropTestResult | PathLike | None = None,
    pairs: bool = False,
    vertical: Motion | Iterable[Motion] | None = None,
    restitution: float | None = None,
    restitution_factor: float | None = None,
    model: str | None = None,
    accuracy: str | None = None,
    walls: Walls | None = None,
    sliding: Sliding | None = None,
    sensitivity: bool = False,
    threads: int | None = None,
) -> Table:
    """Uplift and shock of a grid of uniform objects under each motion.

    Parameters
    ----------
    motions : Motion or iterable of Motion
        Motions of the floor. Those without a name are called "motion 1", "motion 2" by their place in the list.
    heights_m, thicknesses_m : array_like
        Sizes of the objects [m]: all combinations, or with `pairs` the first with the first, and so on.
    mass_kg, stiffness_n_m : float, optional
        Mass, and stiffness of everything under one edge [N/m]; the shock needs both.
    cushion : Cushion, DropTestResult or path, optional
        In place of `stiffness_n_m`.
    pairs : bool, default False
        One object for each (height, thickness) pair.
    vertical : Motion or iterable of Motion, optional
        Vertical motions, one for each motion.
    restitution, restitution_factor, model, accuracy, walls, sliding : optional
        As in `rock`.
    sensitivity : bool, default False
        Whether to report how much each object amplifies an error of the motion, which doubles the work.
    threads : int, optional
        One per core by default; the result does not depend on it.

    Returns
    -------
    Table
        Rows in the order motion, height, thickness. The shock of an object that falls is missing;
        `quantile` ranks it above every number.

    Examples
    --------
    >>> table = fs.spectrum(motions, [1.2, 1.8], [0.3, 0.5, 0.7])
    >>> table.quantile("uplift_m").round(3)
    array([[  inf, 0.   , 0.   ],
           [  inf, 0.003, 0.   ]])
    """
    named = several(motions)
    sizes_m(heights_m=heights_m, thicknesses_m=thicknesses_m)
    of_kind("walls", walls, Walls, "a freestand.Walls")
    of_kind("sliding", sliding, Sliding, "a freestand.Sliding")
    upward = [] if vertical is None else several(vertical, "vertical")
    if upward and len(upward) != len(named):
        raise bad(f"vertical has {len(upward)} motions, motions {len(named)}", "give one for each, in the same order")
    sizes = (data("heights_m", heights_m) or b"", data("thicknesses_m", thicknesses_m) or b"")
    heights, thicknesses = (len(values) // 8 for values in sizes)
    found = cushion_given(cushion, stiffness_n_m, None)
    pad, files = pad_asked(found)
    asked = pad | given(
        mass_kg=mass_kg, pairs=pairs or None, restitution=restitution, restitution_factor=restitution_factor, model=model,
        accuracy=accuracy, sensitivity=sensitivity or None,
    )  # fmt: skip
    if walls is not None:
        asked |= walls._asked()
    if sliding is not None:
        asked |= sliding._given() | {"sliding": not sliding.casters}
    verticals: Sequence[Motion | None] = upward or [None] * len(named)
    records = [
        (motion.name, motion._record, None if second is None else record("vertical", second))
        for motion, second in zip(named, verticals)
    ]
    columns, warnings, timing = _freestand.spectrum(records, *sizes, asked, files, threads_given(threads))
    if pairs:
        dims: tuple[str, ...] = ("motion", "object")
        shape: tuple[int, ...] = (len(named), heights)
    else:
        dims = ("motion", "height_m", "thickness_m")
        shape = (len(named), heights, thicknesses)
    table = Table({name: _Column(kind, held, texts) for name, kind, held, texts in columns}, dims, shape)
    table.warnings = warnings
    table.timing = {"solve_s": timing[0], "block_steps": timing[1]}
    warn(warnings)
    return table


def shock(
    block: Block,
    *,
    cg_rise_m: float | None = None,
    uplift_m: float | None = None,
    rotation_rad: float | None = None,
    angular_velocity_rad_s: float | None = None,
    stiffness_n_m: float | None = None,
    cushion: Cushion | DropTestResult | PathLike | None = None,
    pads_per_edge: int | None = None,
    drop_acceleration_g: float | None = None,
    contact_stiffness_n_m: float | None = None,
    scenario: str | None = None,
    model: str | None = None,
    gap_m: float | None = None,
    obstacle_height_m: float | None = None,
    at_m: tuple[float, float] | None = None,
    friction: float | None = None,
    gravity_m_s2: float | None = None,
    tolerance_g: float | None = None,
    tolerance_duration_s: float | None = None,
    tolerance_velocity_change_m_s: float | None = None,
    tolerance_edge_lift_m: float | None = None,
    component_frequency_hz: float | None = None,
    component_capacity_g: float | None = None,
    damage_boundary: PathLike | None = None,
) -> ShockResult:
    """The shock of one landing.

    Parameters
    ----------
    block : Block
        The object, with its mass.
    cg_rise_m, uplift_m, rotation_rad, angular_velocity_rad_s : float, optional
        One of them: rise of the centre of gravity, uplift of the edge [m], rotation [rad], angular velocity at
        the landing [rad/s].
    stiffness_n_m : float, optional
        Stiffness of everything under one edge [N/m], in place of that of the block.
    cushion : Cushion, DropTestResult or path, optional
        In place of `stiffness_n_m`; a drop test or a cushion file is of one pad.
    pads_per_edge : int, optional
        Pads that share the landing of one edge.
    drop_acceleration_g : float, optional
        Peak of a drop test of the same cushion [g], in place of a stiffness.
    contact_stiffness_n_m : float, optional
        Of the side of an object that falls on something [N/m].
    scenario : str, optional
        "rocking" (default), "halted", "overturn-floor" or "overturn-obstacle".
    model : str, optional
        Model of the landing.
    gap_m, obstacle_height_m : float, optional
        Distance and height of an obstacle [m].
    at_m : tuple of float, optional
        Point (x, z) whose acceleration is reported [m].
    friction, gravity_m_s2 : float, optional
        Coefficient of friction; gravity [m/s²].
    tolerance_g, tolerance_duration_s, tolerance_velocity_change_m_s, tolerance_edge_lift_m : float, optional
        What the object withstands; with it the result has a verdict.
    component_frequency_hz, component_capacity_g : float, optional
        A component inside, and what it withstands.
    damage_boundary : path, optional
        Tests of a damage boundary (CSV).

    Returns
    -------
    ShockResult
        `edge_acceleration_g` is the shock of the landing edge.

    Examples
    --------
    >>> cabinet = fs.Block(2.3, 0.6, mass_kg=140, stiffness_n_m=4.38e6)
    >>> print(f"{fs.shock(cabinet, cg_rise_m=0.016).edge_acceleration_g:.2f}")
    4.53
    """
    check_block(block)
    asked, files = block._asked(cushion_given(cushion, stiffness_n_m, pads_per_edge))
    asked |= given(
        cg_rise_m=cg_rise_m, uplift_m=uplift_m, rotation_rad=rotation_rad,
        angular_velocity_rad_s=angular_velocity_rad_s, drop_acceleration_g=drop_acceleration_g,
        contact_stiffness_n_m=contact_stiffness_n_m, scenario=scenario, model=model, gap_m=gap_m,
        obstacle_height_m=obstacle_height_m, at_m=at_m, friction=friction, gravity_m_s2=gravity_m_s2,
        tolerance_g=tolerance_g, tolerance_duration_s=tolerance_duration_s,
        tolerance_velocity_change_m_s=tolerance_velocity_change_m_s, tolerance_edge_lift_m=tolerance_edge_lift_m,
        component_frequency_hz=component_frequency_hz, component_capacity_g=component_capacity_g,
    )  # fmt: skip
    if damage_boundary is not None:
        files["damage_boundary"] = (damage_boundary, None)
    result = ShockResult._of(_freestand.shock(asked, files))
    warn(result.warnings)
    return result
