"""Spectra of codes, motions that fit them, and the floors of a building."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

from . import _freestand
from ._convert import Numbers, PathLike, bad, data, flag, given, threads_given, warn, words
from ._motion import Motion, several
from ._results import CodeSpectrumResult, FloorResult, SynthResult

if TYPE_CHECKING:
    from typing_extensions import Unpack


class TargetArguments(TypedDict, total=False):
    """The target spectrum of a code, a place or a file: docs/codes.md has the values that each code needs."""

    #: as1170.4 (default), eurocode8, asce7, nzs1170.5, ntc2018, tbdy2018, ts1170.5.
    code: str | None
    edition: int | str | None
    site: str | None
    #: Brings its code and its hazard; its name, or its coordinates ("41.01, 28.97").
    place: str | None
    city: str | None
    latitude: float | None
    longitude: float | None
    #: T1 to T4 of NTC 2018.
    topography: str | None
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


def target_words(arguments: Mapping[str, Any]) -> dict[str, Any] | None:
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
    """The elastic response spectrum of a design code for 5 % damping.

    Parameters
    ----------
    periods_s : array_like, optional
        Periods [s].
    parts : bool, default False
        Whether to add the accelerations of rigid parts on floors.
    building_height_m, building_period_s : float, optional
        The building, for `parts` [m, s].
    **target
        `code` is "as1170.4" (default), "eurocode8", "asce7", "nzs1170.5", "ntc2018", "tbdy2018" or "ts1170.5", with
        `edition, site, place, city, latitude, longitude, topography, hazard_factor, return_period_years` and further values of the codes: `fault_distance_m, spectrum_type,
        ground_acceleration_g, importance_factor, soil_factor, corner_periods_s, sds_g, sd1_g, ss_g, s1_g, fa, fv,
        long_period_s`; or `spectrum` (a file) with `interpolation` and `beyond`: docs/codes.md.

    Returns
    -------
    CodeSpectrumResult
        `periods_s`, `sa_g`, `parts`.

    Examples
    --------
    >>> fs.code_spectrum([0, 1], site="Ce", hazard_factor=0.11).sa_g.shape
    (2,)
    """
    values = given(
        **(target_words(target) or {}), parts=flag("parts", parts), building_height_m=building_height_m,
        building_period_s=building_period_s,
    )  # fmt: skip
    periods = data("periods_s", periods_s) or b""
    result = CodeSpectrumResult._of(_freestand.code_spectrum(periods, values))
    warn(result.warnings)
    return result


def synth(
    count: int | None = None,
    *,
    seed: int | None = None,
    dt_s: float | None = None,
    shaking_s: float | None = None,
    envelope_s: float | None = None,
    match_pga: bool = False,
    threads: int | None = None,
    time_step_s: float | None = None,
    **target: Unpack[TargetArguments],
) -> SynthResult:
    """Synthetic motions that fit the spectrum of a code.

    Parameters
    ----------
    count : int, optional
        Number of motions.
    seed : int, optional
        Seed of the random numbers.
    dt_s : float, optional
        Time step [s].
    shaking_s, envelope_s : float, optional
        Length of the shaking, and of the window that shapes the noise [s].
    match_pga : bool, default False
        Whether the peak acceleration is that of the target at T = 0.
    threads : int, optional
        Number of threads.
    time_step_s : float, optional
        The earlier name of `dt_s`.
    **target
        The spectrum: see `code_spectrum`.

    Returns
    -------
    SynthResult
        `records` are Motions.

    Examples
    --------
    >>> [motion.name for motion in fs.synth(2, seed=7, site="Ce", shaking_s=20).records]
    ['synthetic-01', 'synthetic-02']
    """
    if dt_s is not None and time_step_s is not None:
        raise bad("dt_s and time_step_s are the same", "keep dt_s")
    step_s = time_step_s if dt_s is None else dt_s
    values = given(
        **(target_words(target) or {}), count=count, seed=seed, time_step_s=step_s, shaking_s=shaking_s,
        envelope_s=envelope_s, match_pga=flag("match_pga", match_pga),
    )  # fmt: skip
    text, records = _freestand.synth(values, threads_given(threads))
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
    """How the floors of a building move.

    Parameters
    ----------
    motions : Motion or iterable of Motion
        Motions of the ground.
    levels : array_like, optional
        Shares of the height, 0 (the ground) to 1 (the roof); 0.5 and 1 by default.
    every_floor : bool, default False
        Whether to take all floors.
    storeys : int, optional
        Number of storeys.
    storey_height_m, building_height_m, period_s : float, optional
        Height of a storey or of the building [m], fundamental period [s].
    frame, period_code : str, optional
        Structure, and code of the formula for the period.
    damping_ratio, shear_flexure : float, optional
        Damping of every mode; α₀ = H√(GA/EI).
    modes : int, optional
        Number of modes.
    storey_table, mode_table : path, optional
        The building as a table of storeys or of modes.
    tail_s : float, optional
        Time after the motion, in which the building comes to rest [s].
    upsample : int, optional
        Points in each interval at which peaks are found.
    threads : int, optional
        Number of threads.
    **target
        A code (see `code_spectrum`), whose accelerations of rigid parts are compared.

    Returns
    -------
    FloorResult
        `floors[i][j]` is the motion of level j under motion i.

    Examples
    --------
    >>> found = fs.floor(motion, levels=[0.5, 1], storeys=5, storey_height_m=3)
    >>> [one.name for one in found.floors[0]]
    ['synthfloor at 0.5', 'synthfloor at 1']
    """
    building = words(
        storeys=storeys, storey_height_m=storey_height_m, height=building_height_m, period_s=period_s,
        frame=frame, period_code=period_code, damping_ratio=damping_ratio, shear_flexure=shear_flexure, modes=modes,
        storey_table=storey_table, mode_table=mode_table,
    )  # fmt: skip
    values = given(
        **(building or {}), **(target_words(target) or {}), levels="all" if flag("every_floor", every_floor) else None,
        tail_s=tail_s, upsample=upsample,
    )  # fmt: skip
    shares = b"" if every_floor else data("levels", levels) or b""
    records = [motion._record for motion in several(motions)]
    text, floors = _freestand.floor(records, shares, values, threads_given(threads))
    result = FloorResult(json.loads(text), [[Motion._of(record) for record in one] for one in floors])
    warn(result.warnings)
    return result
