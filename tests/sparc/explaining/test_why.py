"""Why literals are in answer sets of small programs, and why not: what is said in each case."""

from __future__ import annotations

import pytest

import sparc
from sparc.explaining.absence import Absence
from sparc.explaining.derivation import Derivation
from sparc.explaining.why import Why
from tests.support.replaying import faults_of

BIRDS = """sorts
#s = {sam, tweety}.
#n = 0..5.
#f = on(#s).
predicates
bird(#s). penguin(#s). flies(#s). c(#s). n(#n). next(#n). k(#n). big(). odd(). d(#s). h(#f,#n). x(). y().
rules
bird(tweety). bird(sam).
penguin(sam).

% Birds fly.
flies(X) :- bird(X), not penguin(X).
-flies(X) :- penguin(X).

n(0..2).
next(N+1) :- next(N).
next(0).
1{c(X) : bird(X)}1.
k(N) :- #count{X : bird(X)} = N.
big :- k(N), N > 3.
d(X) | -d(X) :- bird(X).
h(on(X), N+1) :- h(on(X), N).
h(on(sam), 3) :- bird(_).
x :- y.
y :- x.
"""


def found(literal: str, program: str = BIRDS, **options: int) -> Why:
    return sparc.why(sparc.Source("p.sparc", program), literal, **options)


def step(literal: str, program: str = BIRDS) -> Derivation:
    why = found(literal, program)
    assert why.holds
    return why.because[0]


def test_a_rule_with_its_place_sentence_instance_and_premises() -> None:
    node = step("flies(tweety)")
    assert node.place is not None
    assert (node.place.file, node.place.line, node.place.sentence) == ("p.sparc", 12, "Birds fly.")
    assert node.instance == "flies(tweety) :- bird(tweety), not penguin(tweety)"
    assert [(each.literal, each.note) for each in node.premises] == [
        ("bird(tweety)", ""),
        ("not penguin(tweety)", "no rule gives it"),
    ]


def test_not_p_is_opened_in_place_once() -> None:
    program = (
        "predicates a(). b(). c(). d(). e(). f(). "
        "rules e. b :- e, c. b :- e, not e. d :- not b. f :- not b. a :- d, f. "
    )
    d, f = step("a", program).premises
    absent = d.premises[0].absent
    assert absent is not None
    assert d.premises[0].note == "none of these rules gives it"
    assert [(each.instance, each.failed) for each in absent.rules] == [
        ("b :- e, c", "c"),
        ("b :- e, not e", "not e"),
    ]
    assert (f.premises[0].absent, f.premises[0].note) == (None, "shown above")
    (alone,) = step("d", "predicates b(). d(). rules d :- not b. ").premises
    assert (alone.absent, alone.note) == (None, "no rule gives it")


def test_the_smallest_derivation() -> None:
    program = (
        "predicates a(). b(). c(). d(). e(). "
        "rules d. c :- d. e :- c. b :- e. a :- b. a :- c, d. a :- a. "
    )
    assert step("a", program).instance == "a :- c, d"


def test_what_is_shared_is_shown_once() -> None:
    program = "predicates a(). b(). c(). d(). e(). rules e. d :- e. b :- d. c :- d. a :- b, c. "
    nodes = [step("a", program)]
    seen = []
    while nodes:
        node = nodes.pop()
        seen.append((node.literal, node.note))
        nodes.extend(node.premises)
    assert sorted(seen) == [
        ("a", ""), ("b", ""), ("c", ""), ("d", ""), ("d", "shown above"), ("e", ""),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("program", "note", "instance"),
    [
        ("1{p; q}1. :- q.", "chosen", "{p}"),
        ("p | q. :- q.", "chosen", "p | q"),
        ("r : p :+ . :- not p.", "needed", "r : p"),
        ("p :+ . :- not p.", "needed", "p"),
        ("{p} :+ . :- not p.", "needed", "{p}"),
    ],
)
def test_what_nothing_forces(program: str, note: str, instance: str) -> None:
    node = step("p", f"predicates p(). q(). rules {program} ")
    assert (node.note, node.instance) == (note, instance)


