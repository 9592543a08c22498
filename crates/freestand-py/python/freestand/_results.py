"""The results of requests, named as their commands."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _freestand
from ._base import Columns, Result
from ._convert import Array, Numbers, PathLike, bad, doubles
from ._table import Table

if TYPE_CHECKING:
    from pathlib import Path

    import matplotlib.axes
    import numpy.typing as npt
    import xarray

    from ._motion import Motion

_IMPACT = np.dtype(
    [(name, "f8") for name in ("time_s", "omega_before_rad_s", "omega_after_rad_s", "edge_acceleration_impact_velocity_g")]
)
_WALL_IMPACT = np.dtype(
    [(name, "f8") for name in ("side", "time_s", "omega_before_rad_s", "omega_after_rad_s", "speed_m_s", "acceleration_g")]
)


def _structured(rows: list[dict[str, Any]]) -> npt.NDArray[Any]:
    """Rows of a document as a structured array: texts as texts, None as NaN."""
    if not rows:
        return np.zeros(0, [("time_s", "f8")])
    is_text = {name: any(isinstance(row[name], str) for row in rows) for name in rows[0]}
    dtype = [(name, "U16" if text else "f8") for name, text in is_text.items()]
    missing = {name: "" if text else np.nan for name, text in is_text.items()}
    return np.array([tuple(missing[k] if v is None else v for k, v in row.items()) for row in rows], dtype)


class RockResult(Result):
    """The response of one object to one motion.

    `outcome` is `no-uplift`, `rocked`, `leaned`, `overturned` or, where `duration_s` ended it while the object
    was neither at rest nor down, `unresolved`. Lengths in m, rotations in rad, times in s;
    `edge_acceleration_g` is the shock from the largest uplift by the paper's Eq. (5).
    """

    outcome: str
    stopped: str
    end_time_s: float
    peak_rotation_rad: float
    peak_rotation_ratio: float
    peak_rotation_time_s: float | None
    uplift_m: float
    cg_rise_m: float
    first_uplift_time_s: float | None
    uplift_count: int
    impact_count: int
    wall_angle_left_rad: float | None
    wall_angle_right_rad: float | None
    wall_impact_count: int
    wall_speed_max_m_s: float | None
    wall_acceleration_g: float | None
    wall_impulse_max_n_s: float | None
    leaning: bool
    passed_alpha_time_s: float | None
    overturn_time_s: float | None
    rest_time_s: float | None
    at_rest: bool
    friction_needed_ratio: float | None
    impact_friction_needed_ratio: float
    restitution_ratio: float
    final_rotation_rad: float
    final_omega_rad_s: float
    half_diagonal_m: float
    slenderness_angle_rad: float
    frequency_parameter_rad_s: float
    uplift_threshold_g: float
    model: str
    base: str
    accuracy: str
    edge_acceleration_g: float | None
    edge_acceleration_impact_velocity_g: float | None
    ceiling_g: float | None
    steps: int
    evaluations: int
    notes: list[str]

    #: time_s, theta_rad, omega_rad_s, uplift_m, base_accel_m_s2 (arrays of one length); None if not recorded.
    history: Columns | None
    _motion: Motion | None

    def __init__(self, document: dict[str, Any], history: tuple[str, bytes] | None, motion: Motion | None = None) -> None:
        self._document = document
        self.__dict__.update({key: value for key, value in document.items() if key not in ("impacts", "wall_impacts")})
        self.history = None if history is None else Columns(*history)
        self._motion = motion

    @property
    def impacts(self) -> npt.NDArray[Any]:
        """A structured array, one row for each impact: time_s, omega_before_rad_s, omega_after_rad_s,
        edge_acceleration_impact_velocity_g (NaN without a cushion)."""
        rows = self._document.get("impacts", ())
        return _structured(rows) if rows else np.zeros(0, _IMPACT)

    @property
    def wall_impacts(self) -> npt.NDArray[Any]:
        """A structured array, one row for each impact on a wall; side is 1 (right) or −1 (left)."""
        sides = {"right": 1.0, "left": -1.0}
        rows = [{**row, "side": sides[row["side"]]} for row in self._document.get("wall_impacts", ())]
        return _structured([{name: row[name] for name in _WALL_IMPACT.names or ()} for row in rows]) if rows else np.zeros(0, _WALL_IMPACT)

    def to_xarray(self) -> xarray.Dataset:
        """The history as an xarray Dataset over time_s, with the single values in `attrs`."""
        import xarray

        if self.history is None:
            raise bad("the history was not recorded", "call rock with history=True")
        time = ("time_s", self.history["time_s"], {"units": "s"})
        variables = {name: ("time_s", values) for name, values in self.history.items() if name != "time_s"}
        attrs = {key: value for key, value in self._document.items() if isinstance(value, int | float | str)}
        return xarray.Dataset(variables, {"time_s": time}, attrs)

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Rotation, floor motion and impacts against time: `freestand.plot.rock`."""
        from . import plot

        return plot.rock(self, ax=ax)


