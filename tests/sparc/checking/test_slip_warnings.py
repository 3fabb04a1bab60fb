"""What a rule says and hardly means: its variables, its literals, and predicates of no use."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.slip_warnings import Mentions, mentions


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


@pytest.mark.parametrize(
    ("statement", "given", "used"),
    [
        ("q(X) | -r(X) :- e(X,_), not s(1), not -q(X).", "q -r", "e s -q"),
        ("{q(X) : r(X); r(X)} :- #count{Y : e(Y,ann), not s(2)} > 0.", "q r", "e s r"),
        ("s(1..3).", "s", ""),
        ("-s(1..3).", "-s", ""),
        ("l : q(ann) :+ r(ann), r(ben).", "q", "r"),
        (":~ q(X), -r(X). [1:1]", "", "q -r"),
        ("#minimize{X : s(X), e(_,_)}.", "", "s e"),
        (":- #p(X), q(X), X != ann.", "", "q"),
    ],
)
def test_the_predicates_of_a_statement(statement: str, given: str, used: str) -> None:
    head = "sorts #p = {ann,ben}. #n = 1..9. predicates q(#p). e(#p,#p). r(#p). s(#n). rules "
    (only,) = sparc.parse(head + statement).statements

    def signs(text: str) -> tuple[tuple[str, bool], ...]:
        return tuple((word.lstrip("-"), word.startswith("-")) for word in text.split())

    found = mentions(only)
    assert found == Mentions(frozenset(signs(given)), signs(used))
    assert found.names() == {name for name, _ in (*signs(given), *signs(used))}
