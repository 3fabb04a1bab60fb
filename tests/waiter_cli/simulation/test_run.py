"""Runs from end to end: the recorded scenes, broken plans, things that come in between."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.playing import WALK, layout_of, play, scene
from waiter_cli.bounds import find_bounds
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.event_log import TYPES
from waiter_cli.simulation.outcome import Rules

SCENES = {"b1": 7, "b2": 4, "b3": 1, "b4": 1}


@pytest.mark.parametrize("name", SCENES)
def test_the_recorded_scenes_reach_their_goals_with_every_check(name: str) -> None:
    run = play(scene(name))
    assert run.outcome.status == "done"
    assert not run.outcome.failures
    assert run.outcome.actions == SCENES[name]
    types = run.types()
    assert types[0] == "start" and types[-1] == "end"
    assert set(types) <= set(TYPES)
    assert [event["seq"] for event in run.events] == list(range(len(types)))
    assert run.of("end")[0]["status"] == "done"


def test_times_and_steps_never_go_back() -> None:
    events = play(scene("b1")).events
    assert [e["t"] for e in events] == sorted(e["t"] for e in events)
    assert [e["step"] for e in events] == sorted(e["step"] for e in events)


def test_guests_sit_on_chairs_of_their_own() -> None:
    seated = play(scene("b2")).of("seated")[0]
    assert set(seated["chairs"]) == {"c2", "c3", "c4", "c5"}
    assert len(set(seated["chairs"].values())) == 4
    assert all(chair.endswith("_table2") for chair in seated["chairs"].values())


def test_two_runs_write_the_same_bytes() -> None:
    def once() -> str:
        return "".join(
            play(scene("b2"), inject=["slip:0.4", "enter:2@3"], rules=Rules(seed=5)).lines
        )

    assert once() == once()


def test_another_seed_is_another_run() -> None:
    first, second = (
        play(scene("b1"), inject=["slip:0.5"], rules=Rules(seed=seed)).lines for seed in (1, 2)
    )
    assert first != second


def test_a_long_evening_with_a_bar() -> None:
    problem = replace(scene("lunch"), prefer=())
    run = play(problem)
    assert run.outcome.status == "done", run.outcome.why
    kinds = set(run.types())
    assert {
        "picked",
        "seated",
        "bill",
        "ordered",
        "sent",
        "taken_up",
        "brought",
        "refilled",
    } <= kinds
    assert run.outcome.min_clearance is not None and run.outcome.min_clearance > 0.05


def test_a_plan_that_stops_short_of_its_goals() -> None:
    run = play(scene("b1"), WALK)
    assert [f.check for f in run.outcome.failures] == ["goals"]


def test_a_plan_whose_final_state_is_another() -> None:
    problem = scene("b3")
    predicted = replace(problem.state, wants_bill=frozenset())
    run = play(problem, ("give_bill(agent,table1)",), predicted=predicted)
    assert [f.check for f in run.outcome.failures] == ["final_state"]


@pytest.mark.parametrize("name", [f"generated{k}" for k in range(1, 6)])
def test_generated_rooms_are_played_without_a_collision(name: str) -> None:
    problem = pose_problem(layout_of(name), None, enter=[2, 1])
    run = play(problem)
    assert run.outcome.status == "done", run.outcome.why
    assert run.outcome.min_clearance is None or run.outcome.min_clearance >= 0.05


def test_an_order_that_was_kept_stays_kept_when_a_plan_is_given_up() -> None:
    """The first of two goals is reached by the plan, the second by another one after a failure."""
    text = "state: {seated: {table1: [c1], table2: [c2]}, wants_bill: [table1, table2]}\n"
    text += "goals: [{at: n1}]\nbefore: [[{paid: table1}, {paid: table2}]]"
    layout = read_layout_file("report")
    problem = pose_problem(layout, read_scenario(text, "bills", layout))
    plan = find_bounds(problem).plan
    assert plan is not None
    for seed in range(12):
        run = play(problem, plan, inject=["slip:0.3"], rules=Rules(seed=seed))
        assert run.outcome.status == "done", (seed, run.outcome.why)
        bills = [event["table"] for event in run.of("bill")]
        assert bills == ["table1", "table2"]
