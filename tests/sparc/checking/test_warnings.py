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
def test_mistakes(rule: str, message: str) -> None:
    assert any(message in warning for warning in warnings(rule)), warnings(rule)


@pytest.mark.parametrize(
    "rule",
    [
        "p(X+1) :- p(X).",
        "p(X) :- not p(X-1).",
        "w(f(X)) :- r(X), X != x.",
        "p(X-1) :- p(X).",
        "p(1+X) :- p(X), X > 1.",
        "p(X-6) :- q(X), X < 10.",
        "q(X+6) :- p(X).",
        "p(X*X) :- p(X), X < 2.",
        "p(X) :- p(Y), X = Y*Y, X < 4.",
        "p(N) :- #count{X : p(X)} = N.",
        "p(N) :- p(N), #sum{X,Y : p(X), p(Y)} = N.",
        "q(N) :- #sum{X : p(X), X > 2} = N.",
        "r(X) :- e(X,_), X < y.",
        "{p(X) : X > 2} :- p(1).",
        "p(Y) :- p(Y), #count{X : p(X), X < Y} = 1.",
        "big(X,Y) :- big(Y,X), X < Y.",
        "h(h(X,Y)) :- big(X,Y), h(h(Y,Y)).",
        "big(X,Y) :- big(Z,U), X+Y = Z*U.",
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


def slips(rules: str, display: str = "") -> list[str]:
    """The places and the messages of all warnings, about a program whose predicates are given."""
    head = (
        "sorts\n#p = {ann, ben}.\n#n = 1..9.\npredicates\nq(#p). e(#p,#p). r(#p). s(#n).\nrules\n"
    )
    text = head + rules + ("\ndisplay\n" + display if display else "")
    found = sparc.find_warnings(sparc.check(sparc.parse(text, "x")))
    return [f"{one.span and one.span.location} {one.message} | {one.hint}" for one in found]


GIVEN = "{q(X); e(X,Y); r(X); s(Z)}.\n:- q(ann), e(ann,ben), r(ann), s(1).\n"


@pytest.mark.parametrize(
    ("rule", "place", "message"),
    [
        ("e(ann, Ben).", "9:8", "Ben is used once | is the constant ben meant?"),
        ("q(ANN).", "9:3", "ANN is used once | is the constant ann meant?"),
        ("q(X).", "9:3", "X is used once | write _ "),
        ("q(X) :- e(X, Y).", "9:14", "Y is used once | write _"),
        ("q(X) :- r(X), #count{Y : e(Y, Z)} > 1.", "9:31", "Z is used once"),
        (":- q(X).", "9:6", "X is used once"),
        ("q(X) :- r(ann).", "9:3", "X is used once | write _ if any element will do: in a head"),
        (
            "q(Guest) :- r(Geust), e(Guest, ann).",
            "9:15",
            "Geust is used once | is the variable Guest",
        ),
        # beside a _ another name is needed, but no misspelt one
        (
            "q(Guest) :- e(Guest, _), r(Gues).",
            "9:28",
            "is the variable Guest meant? If not, write _",
        ),
        ("q(X) :- e(X, _), r(Ben).", "9:20", "is the constant ben meant?"),
        ("q(X) :- r(X), not e(X, Y).", "9:24", 'Y stands only under "not"'),
        (":- r(X), not e(X, Y).", "9:19", 'Y stands only under "not"'),
        ("q(X) :- r(X), #count{X : e(X, ann)} > 1.", "9:22", "another variable than the X outside"),
        ("q(X) :- s(N), r(X), #count{N : s(N)} > 1.", "9:28", "another variable than the N"),
        ("q(X) :- r(X), not r(X).", "9:15", "can never fire"),
        ("q(X) :- r(X), -r(X). -r(ann).", "9:15", "can never fire"),
        ("s(X) :- s(X), X > 9.", "9:1", "this rule has no instance"),
    ],
)
def test_slips(rule: str, place: str, message: str) -> None:
    found = slips(GIVEN + rule)
    assert len(found) == 1
    assert found[0].startswith(f"x:{place} ") and message in found[0]


def test_what_is_advised_is_not_warned_of_then() -> None:
    """Of two that are used once one becomes _, since upstream takes a second _ for the first."""
    first, second = slips(GIVEN + "q(ann) :- e(X, Y).")
    assert "X is used once | write _ if any element will do, for one of X, Y: the orig" in first
    assert "Y is used once | write _ if any element will do, for one of X, Y: the orig" in second
    assert slips(GIVEN + "q(ann) :- e(X, _).") == []
    (several,) = slips(GIVEN + "q(ann) :- e(_, _).")
    assert "2 anonymous variables" in several
    assert several.endswith("keep one, and give the others names")


@pytest.mark.parametrize(
    "rule",
    [
        "q(_).",
        "q(X) :- e(X, _).",
        "q(X) :- e(X, _), r(Y).",
        "q(_) :- r(Y).",
        ":- not q(X).",
        "-q(X) :- not q(X).",
        "1{e(X, Y)}1 :- r(X).",
        "q(X) :- r(X), not e(X, _).",
        "q(X) :- r(X), #count{Y : e(X, Y)} > 1.",
        "s(N) :- #count{Y : q(Y)} = N, s(N).",
        "#minimize{N : s(N)}.",
        ":~ s(N). [N:1]",
        "q(X) :+ r(X).",
    ],
)
def test_rules_without_slips(rule: str) -> None:
    assert slips(GIVEN + rule) == []


def test_predicates_without_rules_and_without_use() -> None:
    assert slips("q(X) :- r(X).") == [
        "x:5:8 e has no effect: nothing uses it | None",
        "x:5:18 r is never true: no rule gives it | write a fact or a rule for r, or a choice",
        "x:5:25 s has no effect: nothing uses it | None",
    ]
    assert slips("q(ann). r(ann). e(ann,ben) :- r(ann). s(1).", "e.") == [
        "x:5:1 q has no effect: no rule uses it, and it is not displayed | None",
        "x:5:25 s has no effect: no rule uses it, and it is not displayed | None",
    ]
    assert slips(GIVEN + ":- -q(ann).") == [
        "x:5:1 -q is never true: no rule gives it | write a fact or a rule for -q, or a choice"
    ]
