"""Literals, comparisons and aggregates: their trees, and the mends of those that are none."""

from __future__ import annotations

import pytest

from sparc.syntax.tree import (
    Aggregate,
    Atom,
    Comparison,
    Guard,
    Identifier,
    Naf,
    Number,
    Record,
    Rule,
    SortAtom,
    Variable,
)
from tests.support.sparc_texts import marked, program, rule

X, Y = Variable("X"), Variable("Y")
A = Identifier("a")


def test_literals() -> None:
    q = Atom("q", ())
    assert rule("q :- -q, not q, not -q, #s(X), not #s(X), -#s(X), #s.").body == (
        Atom("q", (), True),
        Naf(q),
        Naf(Atom("q", (), True)),
        SortAtom("s", (X,)),
        Naf(SortAtom("s", (X,))),
        SortAtom("s", (X,), True),
        SortAtom("s", ()),
    )


def test_aggregates() -> None:
    (item,) = rule("q :- 1 < #count {X,f(a) : q, not q; Y : #s(Y)} == X.").body
    assert isinstance(item, Aggregate)
    assert item.function == "count"
    assert item.left == Guard("<", Number(1))
    assert item.right == Guard("=", X)
    assert [element.terms for element in item.elements] == [(X, Record("f", (A,))), (Y,)]


@pytest.mark.parametrize(
    ("body", "place", "mend"),
    [
        ("", ".", "write the body, or leave the connective out"),
        ("p, ", ".", "leave out the comma before the dot"),
        ("p,, p", ",", "one comma parts two literals"),
        ("not(p)", "(", "write not p(X), without parentheses"),
        ("not-p", "-", "write not -p"),
        ("not not p", "not", "there is no double negation"),
        ("not #count{X : p} > 1", "#count", "an aggregate cannot be negated"),
        ("not X < 1", "X", "a comparison cannot be negated"),
        ("not p = 1", "=", "a comparison cannot be negated"),
        ("- p", "-", 'write "-p" without a space'),
        ("--p", "-", '"-" stands once'),
        ("-1 < X", "-", "there is no unary minus: write 0-1"),
        ("-p < X", "-", 'there is no unary minus; "-" negates only an atom'),
        ("X", ".", ""),
        ("X < Y < Z", "<", "a comparison has two sides"),
        ("1 < a", "<", 'only "=" and "!=" are allowed'),
        ("f(X) >= 1+n", ">=", 'only "=" and "!=" are allowed'),
        ("# s(X)", "#", "without space after #"),
        ("#show", "#show", "goes into the section display"),
        ("#minimize{X : p}", "#minimize", "is a statement of its own"),
        ("#external(X)", "#external", "SPARC has no #external"),
        ("{p}", "{", "a choice {…} stands only in a head"),
        ("1 {p}", "{", "to count in a body use #count"),
        ("#count{X} > 1", "}", "each element has a condition"),
        ("#count{X : p} 2", "2", "a guard needs a comparison: #count{…} <= 2"),
        ("1 #count{X : p}", "#count", "a guard needs a comparison: write 1 <= #count{…}"),
        ("#count{X :-p} > 1", ":-", 'write ": -p"'),
        ("#count{X : #sum{Y : p} > 1} > 1", "#sum", "only in a body, not in a condition"),
        ("#count", ".", ""),
    ],
)
def test_what_is_no_literal(body: str, place: str, mend: str) -> None:
    found, hint = marked(f"#const n = 3. predicates p(). rules p :- {body}.")
    assert found == place and mend in hint


def test_a_word_of_another_language_may_be_a_sort() -> None:
    text = "sorts #show = {a}. #count = {b}. predicates p(). rules p :- #show(X), #count(X)."
    (statement,) = program(text).statements
    assert isinstance(statement, Rule)
    assert statement.body == (SortAtom("show", (X,)), SortAtom("count", (X,)))


@pytest.mark.parametrize("comparison", ["1 = a", "n < 1", "a < b", "f(X) != 2", "X >= f(X)"])
def test_comparisons_that_are_allowed(comparison: str) -> None:
    (item,) = rule(f"q :- {comparison}.").body
    assert isinstance(item, Comparison) and item.span.text == comparison
