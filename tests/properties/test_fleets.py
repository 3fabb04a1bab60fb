"""Several robots in small restaurants: planner, validator and program against every joint state.

The oracle (`tests/support/joint_exhaustive.py`) has the rules written down anew.  ``-m slow`` takes
two thousand restaurants more.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable
from random import Random

import pytest

from tests.support.exhaustive import TooLarge
from tests.support.joint_exhaustive import Fleet, fewest_actions, shortest_together
from tests.support.sampling import mostly_slow, widened
from tests.support.small_worlds import burdened_problem, fleet_problem
from waiter_cli import find_translator
from waiter_cli.encoding.domains import find_domain
from waiter_cli.explanation.explain import explain_foil
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.barriers import find_barriers
from waiter_cli.fleets.construct import construct
from waiter_cli.fleets.fleet_bounds import find_fleet_bounds
from waiter_cli.fleets.joint import closing_lengths
from waiter_cli.fleets.joint.closing_lengths import close_lengths
from waiter_cli.fleets.joint_search import exhaust
from waiter_cli.fleets.joint_walks import only_walks, walk_together
from waiter_cli.fleets.makespan import least_steps
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchOptions, SearchResult, SearchStatus
from waiter_cli.planning.strategies import find_minimal_plan
from waiter_cli.problems.pose import pose_problem
from waiter_cli.rules.actions import Illegal, holds
from waiter_cli.rules.joint_steps import apply_together, begin_together
from waiter_cli.rules.validator import run

DEFAULT = range(12)
SLOW = (0, 50, *range(1000, 3000, 50))
FEW = 12_000


def search(seed: int, **options: object) -> SearchResult:
    return find_minimal_plan(
        fleet_problem(seed),
        find_translator(),
        find_domain("restaurant"),
        SearchOptions(**options),  # type: ignore[arg-type]
    )


def check(seed: int) -> str:
    """Holds plan, proof and actions of one restaurant to the oracle; what became of it."""
    problem = fleet_problem(seed)
    try:
        expected = shortest_together(problem, FEW).length
    except TooLarge:
        return "large"
    result = search(seed)
    if expected is None:
        assert (result.status, bool(result.reasons)) == (SearchStatus.NO_PLAN, True), seed
        return "none"
    assert result.status is SearchStatus.PLAN and result.plan is not None, seed
    assert (result.plan.horizon, result.minimal, result.bounds) == (
        expected, True, (expected, expected),
    ), seed  # fmt: skip
    verdict = run(problem, result.plan)
    assert verdict.valid and verdict.makespan == expected, (seed, verdict.reasons)
    if not problem.before and not problem.prefer and result.ties in (None, "proved"):
        try:
            least = fewest_actions(problem, expected, FEW)
        except TooLarge:
            return "plan"
        assert len(result.plan.actions) == least, seed
        return "fewest"
    return "plan"


def test_small_fleets() -> None:
    found = Counter(check(seed) for seed in DEFAULT)
    assert found["none"] >= len(DEFAULT) / 5 and found["fewest"] >= len(DEFAULT) / 4, found


@pytest.mark.slow
@pytest.mark.parametrize("first", SLOW)
def test_small_fleets_by_the_thousand(first: int) -> None:
    for seed in range(first, first + 50):
        check(seed)


def closed(seeds: Iterable[int], make: Callable[[int], Problem]) -> Counter[str]:
    """Holds lengths that were closed in to the oracle; how often they met, and how often they did more."""
    found: Counter[str] = Counter()
    for seed in seeds:
        problem = make(seed)
        try:
            expected = shortest_together(problem, 4000).length
        except TooLarge:
            continue
        lengths = close_lengths(problem, 0, None)
        if expected is None:
            assert lengths.plan is None, seed
            continue
        assert lengths.lower <= expected, (seed, lengths.lower, expected)
        found["tighter"] += lengths.lower > least_steps(problem)
        if lengths.plan is not None:
            assert lengths.plan.horizon >= expected, seed
            verdict = run(problem, lengths.plan)
            assert verdict.valid and verdict.makespan == lengths.plan.horizon, seed
            found["met"] += lengths.lower == expected == lengths.plan.horizon
    return found


@pytest.mark.wide
def test_lengths_are_closed_in_on_the_least_one() -> None:
    found = closed(range(40), fleet_problem) + closed(range(40), burdened_problem)
    assert found["met"] >= 12 and found["tighter"] >= 4, found


@pytest.fixture
def from_below(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beam search finds next to nothing, so lengths are refuted one after the other up to the plan's."""
    monkeypatch.setattr(closing_lengths, "ROUNDS", ((1, 1_000_000),))
    monkeypatch.setattr(closing_lengths, "WORK", 1_000_000)


