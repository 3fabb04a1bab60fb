"""One text that is being edited: its faults, names and sorts, worked out when asked for.

Entry point `Document`.  The sorts and predicates of the last version without faults are kept, so
that hover and completion go on to answer while a line is half written.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from sparc.errors import SourceError, SourceErrors
from sparc.language_server.positions import Positions
from sparc.language_server.symbols import Occurrence, index
from sparc.source import Source

if TYPE_CHECKING:
    from sparc.checking.typed_program import TypedProgram

__all__ = ["Document", "Finding"]


class Finding(NamedTuple):
    """A fault or a warning and its stretch of the text; ``mend`` is what to do about it."""

    severity: str  # "error" or "warning"
    message: str
    mend: str | None
    start: int
    end: int


class Document:
    """A version of a text; ``before`` is the version it came from, ``encoding`` as `Positions` takes it."""

    def __init__(
        self, name: str, text: str, before: Document | None = None, encoding: str = "utf-16"
    ) -> None:
        self.source = Source(name, text.replace("\r", " "))  # every offset stays
        self.positions = Positions(text, encoding)
        self._known: TypedProgram | None = before.typed if before is not None else None
        self.findings = self._examined()

    @property
    def text(self) -> str:
        """Returns the text itself."""
        return self.source.text

    @cached_property
    def names(self) -> tuple[Occurrence, ...]:
        """Returns all names of the text, in their order."""
        return index(self.source)

    @property
    def typed(self) -> TypedProgram | None:
        """Returns the program of the last version without faults; None before there was one."""
        return self._known

    def _examined(self) -> tuple[Finding, ...]:
        """Returns every fault of the program, or where it has none, its warnings."""
        import sparc

        try:
            typed = sparc.check(sparc.parse(self.source))
        except SourceErrors as errors:
            return tuple(_finding(error, "error") for error in errors.errors)
        except SourceError as error:
            return (_finding(error, "error"),)
        self._known = typed
        try:
            return tuple(_finding(each, "warning") for each in sparc.find_warnings(typed))
        except SourceError:  # a sort too large to look through: no fault of the text
            return ()

    def at(self, offset: int) -> Occurrence | None:
        """Returns the name at an offset, or that ends there."""
        for each in self.names:
            if each.start > offset:
                break
            if each.start <= offset <= each.end:
                return each
        return None

    def same(self, one: Occurrence) -> tuple[Occurrence, ...]:
        """Returns all occurrences of the same thing: a variable's are those of its statement."""
        return tuple(
            each
            for each in self.names
            if (each.kind, each.name) == (one.kind, one.name)
            and (one.kind != "variable" or each.statement == one.statement)
        )

    def has(self, one: Occurrence, name: str) -> bool:
        """Returns whether something is called ``name`` that renaming ``one`` would make the same thing."""
        kinds = ("value", "constant") if one.kind in ("value", "constant") else (one.kind,)
        return any(
            each.kind in kinds
            and each.name == name
            and (one.kind != "variable" or each.statement == one.statement)
            for each in self.names
        )

    def definition(self, one: Occurrence) -> Occurrence | None:
        """Returns the declaration of a thing.

        A variable's is its first occurrence in the statement.
        """
        same = self.same(one)
        definition = next((each for each in same if each.defines), None)
        return same[0] if definition is None and one.kind == "variable" else definition

    def sentence(self, offset: int) -> str | None:
        """Returns the comment above a place, or behind it in its line; None where there is none."""
        lines = self.text.split("\n")
        at = self.positions.of(offset)[0]
        said: list[str] = []
        for line in reversed(lines[:at]):
            stripped = line.strip()
            if not stripped.startswith("%"):
                break
            said.append(stripped.lstrip("% "))
        beside = lines[at].partition("%")[2].strip() if at < len(lines) else ""
        words = " ".join(" ".join([*reversed(said), beside]).split())
        return words or None


def _finding(error: SourceError, severity: str) -> Finding:
    start = error.span.start if error.span is not None else 0
    end = max(error.span.end, start + 1) if error.span is not None else 1
    return Finding(severity, error.message, error.hint, start, end)
