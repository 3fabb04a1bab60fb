"""Each kind of extent by itself: its elements, its size, its numbers, its records."""

from __future__ import annotations

import pytest

from sparc.errors import LimitError
from sparc.sorts.extents import (
    MAX_LISTED,
    Extent,
    IdentifierInterval,
    Interval,
    Listed,
    Records,
    Sort,
    Strings,
    listing,
    require_listable,
)
from sparc.sorts.lazy_values import COUNTED
from sparc.sorts.values import Value
from sparc.syntax.tree import And, Condition, ConditionTest, Not, Or, Variable

X, Y = Variable("X"), Variable("Y")
DIGITS = Sort("digit", Interval(1, 3))
WORDS = Sort("word", Listed(["b", "a", "b"]))


def records(condition: Condition | None = None, name: str = "f", *more: Sort) -> Records:
    """``f(#digit(X),#digit(Y),…) : condition``."""
    return Records(name, (DIGITS, DIGITS, *more), condition, (("X", 0), ("Y", 1)))


@pytest.mark.parametrize(
    ("extent", "elements", "has_number"),
    [
        (Interval(2, 4), [2, 3, 4], True),
        (Interval(3, 3), [3], True),
        (Interval(4, 3), [], False),
        (IdentifierInterval("ay", "bb"), ["ay", "az", "ba", "bb"], False),
        (IdentifierInterval("nos", "nou"), ["nos", "nou"], False),
        (IdentifierInterval("azz", "bab"), ["azz", "baa", "bab"], False),
        (IdentifierInterval("not", "not"), [], False),
        (Listed(["b", 7, "b", ("f", 1)]), ["b", 7, ("f", 1)], True),
        (Listed([]), [], False),
        (Strings((Listed(["a", "ab"]), Listed(["b", "bb"]))), ["ab", "abb", "abbb"], False),
        (Strings((Interval(1, 2), Interval(0, 1))), [10, 11, 20, 21], True),
        (Strings((Listed(["x"]), Interval(9, 10))), ["x9", "x10"], False),
        (Records("g", (WORDS,), None, ()), [("g", "b"), ("g", "a")], False),
    ],
    ids=["range", "one", "turned round", "carry", "without not", "two carries", "only not",
         "each once", "nothing", "two ways", "numbers", "mixed", "records"],
)  # fmt: skip
def test_elements(extent: Extent, elements: list[Value], has_number: bool) -> None:
    assert list(extent) == elements
    assert all(value in extent for value in elements)
    assert extent.bound() >= len(elements)
    assert extent.is_empty() is not bool(elements)
    assert extent.has_number() is has_number


@pytest.mark.parametrize(
    ("extent", "stranger"),
    [
        (Interval(1, 3), 4), (Interval(1, 3), "a"), (Interval(0, 1), "0"),
        (IdentifierInterval("a", "c"), "aa"), (IdentifierInterval("a", "c"), "d"),
        (IdentifierInterval("aa", "cc"), "b1"), (IdentifierInterval("aa", "cc"), "bB"),
        (IdentifierInterval("nos", "nou"), "not"), (IdentifierInterval("a", "c"), 1),
        (Listed(["a", 1]), "1"),
        (Strings((Listed(["x"]), Interval(9, 10))), "x09"),
        (Strings((Interval(1, 2), Interval(0, 1))), "10"),
        (Strings((Listed(["x"]), Listed(["y"]))), ("xy", 1)),
        (records(), ("f", 1)), (records(), ("g", 1, 1)), (records(), ("f", 1, 4)), (records(), "f"),
    ],
)  # fmt: skip
def test_what_is_no_element(extent: Extent, stranger: Value) -> None:
    assert stranger not in extent


@pytest.mark.parametrize(
    ("condition", "pairs"),
    [
        (ConditionTest(X, "<", Y), "12 13 23"),
        (ConditionTest(Y, ">=", X), "11 12 13 22 23 33"),
        (Not(ConditionTest(X, "!=", Y)), "11 22 33"),
        (And((ConditionTest(X, "<=", Y), Not(ConditionTest(X, "=", Y)))), "12 13 23"),
        (Or((ConditionTest(X, "=", Y), ConditionTest(X, ">", Y))), "11 21 22 31 32 33"),
        (ConditionTest(X, "=", X), "11 12 13 21 22 23 31 32 33"),
    ],
)
def test_the_condition_of_a_record(condition: Condition, pairs: str) -> None:
    box = records(condition)
    chosen = [("f", int(pair[0]), int(pair[1])) for pair in pairs.split()]
    assert sorted(box) == chosen  # type: ignore[type-var]
    assert all((value in box) is (value in chosen) for value in records())


