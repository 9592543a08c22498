"""Motions of the ground or of a floor."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np

from . import _freestand
from ._convert import Array, Numbers, PathLike, bad, data, doubles, given, number, of_kind, path_text, paths_text, warn
from ._results import MotionSpectrumResult

#: The name of a motion that was given none; in a list with others it gets its number.
UNNAMED = "motion"


class Motion:
    """An acceleration history, equally spaced and linear between samples.

    Parameters
    ----------
    accel_m_s2 : array_like
        Accelerations [m/s²], two or more, all finite, the first at t = 0.
    dt_s : float
        Time step [s].
    name : str, optional
        Its name in results. In a list, motions without a name are called "motion 1", "motion 2", …

    Examples
    --------
    >>> fs.Motion([0, 1.5, -2, 0], dt_s=0.01, name="test")
    <freestand.Motion test: 4 samples at 0.01 s, PGA 0.2039 g>
    """

    __slots__ = ("_accel", "_is_named", "_record")

    _record: _freestand.Record
    _accel: Array | None
    _is_named: bool

    def __init__(self, accel_m_s2: Numbers, dt_s: float, name: str | None = None) -> None:
        if accel_m_s2 is None:
            raise bad("accel_m_s2 is None", "give the accelerations as a list or an array of numbers")
        of_kind("name", name, str, "a string")
        samples = doubles("accel_m_s2", accel_m_s2).tobytes()
        self._record = _freestand.Record(samples, number("dt_s", dt_s), UNNAMED if name is None else name)
        self._accel, self._is_named = None, name is not None

    @classmethod
    def _of(cls, record: _freestand.Record, is_named: bool = True) -> Motion:
        motion = cls.__new__(cls)
        motion._record, motion._accel, motion._is_named = record, None, is_named
        return motion

    @classmethod
    def _restored(
        cls, accel: bytes, dt_s: float, name: str, notes: list[str], processing: list[str], is_named: bool = True
    ) -> Motion:
        return cls._of(_freestand.Record(accel, dt_s, name, notes, processing), is_named)

    def _called(self, name: str) -> Motion:
        """The same motion under another name."""
        return Motion._restored(self._record.accel(), self.dt_s, name, self.warnings, self.processing)

    @classmethod
    def from_obspy(cls, trace: Any, unit: str | None = None) -> Motion:
        """A motion from an ObsPy trace of accelerations in `unit` (`m/s2`, `g`, `gal`, …).

        A trace does not state its unit, and freestand never guesses one.
        """
        if unit is None:
            raise bad("a trace does not state its unit", 'give unit, such as unit="m/s2" after remove_response')
        if not (hasattr(trace, "data") and hasattr(trace, "stats")):
            raise bad(f"trace must be an ObsPy trace, not {type(trace).__name__}", "give one, such as stream[0]")
        of_kind("unit", unit, str, "a string")
        factor = _freestand.acceleration_unit(unit)
        return cls(np.asarray(trace.data, "f8") * factor, float(trace.stats.delta), str(trace.id))

    @classmethod
    def from_xarray(cls, array: Any) -> Motion:
        """A motion from a one-dimensional DataArray: its coordinate is the time in seconds, and
        `attrs["units"]` the unit of acceleration."""
        if not (hasattr(array, "attrs") and hasattr(array, "dims")):
            raise bad(f"array must be an xarray.DataArray, not {type(array).__name__}", "give one with a time coordinate")
        unit = array.attrs.get("units")
        if unit is None:
            raise bad("the array does not state its unit", 'set array.attrs["units"], such as "m/s2"')
        time = np.asarray(array[array.dims[0]].values)
        seconds = time / np.timedelta64(1, "s") if time.dtype.kind == "m" else np.asarray(time, "f8")
        steps = np.diff(seconds)
        if len(steps) == 0 or not np.allclose(steps, steps[0], rtol=1e-6, atol=0.0):
            raise bad("the times are not equally spaced", "resample the array first")
        dt_s = float((seconds[-1] - seconds[0]) / len(steps))
        name = None if array.name is None else str(array.name)
        return cls(np.asarray(array.values, "f8") * _freestand.acceleration_unit(str(unit)), dt_s, name)

    @property
    def accel_m_s2(self) -> Array:
        """Samples [m/s²], shape (n,), read-only."""
        if self._accel is None:
            self._accel = np.frombuffer(self._record.accel(), "f8")
        return self._accel

    @property
    def dt_s(self) -> float:
        """Time step [s]."""
        return self._record.dt_s

    @property
    def time_s(self) -> Array:
        """Times of the samples [s], shape (n,)."""
        times: Array = np.arange(len(self.accel_m_s2), dtype="f8") * self.dt_s
        return times

    @property
    def name(self) -> str:
        """Its name in results."""
        return self._record.name

    @property
    def pga_g(self) -> float:
        """Largest |a| at the samples [g]."""
        return self._record.pga_g

    @property
    def warnings(self) -> list[str]:
        """What the reader of its file concluded or ignored."""
        return self._record.notes

    @property
    def processing(self) -> list[str]:
        """What was done to the samples, one step each."""
        return self._record.processing

    def measures(self) -> dict[str, Any]:
        """PGA, PGV, PGD, Arias intensity, CAV, durations and periods: the keys of `motion info`."""
        return self._record.measures()

    def spectrum(
        self, periods_s: Numbers | None = None, damping_ratio: Numbers | None = None, *, upsample: int | None = None
    ) -> MotionSpectrumResult:
        """Response spectrum at `periods_s` [s] (by default 0 and 121 from 0.05 s to 5 s), damping 5 %."""
        periods, dampings = data("periods_s", periods_s) or b"", data("damping_ratio", damping_ratio) or b""
        return MotionSpectrumResult._of(self._record.spectrum(periods, dampings, given(upsample=upsample)))

    def process(
        self,
        *,
        baseline: str | None = None,
        taper_ratio: float | None = None,
        low_cut_hz: float | None = None,
        high_cut_hz: float | None = None,
        filter_order: int | None = None,
        resample_s: float | None = None,
        scale: float | None = None,
        scale_to_g: float | None = None,
        scale_to_sa: str | None = None,
        scale_to_spectrum: str | None = None,
    ) -> Motion:
        """A processed copy, in this order: baseline, taper, filter, time step, scale; see docs/records.md."""
        values = given(
            baseline=baseline, taper_ratio=taper_ratio, low_cut_hz=low_cut_hz, high_cut_hz=high_cut_hz,
            filter_order=filter_order, resample_s=resample_s, scale=scale, scale_to_g=scale_to_g,
            scale_to_sa=scale_to_sa, scale_to_spectrum=scale_to_spectrum,
        )  # fmt: skip
        return Motion._of(self._record.process(values), self._is_named)

    def scale(self, factor: float) -> Motion:
        """A copy with every sample multiplied by `factor`."""
        return Motion._of(self._record.scaled(number("factor", factor)), self._is_named)

    def write(self, path: PathLike) -> None:
        """Writes the motion as `.csv` (to the last bit) or `.at2` (8 digits)."""
        self._record.write(path_text("path", path))

    def plot(self, ax: Any = None) -> Any:
        """Acceleration against time."""
        from . import plot

        return plot.motion(self, ax=ax)

    def __len__(self) -> int:
        return len(self.accel_m_s2)

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (self._record.accel(), self.dt_s, self.name, self.warnings, self.processing, self._is_named)
        return Motion._restored, parts

    def _repr_html_(self) -> str:
        import html

        facts = [("name", self.name), ("samples", str(len(self))), ("dt_s", f"{self.dt_s:g}"), ("pga_g", f"{self.pga_g:.4g}")]
        rows = "".join(f"<tr><th>{key}</th><td>{html.escape(value)}</td></tr>" for key, value in facts)
        return f"<table><caption>Motion</caption><tbody>{rows}</tbody></table>"

    def __repr__(self) -> str:
        return f"<freestand.Motion {self.name}: {len(self)} samples at {self.dt_s:g} s, PGA {self.pga_g:.4g} g>"


def read_motions(
    paths: PathLike | Iterable[PathLike],
    unit: str | None = None,
    dt_s: float | None = None,
    component: str | int | None = None,
    *,
    scale: float | None = None,
    station_xml: PathLike | None = None,
    keep_mean: bool | None = None,
    azimuth_deg: float | None = None,
    baseline: str | None = None,
    taper_ratio: float | None = None,
    low_cut_hz: float | None = None,
    high_cut_hz: float | None = None,
    filter_order: int | None = None,
    resample_s: float | None = None,
    scale_to_g: float | None = None,
    scale_to_sa: str | None = None,
    scale_to_spectrum: str | None = None,
) -> list[Motion]:
    """Motions from record files, whose format is recognised by the content.

    Parameters
    ----------
    paths : path or iterable of path
        A pattern such as "floor/*.csv" (sorted by name), or paths.
    unit : str, optional
        Unit of acceleration of files that do not state it: "g", "m/s2", "gal", …
    dt_s : float, optional
        Time step of files that do not state it [s].
    component : str or int, optional
        Component to read, by its name or its number from 1.
    scale : float, optional
        Factor that multiplies the samples.
    station_xml : path, optional
        StationXML file with the sensitivity of a miniSEED file.
    keep_mean : bool, optional
        Whether the mean of raw records stays.
    azimuth_deg, baseline, taper_ratio, low_cut_hz, high_cut_hz, filter_order, resample_s, scale_to_g, scale_to_sa, scale_to_spectrum : optional
        Processing, in this order: docs/records.md.

    Returns
    -------
    list of Motion
        One for each file.

    Examples
    --------
    >>> [motion.name for motion in fs.read_motions("validation/rocking/records/synthfloor.cs*")]
    ['synthfloor']
    """
    if isinstance(paths, str | os.PathLike):
        import glob

        text = path_text("paths", paths)
        files = sorted(glob.glob(text)) if any(c in text for c in "*?[") and not os.path.exists(text) else [text]
        if not files:
            raise bad(f"no file is called {text}", "check the folder and the pattern")
    else:
        files = paths_text("paths", paths)
    xml = None if station_xml is None else path_text("station_xml", station_xml)
    values = given(
        unit=unit, dt_s=dt_s, component=component, scale=scale, station_xml=xml, keep_mean=keep_mean,
        azimuth_deg=azimuth_deg, baseline=baseline, taper_ratio=taper_ratio, low_cut_hz=low_cut_hz,
        high_cut_hz=high_cut_hz, filter_order=filter_order, resample_s=resample_s, scale_to_g=scale_to_g,
        scale_to_sa=scale_to_sa, scale_to_spectrum=scale_to_spectrum,
    )  # fmt: skip
    motions = [Motion._of(record) for record in _freestand.read_motions(files, values)]
    for motion in motions:
        warn([f"{motion.name}: {note}" for note in motion.warnings])
    return motions


def read_motion(
    path: PathLike,
    unit: str | None = None,
    dt_s: float | None = None,
    component: str | int | None = None,
    **processing: Any,
) -> Motion:
    """The motion of one record file.

    Parameters
    ----------
    path : path
        The file.
    unit, dt_s, component, **processing : optional
        As in `read_motions`.

    Returns
    -------
    Motion
        The motion, named as its file.

    Examples
    --------
    >>> fs.read_motion("validation/rocking/records/synthfloor.csv", scale=3.5)
    <freestand.Motion synthfloor: 4801 samples at 0.005 s, PGA 0.3569 g>
    """
    return read_motions([path], unit, dt_s, component, **processing)[0]


def record(name: str, motion: Motion) -> _freestand.Record:
    """The samples of a motion; `name` is its argument."""
    if not isinstance(motion, Motion):
        kind = type(motion).__name__
        raise bad(f"{name} must be a freestand.Motion, not {kind}", "make one: Motion(accel_m_s2, dt_s), or read_motion(path)")
    return motion._record


def several(motions: Motion | Iterable[Motion], name: str = "motions") -> list[Motion]:
    """One motion or a list of them, whose names differ: those without one get their number."""
    if not isinstance(motions, Motion | Iterable):
        record(name, motions)
    found = [motions] if isinstance(motions, Motion) else list(motions)
    for motion in found:
        record(name, motion)
    if not found:
        raise bad(f"there is no motion in {name}", "give at least one")
    if len(found) > 1:
        found = [one if one._is_named else one._called(f"{UNNAMED} {i}") for i, one in enumerate(found, 1)]
    names = [motion.name for motion in found]
    twice = next((one for one in names if names.count(one) > 1), None)
    if twice is not None:
        raise bad(f"two motions of {name} are called {twice}", "give them names: Motion(accel_m_s2, dt_s, name)")
    return found
