"""The search oracle and the verifier, written apart, agree step by step and plan by plan."""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from dataclasses import replace
from functools import cache
from random import Random

import pytest

from tests.support.exhaustive import Outcome, TooLarge, World, shortest
from tests.support.small_worlds import (
    FULL_ONLY,
    SPOILERS,
    one_way_problem,
    small_case,
    small_problem,
)
from waiter_cli.model.layout import Layout, Node, Table
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State
from waiter_cli.rules.actions import Illegal, apply, begin, holds, idle, legal_actions
from waiter_cli.rules.validator import run

ACTIONS = (
    *("go_to", "pick", "seat", "give_bill"),
    *("take_order", "send_order", "take_up", "bring", "refill", "bring_chairs"),
)


@cache
def answer(seed: int) -> Outcome:
    """The shortest plan of a small world."""
    return shortest(small_problem(seed))


def as_plan(texts: tuple[str, ...]) -> Plan:
    """The plan that does these actions, one a step; an empty text is an idle step."""
    actions = []
    for step, text in enumerate(texts):
        if text:
            name, _, rest = text.partition("(")
            actions.append(Action(step, name, tuple(rest.rstrip(")").split(","))))
    return Plan(tuple(actions), len(texts))


@pytest.mark.parametrize("kind", ["full", "simple", "one way"])
def test_both_know_the_same_steps_from_every_state_met_by_chance(kind: str) -> None:
    met = 0
    for seed in range(150):
        one_way = kind == "one way"
        problem = one_way_problem(seed) if one_way else small_problem(seed, full=kind == "full")
        world, rng = World(problem), Random(seed)
        try:
            state = begin(problem)
        except Illegal:
            assert world.start(problem) is None
            continue
        assert world.start(problem) == world.encode(state, 0)
        for step in range(15):
            seen = {
                action.text: apply(problem, state, action, step)
                for action in legal_actions(problem, state, step)
            }
            with suppress(Illegal):
                seen[""] = idle(problem, state, step)
            codes = {text: world.encode(after, step + 1) for text, after in seen.items()}
            assert codes == dict(world.successors(world.encode(state, step))), (seed, step)
            for goal in {*problem.goals, *(goal for pair in problem.before for goal in pair)}:
                code = world.encode(state, step)
                assert holds(goal, state, problem) == world.test(goal)(code), (seed, step, goal)
            met += 1
            if not seen:
                break
            # Walking is always possible; other deeds are rare and lead further.
            deeds = [text for text in seen if text and not text.startswith("go_to")]
            state = seen[rng.choice(deeds if deeds and rng.random() < 0.7 else list(seen))]
    assert met > 1500


def test_shortest_plans_are_valid_and_end_as_soon_as_the_goals_hold() -> None:
    for seed in range(300):
        problem, found = small_problem(seed), answer(seed)
        if found.length is not None:
            verdict = run(problem, as_plan(found.plan))
            assert verdict.valid, (seed, verdict.reasons)
            assert verdict.makespan == found.length == len(found.plan)


def test_small_worlds_are_varied_enough_to_mean_something() -> None:
    lengths: list[int | None] = []
    used: Counter[str] = Counter()
    for seed in range(300):
        found = answer(seed)
        lengths.append(found.length)
        used.update(text.partition("(")[0] for text in found.plan)
    assert sum(length is not None and length >= 6 for length in lengths) >= 300 / 3
    assert sum(length is None for length in lengths) >= 300 / 5
    assert all(used[name] >= 6 for name in ACTIONS), used


def test_spoiled_worlds_have_no_plan_and_are_spoiled_in_every_way() -> None:
    kinds: Counter[str] = Counter()
    for seed in range(600):
        case = small_case(seed)
        if case.spoiled is not None:
            assert shortest(case.problem).length is None, (seed, case.spoiled)
            kinds[case.spoiled] += 1
    assert set(kinds) == set(SPOILERS)


def test_the_simple_worlds_use_the_first_four_actions_only() -> None:
    for seed in range(200):
        case = small_case(seed, full=False)
        assert case.spoiled not in FULL_ONLY
        problem = case.problem
        assert problem.layout.bar is None and not problem.layout.timetable
        used = {text.partition("(")[0] for text in shortest(problem).plan}
        assert used <= set(ACTIONS[:4])


def test_equal_seeds_make_equal_worlds() -> None:
    assert [small_case(seed) for seed in range(50)] == [small_case(seed) for seed in range(50)]
    assert len({small_problem(seed).state for seed in range(50)}) > 40


REPORT = Layout(
    name="report",
    nodes=tuple(Node(f"n{k}") for k in range(8)),
    edges=(
        *(("n1", "n2"), ("n2", "n3"), ("n3", "n4"), ("n4", "n5")),
        *(("n4", "n7"), ("n5", "n6"), ("n0", "n5")),
    ),
    entrance="n5",
    tables=(
        Table("table1", 2, ("n6",), None, (0.8, 0.8), 2),
        Table("table2", 4, ("n6", "n7"), None, (0.8, 1.6), 4),
    ),
    agent="n1",
    waiters=(("w1", "n7"),),
)


@pytest.mark.parametrize(
    ("state", "goals", "length"),
    [
        (State("n1", waiting=(("c1",),)), [Goal("seated", party=("c1",))], 7),
        (
            State("n6", seated=(("table1", ("c1",)),), waiting=(("c2", "c3", "c4", "c5"),)),
            [Goal("seated", party=("c2", "c3", "c4", "c5"))],
            4,
        ),
        (
            State("n6", seated=(("table1", ("c1",)),), wants_bill=frozenset({"table1"})),
            [Goal("paid", table="table1")],
            1,
        ),
        (State("n1"), [], 0),
        (State("n1", waiting=(("c1", "c2", "c3", "c4", "c5"),)), [Goal("at", node="n1")], 0),
        (
            State("n1", waiting=(("c1", "c2", "c3", "c4", "c5"),)),
            [Goal("seated", party=("c1", "c2", "c3", "c4", "c5"))],
            None,
        ),
    ],
    ids=["one customer", "a party of four", "a bill", "no wishes", "held already", "five at four"],
)
def test_lengths_that_were_worked_out_by_hand(
    state: State, goals: list[Goal], length: int | None
) -> None:
    state = replace(state, waiters=REPORT.waiters, chairs=(("table1", 2), ("table2", 4)))
    assert shortest(Problem(REPORT, state, (), state, tuple(goals))).length == length


def test_a_search_that_would_take_too_long_says_so() -> None:
    state = State("n1", waiting=(("c1",), ("c2",)))
    problem = Problem(REPORT, state, (), state, (Goal("seated", party=("c1",)),))
    with pytest.raises(TooLarge, match="more than 5 states"):
        shortest(problem, limit=5)
