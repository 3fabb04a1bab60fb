"""An answer in words, exit codes and JSON: a plan, no plan, and what was left open."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from tests.support.rule_cases import ONE, at, plan, posed
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import Exit, Where
from waiter_cli.model.problem import Reason
from waiter_cli.model.state import Goal
from waiter_cli.planning.answer import PlanAnswer
from waiter_cli.planning.search_results import Probe, SearchResult, SearchStatus
from waiter_cli.rules.validator import run

PROBLEM = posed(at("b", seated=ONE, wants_bill="big"), Goal("paid", table="big"))
DONE = plan("give_bill(agent,big)")
RESULT = SearchResult(
    SearchStatus.PLAN, (1, 1), "binary", DONE, minimal=True, proof="unsat",
    probes=(Probe(0, "unsat", 0.25), Probe(1, "sat", 0.5)), seconds=0.75,
)  # fmt: skip
ANSWER = PlanAnswer(PROBLEM, RESULT, "native", find_domain("restaurant"), run(PROBLEM, DONE).states)


def without(status: SearchStatus, **more: Any) -> PlanAnswer:
    """An answer without a plan."""
    result = SearchResult(status, (4, None), "binary", max_steps=9, **more)
    return replace(ANSWER, result=result, states=())


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        (ANSWER, Exit.OK), (without(SearchStatus.NO_PLAN), Exit.PROVED),
        (without(SearchStatus.CONTRADICTION), Exit.PROVED),
        (without(SearchStatus.UNDECIDED, limit="time"), Exit.UNDECIDED),
    ],
    ids=["plan", "no plan", "contradiction", "undecided"],
)  # fmt: skip
def test_the_exit_code_says_how_the_search_ended(answer: PlanAnswer, code: Exit) -> None:
    assert answer.exit_code == code


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (without(SearchStatus.NO_PLAN), "No plan of any length exists."),
        (
            without(SearchStatus.CONTRADICTION),
            "What was observed contradicts what is known.",
        ),
        (
            without(SearchStatus.UNDECIDED, limit="time"),
            "Undecided: the time limit came first; if there is a plan, it has at least 4 steps.",
        ),
        (
            without(SearchStatus.UNDECIDED, limit="max_steps"),
            "Undecided: no plan found within --max-steps 9; "
            "if there is a plan, it has at least 4 steps.",
        ),
        (
            without(SearchStatus.UNDECIDED, limit="memory", lacking="highspy"),
            "Undecided: the memory ran out; if there is a plan, it has at least 4 steps. "
            "Better bounds take the package highspy: pip install highspy.",
        ),
    ],
)
def test_an_answer_without_a_plan_is_one_sentence(answer: PlanAnswer, said: str) -> None:
    assert answer.headline() == said


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, "Minimal: solving proved that 0 are too few (horizons tried: 0 unsat, 1 sat)."),
        ({"proof": "bound", "probes": ()}, "Minimal: a lower bound proves that 0 are too few."),
        ({"plan": plan(), "probes": ()}, "Minimal."),
        (
            {"minimal": False, "limit": "time", "bounds": (1, 3), "probes": ()},
            "Not proved minimal: the limit (time) came first; 1 to 3 steps.",
        ),
        (
            {"minimal": False, "limit": "max_steps", "max_steps": 7, "probes": ()},
            "Not proved minimal: the limit (--max-steps 7) came first; 1 to 1 steps.",
        ),
    ],
)
def test_the_proof_is_told(changes: dict[str, Any], said: str) -> None:
    assert replace(ANSWER, result=replace(RESULT, **changes)).proof_line() == said


@pytest.mark.parametrize(
    ("ties", "said"),
    [("proved", ""), (None, ""), ("budget", "has a budget"), ("limit", "limit came")],
)
def test_what_preferences_left_open_is_told(ties: str | None, said: str) -> None:
    line = replace(ANSWER, result=replace(RESULT, ties=ties)).ties_line()
    assert said in line and bool(said) == bool(line)


def test_reasons_have_their_places() -> None:
    reasons = (Reason("no way", Where("a.yaml", 3, 2)), Reason("no bar"))
    assert without(SearchStatus.NO_PLAN, reasons=reasons).reason_lines() == [
        "a.yaml:3:2: no way", "no bar",
    ]  # fmt: skip


def test_each_step_has_its_words_and_its_place() -> None:
    ((action, words, place),) = ANSWER.steps()
    assert (action.text, place) == ("give_bill(agent,big)", "b") and "bill" in words
    assert [step[1:] for step in replace(ANSWER, states=()).steps()] == [("", "")]


def test_an_answer_prints_its_actions() -> None:
    assert str(ANSWER) == "0 give_bill(agent,big)"
    assert str(without(SearchStatus.NO_PLAN)) == "no_plan"
    assert without(SearchStatus.NO_PLAN)._repr_html_() == "<p>no_plan</p>"
    assert without(SearchStatus.NO_PLAN)._repr_svg_() is None


def test_the_document_of_a_plan() -> None:
    document = ANSWER.document()
    assert (document["status"], document["horizon"], document["minimal"]) == ("plan", 1, True)
    assert [action["text"] for action in document["actions"]] == ["give_bill(agent,big)"]
    assert document["validated"] is True and document["search"]["proof"] == "unsat"
    assert [each["result"] for each in document["search"]["horizons"]] == ["unsat", "sat"]
    assert "reasons" not in document and "limit" not in document


def test_the_document_of_what_is_undecided_has_no_plan_and_its_limit() -> None:
    document = without(SearchStatus.UNDECIDED, limit="time").document()
    assert (document["limit"], document["actions"], document["minimal"]) == ("time", [], False)
    assert document["bounds"] == [4, None] and "final_state" not in document


def test_the_document_of_what_is_impossible_has_its_reasons() -> None:
    document = without(SearchStatus.NO_PLAN, reasons=(Reason("no way"),)).document()
    assert [reason["message"] for reason in document["reasons"]] == ["no way"]
    assert document["validated"] is False
