"""Why literals do not hold: the rules that could give them, and what fails in each."""

from __future__ import annotations

import pytest

import sparc
from sparc.explaining.absence import Absence, explain_absent_form, open_negation
from sparc.explaining.derivation import Derivation
from tests.support.explained import absence, model_of


@pytest.mark.parametrize(
    ("literal", "rules", "note"),
    [
        ("flies(sam)", [("flies(sam) :- bird(sam), not penguin(sam)", "not penguin(sam)", "")], "-flies(sam) is in the answer set"),
        ("-flies(tweety)", [("-flies(tweety) :- penguin(tweety)", "penguin(tweety)", "")], "flies(tweety) is in the answer set"),
        ("penguin(tweety)", [], "no rule gives it; did you mean penguin(sam)?"),
        ("n(4)", [("n(0..2)", "n(4)", "not in the range")], ""),
        ("k(4)", [("k(4) :- #count{X : bird(X)} = 4", "#count{X : bird(X)} = 4", "")], ""),
        ("big", [("big :- k(2), 2 > 3", "2 > 3", "")], ""),
        ("odd", [], "no rule gives it"),
        ("h(on(sam),2)", [("h(on(sam),2) :- h(on(sam),1)", "h(on(sam),1)", "")], ""),
        ("x", [("x :- y", "y", "")], ""),
        ("n(9)", [], "9 is not in sort #n (argument 1 of n)"),
        ("bird(sm)", [], "sm is not in sort #s (argument 1 of bird) (did you mean sam?)"),
        ("brd(sam)", [], "unknown predicate brd/1 (did you mean bird (declared at line 6)?)"),
    ],
)  # fmt: skip
def test_what_is_not_there(literal: str, rules: list[tuple[str, str, str]], note: str) -> None:
    absent = absence(literal)
    assert [(each.instance, each.failed, each.note) for each in absent.rules] == rules
    assert absent.note.startswith(note)


def test_what_was_not_chosen() -> None:
    program = "predicates p(). q(). t(). rules 1{p; q}1. :- q. t :+ . "
    assert [(e.failed, e.note) for e in absence("q", program).rules] == [("q", "not chosen")]
    assert [(e.failed, e.note) for e in absence("t", program).rules] == [("t", "not needed")]


def test_an_anonymous_variable_without_a_value() -> None:
    program = "sorts #s = {a,b}. predicates p(#s). q(#s,#s). rules p(X) :- q(X,_), q(_,X). q(b,a). "
    (rule,) = absence("p(a)", program).rules
    assert (rule.instance, rule.failed) == ("p(a) :- q(a,_), q(_,a)", "q(a,_)")


def test_it_is_followed_down_to_a_cause() -> None:
    program = "predicates a(). b(). c(). d(). rules a :- b. b :- not c. c :- d. d. "
    (rule,) = absence("a", program).rules
    assert isinstance(rule.then, Absence)
    (rule,) = rule.then.rules
    assert rule.failed == "not c" and isinstance(rule.then, Derivation)
    assert rule.then.instance == "c :- d"


def test_a_circle_is_followed_once() -> None:
    (rule,) = absence("x").rules
    assert isinstance(rule.then, Absence) and rule.then.literal == "y"
    (rule,) = rule.then.rules
    assert rule.then == Absence("x", note="shown above")


FAMILY = (
    "sorts #p = {ann,bob,cid}. predicates parent(#p,#p). father(#p,#p). grand(#p). few(#p). many(#p). "
    "rules parent(ann,bob). parent(bob,cid). parent(X,Y) :- father(X,Y). "
    "grand(X) :- parent(X,Y), parent(Y,Z). many(X) :- #count{Y : parent(X,Y)} >= 2. "
)


def test_a_form_of_which_there_is_no_literal_is_followed_down() -> None:
    (failed,) = absence("grand(bob)", FAMILY).rules
    assert (failed.instance, failed.failed) == (
        "grand(bob) :- parent(bob,cid), parent(cid,Z)",
        "parent(cid,Z)",
    )
    assert isinstance(failed.then, Absence) and failed.then.literal == "parent(cid,Z)"
    (below,) = failed.then.rules
    assert (below.instance, below.failed) == ("parent(cid,Y) :- father(cid,Y)", "father(cid,Y)")
    assert isinstance(below.then, Absence)
    assert (below.then.rules, below.then.note) == ((), "no rule gives it")


def test_a_rule_that_gives_other_literals_of_the_form_is_not_said_to_choose() -> None:
    program = (
        "sorts #n = 0..2. predicates p(#n). q(#n). r(). rules q(2). p(X+1) :- q(X). r :- p(X). "
    )
    (failed,) = absence("r", program).rules
    assert isinstance(failed.then, Absence)
    (below,) = failed.then.rules
    assert below.note == "its head is another literal, or outside its sort"


