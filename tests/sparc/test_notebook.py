"""Values show themselves: as text for people, as HTML in a notebook."""

from __future__ import annotations

import pytest

import sparc

PROGRAM = "sorts #n = 1..12. predicates p(#n). q(#n). rules p(10). p(9). -q(1). "


def test_an_answer_set_as_text() -> None:
    (found,) = sparc.solve(PROGRAM)
    assert str(found) == "{p(9), p(10), -q(1)}"


def test_an_answer_set_in_a_notebook() -> None:
    (found,) = sparc.solve(PROGRAM)
    assert found._repr_html_() == (
        "<table><tr><th>p</th><td><code>p(9)</code> <code>p(10)</code></td></tr>"
        "<tr><th>q</th><td><code>-q(1)</code></td></tr></table>"
    )


def test_markup_in_names_stays_text() -> None:
    from sparc.answer_sets import AnswerSet, GroundLiteral

    shown = AnswerSet(frozenset({GroundLiteral("<b>")}))._repr_html_()
    assert "<b>" not in shown and "&lt;b&gt;" in shown


def test_an_error_says_where_what_and_the_mend() -> None:
    with pytest.raises(sparc.SourceError) as caught:
        sparc.parse("sorts #s = {a}. predicates p(#s). rules p(a) <- p(a).", "x.sparc")
    assert str(caught.value) == 'x.sparc:1:46: expected ":-", found "<-"; write ":-"'


def test_several_errors_stand_in_lines() -> None:
    with pytest.raises(sparc.SourceErrors) as caught:
        sparc.parse(
            "sorts #s = {a}. predicates p(#s). rules\np(a) <- p(a).\np(b <- p(a).\n", "x.sparc"
        )
    assert [line[:10] for line in str(caught.value).splitlines()] == ["x.sparc:2:", "x.sparc:3:"]


def test_answers_as_text() -> None:
    answers = sparc.solve("sorts #s = {a}. predicates p(#s). rules {p(a)}.")
    assert str(answers) == "0 answer sets taken, perhaps not all"
    next(answers)
    assert repr(answers) == "<Answers: 1 answer set taken, perhaps not all>"
    list(answers)
    assert str(answers) == "2 answer sets"
    none = sparc.solve("predicates p(). rules p. :- p. ")
    list(none)
    assert str(none) == "no answer set"


def test_why_as_text() -> None:
    program = sparc.parse(
        "sorts #s = {a,b}. predicates p(#s). q(#s). rules\np(a).\nq(X) :- p(X).\n", "x"
    )
    assert str(sparc.why(program, "q(a)")).split("\n") == [
        "q(a) is in the answer set, because:",
        "  q(a)",
        "      x:3: q(X) :- p(X).",
        "        as in: q(a) :- p(a)",
        "    p(a)",
        "        x:2: p(a).",
    ]
    assert str(sparc.why(program, "q(b)")).startswith("q(b) is not in the answer set.\n  x:3: ")
    assert str(sparc.why(program, "q(b)", number=2)) == "q(b): there is no answer set 2"


def test_an_inconsistency_as_text() -> None:
    program = sparc.parse("predicates p(). rules\np.\n:- p.\n", "x")
    assert str(sparc.explain(program)).split("\n") == [
        "inconsistent",
        "these leave no answer set:",
        "  x:2: p.",
        "  x:3: :- p.",
        "there is an answer set:",
        "  without x:3: :- p.",
        "  without x:2: p.",
    ]
    assert str(sparc.explain("predicates p(). rules p. ")) == "consistent"


def test_a_translation_as_text() -> None:
    text = str(sparc.to_asp("predicates p(). rules p. "))
    assert text.split("\n") == ["p.", "#show.", "#show p/0."]
