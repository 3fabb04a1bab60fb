"""Union, difference and intersection, and what is provably part of what."""

from __future__ import annotations

import pytest

from sparc.sorts.extents import (
    Extent,
    IdentifierInterval,
    Interval,
    Listed,
    Records,
    Sort,
    Strings,
)
from sparc.sorts.lazy_values import COUNTED
from sparc.sorts.set_operations import Difference, Intersection, Union, is_subset
from sparc.sorts.values import Value
from sparc.syntax.tree import ConditionTest, Variable

DIGITS = Interval(1, 4)
WORDS = Listed(["a", "b", "c"])
TWICE = Strings((Listed(["a", "ab"]), Listed(["b", "bb"])))  # abb is put together in two ways
HUGE = Interval(1, 10**18)


def box(name: str, *arguments: Extent, condition: ConditionTest | None = None) -> Records:
    sorts = tuple(Sort(f"s{n}", extent) for n, extent in enumerate(arguments))
    return Records(name, sorts, condition, (("X", 0), ("Y", 1)))


@pytest.mark.parametrize(
    ("extent", "elements"),
    [
        (Union((DIGITS, WORDS, Interval(3, 5))), [1, 2, 3, 4, "a", "b", "c", 5]),
        (Difference(DIGITS, Listed([2, "a"])), [1, 3, 4]),
        (Intersection(WORDS, Listed(["c", "z", "a"])), ["a", "c"]),
        (Intersection(Interval(1, 10**12), Listed([7, 0, "a"])), [7]),
        (Difference(Union((DIGITS, WORDS)), Interval(1, 9)), ["a", "b", "c"]),
        (Intersection(box("f", DIGITS), box("f", Interval(4, 9))), [("f", 4)]),
    ],
    ids=["each once", "difference", "order of the smaller", "huge", "kinds", "records"],
)
def test_elements(extent: Extent, elements: list[Value]) -> None:
    assert list(extent) == elements
    assert all(value in extent for value in elements) and 99 not in extent
    assert extent.has_number() is any(type(value) is int for value in elements)
    assert len(elements) <= extent.bound() and not extent.is_empty()


@pytest.mark.parametrize(
    "extent",
    [
        Difference(DIGITS, Interval(0, 9)),
        Difference(TWICE, Listed(["ab", "abb", "abbb"])),
        Difference(IdentifierInterval("nos", "nou"), Listed(["nos", "nou"])),
        Difference(Union((WORDS, WORDS)), WORDS),
        Difference(Difference(DIGITS, Listed([1])), Interval(2, 4)),
        Intersection(DIGITS, WORDS),
        Intersection(box("f", DIGITS), Listed([("g", 1)])),
        Union((Interval(2, 1), Listed([]))),
    ],
    ids=["part", "two ways to put together", "not is none", "the same twice", "twice", "kinds",
         "no such record", "nothing"],
)  # fmt: skip
def test_what_is_empty(extent: Extent) -> None:
    assert extent.is_empty() and not list(extent)
    assert not extent.has_number()


def test_records_of_different_names_share_nothing_however_many_they_are() -> None:
    assert Intersection(box("f", HUGE, HUGE), box("g", HUGE, HUGE)).is_empty()


@pytest.mark.parametrize(
    "extent",
    [
        Difference(HUGE, Interval(1, 10**17)),
        Difference(Listed(range(50)), Listed([*range(49), "a"])),
        Difference(TWICE, Listed(["ab", "abb"])),
        Intersection(HUGE, Interval(5, 10**18)),
        Intersection(box("f", HUGE, HUGE), box("f", HUGE, HUGE)),
        Union((Listed([]), DIGITS)),
    ],
    ids=["by size", "all but one", "one left", "overlap", "same records", "one part"],
)
def test_what_is_not_empty(extent: Extent) -> None:
    assert not extent.is_empty()


def test_sizes_are_bounds() -> None:
    assert Union((HUGE, HUGE)).bound() == COUNTED
    assert Difference(DIGITS, WORDS).bound() == 4
    assert Intersection(HUGE, WORDS).bound() == 3


def test_records_of_parts() -> None:
    f, g = box("f", DIGITS), box("g", WORDS)
    listed = Listed([("f", 9)])
    assert Union((f, g, f)).boxes("f", 1) == (f,)
    assert Union((f, listed)).boxes("f", 1) is None
    without = Difference(Union((f, g)), Listed([("g", "a")]))
    assert without.boxes("f", 1) == (f,) and without.boxes("g", 1) is None
    assert Difference(f, WORDS).boxes("f", 1) == (f,)
    assert Difference(f, listed).boxes("f", 1) is None
    assert Intersection(f, g).boxes("f", 1) == ()
    assert Intersection(f, Union((f, g))).boxes("f", 1) is None
    assert Union((f, g)).signatures() == {("f", 1), ("g", 1)}
    assert Difference(f, g).signatures() == {("f", 1)}
    assert Intersection(f, g).signatures() == set()


@pytest.mark.parametrize(
    ("small", "large", "known"),
    [
        (Interval(2, 3), DIGITS, True),
        (Interval(0, 3), DIGITS, False),
        (HUGE, box("f", DIGITS), False),
        (Interval(1, 3), Listed([3, 2, 1]), True),
        (Listed([1, "a"]), Union((DIGITS, WORDS)), True),
        (Listed([1, "z"]), Union((DIGITS, WORDS)), False),
        (Union((Interval(1, 2), Listed(["a"]))), Union((DIGITS, WORDS)), True),
        (Difference(WORDS, DIGITS), WORDS, True),
        (Intersection(HUGE, WORDS), WORDS, True),
        (box("f", Interval(1, 2)), box("f", DIGITS), True),
        (box("f", HUGE), box("f", DIGITS), False),
        (box("f", DIGITS), box("g", DIGITS), False),
        (box("f", DIGITS), box("f", DIGITS, DIGITS), False),
        (TWICE, Listed(["ab", "abb", "abbb"]), False),  # so it is, but nobody looks
    ],
)
def test_what_is_part_of_what(small: Extent, large: Extent, known: bool) -> None:
    assert is_subset(small, large) is known


def test_a_condition_narrows_a_record() -> None:
    less = ConditionTest(Variable("X"), "<", Variable("Y"))
    narrow, wide = box("f", DIGITS, DIGITS, condition=less), box("f", DIGITS, DIGITS)
    assert is_subset(narrow, wide) and not is_subset(wide, narrow)
    assert is_subset(narrow, narrow)


def test_answers_are_remembered_by_the_extents_at_hand() -> None:
    known: dict[tuple[int, int], bool] = {}
    small, large = Interval(1, 2), Union((DIGITS, WORDS))
    assert is_subset(small, large, known)
    assert known[id(small), id(large)] is True
    known[id(small), id(large)] = False
    assert not is_subset(small, large, known)
