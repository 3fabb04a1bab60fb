"""Answer sets as values: how literals are written, and in which order."""

from __future__ import annotations

from sparc.answer_sets import AnswerSet, GroundLiteral, GroundTerm, in_order

A, B = GroundTerm("a"), GroundTerm("b")


def test_literals_are_written_as_sparc_has_them() -> None:
    nested = GroundTerm("f", (GroundTerm("g", (A, 2)), -1))
    assert str(GroundLiteral("p", (nested, B))) == "p(f(g(a,2),-1),b)"
    assert str(GroundLiteral("q", negated=True)) == "-q" and str(A) == "a"


def test_numbers_come_as_numbers_before_names_before_records() -> None:
    terms = [GroundTerm("f", (1,)), B, 10, A, 9, GroundTerm("f", (0,)), GroundTerm("f", (0, 0))]
    found = in_order(GroundLiteral("p", (term,)) for term in terms)
    assert [str(literal) for literal in found] == [
        "p(9)", "p(10)", "p(a)", "p(b)", "p(f(0))", "p(f(1))", "p(f(0,0))",
    ]  # fmt: skip


def test_what_holds_comes_before_its_contrary_and_names_before_all() -> None:
    literals = [GroundLiteral("q"), GroundLiteral("p", (1,), True), GroundLiteral("p", (1,))]
    assert list(map(str, in_order(literals))) == ["p(1)", "-p(1)", "q"]


def test_an_answer_set_is_written_in_order_whatever_the_order() -> None:
    literals = [GroundLiteral("p", (k,)) for k in (10, 2, 1)]
    assert str(AnswerSet(frozenset(literals))) == "{p(1), p(2), p(10)}"
    assert AnswerSet(frozenset(literals)) == AnswerSet(frozenset(literals[::-1]))
    assert str(AnswerSet(frozenset())) == "{}"


def test_a_notebook_shows_a_table() -> None:
    shown = AnswerSet(frozenset({GroundLiteral("p", (A,))}), (3,))._repr_html_()
    assert "<table" in shown and "p" in shown
