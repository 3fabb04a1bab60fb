"""Finds probable slips in rules: TypedProgram → warnings, with `rule_slips` and `predicate_slips`.

A variable that is used once, or only under ``not``, or under two meanings; a literal and its
contrary in one body; a predicate that no rule gives, or that nothing uses.

Follows the SPARC manual, Rules: variables range over sorts, and those of an aggregate's tuple are
its own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from sparc.checking.typed_program import TypedProgram, variables
from sparc.errors import SparcWarning
from sparc.sorts.extents import Sort, every
from sparc.source import Span
from sparc.spelling import nearest
from sparc.syntax.tree import (
    Aggregate,
    Atom,
    BodyItem,
    Choice,
    Comparison,
    CrRule,
    Head,
    Naf,
    Optimize,
    RangeFact,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
    WeakConstraint,
)

__all__ = ["Mentions", "mentions", "predicate_slips", "rule_slips"]

_LONG_ENOUGH = 4  # letters of a name that may be a misspelling of another

Sign: TypeAlias = tuple[str, bool]
"""The name of a predicate, and whether it is negated."""


class Mentions(NamedTuple):
    """The predicates of a statement: those of its head, and those of its body, each once."""

    given: frozenset[Sign]
    used: tuple[Sign, ...]

    def names(self) -> set[str]:
        """Returns the names of all of them."""
        return {name for name, _ in (*self.given, *self.used)}


def rule_slips(
    typed: TypedProgram, statement: Statement, head: Head, body: tuple[BodyItem, ...]
) -> Iterator[SparcWarning]:
    """Yields the warnings about the variables and the literals of one rule."""
    under_not = list(_only_under_not(head, body))
    yield from under_not
    yield from _used_once(typed, statement, head, body, {one.span for one in under_not})
    yield from _two_meanings(head, body)
    yield from _contraries(statement, body)


# ------------------------------------------------------------------ variables


def _variables(terms: Iterable[Term]) -> list[Variable]:
    """Returns the variables with a name, at every place where they stand."""
    return [each for each in variables(terms) if each.name != "_"]


def _terms(item: Atom | SortAtom | BodyItem) -> Iterator[Term]:
    """Yields the terms of a literal, those of an aggregate's guards and elements included."""
    if isinstance(item, Aggregate):
        for guard in (item.left, item.right):
            if guard is not None:
                yield guard.bound
        for element in item.elements:
            yield from element.terms
            for literal in element.condition:
                yield from _terms(literal)
    elif isinstance(item, Comparison):
        yield from (item.left, item.right)
    else:
        yield from (item.operand if isinstance(item, Naf) else item).arguments


def _head_terms(head: Head) -> Iterator[Term]:
    if not isinstance(head, Choice):
        for atom in head:
            yield from atom.arguments
        return
    for guard in (head.left, head.right):
        if guard is not None:
            yield guard.bound
    for element in head.elements:
        yield from element.atom.arguments
        for literal in element.condition:
            yield from _terms(literal)


