"""Bounds by the programme against exhaustive search on small restaurants, and on larger evenings."""

from __future__ import annotations

import subprocess
import sys
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from tests.support.exhaustive import TooLarge, shortest
from tests.support.paths import ROOT
from tests.support.sampling import mostly_slow
from tests.support.small_worlds import one_way_problem, small_problem
from waiter_cli.bounds import Bounds, find_bounds
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.flow_bounds import make_closing, tighten
from waiter_cli.flow_bounds.closing import Closing
from waiter_cli.flow_bounds.contraction import contract
from waiter_cli.flow_bounds.layer_builder import build_layers
from waiter_cli.flow_bounds.relaxation import FlowRelaxation
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.rules.validator import run

pytest.importorskip("highspy")

LOOSE = 30


def loosened(bounds: Bounds) -> Bounds:
    """Bounds that know nothing, so that the programme has to find out by itself."""
    assert bounds.plan is not None
    plan = Plan(bounds.plan.actions, bounds.plan.horizon + LOOSE)
    return replace(bounds, lower=0, plan=plan)


def world(kind: str, seed: int) -> Problem:
    """A small restaurant: the four actions alone, everything, or with paths that lead one way."""
    return one_way_problem(seed) if kind == "one way" else small_problem(seed, full=kind == "full")


def compare(seeds: range, kind: str) -> Counter[str]:
    """How the programme does in small worlds; no bound may be above the least length."""
    found: Counter[str] = Counter()
    for seed in seeds:
        problem = world(kind, seed)
        bounds = find_bounds(problem)
        if bounds.impossible or bounds.plan is None:
            continue
        try:
            length = shortest(problem, 60_000).length
        except TooLarge:
            continue
        assert length is not None
        closing = make_closing(problem, loosened(bounds))
        assert closing is not None
        closing.run()
        assert closing.lower <= length <= closing.plan.horizon, (seed, kind)
        if closing.plan.horizon < bounds.plan.horizon + LOOSE:
            assert run(problem, closing.plan).makespan == closing.plan.horizon, (seed, kind)
        found["worlds"] += 1
        found["exact"] += closing.lower == length
        found["whole"] += closing.jobs.whole
        found["whole exact"] += closing.jobs.whole and closing.lower == length
    return found


KINDS = ("simple", "full", "one way")


@pytest.mark.parametrize("kind", KINDS)
def test_no_bound_is_above_the_least_length_and_most_are_exact(kind: str) -> None:
    found = compare(range(100), kind)
    assert found["worlds"] > 50
    assert found["whole exact"] >= 0.95 * found["whole"] > 30, found
    assert found["exact"] >= 0.9 * found["worlds"], found


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_no_bound_is_above_the_least_length_in_two_thousand_worlds(kind: str) -> None:
    found = compare(range(1200), kind)
    assert found["worlds"] > 400, found
    assert found["whole exact"] >= 0.95 * found["whole"], found


def evening(seed: int, size: str, *, plates: bool = False) -> Problem:
    layout_text, scenario = generate_instance(seed, size, bar=True)
    layout = read_layout(layout_text, "layout.yaml")
    scenario += "instant_kitchen: true\n" * plates
    return pose_problem(layout, read_scenario(scenario, "evening.yaml", layout))


@pytest.mark.parametrize(("seed", "length"), [(0, 176), (4, 177)])
def test_large_evenings_are_closed(seed: int, length: int) -> None:
    problem = evening(seed, "L")
    before = find_bounds(problem)
    assert before.plan is not None and before.lower < before.plan.horizon
    told: list[tuple[int, int]] = []
    bounds = tighten(problem, before, tell=lambda *pair: told.append(pair))
    assert bounds.plan is not None
    assert (bounds.lower, bounds.plan.horizon) == (length, length)
    assert run(problem, bounds.plan).makespan == length
    assert told == sorted(told) and told[-1] == (length, length)


def test_a_deadline_that_is_over_leaves_the_bounds_true() -> None:
    problem = evening(0, "L")
    before = find_bounds(problem)
    after = tighten(problem, before, deadline=time.monotonic() - 1)
    assert after.plan is not None and before.lower <= after.lower <= 176 <= after.plan.horizon


def test_the_order_of_every_plate_comes_before_it_is_taken_up() -> None:
    problem = evening(0, "L", plates=True)
    before = find_bounds(problem)
    bounds = tighten(problem, before)
    assert before.lower < 230 < bounds.lower <= 240


