"""The requests: each is a command of freestand as a function."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from . import _freestand
from ._block import Files
from ._body import Body
from ._convert import Numbers, PathLike, bad, flag, given, of_kind, path_text, removed_on_failure, sizes_m, threads_given
from ._convert import inventory as as_file
from ._convert import study_file, warn
from ._ground import TargetArguments, target_words
from ._motion import Motion, several
from ._results import (
    AssessResult,
    FragilityResult,
    InventoryCheck,
    ObjectResult,
    RestrainListResult,
    RestrainResult,
    RiskResult,
    RunResult,
    ValidateResult,
)

if TYPE_CHECKING:
    from pathlib import Path

    from typing_extensions import Unpack

Progress: TypeAlias = Callable[[str, int, int], object]
Study: TypeAlias = "PathLike | Mapping[str, Any]"


def check_object(
    height_m: float | None = None,
    thickness_m: float | None = None,
    *,
    width_m: float | None = None,
    shape: str | None = None,
    diameter_m: float | None = None,
    feet: str | None = None,
    scan: PathLike | None = None,
    scan_unit: str | None = None,
    scan_base: str | None = None,
    scan_error_m: float | None = None,
    scan_hull: bool | None = None,
    stand_on: int | None = None,
    body: Body | None = None,
    cg_height_m: float | None = None,
    mass_kg: float | None = None,
    stiffness_n_m: float | None = None,
    cushion: str | None = None,
    tolerance_g: float | None = None,
    tolerance_duration_s: float | None = None,
    place: str | None = None,
    spectrum: PathLike | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    fault_distance_m: float | None = None,
    fault_magnitude: float | None = None,
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

    Name the earthquake in one of four ways: `place`, `pga_g`, `study`, or `motions`. With a study, `place`
    (with `site` and `return_period_years`) replaces the hazard of the study and keeps its building. A study
    that states no hazard has that of the built-in study, Melbourne: `place_is_assumed` is then true, and `answer`
    names the place. An empty one is refused.

    Parameters
    ----------
    height_m, thickness_m : float
        Size of the object in the direction in which it rocks [m].
    width_m, cg_height_m, mass_kg : float, optional
        Size across the thickness [m], height of the centre of gravity [m], mass [kg].
    shape : str, optional
        "box", "cylinder" or "polygon:N".
    diameter_m : float, optional
        Diameter of a cylinder, or of the circle through the corners of a polygon, in place of `thickness_m` [m].
    feet : str, optional
        Points on which it stands, such as "-0.2 m, -0.1 m; 0.2 m, -0.1 m; 0 m, 0.2 m".
    scan, scan_unit, scan_base, scan_error_m, scan_hull, stand_on : optional
        A scan in place of sizes, as in `Body.from_mesh`.
    body : Body, optional
        In place of all these.
    stiffness_n_m : float, optional
        Stiffness of everything under one edge [N/m].
    cushion : str, optional
        An entry of the cushion library, in place of `stiffness_n_m`.
    tolerance_g, tolerance_duration_s : float, optional
        Shock that it withstands [g], and the duration of the pulse [s].
    place, site : str, optional
        A place with the hazard of its code, and the class of its site.
    spectrum : path, optional
        A spectrum to use instead: a table, or a file of OpenQuake, USGS, EFEHR, AFAD or GEM, in which `place` is the site and
        `return_period_years` chooses the spectrum.
    return_period_years : float, optional
        Return period of the hazard [years].
    fault_distance_m, fault_magnitude : float, optional
        Distance to the fault of the earthquake [m], and its magnitude: a share of the worlds then has velocity pulses.
    pga_g : float, optional
        Peak acceleration of the ground [g].
    study : path, str or dict, optional
        A study: its path, its TOML text, or a dictionary of its tables.
    motions : Motion or iterable of Motion, optional
        Motions of the floor under the object.
    scales : array_like, optional
        Factors by which `motions` are multiplied, one answer for each.
    floor, level_ratio : optional
        Where it stands: the name or number of a floor, or the height divided by that of the building.
    storeys, storey_height_m : optional
        The building: number of storeys and height of a storey [m].
    friction : float or tuple of float, optional
        Coefficient of friction: one value, or the two ends of a range.
    wall_gap_m, neighbour_gap_m : float, optional
        Gap behind the object, and on both sides of it [m]; 0 means that they touch.
    wall_height_m, wall_stiffness_n_m, wall_restitution : float, optional
        Of these walls.
    casters : str, optional
        "no", "free" or "braked".
    rolling_resistance, clearance_m : float, optional
        Of an object on casters: its rolling resistance, and the room beside it [m].
    upper_height_m, upper_thickness_m, upper_mass_kg : float, optional
        The object on top of this one.
    worlds, seed, threads : int, optional
        Number of draws of all that is uncertain, seed of the random numbers, number of threads.

    Returns
    -------
    ObjectResult
        `answer`, `p_overturn` with its interval, `floor_acceleration_g` and more.

    Examples
    --------
    >>> fs.check_object(1.8, 0.5, motions=motion.scale(3.5)).motions_lifted
    1
    """
    lengths = given(height_m=height_m, thickness_m=thickness_m, width_m=width_m, cg_height_m=cg_height_m, upper_height_m=upper_height_m)
    sizes_m(**lengths)
    of_kind("body", body, Body, "a freestand.Body")
    asked = given(
        height_m=height_m, thickness_m=thickness_m, width_m=width_m, shape=shape, cg_height_m=cg_height_m,
        mass_kg=mass_kg, stiffness_n_m=stiffness_n_m, cushion=cushion, tolerance_g=tolerance_g,
        tolerance_duration_s=tolerance_duration_s, place=place, site=site, return_period_years=return_period_years,
        fault_distance_m=fault_distance_m, fault_magnitude=fault_magnitude, pga_g=pga_g, scales=scales, floor=floor, level_ratio=level_ratio, storeys=storeys,
        storey_height_m=storey_height_m, friction=friction, wall_gap_m=wall_gap_m, neighbour_gap_m=neighbour_gap_m,
        wall_height_m=wall_height_m, wall_stiffness_n_m=wall_stiffness_n_m, wall_restitution=wall_restitution,
        casters=casters, rolling_resistance=rolling_resistance, clearance_m=clearance_m,
        upper_height_m=upper_height_m, upper_thickness_m=upper_thickness_m, upper_mass_kg=upper_mass_kg,
        worlds=worlds, seed=seed, units="si", diameter_m=diameter_m, feet=feet, scan_unit=scan_unit, scan_base=scan_base,
        scan_error_m=scan_error_m, scan_hull=flag("scan_hull", scan_hull), stand_on=stand_on,
    )  # fmt: skip
    files: Files = {"spectrum": (spectrum, None)}
    files.update(study_file(study))
    if scan is not None:
        files["scan"] = (scan, None)
    if body is not None:
        values, own = body._asked()
        asked |= values
        files |= own
    records = [motion._record for motion in ([] if motions is None else several(motions))]
    result = ObjectResult._of(_freestand.check_object(records, asked, files, threads_given(threads)))
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
    component: str | None = None,
    anchor_inset_m: float | None = None,
    pivot: str | None = None,
    anchor: str | None = None,
    anchor_capacity_n: float | None = None,
    anchor_shear_capacity_n: float | None = None,
    anchors_per_edge: int | None = None,
    compare: bool = False,
    allow_recalled: bool = False,
    **target: Unpack[TargetArguments],
) -> RestrainResult:
    """The force that the code asks of a restraint, and what it asks of the anchors.

    The hazard is one of `place`, `code` with its values, `study` and `floor_acceleration_g`.

    Parameters
    ----------
    mass_kg, height_m, thickness_m : float
        The object [kg, m].
    width_m, cg_height_m : float, optional
        Size across the thickness and height of the centre of gravity [m].
    study : path, str or dict, optional
        A study, whose hazard and building are used.
    floor_acceleration_g : float, optional
        Acceleration of the floor [g], in place of a code.
    floor, level_ratio : optional
        Where it stands: the name or number of a floor, or the height divided by that of the building.
    storeys, storey_height_m : optional
        The building: number of storeys and height of a storey [m].
    importance_ratio, amplification_ratio, response_ratio, resonance_ratio, strength_ratio, building_ductility_ratio : float, optional
        Factors of the clause, in place of its usual values: docs/restraint.md.
    component : str, optional
        What the object is in the tables of ASCE 7, such as "generator".
    anchor_inset_m : float, optional
        Distance of the anchors from the edge that they hold down [m].
    pivot : {"edge", "feet"}, optional
        The line about which an object tips: the edge of its base, or feet that the anchors fix.
    anchor, anchor_capacity_n, anchor_shear_capacity_n : optional
        The name of the anchor that you have chosen, and its design capacities in tension and in shear [N].
    anchors_per_edge : int, optional
        Number of anchors that share the tension.
    compare : bool, default False
        Whether `others` has the forces by the other codes.
    allow_recalled : bool, default False
        Whether you have confirmed the values of `to_confirm`: without it a sheet that rests on one is a draft.
    **target
        The hazard of a code: `TargetArguments`, see `code_spectrum`.

    Returns
    -------
    RestrainResult
        `force_n`, `anchor_tension_n` and more; `to_confirm` lists what an engineer has to confirm before the sheet is signed,
        and `save(path)` writes that sheet to print.

    Examples
    --------
    >>> print(f"{fs.restrain(360, 1.8, 0.6, floor_acceleration_g=0.5).force_n:.0f}")
    1765
    """
    sizes_m(height_m=height_m, thickness_m=thickness_m, width_m=width_m, cg_height_m=cg_height_m)
    asked = given(
        mass_kg=mass_kg, height_m=height_m, thickness_m=thickness_m, width_m=width_m, cg_height_m=cg_height_m,
        **(target_words(target) or {}), floor_acceleration_g=floor_acceleration_g, floor=floor,
        level_ratio=level_ratio, storeys=storeys, storey_height_m=storey_height_m, importance_ratio=importance_ratio,
        amplification_ratio=amplification_ratio, response_ratio=response_ratio, resonance_ratio=resonance_ratio,
        strength_ratio=strength_ratio, building_ductility_ratio=building_ductility_ratio,
        component=component, anchor_inset_m=anchor_inset_m, pivot=pivot, anchor=anchor,
        anchor_capacity_n=anchor_capacity_n, anchor_shear_capacity_n=anchor_shear_capacity_n, anchors_per_edge=anchors_per_edge,
        compare=flag("compare", compare), allow_recalled=flag("allow_recalled", allow_recalled), units="si",
    )  # fmt: skip
    text, sheet = _freestand.restrain(asked, study_file(study))
    result = RestrainResult(json.loads(text), sheet)
    warn(result.warnings)
    return result