def test_lengths_are_refuted_up_to_the_least_one(from_below: None) -> None:
    assert closed(range(40), fleet_problem)["met"] >= 10


@pytest.mark.slow
@pytest.mark.parametrize("first", range(1000, 3000, 50))
def test_lengths_are_refuted_by_the_thousand(first: int, from_below: None) -> None:
    seeds = range(first, first + 50)
    assert closed(seeds, fleet_problem)["met"] and closed(seeds, burdened_problem)["met"]


@pytest.mark.slow
@pytest.mark.parametrize("first", range(1000, 3000, 50))
def test_lengths_are_closed_in_on_by_the_thousand(first: int) -> None:
    seeds = range(first, first + 50)
    assert closed(seeds, fleet_problem)["met"] and closed(seeds, burdened_problem)["met"]


def test_what_robots_hold_proves_nothing_false() -> None:
    """Several lead a party or carry something, wanted or not: reasons and bounds are right."""
    assert held_to_the_oracle(range(60)) >= 4


@pytest.mark.slow
@pytest.mark.parametrize("first", [0, *range(1000, 4000, 100)])
def test_what_robots_hold_proves_nothing_false_by_the_thousand(first: int) -> None:
    held_to_the_oracle(range(first, first + 100))


def held_to_the_oracle(seeds: range) -> int:
    """How often it was seen that there is no plan."""
    seen = 0
    for seed in seeds:
        problem = burdened_problem(seed)
        try:
            expected = shortest_together(problem, 4000).length
        except TooLarge:
            continue
        reasons = find_barriers(problem)
        assert expected is None or not reasons, (seed, expected, reasons)
        assert expected is None or least_steps(problem) <= expected, seed
        seen += bool(reasons)
    return seen


def test_one_who_leads_what_nobody_asks_for_makes_no_plan_longer() -> None:
    """It could only be got rid of far away; another robot is asked for, and near."""
    nodes = [f"n{k}" for k in range(20)]
    layout = read_layout(
        f"name: long\nnodes: [{', '.join(nodes)}]\nentrance: n0\n"
        f"edges: [{', '.join(f'[{a}, {b}]' for a, b in zip(nodes, nodes[1:]))}]\n"
        "agents: {r1: n2, r2: n1}\n"
        "tables: {t1: {capacity: 2, nodes: [n1]}, t9: {capacity: 6, nodes: [n19]}}\n",
        "long.yaml",
    )
    scenario = read_scenario(
        "state: {with_agent: {r1: [c1, c2, c3, c4, c5]}, waiting: [[c9]]}\ngoals: [{seated: c9}]\n",
        "long-s.yaml",
        layout,
    )
    assert least_steps(pose_problem(layout, scenario)) == 4


def test_more_parties_than_tables_are_seen_whoever_leads_them() -> None:
    layout = read_layout(
        "name: two\nnodes: [a, b, c, d]\nedges: [[a, b], [b, c], [c, d], [d, a]]\nentrance: a\n"
        "agents: {r1: b, r2: c}\n"
        "tables: {t1: {capacity: 2, nodes: [c]}, t2: {capacity: 2, nodes: [d]}}\n",
        "two.yaml",
    )
    text = "state: {with_agent: {r1: [c1], r2: [c2]}, waiting: [[c3]]}\n"
    (reason,) = find_barriers(pose_problem(layout, read_scenario(text, "s.yaml", layout)))
    assert "need 3 tables, and there are only t1 and t2" in reason.message


@pytest.mark.wide
@pytest.mark.parametrize("first", mostly_slow([0, 20, 40], 20))
def test_the_program_alone_finds_the_same_lengths(first: int) -> None:
    """Without bounds it is the program that proves, horizon after horizon."""
    for seed in range(first, first + 20, 4):
        try:
            expected = shortest_together(fleet_problem(seed), FEW).length
        except TooLarge:
            continue
        result = search(seed, use_bounds=False, max_steps=9, strategy="linear")
        if expected is not None and expected <= 9:
            assert result.plan is not None and result.plan.horizon == expected, seed
            assert result.proof == ("unsat" if expected else "bound"), seed
        else:
            assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "max_steps"), seed


