"""Checks the versions of a program that is being edited: only what changed is checked anew. Entry point `Examined`.

What is found out about a statement holds as long as the sorts, the constants and the predicates that it
names do; a fault may also name lines and words of other declarations, so it holds as long as the
text of these.  The whole is what `check` and `find_warnings` say.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sparc.checking.checker import Checker, nested_too_deeply
from sparc.checking.slip_warnings import Mentions, mentions, predicate_slips
from sparc.checking.warnings import WarningSearch
from sparc.errors import SourceError, SparcWarning
from sparc.syntax.tree import Program, Statement

__all__ = ["Examined", "Placed"]


class Placed(NamedTuple):
    """A fault or a warning, and by how many characters its statement has moved since it was read."""

    what: SourceError
    moved: int

    @property
    def start(self) -> int:
        """Returns its place now, by which `check` and `find_warnings` order: -1 without one."""
        return -1 if self.what.span is None else self.what.span.start + self.moved


class _Found(NamedTuple):
    """The findings about one statement."""

    statement: Statement
    faults: tuple[SourceError, ...]
    naturals: frozenset[str]
    mentions: Mentions
    warnings: tuple[SparcWarning, ...] | None = None  # None: not looked for
    budget: int = 0  # the assignments that might be tried for them
    spent: int = 0  # and those that were

    def holds_with(self, budget: int) -> bool:
        """Returns whether the warnings would be the same if so many assignments might be tried."""
        if self.warnings is None:
            return False
        return budget == self.budget or min(budget, self.budget) > self.spent


class Examined:
    """One version of a program, its declarations checked; ``before`` is the version it came from.

    ``typed`` has its sorts, constants and predicates, those without faults, whatever else is wrong.
    """

    def __init__(self, program: Program, before: Examined | None = None) -> None:
        self.program = program
        self._text = _opening(program)
        self._known: dict[int, _Found] = {}
        if before is not None and _same_opening(self, before):
            self._checker: Checker = before._checker
            self._warnings: WarningSearch = before._warnings
            self._checker.program = program
            self._checker.look_for_large_numbers()
            self._opening_faults: tuple[SourceError, ...] = before._opening_faults
            self._known = before._known
        else:
            self._checker = Checker(program)
            self._checker.open()
            self._opening_faults = tuple(self._checker.errors)
            self._warnings = WarningSearch(self._checker.typed())
            if before is not None:
                self._known = self._still_true(before)
        self.typed = self._checker.typed()

    def _still_true(self, before: Examined) -> dict[int, _Found]:
        """Returns what is known of statements that depend on nothing that changed in the declarations."""
        old, new = before._checker, self._checker
        if (old.constants, old.maxint) != (new.constants, new.maxint):
            return {}
        if before.program.sorts != self.program.sorts:
            return {}
        names = {*old.predicates, *new.predicates, *old.misdeclared, *new.misdeclared}
        changed = {name for name in names if _sorts_of(old, name) != _sorts_of(new, name)}
        return {
            key: found
            for key, found in before._known.items()
            if not found.faults and changed.isdisjoint(found.mentions.names())
        }

    def findings(self, moved: Sequence[int]) -> list[Placed]:
        """Returns the faults of a program that could be read, or where there are none its warnings.

        ``moved`` tells for each statement how far it is from its place in its tree.
        """
        checker = self._checker
        checker.naturals, checker.labels = {}, {}
        try:
            found = [self._checked(one, index) for index, one in enumerate(self.program.statements)]
            checker.errors.clear()
            checker.display()
            ending = tuple(checker.errors)
        except RecursionError:
            return [Placed(nested_too_deeply(), 0)]
        self._known = {id(one.statement): one for one in found}
        faults = [Placed(fault, 0) for fault in self._opening_faults]
        for one, by in zip(found, moved, strict=True):
            if one.faults:
                faults += [Placed(fault, by) for fault in one.faults]
        faults += [Placed(fault, 0) for fault in ending]
        return sorted(faults or self._all_warnings(found, moved), key=lambda each: each.start)

    def _checked(self, statement: Statement, index: int) -> _Found:
        """Returns what is known about a statement, its warnings perhaps not yet."""
        known = self._known.get(id(statement))
        if known is not None:
            return known
        checker = self._checker
        checker.errors.clear()
        checker.index = index
        checker.statement(statement)
        naturals = {n for (at, _), names in checker.naturals.items() if at == index for n in names}
        checker.naturals.clear()
        return _Found(statement, tuple(checker.errors), frozenset(naturals), mentions(statement))

    def _all_warnings(self, found: list[_Found], moved: Sequence[int]) -> list[Placed]:
        """Returns all warnings of a program without faults; none where a sort is too large for them."""
        self._warnings.leaving.refill()
        warnings: list[Placed] = []
        try:
            for one, by in zip(found, moved, strict=True):
                looked = self._warned(one)
                warnings += [Placed(each, by) for each in looked.warnings or ()]
        except SourceError:  # a sort too large to look through: no fault of the text
            return []
        slips = predicate_slips(self.typed, [one.mentions for one in found])
        return warnings + [Placed(slip, 0) for slip in slips]

    def _warned(self, one: _Found) -> _Found:
        """Returns what is known about a statement, with its warnings."""
        leaving = self._warnings.leaving
        budget = leaving.left
        if one.holds_with(budget):
            leaving.left = budget - one.spent
            return one
        warnings = self._warnings.of(one.statement, set(one.naturals))
        looked = one._replace(warnings=warnings, budget=budget, spent=budget - leaving.left)
        self._known[id(one.statement)] = looked
        return looked


def _sorts_of(checker: Checker, name: str) -> tuple[str, ...] | bool:
    """Returns the sorts of a predicate; where it has none, whether it is declared nevertheless."""
    signature = checker.predicates.get(name)
    if signature is None:
        return name in checker.misdeclared
    return tuple(sort.name for sort in signature.sorts)


def _same_opening(one: Examined, other: Examined) -> bool:
    """Returns whether two versions have the same declarations at the same places."""
    new, old = one.program, other.program
    return (
        one._text == other._text
        and (new.directives, new.sorts) == (old.directives, old.sorts)
        and new.predicates == old.predicates
    )


def _opening(program: Program) -> str:
    """Returns the text up to the last of the declarations."""
    nodes = (*program.directives, *program.sorts, *program.predicates)
    return program.source.text[: max((node.span.end for node in nodes), default=0)]
