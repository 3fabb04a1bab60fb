"""Terms: the trees they become, and how deep and how large they may be."""

from __future__ import annotations

import pytest

from sparc.errors import LimitError
from sparc.syntax.tree import (
    Arithmetic,
    Atom,
    Comparison,
    Identifier,
    Number,
    Record,
    Term,
    Variable,
)
from tests.support.sparc_texts import marked, rule, rules

X, Y = Variable("X"), Variable("Y")
A = Identifier("a")


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("X", X),
        ("_", Variable("_")),
        ("7", Number(7)),
        ("a", A),
        ("f(a,X)", Record("f", (A, X))),
        ("f (g(a) , 1)", Record("f", (Record("g", (A,)), Number(1)))),
        ("X+1", Arithmetic("+", X, Number(1))),
        ("X-n", Arithmetic("-", X, Identifier("n"))),
        ("X-Y-1", Arithmetic("-", Arithmetic("-", X, Y), Number(1))),
        ("X/Y*2", Arithmetic("*", Arithmetic("/", X, Y), Number(2))),
        ("X+Y*2", Arithmetic("+", X, Arithmetic("*", Y, Number(2)))),
        ("X*Y+2", Arithmetic("+", Arithmetic("*", X, Y), Number(2))),
        ("X*(Y+2)", Arithmetic("*", X, Arithmetic("+", Y, Number(2)))),
        ("X-(Y-1)", Arithmetic("-", X, Arithmetic("-", Y, Number(1)))),
        ("((X))", X),
        ("f(X+1,(Y))", Record("f", (Arithmetic("+", X, Number(1)), Y))),
    ],
    ids=str,
)
def test_trees(text: str, tree: Term) -> None:
    assert rule(f"p({text}).").head == (Atom("p", (tree,)),)
    assert rule(f":- 0 = {text}.").body == (Comparison(Number(0), "=", tree),)


def test_places() -> None:
    (atom,) = rule("p :- q(f(X), (X+1) * 2).").body
    assert isinstance(atom, Atom)
    assert atom.span.text == "q(f(X), (X+1) * 2)"
    assert atom.name_span.text == "q"
    assert [term.span.text for term in atom.arguments] == ["f(X)", "(X+1) * 2"]
    assert str(atom.arguments[1].span.location) == "test.sparc:2:14"


@pytest.mark.parametrize(
    "text",
    [
        "p(" + "f(" * 20_000 + "a" + ")" * 20_000 + ").",
        "p(" + "(" * 20_000 + "X" + ")" * 20_000 + ").",
        "p(" + "f(" * 20_000,
        "p(X" + "+1" * 20_000 + ").",
        "p(" + "1-(" * 20_000 + "X" + ")" * 20_000 + ").",
        "p(" + "1*(f(" * 20_000,
        "q :- X = " + "(" * 20_000 + "X.",
    ],
    ids=["records", "parentheses", "open", "sum", "nested sums", "mixed", "comparison"],
)
def test_how_deep_they_nest(text: str) -> None:
    with pytest.raises(LimitError, match="nested deeper than 200 levels") as info:
        rules(text)
    assert info.value.span is not None
    assert info.value.span.location.line == 2


def test_how_large_numbers_are() -> None:
    assert rules("p(2147483647).")
    with pytest.raises(LimitError, match="larger than 2147483647"):
        rules("p(2147483648).")
    with pytest.raises(LimitError, match="larger than 2147483647"):
        rules("p(" + "9" * 20_000 + ").")


@pytest.mark.parametrize(
    ("term", "place", "mend"),
    [
        ("f()", ")", "without arguments write f"),
        ("f(X,)", ")", 'leave out the comma before ")"'),
        ("#s", "#s", "a sort is no term"),
        ("not", "not", '"not" is a reserved word'),
        ("and", "and", '"and" is a reserved word'),
        ("-1", "-", "there is no unary minus: write 0-1"),
        ("-n", "-", "there is no unary minus: write 0-n"),
        ("-a", "-", '"-" negates only an atom'),
        ("(X,Y)", ",", "there are no tuples"),
        ("X;Y", ";", "there are no pools"),
        ("f(X;Y)", ";", "there are no pools"),
        ("(a)", "a", "leave the parentheses out"),
        ("a+1", "a", "#const a = 3."),
        ("X*(a)", "a", "leave the parentheses out"),
        ("1+f(X)", "f(X)", ""),
        ("f(X)+1", "f(X)", ""),
        ("X+", ")", ""),
    ],
)
def test_what_is_no_term(term: str, place: str, mend: str) -> None:
    found, hint = marked(f"#const n = 3. sorts #s = {{a}}. predicates p(#s). rules p({term}).")
    assert found == place and mend in hint


@pytest.mark.parametrize(
    ("term", "place", "mend"),
    [
        ("-1", "-", "no negative numbers in a set"),
        ("X", "X", "the elements of a set have no variables"),
        ("(a)", "(", "without parentheses"),
        ("1+1", "+", "there is no arithmetic in a set"),
        ("f(n+1)", "+", "there is no arithmetic in a set"),
        ("a,", "}", 'leave out the comma before "}"'),
    ],
)
def test_what_is_no_ground_term(term: str, place: str, mend: str) -> None:
    found, hint = marked(f"#const n = 3. sorts #s = {{{term}}}. predicates rules ")
    assert found == place and mend in hint