def _write(path: PathLike, text: str) -> None:
    with open(os.fspath(path), "w", encoding="utf-8") as file:
        file.write(text)


class ShockResult(Result):
    """The shock of one landing; `edge_acceleration_g` is that of the landing edge."""

    scenario: str
    model: str
    energy_source: str
    drop_acceleration_g: float
    edge_acceleration_g: float
    edge_acceleration_m_s2: float
    amplification_ratio: float
    landing_ratio: float
    effective_mass_kg: float
    edge_velocity_m_s: float
    angular_velocity_rad_s: float
    contact_distance_m: float
    half_diagonal_m: float
    slenderness_angle_rad: float
    cg_rise_m: float
    uplift_m: float | None
    rotation_rad: float | None
    stiffness_n_m: float
    law: str
    cushion: str
    pulse_duration_s: float
    velocity_change_m_s: float
    compression_m: float
    balance_rise_m: float
    ceiling_g: float | None
    impact_friction_needed_ratio: float | None
    models: dict[str, Any]
    at: dict[str, Any] | None
    tolerance_g: float | None
    tolerance_edge_lift_m: float | None
    damage_boundary_tests: Any
    damage_boundary: Any
    demand_capacity: dict[str, Any] | None
    demand_capacity_ratio: float | None
    governing: str | None
    verdict: str
    max_stiffness_n_m: float | None
    notes: list[str]


