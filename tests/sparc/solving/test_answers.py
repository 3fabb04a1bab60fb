"""Answer sets one at a time: each once, as many as are asked for, and what is known at the end."""

from __future__ import annotations

import pytest

from sparc.answer_sets import GroundLiteral
from sparc.solving import answers
from sparc.solving.answers import Answers, LiteralMemo, SeenAnswers, shown_literal
from sparc.translation.asp_program import AspProgram

CHOICE = AspProgram("1{p(1..3)}1.", "#show p/1.")


def texts(found: Answers) -> list[str]:
    return sorted(str(answer_set) for answer_set in found)


def test_all_are_found_and_it_is_said_that_they_are_all() -> None:
    found = Answers(CHOICE)
    assert texts(found) == ["{p(1)}", "{p(2)}", "{p(3)}"]
    assert (found.satisfiable, found.complete) == (True, True)


@pytest.mark.parametrize(("models", "complete"), [(2, False), (3, True), (4, True)])
def test_no_more_than_are_asked_for(models: int, complete: bool) -> None:
    found = Answers(CHOICE, models=models)
    assert len(texts(found)) == min(models, 3)
    assert found.complete is complete


def test_a_program_without_answer_sets() -> None:
    found = Answers(AspProgram("p. :- p.", "#show p/0."))
    assert (texts(found), found.satisfiable, found.complete) == ([], False, True)


def test_no_time_is_no_answer() -> None:
    found = Answers(CHOICE, time_limit=0)
    assert (texts(found), found.satisfiable, found.complete) == ([], None, False)


def test_sets_that_show_the_same_come_once() -> None:
    program = AspProgram("1{p(1..3)}1. {q}.", "#show q/0.", has_display=True)
    assert texts(Answers(program)) == ["{q}", "{}"]


def test_only_the_optimal_ones_come_where_something_is_preferred() -> None:
    program = AspProgram("{p(1..2)}. :~ p(X). [1@1,X]", "#show p/1.", has_preferences=True)
    assert texts(Answers(program)) == ["{}"]


def test_elements_of_sorts_are_shown_by_the_sort() -> None:
    literal = GroundLiteral("__room", (1,))
    assert str(shown_literal(literal)) == "#room(1)"
    assert shown_literal(GroundLiteral("room", (1,))) == GroundLiteral("room", (1,))


def test_a_memo_keeps_what_it_made_until_it_is_full(monkeypatch: pytest.MonkeyPatch) -> None:
    import clingo

    made: list[str] = []
    memo = LiteralMemo(lambda literal: made.append(str(literal)))
    monkeypatch.setattr(answers, "_REMEMBERED", 2)
    p, q, r = (clingo.Function(name) for name in "pqr")
    for symbol in (p, p, q, q, r, r, p):
        memo.of(symbol)
    assert made == ["p", "q", "r", "p"]
    assert [str(literal) for literal in memo.literals()] == ["r", "p"]
    memo.clear()
    assert not list(memo.literals())


def test_what_was_seen_is_told_from_what_is_new() -> None:
    seen = SeenAnswers()
    p, q = GroundLiteral("p"), GroundLiteral("q")
    assert [seen.is_new(each) for each in ([p, q], [q, p], [p], [], [])] == [1, 0, 1, 1, 0]
