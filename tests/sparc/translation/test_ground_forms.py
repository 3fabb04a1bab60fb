"""The rules that list the ground instances of each kind of statement."""

from __future__ import annotations

import pytest

import sparc
from sparc.syntax.printer import print_statement
from sparc.translation.ground_forms import GroundForms, RuleForm

HEAD = """#const n = 3.
sorts
#s = {a,b}. #t = {b,c}. #n = 0..5. #g = g(#n(X),#n(Y)) : X < Y.
predicates
p(#s). q(#s). t(#t). n(#n). e(#s,#s). g(#g). z().
rules
"""


def writer(rules: str) -> GroundForms:
    return GroundForms(sparc.check(sparc.parse(HEAD + rules)))


def lines(forms: GroundForms) -> list[str]:
    """The rules written until now, without the sorts."""
    return [line for line in forms.taken_lines().split("\n") if line.startswith("___")]


@pytest.mark.parametrize(
    ("rule", "written", "kinds"),
    [
        ("z.", ["___f0."], ["rule"]),
        ("p(X) :- e(X,_), n(N), N+n > 4.",
         ["___f0(X,_V1,N):-e(X,_V1),n(N),N+3>4."], ["rule"]),
        ("t(X) :- p(X).", ["___f0(X):-p(X),__t(X)."], ["rule"]),
        ("n(2..n).", ["___f0(N):-N=(2..3)."], ["rule"]),
        ("-n(1..2).", ["___f0(N):-N=(1..2)."], ["rule"]),
        ("p(X) | q(X) :- z.", ["___f0(X):-z,__s(X)."], ["disjunction"]),
        ("g(g(5,X)) :- n(X).", ["___f0(X):-n(X),5<X."], ["rule"]),
        ("r : z :+ p(X).", ["___f0(X):-p(X),___appl(r(X))."], ["cr"]),
        ("z :+ .", ["___f0:-___appl(r_0)."], ["cr"]),
        ("1{p(X) : q(X); z}1 :- n(Y).",
         ["___b0(Y):-n(Y).", "___f0_1(Y,X):-n(Y),q(X).", "___f0_2(Y):-n(Y)."],
         ["choice", "choice"]),
        ("{p(X) : t(c)} :+ z.", ["___b0:-z,___appl(r_0).",
         "___f0_1(X):-z,___appl(r_0),t(c),__s(X)."], ["cr"]),
        ("z :- p(X), #count{Y : e(X,Y)} > 1.",
         ["___f0(X):-p(X),#count{Y: e(X,Y)}>1.", "___a0_1_2(X,Y):-___f0(X),e(X,Y)."], ["rule"]),
        (":- z.", [], []),
        ("p(X) :- q(X), not #s(a).", [], []),
        (":~ z. [1:1]", [], []),
    ],
)  # fmt: skip
def test_forms(rule: str, written: list[str], kinds: list[str]) -> None:
    made = writer(rule)
    forms = made.forms(0)
    assert [form.kind for form in forms] == kinds
    assert lines(made) == written
    assert lines(made) == []  # each line is handed over once


def only(rule: str) -> RuleForm:
    (form,) = writer(rule).forms(0)
    return form


def test_a_form_shows_the_rule_with_names_and_numbers() -> None:
    form = only("p(X) :- e(X,_), n(n), not q(_).")
    assert print_statement(form.statement) == "p(X) :- e(X,_V1), n(3), not q(_V2)."
    assert form.names == ("X", "_V1", "_V2")


def test_a_choice_shows_one_element_at_a_time() -> None:
    first, second = writer("1{p(X) : q(X); z}1 :- n(Y).").forms(0)
    assert print_statement(first.statement) == "{p(X) : q(X)} :- n(Y)."
    assert print_statement(second.statement) == "{z} :- n(Y)."
    assert [len(first.body), len(second.body)] == [2, 1]


@pytest.mark.parametrize(
    ("rule", "shown"),
    [
        ("z :- p(X), #count{X : q(X)} > 1.", "z :- p(X), #count{X_own : q(X_own)} > 1."),
        ("z :- p(X), q(X_own), #count{X : e(X,X_own)} > 0.",
         "z :- p(X), q(X_own), #count{X_own_own : e(X_own_own,X_own)} > 0."),
        ("z :- p(X), #count{X,X_own : e(X,X_own)} > 0.",
         "z :- p(X), #count{X_own_own,X_own : e(X_own_own,X_own)} > 0."),
        ("z :- p(X), #count{Y : e(X,Y)} > 1.", "z :- p(X), #count{Y : e(X,Y)} > 1."),
    ],
)  # fmt: skip
def test_the_variables_of_a_tuple_have_names_of_their_own(rule: str, shown: str) -> None:
    assert print_statement(only(rule).statement) == shown


def test_elements_of_aggregates_are_counted_in_their_order() -> None:
    made = writer("z :- #count{X : p(X)} > 0, #sum{1,X : q(X); 2 : t(b)} > 1.")
    (form,) = made.forms(0)
    assert [(each.predicate, each.names) for each in form.aggregates] == [
        ("___a0_0_2", ("X",)), ("___a0_1_3", ("X",)), ("___a0_1_4", ()),
    ]  # fmt: skip
    assert "___a0_1_4:-___f0,t(b)." in lines(made)


def test_where_some_literals_hold_together() -> None:
    made = writer("z :- e(X,Y), not q(Y), t(Y).")
    items = made.typed.program.statements[0].body  # type: ignore[union-attr]
    assert made.condition_of(0, items[:2], "___q1") == ("X", "Y")
    assert made.condition_of(0, (), "___q2") == ()
    assert lines(made) == ["___q1(X,Y):-e(X,Y),not q(Y).", "___q2."]
    none = writer("z :- p(a), not #s(a).")
    assert none.condition_of(0, none.typed.program.statements[0].body, "___q") is None  # type: ignore[union-attr]