def _used_once(
    typed: TypedProgram,
    statement: Statement,
    head: Head,
    body: tuple[BodyItem, ...],
    told: set[Span | None],
) -> Iterator[SparcWarning]:
    """Yields variables that stand at one place of the rule alone.

    In the atom of a choice such a variable chooses among the elements of its sort, and under
    ``not`` in a constraint it stands for each of them: both are meant.  Beside a ``_`` such a
    variable is meant as well, unless its name is like that of a constant or of another variable:
    the original system takes a second ``_`` for the first.
    """
    in_head = list(_head_terms(head))
    terms = [*in_head, *(term for item in body for term in _terms(item))]
    if isinstance(statement, WeakConstraint):
        terms += filter(None, (statement.weight, statement.level))
    elif isinstance(statement, Optimize):
        terms += statement.parameters
    everywhere = variables(terms)
    number = Counter([variable.name for variable in everywhere])
    anonymous = number.pop("_", 0) > 0
    if 1 not in number.values():
        return
    meant: set[Span | None] = set()
    if isinstance(head, Choice):
        for element in head.elements:
            meant.update(v.span for v in _variables(element.atom.arguments))
    elif not head and all(isinstance(item, (Naf, Comparison)) for item in body):
        meant.update(v.span for item in body for v in _variables(_terms(item)))
    once = [v for v in everywhere if number[v.name] == 1 and v.span not in meant | told]
    heads = {v.span for v in _variables(in_head)}
    for variable in once:
        near = _likely_name(typed, variable, head, body, number)
        if near is None and anonymous:
            continue
        hint = "write _ if any element will do"
        if near is not None:
            hint = f"is {near} meant? If not, write _"
        elif len(once) > 1:
            names = ", ".join(each.name for each in once)
            hint += f", for one of {names}: the original system takes a second _ for the first"
        elif variable.span in heads:
            hint += ": in a head it stands for each"
        yield SparcWarning(f"the variable {variable.name} is used once", variable.span, hint)


def _likely_name(
    typed: TypedProgram,
    variable: Variable,
    head: Head,
    body: tuple[BodyItem, ...],
    number: Mapping[str, int],
) -> str | None:
    """Returns the constant, or the variable of the rule, that may be meant."""
    constant = _constant(typed, variable, head, body)
    if constant is not None:
        return f"the constant {constant}"
    if len(variable.name) < _LONG_ENOUGH:
        return None
    near = nearest(variable.name, [each for each in number if each != variable.name], 0.8)
    return None if near is None else f"the variable {near}"


def _constant(
    typed: TypedProgram, variable: Variable, head: Head, body: tuple[BodyItem, ...]
) -> str | None:
    """Returns the constant that differs from a variable in its capitals, and fits
    where that stands.
    """
    name = variable.name
    atoms = [item.operand if isinstance(item, Naf) else item for item in body]
    sorts: Collection[Sort] = ()
    for atom in (*(() if isinstance(head, Choice) else head), *atoms):
        if isinstance(atom, Atom):
            for term, sort in zip(atom.arguments, typed.predicates[atom.name].sorts, strict=True):
                if term is variable:
                    sorts = [sort]
    for constant in (name[0].lower() + name[1:], name.lower()):
        value = typed.constants.get(constant, constant)
        if any(value in sort.extent for sort in sorts or every(typed.sorts)):
            return constant
    return None


def _only_under_not(head: Head, body: tuple[BodyItem, ...]) -> Iterator[SparcWarning]:
    """Yields variables of a body that stand under ``not`` alone, where they may be read as "none"."""
    if not head and all(isinstance(item, (Naf, Comparison)) for item in body):
        return  # a constraint such as :- not visited(X). is about each X
    elsewhere = {variable.name for variable in _variables(_head_terms(head))}
    under: dict[str, Variable] = {}
    for item in body:
        for variable in _variables(_terms(item)):
            if isinstance(item, Naf) and isinstance(item.operand, Atom):
                under.setdefault(variable.name, variable)
            else:
                elsewhere.add(variable.name)
    for name, variable in under.items():
        if name not in elsewhere:
            yield SparcWarning(
                f'the variable {name} stands only under "not"',
                variable.span,
                f"this holds as soon as one {name} lacks it; for none at all, derive by a rule that"
                f" there is one, and negate that; for each {name}, add its sort atom",
            )


def _two_meanings(head: Head, body: tuple[BodyItem, ...]) -> Iterator[SparcWarning]:
    """Yields variables of an aggregate's tuple that bear the name of a variable outside."""
    for item in body:
        if not isinstance(item, Aggregate):
            continue
        outside = {variable.name for variable in _variables(_head_terms(head))}
        for other in body:
            if not isinstance(other, Aggregate):
                outside |= {variable.name for variable in _variables(_terms(other))}
        outside |= {
            variable.name
            for guard in (item.left, item.right)
            if guard is not None
            for variable in _variables([guard.bound])
        }
        for element in item.elements:
            for variable in _variables(element.terms):
                if variable.name in outside:
                    yield SparcWarning(
                        f"{variable.name} in this aggregate is another variable than the"
                        f" {variable.name} outside",
                        variable.span,
                        "the variables in front of the colon are local: give this one another name",
                    )


