"""A well-typed program: sorts with their extents, predicates with their sorts.

Made by `sparc.checking.checker.check`, read by `sparc.translate`, `sparc.query` and `sparc.checking.warnings`.  The
tree itself stays as it was parsed; `evaluate` gives a ground term its value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from sparc.lazy_dataclass import dataclass, field
from sparc.sorts.extents import Sort
from sparc.sorts.values import Value
from sparc.source import Span
from sparc.syntax.tree import Arithmetic, Identifier, Number, Program, Record, Term, Variable

__all__ = [
    "Signature",
    "TypedProgram",
    "Undefined",
    "apply_operator",
    "evaluate",
    "has_arithmetic",
    "is_ground",
    "subterms",
    "variables",
]


@dataclass(frozen=True)
class Signature:
    """A declared predicate: the sort of each argument, and where it was declared."""

    name: str
    sorts: tuple[Sort, ...]
    span: Span | None = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.name}({', '.join('#' + sort.name for sort in self.sorts)})"


@dataclass(frozen=True)
class TypedProgram:
    """A program without faults.

    ``naturals`` has the variables that occur in arithmetic only and so range over ``#nat``, by
    statement (its index) and scope: 0 is the statement, k its k-th element, those of a choice
    in the head first, then those of the aggregates.
    """

    program: Program
    constants: Mapping[str, int]
    maxint: int
    sorts: Mapping[str, Sort]
    predicates: Mapping[str, Signature]
    naturals: Mapping[tuple[int, int], frozenset[str]]

    def __str__(self) -> str:
        """The text of the program."""
        return str(self.program)

    def _repr_html_(self) -> str:
        """Returns the program for notebooks."""
        return self.program._repr_html_()


class Undefined(Exception):
    """A ground arithmetic term has no value: ``a+1``, ``1/0`` (``by_zero``)."""

    def __init__(self, message: str, span: Span | None, *, by_zero: bool = False) -> None:
        super().__init__(message)
        self.span = span
        self.by_zero = by_zero


def evaluate(term: Term, constants: Mapping[str, int]) -> Value | None:
    """Returns the value of a ground term, None when it has variables; raises `Undefined`.

    >>> evaluate(Record("f", (Arithmetic("/", Number(7), Identifier("n")),)), {"n": 2})
    ('f', 3)
    """
    kind = type(term)
    if kind is Variable:
        return None
    if kind is Identifier:
        return constants.get(term.name, term.name)  # type: ignore[union-attr]
    if kind is Number:
        return term.value  # type: ignore[union-attr]
    if isinstance(term, Record):
        values: list[Value] = [term.name]
        for argument in term.arguments:
            value = evaluate(argument, constants)
            if value is None:
                return None
            values.append(value)
        return tuple(values)
    assert isinstance(term, Arithmetic)
    left, right = evaluate(term.left, constants), evaluate(term.right, constants)
    if left is None or right is None:
        return None
    for value, operand in ((left, term.left), (right, term.right)):
        if type(value) is not int:
            raise Undefined("arithmetic needs numbers", operand.span)
    assert isinstance(left, int) and isinstance(right, int)
    return apply_operator(term.operator, left, right, term.span)


def apply_operator(operator: str, left: int, right: int, span: Span | None) -> int:
    """``left operator right``; ``/`` cuts towards 0.  Raises `Undefined` for division by zero."""
    match operator:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
    if right == 0:
        raise Undefined("division by zero", span, by_zero=True)
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def subterms(term: Term) -> Iterator[Term]:
    """Yields the term, and every term inside it."""
    yield term
    if isinstance(term, Record):
        for part in term.arguments:
            yield from subterms(part)
    elif isinstance(term, Arithmetic):
        yield from subterms(term.left)
        yield from subterms(term.right)


def variables(terms: Iterable[Term]) -> list[Variable]:
    """Returns the variables of terms at every place where they stand, the anonymous ones included.

    >>> [each.name for each in variables([Record("f", (Variable("X"), Number(1))), Variable("X")])]
    ['X', 'X']
    """
    found: list[Variable] = []
    for term in terms:
        kind = type(term)
        if kind is Variable:
            found.append(term)  # type: ignore[arg-type]
        elif kind is Record:
            found += variables(term.arguments)  # type: ignore[union-attr]
        elif kind is Arithmetic:
            found += variables((term.left, term.right))  # type: ignore[union-attr]
    return found


def is_ground(term: Term) -> bool:
    """Returns whether a term has no variable."""
    kind = type(term)
    if kind is Variable:
        return False
    if isinstance(term, Record):
        return all(map(is_ground, term.arguments))
    if isinstance(term, Arithmetic):
        return is_ground(term.left) and is_ground(term.right)
    return True


def has_arithmetic(term: Term) -> bool:
    """Returns whether an operator occurs in a term."""
    if isinstance(term, Record):
        return any(map(has_arithmetic, term.arguments))
    return type(term) is Arithmetic
