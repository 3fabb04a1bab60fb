"""The planner within one process: evenings with a bar, whose bounds a programme brings together."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from sparc.solving.clingo_threads import left_behind
from tests.support.serving import thinker
from tests.support.small_worlds import fleet_problem
from waiter_cli.execution import online_planner
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.fleet_bounds import FleetBounds, find_fleet_bounds
from waiter_cli.layout_tools.generate import generate_instance, generate_layout
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem


def evening() -> Problem:
    layout_text, scenario = generate_instance(4, "M", bar=True)
    layout = read_layout(layout_text, "layout.yaml")
    return pose_problem(layout, read_scenario(scenario, "evening.yaml", layout))


def test_a_search_that_would_take_too_long_is_spared_by_the_programme(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The bounds are 53 and 55 at first, and grounding is said to take longer than there is."""
    pytest.importorskip("highspy")
    monkeypatch.setattr(online_planner, "_SECONDS_PER_STEP_AND_PLACE", 1.0)
    online = thinker(60.0)
    problem = evening()
    online.warm_up(problem.layout, problem.state)
    answer = online.plan(problem)
    assert (answer.status, answer.minimal, online.late) == ("plan", True, 0)
    assert answer.plan is not None and answer.plan.horizon == 55


def test_without_the_programme_the_plan_of_the_bounds_is_given(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(online_planner, "_SECONDS_PER_STEP_AND_PLACE", 1.0)
    monkeypatch.setattr("waiter_cli.flow_bounds.is_available", lambda: False)
    online = thinker(60.0)
    answer = online.plan(evening())
    assert (answer.status, answer.minimal, online.late) == ("undecided", False, 1)
    assert answer.plan is not None and answer.bounds == (53, 55)


def crowded(parties: int) -> Problem:
    """So many parties of four at the door of a large restaurant: the bounds meet at once."""
    layout = read_layout(generate_layout(1, 120, 50, bar=True, waiters=2), "layout.yaml")
    return pose_problem(layout, None, enter=[4] * parties)


def test_a_proved_plan_that_cannot_be_grounded_in_time_is_judged_by_the_rules() -> None:
    """Grounding 500 steps takes minutes and gigabytes and cannot be stopped: it is not begun."""
    online, before = thinker(0.4), left_behind()
    answer = online.plan(crowded(30))
    assert (answer.status, answer.minimal, online.late) == ("plan", True, 0)
    assert answer.plan is not None and answer.plan.horizon == answer.bounds[0] > 400
    assert left_behind() == before


def test_while_a_search_that_cannot_be_stopped_runs_no_other_is_begun(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sparc.solving.clingo_threads.left_behind", lambda: 1)
    monkeypatch.setattr("waiter_cli.planning.planner.find_plan", None)
    monkeypatch.setattr("waiter_cli.flow_bounds.is_available", lambda: False)
    assert thinker(0.4).plan(crowded(1)).minimal
    online = thinker(60.0)
    answer = online.plan(evening())
    assert (answer.status, answer.minimal, online.late) == ("undecided", False, 1)
    assert answer.plan is not None and answer.bounds == (53, 55)


def test_the_bounds_of_several_robots_keep_to_the_time_of_a_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[float | None] = []

    def listens(problem: Problem, deadline: float | None = None) -> FleetBounds:
        asked.append(deadline)
        return find_fleet_bounds(problem, deadline)

    monkeypatch.setattr("waiter_cli.fleets.fleet_bounds.find_fleet_bounds", listens)
    begun, problem = time.monotonic(), fleet_problem(1)
    for limit in (5.0, None):
        replace(thinker(limit), by_bounds=True).plan(problem)
    first, second = asked[0], asked[-1]
    assert first is not None and begun + 5 <= first <= time.monotonic() + 5
    assert second is None
