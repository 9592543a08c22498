"""Exceptions and warnings of freestand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple


class FreestandWarning(UserWarning):
    """A result is valid only in part, or an input was read with an assumption."""


class Problem(NamedTuple):
    """One problem, with the place where it was found and a remedy."""

    message: str
    path: str | None = None
    line: int | None = None
    hint: str | None = None
    #: The arguments that it is about.
    arguments: Sequence[str] = ()

    def __str__(self) -> str:
        if self.path is None:
            place = "" if self.line is None else f"line {self.line}: "
        else:
            place = f"{self.path}: " if self.line is None else f"{self.path}:{self.line}: "
        return place + self.message + ("" if self.hint is None else f"\n  hint: {self.hint}")


class FreestandError(Exception):
    """What every exception of freestand derives from; `problems` are all that were found."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: str | Iterable[tuple[Any, ...]]) -> None:
        if isinstance(problems, str):
            problems = [(problems,)]
        self.problems = tuple(Problem(*problem) for problem in problems)
        super().__init__(tuple(tuple(problem) for problem in self.problems))

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)

    @property
    def hint(self) -> str | None:
        """What to do about the first problem."""
        return self.problems[0].hint if self.problems else None


class BadValue(FreestandError, ValueError):
    """An argument is missing, of a wrong kind, or outside the range of the models."""


class ReadError(FreestandError):
    """A file cannot be read or written, or its content is wrong."""

    @property
    def path(self) -> str | None:
        """The file."""
        return self.problems[0].path if self.problems else None

    @property
    def line(self) -> int | None:
        """The line in that file, counted from 1; None if it is not known."""
        return self.problems[0].line if self.problems else None


class StudyError(FreestandError):
    """A study or an inventory cannot be used: `problems` are all that is wrong with it."""


class SolveError(FreestandError):
    """A calculation failed."""


class Interrupted(FreestandError, KeyboardInterrupt):
    """Ctrl-C stopped the calculation; no partial result is kept."""
