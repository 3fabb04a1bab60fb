"""Ground instances of statements as text."""

from __future__ import annotations

import pytest

import sparc
from sparc.answer_sets import Ground, GroundTerm
from sparc.explaining.instances import ground_statement, ground_term, instance_text, tree_term
from sparc.syntax.printer import print_statement, print_term
from sparc.syntax.tree import Atom, Identifier, Number, Record, Rule, Statement, Term, Variable

A = GroundTerm("a")
VALUES: dict[str, Ground] = {"X": A, "N": 3, "F": GroundTerm("f", (A, 1))}


def statement(text: str) -> Statement:
    (only,) = sparc.parse(f"predicates p(). rules {text} ").statements
    return only


@pytest.mark.parametrize(
    ("rule", "shown"),
    [
        ("p(X) :- q(X,Y).", "p(a) :- q(a,Y)"),
        ("p(N+1) :- r(N), N < 4.", "p(4) :- r(3), 3 < 4"),
        ("p(F) | -q(X) :- not r(N).", "p(f(a,1)) | -q(a) :- not r(3)"),
        (":- p(X), not -q(N).", "p(a), not -q(3)"),
        ("p(X).", "p(a)"),
        ("N{p(Y) : q(X,Y)} 4 :- r(X).", "3 <= {p(Y) : q(a,Y)} <= 4 :- r(a)"),
        ("l : p(X) :+ q(X).", "l : p(a) :+ q(a)"),
        ("p(X) :+ .", "p(a)"),
        ("p :- #count{X,Y : q(X,N)} > N.", "p :- #count{X,Y : q(X,3)} > 3"),
        ("p :- #s(X), not #s(N).", "p :- #s(a), not #s(3)"),
        ("p(N/0) :- q.", "p(3/0) :- q"),
        ("p(1..3).", "p(1..3)"),
    ],
)
def test_instances(rule: str, shown: str) -> None:
    assert instance_text(statement(rule), VALUES) == shown


def test_an_anonymous_variable_without_a_value_is_shown_as_one() -> None:
    unnamed = Rule((Atom("p", (Variable("_V1"),)),), (Atom("q", (Variable("_V12"),)),))
    assert instance_text(unnamed, {"_V1": 2}) == "p(2) :- q(_)"


def test_a_grounded_rule_keeps_its_place_and_its_statement() -> None:
    rule = statement("p(X) :- q(X).")
    ground = ground_statement(rule, VALUES)
    assert ground.span is rule.span and print_statement(ground) == "p(a) :- q(a)."
    weak = statement(":~ p(X). [1:2]")
    assert ground_statement(weak, VALUES) is weak


@pytest.mark.parametrize(
    ("text", "shown"),
    [("X", "a"), ("Y", "Y"), ("f(X,Y)", "f(a,Y)"), ("N*2-1", "5"), ("N+Y", "3+Y"), ("1-N", "-2")],
)
def test_terms(text: str, shown: str) -> None:
    head = statement(f"p({text}).").head  # type: ignore[union-attr]
    assert print_term(ground_term(head[0].arguments[0], VALUES)) == shown  # type: ignore[index, union-attr]


@pytest.mark.parametrize(
    ("value", "term"),
    [
        (3, Number(3)),
        (A, Identifier("a")),
        (VALUES["F"], Record("f", (Identifier("a"), Number(1)))),
        (Record("g", (Variable("Y"),)), Record("g", (Variable("Y"),))),
    ],
)
def test_values_as_terms(value: Ground | Record, term: Term) -> None:
    assert tree_term(value) == term
