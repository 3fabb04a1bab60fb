"""Values of ground terms, and what stands in a term."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.typed_program import (
    Undefined,
    apply_operator,
    evaluate,
    has_arithmetic,
    is_ground,
    subterms,
    variables,
)
from sparc.sorts.values import Value
from sparc.syntax.tree import Atom, Rule, Term


def term(text: str) -> Term:
    (statement,) = sparc.parse(f"#const n = 3. predicates p(). rules p({text}).").statements
    assert isinstance(statement, Rule) and isinstance(statement.head, tuple)
    (atom,) = statement.head
    assert isinstance(atom, Atom)
    return atom.arguments[0]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("7", 7), ("a", "a"), ("n", 3), ("f(a,n)", ("f", "a", 3)), ("f(g(1+n))", ("f", ("g", 4))),
        ("2+3*4-1", 13), ("(2+3)*4", 20), ("0-7", -7), ("X", None), ("f(a,X)", None), ("X+1", None),
        ("f(_)", None),
    ],
)  # fmt: skip
def test_values(text: str, value: Value | None) -> None:
    assert evaluate(term(text), {"n": 3}) == value
    assert is_ground(term(text)) is (value is not None)


@pytest.mark.parametrize(
    ("left", "right", "quotient"),
    [(7, 2, 3), (-7, 2, -3), (7, -2, -3), (-7, -2, 3), (1, 2, 0), (-1, 2, 0), (0, -5, 0)],
)
def test_division_cuts_towards_zero(left: int, right: int, quotient: int) -> None:
    assert apply_operator("/", left, right, None) == quotient


@pytest.mark.parametrize(
    ("text", "message", "place", "by_zero"),
    [
        ("1/0", "division by zero", "1/0", True),
        ("f(2+4/(n-3))", "division by zero", "4/(n-3)", True),
        ("n+1", "arithmetic needs numbers", "n", False),
        ("2*n", "arithmetic needs numbers", "n", False),
    ],
)
def test_what_has_no_value(text: str, message: str, place: str, by_zero: bool) -> None:
    constants = {"n": 3} if by_zero else {}
    with pytest.raises(Undefined, match=message) as caught:
        evaluate(term(text), constants)
    assert caught.value.by_zero is by_zero
    assert caught.value.span is not None and caught.value.span.text == place


@pytest.mark.parametrize(
    ("text", "parts", "names", "arithmetic"),
    [
        ("a", ["a"], [], False),
        ("f(X,g(_,X))", ["f(X,g(_,X))", "X", "g(_,X)", "_", "X"], ["X", "_", "X"], False),
        ("X+f", ["X+f", "X", "f"], ["X"], True),
        ("f(a,Y*2)", ["f(a,Y*2)", "a", "Y*2", "Y", "2"], ["Y"], True),
    ],
)
def test_what_stands_in_a_term(
    text: str, parts: list[str], names: list[str], arithmetic: bool
) -> None:
    if "f" in parts:  # an identifier cannot be added to
        text, parts = text.replace("f", "n"), [part.replace("f", "n") for part in parts]
    whole = term(text)
    assert [each.span.text for each in subterms(whole)] == parts
    assert [each.name for each in variables([whole])] == names
    assert has_arithmetic(whole) is arithmetic


def test_a_program_that_fits() -> None:
    text = "#const n = 3. #maxint = 9. sorts #s = 1..n. predicates p(#s,#nat). q(). rules p(1,X+1)."
    typed = sparc.check(sparc.parse(text))
    assert (typed.constants, typed.maxint, list(typed.sorts)) == ({"n": 3}, 9, ["nat", "s"])
    assert str(typed.predicates["p"]) == "p(#s, #nat)" and str(typed.predicates["q"]) == "q()"
    assert typed.naturals == {(0, 0): frozenset({"X"})}
    assert str(typed) == text and "p(1,X+1)" in typed._repr_html_()
