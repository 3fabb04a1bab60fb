"""Writes trees as SPARC text: Program → str, with :func:`print_program`.

The text is canonical, and reading it gives an equal tree: ``parse(print_program(p)) == p``.
Entry points for parts: :func:`print_statement`, :func:`print_term`.

>>> from sparc.syntax.tree import Arithmetic, Number, Record, Variable
>>> total = Arithmetic("+", Variable("X"), Number(1))
>>> print_term(Record("f", (Arithmetic("*", total, Number(2)), Number(7))))
'f((X+1)*2,7)'
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from sparc.syntax.lexer import SECTION_WORDS
from sparc.syntax.sort_parser import LEFT_DEEP_OPERANDS
from sparc.syntax.tree import (
    Aggregate,
    And,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    Comparison,
    Concatenation,
    Condition,
    ConditionTest,
    ConstDirective,
    CrRule,
    DisplayItem,
    DisplaySort,
    Guard,
    Head,
    Identifier,
    IdentifierList,
    IdentifierRange,
    MaxintDirective,
    Naf,
    Not,
    Number,
    NumericRange,
    Optimize,
    Or,
    PredicateDeclaration,
    Program,
    RangeFact,
    Record,
    RecordSort,
    RecordSortArgument,
    Rule,
    SetExpression,
    SortAtom,
    SortDefinition,
    SortExpression,
    SortName,
    Statement,
    Term,
    TermSet,
    Variable,
    WeakConstraint,
)

__all__ = ["print_program", "print_statement", "print_term"]

AnyStatement: TypeAlias = (
    ConstDirective
    | MaxintDirective
    | SortDefinition
    | PredicateDeclaration
    | Statement
    | DisplayItem
    | DisplaySort
)

_BINDING = {"+": 1, "-": 1, "*": 2, "/": 2}

# Stands behind a name that would open a section if white space followed: eats the space.
_GLUE = "\0"
_GLUED = {word: word + _GLUE for word in SECTION_WORDS}


def print_program(program: Program) -> str:
    """Returns the whole program, a statement a line; an empty section ``sorts`` is left out."""
    sections: list[tuple[str, Iterable[AnyStatement]]] = []
    if program.sorts:
        sections.append(("sorts", program.sorts))
    sections.append(("predicates", program.predicates))
    sections.append(("rules", program.statements))
    if program.display is not None:
        sections.append(("display", program.display))
    blocks = ["".join(print_statement(item) + "\n" for item in program.directives)]
    for word, items in sections:
        blocks.append(word + "\n" + "".join(print_statement(item) + "\n" for item in items))
    return "\n".join(block for block in blocks if block)


def print_statement(statement: AnyStatement) -> str:
    """Returns one statement of any section, its dot included, on one line."""
    return _unglue(_statement(statement))


def print_term(term: Term) -> str:
    """Returns a term, without white space."""
    return _unglue(_term(term))


def _unglue(text: str) -> str:
    """Returns the text without the marks behind section words, and without the spaces after these."""
    if _GLUE not in text:
        return text
    return text.replace(_GLUE + " ", "").replace(_GLUE, "")


def _name(name: str) -> str:
    """Returns the name of a predicate, function or constant."""
    return _GLUED.get(name, name)


def _statement(statement: AnyStatement) -> str:
    match statement:
        case Rule(head, body):
            return _implication(head, ":-", body)
        case RangeFact(name, low, high, negated):
            return f"{_sign(negated)}{_name(name)}({_term(low)}..{_term(high)})."
        case CrRule(label, head, body):
            prefix = "" if label is None else f"{_name(label)} : "
            return prefix + _implication(head, ":+", body)
        case WeakConstraint(body, weight, level):
            text = f":~ {_items(body)}."
            if weight is None and level is None:
                return text
            left = "" if weight is None else _term(weight)
            return f"{text} [{left}:{'' if level is None else _term(level)}]"
        case Optimize():
            return _optimize(statement)
        case SortDefinition(name, expression):
            return f"#{_name(name)} = {_expression(expression)}."
        case PredicateDeclaration(name, sorts):
            return f"{_name(name)}({', '.join(map(_expression, sorts))})."
        case DisplayItem(name, arguments, negated):
            shown = "" if arguments is None else _arguments(arguments)
            return f"{_sign(negated)}{_name(name)}{shown}."
        case DisplaySort(name, argument):
            shown = "" if argument is None else _arguments((argument,))
            return f"#{_name(name)}{shown}."
        case ConstDirective(name, value):
            return f"#const {_name(name)} = {_term(value)}."
        case MaxintDirective(value):
            return f"#maxint = {_term(value)}."


def _implication(head: Head, connective: str, body: tuple[BodyItem, ...]) -> str:
    """Returns a rule or cr-rule."""
    left = _choice(head) if isinstance(head, Choice) else " | ".join(map(_item, head))
    if body:
        return f"{left} {connective} {_items(body)}.".lstrip()
    return f"{left}." if connective == ":-" else f"{left} {connective} ."


def _choice(choice: Choice) -> str:
    elements = []
    for element in choice.elements:
        condition = f" : {_items(element.condition)}" if element.condition else ""
        elements.append(_item(element.atom) + condition)
    left = f"{_left(choice.left)} " if choice.left is not None else ""
    right = f" {_right(choice.right)}" if choice.right is not None else ""
    return f"{left}{{{'; '.join(elements)}}}{right}"


def _optimize(statement: Optimize) -> str:
    word = "#maximize" if statement.maximize else "#minimize"
    parameters = [_term(parameter) for parameter in statement.parameters]
    if statement.priority is not None:
        parameters[statement.priority_index] += f"@{_term(statement.priority)}"
    return f"{word}{{{','.join(parameters)} : {_items(statement.atoms)}}}."


def _items(items: Iterable[BodyItem]) -> str:
    """Returns literals and aggregates in a row."""
    return ", ".join(map(_item, items))


def _item(item: BodyItem) -> str:
    match item:
        case Atom(name, arguments, negated):
            return f"{_sign(negated)}{_name(name)}{_arguments(arguments)}"
        case SortAtom(name, arguments, negated):
            return f"{_sign(negated)}#{_name(name)}{_arguments(arguments)}"
        case Naf(operand):
            return f"not {_item(operand)}"
        case Comparison(left, operator, right):
            return f"{_term(left)} {operator} {_term(right)}"
        case Aggregate(function, elements, lower, upper):
            inner = "; ".join(
                f"{','.join(map(_term, element.terms))} : {_items(element.condition)}"
                for element in elements
            )
            before = f"{_left(lower)} " if lower is not None else ""
            after = f" {_right(upper)}" if upper is not None else ""
            return f"{before}#{function}{{{inner}}}{after}"


def _left(guard: Guard) -> str:
    return f"{_term(guard.bound)} {guard.operator}"


def _right(guard: Guard) -> str:
    return f"{guard.operator} {_term(guard.bound)}"


def _sign(negated: bool) -> str:
    return "-" if negated else ""


def _arguments(terms: tuple[Term, ...]) -> str:
    """Returns terms in parentheses; nothing where there are none."""
    return f"({','.join(map(_term, terms))})" if terms else ""


def _term(term: Term) -> str:
    match term:
        case Variable(name):
            return name
        case Number(value):
            return str(value)
        case Identifier(name):
            return _name(name)
        case Record(name, arguments):
            return f"{_name(name)}{_arguments(arguments)}"
        case Arithmetic(operator, left, right):
            binding = _BINDING[operator]
            return f"{_factor(left, binding)}{operator}{_factor(right, binding + 1)}"


def _factor(term: Term, binding: int) -> str:
    """Returns an operand, in parentheses if it binds less than ``binding``."""
    text = _term(term)
    if isinstance(term, Arithmetic) and _BINDING[term.operator] < binding:
        return f"({text})"
    return text


def _expression(expression: SortExpression) -> str:
    match expression:
        case SortName(name):
            return f"#{_name(name)}"
        case NumericRange(low, high):
            return f"{_term(low)}..{_term(high)}"
        case IdentifierRange(low, high):
            return f"{_term(low)}..{_term(high)}"
        case TermSet(terms):
            return f"{{{', '.join(map(_term, terms))}}}"
        case RecordSort(name, arguments, condition):
            inner = ", ".join(map(_record_argument, arguments))
            suffix = "" if condition is None else f" : {_condition(condition)}"
            return f"{_name(name)}({inner}){suffix}"
        case SetExpression():
            return _set_expression(expression)
        case Concatenation(parts):
            return "".join(f"[{_part(part)}]" for part in parts)


def _record_argument(argument: RecordSortArgument) -> str:
    variable = "" if argument.variable is None else f"({argument.variable.name})"
    return _expression(argument.sort) + variable


def _part(part: NumericRange | IdentifierRange | IdentifierList | SortName) -> str:
    if isinstance(part, IdentifierList):
        return ",".join(map(_term, part.names))
    return _expression(part)


def _set_expression(expression: SetExpression) -> str:
    """Operands from left to right; parentheses keep the parser from balancing a long chain."""
    binding = _BINDING[expression.operator]
    node: SortExpression = expression
    chain = []
    while isinstance(node, SetExpression) and _BINDING[node.operator] == binding:
        chain.append((node.operator, node.right))
        node = node.left
    text = _set_operand(node, binding)
    run = 1
    for operator, right in reversed(chain):
        if operator == "-":
            run = 1
        elif run == LEFT_DEEP_OPERANDS:
            text, run = f"({text})", 2
        else:
            run += 1
        text = f"{text} {operator} {_set_operand(right, binding + 1)}"
    return text


def _set_operand(expression: SortExpression, binding: int) -> str:
    text = _expression(expression)
    if isinstance(expression, SetExpression) and _BINDING[expression.operator] < binding:
        return f"({text})"
    return text


def _condition(condition: Condition) -> str:
    match condition:
        case ConditionTest(left, operator, right):
            return f"{left.name} {operator} {right.name}"
        case Not(operand):
            return f"not({_condition(operand)})"
        case And(operands):
            return " and ".join(
                f"({_condition(o)})" if isinstance(o, (And, Or)) else _condition(o)
                for o in operands
            )
        case Or(operands):
            return " or ".join(
                f"({_condition(o)})" if isinstance(o, Or) else _condition(o) for o in operands
            )
