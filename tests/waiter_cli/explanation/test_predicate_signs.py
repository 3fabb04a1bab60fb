"""How predicates bear on whether there is a plan: by choices, constraints, rules and their negations."""

from __future__ import annotations

import pytest

import sparc
from waiter_cli.explanation.predicate_signs import (
    FREES,
    RESTRICTS,
    PredicateSigns,
    heads_of,
    literals_of,
)

HEADER = """\
sorts
#s = {a, b}.
#step = 0..3.
predicates
occurs(#s, #step). holds(#s, #step). p(#s). q(#s). r(#s). goal(#step). success(). required(#s).
reached(#s).
rules
"""


def signs_of(*rules: str) -> PredicateSigns:
    return PredicateSigns(sparc.parse(HEADER + "\n".join(rules)))


def sign(name: str, *rules: str, negated: bool = False) -> str:
    """``frees``, ``restricts``, or nothing where it is neither alone."""
    signs = signs_of(*rules)
    literal = (name, negated)
    found = [
        word
        for word, way in (("frees", FREES), ("restricts", RESTRICTS))
        if signs.only(way, literal)
    ]
    return "".join(found)


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        ((":- p(X).",), "restricts"),
        ((":- not p(X).",), "frees"),
        (("{occurs(X,I) : p(X)} 1 :- #step(I).",), "frees"),
        (("{occurs(X,I) : not p(X)} 1 :- #step(I).",), "restricts"),
        (("q(X) :- p(X).", ":- q(X)."), "restricts"),
        (("q(X) :- not p(X).", ":- q(X)."), "frees"),
        (("q(X) :- not p(X).", "r(X) :- not q(X).", ":- r(X)."), "restricts"),
        (("goal(I) :- p(X), #step(I).",), "frees"),
        ((":- p(X).", ":- not p(X)."), ""),
        (("q(X) :- p(X).",), ""),
        (("holds(X,I) :- p(X), #step(I).",), ""),
        ((":- #count{X : p(X)} > 1.",), ""),
        (("p(X) | q(X) :- #s(X).",), ""),
        (("1 {occurs(X,I) : #s(X)} :- p(a), #step(I).",), ""),
        (("{q(X) : p(X)}.",), ""),
    ],
)  # fmt: skip
def test_a_predicate_has_a_sign(rules: tuple[str, ...], expected: str) -> None:
    assert sign("p", *rules) == expected


def test_actions_and_fluents_bear_both_ways() -> None:
    rules = (":- holds(X,I), occurs(X,I).",)
    assert sign("holds", *rules) == sign("occurs", *rules) == ""


def test_contraries_that_are_both_given_restrict_each_other() -> None:
    assert sign("p", "p(a).", "-p(b).") == "restricts"
    assert sign("p", "p(a).", "-p(b).", negated=True) == "restricts"
    assert sign("p", "p(a).") == ""


def test_what_a_choice_of_actions_asks_for_is_offered() -> None:
    signs = signs_of("{occurs(X,I) : p(X), not q(X)} 1 :- r(X), #step(I).")
    assert signs.offered == {("p", False)}


def test_wishes_are_what_goals_are_made_of() -> None:
    signs = signs_of("reached(X) :- p(X), holds(X,I), not q(X).", "r(X) :- p(X).")
    assert signs.wishes == {"required", "reached", "p", "q"}


def test_heads_and_bodies_give_their_literals() -> None:
    program = sparc.parse(HEADER + "-p(a) | q(b) :- p(X), not -q(X), #count{X : r(X)} > 1.")
    (rule,) = program.statements
    assert heads_of(rule.head) == [("p", True), ("q", False)]  # type: ignore[union-attr]
    assert list(literals_of(rule.body)) == [  # type: ignore[union-attr]
        (("p", False), FREES), (("q", True), RESTRICTS), (("r", False), 0),
    ]  # fmt: skip