def test_an_aggregate_that_fails_shows_what_counted() -> None:
    (failed,) = absence("many(bob)", FAMILY).rules
    assert failed.counted is not None
    assert failed.counted.aggregate == "#count{Y : parent(bob,Y)} >= 2"
    assert failed.counted.elements == ("parent(bob,cid)",)
    (nothing,) = absence("many(cid)", FAMILY).rules
    assert nothing.counted is not None and nothing.counted.elements == ()


def test_a_form_is_followed_into_rules_whose_heads_are_generic() -> None:
    """`occurs(A,I)` gives `occurs(seat(_,t1),0)` as that alone, not by whatever else occurs."""
    program = """sorts
#s = 0..3.
#t = {t1,t2}.
#go = go(#t).
#seat = seat(#t,#t).
#act = #go + #seat.
predicates
possible(#act,#s).
occurs(#act,#s).
seated(#t,#s).
held(#act,#s).
rules
possible(go(T),I).
1{occurs(A,I) : possible(A,I)}1 :- #s(I), I < 3.
held(A,I+1) :- occurs(A,I).
held(A,I+1) :- held(A,I).
seated(T,I+1) :- held(seat(_,T),I).
"""
    told = str(sparc.why(program, "seated(t1,2)"))
    assert "possible(seat(_,t1),0)" in told and "held(seat(_,t1),1)" in told
    assert "(go(t" not in told and "not chosen" not in told


@pytest.mark.parametrize(
    ("form", "note", "instances"),
    [
        ("q(a,X)", "", ["q(a,Y) :- p(Y), r(a)"]),
        ("q(X,X)", "", ["q(X,Y) :- p(Y), r(X)"]),
        ("q(c,X)", "its sort forbids it", []),
        ("-p(X)", "no rule gives it", []),
        ("p(X)", "no rule gives it", []),
    ],
)
def test_a_form_of_literals(form: str, note: str, instances: list[str]) -> None:
    head = "sorts #s = {a,b}. predicates p(#s). q(#s,#s). r(#s). rules "
    program = head + "q(X,Y) :- p(Y), r(X). "
    (statement,) = sparc.parse(f"{head}{form}. ").statements
    (atom,) = statement.head  # type: ignore[union-attr, misc]
    told = explain_absent_form(model_of(program), atom)  # type: ignore[arg-type]
    assert told.note == note
    assert len(told.rules) == len(instances)
    for failed in told.rules:
        assert failed.failed.startswith("p(")


def test_a_negation_is_opened_once_and_where_some_rule_could_give_it() -> None:
    model = model_of("predicates p(). q(). r(). rules q :- r. p :- not q, not r. ")
    opened = open_negation(model)
    q, r = sparc.GroundLiteral("q"), sparc.GroundLiteral("r")
    first = opened(q)
    assert first is not None and [rule.failed for rule in first.rules] == ["r"]
    assert opened(q) is None and opened(r) is None


def test_a_long_chain_is_followed_so_far() -> None:
    rules = " ".join(f"p({n + 1}) :- p({n})." for n in range(30))
    told: object = absence("p(30)", f"sorts #n = 0..30. predicates p(#n). rules {rules} ")
    notes = []
    while isinstance(told, Absence) and told.rules:
        told = told.rules[0].then
        notes.append(told.note if isinstance(told, Absence) else "")
    assert notes[-1] == "not followed further" and len(notes) == 13


@pytest.mark.parametrize(
    ("aggregate", "value"),
    [
        ("#sum{P,I : on(I), w(I,P)}", 6),
        ("#sum{P : on(I), w(I,P)}", 3),
        ("#sum{I : on(I)}", 0),
        ("#count{I : on(I); P : w(I,P)}", 4),
        ("#count{I : on(I), w(I,5)}", 0),
        ("#max{P : w(I,P)}", 5),
        ("#min{P : w(I,P)}", 3),
        ("#min{P : w(I,P), on(c)}", None),
        ("#max{I : on(I)}", None),
    ],
)
def test_an_aggregate_that_fails_says_what_it_comes_to(aggregate: str, value: int | None) -> None:
    program = (
        "sorts #i = {a, b, c}. #n = 0..20. predicates w(#i, #n). on(#i). t(#n). rules "
        f"w(a, 3). w(b, 3). w(c, 5). on(a). on(b). t(S) :- {aggregate} = S."
    )
    absent = sparc.why(program, "t(9)").because_not
    assert absent is not None
    (rule,) = absent.rules
    assert rule.counted is not None and rule.counted.value == value
    assert value is None or sparc.why(program, f"t({value})").holds