def some_action(problem: Problem, rng: Random) -> Action:
    """An action of the right form, possible or not."""
    layout = problem.layout
    tables = [table.name for table in layout.tables]
    words = {
        "go_to": ([node.name for node in layout.nodes],),
        "pick": ([party[0] for party in problem.state.parties()],),
        "seat": ([party[0] for party in problem.state.parties()], tables),
        "give_bill": (tables,), "take_order": (tables,), "send_order": (tables,),
        "take_up": (["plate", "jug"], tables), "bring": (["plate", "jug"], tables),
        "refill": (["jug"], tables), "bring_chairs": (tables, ["2", "3", "4"]),
    }  # fmt: skip
    while True:
        name = rng.choice(["go_to", *words])
        if all(words[name]):
            robot, _ = rng.choice(layout.agents)
            return Action(0, name, (robot, *(rng.choice(each) for each in words[name])))


def check_price(seed: int) -> str:
    """Holds the price of an action by chance, or that no plan has it, to the oracle."""
    problem = fleet_problem(seed)
    foil = some_action(problem, Random(f"foil {seed}"))
    try:
        best = shortest_together(problem, FEW).length
        forced = shortest_together(problem, FEW, foil.text).length
    except TooLarge:
        return "large"
    found = explain_foil(
        problem, foil, find_translator(), find_domain("restaurant"), SearchOptions(max_steps=30)
    )
    if best is None:
        assert found.best.plan is None, seed
        return "no plan"
    if forced is None:
        assert found.forced.plan is None and found.limit in (None, "max_steps"), (seed, foil)
        return "never" if found.conflict else "open"
    assert found.price == forced - best, (seed, foil.text, found.price, forced, best)
    assert foil.text in [action.text for action in found.forced.plan.actions]  # type: ignore[union-attr]
    assert run(problem, found.forced.plan).valid, seed  # type: ignore[arg-type]
    return "price"


@pytest.mark.wide
@pytest.mark.parametrize("seeds", widened(range(40, 52), range(40, 65)))
def test_what_an_action_costs(seeds: range) -> None:
    found = Counter(check_price(seed) for seed in seeds)
    assert found["price"] >= len(seeds) // 8 and found["never"] >= len(seeds) // 5, found
    assert not found["open"], found


@pytest.mark.slow
@pytest.mark.parametrize("first", [40, *range(100, 1100, 50)])
def test_what_an_action_costs_by_the_thousand(first: int) -> None:
    assert not [seed for seed in range(first, first + 50) if check_price(seed) == "open"]


def exhaust_all(seeds: range) -> None:
    for seed in seeds:
        problem = fleet_problem(seed)
        try:
            expected = shortest_together(problem, 4000)
        except TooLarge:
            continue
        found = exhaust(problem, 10**6)
        assert found is not None
        assert (found.plan and found.plan.horizon) == expected.length, seed
        if found.plan is not None:
            verdict = run(problem, found.plan)
            assert verdict.valid and verdict.makespan == expected.length, (seed, verdict.reasons)
        else:
            assert found.states == expected.states, seed


def test_all_joint_states_are_searched_to_the_same_end() -> None:
    exhaust_all(range(100, 130))


@pytest.mark.slow
def test_all_joint_states_are_searched_to_the_same_end_in_twice_as_many() -> None:
    exhaust_all(range(100, 220))


def test_the_rules_know_the_same_joint_steps_from_every_state_met_by_chance() -> None:
    met = 0
    for seed in range(300, 360):
        problem, rng = fleet_problem(seed), Random(seed)
        fleet = Fleet(problem)
        try:
            state = begin_together(problem)
        except Illegal:
            assert fleet.arrive(fleet.encode(problem.state, 0)) is None
            continue
        for step in range(8):
            code = fleet.encode(state, step)
            known = dict(fleet.successors(code))
            tried = set(known)
            for _ in range(12):  # and some that are not possible
                deeds = [
                    rng.choice(list(fleet.deeds(code, k))).text for k in range(len(fleet.robots))
                ]
                tried.add(tuple(text for text in deeds if text))
            afterwards = {}
            for texts in sorted(tried):
                actions = [_action(text, step) for text in texts]
                try:
                    afterwards[texts] = apply_together(problem, state, actions, step)
                except Illegal:
                    assert texts not in known, (seed, step, texts)
                    continue
                assert known.get(texts) == fleet.encode(afterwards[texts], step + 1), (
                    seed,
                    step,
                    texts,
                )
            for goal in problem.goals:
                assert holds(goal, state, problem) == fleet.test(goal)(code), (seed, step, goal)
            met += 1
            if not afterwards:
                break
            deeds_ = [texts for texts in afterwards if any("go_to" not in text for text in texts)]
            state = afterwards[rng.choice(deeds_ or list(afterwards))]
    assert met > 250