# ------------------------------------------------------------------ rules that never fire


def _contraries(statement: Statement, body: tuple[BodyItem, ...]) -> Iterator[SparcWarning]:
    """Yields a literal beside its negation: the body is never true."""
    negations = [i for i in body if isinstance(i, Naf) or (isinstance(i, Atom) and i.negated)]
    if not negations:
        return
    positive = {(i.name, i.arguments, i.negated) for i in body if isinstance(i, Atom)}
    for item in negations:
        atom = item.operand if isinstance(item, Naf) else item
        if not isinstance(atom, Atom) or any(v.name == "_" for v in variables(atom.arguments)):
            continue
        if isinstance(item, Naf):
            clash = (atom.name, atom.arguments, atom.negated) in positive
        else:
            clash = atom.negated and (atom.name, atom.arguments, False) in positive
        if clash:
            yield SparcWarning(
                "this rule can never fire: its body has a literal and its negation",
                item.span or statement.span,
                "leave one of the two out",
            )


# ------------------------------------------------------------------ predicates


def mentions(statement: Statement) -> Mentions:
    """Returns the predicates that a statement gives and uses."""
    if isinstance(statement, RangeFact):
        return Mentions(frozenset({(statement.name, statement.negated)}), ())
    given: frozenset[Sign] = frozenset()
    body: Iterable[BodyItem] = ()
    if isinstance(statement, (Rule, CrRule)):
        head, body = statement.head, statement.body
        atoms = [e.atom for e in head.elements] if isinstance(head, Choice) else head
        given = frozenset((a.name, a.negated) for a in atoms if isinstance(a, Atom))
        if isinstance(head, Choice):
            body = (*body, *(one for e in head.elements for one in e.condition))
    elif isinstance(statement, WeakConstraint):
        body = statement.body
    elif isinstance(statement, Optimize):
        body = statement.atoms
    return Mentions(given, tuple(dict.fromkeys((a.name, a.negated) for a in _atoms(body))))


def predicate_slips(typed: TypedProgram, mentioned: Iterable[Mentions]) -> Iterator[SparcWarning]:
    """Yields predicates that are used and that no rule gives, or that nothing uses or shows.

    ``mentioned`` are the `mentions` of all statements, in their order.
    """
    given: set[Sign] = set()
    used: dict[Sign, None] = {}
    for each in mentioned:
        given |= each.given
        used.update(dict.fromkeys(each.used))
    for name, negated in used:
        if (name, negated) not in given:
            sign = "-" if negated else ""
            yield SparcWarning(
                f"{sign}{name} is never true: no rule gives it",
                typed.predicates[name].span,
                f"write a fact or a rule for {sign}{name}, or a choice",
            )
    shown = typed.program.display
    names = {name for name, _ in used}
    names |= {item.name for item in shown or ()}
    heads = {name for name, _ in given}
    for name, signature in typed.predicates.items():
        if name not in names and (shown is not None or name not in heads):
            what = (
                "no rule uses it, and it is not displayed" if name in heads else "nothing uses it"
            )
            yield SparcWarning(f"{name} has no effect: {what}", signature.span, None)


def _atoms(body: Iterable[BodyItem]) -> Iterator[Atom]:
    """Yields the atoms of literals, those in the conditions of aggregates included."""
    for item in body:
        if isinstance(item, Aggregate):
            for element in item.elements:
                yield from _atoms(element.condition)
            continue
        atom = item.operand if isinstance(item, Naf) else item
        if isinstance(atom, Atom):
            yield atom
