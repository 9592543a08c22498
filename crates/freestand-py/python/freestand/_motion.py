"""Motions of the ground or of a floor."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np

from . import _freestand
from ._convert import Array, Numbers, PathLike, bad, data, doubles, given, number, of_kind, path_text, paths_text, warn, words
from ._results import MotionSpectrumResult


class Motion:
    """An acceleration history, equally spaced and linear between samples.

    `accel_m_s2`: shape (n,), n ≥ 2, finite, in m/s², the first at t = 0; `dt_s`: time step in s.
    """

    __slots__ = ("_accel", "_record")

    _record: _freestand.Record
    _accel: Array | None

    def __init__(self, accel_m_s2: Numbers, dt_s: float, name: str | None = None) -> None:
        if accel_m_s2 is None:
            raise bad("accel_m_s2 is None", "give the accelerations as a list or an array of numbers")
        of_kind("name", name, str, "a string")
        samples = doubles("accel_m_s2", accel_m_s2).tobytes()
        self._record = _freestand.Record(samples, number("dt_s", dt_s), "motion" if name is None else name)
        self._accel = None

    @classmethod
    def _of(cls, record: _freestand.Record) -> Motion:
        motion = cls.__new__(cls)
        motion._record, motion._accel = record, None
        return motion

    @classmethod
    def _restored(cls, accel: bytes, dt_s: float, name: str, notes: list[str], processing: list[str]) -> Motion:
        return cls._of(_freestand.Record(accel, dt_s, name, notes, processing))

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
        name = "motion" if array.name is None else str(array.name)
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
        values = given(
            periods_s=data("periods_s", periods_s), damping_ratio=data("damping_ratio", damping_ratio), upsample=upsample
        )
        return MotionSpectrumResult._of(self._record.spectrum(values))

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
        keys = words(
            baseline=baseline, taper_ratio=taper_ratio, low_cut_hz=low_cut_hz, high_cut_hz=high_cut_hz,
            filter_order=filter_order, resample_s=resample_s, scale=scale, scale_to_g=scale_to_g,
            scale_to_sa=scale_to_sa, scale_to_spectrum=scale_to_spectrum,
        )  # fmt: skip
        return Motion._of(self._record.process(given(words=keys)))

    def scale(self, factor: float) -> Motion:
        """A copy with every sample multiplied by `factor`."""
        return Motion._of(self._record.scaled(number("factor", factor)))

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
        parts = (self._record.accel(), self.dt_s, self.name, self.warnings, self.processing)
        return Motion._restored, parts

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
    """Motions from record files: a pattern such as `"floor/*.csv"` (sorted by name), or paths.

    The format is recognised by the content. `unit` and `dt_s` are for files that do not state them;
    `component` is a name or a number from 1. The other arguments process the motions: docs/records.md.
    """
    if isinstance(paths, str | os.PathLike):
        import glob

        text = path_text("paths", paths)
        files = sorted(glob.glob(text)) if any(c in text for c in "*?[") and not os.path.exists(text) else [text]
        if not files:
            raise bad(f"no file is called {text}", "check the folder and the pattern")
    else:
        files = paths_text("paths", paths)
    keys = words(
        unit=unit, dt_s=dt_s, component=component, scale=scale, station_xml=station_xml, keep_mean=keep_mean,
        azimuth_deg=azimuth_deg, baseline=baseline, taper_ratio=taper_ratio, low_cut_hz=low_cut_hz,
        high_cut_hz=high_cut_hz, filter_order=filter_order, resample_s=resample_s, scale_to_g=scale_to_g,
        scale_to_sa=scale_to_sa, scale_to_spectrum=scale_to_spectrum,
    )  # fmt: skip
    motions = [Motion._of(record) for record in _freestand.read_motions(files, given(words=keys))]
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
    """The motion of one record file; the arguments are those of `read_motions`."""
    return read_motions([path], unit, dt_s, component, **processing)[0]