def _action(text: str, step: int) -> Action:
    name, _, rest = text.partition("(")
    return Action(step, name, tuple(rest.rstrip(")").split(",")))


def judge_bounds(seeds: range) -> tuple[int, int]:
    """How often it is told that there is no plan, and how often the lower bound is the least."""
    told = tight = 0
    for seed in seeds:
        problem = fleet_problem(seed)
        try:
            expected = shortest_together(problem, 6000).length
        except TooLarge:
            continue
        reasons, least = find_barriers(problem), least_steps(problem)
        if expected is None:
            told += bool(reasons)
            continue
        assert not reasons, (seed, reasons)
        assert least <= expected, seed
        tight += least == expected
        made = construct(problem, least)
        if made is not None and made.plan is not None:
            verdict = run(problem, made.plan)
            assert verdict.valid and verdict.makespan == made.plan.horizon >= expected, seed
    return told, tight


def test_bounds_and_reasons_are_never_wrong() -> None:
    """No lower bound is above the least number of steps, and nothing possible is called impossible."""
    told, tight = judge_bounds(range(400, 440))
    assert told >= 5 and tight >= 6, (told, tight)


@pytest.mark.slow
def test_bounds_and_reasons_are_never_wrong_in_twice_as_many() -> None:
    told, tight = judge_bounds(range(400, 480))
    assert told >= 10 and tight >= 12, (told, tight)


PATH = """\
nodes: [a, b, c, d, e]
edges: [[a, b], [b, c], [c, d], [d, e]]
entrance: a
tables: {}
"""


@pytest.mark.parametrize(
    ("more", "goals", "told"),
    [
        ("agents: {r1: a, r2: b}", ["at: {r1: d, r2: c}"],
         "r1 and r2 cannot pass each other between a and e: the path has no siding"),
        ("agents: {r1: a, r2: b}", ["at: {r1: c, r2: c}"], "r1 and r2 are both wanted at c"),
        ("agents: {r1: a, r2: b}\nwaiters: {w1: d}", ["at: {r2: e}"],
         "e can be reached only through d, where w1 stands"),
        ("agents: {r1: a, r2: b}", ["at: a", "at: b", "at: c"],
         "robots are wanted at 3 nodes, and there are 2"),
        ("agents: {r1: a, r2: b}\nwaiters: {w1: c}", ["at: {r1: b, r2: a}"],
         "as many robots as nodes (2) where r1 stands: none of them can move"),
    ],
    ids=["order", "both", "behind", "too many", "packed"],
)  # fmt: skip
def test_what_robots_can_never_do_has_its_reason(more: str, goals: list[str], told: str) -> None:
    problem = pose_problem(read_layout(f"{PATH}{more}\n", "path.yaml"), goals=goals)
    reasons = find_barriers(problem)
    assert told in [reason.message for reason in reasons], reasons
    assert shortest_together(problem).length is None


ACROSS = """\
nodes: [a, b, c, d, e]
edges: [[a, b], [b, c], [c, d], [d, e]]
entrance: a
tables: {table1: {capacity: 2, nodes: [e]}}
bar: [b, d]
"""


@pytest.mark.parametrize("colleague", ["", "waiters: {w: c}\n"], ids=["open", "barred"])
def test_one_robot_sends_the_order_and_another_brings_the_plate(colleague: str) -> None:
    layout = read_layout(f"{ACROSS}{colleague}agents: {{r1: a, r2: d}}\n", "across.yaml")
    state = "state: {seated: {table1: [c1]}, ordered: {table1: r1}}\n"
    scenario = read_scenario(f"{state}instant_kitchen: true\n", "evening.yaml", layout)
    problem = pose_problem(layout, scenario, goals=["served: table1"])
    assert shortest_together(problem).length == 5
    assert least_steps(problem) == 5
    result = find_minimal_plan(problem, find_translator(), find_domain("restaurant"))
    assert result.plan is not None and (result.plan.horizon, result.minimal) == (5, True)


