"""Bounds against exhaustive search on small restaurants, and against each other on large ones."""

from __future__ import annotations

import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from functools import cache

import pytest

from tests.support.exhaustive import TooLarge, shortest
from tests.support.paths import ROOT
from tests.support.small_worlds import small_case
from waiter_cli.bounds import Bounds, find_bounds
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario, read_scenario_file
from waiter_cli.layout_tools.generate import SIZES, generate_instance
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.rules.validator import run

SIMPLE, FULL = 210, 210


@cache
def judged(full: bool) -> tuple[tuple[int, Problem, int | None, Bounds], ...]:
    """Small problems by their seed, the length of a shortest plan, and the bounds."""
    found = []
    for seed in range(FULL if full else SIMPLE):
        problem = small_case(seed, full=full).problem
        try:
            length = shortest(problem, 60_000).length
        except TooLarge:
            continue
        found.append((seed, problem, length, find_bounds(problem)))
    return tuple(found)


def both() -> Iterator[tuple[int, Problem, int | None, Bounds]]:
    yield from judged(False)
    yield from judged(True)


def test_there_is_enough_to_judge_by() -> None:
    lengths = [length is not None for _, _, length, _ in both()]
    assert len(lengths) >= 400
    assert 100 <= lengths.count(False) <= len(lengths) - 250


def test_no_plan_is_shorter_than_the_lower_bound() -> None:
    for seed, _, length, bounds in both():
        assert length is None or bounds.lower <= length, seed


def test_every_plan_is_legal_reaches_the_goals_and_ends_there() -> None:
    for seed, problem, length, bounds in both():
        if bounds.plan is not None:
            verdict = run(problem, bounds.plan)
            assert verdict.valid, seed
            assert verdict.makespan == bounds.plan.horizon, seed
            assert length is not None and length <= bounds.plan.horizon, seed


@pytest.mark.wide
@pytest.mark.parametrize("full", [False, True])
def test_the_bounds_hold_in_more_small_worlds(full: bool) -> None:
    """The same of six times as many."""
    judged_here = 0
    for seed in range(6 * FULL):
        problem = small_case(seed, full=full).problem
        try:
            length = shortest(problem, 60_000).length
        except TooLarge:
            continue
        bounds = find_bounds(problem)
        judged_here += 1
        if length is not None:
            assert bounds.lower <= length and not bounds.impossible, seed
            assert bounds.cap is not None and length <= bounds.cap, seed
        if bounds.plan is not None:
            verdict = run(problem, bounds.plan)
            assert verdict.valid and length is not None and length <= bounds.plan.horizon, seed
    assert judged_here > FULL


def test_where_there_is_a_plan_one_is_no_longer_than_the_cap() -> None:
    for seed, _, length, bounds in both():
        assert length is None or (bounds.cap is not None and length <= bounds.cap), seed


def test_what_is_called_impossible_is() -> None:
    for seed, _, length, bounds in both():
        assert length is None or not bounds.impossible, (seed, bounds.impossible)


def test_seating_and_bills_without_a_plan_are_called_impossible() -> None:
    for seed, _, length, bounds in judged(False):
        assert bool(bounds.impossible) == (length is None), seed


def test_the_full_service_without_a_plan_is_called_impossible() -> None:
    """Complete, here, without a timetable and an order of goals, which are looked at in part."""
    for seed, problem, length, bounds in judged(True):
        if not problem.layout.timetable and not problem.before:
            assert bool(bounds.impossible) == (length is None), seed


def test_seating_and_bills_are_bounded_exactly() -> None:
    for seed, problem, length, bounds in judged(False):
        if length is not None and not problem.before:
            assert bounds.plan is not None, seed
            assert (bounds.lower, bounds.plan.horizon) == (length, length), seed


