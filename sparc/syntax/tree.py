"""The frozen tree of a SPARC program: what the parser makes and all later stages read.

Spans take no part in comparison, so trees compare by meaning.  The form follows the SPARC
manual (Balai, Gelfond, Zhang 2013): directives, sorts, predicates, rules, display.
"""

from __future__ import annotations

from typing import TypeAlias

from sparc.lazy_dataclass import dataclass, field
from sparc.source import Source, Span

__all__ = [
    "Aggregate", "AggregateElement", "And", "Arithmetic", "Atom", "BodyItem", "Choice",
    "ChoiceElement", "Comparison", "Concatenation", "Condition", "ConditionTest", "ConstDirective",
    "CrRule", "DisplayItem", "DisplaySort", "Guard", "Head", "IdentifierRange", "Identifier",
    "IdentifierList", "Literal", "MaxintDirective", "Naf", "Not", "Number", "NumericRange",
    "Optimize", "Or", "PredicateDeclaration", "Program", "RangeFact", "Record", "RecordSort",
    "RecordSortArgument", "Rule", "SetExpression", "SortAtom", "SortDefinition", "SortExpression",
    "SortName", "Statement", "Term", "TermSet", "Variable", "WeakConstraint",
]  # fmt: skip


def _span() -> Span:
    """Returns a span field: not compared, not shown, and required by convention of the parser."""
    return field(compare=False, repr=False, default=None)  # type: ignore[return-value]


# ------------------------------------------------------------------ terms


@dataclass(frozen=True)
class Variable:
    """``X``; the anonymous variable has the name ``_``."""

    name: str
    span: Span = _span()


@dataclass(frozen=True)
class Number:
    """A non-negative integer as written."""

    value: int
    span: Span = _span()


@dataclass(frozen=True)
class Identifier:
    """``a``: a symbolic constant, or the name of a ``#const``."""

    name: str
    span: Span = _span()


@dataclass(frozen=True)
class Record:
    """``f(t1,...,tn)`` with n >= 1."""

    name: str
    arguments: tuple[Term, ...]
    span: Span = _span()


@dataclass(frozen=True)
class Arithmetic:
    """``left operator right`` with operator one of ``+ - * /``."""

    operator: str
    left: Term
    right: Term
    span: Span = _span()


Term: TypeAlias = Variable | Number | Identifier | Record | Arithmetic


# ------------------------------------------------------------------ directives


@dataclass(frozen=True)
class ConstDirective:
    """``#const name = value.`` where the value is a number or a constant defined above."""

    name: str
    value: Number | Identifier
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class MaxintDirective:
    """``#maxint = value.``"""

    value: Number | Identifier
    span: Span = _span()


# ------------------------------------------------------------------ sorts


@dataclass(frozen=True)
class SortName:
    """``#name`` as an operand (the name is kept without its ``#``)."""

    name: str
    span: Span = _span()


@dataclass(frozen=True)
class NumericRange:
    """``low..high``, numbers or names of constants."""

    low: Number | Identifier
    high: Number | Identifier
    span: Span = _span()


@dataclass(frozen=True)
class IdentifierRange:
    """``first..last`` over identifiers.

    ``a..c`` is one of these unless both ends are numbers or constants defined above.
    """

    first: Identifier
    last: Identifier
    span: Span = _span()


@dataclass(frozen=True)
class IdentifierList:
    """``a,b`` as a part of a concatenation (``[a,b]``)."""

    names: tuple[Identifier, ...]
    span: Span = _span()


@dataclass(frozen=True)
class TermSet:
    """``{t1,...,tn}`` of ground terms."""

    terms: tuple[Term, ...]
    span: Span = _span()


@dataclass(frozen=True)
class RecordSortArgument:
    """``#s`` or ``#s(X)`` inside a record."""

    sort: SortName
    variable: Variable | None
    span: Span = _span()


@dataclass(frozen=True)
class ConditionTest:
    """``X < Y`` in a record's condition (``==`` is read as ``=``)."""

    left: Variable
    operator: str
    right: Variable
    span: Span = _span()


@dataclass(frozen=True)
class Not:
    """``not(condition)``."""

    operand: Condition
    span: Span = _span()


@dataclass(frozen=True)
class And:
    """``left and right and ...`` (two operands or more)."""

    operands: tuple[Condition, ...]
    span: Span = _span()


@dataclass(frozen=True)
class Or:
    """``left or right or ...`` (two operands or more)."""

    operands: tuple[Condition, ...]
    span: Span = _span()


Condition: TypeAlias = ConditionTest | Not | And | Or


@dataclass(frozen=True)
class RecordSort:
    """``f(#s(X),...) : condition``."""

    name: str
    arguments: tuple[RecordSortArgument, ...]
    condition: Condition | None
    span: Span = _span()


@dataclass(frozen=True)
class SetExpression:
    """``left operator right`` with operator ``+`` (union), ``-`` (difference), ``*`` (intersection)."""

    operator: str
    left: SortExpression
    right: SortExpression
    span: Span = _span()


@dataclass(frozen=True)
class Concatenation:
    """``[part]...[part]``."""

    parts: tuple[NumericRange | IdentifierRange | IdentifierList | SortName, ...]
    span: Span = _span()


