"""Values of Python as freestand takes them: arrays, texts by key, studies, inventories."""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
import warnings as python_warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from ._errors import BadValue, FreestandError, FreestandWarning, Problem

if TYPE_CHECKING:
    from pathlib import Path

    import numpy.typing as npt

Array: TypeAlias = "npt.NDArray[np.float64]"
Numbers: TypeAlias = "npt.ArrayLike"
PathLike: TypeAlias = "str | os.PathLike[str]"
Given: TypeAlias = "dict[str, Any]"


def bad(message: str, hint: str) -> BadValue:
    """A wrong argument, with its remedy."""
    return BadValue([(message, None, None, hint)])


def given(**values: Any) -> Given:
    """The arguments that were given: freestand's own defaults count for the others."""
    return {name: value for name, value in values.items() if value is not None}


def flag(name: str, value: bool | None) -> bool | None:
    """True, False or not given."""
    if value is None or isinstance(value, bool | np.bool_):
        return None if value is None else bool(value)
    raise bad(f"{name} must be True or False, not {value!r}", "give one of them")


def doubles(name: str, values: Numbers) -> Array:
    """One-dimensional, contiguous, aligned doubles in the byte order of the machine.

    Strided, misaligned, read-only and big-endian arrays, float32 and integers, lists and one number
    are accepted; complex numbers, texts and objects are not.
    """
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise bad(f"{name} has masked values", f"fill them first, for example with {name}.filled(0)")
    try:
        array = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise bad(f"{name} is not an array of numbers: {error}", f"give {name} as a list or an array of numbers") from None
    if array.dtype.kind not in "iuf":
        raise bad(f"{name} is an array of {array.dtype}, not of numbers", f"give {name} as a list or an array of numbers")
    if array.ndim == 0:
        array = array.reshape(1)
    if array.ndim != 1:
        raise bad(f"{name} has the shape {array.shape}, not one dimension", f"give one row or column of {name}")
    return np.require(array, "f8", ["C", "A"])


def data(name: str, values: Numbers | None) -> bytes | None:
    """The numbers as bytes for the Rust extension: at least one number, all of them finite."""
    if values is None:
        return None
    array = doubles(name, values)
    if len(array) == 0:
        raise bad(f"{name} is empty", f"give at least one value in {name}")
    finite = np.isfinite(array)
    if not finite.all():
        at = int(np.argmin(finite))
        raise bad(f"{name} holds {array[at]} (value {at}, counted from 0)", f"give finite numbers in {name}")
    return array.tobytes()


def number(name: str, value: Any) -> float:
    """A number. Strings and booleans, which Python would convert, are refused."""
    if not isinstance(value, bool | np.bool_ | str | bytes):
        with contextlib.suppress(TypeError, ValueError):
            return float(value)
    raise bad(f"{name} must be a number, not {value!r}", f"give {name} as a number in SI units")


