"""Guards keep the variables of a statement in their sorts, where nothing else does."""

from __future__ import annotations

import pytest

import sparc
from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.tree import Atom, Term
from sparc.translation.guards import Guards, NoInstance, is_anonymous

PROGRAM = """
#const c = 4. #maxint = 9000000.
sorts
#s = {a,b}. #t = {b,c1}. #n = 0..5. #few = 1..3. #far = 8..9. #even = {0,2,4}. #long = 0..9000000.
#f = f(#s,#n). #g = g(#n(X),#n(Y)) : X < Y. #u = #f + {k(1)}. #l = {f(a,1), f(b,2)}. #w = w(#f).
predicates p(#s).
rules
"""
TYPED = sparc.check(sparc.parse(PROGRAM))


def term(text: str) -> Term:
    program = parse(Source("x", f"#const c = 4. predicates p(). rules p({text})."))
    (statement,) = program.statements
    (atom,) = statement.head  # type: ignore[union-attr,misc]
    assert isinstance(atom, Atom)
    return atom.arguments[0]


def guards(**known: str) -> Guards:
    """Guards, with the sorts in which variables are known to lie."""
    made = Guards(TYPED)
    made.known = {name: (TYPED.sorts[sort].extent,) for name, sort in known.items()}
    return made


@pytest.mark.parametrize(
    ("written", "sort", "known", "shown", "due"),
    [
        ("X", "s", {}, "X", ["__s(X)"]),
        ("X", "s", {"X": "s"}, "X", []),
        ("X", "n", {"X": "few"}, "X", []),
        ("X", "few", {"X": "n"}, "X", ["__few(X)"]),
        ("_", "s", {}, "_V1", ["__s(_V1)"]),
        ("a", "s", {}, "a", []),
        ("c", "n", {}, "4", []),
        ("f(a,X)", "f", {}, "f(a,X)", ["__n(X)"]),
        ("f(a,X)", "u", {"X": "few"}, "f(a,X)", []),
        ("f(X,1)", "l", {}, "f(X,1)", ["__l(f(X,1))"]),
        ("g(X,3)", "g", {"X": "n"}, "g(X,3)", ["X<3"]),
        ("w(f(X,1))", "w", {}, "w(f(X,1))", ["__s(X)"]),
        ("X+1", "n", {"X": "n"}, "X+1", ["X<=4"]),
        ("X-c", "n", {"X": "n"}, "X-4", ["X>=4"]),
        ("X+1", "n", {"X": "few"}, "X+1", []),
        ("X+1", "even", {"X": "n"}, "X+1", ["__even(X+1)"]),
        ("X*2", "n", {"X": "n"}, "X*2", ["__n(X*2)"]),
        ("2+c", "far", {}, None, []),
        ("X+1", "far", {"X": "few"}, None, []),
        ("X+1", "s", {"X": "n"}, None, []),
        ("f(a)", "f", {}, None, []),
        ("g(3,2)", "g", {}, "g(3,2)", ["3<2"]),
        ("f(a,7)", "f", {}, None, []),
        ("c1", "s", {}, None, []),
        ("9", "n", {}, None, []),
        ("1/0", "n", {}, None, []),
    ],
)
def test_what_a_term_needs(
    written: str, sort: str, known: dict[str, str], shown: str | None, due: list[str]
) -> None:
    made = guards(**known)
    extent = TYPED.sorts[sort].extent
    if shown is None:
        with pytest.raises(NoInstance):
            made.require(term(written), extent)
        return
    assert made.require(term(written), extent) == shown
    assert made.guards == due
    if "_" not in written:
        made.require(term(written), extent)
        assert made.guards == due  # what is known now needs no second guard


def test_a_number_that_is_computed_is_compared_with_a_long_range() -> None:
    made = guards(X="n")
    made.require(term("X"), TYPED.sorts["long"].extent)
    made.require(term("X*X"), TYPED.sorts["long"].extent)
    assert made.guards == ["@order(X*X,0)>=0", "@order(X*X,9000000)<=0"]


@pytest.mark.parametrize(
    ("written", "sort", "shown", "learnt"),
    [
        ("X", "s", "X", {"X": "s"}),
        ("_", "s", "_", {}),
        ("f(X,Y)", "u", "f(X,Y)", {"X": "s", "Y": "n"}),
        ("w(f(X,_))", "w", "w(f(X,_))", {"X": "s"}),
        ("f(X,Y)", "l", "f(X,Y)", {}),
        ("X+1", "n", "X+1", {}),
    ],
)
def test_what_a_literal_says_of_its_variables(
    written: str, sort: str, shown: str, learnt: dict[str, str]
) -> None:
    made = guards()
    assert made.learn(term(written), TYPED.sorts[sort].extent) == shown
    assert made.known == {name: (TYPED.sorts[each].extent,) for name, each in learnt.items()}
    assert made.guards == []


def test_a_record_that_its_sort_does_not_have_has_no_instance() -> None:
    with pytest.raises(NoInstance):
        guards().learn(term("k(X)"), TYPED.sorts["f"].extent)


def test_anonymous_variables_get_names_where_they_are_counted() -> None:
    made = guards()
    made.named = True
    extent = TYPED.sorts["s"].extent
    assert [made.learn(term("_"), extent), made.learn(term("f(_,_)"), None)] == [
        "_V1",
        "f(_V2,_V3)",
    ]
    made.begin()
    assert made.fresh() == "_V1"


def test_a_variable_of_an_element_has_another_name() -> None:
    made = guards(Y="s")
    made.renamed = {"X": "Y"}
    assert made.require(term("X"), TYPED.sorts["s"].extent) == "Y" and made.guards == []
    assert made.term(term("f(X,c)")) == "f(Y,4)"


@pytest.mark.parametrize(
    ("written", "shown"),
    [("(X+1)*2", "(X+1)*2"), ("X-(1-X)", "X-(1-X)"), ("c*2", "4*2"), ("f(X+1)", "f(X+1)")],
)
def test_arithmetic_keeps_its_parentheses(written: str, shown: str) -> None:
    assert guards(X="n").term(term(written)) == shown


def test_what_may_leave_32_bits_is_an_exact_function_with_its_place() -> None:
    made = guards(X="long", Y="n")
    assert made.term(term("X*X+Y")) == "@plus(1,@times(0,X,X),Y)"
    assert [span and span.text for span in made.places] == ["X*X", "X*X+Y"]


@pytest.mark.parametrize(
    ("written", "anonymous"), [("_", True), ("X", False), ("f(a,g(_))", True), ("1+_", True)]
)
def test_anonymous_variables_are_seen(written: str, anonymous: bool) -> None:
    assert is_anonymous(term(written)) is anonymous
