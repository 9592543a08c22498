"""What all results have in common."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

R = TypeVar("R", bound="Result")


class Result:
    """A result: every key of the command's JSON as an attribute, SI units, None where it is missing.

    Lists of numbers are NumPy arrays. `to_dict()` is the document as the command prints it.
    """

    schema: str
    warnings: list[str]
    _document: dict[str, Any]
    _tables: ClassVar[tuple[str, ...]] = ()

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document
        for key, value in document.items():
            self.__dict__[key] = np.array(value, "f8") if _is_numbers(value) else value

    @classmethod
    def _of(cls: type[R], text: str) -> R:
        return cls(json.loads(text))

    def to_dict(self) -> dict[str, Any]:
        """The document of the command, as `--json` prints it."""
        return self._document

    def to_pandas(self) -> Any:
        """The single values as a pandas Series."""
        import pandas

        return pandas.Series({key: value for key, value in self.to_dict().items() if not isinstance(value, list | dict)})

    def _shown(self) -> Iterator[tuple[str, str]]:
        for key, value in self.to_dict().items():
            if isinstance(value, list | dict):
                shown = f"{len(value)} values"
            else:
                shown = f"{value:.6g}" if isinstance(value, float) else str(value)
            yield key, shown

    def __repr__(self) -> str:
        shown = [f"{key}={value}" for key, value in self._shown() if key != "schema"]
        words = ", ".join(shown[:8])
        return f"<freestand.{type(self).__name__}: {words}, …>"

    def _repr_html_(self) -> str:
        import html

        shown = [(key, value) for key, value in self._shown() if key not in ("schema", "warnings")]
        rows = "".join(f"<tr><th>{html.escape(key)}</th><td>{html.escape(value)}</td></tr>" for key, value in shown)
        return f"<table><caption>{type(self).__name__}</caption><tbody>{rows}</tbody></table>{self._warnings_html()}"

    def _warnings_html(self) -> str:
        """The warnings: a result that is shown without them would say more than it knows."""
        import html

        items = "".join(f"<li>{html.escape(text)}</li>" for text in self.warnings)
        return f"<p>Warnings</p><ul>{items}</ul>" if items else ""


def _is_numbers(value: Any) -> bool:
    if not isinstance(value, list) or not value:
        return False
    return all(isinstance(one, int | float) and not isinstance(one, bool) for one in value)


class Columns(Mapping[str, "npt.NDArray[np.float64]"]):
    """Columns of equal length by name; each name ends in its unit."""

    def __init__(self, names: str, data: bytes) -> None:
        self._names = names.split(",")
        self._data = data

    @classmethod
    def _of_csv(cls, text: str) -> Columns:
        head, *lines = text.splitlines()
        values = np.array([[float(cell) for cell in line.split(",")] for line in lines], "f8")
        return cls(head, values.reshape(len(lines), -1).T.tobytes())

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        if name not in self._names:
            raise KeyError(f"{name}: the columns are {', '.join(self._names)}")
        rows = len(self._data) // (8 * len(self._names))
        return np.frombuffer(self._data, "f8", rows, 8 * rows * self._names.index(name))

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<{len(self._data) // 8 // len(self._names)} rows of {', '.join(self._names)}>"

    def to_pandas(self) -> Any:
        """A pandas DataFrame."""
        import pandas

        return pandas.DataFrame(dict(self))
