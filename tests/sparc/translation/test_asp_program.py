"""The translation as text: what is shown, where each line came from, what a file of it needs."""

from __future__ import annotations

from sparc.source import Source, Span
from sparc.translation.asp_program import AspProgram

TEXT = "p.\nq :-\n  p."
SOURCE = Source("x.sparc", TEXT)
P, Q = Span(SOURCE, 0, 2), Span(SOURCE, 3, 12)


def test_what_it_shows_stands_behind_the_rules() -> None:
    assert str(AspProgram("p.", "#show p/0.")) == "p.\n#show p/0."


def test_a_place_stands_above_the_lines_of_a_statement() -> None:
    program = AspProgram("a.\nb.\nc.\n__s(1).\n__t(1).\nd.", "#show.", (P, Q, Q, None, None, P))
    assert program.annotated().split("\n") == [
        "% x.sparc:1", "a.", "% x.sparc:2", "b.", "c.", "% sorts", "__s(1).", "__t(1).",
        "% x.sparc:1", "d.", "#show.",
    ]  # fmt: skip


def test_lines_without_places_have_none() -> None:
    assert AspProgram("a.\nb.", "#show.").annotated() == "a.\nb.\n#show."
    assert AspProgram("a.", "#show.", (P, Q)).annotated().endswith("% x.sparc:2\n\n#show.")


def test_exact_functions_are_loaded_where_they_are_used() -> None:
    script = ["#script (python)", "from sparc.solving.exact_arithmetic import *", "#end."]
    assert AspProgram("p(@plus(0,1,2)).", "", places=(P,)).script() == script
    assert AspProgram("p:-@order(1,2)>0.", "").script() == script
    assert AspProgram("p(1+2).", "").script() == []
    assert AspProgram("p.", "#show.", places=(P,)).annotated().split("\n")[-3:] == script


def test_places_make_no_difference() -> None:
    assert AspProgram("p.", "", (P,), places=(P,)) == AspProgram("p.", "")
    assert AspProgram("p.", "", has_display=True) != AspProgram("p.", "")