class DropTestResult(Result):
    """A pad from its drop tests. It can be given as `cushion`, with `pads_per_edge`."""

    tests: list[dict[str, Any]]
    pooled: dict[str, Any]
    failed: list[Any]

    def __init__(self, document: dict[str, Any], cushion_toml: str | None, loops: Sequence[str]) -> None:
        super().__init__(document)
        #: The pad as the text of a cushion file; None if the tests give no pad.
        self.cushion_toml = cushion_toml
        #: For each test, its force–compression loop as columns.
        self.loops = [Columns._of_csv(loop) for loop in loops]

    @property
    def stiffness_n_m(self) -> float | None:
        """Stiffness of one pad [N/m], pooled over the tests."""
        return _number(self._document["pooled"]["stiffness_n_m"])

    @property
    def ci95_n_m(self) -> Array | None:
        """Its 95 % interval [N/m]."""
        found = self._document["pooled"]["ci95_n_m"]
        return None if found is None else np.array(found, "f8")

    def save(self, path: PathLike) -> None:
        """Writes the pad as a cushion file (TOML), which every command accepts."""
        if self.cushion_toml is None:
            raise bad("these tests give no pad", "see `pooled[\"reason\"]` and the flags of the tests")
        _write(path, self.cushion_toml)

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Force against compression of each test: `freestand.plot.loop`."""
        from . import plot

        return plot.loop(self, ax=ax)


def _number(value: Any) -> float | None:
    return None if value is None else float(value)


class StaticTestResult(Result):
    """Static stiffness of a pad."""


class ShockSpectrumResult(Result):
    """A shock response spectrum (ISO 18431-4)."""

    kind: str
    peak: str
    damping_ratio: float
    quality_factor_ratio: float
    upsample: bool
    spectra: list[dict[str, Any]]
    timing: dict[str, Any]

    @property
    def frequencies_hz(self) -> Array:
        """Frequencies of the oscillators [Hz]."""
        return np.array(self._document["spectra"][0]["frequencies_hz"], "f8")

    @property
    def values(self) -> Array:
        """Peak responses, one for each frequency, in `unit`."""
        return np.array(self._document["spectra"][0]["values"], "f8")

    @property
    def unit(self) -> str:
        """The unit of `values`."""
        return str(self._document["spectra"][0]["unit"])


class CodeSpectrumResult(Result):
    """The elastic response spectrum of a code, for 5 % damping."""

    code: str
    site: str | None
    place: dict[str, Any] | None
    hazard_factor: float | None
    return_period_years: int | None
    kpz_g: float | None
    minimum_kpz_governs: bool | None
    facts: list[dict[str, Any]]
    corner_periods_s: Array
    periods_s: Array
    sa_g: Array
    vertical_sa_g: Array | None
    parts: dict[str, Any] | None


class MotionSpectrumResult(Result):
    """The response spectrum of a motion: `periods_s`, `sd_m`, `psv_m_s`, `psa_g`, `sa_g`."""

    path: str
    name: str
    upsample: int
    processing: list[str]
    scale_ratio: float
    periods_s: Array
    damping_ratio: float
    sd_m: Array
    psv_m_s: Array
    psa_g: Array
    sa_g: Array
    more: list[Any]


class SynthResult(Result):
    """Motions that fit a target."""

    code: str
    site: str
    place: dict[str, Any]
    hazard_factor: float
    return_period_years: int
    kpz_g: float
    minimum_kpz_governs: bool
    facts: list[dict[str, Any]]
    seed: int
    generator: str
    method: str
    motions: list[dict[str, Any]]

    def __init__(self, document: dict[str, Any], records: list[Motion]) -> None:
        super().__init__(document)
        #: The motions.
        self.records = records


class FloorResult(Result):
    """The floors of a building: `levels` of the document, and their motions."""

    motion: str
    processing: list[str]
    building_height_m: float
    model: str
    damping: str
    damping_ratio: float
    shear_flexure_ratio: float
    pga_g: float
    modes: list[dict[str, Any]]
    across: Any
    levels: list[dict[str, Any]]
    motions: list[dict[str, Any]]
    spectra: Any
    code_clause: str | None

    def __init__(self, document: dict[str, Any], floors: list[list[Motion]]) -> None:
        super().__init__(document)
        #: `floors[i][j]` is the motion of level j under motion i.
        self.floors = floors


class ObjectResult(Result):
    """Whether an earthquake rocks one object and whether it falls over; `answer` is the sentence."""

    answer: str
    answer_kind: str
    earthquake: str
    building: Any
    place_is_assumed: bool
    building_is_assumed: bool
    decision: str
    why: str
    close_call: bool
    worlds_needed: int | None
    is_round: bool
    body: dict[str, Any] | None
    clearance_needed_m: float | None
    clearance_m_median: float | None
    clearance_m_p84: float | None
    clearance_m_p98: float | None
    p_overturn_locked: float | None
    falls: str
    shock: str
    motions: int
    motions_lifted: int
    motions_overturned: int
    p_overturn: float
    p_overturn_low: float
    p_overturn_high: float
    accepted_ratio: float
    accepted_for: str
    confidence: float
    floor_acceleration_g: dict[str, Any]
    model: str | None
    lift_acceleration_g: float
    motions_leaning: int | None
    p_lean: float | None
    wall_strike_share: float | None
    wall_speed_m_s_median: float | None
    wall_acceleration_g_median: float | None
    slide_m_median: float | None
    slide_m_p84: float | None
    stop_share: float | None
    trip_speed_m_s: float | None
    trip_margin: float | None
    uplift_m_max: float | None
    uplift_m_median: float | str
    rotation_ratio_median: float | str
    edge_acceleration_g_median: float | None
    edge_acceleration_g_p16: float | None
    edge_acceleration_g_p84: float | None
    edge_acceleration_compliant_g_median: float | None
    edge_acceleration_g_max: float | None
    landing_acceleration_g_max: float | None
    ceiling_g: float | None
    pulse_duration_s: float | None
    velocity_change_m_s: float | None
    pad_uplift_threshold_g: float | None
    rocking_frequency_hz: float | None
    tolerance_g: float | None
    tolerance_duration_s: float | None
    demand_capacity_ratio: float | None
    p_exceed: float | None
    p_exceed_low: float | None
    p_exceed_high: float | None
    model_bias: bool
    models_agree: bool | None
    clearance_m: float
    sliding: str
    level_ratio: float | None
    place: Any
    scales: list[dict[str, Any]] | None
    assumptions: list[str]


class RestrainResult(Result):
    """The force that the code asks of a restraint, and its anchors."""

    code: str | None
    clause: str
    force_n: float
    force_ratio: float
    acts_at_height_m: float
    overturning_moment_n_m: float
    resisting_moment_n_m: float
    axis: str
    anchor_tension_n: float
    anchor_tension_concrete_n: float
    per_anchor: dict[str, Any]
    anchors_per_edge: int
    pivot: str
    weight_lever_m: float
    anchor_lever_m: float
    anchor: str | None
    anchor_capacity_n: float | None
    anchor_shear_capacity_n: float | None
    demand_capacity_ratio: float | None
    bracket_height_m: float
    bracket_force_n: float
    bracket_base_shear_n: float
    held_weight_ratio: float
    overstrength_ratio: float
    formula: str
    level_ratio: float
    place: dict[str, Any] | None
    factors: dict[str, Any]
    assumptions: list[str]
    component: str | None
    anchor_inset_m: float
    to_confirm: list[dict[str, Any]]
    others: list[Any]
    sheet: Any

    def __init__(self, document: dict[str, Any], sheet: str) -> None:
        super().__init__(document)
        #: A sheet to print and sign (HTML).
        self.sheet_html = sheet

    def save(self, path: PathLike) -> None:
        """Writes the sheet (HTML)."""
        _write(path, self.sheet_html)


class FragilityResult(Result):
    """Fragilities of objects: `objects`, each with its `curves`."""

    version: str
    seed: int
    inputs: list[dict[str, Any]]
    objects: list[dict[str, Any]]

    def __init__(self, document: dict[str, Any], seen: str) -> None:
        super().__init__(document)
        self._seen = seen

    @property
    def empirical(self) -> Table:
        """The share of runs that reached each limit state at each intensity, with its 95 % interval."""
        return Table._from_rows(_csv_rows(self._seen.splitlines()))

    @property
    def curves(self) -> Table:
        """A row for each object and limit state: `kind`, `median`, `beta`, the ends of their 95 % intervals, and
        the unit of the intensity."""
        return Table._from_rows([_curve_row(item, one) for item in self._document["objects"] for one in item["curves"]])

    def __repr__(self) -> str:
        rows = [_curve_words(row) for row in self.curves.rows()]
        shown = rows[:20] + [f"and {len(rows) - 20} more curves"] * (len(rows) > 20)
        return "\n".join([f"<freestand.FragilityResult: {len(self._document['objects'])} objects", *shown]) + ">"

    def _repr_html_(self) -> str:
        return f"<p>FragilityResult</p>{self.curves._repr_html_()}{self._warnings_html()}"

    def curve(self, id: str, limit_state: str) -> dict[str, Any]:
        """The curve of an object: `kind`, `median`, `beta`, their intervals, `lower`, `upper`."""
        curves = [one for item in self._document["objects"] if item["id"] == id for one in item["curves"]]
        found = next((one for one in curves if one["limit_state"] == limit_state), None)
        if found is None:
            known = sorted({f"{item['id']}: {one['limit_state']}" for item in self._document["objects"] for one in item["curves"]})
            raise bad(f"there is no curve of {id} for {limit_state}", f"the curves are {', '.join(known[:12])}")
        return dict(found)

    def probability(self, id: str, limit_state: str, intensity: Numbers) -> Array:
        """The probability that an object reaches a limit state at these intensities; NaN where no lognormal curve fits."""
        curve, at = self.curve(id, limit_state), doubles("intensity", intensity)
        if curve["kind"] != "lognormal":
            return np.full(len(at), np.nan)
        return np.frombuffer(_freestand.lognormal(curve["median"], curve["beta"], at.tobytes()), "f8")

    def plot(self, id: str | None = None, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """The curves of an object with the observed shares of runs: `freestand.plot.fragility`."""
        from . import plot

        return plot.fragility(self, id, ax=ax)


def _curve_row(item: dict[str, Any], curve: dict[str, Any]) -> dict[str, Any]:
    median, beta = (curve[name] or (None, None) for name in ("median_ci95", "beta_ci95"))
    unit = item["im_unit"] or None
    return {
        "id": item["id"], "limit_state": curve["limit_state"], "kind": curve["kind"], "im": item["im"], "im_unit": unit,
        "at": item["at"], "median": curve["median"], "median_ci95_low": median[0], "median_ci95_high": median[1],
        "beta": curve["beta"], "beta_ci95_low": beta[0], "beta_ci95_high": beta[1],
        "lower": curve["lower"], "upper": curve["upper"],
    }  # fmt: skip


def _curve_words(row: dict[str, Any]) -> str:
    unit = f" {row['im_unit']}" if row["im_unit"] else ""
    said = [f"{name} {row[name]:.4g}{mark}" for name, mark in (("median", unit), ("beta", "")) if row[name] is not None]
    said += [f"{name} {row[name]:.4g}{unit}" for name in ("lower", "upper") if row[name] is not None]
    return f"  {row['id']}, {row['limit_state']} ({row['im']} of the {row['at']}): {', '.join([row['kind'], *said])}"


class IdaResult(Result):
    """Incremental dynamic analysis of an object: `runs`, one row for each motion and scale.

    `im` and `im_unit` are the measure of intensity and its unit, `motions` the names.
    """

    im: str
    im_unit: str
    motions: list[str]
    scales_ratio: Array
    #: The outcome and the responses of each run: motion, scale_ratio, intensity, outcome, peak_rotation_rad, …
    runs: Table

    def __init__(
        self, im: str, unit: str, motions: list[str], scales: Array, rows: list[dict[str, Any]], warnings: list[str]
    ) -> None:
        super().__init__(
            {"schema": "freestand.ida/1", "im": im, "im_unit": unit, "motions": motions,
             "scales_ratio": scales.tolist(), "runs": rows, "warnings": warnings}
        )  # fmt: skip
        table = Table._from_rows(rows)
        self.runs = Table(table._columns, ("motion", "scale_ratio"), (len(motions), len(scales)))
        self.runs.warnings = warnings

    def quantile(self, name: str, q: float = 0.5) -> Array:
        """Quantile of a response over the motions at each scale; `inf` where it falls: `Table.quantile`."""
        return self.runs.quantile(name, q)

    def capacities(self, limit_state: str = "overturns") -> Array:
        """The lowest intensity at which each motion reaches a limit state.

        Parameters
        ----------
        limit_state : str, default "overturns"
            "rocks", "exceeds" (with a tolerance) or "overturns", each or worse.

        Returns
        -------
        numpy.ndarray
            One intensity for each motion; `inf` if no scale reaches it, NaN if that depends on an unresolved run.
        """
        reached = _REACHED.get(limit_state)
        if reached is None:
            raise bad(f"there is no limit state {limit_state}", f"name one of {', '.join(_REACHED)}")
        outcome = self.runs.column("outcome").reshape(self.runs._shape)
        intensity = self.runs.column("intensity").reshape(self.runs._shape)
        at = np.where(np.isin(outcome, reached), intensity, np.inf).min(axis=1)
        unknown = np.where(outcome == "unresolved", intensity, np.inf).min(axis=1)
        found: Array = np.where(unknown < at, np.nan, at)
        return found

    def fragility(
        self, *, fit: str | None = None, bootstrap: int | None = None, seed: int | None = None, threads: int | None = None
    ) -> FragilityResult:
        """Lognormal curves fitted to the runs: the function `fragility`, whose arguments these are.

        The object is called "object".
        """
        import os
        import tempfile

        from ._requests import fragility

        unit = f" [{self.im_unit}]" if self.im_unit else ""
        with tempfile.TemporaryDirectory(prefix="freestand-") as folder:
            path = os.path.join(folder, "outcomes.csv")
            _write(path, "".join(_outcome_lines(f"{self.im}{unit}", self.runs)))
            at = "floor" if self.im.startswith("sa(") else None
            return fragility(path, at=at, fit=fit, bootstrap=bootstrap, seed=seed, threads=threads)

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """The largest rotation against the intensity: `freestand.plot.ida`."""
        from . import plot

        return plot.ida(self, ax=ax)

    def _repr_html_(self) -> str:
        return f"<p>IdaResult</p>{self.runs._repr_html_()}{self._warnings_html()}"


_REACHED = {
    "rocks": ("rocked", "exceeded", "leaned", "overturned"),
    "exceeds": ("exceeded", "leaned", "overturned"),
    "overturns": ("leaned", "overturned"),
}


def _outcome_lines(heading: str, runs: Table) -> Iterable[str]:
    """The table of outcomes that `fragility` reads."""
    import csv
    import io

    def line(*cells: object) -> str:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerow(cells)
        return text.getvalue()

    yield line("object", "motion", heading, "outcome")
    for row in runs.rows():
        outcome = "overturned" if row["outcome"] == "leaned" else row["outcome"]
        yield line("object", row["motion"], repr(row["intensity"]), outcome)


class RiskResult(Result):
    """How often objects fail, and what that costs."""

    version: str
    inputs: list[dict[str, Any]]
    years: float
    currency: str | None
    hazard: dict[str, Any]
    assumptions: list[str]
    objects: list[dict[str, Any]]
    expected_annual_loss: float | None
    expected_annual_loss_lower: float | None
    expected_annual_loss_upper: float | None
    is_bound: bool
    is_at_least: bool
    not_run: list[dict[str, Any]]
    portfolio: dict[str, Any] | None
    ranking: Any
    plan: Any


class RestrainListResult(Result):
    """The forces on the restraints of all objects of a list; `table` has a row for each object."""

    objects: int
    held: int
    assumptions: list[str]
    to_confirm: list[dict[str, Any]]
    problems: list[str]
    rows: list[dict[str, Any]]
    sheet: Any

    def __init__(self, document: dict[str, Any], sheets: str) -> None:
        super().__init__(document)
        #: A sheet for each object to print and sign (HTML).
        self.sheets_html = sheets

    def save(self, path: PathLike) -> None:
        """Writes the sheets (HTML)."""
        _write(path, self.sheets_html)

    @property
    def table(self) -> Table:
        """The rows as a table; an object without a force says why in `reason`."""
        return Table._from_rows(self._document["rows"])


class InventoryCheck(Result):
    """How a list was understood; `problems` are all doubts and errors."""

    path: str
    sha256: str
    sheet: str | None
    header_row: int
    counts: dict[str, Any]
    columns: list[dict[str, Any]]
    carried: list[str]
    first_rows: list[dict[str, Any]]
    objects: list[dict[str, Any]]
    left_out: list[dict[str, Any]]
    problems: list[dict[str, Any]]
    marked_copy: Any

    @property
    def ok(self) -> bool:
        """Whether no cell has an error."""
        return all(problem["severity"] != "error" for problem in self._document["problems"])

    @property
    def table(self) -> Table:
        """The objects, in SI, as a table."""
        return Table._from_rows(self._document["objects"])


class ValidateResult(Result):
    """Table I of the paper and the closed forms."""

    table_one_gravity_m_s2: float
    table_one: list[dict[str, Any]]
    checks: list[dict[str, Any]]

    @property
    def ok(self) -> bool:
        """Whether every check holds."""
        return all(check["ok"] for check in self._document["checks"])


class _Folder(Result):
    """A result whose files are in a folder."""

    _folder: Path

    def _in(self, folder: Path, own: Path | None) -> None:
        """The folder, and the temporary one around it that is removed with the result."""
        self._folder = folder
        if own is not None:
            import shutil
            import weakref

            weakref.finalize(self, shutil.rmtree, own, ignore_errors=True)

    def save(self, folder: PathLike) -> Path:
        """Copies the files of the command into a folder, which must be new or empty."""
        import shutil
        from pathlib import Path

        target = Path(folder)
        if target.exists() and (not target.is_dir() or any(target.iterdir())):
            raise bad(f"{target} is not an empty folder", "name a new folder")
        shutil.copytree(self._folder, target, dirs_exist_ok=True)
        return target

    def _read(self, name: str) -> Table:
        with open(self._folder / name, newline="", encoding="utf-8") as file:
            return Table._from_rows(_csv_rows(file))


def _csv_rows(lines: Iterable[str]) -> list[dict[str, Any]]:
    import csv

    return [{key: _cell(text) for key, text in row.items()} for row in csv.DictReader(lines)]


def _cell(text: str) -> str | float | bool | None:
    if text in ("", "true", "false"):
        return None if text == "" else text == "true"
    try:
        return float(text)
    except ValueError:
        return text


class AssessResult(_Folder):
    """Verdicts about an inventory."""

    #: A row for each object: the columns of objects.csv, and `row` of the list. `overturned` is +∞.
    objects: Table

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document)
        self.objects = Table._from_rows(document["rows"])

    def _repr_html_(self) -> str:
        return f"<p>AssessResult</p>{self.objects._repr_html_()}{self._warnings_html()}"

    def report_html(self) -> str:
        """The report, which loads nothing from a network."""
        return (self._folder / "report.html").read_text(encoding="utf-8")


class RunResult(_Folder):
    """A study: the keys of summary.json."""

    @property
    def rows(self) -> Table:
        """The shock of every object under every motion on every level: srs.csv."""
        return self._read("srs.csv")

    @property
    def uplift_rows(self) -> Table:
        """The uplift of every object under every motion on every level: urs.csv."""
        return self._read("urs.csv")


def version() -> str:
    """The version of freestand."""
    return _freestand.version()
