"""Incremental dynamic analysis: an object under motions at growing scales."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from ._block import Block
from ._convert import Array, Numbers, bad, doubles, number, warnings_kept
from ._errors import SolveError
from ._motion import Motion, record, several
from ._results import IdaResult, RockResult
from ._rocking import check_block, rock

#: The measures of intensity of a floor, with their units.
_UNITS = {"pfa": "g", "pfv": "m/s", "velocity_ratio": "", "acceleration_ratio": ""}
_SPECTRAL = re.compile(r"sa\(([0-9.]+)\)")


def ida(
    block: Block,
    motions: Motion | Iterable[Motion],
    scales: Numbers,
    *,
    im: str = "pfa",
    tolerance_g: float | None = None,
    vertical: Motion | Iterable[Motion] | None = None,
    **options: Any,
) -> IdaResult:
    """Incremental dynamic analysis: one object under motions of its floor, each multiplied by every scale.

    A run that overturns has no shock and no largest uplift: medians rank it above every number.

    Parameters
    ----------
    block : Block
        The object. A tolerance needs its mass and its cushion.
    motions : Motion or iterable of Motion
        Motions of the floor under the object.
    scales : array_like
        Factors above 0, in growing order.
    im : str, default "pfa"
        Intensity measure of the floor: "pfa" [g], "pfv" [m/s], "sa(T)" [g] with the period T in s and 5 %
        damping, "velocity_ratio" p·PFV/(g tan α) or "acceleration_ratio" PFA/(g tan α), with g tan α the
        acceleration that lifts an edge.
    tolerance_g : float, optional
        Shock of the edge that the object withstands [g]; a larger one makes the run `exceeded`.
    vertical : Motion or iterable of Motion, optional
        Vertical motions, one for each motion, multiplied by the same scales.
    **options
        The other arguments of `rock`, except `history` and `sliding`.

    Returns
    -------
    IdaResult
        `runs`, a table with a row for each motion and scale; `quantile`, `capacities` and `fragility`.

    Examples
    --------
    >>> found = fs.ida(fs.Block(1.8, 0.5), motions, np.geomspace(0.5, 2, 12))
    >>> found.quantile("peak_rotation_ratio")[[0, -1]]
    array([ 0., inf])
    >>> fit = found.fragility(bootstrap=0).curve("object", "overturns")
    >>> print(f"median {fit['median']:.1f} g of the floor")
    median 0.5 g of the floor
    """
    check_block(block)
    for name in ("history", "sliding"):
        if name in options:
            raise bad(f"{name} does not apply to an incremental dynamic analysis", "leave it out, or use rock")
    named = several(motions)
    upward: list[Motion | None] = [*several(vertical, "vertical")] if vertical is not None else [None] * len(named)
    if len(upward) != len(named):
        raise bad(f"vertical has {len(upward)} motions, motions {len(named)}", "give one for each, in the same order")
    factors = _scales(scales)
    tolerance = None if tolerance_g is None else number("tolerance_g", tolerance_g)
    warnings: list[str] = []
    rows: list[dict[str, Any]] = []
    for motion, second in zip(named, upward):
        record("motions", motion)
        base = _intensity(im, block, motion)
        for scale in factors.tolist():
            row: dict[str, Any] = {"motion": motion.name, "scale_ratio": scale, "intensity": scale * base}
            try:
                with warnings_kept() as kept:
                    found = rock(block, motion.scale(scale), vertical=None if second is None else second.scale(scale), **options)
            except SolveError as error:
                rows.append({**row, "outcome": "unresolved", **dict.fromkeys(_RESPONSES), "reason": str(error)})
                continue
            warnings += [text for text in kept if text not in warnings]
            rows.append({**row, **_response(found, tolerance), "reason": None})
    unit = _UNITS.get(im, "g")
    return IdaResult(im, unit, [motion.name for motion in named], factors, rows, warnings)


_RESPONSES = ("peak_rotation_rad", "peak_rotation_ratio", "uplift_m", "cg_rise_m", "impact_count", "shock_g")


def _response(found: RockResult, tolerance_g: float | None) -> dict[str, Any]:
    """The columns of a run; `shock_g` is the larger of both sources."""
    shocks = [found.edge_acceleration_g, found.edge_acceleration_impact_velocity_g]
    known = [shock for shock in shocks if shock is not None]
    shock = max(known) if len(known) == len(shocks) else None
    outcome = found.outcome
    if tolerance_g is not None and outcome == "rocked":
        if shock is None:
            raise bad("tolerance_g needs the shock of the object", "give the block mass_kg and stiffness_n_m, or a cushion")
        outcome = "exceeded" if shock > tolerance_g else outcome
    facts = {name: getattr(found, name) for name in _RESPONSES if name != "shock_g"}
    return {"outcome": outcome, **facts, "shock_g": shock}


def _scales(scales: Numbers) -> Array:
    factors = doubles("scales", scales)
    if len(factors) == 0 or not np.isfinite(factors).all() or factors[0] <= 0 or (np.diff(factors) <= 0).any():
        raise bad("scales are not factors above 0 in growing order", "give them so, such as np.geomspace(0.2, 5, 15)")
    return factors


def _intensity(im: str, block: Block, motion: Motion) -> float:
    """The intensity of an unscaled motion."""
    if im == "pfa":
        return motion.pga_g
    if im == "pfv":
        return float(motion.measures()["pgv_m_s"])
    tangent = block.uplift_threshold_g
    if im == "acceleration_ratio":
        return motion.pga_g / tangent
    if im == "velocity_ratio":
        return block.frequency_parameter_rad_s * float(motion.measures()["pgv_m_s"]) / (9.80665 * tangent)
    period = _SPECTRAL.fullmatch(im) if isinstance(im, str) else None
    if period is None:
        raise bad(f"im {im!r} is not an intensity measure of a floor", f"give {', '.join(_UNITS)} or sa(0.5)")
    return float(motion.spectrum([number("the period of im", float(period[1]))]).psa_g[0])