SortExpression: TypeAlias = (
    SortName | NumericRange | IdentifierRange | TermSet | RecordSort | SetExpression | Concatenation
)


@dataclass(frozen=True)
class SortDefinition:
    """``#name = expression.``"""

    name: str
    expression: SortExpression
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class PredicateDeclaration:
    """``name(#s1,...,#sn).``"""

    name: str
    sorts: tuple[SortName, ...]
    span: Span = _span()
    name_span: Span = _span()


# ------------------------------------------------------------------ atoms and literals


@dataclass(frozen=True)
class Atom:
    """``p(t1,...,tn)``, or ``-p(...)`` when ``negated`` (strong negation)."""

    name: str
    arguments: tuple[Term, ...]
    negated: bool = False
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class SortAtom:
    """``#s(t)``; the parser keeps any number of arguments, the checker wants one."""

    name: str
    arguments: tuple[Term, ...]
    negated: bool = False
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class Comparison:
    """``left operator right``; ``==`` is kept as ``=``."""

    left: Term
    operator: str
    right: Term
    span: Span = _span()


@dataclass(frozen=True)
class Naf:
    """``not literal`` (negation as failure)."""

    operand: Atom | SortAtom
    span: Span = _span()


Literal: TypeAlias = Atom | SortAtom | Comparison | Naf


@dataclass(frozen=True)
class AggregateElement:
    """``t1,...,tk : condition``."""

    terms: tuple[Term, ...]
    condition: tuple[Literal, ...]
    span: Span = _span()


@dataclass(frozen=True)
class Guard:
    """One side of an aggregate or a choice: ``bound operator``.

    On the left side the guard reads ``bound operator {``; on the right ``} operator bound``.
    """

    operator: str
    bound: Term
    span: Span = _span()


@dataclass(frozen=True)
class Aggregate:
    """``left #function{elements} right`` with function ``count``, ``sum``, ``min`` or ``max``."""

    function: str
    elements: tuple[AggregateElement, ...]
    left: Guard | None
    right: Guard | None
    span: Span = _span()


BodyItem: TypeAlias = Literal | Aggregate


@dataclass(frozen=True)
class ChoiceElement:
    """``atom : condition``; without a condition the element ranges over its sorts."""

    atom: Atom | SortAtom
    condition: tuple[Literal, ...]
    span: Span = _span()


@dataclass(frozen=True)
class Choice:
    """``left {elements} right``."""

    elements: tuple[ChoiceElement, ...]
    left: Guard | None
    right: Guard | None
    span: Span = _span()


# A disjunction of atoms (empty: a constraint), or one choice.
Head: TypeAlias = tuple[Atom | SortAtom, ...] | Choice


# ------------------------------------------------------------------ statements


@dataclass(frozen=True)
class Rule:
    """``head :- body.``; a fact has no body, a constraint no head."""

    head: Head
    body: tuple[BodyItem, ...]
    span: Span = _span()


@dataclass(frozen=True)
class RangeFact:
    """``p(low..high).``"""

    name: str
    low: Number | Identifier
    high: Number | Identifier
    negated: bool = False
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class CrRule:
    """``label : head :+ body.``, a consistency-restoring rule."""

    label: str | None
    head: Head
    body: tuple[BodyItem, ...]
    span: Span = _span()
    label_span: Span = _span()


@dataclass(frozen=True)
class WeakConstraint:
    """``:~ body. [weight:level]``"""

    body: tuple[BodyItem, ...]
    weight: Term | None
    level: Term | None
    span: Span = _span()


@dataclass(frozen=True)
class Optimize:
    """``#minimize{p1@l,...,pk : atoms}.`` or ``#maximize``.

    ``priority`` is the number after ``@``; ``priority_index`` tells which parameter bears it.
    """

    maximize: bool
    parameters: tuple[Term, ...]
    priority: Term | None
    atoms: tuple[Atom, ...]
    span: Span = _span()
    priority_index: int = 0


Statement: TypeAlias = Rule | RangeFact | CrRule | WeakConstraint | Optimize


@dataclass(frozen=True)
class DisplayItem:
    """``p.``, ``-p.``, ``p(t1,...,tn).`` (``arguments`` None: every argument)."""

    name: str
    arguments: tuple[Term, ...] | None
    negated: bool = False
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class DisplaySort:
    """``#s.`` or ``#s(t).`` in the display section."""

    name: str
    argument: Term | None
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True)
class Program:
    """A whole program; ``display`` is None when it has no display section."""

    directives: tuple[ConstDirective | MaxintDirective, ...]
    sorts: tuple[SortDefinition, ...]
    predicates: tuple[PredicateDeclaration, ...]
    statements: tuple[Statement, ...]
    display: tuple[DisplayItem | DisplaySort, ...] | None
    source: Source = field(compare=False, repr=False, default=None)  # type: ignore[assignment]

    def __str__(self) -> str:
        """The text that was read; of a tree made otherwise, its values."""
        return repr(self) if self.source is None else self.source.text

    def _repr_html_(self) -> str:
        """Returns the program for notebooks."""
        from sparc.notebook import program_text

        return program_text(str(self))
