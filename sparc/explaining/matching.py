"""Matches the head of a rule with a literal, or a form of literals: values of the rule's variables.

Entry point `match_atom`.
"""

from __future__ import annotations

from sparc.answer_sets import Ground
from sparc.explaining.answer_model import term_value
from sparc.explaining.instances import tree_term
from sparc.syntax.tree import Arithmetic, Atom, Comparison, Number, Record, Term, Variable

__all__ = ["match_atom"]

_FIRST_OWN = 900  # the number of a first variable that no rule has: theirs count from 1


def match_atom(
    atom: Atom, wanted: Atom
) -> tuple[dict[str, Ground | Record], list[Comparison]] | None:
    """Returns values with which a head is ``wanted``, and equations that remain.

    Variables of ``wanted`` may be anything; where a variable of the head has to be of a form of
    ``wanted``, its value is that form, with variables of its own.  None where it cannot be.
    """
    if (atom.name, atom.negated, len(atom.arguments)) != (
        wanted.name, wanted.negated, len(wanted.arguments),
    ):  # fmt: skip
        return None
    wanted = _with_own_variables(wanted)
    values: dict[str, Ground | Record] = {}
    later: list[tuple[Arithmetic, int]] = []
    for term, other in zip(atom.arguments, wanted.arguments, strict=True):
        if not _match(term, other, values, later):
            return None
    equations = []
    for sum_, value in later:
        if not _inverted(sum_, value, values):
            equations.append(Comparison(sum_, "=", tree_term(value)))
    return values, equations


def _match(
    term: Term,
    wanted: Term,
    values: dict[str, Ground | Record],
    later: list[tuple[Arithmetic, int]],
) -> bool:
    if isinstance(wanted, Variable | Arithmetic):
        return True
    match term:
        case Variable(name):
            value: Ground | Record | None = term_value(wanted, {})
            if value is None and isinstance(wanted, Record):
                value = wanted
            return value is None or values.setdefault(name, value) == value
        case Record(name, arguments):
            return (
                isinstance(wanted, Record)
                and (wanted.name, len(wanted.arguments)) == (name, len(arguments))
                and all(
                    _match(part, inner, values, later)
                    for part, inner in zip(arguments, wanted.arguments, strict=True)
                )
            )
        case Arithmetic():
            if isinstance(wanted, Number):
                later.append((term, wanted.value))
            return isinstance(wanted, Number)
    return term_value(term, {}) == term_value(wanted, {})


def _with_own_variables(atom: Atom) -> Atom:
    """Returns a form whose variables are none of any rule's."""
    names: dict[str, str] = {}

    def renamed(term: Term) -> Term:
        if isinstance(term, Variable):
            return Variable(names.setdefault(term.name, f"_V{_FIRST_OWN + len(names)}"), term.span)
        if isinstance(term, Record):
            return Record(term.name, tuple(map(renamed, term.arguments)), term.span)
        if isinstance(term, Arithmetic):
            return Arithmetic(term.operator, renamed(term.left), renamed(term.right), term.span)
        return term

    return Atom(atom.name, tuple(map(renamed, atom.arguments)), atom.negated)


def _inverted(sum_: Arithmetic, value: int, values: dict[str, Ground | Record]) -> bool:
    """Returns whether ``X+n`` or ``X-n`` gives a new variable its value."""
    left, right = sum_.left, sum_.right
    if not isinstance(left, Variable) or not isinstance(right, Number) or left.name in values:
        return False
    if sum_.operator not in ("+", "-"):
        return False
    values[left.name] = value - right.value if sum_.operator == "+" else value + right.value
    return True
