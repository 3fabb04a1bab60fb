"""Finds values with which literals with variables are among those of an answer set. Entry point `first_fit`.

>>> from sparc.syntax.tree import Variable
>>> there = {GroundLiteral("p", (1,)), GroundLiteral("p", (2,)), GroundLiteral("q", (2,))}
>>> wanted = [Atom("p", (Variable("X"),)), Atom("q", (Variable("X"),))]
>>> first_fit(wanted, there)
({'X': 2}, None)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from sparc.answer_sets import Ground, GroundLiteral, GroundTerm, in_order
from sparc.checking.typed_program import has_arithmetic
from sparc.explaining.answer_model import term_value
from sparc.explaining.instances import ground_item
from sparc.syntax.tree import Arithmetic, Atom, Record, Term, Variable

__all__ = ["first_fit", "with_values"]

_MOST_TRIED = 300_000  # literals; then the best that was found is taken

Values = dict[str, Ground]


def first_fit(
    wanted: Sequence[Atom], literals: Iterable[GroundLiteral]
) -> tuple[Values, Atom | None]:
    """Returns the first values, in the order of terms, with which all of ``wanted`` are among the literals.

    Where there are none, values with which as many as possible are, and the one that fails then.
    """
    ordered = sorted(wanted, key=lambda atom: any(map(has_arithmetic, atom.arguments)))
    there: dict[tuple[str, bool], list[GroundLiteral]] = {}
    for each in in_order(literals):
        there.setdefault((each.name, each.negated), []).append(each)
    best: tuple[Values, int] = ({}, 0)
    tried = 0

    def fit(values: Values, at: int) -> bool:
        nonlocal best, tried
        if at > best[1]:
            best = (values, at)
        if at == len(ordered):
            return True
        atom = ordered[at]
        for literal in there.get((atom.name, atom.negated), ()):
            tried += 1
            if tried > _MOST_TRIED:
                return True
            bound = _bound(atom, literal, values)
            if bound is not None and fit(bound, at + 1):
                return True
        return False

    fit({}, 0)
    values, fitting = best
    return values, ordered[fitting] if fitting < len(ordered) else None


def with_values(atom: Atom, values: Mapping[str, Ground]) -> Atom:
    """Returns the literal with these values for its variables, as far as it has them."""
    ground = ground_item(atom, values)
    assert isinstance(ground, Atom)
    return ground


def _bound(atom: Atom, literal: GroundLiteral, values: Values) -> Values | None:
    """Returns the values with which an atom is a literal, those given included; None for none."""
    found = dict(values)
    pairs = list(zip(atom.arguments, literal.arguments, strict=True))
    pairs.sort(key=lambda pair: isinstance(pair[0], Arithmetic))  # others may give it its values
    return found if all(_matches(term, value, found) for term, value in pairs) else None


def _matches(term: Term, value: Ground, values: Values) -> bool:
    """Returns whether a term is a value, and adds what its variables have to be for that."""
    if isinstance(term, Variable):
        return values.setdefault(term.name, value) == value
    if isinstance(term, Record):
        return (
            isinstance(value, GroundTerm)
            and (value.name, len(value.arguments)) == (term.name, len(term.arguments))
            and all(
                _matches(part, inner, values)
                for part, inner in zip(term.arguments, value.arguments, strict=True)
            )
        )
    return term_value(term, values) == value
