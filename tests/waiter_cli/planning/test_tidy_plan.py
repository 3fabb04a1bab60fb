"""Plans that people would call sensible: nothing is postponed, who came first is fetched first.

Judged by `tests/support/sensible.py`, which tries every plan that differs a little.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.exhaustive import TooLarge, least_waiting, shortest
from tests.support.planning import length, scenario, search
from tests.support.sampling import mostly_slow, mostly_wide
from tests.support.sensible import out_of_turn, postponed, too_large, total_waiting
from tests.support.small_worlds import small_problem
from waiter_cli.bounds import find_bounds
from waiter_cli.encoding.domains import find_domain
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.planning import strategies as search_module
from waiter_cli.planning import tidy_plan as tidying
from waiter_cli.planning.planner import find_plan
from waiter_cli.planning.prober import LimitReached, Prober
from waiter_cli.planning.search_results import SearchOptions, SearchStatus
from waiter_cli.planning.tidy_plan import tidy
from waiter_cli.problems.pose import pose_problem
from waiter_cli.rules.validator import run
from waiter_cli.translators.native import NativeTranslator

BLOCK = 10
STRATEGIES = ("binary", "gallop", "linear", "minimize")


def posed(layout: str, state: str = "", **more: object) -> Problem:
    """A problem of a layout in YAML, and a scenario."""
    hall = read_layout(layout, "hall.yaml")
    given = read_scenario(state, "s.yaml", hall) if state else None
    return pose_problem(hall, given, **more)  # type: ignore[arg-type]


def texts(problem: Problem, **options: object) -> list[str]:
    """The actions of the plan that is found."""
    result = search(problem, **options)  # type: ignore[arg-type]
    assert result.plan is not None and result.minimal
    return [action.text for action in result.plan.actions]


def generated(size: str, seed: int, *, bar: bool) -> Problem:
    layout, scenario_text = generate_instance(seed, size, bar=bar)
    hall = read_layout(layout, "l.yaml")
    return pose_problem(hall, read_scenario(scenario_text, "s.yaml", hall))


def faults(problem: Problem, plan: Plan) -> list[str]:
    """What people would change about a plan."""
    return [*postponed(problem, plan), *out_of_turn(problem, plan), *too_large(problem, plan)]


# -- cases that are easily told ---------------------------------------------------------------

STAR = """
name: star
nodes: [door, aisle, back]
edges: [[door, aisle], [aisle, back]]
entrance: door
agent: aisle
tables:
  six: {capacity: 6, nodes: [aisle]}
  four: {capacity: 4, nodes: [aisle]}
  two: {capacity: 2, nodes: [aisle]}
  pair: {capacity: 2, nodes: [aisle]}
  far: {capacity: 2, nodes: [back]}
"""
WAY = """
name: way
nodes: [hatch, aisle, hall, door]
edges: [[hatch, aisle], [aisle, hall], [hall, door]]
entrance: door
agent: hatch
bar: [hatch]
tables: {near: {capacity: 2, nodes: [aisle]}, far: {capacity: 2, nodes: [aisle, hall]}}
"""


@pytest.mark.parametrize("strategy", mostly_wide(STRATEGIES, "binary"))
def test_who_came_first_is_fetched_first_unasked(strategy: str) -> None:
    problem = posed(STAR, enter=(2, 2, 4, 1))
    picks = [text for text in texts(problem, strategy=strategy) if text.startswith("pick")]
    assert picks == [f"pick(agent,c{k})" for k in (1, 3, 5, 9)]


def test_everybody_gets_the_smallest_table_that_costs_no_step() -> None:
    done = texts(posed(STAR, enter=(2, 4, 2)))
    assert "seat(agent,c3,four)" in done
    assert {text.rpartition(",")[2] for text in done if "seat" in text} == {
        "four)",
        "two)",
        "pair)",
    }


def test_a_table_on_another_way_that_is_as_short() -> None:
    """Also where there are too many tables for an optimization nobody asked for."""
    spare = "\n".join(f"  t{k}: {{capacity: 6, nodes: [left]}}" for k in range(12))
    fork = f"""
name: fork
nodes: [door, left, right]
edges: [[door, left], [door, right]]
entrance: door
agent: door
tables:
{spare}
  small: {{capacity: 2, nodes: [right]}}
