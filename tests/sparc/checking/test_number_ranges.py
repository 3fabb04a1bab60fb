"""Bounds of arithmetic hold for every value, and what may not fit is checked."""

from __future__ import annotations

from itertools import product

import pytest

from sparc.checking.number_ranges import Linear, Ranges, Reach, combine, fits
from sparc.checking.typed_program import Undefined, apply_operator
from sparc.sorts.extents import Extent, IdentifierInterval, Interval, Listed, Records, Sort, Strings
from sparc.sorts.set_operations import Difference, Intersection, Union
from sparc.syntax.cursor import MAX_NUMBER

NUMBERS = Interval(2, 9)
MIXED = Listed(["a", 7, -1])
BOX = Records("f", (Sort("n", NUMBERS), Sort("m", Listed([("g", 40, "x")]))), None, ())


@pytest.mark.parametrize(
    ("low", "high", "fit"),
    [(0, MAX_NUMBER, True), (0, MAX_NUMBER + 1, False), (-MAX_NUMBER, 0, True), (-(2**31), 0, False)],
)  # fmt: skip
def test_what_clingo_can_count_with(low: int, high: int, fit: bool) -> None:
    assert fits(low, high) is fit


@pytest.mark.parametrize("operator", ["+", "-", "*", "/"])
def test_every_value_lies_in_the_range_and_the_ends_are_values(operator: str) -> None:
    ends = [(low, high) for low in (-3, -1, 0, 2) for high in (-1, 0, 1, 4) if low <= high]
    for one, other in product(ends, ends):
        values = []
        for a, b in product(range(one[0], one[1] + 1), range(other[0], other[1] + 1)):
            try:
                values.append(apply_operator(operator, a, b, None))
            except Undefined:
                continue
        reach = combine(operator, Reach(*one), Reach(*other))
        assert not reach.checked and reach.linear is None
        if values:
            assert (reach.low, reach.high) == (min(values), max(values)), (one, other)


X = Reach(0, 10, Linear("X"))


@pytest.mark.parametrize(
    ("operator", "left", "right", "linear"),
    [
        ("+", X, Reach(3, 3), Linear("X", 1, 3)),
        ("-", X, Reach(3, 3), Linear("X", 1, -3)),
        ("-", Reach(3, 3), X, Linear("X", -1, 3)),
        ("+", Reach(3, 3), X, Linear("X", 1, 3)),
        ("*", X, Reach(4, 4), Linear("X", 4)),
        ("*", Reach(4, 4), Reach(0, 20, Linear("X", 2, 1)), Linear("X", 8, 4)),
        ("/", X, Reach(2, 2), None),
        ("+", X, X, None),
        ("*", X, Reach(2, 3), None),
        ("+", Reach(2, 3), X, None),
    ],
)
def test_the_linear_form(operator: str, left: Reach, right: Reach, linear: Linear | None) -> None:
    assert combine(operator, left, right).linear == linear


@pytest.mark.parametrize(
    ("operator", "left", "right"),
    [
        ("*", Reach(0, 70_000), Reach(0, 70_000)),
        ("+", Reach(0, MAX_NUMBER), Reach(1, 1)),
        ("-", Reach(-MAX_NUMBER, 0), Reach(1, 1)),
        ("+", Reach(0, 1, checked=True), Reach(1, 1)),
        ("*", Reach(-3000, 1, Linear("X", 1, -3000)), Reach(1_000_000, 1_000_000)),
        ("-", Reach(0, 5, Linear("X", 1, 0)), Reach(MAX_NUMBER, MAX_NUMBER)),
    ],
    ids=["product", "above", "below", "a part", "the shift of the form", "fits"],
)
def test_what_is_counted_exactly(operator: str, left: Reach, right: Reach) -> None:
    reach = combine(operator, left, right)
    assert reach.checked is (operator != "-" or left.low < 0)
    assert (reach.linear is None) is (reach.checked or left.linear is None)


@pytest.mark.parametrize(
    ("extent", "numbers", "inside"),
    [
        (NUMBERS, (2, 9), None),
        (MIXED, (-1, 7), None),
        (IdentifierInterval("a", "c"), None, None),
        (Listed(["a", ("f", 3, ("g", 8))]), None, (3, 8)),
        (Strings((Interval(1, 2), Interval(0, 10))), (0, 999), None),
        (Strings((Listed(["a"]), Interval(0, 9))), None, None),
        (Union((MIXED, Interval(20, 30))), (-1, 30), None),
        (Difference(NUMBERS, MIXED), (2, 9), None),
        (Intersection(NUMBERS, MIXED), (2, 7), None),
        (Intersection(NUMBERS, Interval(20, 30)), None, None),
        (BOX, None, (2, 40)),
        (Union((BOX, NUMBERS)), (2, 9), (2, 40)),
        (Difference(BOX, NUMBERS), None, (2, 40)),
        (Intersection(BOX, BOX), None, (2, 40)),
    ],
)
def test_the_numbers_of_a_sort(
    extent: Extent, numbers: tuple[int, int] | None, inside: tuple[int, int] | None
) -> None:
    ranges = Ranges(())
    assert ranges.of(extent) == numbers == ranges.of(extent)
    assert ranges.inside(extent) == inside == ranges.inside(extent)


def test_all_the_numbers_of_a_program() -> None:
    assert Ranges((NUMBERS, MIXED, BOX)).widest() == (-1, 40)
    assert Ranges((IdentifierInterval("a", "c"),)).widest() == (0, 0)
