"""What happens by itself in a run: events of a scenario and injections."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.playing import SHIPPED, corridor, layout_of, play, scene
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Observation
from waiter_cli.problems.pose import pose_problem

ENDINGS = {"done", "gave_up"}


def evening(name: str) -> Problem:
    layout = layout_of(name)
    seated = {
        "report": "table1",
        "report_large": "table1",
        "bistro": "table1",
        "walled_off": "table1",
    }
    text = f"state: {{seated: {{{seated[name]}: [g1]}}}}\nobserve: [enter: [g2, g3]]\n"
    return pose_problem(layout, read_scenario(text, "evening", layout))


@pytest.mark.parametrize("layout", SHIPPED)
@pytest.mark.parametrize(
    "inject",
    [
        "block",
        "block+",
        "leave:g2@4",
        "leave:g1@4",
        "enter:1@2",
        "bill:table1@3",
        "slip:0.2",
        "slip:1",
        "stall:3@2",
    ],
)
def test_each_injection_ends_in_something(layout: str, inject: str) -> None:
    problem = evening(layout)
    if inject.startswith("block"):
        near = problem.layout.neighbours()[problem.state.agent]
        inject = f"block:{problem.state.agent}-{near[0]}@0" + ("+5" if inject.endswith("+") else "")
    run = play(problem, inject=[inject])
    assert run.outcome.status in ENDINGS, run.outcome
    assert not run.outcome.failures
    if run.outcome.status == "gave_up":
        assert run.outcome.why
    said = run.of("injected")
    assert said or (inject.startswith("slip") and "action_failed" not in run.types())
    answers = {event.get("answer") for event in run.events} - {None}
    kind = inject.partition(":")[0]
    if kind in ("leave", "enter", "bill"):
        assert answers <= {"replan", "the plan stands"} and answers
    if inject == "slip:1" and said:
        assert run.outcome.status == "gave_up"


def test_who_leaves_while_being_led_is_not_seated() -> None:
    run = play(scene("b1"), inject=["leave:c1@21"])
    assert not run.of("seated")
    assert run.of("action_failed")
    assert run.outcome.status == "done"


def test_events_of_a_scenario_happen_in_their_time() -> None:
    timed = (TimedEvent(5.0, (Observation("bill", ("table1",)),)),)
    problem = replace(scene("b3"), goals=(), everybody=True)
    run = play(problem, timed=timed)
    assert run.outcome.status == "done"
    assert [e["t"] for e in run.of("observed") if "at_start" not in e] == [5.0]
    assert len(run.of("bill")) == 2


def test_news_that_cannot_be_true_is_said_and_ignored() -> None:
    timed = (TimedEvent(1.0, (Observation("leave", ("nobody",)),)),)
    run = play(scene("b1"), timed=timed)
    assert run.of("observed")[-1]["ignored"] == "nobody is not inside"
    assert run.outcome.status == "done"


def test_news_while_nothing_is_to_be_done() -> None:
    """What is seen in an idle step can change what is to be done at that step."""
    problem = corridor(1.0, {1: "n1", 9: "side"})
    timed = (TimedEvent(6.0, (Observation("at", ("anna", "side")),)),)
    run = play(problem, timed=timed)
    assert run.outcome.status == "done" and not run.outcome.failures
    assert run.outcome.seconds < play(problem).outcome.seconds
