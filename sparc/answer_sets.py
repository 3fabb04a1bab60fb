"""Answer sets as values: ground terms, literals, and what a solver answers.

The same values come from either solver.  Terms are compared as clingo compares them: numbers
before identifiers before records.

>>> str(GroundLiteral("holds", (GroundTerm("at", (GroundTerm("r"), 3)), 0), negated=True))
'-holds(at(r,3),0)'
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass

__all__ = ["AnswerSet", "Ground", "GroundLiteral", "GroundTerm", "in_order"]


@dataclass(frozen=True)
class GroundTerm:
    """``a`` (no arguments) or ``f(t1,...,tn)``."""

    name: str
    arguments: tuple[Ground, ...] = ()

    def __str__(self) -> str:
        if not self.arguments:
            return self.name
        return f"{self.name}({','.join(map(str, self.arguments))})"


Ground: TypeAlias = int | GroundTerm


@dataclass(frozen=True)
class GroundLiteral:
    """``p(...)`` or ``-p(...)``; sort atoms shown by a display section have names with ``#``."""

    name: str
    arguments: tuple[Ground, ...] = ()
    negated: bool = False

    def __str__(self) -> str:
        sign = "-" if self.negated else ""
        if not self.arguments:
            return sign + self.name
        return f"{sign}{self.name}({','.join(map(str, self.arguments))})"


@dataclass(frozen=True)
class AnswerSet:
    """One answer set: the literals shown, in no particular order, and its cost (priority, value)."""

    literals: frozenset[GroundLiteral]
    cost: tuple[int, ...] = ()

    def __str__(self) -> str:
        """``{a, p(1), -q}``: the literals by name and arguments, numbers as numbers."""
        return f"{{{', '.join(map(str, in_order(self.literals)))}}}"

    def _repr_html_(self) -> str:
        """Returns a table for notebooks: a row a predicate."""
        from sparc.notebook import answer_set_table

        return answer_set_table(in_order(self.literals), self.cost)


def in_order(literals: Iterable[GroundLiteral]) -> list[GroundLiteral]:
    """Returns literals by name and arguments, numbers as numbers, positive before negative."""
    return sorted(literals, key=_order)


def _order(literal: GroundLiteral) -> tuple[object, ...]:
    return (literal.name, tuple(map(_term_order, literal.arguments)), literal.negated)


def _term_order(term: Ground) -> tuple[object, ...]:
    if isinstance(term, int):
        return (0, term)
    return (1, len(term.arguments), term.name, tuple(map(_term_order, term.arguments)))
