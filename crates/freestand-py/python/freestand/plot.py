"""Figures of results with matplotlib (the extra `plot`).

Each function takes a result and returns the Axes that it drew on: `ax`, or new ones. No style is set, and
nothing is shown or saved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._convert import bad
from ._motion import Motion
from ._results import (
    CodeSpectrumResult,
    DropTestResult,
    FragilityResult,
    IdaResult,
    MotionSpectrumResult,
    RockResult,
    ShockSpectrumResult,
)
from ._table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError('figures need matplotlib: pip install "freestand[plot]"') from error

    found: Axes = plt.subplots(layout="constrained")[1]
    return found


def motion(motion: Motion, ax: Axes | None = None) -> Axes:
    """Acceleration [g] against time."""
    ax = _axes(ax)
    ax.plot(motion.time_s, motion.accel_m_s2 / 9.80665, linewidth=0.8)
    ax.set(title=motion.name, xlabel="time [s]", ylabel="acceleration [g]")
    return ax


def rock(result: RockResult, ax: Axes | None = None) -> Axes:
    """The history of an object: its rotation over α with the impacts, and the motion of the floor.

    Without a recorded history only the impacts are drawn. An object that slides: its slide.
    """
    ax = _axes(ax)
    history = result.history
    if history is not None and "slide_m" in history:
        ax.plot(history["time_s"], 1e3 * history["slide_m"], label="slide")
        ax.set(xlabel="time [s]", ylabel="slide [mm]", title=result.outcome)
        return ax
    floor: tuple[Any, Any] | None = None
    if history is not None and "base_accel_m_s2" in history:
        floor = history["time_s"], history["base_accel_m_s2"] / 9.80665
    elif result._motion is not None:
        floor = result._motion.time_s, result._motion.accel_m_s2 / 9.80665
    handles: list[Any] = []
    if floor is not None:
        behind = ax.twinx()
        behind.set_zorder(ax.get_zorder() - 1)
        ax.patch.set_visible(False)
        handles += behind.plot(*floor, color="0.75", linewidth=0.6, label="floor")
        behind.set_ylim(*(1.1 * np.max(np.abs(floor[1]), initial=1e-6) * np.array([-1, 1])))
        behind.set_ylabel("acceleration of the floor [g]")
    if history is not None:
        ratio = history["theta_rad"] / result.slenderness_angle_rad
        handles += ax.plot(history["time_s"], ratio, color="C0", label="rotation / α")
        ax.set_ylim(*(1.1 * np.max(np.abs(ratio), initial=0.1) * np.array([-1, 1])))
    times = result.impacts["time_s"]
    if len(times):
        handles += ax.plot(times, np.zeros(len(times)), "|", color="C3", markersize=8, label=f"impacts ({len(times)})")
    ax.set(xlabel="time [s]", ylabel="rotation / α", title=result.outcome)
    if handles:
        ax.legend(handles=handles, loc="upper right")
    return ax


def _medians(table: Table, name: str, motion: str | None) -> tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]:
    """Heights, thicknesses, the median over motions (NaN where the object falls), the share of them in which it does."""
    if table._dims != ("motion", "height_m", "thickness_m"):
        raise bad("this table has no grid of heights and thicknesses", "give the table of freestand.spectrum")
    if motion is not None:
        names = table.column("motion").reshape(table._shape)[:, 0, 0].tolist()
        if motion not in names:
            raise bad(f"there is no motion {motion}", f"the motions are {', '.join(names)}")
        table = table._of_motion(names.index(motion))
    fallen = np.isin(table.column("outcome"), ("overturned", "leaned")).reshape(table._shape)
    median = table.quantile(name)
    median = np.where(np.isinf(median), np.nan, median)
    heights = table.column("height_m").reshape(table._shape)[0, :, 0]
    thicknesses = table.column("thickness_m").reshape(table._shape)[0, 0, :]
    return heights, thicknesses, median, fallen.mean(axis=0)


def _lines(table: Table, name: str, factor: float, label: str, ax: Axes | None, motion: str | None) -> Axes:
    """The median against the height, a line for each of at most seven thicknesses; crosses: at least half overturn."""
    ax = _axes(ax)
    heights, thicknesses, median, share = _medians(table, name, motion)
    shown = np.unique(np.linspace(0, len(thicknesses) - 1, min(7, len(thicknesses))).astype(int))
    for row, index in enumerate(shown):
        (line,) = ax.plot(heights, factor * median[:, index], label=f"{1e3 * thicknesses[index]:.0f} mm")
        fallen = heights[share[:, index] >= 0.5]
        # One row of crosses for each thickness, at the bottom of the figure.
        level = np.full(len(fallen), 0.015 + 0.02 * row)
        ax.plot(fallen, level, "x", color=line.get_color(), markersize=4, transform=ax.get_xaxis_transform())
    ax.set(xlabel="height [m]", ylabel=label)
    ax.set_ylim(bottom=0)
    ax.legend(title="thickness")
    return ax


def urs(table: Table, ax: Axes | None = None, *, motion: str | None = None) -> Axes:
    """Uplift response spectrum: the median uplift against the height, a line for each thickness.

    A cross at the bottom: at least half of the motions overturn the object. `motion` chooses one motion.
    """
    return _lines(table, "uplift_m", 1e3, "uplift [mm]", ax, motion)


def srs(table: Table, ax: Axes | None = None, *, motion: str | None = None) -> Axes:
    """Shock response spectrum of the paper: as `urs`, with the shock of the landing edge [g]."""
    return _lines(table, "edge_acceleration_g", 1.0, "shock of the edge [g]", ax, motion)


def fragility(result: FragilityResult, id: str | None = None, ax: Axes | None = None) -> Axes:
    """The fragility curves of one object (the first one by default), with the observed shares of runs.

    A vertical bar is the 95 % interval of a share.
    """
    ax = _axes(ax)
    known = [one["id"] for one in result.objects]
    if id is None:
        id = known[0]
    item = next((one for one in result.objects if one["id"] == id), None)
    if item is None:
        raise bad(f"there is no object {id}", f"the objects are {', '.join(known[:12])}")
    rows = [row for row in result.empirical.rows() if row["id"] == id]
    most = max((row["intensity"] for row in rows), default=1.0)
    grid = np.linspace(0, most, 201)[1:]
    for index, curve in enumerate(item["curves"]):
        state, color = curve["limit_state"], f"C{index}"
        ax.plot(grid, result.probability(id, state, grid), color=color, label=state)
        seen = [row for row in rows if row["limit_state"] == state]
        x, share, low, high = (
            np.array([row[name] for row in seen], "f8") for name in ("intensity", "share", "share_ci95_low", "share_ci95_high")
        )
        ends = np.maximum([share - low, high - share], 0)
        ax.errorbar(x, share, ends, fmt="o", color=color, markersize=4, linewidth=0.8)
    unit = f" [{item['im_unit']}]" if item["im_unit"] else ""
    ax.set(title=id, xlabel=f"{item['im']}{unit} of the {item['at']}", ylabel="probability", ylim=(-0.02, 1.02))
    ax.legend(loc="upper left")
    return ax


def ida(result: IdaResult, ax: Axes | None = None) -> Axes:
    """Incremental dynamic analysis: the largest rotation over α against the intensity, a line for each motion.

    A line ends in a cross where the motion overturns the object.
    """
    ax = _axes(ax)
    table = result.runs
    intensity, ratio = (table.column(name).reshape(table._shape) for name in ("intensity", "peak_rotation_ratio"))
    fallen = np.isin(table.column("outcome"), ("overturned", "leaned")).reshape(table._shape)
    for name, x, y, down in zip(result.motions, intensity, ratio, fallen):
        count = int(np.argmax(down)) if down.any() else len(down)
        (line,) = ax.plot(x[:count], y[:count], label=name, linewidth=0.8)
        if down.any():
            ax.plot(x[count], 1.0, "x", color=line.get_color(), markersize=4)
    unit = f" [{result.im_unit}]" if result.im_unit else ""
    ax.set(xlabel=f"{result.im}{unit} of the floor", ylabel="largest rotation / α", ylim=(-0.02, 1.05))
    return ax


def loop(test: DropTestResult, ax: Axes | None = None) -> Axes:
    """Force against compression of each drop."""
    ax = _axes(ax)
    for index, one in enumerate(test.loops):
        ax.plot(1e3 * one["compression_m"], 1e-3 * one["force_n"], linewidth=1, label=f"drop {index + 1}")
    if test.stiffness_n_m is not None:
        most = max((float(one["compression_m"].max()) for one in test.loops), default=0.0)
        label = f"{1e-3 * test.stiffness_n_m:.4g} N/mm"
        ax.plot([0, 1e3 * most], [0, 1e-3 * test.stiffness_n_m * most], "k--", linewidth=1, label=label)
    ax.set(xlabel="compression [mm]", ylabel="force [kN]")
    ax.legend()
    return ax


def spectrum(
    result: Motion | MotionSpectrumResult | CodeSpectrumResult | ShockSpectrumResult, ax: Axes | None = None
) -> Axes:
    """A response spectrum: of a motion or a code against the period, of a shock against the frequency."""
    ax = _axes(ax)
    if isinstance(result, Motion):
        name, result = result.name, result.spectrum()
        ax.set_title(name)
    if isinstance(result, ShockSpectrumResult):
        ax.loglog(result.frequencies_hz, result.values)
        ax.set(xlabel="frequency [Hz]", ylabel=f"peak response [{result.unit}]")
    elif isinstance(result, CodeSpectrumResult):
        ax.plot(result.periods_s, result.sa_g, label=f"{result.code}, site {result.site}")
        ax.set(xlabel="period [s]", ylabel="pseudo-acceleration [g]")
        ax.legend()
    else:
        ax.plot(result.periods_s, result.psa_g, label=f"{100 * result.damping_ratio:g} % damping")
        ax.set(xlabel="period [s]", ylabel="pseudo-acceleration [g]")
        ax.legend()
    return ax