def plain(value: Any) -> Any:
    """A NumPy number or zero-dimensional array as a Python number, which can be hashed."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return value.item()
    return value


def whole(name: str, value: Any, least: int, most: int | None = None) -> int | None:
    """A Python or NumPy integer within limits; None if it was not given."""
    if value is None:
        return None
    is_whole = hasattr(value, "__index__") and not isinstance(value, bool) and np.ndim(value) == 0
    if not is_whole or value.__index__() < least or (most is not None and value.__index__() > most):
        hint = f"give {name} as an int, or leave it out"
        limits = f"at least {least}" if most is None else f"from {least} to {most}"
        raise bad(f"{name} must be a whole number, {limits}, not {value!r}", hint)
    return int(value.__index__())


def of_kind(name: str, value: Any, kind: type | tuple[type, ...], expected: str) -> None:
    """Refuses an argument that is neither None nor an object of these classes."""
    if value is not None and not isinstance(value, kind):
        raise bad(f"{name} must be {expected}, not {type(value).__name__}", f"give {name} as {expected}")


def path_text(name: str, path: PathLike) -> str:
    """A path as a string; `name` is its argument."""
    text = os.fspath(path) if isinstance(path, str | os.PathLike) else None
    if not isinstance(text, str):
        raise bad(f"{name} must be a path, not {path!r}", f"give {name} as a str or a pathlib.Path")
    if "\0" in text:
        raise bad(f"{name} has a NUL character in {text!r}", f"give {name} as the path of a file")
    return text


def paths_text(name: str, paths: PathLike | Iterable[PathLike]) -> list[str]:
    """One or more paths as strings; `name` is their argument."""
    if isinstance(paths, str | os.PathLike):
        return [path_text(name, paths)]
    # Both could be iterated over: an open file yields lines, and bytes yield numbers.
    if not isinstance(paths, Iterable) or isinstance(paths, bytes | io.IOBase):
        raise bad(f"{name} must be one or more paths, not {paths!r}", f"give {name} as a path or a list of paths")
    return [path_text(name, path) for path in paths]


def words(**values: Any) -> Given | None:
    """Arguments that are read by key: paths as texts, arrays as lists."""
    plain: Given = {}
    for name, value in given(**values).items():
        if isinstance(value, os.PathLike):
            value = os.fspath(value)
        elif isinstance(value, np.ndarray | tuple):
            value = list(value)
        plain[name] = value
    return plain or None


#: Where the warnings of many calls are kept, until they are shown together.
_KEPT: ContextVar[list[str] | None] = ContextVar("_KEPT", default=None)


@contextlib.contextmanager
def warnings_kept() -> Iterator[list[str]]:
    """Keeps the warnings of the calls inside, for one that is made of many."""
    kept: list[str] = []
    token = _KEPT.set(kept)
    try:
        yield kept
    finally:
        _KEPT.reset(token)


def warn(messages: Sequence[str]) -> None:
    """Shows warnings of a result at the line that called freestand."""
    if not messages:
        return
    kept = _KEPT.get()
    if kept is not None:
        kept.extend(messages)
        return
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    for message in messages:
        python_warnings.warn(message, FreestandWarning, stacklevel=level)


def study(source: PathLike | Mapping[str, Any] | None) -> Given:
    """A study: a path, its TOML text, or a dictionary of its tables."""
    if source is None:
        return {}
    if isinstance(source, Mapping):
        return {"study_text": toml(source)}
    if isinstance(source, str) and ("\n" in source or "=" in source):
        return {"study_text": source}
    if not isinstance(source, str | os.PathLike):
        raise bad(f"study cannot be of type {type(source).__name__}", "give a path, TOML text or a dictionary")
    if source == "":
        raise bad("study is an empty string", "give a path, TOML text or a dictionary")
    return {"study": path_text("study", source)}


def study_file(source: PathLike | Mapping[str, Any] | None) -> dict[str, tuple[PathLike | None, str | None]]:
    """A study as a file of a request: its path, or its text."""
    found = study(source)
    return {"study": (found.get("study"), found.get("study_text"))} if found else {}


def toml(tables: Mapping[str, Any]) -> str:
    """A dictionary as TOML."""
    lines: list[str] = []
    _write_table(tables, (), lines)
    return "\n".join(lines) + "\n"


def _write_table(table: Mapping[str, Any], names: tuple[str, ...], lines: list[str]) -> None:
    plain = {key: value for key, value in table.items() if not _is_table(value) and value is not None}
    if names and (plain or not table):
        lines.append(f"[{'.'.join(_quoted(name) for name in names)}]")
    lines.extend(f"{_quoted(key)} = {_toml_value(key, value)}" for key, value in plain.items())
    for key, value in table.items():
        if isinstance(value, Mapping):
            _write_table(value, (*names, key), lines)
        elif _is_table(value):
            for one in value:
                lines.append(f"[[{'.'.join(_quoted(name) for name in (*names, key))}]]")
                flat = {name: inner for name, inner in one.items() if inner is not None}
                lines.extend(f"{_quoted(name)} = {_toml_value(name, inner)}" for name, inner in flat.items())


def _is_table(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0
    return isinstance(value, Mapping) or (is_list and all(isinstance(one, Mapping) for one in value))


def _quoted(key: str) -> str:
    is_bare = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if is_bare else _toml_text(key)


def _toml_text(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\U{ord(c):08X}" for c in escaped) + '"'


def _toml_value(key: str, value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | np.integer):
        return str(int(value))
    if isinstance(value, float | np.floating):
        return repr(float(value))
    if isinstance(value, str | os.PathLike):
        return _toml_text(os.fspath(value))
    if isinstance(value, Sequence | np.ndarray):
        return "[" + ", ".join(_toml_value(key, one) for one in value) + "]"
    raise bad(f"{key} is a {type(value).__name__}, which a study cannot hold", "give a number, a text, a list or a table")


@contextlib.contextmanager
def removed_on_failure(folder: Path | None) -> Iterator[None]:
    """Removes a temporary folder if what fills it fails."""
    try:
        yield
    except BaseException:
        if folder is not None:
            import shutil

            shutil.rmtree(folder, ignore_errors=True)
        raise


class Source(NamedTuple):
    """A table as a file: its path and, if the file is temporary, the argument that it was made from."""

    path: str | None
    argument: str | None = None

    def named(self, document: str) -> str:
        """A document (JSON) with the name of the argument in place of the path of its temporary file."""
        if self.path is None or self.argument is None:
            return document
        return document.replace(json.dumps(self.path)[1:-1], self.argument)


@contextlib.contextmanager
def inventory(source: Any, name: str = "inventory") -> Iterator[Source]:
    """An inventory as a file: a path as it is; a table of pandas, polars or pyarrow as CSV.

    The headings of a table are those of a file, with units: `height [mm]`. `name` is the argument, which
    messages about a table name.
    """
    if source is None or isinstance(source, str | os.PathLike):
        yield Source(None if source is None else path_text(name, source))
        return
    import tempfile

    with tempfile.TemporaryDirectory(prefix="freestand-") as folder:
        path = os.path.join(folder, f"{name}.csv")
        _write_csv(source, path, name)
        try:
            yield Source(path, name)
        except FreestandError as error:
            raise type(error)([_named(problem, path, name) for problem in error.problems]) from None


def _named(problem: Problem, path: str, name: str) -> Problem:
    """A problem with a temporary file as one with the argument that it was made of."""
    hint = None if problem.hint is None else problem.hint.replace(path, name)
    own = name if problem.path == path else problem.path
    return problem._replace(message=problem.message.replace(path, name), path=own, hint=hint)


def _write_csv(source: Any, path: str, name: str) -> None:
    if hasattr(source, "to_csv"):  # pandas
        # An index with a name is a column, such as the ids after set_index("id").
        source.to_csv(path, index=any(one is not None for one in source.index.names))
    elif hasattr(source, "write_csv"):  # polars
        source.write_csv(path)
    elif hasattr(source, "to_pylist") and hasattr(source, "column_names"):  # pyarrow
        import csv

        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, source.column_names)
            writer.writeheader()
            writer.writerows(source.to_pylist())
    else:
        kind = type(source).__name__
        raise bad(f"{name} cannot be of type {kind}", "give a path, or a table of pandas, polars or pyarrow")


#: More than the cores of any machine today. Each thread takes memory, and a million threads take
#: all of it.
MAX_THREADS = 1024


def threads_given(threads: Any) -> int | None:
    """The number of threads; None: the default."""
    return whole("threads", threads, 1, MAX_THREADS)


#: The largest obelisk ever begun is 42 m long: a larger number was meant in other units.
MOST_M = 50.0


def sizes_m(**sizes: Any) -> None:
    """Refuses sizes of an object that cannot be meters, such as millimeters or centimeters."""
    for name, given_m in sizes.items():
        try:
            largest = float(np.max(np.abs(np.asarray(given_m, "f8")), initial=0.0))
        except (TypeError, ValueError):
            continue  # It is refused, as what it is, where it is read.
        if np.isfinite(largest) and largest > MOST_M:
            meant = largest / 1000 if largest >= 300 else largest / 100
            unit = "mm" if largest >= 300 else "cm"
            raise bad(
                f"{name} is {largest:g} m: no free-standing object is so large",
                f"give {name} in meters: {meant:g} if {largest:g} {unit} is meant",
            )