def test_the_full_service_is_nearly_always_bounded_exactly() -> None:
    hits: Counter[str] = Counter()
    for _, problem, length, bounds in judged(True):
        if length is None:
            continue
        kind = "moves" if problem.layout.timetable else "before" if problem.before else "still"
        hits[kind] += 1
        hits[f"{kind} lower"] += bounds.lower == length
        hits[f"{kind} upper"] += bounds.plan is not None and bounds.plan.horizon == length
    for what, share in (
        ("still lower", 0.98),
        ("still upper", 0.99),
        ("before upper", 0.75),
        ("moves lower", 0.8),
        ("moves upper", 0.8),
    ):
        assert hits[what] >= share * hits[what.split()[0]], (what, hits)


def instance(seed: int, size: str, *, bar: bool = False) -> Problem:
    layout_text, scenario_text = generate_instance(seed, size, bar=bar)
    layout = read_layout(layout_text, "layout.yaml")
    return pose_problem(layout, read_scenario(scenario_text, "scenario.yaml", layout))


@pytest.mark.wide
@pytest.mark.parametrize(("size", "count"), [("S", 20), ("M", 20), ("L", 20), ("XL", 20)])
def test_large_evenings_are_bounded_exactly(size: str, count: int) -> None:
    met = 0
    for seed in range(count):
        problem = instance(seed, size)
        bounds = find_bounds(problem)
        assert bounds.plan is not None and bounds.lower <= bounds.plan.horizon
        assert run(problem, bounds.plan).valid
        met += bounds.lower == bounds.plan.horizon
    assert met >= (count if size != "XL" else count - 2)


@pytest.mark.parametrize("size", SIZES)
def test_full_service_at_every_size_has_a_legal_plan(size: str) -> None:
    problem = instance(3, size, bar=True)
    bounds = find_bounds(problem)
    assert bounds.plan is not None and run(problem, bounds.plan).valid
    assert bounds.lower <= bounds.plan.horizon <= (bounds.cap or 0)
    assert bounds.lower >= 0.6 * bounds.plan.horizon


@pytest.mark.parametrize(
    ("scenario", "length"), [("b1", 7), ("b2", 4), ("b3", 1), ("b4", 1), ("lunch", 42)]
)
def test_shipped_scenes_are_bounded_exactly(scenario: str, length: int) -> None:
    layout, read = read_scenario_file(scenario)
    bounds = find_bounds(pose_problem(layout, read))
    assert bounds.plan is not None
    assert (bounds.lower, bounds.plan.horizon) == (length, length)


def test_goals_that_hold_take_no_step() -> None:
    layout = read_layout_file("report")
    bounds = find_bounds(pose_problem(layout, goals=[f"at: {layout.agent}"]))
    assert bounds.plan is not None
    assert (bounds.lower, bounds.plan.horizon, bounds.plan.actions) == (0, 0, ())


def test_a_deadline_that_is_over_still_gives_bounds_that_are_true() -> None:
    problem = instance(5, "XL")
    hasty = find_bounds(problem, deadline=time.monotonic() - 1)
    patient = find_bounds(problem)
    assert hasty.plan is not None and patient.plan is not None
    assert hasty.lower <= patient.plan.horizon and patient.lower <= hasty.plan.horizon
    assert run(problem, hasty.plan).valid


@pytest.mark.wide
def test_the_same_problem_has_the_same_bounds() -> None:
    code = (
        "from waiter_cli.bounds import find_bounds\n"
        "from tests.waiter_cli.bounds.test_find_bounds import instance\n"
        "for size in 'SML':\n"
        "    print(find_bounds(instance(7, size)), find_bounds(instance(7, size, bar=True)))\n"
    )
    outputs = {
        subprocess.run(
            [sys.executable, "-c", code],
            cwd=ROOT,
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "3")
    }
    assert len(outputs) == 1


def test_nothing_heavy_is_imported() -> None:
    code = (
        "import sys, waiter_cli.bounds\n"
        "print(*{'clingo', 'numpy', 'scipy', 'networkx', 'yaml', 'rich'} & sys.modules.keys())"
    )
    found = subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        env={"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout.strip() == ""
