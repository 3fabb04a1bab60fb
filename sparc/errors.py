"""The errors of SPARC: one family, each with the place it concerns and the mend.

>>> raise SortError("unknown sort #nodee", None, "did you mean #node?")
Traceback (most recent call last):
sparc.errors.SortError: unknown sort #nodee; did you mean #node?
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from sparc.source import Span

__all__ = [
    "Edit",
    "LimitError",
    "MissingToolError",
    "NumberError",
    "PredicateError",
    "RefusedProgramError",
    "RuleError",
    "SolverError",
    "SortError",
    "SourceError",
    "SourceErrors",
    "SparcSyntaxError",
    "SparcWarning",
    "too_large",
]


class Edit(NamedTuple):
    """A change of a text that mends a fault: ``new`` in place of the characters ``[start, end)``."""

    start: int
    end: int
    new: str


class SourceError(Exception):
    """A fault at a place in a file; ``hint`` says the mend, when there is one to say.

    ``edit`` does what the hint says, where that is one change of the text of ``span``.
    """

    edit: Edit | None = None

    def __init__(self, message: str, span: Span | None = None, hint: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.span = span
        self.hint = hint

    def __str__(self) -> str:
        """Returns the place, the message and the mend, as far as they are known, in one line."""
        place = f"{self.span.location}: " if self.span is not None else ""
        return f"{place}{self.message}{f'; {self.hint}' if self.hint else ''}"


class SparcSyntaxError(SourceError):
    """The text is no SPARC program: a character or a word that cannot stand here.

    ``expected`` is what the message says could stand here instead, where it says that.
    """

    expected: str | None = None


class SortError(SourceError):
    """A sort that is unknown, empty, declared twice, or of the wrong kind."""


class PredicateError(SourceError):
    """A predicate that is unknown, declared twice, or whose argument leaves its sort."""


class RuleError(SourceError):
    """A rule that has no meaning: an unrestricted variable, a misplaced sort atom, and so on."""


class LimitError(SourceError):
    """A program too large to be handled: nesting, size, or a sort with too many elements."""


class NumberError(LimitError):
    """Arithmetic beyond the 32 bits of clingo, where it cannot be worked out exactly."""


class SolverError(SourceError):
    """The solver could not do its work: it is missing, was refused its input, or died."""


class MissingToolError(SolverError):
    """Java or the jar is not there or cannot be run; ``hint`` says how to get it.

    ``tool`` is ``java`` or ``jar``.
    """

    def __init__(self, tool: str, message: str, hint: str) -> None:
        super().__init__(message, hint=hint)
        self.tool = tool


class RefusedProgramError(SolverError):
    """clingo refused the program that it was given; ``details`` are its reasons."""

    def __init__(self, details: str) -> None:
        super().__init__(f"clingo refused the translation: {details}")
        self.details = details


class SparcWarning(SourceError):
    """Something legal that is probably a mistake; never raised, only reported."""


class SourceErrors(Exception):
    """All faults found in one go, in the order of the text."""

    def __init__(self, errors: Sequence[SourceError]) -> None:
        self.errors: tuple[SourceError, ...] = tuple(errors)
        super().__init__("\n".join(map(str, self.errors)))


def too_large(errors: Iterable[SourceError]) -> bool:
    """Returns whether a program is beyond a limit rather than wrong: then nothing is decided."""
    return any(isinstance(one, LimitError) and not isinstance(one, NumberError) for one in errors)
