"""The requests: each is a command of freestand as a function."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypedDict

import numpy as np

from . import _freestand
from ._block import Block, Cushion, Sliding, Walls, cushion_given
from ._convert import Numbers, PathLike, bad, data, given, of_kind, path_text, paths_text, removed_on_failure, warn
from ._convert import inventory as as_file
from ._convert import study as study_given
from ._convert import whole, words
from ._motion import Motion
from ._results import (
    AssessResult,
    CodeSpectrumResult,
    DropTestResult,
    FloorResult,
    FragilityResult,
    InventoryCheck,
    ObjectResult,
    RestrainResult,
    RiskResult,
    RockResult,
    RunResult,
    ShockResult,
    ShockSpectrumResult,
    StaticTestResult,
    SynthResult,
    ValidateResult,
)
from ._table import Table, _Column

if TYPE_CHECKING:
    from pathlib import Path

    from typing_extensions import Unpack

Progress: TypeAlias = Callable[[str, int, int], object]
Files: TypeAlias = "PathLike | Iterable[PathLike]"
Study: TypeAlias = "PathLike | Mapping[str, Any]"


def rock(
    block: Block,
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
) -> RockResult:
    """How an object responds to a motion of its floor.

    `restitution` in (0, 1] replaces Housner's ratio, `restitution_factor` multiplies it; `model` is
    "rigid" (default) or "linear", `accuracy` "fast", "standard" (default) or "tight". Without a motion give
    `initial_rotation_rad` or `initial_velocity_rad_s`. After the last sample the floor does not move, and
    the object is followed until it rests or lies; `duration_s` ends that, and the outcome may then be
    `unresolved`. `base="compliant"` follows the object on its cushions (`cg_rise_m`, `contacts`, `at_m`,
    `tangential_…` apply to it alone); `sliding` follows an object that slides or rolls. With
    `history=True` the result has arrays over time.
    """
    _check_block(block)
    of_kind("walls", walls, Walls, "a freestand.Walls")
    of_kind("sliding", sliding, Sliding, "a freestand.Sliding")
    of_kind("history", history, (bool, np.bool_), "True or False")
    history = bool(history)
    record = None if motion is None else _record("motion", motion)
    upward = None if vertical is None else _record("vertical", vertical)
    values: dict[str, Any] = {}
    for name, value in (
        ("restitution", restitution), ("restitution_factor", restitution_factor), ("model", model),
        ("accuracy", accuracy), ("base", base), ("initial_rotation_rad", initial_rotation_rad),
        ("initial_velocity_rad_s", initial_velocity_rad_s), ("duration_s", duration_s), ("friction", friction),
        ("gravity_m_s2", gravity_m_s2), ("cg_rise_m", cg_rise_m), ("contacts", contacts), ("at_m", at_m),
        ("tangential_stiffness_n_m", tangential_stiffness_n_m), ("tangential_ratio", tangential_ratio),
    ):  # fmt: skip
        if value is not None:
            values[name] = value
    if base != "compliant":
        for name in _COMPLIANT:
            if name in values:
                raise bad(f"{name} applies only to a compliant base", 'add base="compliant", or leave it out')
    if walls is not None:
        values |= walls._given()
    found = None if sliding is None else _freestand.rock(block._body, record, upward, values | _slid(sliding, walls), history)
    if found is None:
        # An object that does not slide, or stands on braked casters that hold.
        found = _freestand.rock(block._body, record, upward, values, history)
    else:
        for name in _OF_ROCKING:
            if name in values:
                raise bad(f"{name} applies only to an object that rocks, and this one slides or rolls", "leave it out")
    assert found is not None
    warn(found[1])
    return RockResult(*found, motion)


_COMPLIANT = ("cg_rise_m", "contacts", "at_m", "tangential_stiffness_n_m", "tangential_ratio")
_OF_ROCKING = ("restitution", "restitution_factor", "model", "base", "initial_rotation_rad", "initial_velocity_rad_s")


def _check_block(block: Block) -> None:
    if not isinstance(block, Block):
        raise bad(f"block must be a freestand.Block, not {type(block).__name__}", "make one: Block(height_m, thickness_m)")


def _slid(sliding: Sliding, walls: Walls | None) -> dict[str, Any]:
    if walls is not None:
        raise bad("walls apply only to an object that rocks", "give the room as clearance_left_m and clearance_right_m")
    return sliding._given() | {"sliding": True}


def _record(name: str, motion: Motion) -> _freestand.Record:
    if not isinstance(motion, Motion):
        kind = type(motion).__name__
        raise bad(f"{name} must be a freestand.Motion, not {kind}", "make one: Motion(accel_m_s2, dt_s), or read_motion(path)")
    return motion._record


def _motions(motions: Motion | Iterable[Motion], name: str = "motions") -> list[Motion]:
    if not isinstance(motions, Motion | Iterable):
        _record(name, motions)
    found = [motions] if isinstance(motions, Motion) else list(motions)
    for motion in found:
        _record(name, motion)
    if not found:
        raise bad(f"there is no motion in {name}", "give at least one")
    return found


#: More than the cores of any machine today. Each thread takes memory, and a million threads take
#: all of it.
MAX_THREADS = 1024


def _threads(threads: Any) -> int | None:
    return whole("threads", threads, 1, MAX_THREADS)


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

    Rows in the order motion, height, thickness: all combinations of `heights_m` and `thicknesses_m` [m],
    or with `pairs=True` one object for each (height, thickness) pair. The shock needs `mass_kg` and
    `stiffness_n_m` (of everything under one edge) or a cushion. `threads`: one per core by default; the
    result does not depend on it.
    """
    named = _motions(motions)
    of_kind("walls", walls, Walls, "a freestand.Walls")
    of_kind("sliding", sliding, Sliding, "a freestand.Sliding")
    upward = [] if vertical is None else _motions(vertical, "vertical")
    if upward and len(upward) != len(named):
        raise bad(f"vertical has {len(upward)} motions, motions {len(named)}", "give one for each, in the same order")
    values = given(
        heights_m=data("heights_m", heights_m), thicknesses_m=data("thicknesses_m", thicknesses_m), mass_kg=mass_kg,
        pairs=pairs or None, restitution=restitution, restitution_factor=restitution_factor, model=model,
        accuracy=accuracy, sensitivity=sensitivity or None,
    )  # fmt: skip
    values |= cushion_given(cushion, stiffness_n_m, None)
    if walls is not None:
        values |= walls._given()
    if sliding is not None:
        values |= _slid(sliding, None)
    verticals: Sequence[Motion | None] = upward or [None] * len(named)
    records = [
        (motion.name, motion._record, None if second is None else _record("vertical", second))
        for motion, second in zip(_unique(named), verticals)
    ]
    columns, warnings, timing = _freestand.spectrum(records, values, _threads(threads))
    if pairs:
        dims: tuple[str, ...] = ("motion", "object")
        shape: tuple[int, ...] = (len(named), len(values["heights_m"]) // 8)
    else:
        dims = ("motion", "height_m", "thickness_m")
        shape = (len(named), len(values["heights_m"]) // 8, len(values["thicknesses_m"]) // 8)
    table = Table({name: _Column(kind, held, texts) for name, kind, held, texts in columns}, dims, shape)
    table.warnings = warnings
    table.timing = {"solve_s": timing[0], "block_steps": timing[1]}
    warn(warnings)
    return table


def _unique(motions: list[Motion]) -> list[Motion]:
    """The motions, whose names must differ."""
    names = [motion.name for motion in motions]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise bad(f"two motions are called {twice}", "give them names: Motion(accel_m_s2, dt_s, name)")
    return motions


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
    """The shock of one landing, from one of `cg_rise_m`, `uplift_m`, `rotation_rad`, `angular_velocity_rad_s`.

    The cushion is that of the block, or `stiffness_n_m` or `cushion` given here (a drop test or a
    cushion file is of one pad, and needs `pads_per_edge`). `scenario`: rocking (default), halted,
    overturn-floor, overturn-obstacle. With `tolerance_g` the result has a verdict.
    """
    _check_block(block)
    values = given(
        cg_rise_m=cg_rise_m, uplift_m=uplift_m, rotation_rad=rotation_rad,
        angular_velocity_rad_s=angular_velocity_rad_s, drop_acceleration_g=drop_acceleration_g,
        contact_stiffness_n_m=contact_stiffness_n_m, scenario=scenario, model=model, gap_m=gap_m,
        obstacle_height_m=obstacle_height_m, at_m=at_m, friction=friction, gravity_m_s2=gravity_m_s2,
        tolerance_g=tolerance_g, tolerance_duration_s=tolerance_duration_s,
        tolerance_velocity_change_m_s=tolerance_velocity_change_m_s, tolerance_edge_lift_m=tolerance_edge_lift_m,
        component_frequency_hz=component_frequency_hz, component_capacity_g=component_capacity_g,
        damage_boundary=damage_boundary,
    )  # fmt: skip
    values |= cushion_given(cushion, stiffness_n_m, pads_per_edge)
    result = ShockResult._of(_freestand.shock(block._body, values))
    warn(result.warnings)
    return result


def _files(files: Files) -> list[str]:
    found = paths_text("files", files)
    if not found:
        raise bad("files names no file", "give the file of at least one test")
    return found


def drop_test(
    files: Files,
    *,
    mass_kg: float | None = None,
    height_m: float | None = None,
    impact_velocity_m_s: float | None = None,
    velocity_error_ratio: float | None = None,
    law: str | None = None,
    pad_thickness_m: float | None = None,
    impactor: str | None = None,
    sphere_radius_m: float | None = None,
    boundary: str | None = None,
    corner_hz: float | None = None,
    gravity_m_s2: float | None = None,
    inverted: bool = False,
    unit: str | None = None,
    dt_s: float | None = None,
    component: str | None = None,
    seed: int | None = None,
) -> DropTestResult:
    """The stiffness of a pad with its 95 % interval, from accelerations of a mass dropped on it.

    Each file has columns of time and acceleration with their units. `mass_kg`, and `height_m` or
    `impact_velocity_m_s`, replace what the files state.
    """
    values = given(
        files=_files(files), mass_kg=mass_kg, height_m=height_m, impact_velocity_m_s=impact_velocity_m_s,
        velocity_error_ratio=velocity_error_ratio, law=law, pad_thickness_m=pad_thickness_m, impactor=impactor,
        sphere_radius_m=sphere_radius_m, boundary=boundary, corner_hz=corner_hz, gravity_m_s2=gravity_m_s2,
        inverted=inverted or None, unit=unit, dt_s=dt_s, component=component, seed=seed,
    )  # fmt: skip
    text, toml, loops = _freestand.drop_test(values)
    result = DropTestResult(json.loads(text), toml, loops)
    warn(result.warnings)
    return result


def static_test(
    files: Files,
    *,
    load_n: float | None = None,
    machine_stiffness_n_m: float | None = None,
    cut_toe: bool | None = None,
    impactor: str | None = None,
    boundary: str | None = None,
    dynamic_stiffness_n_m: float | None = None,
) -> StaticTestResult:
    """The static stiffness of a pad, from files with columns of force and displacement."""
    values = given(
        files=_files(files), load_n=load_n, machine_stiffness_n_m=machine_stiffness_n_m, cut_toe=cut_toe,
        impactor=impactor, boundary=boundary, dynamic_stiffness_n_m=dynamic_stiffness_n_m,
    )  # fmt: skip
    result = StaticTestResult._of(_freestand.static_test(values))
    warn(result.warnings)
    return result


def shock_spectrum(
    accel: Motion | Numbers,
    dt_s: float | None = None,
    frequencies_hz: Numbers | None = None,
    *,
    damping_ratio: float | None = None,
    q: float | None = None,
    kind: str | None = None,
    peak: str | None = None,
    upsample: bool | None = None,
) -> ShockSpectrumResult:
    """Shock response spectrum (ISO 18431-4) of a motion, or of accelerations [m/s²] at steps of `dt_s` [s].

    `kind`: absolute-acceleration (default), relative-displacement, pseudo-velocity; `peak`: maximax
    (default), positive, negative, primary, residual; `damping_ratio` 5 % by default, or `q`.
    """
    if isinstance(accel, Motion):
        motion = accel
        if dt_s is not None:
            raise bad("dt_s is that of the motion", "leave it out")
    elif dt_s is None:
        raise bad("an array needs its time step", "give dt_s in seconds")
    else:
        motion = Motion(accel, dt_s)
    values = given(
        frequencies_hz=data("frequencies_hz", frequencies_hz), damping_ratio=damping_ratio, q=q, kind=kind, peak=peak,
        upsample=upsample,
    )  # fmt: skip
    result = ShockSpectrumResult._of(_freestand.shock_spectrum(motion._record, values))
    warn(result.warnings)
    return result


class TargetArguments(TypedDict, total=False):
    """The target spectrum of a code, a place or a file: docs/codes.md has the values that each code needs."""

    #: as1170.4 (default), eurocode8, asce7, nzs1170.5.
    code: str | None
    edition: int | str | None
    site: str | None
    #: Brings its code and its hazard.
    place: str | None
    city: str | None
    hazard_factor: float | None
    return_period_years: float | None
    fault_distance_m: float | None
    spectrum_type: int | None
    ground_acceleration_g: float | None
    importance_factor: float | None
    soil_factor: float | None
    corner_periods_s: Sequence[float] | None
    sds_g: float | None
    sd1_g: float | None
    ss_g: float | None
    s1_g: float | None
    fa: float | None
    fv: float | None
    long_period_s: float | None
    #: A file in place of a code.
    spectrum: PathLike | None
    interpolation: str | None
    beyond: str | None


def _target(arguments: Mapping[str, Any]) -> dict[str, Any] | None:
    known = TargetArguments.__annotations__
    unknown = next((name for name in arguments if name not in known), None)
    if unknown is not None:
        raise TypeError(f"unexpected argument {unknown!r}; those of a target are {', '.join(known)}")
    return words(**arguments)


def code_spectrum(
    periods_s: Numbers | None = None,
    *,
    parts: bool = False,
    building_height_m: float | None = None,
    building_period_s: float | None = None,
    **target: Unpack[TargetArguments],
) -> CodeSpectrumResult:
    """The elastic response spectrum of a design code for 5 % damping: `periods_s`, `sa_g`.

    `code` is as1170.4 (default), eurocode8, asce7 or nzs1170.5, with `edition, site, place, city,
    hazard_factor, return_period_years` and further values of the codes: `fault_distance_m, spectrum_type,
    ground_acceleration_g, importance_factor, soil_factor, corner_periods_s, sds_g, sd1_g, ss_g, s1_g, fa, fv,
    long_period_s`, and `spectrum` (a file), `interpolation`, `beyond`: docs/codes.md. With `parts=True` also
    the accelerations of rigid parts.
    """
    values = given(
        words=_target(target), periods_s=data("periods_s", periods_s), parts=parts or None, building_height_m=building_height_m,
        building_period_s=building_period_s,
    )  # fmt: skip
    result = CodeSpectrumResult._of(_freestand.code_spectrum(values))
    warn(result.warnings)
    return result


def synth(
    count: int | None = None,
    *,
    seed: int | None = None,
    time_step_s: float | None = None,
    shaking_s: float | None = None,
    envelope_s: float | None = None,
    match_pga: bool = False,
    threads: int | None = None,
    **target: Unpack[TargetArguments],
) -> SynthResult:
    """Synthetic motions that fit the spectrum of a code (see `code_spectrum`): `records` are Motions."""
    values = given(
        words=_target(target), count=count, seed=seed, time_step_s=time_step_s, shaking_s=shaking_s, envelope_s=envelope_s,
        match_pga=match_pga or None,
    )  # fmt: skip
    text, records = _freestand.synth(values, _threads(threads))
    result = SynthResult(json.loads(text), [Motion._of(record) for record in records])
    warn(result.warnings)
    return result


def floor(
    motions: Motion | Iterable[Motion],
    *,
    levels: Numbers | None = None,
    every_floor: bool = False,
    storeys: int | None = None,
    storey_height_m: float | None = None,
    building_height_m: float | None = None,
    period_s: float | None = None,
    frame: str | None = None,
    period_code: str | None = None,
    damping_ratio: float | None = None,
    shear_flexure: float | None = None,
    modes: int | None = None,
    storey_table: PathLike | None = None,
    mode_table: PathLike | None = None,
    tail_s: float | None = None,
    upsample: int | None = None,
    threads: int | None = None,
    **target: Unpack[TargetArguments],
) -> FloorResult:
    """How the floors of a building move: `floors[i][j]` is the motion of level j under motion i.

    `levels` are shares of the height, 0 to 1 (default 0.5 and 1); `every_floor=True` takes all floors. A
    code (see `code_spectrum`) adds its accelerations of rigid parts for comparison.
    """
    building = words(
        storeys=storeys, storey_height_m=storey_height_m, building_height_m=building_height_m, period_s=period_s,
        frame=frame, period_code=period_code, damping_ratio=damping_ratio, shear_flexure=shear_flexure, modes=modes,
        storey_table=storey_table, mode_table=mode_table,
    )  # fmt: skip
    values = given(
        building=building, target=_target(target), levels=data("levels", levels), every_floor=every_floor or None, tail_s=tail_s,
        upsample=upsample,
    )  # fmt: skip
    records = [motion._record for motion in _motions(motions)]
    text, floors = _freestand.floor(records, values, _threads(threads))
    result = FloorResult(json.loads(text), [[Motion._of(record) for record in one] for one in floors])
    warn(result.warnings)
    return result


def check_object(
    height_m: float,
    thickness_m: float,
    *,
    width_m: float | None = None,
    shape: str | None = None,
    cg_height_m: float | None = None,
    mass_kg: float | None = None,
    stiffness_n_m: float | None = None,
    cushion: str | None = None,
    tolerance_g: float | None = None,
    tolerance_duration_s: float | None = None,
    place: str | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    pga_g: float | None = None,
    study: Study | None = None,
    motions: Motion | Iterable[Motion] | None = None,
    scales: Numbers | None = None,
    floor: str | int | None = None,
    level_ratio: float | None = None,
    storeys: int | None = None,
    storey_height_m: float | None = None,
    friction: float | tuple[float, float] | None = None,
    wall_gap_m: float | None = None,
    neighbour_gap_m: float | None = None,
    wall_height_m: float | None = None,
    wall_stiffness_n_m: float | None = None,
    wall_restitution: float | None = None,
    casters: str | None = None,
    rolling_resistance: float | None = None,
    clearance_m: float | None = None,
    upper_height_m: float | None = None,
    upper_thickness_m: float | None = None,
    upper_mass_kg: float | None = None,
    worlds: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
) -> ObjectResult:
    """Whether an earthquake rocks one object and whether it falls over: `answer` is one sentence.

    Name the earthquake in one of four ways: `place`, `pga_g` (of the ground), `study` (a path, TOML text or
    a dictionary), or `motions` of its floor. With a study, `place` (with `site` and `return_period_years`)
    replaces the hazard of the study and keeps its building. A study that states no hazard has that of the
    built-in study, Melbourne: `place_is_assumed` is then true, and `answer` names the place. An empty one is refused. `cushion` is an entry of the cushion
    library. `shape` is "box" or "cylinder", of which `thickness_m` is the diameter; a cylinder is never said to
    stand. `friction` is one value or the two ends of a range. `wall_gap_m` is behind the object and
    `neighbour_gap_m` on both sides of it; 0 means that they touch. `casters` is "no", "free" or "braked".
    `upper_…` describe the object on top of this one.
    """
    named = [] if motions is None else _motions(motions)
    values = given(
        height_m=height_m, thickness_m=thickness_m, width_m=width_m, shape=shape, cg_height_m=cg_height_m,
        mass_kg=mass_kg, stiffness_n_m=stiffness_n_m, cushion=cushion, tolerance_g=tolerance_g,
        tolerance_duration_s=tolerance_duration_s,
        hazard=words(place=place, site=site, return_period_years=return_period_years), pga_g=pga_g,
        scales=data("scales", scales), floor=None if floor is None else str(floor), level_ratio=level_ratio,
        storeys=storeys, storey_height_m=storey_height_m, friction=friction, wall_gap_m=wall_gap_m,
        neighbour_gap_m=neighbour_gap_m, wall_height_m=wall_height_m, wall_stiffness_n_m=wall_stiffness_n_m,
        wall_restitution=wall_restitution, casters=casters, rolling_resistance=rolling_resistance,
        clearance_m=clearance_m, upper_height_m=upper_height_m, upper_thickness_m=upper_thickness_m,
        upper_mass_kg=upper_mass_kg, worlds=worlds, seed=seed,
    )  # fmt: skip
    records = [motion._record for motion in named]
    result = ObjectResult._of(_freestand.check_object(records, values | study_given(study), _threads(threads)))
    warn(result.warnings)
    return result


def restrain(
    mass_kg: float,
    height_m: float,
    thickness_m: float,
    *,
    width_m: float | None = None,
    cg_height_m: float | None = None,
    study: Study | None = None,
    floor_acceleration_g: float | None = None,
    floor: str | int | None = None,
    level_ratio: float | None = None,
    storeys: int | None = None,
    storey_height_m: float | None = None,
    importance_ratio: float | None = None,
    amplification_ratio: float | None = None,
    response_ratio: float | None = None,
    resonance_ratio: float | None = None,
    strength_ratio: float | None = None,
    building_ductility_ratio: float | None = None,
    anchors_per_edge: int | None = None,
    compare: bool = False,
    **target: Unpack[TargetArguments],
) -> RestrainResult:
    """The force that the code asks of a restraint, and what it asks of the anchors.

    The hazard is one of `place`, `code` with its values (see `code_spectrum`), `study` or
    `floor_acceleration_g`. `save(path)` writes a sheet to print.
    """
    values = given(
        mass_kg=mass_kg, height_m=height_m, thickness_m=thickness_m, width_m=width_m, cg_height_m=cg_height_m,
        hazard=_target(target),
        floor_acceleration_g=floor_acceleration_g, floor=None if floor is None else str(floor),
        level_ratio=level_ratio, storeys=storeys, storey_height_m=storey_height_m, importance_ratio=importance_ratio,
        amplification_ratio=amplification_ratio, response_ratio=response_ratio, resonance_ratio=resonance_ratio,
        strength_ratio=strength_ratio, building_ductility_ratio=building_ductility_ratio,
        anchors_per_edge=anchors_per_edge, compare=compare or None,
    )  # fmt: skip
    text, sheet = _freestand.restrain(values | study_given(study))
    result = RestrainResult(json.loads(text), sheet)
    warn(result.warnings)
    return result


def check_inventory(
    inventory: Any,
    *,
    sheet: str | None = None,
    columns: PathLike | None = None,
    storeys: int | None = None,
    strict: bool = False,
    study: Study | None = None,
    library: PathLike | None = None,
    cushion_library: PathLike | None = None,
    marked_copy: PathLike | None = None,
) -> InventoryCheck:
    """How a list of objects is understood, with all its problems.

    A path (CSV, XLSX), or a table of pandas, polars or pyarrow with the headings of a file. `marked_copy`
    is a file (XLSX) to write: the list with a note at each cell that has a problem.
    """
    values = given(
        sheet=sheet, columns=columns, storeys=storeys, strict=strict or None, library=library,
        cushion_library=cushion_library, marked_copy=marked_copy,
    )  # fmt: skip
    with as_file(inventory) as listed:
        if listed.path is None:
            raise bad("there is no inventory", "give a path or a table")
        result = InventoryCheck._of(listed.named(_freestand.check_inventory(listed.path, values | study_given(study))))
    warn(result.warnings)
    return result


def _folder(out: PathLike | None) -> tuple[Path, Path | None]:
    """The folder of the outputs, and one to remove with the result: without `out` it lives as long."""
    import tempfile
    from pathlib import Path

    if out is not None:
        return Path(path_text("out", out)), None
    folder = Path(tempfile.mkdtemp(prefix="freestand-"))
    return folder / "out", folder


def _check_progress(progress: Progress | None) -> None:
    if progress is not None and not callable(progress):
        kind = type(progress).__name__
        raise bad(f"progress must be a function of (stage, done, total), not {kind}", "give one, such as print")


def assess(
    study: Study | None = None,
    inventory: Any = None,
    *,
    out: PathLike | None = None,
    seed: int | None = None,
    threads: int | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    place: str | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    sheet: str | None = None,
    columns: PathLike | None = None,
    storeys: int | None = None,
    strict: bool = False,
    assess_anchored: bool = False,
    library: PathLike | None = None,
    cushion_library: PathLike | None = None,
    parquet: bool = False,
    outcomes: bool = False,
    force: bool = False,
) -> AssessResult:
    """Which objects of an inventory must be restrained.

    `study`: a path, TOML text or a dictionary; by default the built-in one. `inventory`: a path, or a
    table of pandas, polars or pyarrow with the headings of a file; by default that of the study. Without
    `out` the files are kept until `save(folder)`. `progress(stage, done, total)` is called as the work
    goes on. Ctrl-C stops it; with `out` and `resume=True` it goes on later.
    """
    values = given(
        seed=seed, hazard=words(place=place, site=site, return_period_years=return_period_years), sheet=sheet,
        columns=columns, storeys=storeys, strict=strict or None, assess_anchored=assess_anchored or None,
        library=library, cushion_library=cushion_library, parquet=parquet or None, outcomes=outcomes or None,
        resume=resume or None, force=force or None,
    )  # fmt: skip
    source = study_given(study)
    _check_progress(progress)
    folder, own = _folder(out)
    with removed_on_failure(own), as_file(inventory) as listed:
        text = _freestand.assess(listed.path, folder, values | source, _threads(threads), progress)
        result = AssessResult._of(listed.named(text))
    result._in(folder, own)
    warn(result.warnings)
    return result


def run(
    study: Study | None = None,
    out: PathLike | None = None,
    *,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    place: str | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    parquet: bool = False,
    force: bool = False,
) -> RunResult:
    """A whole study: motions, building, spectra of a grid of objects, figures and report.

    `study`: a path, TOML text or a dictionary; by default the built-in one. `rows` is srs.csv as a table.
    With `parquet=True` the tables are written as Parquet too.
    """
    values = given(
        seed=seed, hazard=words(place=place, site=site, return_period_years=return_period_years),
        parquet=parquet or None, force=force or None,
    )  # fmt: skip
    source = study_given(study)
    _check_progress(progress)
    folder, own = _folder(out)
    with removed_on_failure(own):
        result = RunResult._of(_freestand.run(folder, values | source, _threads(threads), progress))
    result._in(folder, own)
    warn(result.warnings)
    return result


def fragility(
    outcomes: Any,
    *,
    at: str | None = None,
    fit: str | None = None,
    tolerance_g: float | None = None,
    ceiling_g: float | None = None,
    bootstrap: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
) -> FragilityResult:
    """Fragilities of objects: the probabilities of limit states against the intensity of the motion.

    `outcomes` is a path (CSV; docs/risk.md has its columns) or a table of pandas, polars or pyarrow with its headings:
    one row for each object and motion. `outcomes.csv` of an assessment is another table. `at`: "ground" or "floor", where a spectral acceleration is taken; `fit`: "ordered" (default) or
    "separate"; `tolerance_g` with `ceiling_g`: fit `exceeds` to the shocks; `bootstrap`: samples of motions for the 95 %
    intervals, 0 for none.
    """
    values = given(
        at=at, fit=fit, tolerance_g=tolerance_g, ceiling_g=ceiling_g, bootstrap=bootstrap, seed=seed,
    )  # fmt: skip
    with as_file(outcomes, "outcomes") as runs:
        text, seen = _freestand.fragility(values | given(outcomes=runs.path), _threads(threads))
    result = FragilityResult(json.loads(runs.named(text)), seen)
    warn(result.warnings)
    return result


def risk(
    fragility: PathLike | None = None,
    *,
    outcomes: Any = None,
    hazard: PathLike | None = None,
    hazard_power: str | None = None,
    hazard_code: str | None = None,
    hazard_im: str | None = None,
    site: str | None = None,
    hazard_factor: float | None = None,
    fault_distance_m: float | None = None,
    site_deg: tuple[float, float] | None = None,
    at: str | None = None,
    fit: str | None = None,
    bootstrap: int | None = None,
    seed: int | None = None,
    inventory: Any = None,
    options: Any = None,
    budget: str | None = None,
    horizon_years: float | None = None,
    discount_ratio: float | None = None,
    accepted_rate: float | None = None,
    years: float | None = None,
    threads: int | None = None,
) -> RiskResult:
    """How often objects fail per year, what that costs, and which options are worth their money.

    The fragilities are `fragility` (the file fragility.csv) or are fitted to `outcomes`. The hazard is one of
    `hazard` (a file), `hazard_power` ("k0=1e-4 /yr, k=2.5, reference=1 m/s") and `hazard_code` (with `site` and
    `hazard_factor`); `hazard_im`, such as "pgv", is that of the last two, and by default that of the curves.
    `inventory` holds costs and accepted rates,
    `options` what can be bought, `budget` is an amount such as "20000 AUD". Tables are accepted as in `fragility`.
    """
    values = given(
        fragility=fragility, hazard=hazard, hazard_power=hazard_power, hazard_code=hazard_code, hazard_im=hazard_im,
        site=site, hazard_factor=hazard_factor, fault_distance_m=fault_distance_m, site_deg=site_deg, at=at, fit=fit,
        bootstrap=bootstrap, seed=seed, budget=budget, horizon_years=horizon_years, discount_ratio=discount_ratio,
        accepted_rate=accepted_rate, years=years,
    )  # fmt: skip
    with (
        as_file(outcomes, "outcomes") as runs,
        as_file(inventory) as costs,
        as_file(options, "options") as bought,
    ):
        files = given(outcomes=runs.path, inventory=costs.path, options=bought.path)
        text = _freestand.risk(values | files, _threads(threads))
    result = RiskResult._of(bought.named(costs.named(runs.named(text))))
    warn(result.warnings)
    return result


def validate(*, threads: int | None = None) -> ValidateResult:
    """Recalculates Table I of the paper and every closed form that is built in."""
    return ValidateResult._of(_freestand.validate(_threads(threads)))
