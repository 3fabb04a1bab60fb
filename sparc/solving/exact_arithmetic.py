"""Arithmetic beyond 32 bits for clingo: the functions ``@plus``, ``@minus``, ``@times``, ``@over``.

A translation calls them where a result may not fit (`sparc.checking.number_ranges`).  They count with the integers
of Python; what does not fit comes back as the term ``big("4294967296")``, which they take as an
operand again, and which is in no sort.  ``@order`` compares two terms, ``@bound`` makes of a number
that does not fit a bound that no aggregate reaches, and ``@total`` adds up what a ``#sum`` or an
optimization may have to add, which clingo itself cannot check.

The first argument of a function is the index of its place in `AspProgram.places`.
"""

from __future__ import annotations

from typing import Any

import clingo
from clingo import Function, Number, String, Symbol, SymbolType

from sparc.checking.typed_program import Undefined, apply_operator
from sparc.lazy_dataclass import dataclass
from sparc.syntax.cursor import MAX_NUMBER

__all__ = [
    "ExactArithmetic",
    "Overflow",
    "bound",
    "minus",
    "order",
    "over",
    "plus",
    "times",
    "total",
]

_BIG = "big"


@dataclass(frozen=True)
class Overflow:
    """A result that does not fit: the index of its place, the instance in words, the result."""

    place: int
    instance: str
    value: int


class ExactArithmetic:
    """The functions, as the ``context`` of a grounding.

    ``overflow`` is the first operation that left 32 bits, ``exceeded`` the first sum that may
    leave them.  Nobody waits for what was ``abandoned``: the next operation ends the grounding, with
    `InterruptedError`.
    """

    def __init__(self) -> None:
        self.abandoned = False
        self.overflow: Overflow | None = None
        self.exceeded: Overflow | None = None
        self._totals: dict[tuple[int, Symbol], int] = {}
        self._added: set[tuple[int, Symbol, Symbol]] = set()

    def plus(self, place: Symbol, left: Symbol, right: Symbol) -> Any:
        """``left + right``"""
        return self._result(place, "+", left, right)

    def minus(self, place: Symbol, left: Symbol, right: Symbol) -> Any:
        """``left - right``"""
        return self._result(place, "-", left, right)

    def times(self, place: Symbol, left: Symbol, right: Symbol) -> Any:
        """``left * right``"""
        return self._result(place, "*", left, right)

    def over(self, place: Symbol, left: Symbol, right: Symbol) -> Any:
        """``left / right``, cut towards 0."""
        return self._result(place, "/", left, right)

    def order(self, left: Symbol, right: Symbol) -> Symbol:
        """Returns -1, 0 or 1 where ``left`` comes before ``right``, equals it, or comes after it."""
        self._go_on()
        return Number(_order(left, right))

    def bound(self, value: Symbol) -> Symbol:
        """Returns the number, or what is above or below all numbers when it does not fit."""
        number = _number(value)
        if number is None or -MAX_NUMBER <= number <= MAX_NUMBER:
            return value
        return clingo.Supremum if number > 0 else clingo.Infimum

    def total(self, place: Symbol, group: Symbol, terms: Symbol) -> Symbol:
        """Adds ``terms``, of which the first is a weight, to the sum ``group``; returns 0."""
        self._go_on()
        weight = terms.arguments[0]
        key = (place.number, group)
        if weight.type is SymbolType.Number and (*key, terms) not in self._added:
            self._added.add((*key, terms))
            whole = self._totals.get(key, 0) + abs(weight.number)
            self._totals[key] = whole
            if whole > MAX_NUMBER and self.exceeded is None:
                self.exceeded = Overflow(place.number, str(terms), whole)
        return Number(0)

    def _go_on(self) -> None:
        if self.abandoned:
            raise InterruptedError("this grounding was abandoned")

    def _result(self, place: Symbol, operator: str, left: Symbol, right: Symbol) -> Any:
        """Returns the value as a term; nothing, and so no instance, where it has none."""
        self._go_on()
        first, second = _number(left), _number(right)
        if first is None or second is None:
            return []
        try:
            value = apply_operator(operator, first, second, None)
        except Undefined:
            return []
        if -MAX_NUMBER <= value <= MAX_NUMBER:
            return Number(value)
        if self.overflow is None:
            self.overflow = Overflow(place.number, f"{first}{operator}{second}", value)
        return Function(_BIG, [String(str(value))])


_alone = ExactArithmetic()  # for programs that clingo runs by itself
plus, minus, times, over = _alone.plus, _alone.minus, _alone.times, _alone.over
order, bound = _alone.order, _alone.bound


def total(place: Symbol, group: Symbol, terms: Symbol) -> Symbol:
    """`ExactArithmetic.total`; raises `OverflowError` once the sum is too large."""
    total = _alone.total(place, group, terms)
    if _alone.exceeded is not None:
        raise OverflowError(f"a sum can come to {_alone.exceeded.value}")
    return total


def _number(symbol: Symbol) -> int | None:
    """Returns the number that a term stands for, None when it is none."""
    if symbol.type is SymbolType.Number:
        return symbol.number
    if symbol.type is SymbolType.Function and symbol.name == _BIG and len(symbol.arguments) == 1:
        (text,) = symbol.arguments
        if text.type is SymbolType.String:  # a record of SPARC has no strings
            return int(text.string)
    return None


def _order(left: Symbol, right: Symbol) -> int:
    """Compares terms in clingo's order, with numbers of any size as numbers."""
    first, second = _number(left), _number(right)
    if first is not None and second is not None:
        return (first > second) - (first < second)
    if first is not None or second is not None:
        return -1 if first is not None else 1
    if left.name == right.name and len(left.arguments) == len(right.arguments):
        pairs = zip(left.arguments, right.arguments, strict=True)
        return next(filter(None, (_order(a, b) for a, b in pairs)), 0)
    return -1 if left < right else 1
