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