"""
    problem = posed(fork, enter=(2,))
    plan = Plan(
        tuple(
            Action(k, name, ("agent", *more))
            for k, (name, *more) in enumerate(
                [("pick", "c1"), ("go_to", "left"), ("seat", "c1", "t0")]
            )
        ),
        3,
    )
    assert [a.text for a in tidy(problem, plan).actions][1:] == [
        "go_to(agent,right)",
        "seat(agent,c1,small)",
    ]
    assert texts(problem)[-1] == "seat(agent,c1,small)"


@pytest.mark.parametrize("strategy", mostly_wide(STRATEGIES, "binary"))
def test_what_lies_on_the_way_is_done_on_the_way(strategy: str) -> None:
    state = """
state:
  seated: {near: [ada]}
  wants_bill: [near]
  ready: {near: plate}
  waiting: [[bo]]
"""
    done = texts(posed(WAY, state), strategy=strategy)
    assert len(done) == 9
    first = done[: done.index("pick(agent,bo)")]
    assert {"bring(agent,plate,near)", "give_bill(agent,near)"} <= set(first)


def test_two_things_to_carry_are_carried_one_after_the_other_as_soon_as_can_be() -> None:
    """Moving one deed alone is not possible here: hands hold one object."""
    state = "state: {seated: {near: [ada], far: [bo]}, ready: {near: plate, far: plate}}"
    problem = posed(
        WAY, state, goals=["served: {near: plate}", "served: {far: plate}", "at: hatch"]
    )
    result = search(problem)
    assert result.plan is not None and not faults(problem, result.plan)


def test_an_order_of_goals_comes_first() -> None:
    state = """
state: {seated: {near: [ada], far: [bo]}, wants_bill: [near, far]}
before: [[{paid: far}, {paid: near}]]
"""
    done = texts(posed(WAY, state))
    assert done.index("give_bill(agent,far)") < done.index("give_bill(agent,near)")


# -- by chance --------------------------------------------------------------------------------


@pytest.mark.wide
@pytest.mark.parametrize("first", mostly_slow(range(0, 400, BLOCK), 0))
@pytest.mark.parametrize("full", [True, False], ids=["full", "simple"])
def test_small_worlds(first: int, full: bool) -> None:
    """Also with orders of goals, timetables, chairs, and preferences of their own."""
    for seed in range(first, first + BLOCK):
        problem = small_problem(seed, full=full)
        plan = search(problem, use_bounds=seed % 2 == 0).plan
        if plan is not None:
            assert plan.horizon == shortest(problem).length
            assert not faults(problem, plan), (seed, [action.text for action in plan.actions])


@pytest.mark.parametrize("seed", mostly_slow(range(30), *range(3)))
@pytest.mark.parametrize(("size", "bar"), [("S", False), ("S", True), ("M", False)])
def test_generated_restaurants(size: str, bar: bool, seed: int) -> None:
    problem = generated(size, seed, bar=bar)
    result = search(problem)
    assert result.plan is not None and result.minimal
    assert not faults(problem, result.plan)


@pytest.mark.parametrize("seed", mostly_slow(range(12), 0, 1))
def test_plans_of_the_bounds_with_orders_and_refills(seed: int) -> None:
    """They are given where time is short, so they are put in order, too."""
    problem = generated("M", seed, bar=True)
    plan = find_bounds(problem).plan
    assert plan is not None
    better = tidy(problem, plan)
    assert run(problem, better).valid and better.horizon == plan.horizon
    assert not faults(problem, better)
    assert tidy(problem, better) == better, "there is nothing left to do"


@pytest.mark.wide
def test_the_checker_sees_what_is_not_in_order() -> None:
    """What the bounds put together is seldom in order, so the tests above can fail."""
    problems = [generated("M", seed, bar=True) for seed in range(4)]
    plans = [find_bounds(problem).plan for problem in problems]
    assert all(plan is not None and faults(p, plan) for p, plan in zip(problems, plans))


@pytest.mark.parametrize("seed", mostly_slow(range(80), *range(12)))
def test_earliest_is_the_least_waiting_there_can_be(seed: int) -> None:
    problem = replace(small_problem(seed), prefer=("earliest",))
    try:
        least = least_waiting(problem, 3000)
    except TooLarge:
        return
    plan = search(problem).plan
    if least is None:
        assert plan is None
        return
    assert plan is not None and plan.horizon == shortest(problem).length
    assert total_waiting(problem, plan) == least


# -- what a search does with it ---------------------------------------------------------------


def test_a_plan_that_the_program_refuses_is_left_as_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = posed(STAR, enter=(2, 2, 4, 1))
    asked: list[Plan] = []

    def refuses(self: Prober, plan: Plan) -> bool:
        asked.append(plan)
        return False

    monkeypatch.setattr(Prober, "accepts", refuses)
    for strategy in ("gallop", "minimize"):
        result = search(problem, strategy)
        assert result.plan is not None and result.minimal and run(problem, result.plan).valid
        assert result.plan not in asked
    assert asked


@pytest.mark.parametrize("domain", ["restaurant", "report"])
def test_the_program_is_asked_about_what_comes_out(domain: str) -> None:
    problem = posed(STAR, enter=(2, 2, 4))
    result = search(problem, "gallop", domain=domain)
    assert result.plan is not None
    told = [stage.outcome for stage in result.stages if stage.name == "tidy"]
    assert told in ([], ["deeds and parties put in order: accepted"])
    prober = Prober(problem, NativeTranslator(), find_domain(domain), SearchOptions())
    assert prober.accepts(result.plan)
    wrong = replace(result.plan, actions=result.plan.actions[1:])
    assert not prober.accepts(wrong)


def test_a_change_that_was_not_as_sure_as_it_seemed_is_undone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Then each one is executed before it is taken."""
    problem = generated("M", 3, bar=True)
    plan = find_bounds(problem).plan
    assert plan is not None
    right = tidy(problem, plan)
    monkeypatch.setattr(tidying, "clash", lambda *_, **__: False)
    found = tidy(problem, plan)
    assert run(problem, found).valid and found.horizon == right.horizon


