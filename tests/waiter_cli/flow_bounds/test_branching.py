"""Cases that cuts leave open: refuted where no plan is shorter, never where one is."""

from __future__ import annotations

from collections import Counter

import pytest

from tests.support.exhaustive import TooLarge, shortest
from tests.support.small_worlds import one_way_problem, small_problem
from waiter_cli.bounds import Bounds, find_bounds
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.flow_bounds import make_closing
from waiter_cli.flow_bounds.branching import Branching
from waiter_cli.flow_bounds.closing import Closing
from waiter_cli.flow_bounds.layer_builder import build_layers
from waiter_cli.flow_bounds.programme import CORNER
from waiter_cli.flow_bounds.relaxation import _PATIENCE, FlowRelaxation
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.model.plan import Plan
from waiter_cli.problems.pose import pose_problem

pytest.importorskip("highspy")


def refuted(closing: Closing, length: int) -> str:
    """What refutes all plans below ``length``: ``cuts``, ``cases``, or nothing."""
    layers = build_layers(closing.jobs, closing.floor)
    relaxation = FlowRelaxation(layers, length + 20, fixes=True)
    enough = length - closing.jobs.deeds
    relaxation.solve(enough)
    if relaxation.refuted:
        return "cuts"
    return "cases" if Branching(relaxation, enough, lambda: enough).refute() else ""


@pytest.mark.parametrize("patience", [15, 1])
@pytest.mark.parametrize("kind", ["full", "one way"])
def test_cases_are_refuted_where_nothing_is_shorter_and_only_there(
    kind: str, patience: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(_PATIENCE, CORNER, patience)
    found: Counter[str] = Counter()
    for seed in range(60):
        problem = one_way_problem(seed) if kind == "one way" else small_problem(seed, full=True)
        bounds = find_bounds(problem)
        if bounds.impossible or bounds.plan is None:
            continue
        try:
            length = shortest(problem, 20_000).length
        except TooLarge:
            continue
        assert length is not None
        loose = Plan(bounds.plan.actions, bounds.plan.horizon + 1)
        closing = make_closing(problem, Bounds(0, loose, None))
        assert closing is not None
        assert not refuted(closing, length + 1), (kind, seed)
        if closing.jobs.whole:
            found[refuted(closing, length)] += 1
    assert found.total() > 15
    assert found[""] <= 0.05 * found.total(), found


def test_a_case_leaves_rows_with_the_same_columns_as_they_are() -> None:
    problem = small_problem(7, full=True)
    plan = find_bounds(problem).plan
    assert plan is not None
    closing = make_closing(problem, Bounds(0, Plan(plan.actions, plan.horizon + 1), None))
    assert closing is not None
    layers = build_layers(closing.jobs, closing.floor)
    relaxation = FlowRelaxation(layers, 30)
    assert relaxation.programme.solve()
    shared = next(row.columns for row in layers.rows if (row.low, row.high) == (0, 1))
    relaxation.divide(shared, None, 0)
    relaxation.divide(shared, 1, None)
    rows, base = relaxation.programme.rows, len(layers.rows)
    assert rows[:base] == layers.rows
    assert [(row.low, row.high) for row in rows[base:]] == [(1, None)]
    assert relaxation.programme.solve()


@pytest.mark.parametrize(("seed", "length"), [(0, 56), (5, 49), (10, 62), (11, 46)])
def test_what_few_rounds_of_cuts_leave_open_is_refuted_case_by_case(
    seed: int, length: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(_PATIENCE, CORNER, 1)
    layout_text, scenario = generate_instance(seed, "M", bar=True)
    layout = read_layout(layout_text, "layout.yaml")
    problem = pose_problem(layout, read_scenario(scenario, "evening.yaml", layout))
    plan = find_bounds(problem).plan
    assert plan is not None
    closing = make_closing(problem, Bounds(0, Plan(plan.actions, plan.horizon + 1), None))
    assert closing is not None
    assert refuted(closing, length) == "cases"
    assert refuted(closing, length + 1) == ""
