"""No false proof: whatever the bounds say of two goals, trying everything says so, too.

Pairs of goals of every two kinds, in every state of their parties, mostly one before the other
(`tests/support/goal_pairs.py`).  What is impossible by the bounds has no plan; no plan is shorter
than their lower bound; what they construct is a plan; where there is one at all, there is one
within their cap.  Each run has each pair of kinds equally often.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest

from tests.support.exhaustive import TooLarge, shortest
from tests.support.goal_pairs import PAIRS, pair_problem
from tests.support.planning import length, search
from tests.support.sampling import widened
from waiter_cli.bounds import find_bounds, find_impossible
from waiter_cli.model.layout import Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State
from waiter_cli.planning.strategies import crude_cap
from waiter_cli.rules.validator import run

BOUNDED = range(13 * len(PAIRS))  # two thousand where it is wide
PLANNED = range(0, len(PAIRS), 2)
TENS = 10 * len(PAIRS)
MORE = (*range(0, 3 * TENS, TENS), *range(10_000, 10_000 + 24 * TENS, TENS))
LIMIT = 6_000


def judge(problem: Problem) -> int | None:
    """The length of a shortest plan, with which the bounds agree."""
    bounds = find_bounds(problem)
    least = shortest(problem, LIMIT).length
    if least is None:
        assert bounds.plan is None, f"there is no plan, yet the bounds have {bounds.plan}"
        return None
    assert not bounds.impossible, f"a plan of {least} steps exists: {bounds.impossible}"
    assert bounds.lower <= least, f"a plan of {least} steps exists, not only of {bounds.lower}"
    for cap in (bounds.cap, crude_cap(problem)):
        assert cap is None or cap >= least, f"the shortest plan has {least} steps, not {cap}"
    if bounds.plan is not None:
        verdict = run(problem, bounds.plan)
        assert verdict.valid and verdict.makespan == bounds.plan.horizon >= least
    return least


def judge_all(seeds: range) -> Counter[str]:
    found: Counter[str] = Counter()
    for seed in seeds:
        try:
            least = judge(pair_problem(seed))
        except TooLarge:
            found["too large"] += 1
        except AssertionError as wrong:
            raise AssertionError(f"pair_problem({seed}): {wrong}") from wrong
        else:
            found["none" if least is None else "plan"] += 1
    return found


@pytest.mark.parametrize("seeds", widened(BOUNDED[: 4 * len(PAIRS)], BOUNDED))
def test_the_bounds_prove_nothing_false_of_two_goals(seeds: range) -> None:
    found = judge_all(seeds)
    assert found.total() - found["too large"] >= 2000 * len(seeds) / len(BOUNDED)
    assert found["plan"] >= len(seeds) // 4 and found["none"] >= len(seeds) * 2 // 5, found


def test_plans_for_two_goals_are_the_shortest() -> None:
    for seed in PLANNED:
        problem = pair_problem(seed)
        assert length(search(problem)) == shortest(problem).length, f"pair_problem({seed})"


@pytest.mark.slow
@pytest.mark.parametrize("first", MORE)
def test_the_bounds_prove_nothing_false_of_tens_of_thousands(first: int) -> None:
    judge_all(range(first, first + TENS))


@pytest.mark.slow
@pytest.mark.parametrize("first", MORE)
def test_thousands_of_plans_for_two_goals_are_the_shortest(first: int) -> None:
    for seed in range(first, first + 2 * len(PAIRS)):
        problem = pair_problem(seed)
        assert length(search(problem)) == shortest(problem).length, f"pair_problem({seed})"


# ------------------------------------------------------------- what was once proved, and false


def two_tables(state: State, *before: tuple[Goal, Goal], goals: tuple[Goal, ...] = ()) -> Problem:
    """A door and a hall with two tables of one seat; the pairs of goals in their order."""
    tables = tuple(Table(name, 1, ("b",), None, (0.8, 0.8), 1) for name in ("t0", "t1"))
    layout = Layout("mini", (Node("a"), Node("b")), (("a", "b"),), "a", tables, "a")
    state = replace(state, chairs=(("t0", 1), ("t1", 1)))
    return Problem(layout, state, (), state, goals, before)


def test_nobody_who_waits_shares_a_table_with_a_goal_that_names_none() -> None:
    state = State("a", seated=(("t1", ("c1",)),), waiting=(("c4",),), wants_bill=frozenset({"t1"}))
    serve, paid = Goal("serve", party=("c4",)), Goal("paid", party=("c1",))
    problem = two_tables(state, (serve, paid), goals=(serve,))
    assert find_impossible(problem) == ()
    assert length(search(problem)) == 4


def test_a_place_that_is_passed_first_may_be_where_the_plan_ends() -> None:
    state = State("a", seated=(("t0", ("c1",)),), wants_bill=frozenset({"t0"}))
    hall, paid = Goal("at", node="b"), Goal("paid", table="t0")
    problem = two_tables(state, (hall, paid), goals=(hall,))
    by_the_door = tuple(replace(table, nodes=("a",)) for table in problem.layout.tables)
    problem = replace(problem, layout=replace(problem.layout, tables=by_the_door))
    assert length(search(problem)) == shortest(problem).length == 4
