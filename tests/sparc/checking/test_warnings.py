"""Warnings name real mistakes, and leave good rules alone."""

from __future__ import annotations

import pytest

import sparc
from tests.support.answer_corpus import Example, examples

SORTS = """
sorts #a = 1..3. #b = 7..9. #s = {x,y}. #f = f(#s). #g = g(#a). #big = 1..2000. #h = h(#big,#big).
predicates p(#a). q(#b). r(#s). w(#f). e(#s,#s). big(#big,#big). h(#h).
rules
"""


def warnings(rules: str) -> list[str]:
    typed = sparc.check(sparc.parse(SORTS + rules))
    return [f"{warning.message} | {warning.hint}" for warning in sparc.find_warnings(typed)]


@pytest.mark.parametrize(
    ("rule", "message"),
    [
        ("p(X) :- q(X).", "X would have to be in #b and in #a, which share no element"),
        ("p(X) :- q(X+1).", "no values of X"),
        ("w(g(X)) :- p(X).", "#f has no record g with 1 argument"),
        ("p(X) :- X > 3.", "no values of X in their sorts pass"),
        ("p(X) :- p(Y), X > Y, Y > X.", "no values of X, Y"),
        (":- p(X), X = zzz.", "zzz is no element of any sort"),
        ("p(1) :- 1 = 2.", "its comparisons are false"),
        ("{p(X) : q(X)}.", "this element has no instance"),
        ("r(x) :- #count{X : p(X), X > 5} > 0.", "this element has no instance"),
        ("r(x) :- e(_,_).", "2 anonymous variables, each a variable of its own"),
        (":- p(X), #b(X).", "which share no element"),
        (":- p(X), X/0 = 1.", "no values of X"),
    ],
)
def test_mistakes(rule: str, message: str) -> None:
    assert any(message in warning for warning in warnings(rule)), warnings(rule)


@pytest.mark.parametrize(
    "rule",
    [
        "p(X) :- not p(X-1).",
        "w(f(X)) :- r(X), X != x.",
        "r(X) :- e(X,_), X < y.",
        "{p(X) : X > 2} :- p(1).",
        "p(Y) :- p(Y), #count{X : p(X), X < Y} = 1.",
        "big(X,Y) :- big(Y,X), X < Y.",
        "h(h(X,Y)) :- big(X,Y), h(h(Y,Y)).",
        "r(X) :- #s(X), X = y.",
        ":- r(X), not #s(X).",
    ],
)
def test_good_rules(rule: str) -> None:
    expected = ["this rule has no instance"] if "not #s" in rule else []
    found = [one for one in warnings(rule) if "is never true" not in one and "no effect" not in one]
    assert [warning[: len("this rule has no instance")] for warning in found] == expected


def test_a_rule_that_derives_something_is_not_called_empty() -> None:
    """No warning is wrong: without the rules called empty, the answer sets are the same."""
    for example in examples():
        must_derive_nothing(example)


def must_derive_nothing(example: Example) -> None:
    program = sparc.parse(example.source)
    typed = sparc.check(program)
    empty = {
        warning.span.location.line
        for warning in sparc.find_warnings(typed)
        if warning.span and warning.message.startswith("this rule has no instance")
    }
    for statement, at in zip(program.statements, range(len(program.statements)), strict=True):
        if statement.span.location.line not in empty or len(empty) != 1:
            continue
        rest = (*program.statements[:at], *program.statements[at + 1 :])
        alone = [s for s in program.statements if s.span.location.line in empty]
        if len(alone) == 1:
            without = sparc.Program(
                program.directives, program.sorts, program.predicates, rest, program.display
            )
            shown = {frozenset(a.literals) for a in sparc.solve(without)}
            assert shown == {frozenset(a.literals) for a in sparc.solve(typed)}
