"""Tables of results, column by column."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _freestand
from ._convert import bad, number

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas
    import xarray

_DTYPES: dict[str, str] = {"number": "f8", "count": "i8", "flag": "u1", "text": "i4"}

_UNITS = [
    ("_m_s2", "m/s2"), ("_rad_s", "rad/s"), ("_n_m", "N/m"), ("_m_s", "m/s"), ("_rad", "rad"), ("_deg", "deg"),
    ("_kg", "kg"), ("_hz", "Hz"), ("_g", "g"), ("_n", "N"), ("_m", "m"), ("_s", "s"),
]  # fmt: skip


def unit_of(name: str) -> str:
    """The unit that a name ends in; "" for a ratio, a count or a text."""
    return next((unit for ending, unit in _UNITS if name.endswith(ending)), "")


#: Outcomes in which the object has fallen, onto the floor or against a wall.
_FALLEN = ("overturned", "leaned")
#: Outcomes whose numbers are not those of the whole motion.
_UNKNOWN = ("unresolved", "failed")
#: Columns of the object or of its motion, which no outcome changes.
_NOT_A_RESPONSE = ("height_m", "thickness_m", "ceiling_g", "scale_ratio", "intensity")


class _Column(NamedTuple):
    """A column: its kind, its values as bytes, and the texts that those of a text column count."""

    kind: str
    data: bytes
    texts: list[str]

    def values(self) -> npt.NDArray[Any]:
        return np.frombuffer(self.data, _DTYPES[self.kind])

    def missing(self) -> npt.NDArray[np.bool_]:
        values = self.values()
        missing: npt.NDArray[np.bool_] = values == 255
        if self.kind == "number":
            missing = np.isnan(values)
        elif self.kind != "flag":
            missing = values < 0
        return missing


class Table:
    """Rows of results, stored as columns.

    It has the Arrow PyCapsule interface: `pyarrow.table(t)`, `polars.DataFrame(t)` and duckdb take it
    as it is, without a copy. `column(name)` is a NumPy array. A missing value is null in Arrow, pandas
    and polars, NaN in an array of numbers and −1 in one of counts.
    """

    def __init__(self, columns: dict[str, _Column], dims: tuple[str, ...] = (), shape: tuple[int, ...] = ()) -> None:
        self._columns = columns
        self._dims = dims
        self._shape = shape
        #: Warnings about the validity of the results.
        self.warnings: list[str] = []
        #: Seconds in the solver alone, and objects × intervals of their motions; empty elsewhere.
        self.timing: dict[str, float] = {}

    @classmethod
    def _from_rows(cls, rows: Sequence[dict[str, Any]]) -> Table:
        """A table of the rows of a document. `overturned` among numbers is +∞: it ranks above all."""
        names = list(rows[0]) if rows else []
        return cls({name: _column([row.get(name) for row in rows]) for name in names})

    @property
    def column_names(self) -> list[str]:
        """The names of the columns; each ends in its unit."""
        return list(self._columns)

    @property
    def num_rows(self) -> int:
        """The number of rows."""
        first = next(iter(self._columns.values()), None)
        return 0 if first is None else len(first.values())

    def __len__(self) -> int:
        return self.num_rows

    def column(self, name: str) -> npt.NDArray[Any]:
        """A column as a NumPy array: numbers (NaN where missing), counts (−1) and flags (255) are views
        of the data, which is read-only; texts are an array of objects (None)."""
        if name not in self._columns:
            raise bad(f"there is no column {name}", f"the columns are {', '.join(self._columns)}")
        column = self._columns[name]
        if column.kind != "text":
            return column.values()
        texts: npt.NDArray[Any] = np.array([*column.texts, None], dtype=object)
        found: npt.NDArray[Any] = texts[column.values()]
        return found

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self.column(name)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The columns as an Arrow stream. The schema is always the table's own."""
        return _freestand.arrow_stream([(name, *column) for name, column in self._columns.items()])

    def _python_column(self, name: str) -> list[Any]:
        column = self._columns[name]
        values = column.values().tolist()
        missing = column.missing().tolist()
        if column.kind == "text":
            values = [None if none else column.texts[value] for value, none in zip(values, missing)]
        elif column.kind == "flag":
            values = [bool(value) for value in values]
        return [None if none else value for value, none in zip(values, missing)]

    def rows(self) -> Iterator[dict[str, Any]]:
        """Each row as a dictionary, as in the JSON of the command; missing values are None."""
        columns = [self._python_column(name) for name in self._columns]
        for values in zip(*columns):
            yield dict(zip(self._columns, values))

    def quantile(self, name: str, q: float = 0.5) -> npt.NDArray[np.float64]:
        """Quantile of a response over the motions, in which a fall ranks above every number.

        A median over only those motions that leave the object standing would be too small. This one
        is that of `freestand run`: linear between the ranks (type 7 of Hyndman and Fan, the default of NumPy).

        Parameters
        ----------
        name : str
            A column of numbers that depends on the motion, such as "uplift_m".
        q : float, default 0.5
            From 0 to 1; 0.5 is the median.

        Returns
        -------
        numpy.ndarray
            One value for each object (of a grid: heights × thicknesses) or, of `ida`, for each scale.
            `inf`: the object falls. NaN: it depends on runs that have no result.

        Examples
        --------
        >>> table = fs.spectrum(motions, [1.8], [0.3, 0.5, 0.9])
        >>> table.quantile("uplift_m").round(3)
        array([[  inf, 0.003, 0.   ]])
        """
        if "motion" not in self._dims or "outcome" not in self._columns:
            raise bad("this table has no motions to rank", "take the table of freestand.spectrum or freestand.ida")
        values = self.column(name)
        if self._columns[name].kind not in ("number", "count") or name in _NOT_A_RESPONSE:
            raise bad(f"{name} is not a number that depends on the motion", "name a column such as uplift_m")
        share = number("q", q)
        if not 0 <= share <= 1:
            raise bad(f"q is {share:g}, which is no share", "give q from 0 to 1: 0.5 is the median")
        outcome, missing = self.column("outcome"), self._columns[name].missing()
        missing = (missing | np.isin(outcome, _UNKNOWN) | (outcome == None)).reshape(self._shape)  # noqa: E711
        ranked = np.where(np.isin(outcome, _FALLEN), np.inf, values.astype("f8")).reshape(self._shape)
        missing &= np.isfinite(ranked) | np.isnan(ranked)
        axis = self._dims.index("motion")
        low, high = (_ranked(np.where(missing, bound, ranked), share, axis) for bound in (-np.inf, np.inf))
        return np.where(low == high, high, np.nan)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas DataFrame; texts are categories."""
        import pandas

        series: dict[str, Any] = {}
        for name, column in self._columns.items():
            values, missing = column.values(), column.missing()
            if column.kind == "text":
                series[name] = pandas.Categorical.from_codes(values.tolist(), categories=column.texts)
            elif column.kind == "number" or not missing.any():
                series[name] = values.astype(bool) if column.kind == "flag" else values
            else:
                kind = "boolean" if column.kind == "flag" else "Int64"
                series[name] = pandas.array(self._python_column(name), dtype=kind)
        return pandas.DataFrame(series)

    def to_xarray(self) -> xarray.Dataset:
        """An xarray Dataset with the dimensions of the spectrum (motion, height_m, thickness_m; of pairs:
        motion, object); each variable has its unit in `attrs`."""
        import xarray

        if not self._dims:
            raise bad("this table has no grid", "use to_pandas().to_xarray()")
        coords: dict[str, Any] = {}
        positions = dict(zip(self._dims, range(len(self._dims))))
        for name in dict.fromkeys(("motion", *self._dims, "height_m", "thickness_m")):
            if name not in self._columns:
                continue
            values = self.column(name).reshape(self._shape)
            dim = name if name in positions else "object"
            first = tuple(slice(None) if one == dim else 0 for one in self._dims)
            coords[name] = (dim, values[first], {"units": unit_of(name)})
        variables = {
            name: (self._dims, self.column(name).reshape(self._shape), {"units": unit_of(name)})
            for name in self._columns
            if name not in coords
        }
        return xarray.Dataset(variables, coords)

    def _of_motion(self, index: int) -> Table:
        """The rows of one motion."""
        rows = self.num_rows // self._shape[0]
        of = slice(index * rows, (index + 1) * rows)
        columns = {name: one._replace(data=one.values()[of].tobytes()) for name, one in self._columns.items()}
        return Table(columns, self._dims, (1, *self._shape[1:]))

    def __repr__(self) -> str:
        return f"<freestand.Table: {self.num_rows} rows of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        import html

        shown = 10
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self._columns)
        columns = [self._python_column(name)[:shown] for name in self._columns]
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(_short(value))}</td>" for value in row) + "</tr>" for row in zip(*columns)
        )
        more = f"<p>and {self.num_rows - shown} more rows</p>" if self.num_rows > shown else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _ranked(values: npt.NDArray[np.float64], share: float, axis: int) -> npt.NDArray[np.float64]:
    """A quantile by linear interpolation between the ranks; infinite where it needs an infinite value."""
    ranked = np.sort(values, axis=axis)
    last = ranked.shape[axis] - 1
    position = share * last
    below, part = int(position), position % 1
    lower: npt.NDArray[np.float64] = np.take(ranked, below, axis)
    if part == 0:
        return lower
    upper = np.take(ranked, min(below + 1, last), axis)
    with np.errstate(invalid="ignore"):
        between = lower + part * (upper - lower)
    return np.where(np.isinf(upper), upper, np.where(np.isinf(lower), lower, between))


def _short(value: object) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _column(values: list[Any]) -> _Column:
    """A column of values as a document has them."""
    known = [value for value in values if value is not None]
    if known and all(isinstance(value, bool) for value in known):
        flags = bytes(255 if value is None else int(value) for value in values)
        return _Column("flag", flags, [])
    if known and all(_is_number(value) for value in known) and any(value != "overturned" for value in known):
        numbers = [np.nan if value is None else np.inf if value == "overturned" else float(value) for value in values]
        return _Column("number", np.array(numbers, "f8").tobytes(), [])
    code_of: dict[str, int] = {}
    codes = [-1 if value is None else code_of.setdefault(str(value), len(code_of)) for value in values]
    return _Column("text", np.array(codes, "i4").tobytes(), list(code_of))


def _is_number(value: object) -> bool:
    return value == "overturned" or (isinstance(value, int | float) and not isinstance(value, bool))