@pytest.mark.parametrize("where", ["ready: {table1: plate}", "carrying: {r2: {table1: plate}}"])
def test_a_plate_that_is_there_needs_no_order(where: str) -> None:
    layout = read_layout(f"{ACROSS}agents: {{r1: a, r2: d}}\n", "across.yaml")
    state = f"state: {{seated: {{table1: [c1]}}, ready_to_order: [table1], {where}}}\n"
    scenario = read_scenario(f"{state}instant_kitchen: true\n", "evening.yaml", layout)
    problem = pose_problem(layout, scenario, goals=["served: table1"])
    expected = shortest_together(problem).length
    assert expected == (3 if "ready" in where.partition(":")[0] else 2)
    assert least_steps(problem) <= expected
    result = find_minimal_plan(problem, find_translator(), find_domain("restaurant"))
    assert result.plan is not None and (result.plan.horizon, result.minimal) == (expected, True)


def _walking(seed: int) -> Problem:
    """Robots on a few nodes, some paths one way, each wanted somewhere."""
    rng = Random(f"walks {seed}")
    nodes = [f"n{k}" for k in range(rng.choice((4, 5, 6)))]
    pairs = [(rng.choice(nodes[:k]), nodes[k]) for k in range(1, len(nodes))]
    pairs += [tuple(rng.sample(nodes, 2)) for _ in range(rng.choice((0, 1, 1, 2)))]  # type: ignore[misc]
    pairs = list({frozenset(pair): pair for pair in pairs}.values())
    edges = [f"{{from: {a}, to: {b}}}" if rng.random() < 0.15 else f"[{a}, {b}]" for a, b in pairs]
    robots = [f"r{k}" for k in range(rng.choice((2, 2, 3)))]
    agents = ", ".join(f"{name}: {n}" for name, n in zip(robots, rng.sample(nodes, len(robots))))
    some = robots[: len(robots) - (rng.random() < 0.3)]
    ends = ", ".join(f"{name}: {n}" for name, n in zip(some, rng.sample(nodes, len(some))))
    text = f"nodes: [{', '.join(nodes)}]\nedges: [{', '.join(edges)}]\nentrance: n0\ntables: {{}}\n"
    layout = read_layout(f"{text}agents: {{{agents}}}\n", "walks.yaml")
    return pose_problem(layout, goals=[f"at: {{{ends}}}"])


@pytest.mark.parametrize("seeds", widened(range(24), range(60)))
def test_joint_walks_are_shortest_ones(seeds: range) -> None:
    """From no bound at all, and from one that another method leaves."""
    lengths: Counter[int | None] = Counter()
    for seed in seeds:
        problem = _walking(seed)
        assert only_walks(problem)
        expected = shortest_together(problem).length
        lengths[expected] += 1
        if expected is None:
            assert walk_together(problem, 0, 6).lower == 6, seed
            continue
        for lower in {0, max(0, expected - 1)}:
            found = walk_together(problem, lower)
            assert (found.lower, found.plan and found.plan.horizon) == (expected, expected), seed
        assert walk_together(problem, 0, expected).lower == expected, seed
        result = find_minimal_plan(problem, find_translator(), find_domain("restaurant"))
        assert result.plan is not None and result.bounds == (expected, expected), seed
    assert lengths[None] >= 3 and len(lengths) >= 6, lengths


def test_eight_robots_change_places_on_a_tree() -> None:
    """Their bounds do not meet without joint walks, and the program alone takes long."""
    nodes = [f"n{k}" for k in range(21)]
    edges = ", ".join(f"[n{(k - 1) // 2}, n{k}]" for k in range(1, 21))
    agents = ", ".join(f"r{k}: n{k + 10}" for k in range(8))
    goal = ", ".join(f"r{k}: n{(k ^ 1) + 10}" for k in range(8))
    text = f"nodes: [{', '.join(nodes)}]\nedges: [{edges}]\nentrance: n0\ntables: {{}}\n"
    problem = pose_problem(
        read_layout(f"{text}agents: {{{agents}}}\n", "tree.yaml"), goals=[f"at: {{{goal}}}"]
    )
    bounds = find_fleet_bounds(problem)
    assert bounds.plan is not None and bounds.lower == bounds.plan.horizon > least_steps(problem)
    assert run(problem, bounds.plan).valid


def test_bounds_leave_a_fifth_of_the_time_to_the_program(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plan that they found would otherwise be lost when the time is up."""
    given: list[float] = []
    monkeypatch.setattr(
        "waiter_cli.fleets.fleet_bounds.find_barriers",
        lambda problem: given.append(time.monotonic()) or (),
    )
    monkeypatch.setattr(
        "waiter_cli.fleets.fleet_bounds.least_steps",
        lambda problem, deadline: given.append(deadline) or 0,
    )
    assert search(0, time_limit=60.0).status is SearchStatus.PLAN
    assert 43 < given[1] - given[0] <= 48