def test_aggregates_show_what_counted() -> None:
    node = step("k(2)")
    (counted,) = node.aggregates
    assert counted.aggregate == "#count{X : bird(X)} = 2"
    assert counted.elements == ("bird(sam)", "bird(tweety)")
    assert {each.literal for each in node.premises} == {"bird(sam)", "bird(tweety)"}


def test_the_variables_of_a_tuple_are_its_own() -> None:
    program = (
        "sorts #n = 0..9. predicates p(#n). t(#n). rules p(1). p(4). "
        "t(S) :- p(X), #sum{X : p(X)} = S. "
    )
    (counted,) = step("t(5)", program).aggregates
    assert counted.elements == ("p(1)", "p(4)")


def test_an_aggregate_over_what_it_gives() -> None:
    program = (
        "sorts #n = 0..2. predicates p(#n). rules p(0). p(1) :- #count{X : p(X)} >= 1. "
        "p(2) :- #count{X : p(X)} >= 2. "
    )
    assert step("p(1)", program).aggregates and step("p(2)", program).aggregates


def test_literals_that_need_one_another() -> None:
    program = "predicates a(). b(). rules a | b. a :- b. b :- a. "
    assert found("a", program).holds and found("b", program).holds


def test_deep_derivations_are_continued() -> None:
    program = "#maxint = 1500. sorts #n = 0..1500. predicates p(#n). rules p(0). p(N+1) :- p(N). "
    why = found("p(1500)", program)
    nodes = list(why.because)
    literals = set()
    while nodes:
        node = nodes.pop()
        if node.place is not None:
            assert node.literal not in literals
            literals.add(node.literal)
        nodes.extend(node.premises)
    assert literals == {f"p({n})" for n in range(1501)}


# ------------------------------------------------------------------ not in


def absence(literal: str, program: str = BIRDS) -> Absence:
    why = found(literal, program)
    assert why.holds is False and why.because_not is not None
    return why.because_not


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


# ------------------------------------------------------------------ which answer set


def test_each_answer_set() -> None:
    program = "predicates p(). q(). rules p | q. "
    sets = [{str(one) for one in each.literals} for each in sparc.solve(program)]
    for number, literals in enumerate(sets, 1):
        for literal in ("p", "q"):
            assert found(literal, program, number=number).holds is (literal in literals)
    assert found("p", program, number=3).sets == 2


def test_hidden_literals_can_be_asked_about() -> None:
    program = "predicates p(). q(). rules q. p :- q. display p. "
    assert found("q", program).holds
    choice = "predicates p(). q(). r(). rules {q}. {r}. p. display p. r. "
    assert found("p", choice, number=2).holds and found("p", choice, number=3).sets == 2


def test_without_an_answer_set() -> None:
    why = found("p", "predicates p(). rules p. -p. ")
    assert (why.holds, why.sets, why.limit) == (None, 0, None)


def test_time_that_is_up() -> None:
    why = sparc.why(BIRDS, "flies(sam)", time_limit=0.0)
    assert (why.holds, why.limit) == (None, "time")


@pytest.mark.parametrize("literal", ["p(X)", "p(", "", "not p", "p(a), p(b)"])
def test_what_is_no_literal(literal: str) -> None:
    with pytest.raises(sparc.SourceError):
        sparc.why("sorts #s = {a,b}. predicates p(#s). rules p(a). ", literal)


def test_a_constant_stands_for_its_number() -> None:
    program = "#const n = 2. sorts #n = 0..4. predicates p(#n). rules p(n). p(N+n) :- p(N). "
    assert step("p(n)", program).literal == "p(2)"
    assert step("p(4)", program).instance == "p(4) :- p(2)"


def test_everything_about_birds_replays() -> None:
    from tests.support.replaying import all_literals

    assert faults_of(BIRDS, all_literals(sparc.check(sparc.parse(BIRDS)))) == []


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
