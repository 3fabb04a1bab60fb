"""Bounds the results of arithmetic, so that none is ever cut to 32 bits.

clingo counts with 32 bits and says nothing when a result does not fit: 65536*65536 is 0 for it.
`Ranges` gives the least and the greatest number of a sort, `combine` those of an operation; an
operation is ``checked`` where they may not fit, and is then left to functions that count exactly
(`sparc.solving.exact_arithmetic`).

>>> from sparc.sorts.extents import Interval
>>> sides = Ranges(()).of(Interval(0, 70000))
>>> combine("*", Reach(*sides, Linear("X")), Reach(*sides, Linear("X"))).checked
True
>>> combine("+", Reach(*sides, Linear("X")), Reach(1, 1)).checked
False
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.lazy_dataclass import dataclass
from sparc.sorts.extents import Extent, Interval, Listed, Records, Strings
from sparc.sorts.set_operations import Difference, Intersection, Union
from sparc.sorts.values import Value
from sparc.syntax.cursor import MAX_NUMBER

__all__ = ["FUNCTIONS", "Linear", "Range", "Ranges", "Reach", "combine", "fits"]

Range = tuple[int, int]
"""The least and the greatest number, both included."""

FUNCTIONS = {"+": "plus", "-": "minus", "*": "times", "/": "over"}
"""The name of the exact function for each operator."""


@dataclass(frozen=True)
class Linear:
    """``factor * name + shift``: the form into which clingo brings such a term by itself."""

    name: str
    factor: int = 1
    shift: int = 0


@dataclass(frozen=True)
class Reach:
    """The range of a term: every value is a number of ``low..high``, or none.

    ``checked``: the value may leave 32 bits, so the term is written with an exact function.
    """

    low: int
    high: int
    linear: Linear | None = None
    checked: bool = False


def fits(low: int, high: int) -> bool:
    """Returns whether clingo can count with all numbers of the range."""
    return low >= -MAX_NUMBER and high <= MAX_NUMBER


def combine(operator: str, left: Reach, right: Reach) -> Reach:
    """Returns the reach of ``left operator right``.

    An operation of which a part is checked is checked, too: the part may not be a number of
    clingo's.  So is one that fits, but of which the linear form does not: clingo solves
    ``p((X-3000)*1000000)`` for X as ``(p+3000000000)/1000000``.
    """
    corners = _corners(operator, left, right)
    low, high = min(corners, default=0), max(corners, default=0)
    linear = _linear(operator, left, right)
    checked = left.checked or right.checked or not fits(low, high)
    if linear is not None and not checked:
        source = left if left.linear is not None else right
        assert source.linear is not None
        whole = (low - linear.shift, high - linear.shift)
        checked = not (
            fits(linear.shift, linear.shift) and fits(linear.factor, linear.factor) and fits(*whole)
        )
    return Reach(low, high, None if checked else linear, checked)


def _corners(operator: str, left: Reach, right: Reach) -> list[int]:
    """Returns values among which are the least and the greatest."""
    if operator == "+":
        return [left.low + right.low, left.high + right.high]
    if operator == "-":
        return [left.low - right.high, left.high - right.low]
    if operator == "*":
        return [a * b for a in (left.low, left.high) for b in (right.low, right.high)]
    divisors = [b for b in (right.low, -1, 1, right.high) if b and right.low <= b <= right.high]
    dividends = [a for a in (left.low, 0, left.high) if left.low <= a <= left.high]
    return [
        (abs(a) // abs(b)) * (1 if (a < 0) == (b < 0) else -1) for a in dividends for b in divisors
    ]


def _linear(operator: str, left: Reach, right: Reach) -> Linear | None:
    """Returns the linear form of an operation with one variable, None when it has none."""
    if operator == "/" or (left.linear is None) == (right.linear is None):
        return None
    if left.linear is not None:
        if right.low != right.high:
            return None
        form, number = left.linear, right.low
        if operator == "*":
            return Linear(form.name, form.factor * number, form.shift * number)
        shift = number if operator == "+" else -number
        return Linear(form.name, form.factor, form.shift + shift)
    assert right.linear is not None
    if left.low != left.high:
        return None
    form, number = right.linear, left.low
    if operator == "*":
        return Linear(form.name, form.factor * number, form.shift * number)
    sign = 1 if operator == "+" else -1
    return Linear(form.name, sign * form.factor, number + sign * form.shift)


class Ranges:
    """The numbers of extents, each looked at once; ``sorts`` are all that a program has."""

    def __init__(self, sorts: Iterable[Extent]) -> None:
        self._sorts = tuple(sorts)
        self._found: dict[int, Range | None] = {}
        self._inside: dict[int, Range | None] = {}
        self._widest: Range | None = None

    def widest(self) -> Range:
        """Returns the numbers of all sorts, inside of records too: a value of a
        program is among them.
        """
        if self._widest is None:
            reaches = [self.of(sort) for sort in self._sorts]
            reaches += [self.inside(sort) for sort in self._sorts]
            self._widest = _hull(reaches) or (0, 0)
        return self._widest

    def of(self, extent: Extent) -> Range | None:
        """Returns the least and the greatest number among the elements, or a wider range.

        None: no number.
        """
        key = id(extent)
        if key not in self._found:
            self._found[key] = self._of(extent)
        return self._found[key]

    def _of(self, extent: Extent) -> Range | None:
        match extent:
            case Interval():
                return (extent.low, extent.high)
            case Listed():
                numbers = [value for value in extent.values if type(value) is int]
                return (min(numbers), max(numbers)) if numbers else None
            case Strings():
                parts = [self.of(part) for part in extent.parts]
                digits = sum(len(str(part[1])) if part else 1 for part in parts)
                return (0, 10**digits - 1) if extent.has_number() else None
            case Union():
                return _hull([self.of(part) for part in extent.parts])
            case Difference():
                return self.of(extent.left)
            case Intersection():
                left, right = self.of(extent.left), self.of(extent.right)
                if left is None or right is None:
                    return None
                shared = (max(left[0], right[0]), min(left[1], right[1]))
                return shared if shared[0] <= shared[1] else None
        return None

    def inside(self, extent: Extent) -> Range | None:
        """Returns the numbers that stand in the records of an extent, at any depth.

        None: there is none.
        """
        key = id(extent)
        if key not in self._inside:
            self._inside[key] = self._within(extent)
        return self._inside[key]

    def _within(self, extent: Extent) -> Range | None:
        match extent:
            case Listed():
                return None if extent.basic else _nested(extent.values)
            case Records():
                parts = [sort.extent for sort in extent.arguments]
                return _hull([*map(self.of, parts), *map(self.inside, parts)])
            case Union():
                return _hull([self.inside(part) for part in extent.parts])
            case Difference():
                return self.inside(extent.left)
            case Intersection():
                return self.inside(extent.left)
        return None


def _nested(values: Iterable[Value]) -> Range | None:
    numbers: list[int] = []
    stack = [part for value in values if type(value) is tuple for part in value[1:]]
    while stack:
        value = stack.pop()
        if type(value) is tuple:
            stack.extend(value[1:])
        elif type(value) is int:
            numbers.append(value)
    return (min(numbers), max(numbers)) if numbers else None


def _hull(ranges: Iterable[Range | None]) -> Range | None:
    known = [each for each in ranges if each is not None]
    return (min(low for low, _ in known), max(high for _, high in known)) if known else None
