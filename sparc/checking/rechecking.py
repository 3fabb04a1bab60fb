"""Checks the versions of a program that is being edited: only what changed is checked anew. Entry point `Examined`.

What is found out about a statement holds as long as the sorts that were looked into for it, and the
constants and the predicates that it names; a fault may also name lines and words of other
declarations, so it holds as long as the text of these.  The whole is what `check` and `find_warnings` say.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set
from functools import lru_cache
from typing import NamedTuple

from sparc.checking.checker import Checker, nested_too_deeply
from sparc.checking.slip_warnings import Mentions, mentions, predicate_slips
from sparc.checking.warnings import WarningSearch
from sparc.errors import SourceError, SparcWarning
from sparc.sorts.extents import EVERY
from sparc.source import Span
from sparc.syntax.tree import Program, SortDefinition, Statement

__all__ = ["Examined", "Placed"]


class Placed(NamedTuple):
    """A fault or a warning, and by how many characters its statement has moved since it was read."""

    what: SourceError
    moved: int

    @property
    def start(self) -> int:
        """Returns its place now, by which `check` and `find_warnings` order: -1 without one."""
        return -1 if self.what.span is None else self.what.span.start + self.moved


class _Warned(NamedTuple):
    """Warnings about a statement, and the sorts that were looked into for them."""

    warnings: tuple[SparcWarning, ...]
    asked: frozenset[str]
    budget: int = 0  # the assignments that might be tried for them
    spent: int = 0  # and those that were

    def holds_with(self, budget: int) -> bool:
        """Returns whether the warnings would be the same if so many assignments might be tried."""
        return budget == self.budget or min(budget, self.budget) > self.spent


class _Checked(NamedTuple):
    """The findings of `Checker` about a statement, and the sorts that it looked into."""

    faults: tuple[SourceError, ...]
    naturals: frozenset[str]
    asked: frozenset[str]


class _Found(NamedTuple):
    """The findings about one statement; what is None was not looked for, or holds no longer."""

    statement: Statement
    mentions: Mentions
    checked: _Checked | None = None
    by_text: _Warned | None = None
    by_instances: _Warned | None = None

    def where_true(self, changed: Set[str]) -> _Found:
        """Returns what still holds where some sorts are others; faults may tell more than they ask."""
        checked = self.checked
        if checked is not None and (checked.faults or not changed.isdisjoint(checked.asked)):
            checked = None
        text, instances = (
            None if each is None or not changed.isdisjoint(each.asked) else each
            for each in (self.by_text, self.by_instances)
        )
        return _Found(self.statement, self.mentions, checked, text, instances)


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
        """Returns what is known of statements that depends on nothing that changed in the declarations."""
        old, new = before._checker, self._checker
        if old.maxint != new.maxint:
            return {}
        constants = _changed(old.constants, new.constants)
        sorts = _changed_sorts(before, self, constants)
        names = {*old.predicates, *new.predicates, *old.misdeclared, *new.misdeclared}
        predicates = {name for name in names if _sorts_of(old, name) != _sorts_of(new, name)}
        return {
            key: found.where_true(sorts)
            for key, found in before._known.items()
            if predicates.isdisjoint(found.mentions.names())
            and not _has_word(found.statement.span, constants)
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
            if one.checked is not None and one.checked.faults:
                faults += [Placed(fault, by) for fault in one.checked.faults]
        faults += [Placed(fault, 0) for fault in ending]
        return sorted(faults or self._all_warnings(found, moved), key=lambda each: each.start)

    def _checked(self, statement: Statement, index: int) -> _Found:
        """Returns what is known about a statement, its warnings perhaps not yet."""
        known = self._known.get(id(statement))
        if known is None:
            known = _Found(statement, mentions(statement))
        if known.checked is not None:
            return known
        checker = self._checker
        checker.errors.clear()
        checker.table.asked.clear()
        checker.index = index
        checker.statement(statement)
        naturals = {n for (at, _), names in checker.naturals.items() if at == index for n in names}
        checker.naturals.clear()
        return known._replace(
            checked=_Checked(tuple(checker.errors), frozenset(naturals), self._asked())
        )

    def _asked(self) -> frozenset[str]:
        """Returns the sorts that were looked into since their names were cleared."""
        return frozenset(self._checker.table.asked)

    def _all_warnings(self, found: list[_Found], moved: Sequence[int]) -> list[Placed]:
        """Returns all warnings of a program without faults; none where a sort is too large for them."""
        self._warnings.leaving.refill()
        warnings: list[Placed] = []
        try:
            for one, by in zip(found, moved, strict=True):
                warnings += [Placed(each, by) for each in self._warned(one)]
        except SourceError:  # a sort too large to look through: no fault of the text
            return []
        slips = predicate_slips(self.typed, [one.mentions for one in found])
        return warnings + [Placed(slip, 0) for slip in slips]

    def _warned(self, one: _Found) -> tuple[SparcWarning, ...]:
        """Returns the warnings about a statement, and keeps them."""
        leaving = self._warnings.leaving
        asked = self._checker.table.asked
        budget = leaving.left
        text, instances = one.by_text, one.by_instances
        if instances is not None and instances.holds_with(budget):
            leaving.left = budget - instances.spent
        else:
            assert one.checked is not None
            asked.clear()
            told = self._warnings.of_instances(one.statement, set(one.checked.naturals))
            instances = _Warned(told, self._asked(), budget, budget - leaving.left)
        if text is None:
            asked.clear()
            text = _Warned(self._warnings.of_text(one.statement), self._asked())
        if text is not one.by_text or instances is not one.by_instances:
            looked = one._replace(by_text=text, by_instances=instances)
            self._known[id(one.statement)] = looked
        return instances.warnings + text.warnings


def _changed(old: Mapping[str, object], new: Mapping[str, object]) -> set[str]:
    """Returns the keys whose values differ, or that only one has."""
    return {name for name in {*old, *new} if old.get(name) != new.get(name)}


def _changed_sorts(before: Examined, after: Examined, constants: Set[str]) -> set[str]:
    """Returns the sorts that may be others; with any of them, all together (`EVERY`) are others."""
    old, new = before._checker.table, after._checker.table
    changed = _changed(_definitions(before.program), _definitions(after.program))
    changed |= old.sorts.keys() ^ new.sorts.keys()
    for definition in after.program.sorts:  # a sort stands behind those that it is built on
        if _has_word(definition.span, constants) or _has_word(definition.span, changed):
            changed.add(definition.name)
    return changed | {EVERY} if changed else changed


def _definitions(program: Program) -> dict[str, tuple[SortDefinition, ...]]:
    """Returns the definitions of each sort; there are several by mistake alone."""
    definitions: dict[str, tuple[SortDefinition, ...]] = {}
    for definition in program.sorts:
        definitions[definition.name] = (*definitions.get(definition.name, ()), definition)
    return definitions


def _has_word(span: Span, words: Set[str]) -> bool:
    """Returns whether one of the words stands in a stretch of text, in small or large letters.

    A variable may be meant for the constant that differs from it in its capitals.
    """
    return bool(words) and _any_of(frozenset(words)).search(span.text) is not None


@lru_cache(4)
def _any_of(words: frozenset[str]) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{'|'.join(words)})\b", re.IGNORECASE)


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
