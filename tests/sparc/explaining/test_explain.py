"""Causes and mends of small programs: what is said of each kind of statement."""

from __future__ import annotations

import pytest

import sparc
from sparc.errors import NumberError
from sparc.explaining.explain import Inconsistency
from tests.support.inconsistent import SORTS, found


def causes(explanation: Inconsistency) -> list[set[str]]:
    return [{member.place.text for member in cause.members} for cause in explanation.causes]


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        ("p(a). q(b). :- p(X).", [{"p(a).", ":- p(X)."}]),
        ("p(a). -p(a).", [{"p(a).", "-p(a)."}]),
        ("p(a). -p(X) :- p(X).", [{"p(a).", "-p(X) :- p(X)."}]),
        ("t :- not t.", [{"t :- not t."}]),
        ("t :- not t. t :- u.", [{"t :- not t.", }]),
        (":- not t.", [{":- not t."}]),
        (":- not t. t :- u. {u} :- p(a).", [{":- not t."}]),
        # what is chosen is not to blame
        ("{p(X)}. {q(X)}. :- t. t.", [{":- t.", "t."}]),
        ("1{p(a); p(b)}1. :- p(a). :- p(b).", [{"1{p(a); p(b)}1.", ":- p(a).", ":- p(b)."}]),
        ("p(a) | p(b). q(a) | q(b). :- p(X).", [{"p(a) | p(b).", ":- p(X)."}]),
        ("3{p(a); p(b)}.", [{"3{p(a); p(b)}."}]),
        # relaxations and preferences never are
        ("t :+ . #minimize{X : p(X)}. p(a). :- p(a).", [{"p(a).", ":- p(a)."}]),
        ("t :+ . :- not u.", [{":- not u."}]),
        ("r(0..2). :- #count{N : r(N)} > 2.", [{"r(0..2).", ":- #count{N : r(N)} > 2."}]),
        # two that have nothing to do with each other
        ("p(a). :- p(a). q(a). :- q(X).", [{"p(a).", ":- p(a)."}, {"q(a).", ":- q(X)."}]),
        (":- .", None),
    ],
)  # fmt: skip
def test_the_causes(rules: str, expected: list[set[str]] | None) -> None:
    if expected is None:
        with pytest.raises((sparc.SourceError, sparc.SourceErrors)):
            found(rules)
        return
    explanation = found(rules)
    assert explanation.consistent is False and explanation.complete
    assert sorted(map(sorted, causes(explanation))) == sorted(map(sorted, expected))


@pytest.mark.parametrize(
    "rules",
    [
        "",
        "p(a).",
        "t :+ . :- not t.",
        "{t}. :- not t.",
        "p(a) | p(b). :- p(a).",
        "t. #minimize{1 : t}.",
    ],
)
def test_a_consistent_program(rules: str) -> None:
    explanation = found(rules)
    assert explanation.consistent and not explanation.causes and not explanation.mends


def test_every_cause() -> None:
    rules = "p(a). q(a). :- p(a). :- p(X), q(X). -q(a) :- p(a)."
    assert len(found(rules).causes) == 1
    explanation = found(rules, every=True)
    assert explanation.complete
    assert sorted(map(sorted, causes(explanation))) == sorted(map(sorted, [
        {"p(a).", ":- p(a)."}, {"p(a).", "q(a).", ":- p(X), q(X)."}, {"p(a).", "q(a).", "-q(a) :- p(a)."},
    ]))  # fmt: skip


def test_mends_of_fewest_statements_come_first() -> None:
    explanation = found("p(a). :- p(a). :- p(X).")
    assert [[place.text for place in mend.without] for mend in explanation.mends] == [
        ["p(a)."],
        [":- p(a).", ":- p(X)."],
    ]


def test_more_than_the_limit_is_said_to_be_left() -> None:
    pairs = "".join(f"r({n}). :- r({n}). :- r({n}), t. t." for n in range(5))
    explanation = found(pairs, every=True)
    assert len(explanation.mends) == 20 and not explanation.complete


def test_instances_sentences_and_contraries() -> None:
    explanation = found(
        "\n% Nobody is both.\n:- p(X), q(X), r(N), N > 1.\n\nq(X) :- p(X).\np(a). r(0..4).\n-t :- p(a).\nt.\n",
        every=True,
    )
    by_text = {m.place.text: m for cause in explanation.causes for m in cause.members}
    (constraint,) = (m for text, m in by_text.items() if text.startswith(":-"))
    assert constraint.place.sentence == "Nobody is both."
    assert len(constraint.instances) == 1 and constraint.instances[0].startswith("p(a), q(a), r(")
    assert by_text["q(X) :- p(X)."].instances == ("q(a) :- p(a)",)
    assert by_text["t."].place.sentence is None
    assert [cause.contraries for cause in explanation.causes if cause.contraries] == [
        (("t", "-t"),)
    ]


def test_contraries_that_do_not_matter_are_not_told() -> None:
    """Both are there, and the constraint alone takes them: without the law nothing is better."""
    explanation = found("p(a). -p(a) :- t. t. :- p(a), t.", every=True)
    told = {frozenset(m.place.text for m in c.members): c.contraries for c in explanation.causes}
    assert told[frozenset({"p(a).", "t.", ":- p(a), t."})] == ()
    assert told[frozenset({"p(a).", "t.", "-p(a) :- t."})] == (("p(a)", "-p(a)"),)


def test_time_that_is_up_is_said() -> None:
    explanation = sparc.explain(SORTS + "p(a). :- p(a).", time_limit=0.0)
    assert explanation.consistent is None and explanation.limit == "time"
    assert not explanation.complete and not explanation.causes


@pytest.mark.parametrize("answered", [1, 2, 3, 4])
def test_what_was_not_finished_is_left_open(answered: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """After so many questions the time is up: what is told is minimal, or is not told."""
    from sparc.explaining import subsets

    asked, real = [0], subsets.SubsetOracle.conflict

    def conflict(self: subsets.SubsetOracle, on: object) -> object:
        asked[0] += 1
        if asked[0] > answered:
            raise subsets.Undecided
        return real(self, on)  # type: ignore[arg-type]

    monkeypatch.setattr(subsets.SubsetOracle, "conflict", conflict)
    explanation = found("p(a). :- p(a). q(a). :- q(X).")
    assert explanation.consistent is False and explanation.limit == "time"
    assert not explanation.complete
    whole = [{"p(a).", ":- p(a)."}, {"q(a).", ":- q(X)."}]
    assert all(cause in whole for cause in causes(explanation))


@pytest.mark.parametrize("stage", ["active_instances", "contraries", "small_sorts"])
def test_what_is_told_of_a_cause_may_be_left_open_too(
    stage: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    from sparc.explaining import explain, subsets

    def late(*_: object) -> None:
        raise subsets.Undecided

    monkeypatch.setattr(explain, stage, late)
    explanation = found("p(a). -p(a).")
    assert explanation.consistent is False and explanation.limit == "time"
    assert not explanation.complete and causes(explanation) == [{"p(a).", "-p(a)."}]


def test_a_sum_beyond_32_bits_is_told_at_its_place() -> None:
    program = """#maxint = 2147483647.
sorts
#k = {1,2}.
#w = {2000000000}.
predicates
w(#k,#w). q(#k).
rules
w(1,2000000000). w(2,2000000000).
q(1) :- #sum{K,X : w(X,K)} > 0.
"""
    with pytest.raises(NumberError) as told:
        sparc.explain(program)
    assert "can add up to 4000000000" in str(told.value) and ":9:9:" in str(told.value)
