"""One text that is being edited: its faults, names and sorts, worked out when asked for.

Entry point `Document`.  What did not change since the version before is not worked out again, and while
there are faults the declarations of before go on to answer hover and completion.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import NamedTuple

from sparc.checking.rechecking import Examined
from sparc.checking.typed_program import Signature
from sparc.errors import Edit, SourceError, SparcWarning
from sparc.language_server.positions import Positions
from sparc.language_server.symbols import Occurrence, index
from sparc.sorts.extents import Sort
from sparc.source import Source
from sparc.syntax.lexer import Lexemes
from sparc.syntax.rereading import Reading

__all__ = ["Declared", "Document", "Finding"]


class Declared(NamedTuple):
    """The declarations of a program, as far as it is without faults."""

    constants: Mapping[str, int]
    sorts: Mapping[str, Sort]
    predicates: Mapping[str, Signature]


class Finding(NamedTuple):
    """A fault or a warning and its stretch of the text.

    ``mend`` is what to do about it, ``edit`` the change that does it, where there is one.
    """

    severity: str  # "error" or "warning"
    message: str
    mend: str | None
    start: int
    end: int
    edit: Edit | None = None


class Document:
    """A version of a text; ``before`` is the version it came from, ``encoding`` as `Positions` takes it."""

    def __init__(
        self, name: str, text: str, before: Document | None = None, encoding: str = "utf-16"
    ) -> None:
        self.source = Source(name, text.replace("\r", " "))  # every offset stays
        self.positions = Positions(text, encoding)
        self._reading: Reading = Reading(self.source, before._reading if before else None)
        examined = before._examined if before else None
        self._examined: Examined = Examined(self._reading.program, examined)
        self.findings = self._found()
        self.declared = self._all_declared(before)

    @property
    def text(self) -> str:
        """Returns the text itself."""
        return self.source.text

    @property
    def lexemes(self) -> Lexemes:
        """Returns the tokens of the text."""
        return self._reading.lexemes

    @cached_property
    def names(self) -> tuple[Occurrence, ...]:
        """Returns all names of the text, in their order."""
        return index(self.lexemes)

    def _found(self) -> tuple[Finding, ...]:
        """Returns every fault of the program, or where it has none, its warnings."""
        faults = self._reading.faults
        if faults:
            return tuple(_finding(fault, 0) for fault in faults)
        placed = self._examined.findings(self._reading.moved())
        return tuple(_finding(each.what, each.moved) for each in placed)

    def _all_declared(self, before: Document | None) -> Declared:
        """Returns what is declared; where there are faults, also what was before."""
        typed = self._examined.typed
        now = Declared(typed.constants, typed.sorts, typed.predicates)
        if before is None or not any(each.severity == "error" for each in self.findings):
            return now
        old = before.declared
        return Declared(
            {**old.constants, **now.constants},
            {**old.sorts, **now.sorts},
            {**old.predicates, **now.predicates},
        )

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


def _finding(error: SourceError, moved: int) -> Finding:
    severity = "warning" if isinstance(error, SparcWarning) else "error"
    start = error.span.start + moved if error.span is not None else 0
    end = max(error.span.end + moved, start + 1) if error.span is not None else 1
    return Finding(severity, error.message, error.hint, start, end, error.edit)
