"""Statements: rules, choices, preferences, and the mends of what goes on where it cannot."""

from __future__ import annotations

import pytest

from sparc.syntax.tree import (
    Arithmetic,
    Atom,
    Choice,
    ChoiceElement,
    CrRule,
    Guard,
    Identifier,
    Number,
    Optimize,
    RangeFact,
    Variable,
    WeakConstraint,
)
from tests.support.sparc_texts import marked, rule, rules

X = Variable("X")


@pytest.mark.parametrize(
    ("text", "left", "right"),
    [
        ("{q}.", None, None),
        ("1{q}2.", Guard("<=", Number(1)), Guard("<=", Number(2))),
        ("n{q}n.", Guard("<=", Identifier("n")), Guard("<=", Identifier("n"))),
        ("{q} = 1.", None, Guard("=", Number(1))),
        ("1{q} == 1.", Guard("<=", Number(1)), Guard("=", Number(1))),
        ("X < {q} X*2.", Guard("<", X), Guard("<=", Arithmetic("*", X, Number(2)))),
    ],
)
def test_bounds(text: str, left: Guard | None, right: Guard | None) -> None:
    element = ChoiceElement(Atom("q", ()), ())
    assert rule(text).head == Choice((element,), left, right)


def test_other_statements() -> None:
    q, s = Atom("q", ()), Atom("s", (X,))
    assert rules("p(1..n). -p(n..2).") == (
        RangeFact("p", Number(1), Identifier("n")),
        RangeFact("p", Identifier("n"), Number(2), True),
    )
    assert rules("lab : q :+ s(X). q | s(X) :+ . :+ q.") == (
        CrRule("lab", (q,), (s,)),
        CrRule(None, (q, s), ()),
        CrRule(None, (), (q,)),
    )
    assert rules(":~ q. :~ q. [1:] :~ q. [:X] :~ q. [n:2]") == (
        WeakConstraint((q,), None, None),
        WeakConstraint((q,), Number(1), None),
        WeakConstraint((q,), None, X),
        WeakConstraint((q,), Identifier("n"), Number(2)),
    )
    assert rules("#minimize{X:s(X)}. #maximize{1,X@n:q,s(X)}.") == (
        Optimize(False, (X,), None, (s,)),
        Optimize(True, (Number(1), X), Identifier("n"), (q, s), priority_index=1),
    )


def test_places_of_statements() -> None:
    text = "q :- p.\n  lab : q\n :+ . {q} 1. :~ q. [1:2] p(1..2)."
    found = [statement.span.text for statement in rules(text)]
    assert found == ["q :- p.", "lab : q\n :+ .", "{q} 1.", ":~ q. [1:2]", "p(1..2)."]


@pytest.mark.parametrize(
    ("statement", "place", "mend"),
    [
        ("p, q.", ",", 'the atoms of a disjunction are parted by "|"'),
        ("p; q.", ";", 'the atoms of a disjunction are parted by "|"'),
        ("p v q.", "v", 'the atoms of a disjunction are parted by "|"'),
        ("p(X) < 3.", "<", "a comparison cannot be a head"),
        ("p(a) : q.", ":", 'write ":-" before a body'),
        ("p(a) {q}.", "{", "the bound of a choice is a number"),
        ("{p} | q.", "|", "a choice cannot stand in a disjunction"),
        ("q | {p}.", "{", "a choice cannot stand in a disjunction"),
        ("{p}, {q}.", ",", "a rule has one choice: write a rule for each"),
        ("{p} {q}.", "{", "does the one before end with a dot?"),
        ("not p.", "not", "move the literal into the body"),
        ("[1:2].", "[", "follows its dot"),
        ("#count{X : p} > 1.", "#count", "an aggregate stands only in a body"),
        ("a{p}.", "a", "#const a = 3."),
        ("X >= Y.", "Y", "a comparison cannot be a head; write a constraint"),
        ("3.", ".", "a rule begins with an atom, a choice, or :-"),
        ("{}.", "}", "a choice has an element at least"),
        ("{p, q}.", ",", 'part the elements of a choice by ";"'),
        ("{p :-q}.", ":-", 'write ": -p"'),
        ("l : p.", ".", "only a consistency-restoring rule has a label"),
        ("l : p :- q.", ":-", "only a consistency-restoring rule has a label"),
        (":+ .", ".", "write the body, or leave the connective out"),
        ("p(1..3,a).", ",", "only a predicate with one argument may have a range"),
        ("p(1..-3).", "-", "there are no negative numbers in a range"),
        ("p(1..2+1).", "+", "the ends of a range are numbers or constants"),
        ("p(1..2) :- q.", ":-", "a range stands only in a fact p(m..n). of its own"),
        ("- p(1..2).", "-", 'write "-p" without a space'),
        ("q :- p (a) (b).", "(", "a parenthesis stands only in arithmetic"),
        ("#minimize{X : -#s(X)}.", "-", "#minimize takes atoms only"),
        (":~ p. [1@2]", "@", "weight and level are parted by a colon"),
        (":~ p. [1+1:2]", "+", "weight and level are single numbers"),
        (":~ p. []", "[", "write [1:1]"),
        (":~ p. [:]", "[", "write [1:1]"),
        (":~ p. [1:2].", ".", "the dot stands before the brackets"),
        ("#minimize{X}.", "}", "follow a colon: #minimize{X : cost(X)}."),
        ("#minimize{: p}.", ":", "stands before the colon: #minimize{X : cost(X)}."),
        ("#minimize{X@1,Y@2 : p}.", "@", "only one parameter has a priority"),
        ("#minimize{X+1 : p}.", "+", "a parameter of #minimize is a single number"),
        ("#maximize{X : p; Y : q}.", ";", "#maximize has one element"),
        ("#minimize{X : p(X) > 3}.", ">", "there are no comparisons in #minimize"),
        ("#minimize{X : not p}.", "not", "#minimize takes atoms only"),
        ("#minimize{X : p} :- q.", ":-", "#minimize has no body"),
    ],
)
def test_what_is_no_statement(statement: str, place: str, mend: str) -> None:
    found, hint = marked(f"predicates p(). rules {statement}")
    assert found == place and mend in hint


def test_a_statement_without_its_dot_is_marked_behind_its_last_word() -> None:
    assert marked("predicates p(). rules\n{p}\nq.") == ("", 'every statement ends with "."')