def restrain_list(
    inventory: Any,
    *,
    sheet: str | None = None,
    columns: PathLike | None = None,
    edits: Sequence[str] | None = None,
    study: Study | None = None,
    floor_acceleration_g: float | None = None,
    storeys: int | None = None,
    storey_height_m: float | None = None,
    importance_ratio: float | None = None,
    amplification_ratio: float | None = None,
    response_ratio: float | None = None,
    resonance_ratio: float | None = None,
    strength_ratio: float | None = None,
    building_ductility_ratio: float | None = None,
    component: str | None = None,
    anchor_inset_m: float | None = None,
    pivot: str | None = None,
    anchor: str | None = None,
    anchor_capacity_n: float | None = None,
    anchor_shear_capacity_n: float | None = None,
    anchors_per_edge: int | None = None,
    allow_recalled: bool = False,
    **target: Unpack[TargetArguments],
) -> RestrainListResult:
    """The forces that the code asks of the restraints of all objects of a list.

    Masses, sizes and floors are those of the list; the hazard comes from one of `place`, `code` with its values,
    `study` and `floor_acceleration_g`.

    Parameters
    ----------
    inventory : path or table
        A file (CSV, XLSX), or a table of pandas, polars or pyarrow with the headings of a file.
    sheet, columns, edits : optional
        As in `check_inventory`.
    study : path, str or dict, optional
        A study, whose hazard and building are used.
    floor_acceleration_g : float, optional
        Acceleration of the floor [g], in place of a code.
    storeys, storey_height_m : optional
        The building: number of storeys and height of a storey [m].
    importance_ratio, amplification_ratio, response_ratio, resonance_ratio, strength_ratio, building_ductility_ratio : float, optional
        Factors of the clause, in place of its usual values: docs/restraint.md.
    component : str, optional
        What the objects are whose name is no row of the tables of ASCE 7.
    anchor_inset_m : float, optional
        Distance of the anchors from the edge that they hold down [m].
    pivot : {"edge", "feet"}, optional
        The line about which an object tips: the edge of its base, or feet that the anchors fix.
    anchor, anchor_capacity_n, anchor_shear_capacity_n : optional
        The name of the anchor that you have chosen, and its design capacities in tension and in shear [N].
    anchors_per_edge : int, optional
        Number of anchors that share the tension.
    allow_recalled : bool, default False
        Whether you have confirmed the values of `to_confirm`: without it a sheet that rests on one is a draft.
    **target
        The hazard of a code: `TargetArguments`, see `code_spectrum`.

    Returns
    -------
    RestrainListResult
        `table` with a row for each object, `to_confirm`, `problems`; `save(path)` writes a sheet to print for each object.

    Examples
    --------
    >>> found = fs.restrain_list("examples/hospital/inventory.csv", floor_acceleration_g=0.5)
    >>> found.objects == len(found.rows), found.held > 0
    (True, True)
    """
    asked = given(
        sheet=sheet, edit=edits, **(target_words(target) or {}), floor_acceleration_g=floor_acceleration_g,
        storeys=storeys, storey_height_m=storey_height_m, importance_ratio=importance_ratio,
        amplification_ratio=amplification_ratio, response_ratio=response_ratio, resonance_ratio=resonance_ratio,
        strength_ratio=strength_ratio, building_ductility_ratio=building_ductility_ratio,
        component=component, anchor_inset_m=anchor_inset_m, pivot=pivot, anchor=anchor,
        anchor_capacity_n=anchor_capacity_n, anchor_shear_capacity_n=anchor_shear_capacity_n, anchors_per_edge=anchors_per_edge,
        allow_recalled=flag("allow_recalled", allow_recalled), units="si",
    )  # fmt: skip
    with as_file(inventory) as listed:
        if listed.path is None:
            raise bad("there is no inventory", "give a path or a table")
        files = study_file(study) | {"list": (listed.path, None), "columns": (columns, None)}
        text, sheets = _freestand.restrain(asked, files)
        result = RestrainListResult(json.loads(listed.named(text)), sheets)
    warn(result.warnings)
    return result


