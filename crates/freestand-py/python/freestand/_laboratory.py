"""Tests of cushions, and the spectrum of a shock."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TypeAlias

from . import _freestand
from ._convert import Numbers, PathLike, bad, data, flag, given, paths_text, warn
from ._motion import Motion
from ._results import DropTestResult, ShockSpectrumResult, StaticTestResult

Files: TypeAlias = "PathLike | Iterable[PathLike]"


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
    sensitivity: str | None = None,
    dt_s: float | None = None,
    component: str | None = None,
    seed: int | None = None,
) -> DropTestResult:
    """The stiffness of a pad with its 95 % interval, from accelerations of a mass dropped on it.

    Parameters
    ----------
    files : path or iterable of path
        Tests of one pad: columns of time and acceleration with their units.
    mass_kg, height_m, impact_velocity_m_s : float, optional
        Mass of the impactor, and its drop height or its velocity at the pad; they replace what the files state.
    velocity_error_ratio : float, optional
        Standard error of that velocity, as a share of it.
    law : str, optional
        Law of the cushion; by default the one that fits best.
    pad_thickness_m, sphere_radius_m : float, optional
        Thickness of the pad, radius of a spherical impactor [m].
    impactor, boundary : str, optional
        Shape of the impactor and boundary of the pad: docs/cushion-laboratory.md.
    corner_hz : float, optional
        Corner frequency of the filter of the measurement [Hz].
    gravity_m_s2 : float, optional
        Gravity during the contact [m/s²].
    inverted : bool, default False
        Whether upward accelerations are negative in the files.
    sensitivity : str, optional
        Sensitivity of the accelerometer of a column in volts, such as "10 mV/g".
    unit, dt_s, component : optional
        As in `read_motion`.
    seed : int, optional
        Seed of the random numbers.

    Returns
    -------
    DropTestResult
        `stiffness_n_m` of one pad and `ci95_n_m`; it can be given as `cushion`, with `pads_per_edge`.

    Examples
    --------
    >>> pad = fs.drop_test(["validation/cushion/drop-001.csv", "validation/cushion/drop-002.csv"])
    >>> bool(pad.ci95_n_m[0] < pad.stiffness_n_m < pad.ci95_n_m[1])
    True
    """
    values = given(
        files=paths_text("files", files), mass_kg=mass_kg, height_m=height_m, impact_velocity_m_s=impact_velocity_m_s,
        velocity_error_ratio=velocity_error_ratio, law=law, pad_thickness_m=pad_thickness_m, impactor=impactor,
        sphere_radius_m=sphere_radius_m, boundary=boundary, corner_hz=corner_hz, gravity_m_s2=gravity_m_s2,
        invert=flag("inverted", inverted), unit=unit, sensitivity=sensitivity, dt_s=dt_s,
        component=component, seed=seed,
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
    inverted: bool = False,
    sensitivity: str | Iterable[str] | None = None,
    impactor: str | None = None,
    boundary: str | None = None,
    dynamic_stiffness_n_m: float | None = None,
) -> StaticTestResult:
    """The static stiffness of a pad.

    Parameters
    ----------
    files : path or iterable of path
        Tests of one pad: columns of force and displacement with their units.
    load_n : float, optional
        Working load [N]; by default half of the largest force.
    machine_stiffness_n_m : float, optional
        Stiffness of the frame of the machine [N/m], whose deformation is subtracted.
    cut_toe : bool, optional
        Whether to cut off the toe of the curve.
    inverted : bool, default False
        Whether compression is negative in the files.
    sensitivity : str or iterable of str, optional
        Sensitivities of the sensors of columns in volts, such as "2 mV/N" and "1 V/mm".
    impactor, boundary : str, optional
        Shape of the impactor and boundary of the pad, in place of what the files state.
    dynamic_stiffness_n_m : float, optional
        Stiffness from a drop test [N/m], for comparison.

    Returns
    -------
    StaticTestResult
        `tests`, each with its tangent and secant stiffness.

    Examples
    --------
    >>> found = fs.static_test("press.csv", load_n=350)  # doctest: +SKIP
    >>> found.tests[0]["secant_stiffness_n_m"]  # doctest: +SKIP
    1100000.0
    """
    sensors = [sensitivity] if isinstance(sensitivity, str) else sensitivity
    cuts = flag("cut_toe", cut_toe)
    values = given(
        files=paths_text("files", files), load_n=load_n, machine_compliance=machine_stiffness_n_m,
        toe=None if cuts is None else "cut" if cuts else "keep", invert=flag("inverted", inverted),
        sensitivity=None if sensors is None else list(sensors), impactor=impactor,
        boundary=boundary, dynamic=dynamic_stiffness_n_m,
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
    """Shock response spectrum (ISO 18431-4) of a motion or of accelerations.

    Parameters
    ----------
    accel : Motion or array_like
        A motion, or accelerations [m/s²] at steps of `dt_s`.
    dt_s : float, optional
        Time step of an array [s].
    frequencies_hz : array_like, optional
        Frequencies of the oscillators [Hz].
    damping_ratio, q : float, optional
        Damping, 5 % by default, or the quality factor 1/(2·damping).
    kind : str, optional
        "absolute-acceleration" (default), "relative-displacement" or "pseudo-velocity".
    peak : str, optional
        "maximax" (default), "positive", "negative", "primary" or "residual".
    upsample : bool, optional
        Whether peaks are found between the samples.

    Returns
    -------
    ShockSpectrumResult
        `frequencies_hz`, `values`, `unit`.

    Examples
    --------
    >>> fs.shock_spectrum(motion, frequencies_hz=[1, 5, 20]).values.shape
    (3,)
    """
    if isinstance(accel, Motion):
        motion = accel
        if dt_s is not None:
            raise bad("dt_s is that of the motion", "leave it out")
    elif dt_s is None:
        raise bad("an array needs its time step", "give dt_s in seconds")
    else:
        motion = Motion(accel, dt_s)
    between = flag("upsample", upsample)
    values = given(
        damping_ratio=damping_ratio, q=q, kind=kind, peak=peak, no_upsample=None if between is None else not between,
    )  # fmt: skip
    frequencies = data("frequencies_hz", frequencies_hz) or b""
    result = ShockSpectrumResult._of(_freestand.shock_spectrum(motion._record, frequencies, values))
    warn(result.warnings)
    return result
