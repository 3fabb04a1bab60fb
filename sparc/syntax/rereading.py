"""Reads the versions of a text that is being edited, and parses only statements that changed. Entry point `Reading`.

A statement is kept where its tokens, and those that the parser looks at behind it, are those of the
version before; whatever has a fault is read again, with the faults of all the text as `parse` tells them.

>>> old = Reading(Source("x", "predicates\\np().\\nrules\\np.\\n"))
>>> new = Reading(Source("x", "predicates\\np().\\nq().\\nrules\\np.\\n"), old)
>>> new.program.statements[0] is old.program.statements[0]
True
"""

from __future__ import annotations

from typing import NamedTuple

from sparc.errors import LimitError, SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.lexer import Lexemes, scan
from sparc.syntax.literal_parser import FOREIGN, OPTIMIZE
from sparc.syntax.parser import ProgramParser, in_order
from sparc.syntax.rescanning import rescan
from sparc.syntax.tree import CrRule, Program, Statement

__all__ = ["Reading"]

_AHEAD = 4  # tokens behind a statement that the parser may look at
_MOST_HELD = 1 << 26  # characters of older versions, to which the places in kept statements belong
_WORDS = FOREIGN.union(OPTIMIZE)
_NOTHING = Lexemes(["end"] * 4, [""] * 4, [0] * 4)


class _Kept(NamedTuple):
    """A statement without faults: its first token, and how many it has."""

    first: int
    length: int
    tree: Statement


class Reading:
    """One version of a text, read.

    ``program`` is what could be read, ``faults`` are those of syntax in the order of the text.  The
    places in a statement that was kept are those of an earlier version: `moved` tells how far it is
    from there.
    """

    def __init__(self, source: Source, before: Reading | None = None) -> None:
        if before is not None and (before._held > _MOST_HELD or before.lexemes is _NOTHING):
            before = None  # its tokens are let go, or were never cut
        self.source = source
        self._held: int = len(source.text) + (0 if before is None else before._held)
        self.lexemes: Lexemes = _NOTHING
        self._kept: list[_Kept] = []
        try:
            kept = self._scanned(before)
        except LimitError as error:
            self.faults: tuple[SourceError, ...] = (error,)
            self.program = Program((), (), (), (), None, source)
            self._words = _Words(frozenset(), frozenset())
            return
        parser = _Rereader(source, self.lexemes, kept, None if before is None else before._words)
        self.faults = parser.all_faults()
        self.program = parser.tree()
        self._kept = parser.read
        self._words = parser.words()

    def _scanned(self, before: Reading | None) -> dict[int, _Kept]:
        """Cuts the text into tokens; returns the statements that are kept, by their first token."""
        if before is None:
            self.lexemes = scan(self.source)
            return {}
        self.lexemes, front, back, moved = rescan(self.source, before.source, before.lexemes)
        kept = {}
        for one in before._kept:
            if isinstance(one.tree, CrRule) and one.tree.label is not None:
                continue  # others are told the line of its label
            if one.first + one.length + _AHEAD <= front:
                kept[one.first] = one
            elif one.first >= back:
                kept[one.first + moved] = one._replace(first=one.first + moved)
        return kept

    def moved(self) -> list[int]:
        """Returns for each statement of a program without faults how many characters it has moved."""
        starts = self.lexemes.starts
        return [starts[one.first] - one.tree.span.start for one in self._kept]


class _Words(NamedTuple):
    """The names on which it depends how a statement is read."""

    constants: frozenset[str]
    sorts: frozenset[str]  # those named as words of other languages are


class _Rereader(ProgramParser):
    """A parser that knows statements already; ``under`` which names they were read."""

    __slots__ = ("_known", "_under", "read")

    def __init__(
        self, source: Source, lexemes: Lexemes, known: dict[int, _Kept], under: _Words | None
    ) -> None:
        super().__init__(source, lexemes)
        self._known = known
        self._under = under
        self.read: list[_Kept] = []

    def words(self) -> _Words:
        """Returns the names that are known here."""
        return _Words(frozenset(self.constants), _WORDS & self.sorts)

    def statement(self) -> Statement:
        """Returns the next statement, if possible the one that is known."""
        first = self.at
        known = self._known.get(first)
        if known is None or self._under != self.words():
            tree = super().statement()
            known = _Kept(first, self.at - first, tree)
        self.at = first + known.length
        self.read.append(known)
        return known.tree

    def all_faults(self) -> tuple[SourceError, ...]:
        """Reads the program; returns its faults, in the order in which `parse` has them."""
        try:
            self.program()
        except SourceErrors as errors:
            return errors.errors
        except SourceError as error:
            return (error,)
        return tuple(in_order(self.faults))