def test_plates_whose_orders_are_told_apart_are_bounded_by_the_truth() -> None:
    """Small kitchens that cook at once, with none, one and all of the orders told apart."""
    looked = 0
    for seed in range(600):
        problem = small_problem(seed)
        bounds = find_bounds(problem) if problem.instant_kitchen else None
        if bounds is None or bounds.impossible or bounds.plan is None:
            continue
        closing = Closing(problem, loosened(bounds))
        orders = closing.jobs.orders
        plates = tuple(k for k, order in enumerate(orders) if order.plate and order.nodes)
        if not plates or any(order.plate and order.table for order in orders):
            continue
        try:
            length = shortest(problem, 60_000).length
        except TooLarge:
            continue
        assert length is not None
        for tracked in ((), plates[:1], plates):
            layers = build_layers(closing.jobs, closing.floor, tracked)
            relaxation = FlowRelaxation(layers, bounds.plan.horizon + LOOSE)
            relaxation.solve(1000)
            assert relaxation.bound + closing.jobs.deeds <= length, (seed, tracked)
        looked += 1
    assert looked >= 3


@pytest.mark.wide
def test_a_long_evening_of_plates_is_closed() -> None:
    problem = evening(1, "L", plates=True)
    bounds = tighten(problem, find_bounds(problem, effort=2))
    assert bounds.plan is not None and (bounds.lower, bounds.plan.horizon) == (120, 120)


def test_paths_that_lead_one_way_are_walked_one_way() -> None:
    """A ring that can be walked round in one sense only: a smaller floor has to keep to that."""
    ring = {0: {1: 1}, 1: {2: 1}, 2: {3: 1}, 3: {4: 1}, 4: {5: 1}, 5: {0: 1}}
    assert contract(ring, {0, 2}) == {0: {2: 2}, 2: {0: 4}}
    both = {0: {1: 1}, 1: {0: 1, 2: 1}, 2: {1: 1}}
    assert contract(both, {0, 2}) == {0: {2: 2}, 2: {0: 2}}
    assert contract(both, {0}) == {0: {}}


@pytest.mark.parametrize("seed", range(6))
def test_a_smaller_floor_has_the_same_distances(seed: int) -> None:
    rng = Random(seed)
    floor: dict[int, dict[int, int]] = {k: {} for k in range(40)}
    for k in range(1, 40):
        for other in (rng.randrange(k), rng.choice([max(0, k - 1), rng.randrange(k)])):
            floor[k][other] = 1
            if rng.random() < 0.8:
                floor[other][k] = 1
    kept = set(rng.sample(range(40), 8))
    small = contract(floor, kept)
    assert kept <= small.keys() and len(small) < 40
    for a in kept:
        assert [_steps(small, a).get(b) for b in kept] == [_steps(floor, a).get(b) for b in kept]


def _steps(floor: dict[int, dict[int, int]], source: int) -> dict[int, int]:
    """Distances by relaxing every edge until nothing changes."""
    found = {source: 0}
    while True:
        more = dict(found)
        for here, line in floor.items():
            for there, steps in line.items():
                if here in more:
                    more[there] = min(more.get(there, 1000), more[here] + steps)
        if more == found:
            return found
        found = more


@pytest.mark.wide
def test_the_graph_and_its_rows_are_the_same_every_time() -> None:
    code = (
        "from tests.waiter_cli.flow_bounds.test_closing import evening, find_bounds, Closing\n"
        "problem = evening(4, 'M')\n"
        "closing = Closing(problem, find_bounds(problem))\n"
        "closing.run()\n"
        "print(closing.layers.keys, closing.layers.rows, closing.lower, closing.plan)\n"
        "print([sorted(cut.inside) for cut in closing.relaxation.cuts])\n"
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


@pytest.mark.parametrize("seed", mostly_slow([None, 5, 9, 21], None, 9))
def test_what_other_bounds_close_does_not_load_highs(seed: int | None, tmp_path: Path) -> None:
    """The finder tells of every import before it happens; `main` ends the process."""
    options = ["--scenario", "lunch"]
    if seed is not None:
        options = []
        for option, text in zip(("--layout", "--scenario"), generate_instance(seed, "M", bar=True)):
            (tmp_path / f"{option}.yaml").write_text(text)
            options += [option, str(tmp_path / f"{option}.yaml")]
    code = (
        "import sys\n"
        "class Teller:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name in ('highspy', 'numpy'):\n"
        "            sys.stderr.write(f'LOADED {name} ')\n"
        "sys.meta_path.insert(0, Teller())\n"
        "from waiter_cli import app\n"
        f"app.main({['plan', *options]!r})\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert ("42 steps" if seed is None else " steps") in done.stdout
    assert (
        "LOADED" if seed is None else "LOADED numpy"
    ) not in done.stderr  # highspy is looked for


def test_nothing_is_printed_by_highs(capfd: pytest.CaptureFixture[str]) -> None:
    problem = evening(4, "M")
    closing = Closing(problem, find_bounds(problem))
    closing.run()
    captured = capfd.readouterr()
    assert captured.out == captured.err == ""
