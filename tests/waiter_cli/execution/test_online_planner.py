"""The planner within one process: evenings with a bar, whose bounds a programme brings together."""

from __future__ import annotations

import pytest

from tests.support.serving import thinker
from waiter_cli.execution import online_planner
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import generate_instance
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