def check_inventory(
    inventory: Any,
    *,
    sheet: str | None = None,
    columns: PathLike | None = None,
    edits: Sequence[str] | None = None,
    storeys: int | None = None,
    strict: bool = False,
    study: Study | None = None,
    library: PathLike | None = None,
    cushion_library: PathLike | None = None,
    marked_copy: PathLike | None = None,
) -> InventoryCheck:
    """How a list of objects is understood, with all its problems.

    Parameters
    ----------
    inventory : path or table
        A file (CSV, XLSX), or a table of pandas, polars or pyarrow with the headings of a file.
    sheet : str, optional
        Sheet of a workbook.
    columns : path, optional
        Mapping file (TOML) that says what columns, floors and numbers of the list mean.
    edits : sequence of str, optional
        Cells that are read as if they contained another text, such as ``["D7=900 mm"]``. The file is not changed.
    storeys : int, optional
        Number of storeys, to place floors by their numbers.
    strict : bool, default False
        Whether every doubt is an error.
    study : path, str or dict, optional
        A study, whose building and libraries are used.
    library, cushion_library : path, optional
        Your own libraries of tolerances and cushions (CSV).
    marked_copy : path, optional
        File (XLSX) to write: the list with a note at each cell that has a problem.

    Returns
    -------
    InventoryCheck
        `ok`, `objects`, `columns`, `problems`; `table` in SI units.

    Examples
    --------
    >>> found = fs.check_inventory("examples/hospital/inventory.csv")
    >>> found.counts["rows"], [problem["severity"] for problem in found.problems].count("error") == 0
    (28, False)
    """
    asked = given(sheet=sheet, edit=edits, storeys=storeys, strict=flag("strict", strict))
    marked = None if marked_copy is None else path_text("marked_copy", marked_copy)
    with as_file(inventory) as listed:
        if listed.path is None:
            raise bad("there is no inventory", "give a path or a table")
        files = study_file(study) | {
            "file": (listed.path, None), "columns": (columns, None), "library": (library, None),
            "cushion_library": (cushion_library, None),
        }  # fmt: skip
        result = InventoryCheck._of(listed.named(_freestand.check_inventory(asked, files, marked)))
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
    spectrum: PathLike | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    fault_distance_m: float | None = None,
    fault_magnitude: float | None = None,
    sheet: str | None = None,
    columns: PathLike | None = None,
    edits: Sequence[str] | None = None,
    storeys: int | None = None,
    strict: bool = False,
    assess_anchored: bool = False,
    library: PathLike | None = None,
    cushion_library: PathLike | None = None,
    parquet: bool = False,
    outcomes: bool = False,
    date: str | None = None,
    preparer: str | None = None,
    revision: str | None = None,
    since: PathLike | None = None,
    allow_recalled: bool = False,
    budget: str | None = None,
    restraints: PathLike | None = None,
    horizon_years: float | None = None,
    discount_ratio: float | None = None,
    force: bool = False,
) -> AssessResult:
    """Which objects of an inventory must be restrained.

    Ctrl-C stops it; with `out` and `resume=True` it goes on later.

    Parameters
    ----------
    study : path, str or dict, optional
        A study: its path, its TOML text, or a dictionary of its tables. By default the built-in one.
    inventory : path or table, optional
        A file, or a table of pandas, polars or pyarrow with the headings of a file; by default that of the study.
    out : path, optional
        Folder for the files; without it they are kept until `save(folder)`.
    seed, threads : int, optional
        Seed of the random numbers, number of threads; the result does not depend on the threads.
    resume : bool, default False
        Whether to continue an earlier run in `out`.
    progress : callable, optional
        Called with (stage, done, total) as the work goes on.
    place, site : str, optional
        A place with the hazard of its code, in place of that of the study, and the class of its site.
    spectrum : path, optional
        A spectrum to use instead: a table, or a file of OpenQuake, USGS, EFEHR, AFAD or GEM, in which `place` is the site and
        `return_period_years` chooses the spectrum.
    return_period_years : float, optional
        Return period of the hazard [years].
    fault_distance_m, fault_magnitude : float, optional
        Distance to the fault of the earthquake [m], and its magnitude: a share of the worlds then has velocity pulses.
    sheet, columns, edits, storeys, strict, library, cushion_library : optional
        As in `check_inventory`.
    assess_anchored : bool, default False
        Whether anchored objects are assessed as if they were free.
    parquet, outcomes : bool, default False
        Whether to write objects.parquet, and what happened to every object in every world.
    date, preparer, revision : str, optional
        What the report states at its head; without them there are lines to fill in.
    since : path, optional
        Folder of an earlier assessment: the result then has `since`, with what is new, gone, done or worse.
    allow_recalled : bool, default False
        Whether you have confirmed the values quoted from memory: without it the report and the work orders are drafts.
    budget : str, optional
        The most that restraints may cost, such as "20000 NZD": the result then has their `plan`, life safety first.
    restraints : path, optional
        Your own restraints (CSV); its entries replace built-in entries with the same id.
    horizon_years, discount_ratio : float, optional
        Years over which the savings of restraints count, and their discount per year; 50 and 0.03 are assumed.
    force : bool, default False
        Whether to write into a folder with other files.

    Returns
    -------
    AssessResult
        `objects` is a table with a row for each object; `save(folder)` writes the files of the command.

    Examples
    --------
    >>> found = fs.assess({"assessment": {"worlds": {"most": 200}}}, list_of_objects, place="Wellington")  # doctest: +SKIP
    >>> found.objects.column("decision")  # doctest: +SKIP
    array(['restrain', 'leave'], dtype=object)
    """
    asked = given(
        seed=seed, place=place, site=site, return_period_years=return_period_years,
        fault_distance_m=fault_distance_m, fault_magnitude=fault_magnitude, sheet=sheet, edit=edits,
        storeys=storeys, strict=flag("strict", strict), assess_anchored=flag("assess_anchored", assess_anchored),
        format=["csv", "parquet"] if flag("parquet", parquet) else None, outcomes=flag("outcomes", outcomes),
        resume=flag("resume", resume), date=date, preparer=preparer, revision=revision,
        allow_recalled=flag("allow_recalled", allow_recalled),
        budget=budget, horizon_years=horizon_years, discount_ratio=discount_ratio,
    )  # fmt: skip
    files = study_file(study) | {
        "spectrum": (spectrum, None), "columns": (columns, None), "library": (library, None),
        "cushion_library": (cushion_library, None), "restraints": (restraints, None), "since": (since, None),
    }  # fmt: skip
    _check_progress(progress)
    folder, own = _folder(out)
    with removed_on_failure(own), as_file(inventory) as listed:
        files["inventory"] = (listed.path, None)
        into = (folder, bool(flag("force", force)))
        text = _freestand.assess(asked, files, into, threads_given(threads), progress)
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
    spectrum: PathLike | None = None,
    site: str | None = None,
    return_period_years: float | None = None,
    parquet: bool = False,
    force: bool = False,
) -> RunResult:
    """A whole study: motions, building, spectra of a grid of objects, figures and report.

    Parameters
    ----------
    study : path, str or dict, optional
        A study: its path, its TOML text, or a dictionary of its tables. By default the built-in one.
    out : path, optional
        Folder for the files; without it they are kept until `save(folder)`.
    seed, threads : int, optional
        Seed of the random numbers, number of threads; the result does not depend on the threads.
    progress : callable, optional
        Called with (stage, done, total) as the work goes on.
    place, site : str, optional
        A place with the hazard of its code, in place of that of the study, and the class of its site.
    spectrum : path, optional
        A spectrum to use instead: a table, or a file of OpenQuake, USGS, EFEHR, AFAD or GEM, in which `place` is the site and
        `return_period_years` chooses the spectrum.
    return_period_years : float, optional
        Return period of the hazard [years].
    parquet : bool, default False
        Whether to write the tables as Parquet, too.
    force : bool, default False
        Whether to write into a folder with other files.

    Returns
    -------
    RunResult
        `rows` is srs.csv as a table, `uplift_rows` urs.csv.

    Examples
    --------
    >>> fs.run("study.toml", "out").rows.num_rows  # doctest: +SKIP
    5120
    """
    asked = given(
        seed=seed, place=place, site=site, return_period_years=return_period_years, parquet=flag("parquet", parquet),
    )  # fmt: skip
    _check_progress(progress)
    folder, own = _folder(out)
    files = study_file(study) | {"spectrum": (spectrum, None)}
    with removed_on_failure(own):
        into = (folder, bool(flag("force", force)))
        text = _freestand.run(asked, files, into, threads_given(threads), progress)
        result = RunResult._of(text)
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

    Parameters
    ----------
    outcomes : path or table
        One row for each object and motion (CSV; docs/risk.md has its columns), or a table of pandas, polars or
        pyarrow with its headings. `outcomes.csv` of an assessment is another table.
    at : str, optional
        "ground" or "floor", where a spectral acceleration is taken.
    fit : str, optional
        "ordered" (default) or "separate".
    tolerance_g, ceiling_g : float, optional
        Both: fit `exceeds` to the shocks [g].
    bootstrap : int, optional
        Samples of motions for the 95 % intervals, 0 for none.
    seed, threads : int, optional
        Seed of the random numbers, number of threads.

    Returns
    -------
    FragilityResult
        `curves` is a table with `median` and `beta`; `probability` evaluates one, `plot` draws them.

    Examples
    --------
    >>> found = fs.fragility("examples/risk/outcomes.csv", bootstrap=0)
    >>> print(f"{found.curve('cabinet', 'overturns')['median']:.3f} m/s")
    0.472 m/s
    """
    asked = given(
        at=at, fit=fit, tolerance_g=tolerance_g, ceiling_g=ceiling_g, bootstrap=bootstrap, seed=seed,
    )  # fmt: skip
    with as_file(outcomes, "outcomes") as runs:
        text, seen = _freestand.fragility(asked, {"outcomes": (runs.path, None)}, threads_given(threads))
    result = FragilityResult(json.loads(runs.named(text)), seen)
    warn(result.warnings)
    return result


def risk(
    fragility: PathLike | None = None,
    *,
    outcomes: Any = None,
    hazard: PathLike | None = None,
    hazard_power: str | None = None,
    place: str | None = None,
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
    sheet: str | None = None,
    columns: PathLike | None = None,
    edits: Sequence[str] | None = None,
    options: Any = None,
    budget: str | None = None,
    horizon_years: float | None = None,
    discount_ratio: float | None = None,
    accepted_rate: float | None = None,
    years: float | None = None,
    threads: int | None = None,
) -> RiskResult:
    """How often objects fail per year, what that costs, and which options are worth their money.

    Parameters
    ----------
    fragility : path, optional
        Curves, such as the file fragility.csv.
    outcomes : path or table, optional
        Runs to which curves are fitted, in place of `fragility`.
    hazard : path, optional
        Hazard curve: a table of one's own, or a file of OpenQuake, USGS, EFEHR, AFAD or NTC.
    hazard_power : str, optional
        A hazard curve as "k0=1e-4 /yr, k=2.5, reference=1 m/s", in place of `hazard`.
    place : str, optional
        A place whose return periods are the hazard, in place of `hazard`; with `hazard` the site of that file.
    hazard_code : str, optional
        A code, with `site`, `hazard_factor` and `fault_distance_m`, in place of `hazard`.
    hazard_im : str, optional
        Intensity measure of the hazard, such as "pgv".
    site : str, optional
        Class of the site.
    hazard_factor, fault_distance_m : float, optional
        Values of the code.
    site_deg : tuple of float, optional
        Longitude and latitude [degrees], for a file of `hazard` with several sites.
    at, fit, bootstrap, seed : optional
        As in `fragility`.
    inventory : path or table, optional
        Costs and accepted rates.
    sheet, columns, edits : optional
        As in `check_inventory`.
    options : path or table, optional
        What can be bought.
    budget : str, optional
        An amount, such as "20000 AUD".
    horizon_years, discount_ratio : float, optional
        Years over which losses count, and their discount per year.
    accepted_rate : float, optional
        Accepted rate per year.
    years : float, optional
        Years of a probability.
    threads : int, optional
        Number of threads.

    Returns
    -------
    RiskResult
        `objects` with rates and losses, `plan`, `portfolio`.

    Examples
    --------
    >>> found = fs.risk("examples/risk/curves.csv", hazard="examples/risk/hazard.csv")
    >>> sorted({item["id"] for item in found.objects})[:1]
    ['cabinet']
    """
    asked = given(
        hazard_power=hazard_power, place=place, hazard_code=hazard_code, hazard_im=hazard_im, site=site,
        hazard_factor=hazard_factor, fault_distance_m=fault_distance_m, site_deg=site_deg, at=at, fit=fit,
        bootstrap=bootstrap, seed=seed, budget=budget, horizon_years=horizon_years, discount_ratio=discount_ratio,
        accepted_rate=accepted_rate, years=years, sheet=sheet, edit=edits,
    )  # fmt: skip
    with (
        as_file(outcomes, "outcomes") as runs,
        as_file(inventory) as costs,
        as_file(options, "options") as bought,
    ):
        files: dict[str, tuple[PathLike | None, str | None]] = {
            "fragility": (fragility, None), "hazard": (hazard, None), "outcomes": (runs.path, None),
            "inventory": (costs.path, None), "columns": (columns, None), "options": (bought.path, None),
        }  # fmt: skip
        text = _freestand.risk(asked, files, threads_given(threads))
    result = RiskResult._of(bought.named(costs.named(runs.named(text))))
    warn(result.warnings)
    return result


def validate(*, threads: int | None = None) -> ValidateResult:
    """Recalculates Table I of the paper and every closed form that is built in.

    Parameters
    ----------
    threads : int, optional
        Number of threads.

    Returns
    -------
    ValidateResult
        `table_one`, `checks`, and `ok`: whether all of them hold.

    Examples
    --------
    >>> fs.validate().ok
    True
    """
    return ValidateResult._of(_freestand.validate(threads_given(threads)))