def test_arguments_keep_their_places_where_the_condition_names_some_of_them() -> None:
    places = (("X", 2), ("Y", 1))
    box = Records("f", (WORDS, DIGITS, DIGITS), ConditionTest(X, "<", Y), places)
    assert set(box) == {("f", w, y, x) for w in "ab" for x, y in ((1, 2), (1, 3), (2, 3))}


def test_a_condition_that_nothing_fulfils_makes_a_record_empty() -> None:
    less = ConditionTest(X, "<", Y)
    assert records(And((less, ConditionTest(Y, "<", X)))).is_empty()
    assert not records(less).is_empty()
    assert records(None, "f", Sort("none", Listed([]))).is_empty()


def test_sizes_are_counted_without_listing_and_up_to_a_limit() -> None:
    wide = Sort("wide", Interval(1, 10**10))
    assert records().bound() == 9
    assert Records("f", (wide, wide), None, ()).bound() == COUNTED
    assert IdentifierInterval("aa", "zz").bound() == 26 * 26


def test_records_are_known_by_name_and_number_of_arguments() -> None:
    inner = Sort("inner", Listed(["a", ("h", ("k", 1, 2))]))
    outer = Records("g", (inner,), None, ())
    assert outer.signatures() == {("g", 1), ("h", 1), ("k", 2)}
    assert outer.boxes("g", 1) == (outer,)
    assert outer.boxes("g", 2) == outer.boxes("h", 1) == ()
    assert inner.extent.boxes("h", 1) is None  # listed one by one: no box
    assert inner.extent.boxes("h", 2) == () == inner.extent.boxes("k", 2)


@pytest.mark.parametrize(
    ("extent", "depth", "basic"),
    [
        (Interval(1, 2), 0, True),
        (Listed(["a"]), 0, True),
        (Listed([("f", 1)]), 0, False),
        (Strings((Interval(1, 2), Interval(1, 2))), 1, True),
        (records(), 1, False),
        (records(None, "g", Sort("f", records())), 2, False),
    ],
)
def test_how_deep_and_whether_there_are_records(extent: Extent, depth: int, basic: bool) -> None:
    assert (extent.depth, extent.basic) == (depth, basic)


def test_a_sort_asks_its_extent_once() -> None:
    class Asked(Interval):
        asked = 0

        def is_empty(self) -> bool:
            Asked.asked += 1
            return super().is_empty()

    sort = Sort("s", Asked(1, 2))
    assert not sort.is_empty() and not sort.is_empty() and Asked.asked == 1
    assert (sort.bound(), sort.signatures(), repr(sort)) == (2, set(), "Sort(#s)")


@pytest.mark.parametrize(
    ("sorts", "condition", "shown"),
    [
        ((Interval(1, 3000), Interval(1, 3000)), None, "9,000,000"),
        ((Interval(1, 3000), Interval(1, 3000)), ConditionTest(X, "<", Y), "up to 9,000,000"),
        ((Interval(1, 10**9), Interval(1, 10**9)), None, "countless"),
        ((Interval(1, 6_000_000), IdentifierInterval("a", "b")), None, "up to 12,000,000"),
    ],
)
def test_a_sort_too_large_to_list(
    sorts: tuple[Extent, Extent], condition: Condition | None, shown: str
) -> None:
    arguments = tuple(Sort(f"s{n}", extent) for n, extent in enumerate(sorts))
    box = Records("f", arguments, condition, (("X", 0), ("Y", 1)))
    with pytest.raises(LimitError, match=f"sort #big has {shown} elements"):
        listing(box, "big", None)


def test_a_sort_at_the_limit_is_listed() -> None:
    require_listable(Interval(1, MAX_LISTED), "s", None)
    with pytest.raises(LimitError, match=f"has 5,000,001 elements .*; at most {MAX_LISTED:,} can"):
        require_listable(Interval(0, MAX_LISTED), "s", None)