# -- what choosing may cost -------------------------------------------------------------------


def test_of_a_choice_that_was_proved_nothing_is_said() -> None:
    problem = scenario("b1")
    answer = find_plan(problem, NativeTranslator(), find_domain("restaurant"), SearchOptions())
    assert answer.result.ties == "proved" and "ties" not in answer.document()["search"]
    assert answer.ties_line() == ""


@pytest.mark.parametrize("asked", [True, False])
def test_a_choice_whose_budget_ended_says_so(asked: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search_module, "TIE_BUDGETS", {True: (0.0, 0.0), False: (0.0, 0.0)})
    problem = replace(scenario("b1"), prefer=("smallest_table",) if asked else ())
    options = SearchOptions()
    answer = find_plan(problem, NativeTranslator(), find_domain("restaurant"), options)
    assert answer.result.status is SearchStatus.PLAN and answer.result.minimal
    assert answer.document()["search"]["ties"] == "budget"
    assert ("preferences" if asked else "smaller tables") in answer.ties_line()


def test_a_choice_that_the_time_limit_ended_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> bool:
        raise LimitReached("time")

    monkeypatch.setattr(Prober, "improve", fails)
    result = search(scenario("b1"))
    assert (result.ties, length(result)) == ("limit", 7)


def test_nothing_is_said_of_ties_where_there_were_none() -> None:
    assert search(scenario("b4")).ties is None


def test_in_a_large_restaurant_nothing_is_optimized_unasked() -> None:
    """It took longer there than the plan itself; putting it in order takes next to nothing."""
    nodes = [f"n{k}" for k in range(140)]
    edges = ", ".join(f"[{a}, {b}]" for a, b in zip(nodes, nodes[1:]))
    problem = posed(
        f"""
name: long
nodes: [{", ".join(nodes)}]
edges: [{edges}]
entrance: n0
agent: n0
tables: {{big: {{capacity: 4, nodes: [n3]}}, small: {{capacity: 2, nodes: [n3]}}}}
""",
        enter=(2,),
    )
    result = search(problem)
    assert result.ties is None and result.plan is not None
    assert result.plan.actions[-1].text == "seat(agent,c1,small)"
