"""Extents answer alike whether asked for membership, for size, or for their elements."""

from __future__ import annotations

import time
from itertools import islice

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sparc
from sparc.errors import LimitError
from sparc.sorts.extents import (
    Extent,
    IdentifierInterval,
    Interval,
    Listed,
    Records,
    Sort,
    Strings,
)
from sparc.sorts.set_operations import Difference, Intersection, Union, is_subset
from sparc.sorts.values import compare, from_ground, text, to_ground


def extent(expression: str, before: str = "") -> Extent:
    typed = sparc.check(sparc.parse(f"sorts {before} #x = {expression}. predicates rules "))
    return typed.sorts["x"].extent


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("2..4", "2 3 4"),
        ("a..d", "a b c d"),
        ("az..bb", "az ba bb"),
        ("nos..nou", "nos nou"),
        ("a8..a9", "a8 a9"),
        ("{b,a,b,3}", "b a 3"),
        ("{f(a,g(1))}", "f(a,g(1))"),
        ("#a", "a b c"),
        ("#a + #n", "a b c 1 2 3"),
        ("#a + {a}", "a b c"),
        ("#a - {b}", "a c"),
        ("#a * {c,b,z}", "b c"),
        ("#a - {a} - {b} + {a}", "c a"),
        ("#a + #n * {1}", "a b c 1"),
        ("(#a + #n) * {1}", "1"),
        ("#a - ({a} + {b})", "c"),
        ("f(#n)", "f(1) f(2) f(3)"),
        ("f(#n(X),#n(Y)) : X < Y", "f(1,2) f(1,3) f(2,3)"),
        ("f(#n(X),#n(Y)) : not(X != Y)", "f(1,1) f(2,2) f(3,3)"),
        ("f(#n(X),#n(Y)) : X = Y and X >= Y or X > Y and not(Y >= X)", "f(1,1) f(2,1) f(2,2) f(3,1) f(3,2) f(3,3)"),
        ("[b][1..2]", "b1 b2"),
        ("[a,ab][b,bb]", "ab abb abbb"),
        ("[1..2][3..4]", "13 14 23 24"),
        ("[x][#a]", "xa xb xc"),
        ("[2..3]", "2 3"),
    ],
)  # fmt: skip
def test_elements(expression: str, expected: str) -> None:
    found = extent(expression, "#a = {a,b,c}. #n = 1..3.")
    values = list(found)
    assert sorted(map(text, values)) == sorted(expected.split())
    assert all(value in found for value in values)
    assert len(set(values)) == len(values) <= found.bound()
    assert not found.is_empty()


def test_constants_are_replaced_in_ranges_of_identifiers() -> None:
    program = "#const c = 7. sorts #x = a..d. predicates rules "
    assert list(sparc.check(sparc.parse(program)).sorts["x"].extent) == ["a", "b", 7, "d"]


ATOMS = st.sampled_from(["a", "b", "c", 1, 2, 3, ("f", "a"), ("f", 1), ("g", "a", 1)])
SETS = st.lists(ATOMS, min_size=1, max_size=5).map(Listed)
LEAVES = st.one_of(
    SETS,
    st.tuples(st.integers(0, 2), st.integers(2, 4)).map(lambda ends: Interval(*ends)),
    st.just(IdentifierInterval("a", "d")),
    SETS.map(lambda part: Records("f", (Sort("s", part),), None, ())),
)
EXTENTS = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: Union(tuple(parts))),
        st.tuples(inner, inner).map(lambda pair: Difference(*pair)),
        st.tuples(inner, inner).map(lambda pair: Intersection(*pair)),
        st.tuples(inner, inner).map(
            lambda pair: Records("f", (Sort("s", pair[0]), Sort("t", pair[1])), None, ())
        ),
    ),
    max_leaves=5,
)


@settings(max_examples=150, deadline=None)
@given(EXTENTS, EXTENTS)
def test_questions_agree_with_the_elements(one: Extent, other: Extent) -> None:
    values = list(islice(one, 400))
    members = set(values)
    assert len(members) == len(values)
    assert all(value in one for value in values)
    assert all(value not in one for value in islice(other, 100) if value not in members)
    assert len(values) <= one.bound()
    assert one.is_empty() == (not values)
    assert one.has_number() == any(type(value) is int for value in values)
    if is_subset(one, other):
        assert all(value in other for value in values)
    for value in values:
        if type(value) is tuple:
            assert (value[0], len(value) - 1) in one.signatures()
            boxes = one.boxes(str(value[0]), len(value) - 1)
            assert boxes is None or any(value in box for box in boxes)
    for name, arity in (("f", 1), ("f", 2), ("g", 2)):
        for box in one.boxes(name, arity) or ():
            assert all(value in one for value in islice(box, 50))


@given(ATOMS)
def test_values_go_to_the_public_form_and_back(value: object) -> None:
    assert from_ground(to_ground(value)) == value  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("left", "operator", "right", "expected"),
    [
        (2, "<", 10, True),
        ("aB", "<", "aa", True),
        ("a2", "<", "a10", False),
        (1, "<", "a", False),
        ("a", ">", 1, False),
        (1, "!=", "a", True),
        (1, "=", "a", False),
        (("f", 1), "=", ("f", 1), True),
        (("f", 1), "<=", ("f", 1), False),
    ],
)
def test_comparison(left: object, operator: str, right: object, expected: bool) -> None:
    assert compare(left, operator, right) is expected  # type: ignore[arg-type]


def test_strings_know_their_elements_without_listing_them() -> None:
    digits = Interval(0, 999)
    word = Strings((Listed(["a", "ab"]), digits, digits))
    assert word.bound() == 2_000_000
    assert "ab12" in word and "a0999" in word
    assert "ab" not in word and "b12" not in word and 12 not in word


def test_huge_sorts_cost_nothing_until_they_are_listed() -> None:
    before = "#n = 1..2000. #r = f(#n,#n,#n,#n). #q = f(#n(X),#n,#n,#n(Y)) : X > Y."
    start = time.process_time()
    found = extent("g(#r,#q) + #n - {3}", before)
    assert ("g", ("f", 1, 2, 3, 4), ("f", 4, 3, 2, 1)) in found
    assert ("g", ("f", 1, 2, 3, 4), ("f", 1, 3, 2, 4)) not in found
    assert 3 not in found and 4 in found
    assert time.process_time() - start < 0.5


def test_hopeless_emptiness_is_a_limit_not_an_endless_search() -> None:
    before = "#n = 1..2000. #r = f(#n(X),#n(Y)) : X < Y. #q = f(#n(X),#n(Y),#n) : X <= Y."
    with pytest.raises((sparc.SourceErrors, LimitError)):
        extent("f(#n(X),#n(Y),#n(Z)) : X < Y and Y < Z and Z < X", before)
