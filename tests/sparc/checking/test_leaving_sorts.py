"""Arithmetic and sums that can leave their sort are told, with values; others are not."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking import leaving_sorts
from tests.sparc.checking.test_warnings import warnings

SORTS = """
#const five = 5.
sorts
#a = 1..3. #b = 7..9. #odd = {1,4}. #pair = [a,ab][b,bb]. #mix = {x,2,y}.
#five = 0..5. #rest = #five - {4,5}. #deep = #five * {2,3,9}.
predicates
p(#a). q(#b). odd(#odd). mix(#mix). pair(#pair). deep(#deep). five(#five). e(#a,#odd). rest(#rest).
rules
"""


def told(rules: str) -> list[str]:
    found = sparc.find_warnings(sparc.check(sparc.parse(SORTS + rules)))
    return [one.message for one in found if "can leave" in one.message]


@pytest.mark.parametrize(
    ("rule", "message"),
    [
        ("p(X) :- p(Y), p(Z), X = Y+Z.", "this can leave #a: with Y = 3, Z = 3 it is 6"),
        ("p(X*X) :- p(X).", "this can leave #a: with X = 3 it is 9"),
        ("q(X+1) :- p(X).", "this can leave #b: with X = 3 it is 4"),
        ("r(x) | p(X+X) :- p(X).", "this can leave #a: with X = 3 it is 6"),
        ("p(N) :- #sum{X : p(X)} = N.", "this sum can leave #a: it can come to 6"),
        ("p(N) :- #sum{X,Y : e(x,Y), p(X)} = N.", "this sum can leave #a: it can come to 12"),
        ("p(N) :- #sum{X,Y : p(Y), p(X)} = N.", "this sum can leave #a: it can come to 18"),
        ("p(N) :- N = #sum{5,Y : e(x,Y)}.", "this sum can leave #a: it can come to 10"),
        ("p(N) :- #count{X,Y : e(X,Y)} = N.", "can come to 4, and the rule gives nothing above 3"),
    ],
)
def test_what_can_leave(rule: str, message: str) -> None:
    assert any(message in warning for warning in warnings(rule)), warnings(rule)


@pytest.mark.parametrize(
    "rule",
    [
        "p(X+1) :- p(X).",
        "p(X-1) :- p(X).",
        "p(1+X) :- p(X), X > 1.",
        "p(X-6) :- q(X), X < 10.",
        "q(X+6) :- p(X).",
        "p(X*X) :- p(X), X < 2.",
        "p(X) :- p(Y), X = Y*Y, X < 4.",
        "p(N) :- #count{X : p(X)} = N.",
        "p(N) :- p(N), #sum{X,Y : p(X), p(Y)} = N.",
        "q(N) :- #sum{X : p(X), X > 2} = N.",
        "big(X,Y) :- big(Z,U), X+Y = Z*U.",
    ],
)
def test_what_stays(rule: str) -> None:
    assert not any("can leave" in warning for warning in warnings(rule))


@pytest.mark.parametrize(
    ("aggregate", "most"),
    [
        ("#count{X : odd(X)}", 2), ("#count{X : pair(X)}", 3), ("#count{X : mix(X)}", 3),
        ("#count{X : deep(X)}", 2), ("#count{X : rest(X)}", 4), ("#count{X,Y : e(X,Y)}", 6),
        ("#count{X : odd(X), p(X)}", 2), ("#count{X : odd(X); Y : p(Y)}", 5),
        ("#sum{X : odd(X)}", 5), ("#sum{X : mix(X)}", 2), ("#sum{X : deep(X)}", 5),
        ("#sum{X : rest(X)}", 6), ("#sum{X : q(X)}", 24), ("#sum{2,X : odd(X)}", 4),
        ("#sum{X,Y : e(Y,X)}", 12), ("#sum{X,Y : odd(X), p(Y)}", 15), ("#sum{X : odd(X), p(X)}", 3),
    ],
)  # fmt: skip
def test_what_a_sum_can_come_to_at_most(
    aggregate: str, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    rule = f"five(N) :- {aggregate} = N."
    messages = told(rule)
    assert bool(messages) is (most > 5)
    assert all(f"can come to {most}, and the rule gives nothing above 5" in m for m in messages)
    monkeypatch.setattr(leaving_sorts, "_MOST_ELEMENTS", 1)
    assert told(rule) == [] or "q(X)" in rule  # only ranges are counted without a look


@pytest.mark.parametrize(
    "aggregate",
    [
        "#count{X : p(X), X > 1}", "#sum{X : p(X), not odd(X)}", "#max{X : q(X)}",
        "#sum{five,X : q(X)}", "#sum{x,Y : q(Y)}", "#sum{X,X : q(X)}",
    ],
)  # fmt: skip
def test_sums_of_which_nothing_is_said(aggregate: str) -> None:
    assert told(f"five(N) :- {aggregate} = N.") == []


def test_the_target_of_a_sum_is_what_its_sort_has() -> None:
    (message,) = told("rest(N) :- #sum{X : odd(X)} = N.")
    assert message.endswith("it can come to 5, and the rule gives nothing above 3")
    assert told("mix(N) :- #count{X : odd(X)} = N.") == []


@pytest.mark.parametrize(
    ("rule", "values"),
    [
        ("five(X+Y) :- p(X), p(Y).", "with X = 3, Y = 3 it is 6"),
        ("five(X-Y) :- p(X), q(Y).", "with X = 3, Y = 9 it is -6"),
        ("five(X*2) :- p(X), X > 1.", "with X = 3 it is 6"),
        ("five(Z) :- p(X), odd(Y), Z = X+Y, X != 3.", "with X = 2, Y = 4 it is 6"),
    ],
)
def test_the_values_are_an_instance(rule: str, values: str) -> None:
    (message,) = told(rule)
    assert values in message


def test_looking_ends_with_its_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    rules = "five(X*2) :- p(X). five(X*3) :- p(X)."
    assert len(told(rules)) == 2
    monkeypatch.setattr(leaving_sorts, "_WHOLE_BUDGET", 1)
    assert len(told(rules)) == 1
