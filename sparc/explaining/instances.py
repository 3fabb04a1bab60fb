"""Ground instances of statements: a statement and values for its variables → text.

Entry points `ground_statement` and `instance_text`; `binding_of` reads values from a solver's terms.

>>> from sparc.answer_sets import GroundTerm
>>> from sparc.syntax.parser import parse
>>> from sparc.source import Source
>>> text = "predicates rules :- busy(X), idle(X,Y+1). "
>>> (statement,) = parse(Source("p", text)).statements
>>> instance_text(statement, {"X": GroundTerm("a"), "Y": 2})
'busy(a), idle(a,3)'
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from sparc.answer_sets import Ground, GroundTerm
from sparc.checking.typed_program import Undefined, apply_operator
from sparc.syntax.printer import print_statement
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    CrRule,
    Guard,
    Head,
    Identifier,
    Literal,
    Naf,
    Number,
    Record,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
)

__all__ = [
    "Binding",
    "ground_item",
    "ground_statement",
    "ground_term",
    "instance_text",
    "tree_term",
]

Binding = Mapping[str, "Ground | Record"]
"""Values of variables; a record may have variables of its own, where only a form is known."""


_UNNAMED = re.compile(r"(?<!\w)_V\d+")  # an anonymous variable that has no value


def instance_text(statement: Statement, binding: Binding) -> str:
    """Returns the instance in words: a rule as it is written, of a constraint its body alone."""
    ground = ground_statement(statement, binding)
    shown = (
        _UNNAMED.sub("_", print_statement(ground)).removesuffix(".").rstrip().removesuffix(" :+")
    )
    return shown.removeprefix(":- ") if isinstance(ground, Rule) and ground.head == () else shown


def ground_statement(statement: Statement, binding: Binding) -> Statement:
    """Returns the statement with values for its variables; other variables stay."""
    match statement:
        case Rule(head, body):
            return Rule(_head(head, binding), _body(body, binding), statement.span)
        case CrRule(label, head, body):
            return CrRule(label, _head(head, binding), _body(body, binding), statement.span)
    return statement


def _head(head: Head, binding: Binding) -> Head:
    if isinstance(head, Choice):
        elements = tuple(
            ChoiceElement(_atom(each.atom, binding), _literals(each.condition, binding), each.span)
            for each in head.elements
        )
        return Choice(elements, _guard(head.left, binding), _guard(head.right, binding), head.span)
    return tuple(_atom(atom, binding) for atom in head)


def _body(body: tuple[BodyItem, ...], binding: Binding) -> tuple[BodyItem, ...]:
    return tuple(ground_item(item, binding) for item in body)


def _literals(items: tuple[Literal, ...], binding: Binding) -> tuple[Literal, ...]:
    return tuple(ground_item(item, binding) for item in items)  # type: ignore[misc]


def ground_item(item: BodyItem, binding: Binding) -> BodyItem:
    """Returns a literal or an aggregate with values for variables."""
    match item:
        case Naf(operand):
            return Naf(_atom(operand, binding), item.span)
        case Comparison(left, operator, right):
            return Comparison(
                ground_term(left, binding), operator, ground_term(right, binding), item.span
            )
        case Aggregate():
            elements = tuple(_element(each, binding) for each in item.elements)
            guards = _guard(item.left, binding), _guard(item.right, binding)
            return Aggregate(item.function, elements, *guards, item.span)
    return _atom(item, binding)


def _element(element: AggregateElement, binding: Binding) -> AggregateElement:
    """Returns the variables of a tuple are its own, whatever the rule calls by the same name."""
    own = {term.name for term in element.terms if isinstance(term, Variable)}
    outer = {name: value for name, value in binding.items() if name not in own}
    return AggregateElement(element.terms, _literals(element.condition, outer), element.span)


def _guard(guard: Guard | None, binding: Binding) -> Guard | None:
    return None if guard is None else Guard(guard.operator, ground_term(guard.bound, binding))


def _atom(atom: Atom | SortAtom, binding: Binding) -> Atom | SortAtom:
    arguments = tuple(ground_term(term, binding) for term in atom.arguments)
    return type(atom)(atom.name, arguments, atom.negated, atom.span, atom.name_span)


def ground_term(term: Term, binding: Binding) -> Term:
    """Returns the term with values for its variables, ground arithmetic worked out."""
    match term:
        case Variable(name):
            return tree_term(binding[name]) if name in binding else term
        case Record(name, arguments):
            return Record(name, tuple(ground_term(each, binding) for each in arguments), term.span)
        case Arithmetic(operator, left, right):
            first, second = ground_term(left, binding), ground_term(right, binding)
            if isinstance(first, Number) and isinstance(second, Number):
                try:
                    value = apply_operator(operator, first.value, second.value, None)
                except Undefined:
                    pass
                else:
                    return tree_term(value)
            return Arithmetic(operator, first, second, term.span)
    return term


def tree_term(value: Ground | Record) -> Term:
    """Returns a value as a term of the tree."""
    if isinstance(value, int):
        return Number(value)
    if isinstance(value, Record):
        return value
    assert isinstance(value, GroundTerm)
    if not value.arguments:
        return Identifier(value.name)
    return Record(value.name, tuple(map(tree_term, value.arguments)))
