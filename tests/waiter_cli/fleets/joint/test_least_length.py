"""`least_length`, `known_states` and `steps_left`: lengths refuted best first, no state twice."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from tests.support.fleet_floors import aisle, posed, square
from tests.support.joint_exhaustive import shortest_together
from tests.support.small_worlds import fleet_problem
from waiter_cli import pose_problem, read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.jobs import find_jobs
from waiter_cli.fleets.joint import joint_states, least_length
from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.joint.known_states import KnownStates
from waiter_cli.fleets.joint.least_length import LeastLength
from waiter_cli.fleets.joint.steps_left import StepsLeft
from waiter_cli.fleets.tour_table import TourTable
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

SEATING = """\
state:
  seated: {table1: [a1], table5: [b1, b2]}
  waiting: [[c1, c2], [d1], [e1, e2, e3], [f1, f2]]
  wants_bill: [table1, table5]
"""
THREE = "r1: a, r2: b, r3: c"
ORDERS = (
    "state: {seated: {tb: [c1], td: [c2]}, ready_to_order: [tb, td], waiting: [[c3]]}\n"
    "goals: [{sent: tb}, {sent: td}"
)
WIDE = """\
name: wide
nodes: [a, b, c, d, e]
edges: [[a, b], [b, c], [c, d], [d, a], [d, e], [e, b]]
entrance: a
bar: [b, c]
tables: {tb: {capacity: 2, nodes: [b]}, td: {capacity: 4, nodes: [d]}}
"""
CASES = {
    "alike": square("r1: a, r2: b", f"{ORDERS}]\n"),
    "three, one with a place": square(THREE, f"{ORDERS}, {{at: {{r2: d}}}}]\n"),
    "somebody somewhere": square(THREE, f"{ORDERS}, {{at: a}}, {{at: b}}]\n"),
    "in each other's way": aisle(
        "r1: n3, r2: n4",
        "state: {seated: {t2: [c1], t5: [c2]}, wants_bill: [t2, t5]}\n"
        "goals: [{paid: t2}, {paid: t5}, {at: {r1: n1, r2: n6}}]\n",
    ),
    "plates by somebody else": posed(
        WIDE,
        THREE,
        "instant_kitchen: true\nstate: {seated: {td: [c2]}, ready_to_order: [td]}\n"
        "goals: [{served: td}, {at: b}]\n",
    ),
}


def states_of(problem: Problem) -> JointStates:
    jobs = find_jobs(problem)
    assert jobs is not None
    return JointStates(problem, Deals(problem, TourTable(problem, jobs), jobs.ends), jobs.anywhere)


def asked(problem: Problem, most: int = 1_000_000) -> int:
    """The length of the plan that is found, checked; ``most`` states are looked at for one answer."""
    states = states_of(problem)
    search = LeastLength(states, states.deals.least())
    while search.next < 60:
        length = search.next
        outcome = search.ask(most)
        assert search.left.length >= length  # else what is left would be said to be too much
        if outcome.plan is not None:
            verdict = run(problem, outcome.plan)
            assert verdict.valid and verdict.makespan == length == outcome.plan.horizon
            return length
        assert outcome.refuted == (search.next == length + 1)
    raise AssertionError("no plan was found")


@pytest.mark.parametrize("dives", [0, 12_000], ids=["layer by layer", "farthest first"])
@pytest.mark.parametrize("problem", CASES.values(), ids=CASES)
def test_no_plan_is_shorter(problem: Problem, dives: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(least_length, "DIVED", dives)
    monkeypatch.setattr(least_length, "DIVE", 7)
    monkeypatch.setattr(least_length, "AHEAD", 1)
    assert asked(problem) == shortest_together(problem).length


def test_it_goes_on_where_it_ended() -> None:
    problem = CASES["three, one with a place"]
    assert asked(problem, most=5) == shortest_together(problem).length


def test_states_without_keys_are_told_apart_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint_states, "KEY_BITS", 10)
    problem = CASES["alike"]
    assert not states_of(problem).fits
    assert asked(problem) == shortest_together(problem).length


def test_what_is_left_falls_by_one_at_most_and_never_says_too_much() -> None:
    """On ways by chance; without that no state would be come to by a shortest way first."""
    looked = 0
    for seed in range(40):
        problem, rng = fleet_problem(seed), Random(seed)
        jobs = find_jobs(problem)
        if jobs is None or not jobs.jobs or problem.layout.timetable:
            continue
        states = states_of(problem)
        if states.deals.least() > 40:
            continue
        left, rows = StepsLeft(states, 60), states.start()
        for step in range(12):
            before = int(left.least(rows)[0])
            after, _ = states.following(rows, step, 10_000)
            assert (left.least(after) >= before - 1).all(), (seed, step)
            looked += len(after)
            at = rng.randrange(len(after))
            rows = after[at : at + 1]
    assert looked > 1_000


def another_first(states: JointStates, row: list[int], rng: Random) -> list[int]:
    """The same state with the first robot elsewhere, or with something else in hand."""
    busy, nodes, k = states.moves.busy, states.moves.nodes, states.count
    others = {state % nodes for state in row[1:k]}
    taken = row[k] | int(sum(busy[state // nodes] for state in row[1:k]))
    free = [
        state
        for state in range(len(states.cell))
        if state % nodes not in others and not int(busy[state // nodes]) & taken
    ]
    return [rng.choice(free), *row[1:]]


@pytest.mark.parametrize("name", ["three, one with a place", "plates by somebody else"])
def test_robots_that_move_one_by_one_come_to_what_they_come_to_together(name: str) -> None:
    """In the middle of a step equal states are merged, and none is lost or won by it."""
    merging, apart = states_of(CASES[name]), states_of(CASES[name])
    apart.fits = False
    rows, rng, merged = merging.start(), Random(name), 0
    pairs: list[list[list[int]]] = []
    for _ in range(8):
        after, source = merging.following(rows, 0, 10_000)
        for k in rng.sample(range(len(after)), min(len(after), 20)):
            merging.plan([rows[source[k]].tolist(), after[k].tolist()])  # by actions
        rows = after[rng.sample(range(len(after)), min(len(after), 300))]
        pairs += [[row, another_first(merging, row, rng)] for row in rows.tolist()]
    for pair in rng.sample(pairs, min(len(pairs), 600)):
        after, _ = merging.following(merging.np.array(pair), 0, 10_000)
        every, _ = apart.following(merging.np.array(pair), 0, 10_000)
        assert {*map(tuple, after[:, :-1].tolist())} == {*map(tuple, every[:, :-1].tolist())}
        merged += len(every) - len(after)
    assert merged > 100


def test_known_states_are_those_that_are_no_better() -> None:
    states = states_of(CASES["alike"])
    known = KnownStates(states)
    start = states.start()
    after, _ = states.following(start, 0, 10_000)
    assert known.fresh(start, 0).tolist() == [0]
    first = known.fresh(after, 1)
    assert (
        0 < len(first) < len(after)
    )  # to stand still is no news, and who of them is where neither
    assert not len(known.fresh(after, 2))
    open_jobs = after[first[:1]].copy()
    open_jobs[:, states.count] |= 1  # as one of them, with a job undone
    done = after[first[:1]].copy()
    done[:, states.count] &= ~1
    other = KnownStates(states)
    assert len(other.fresh(done, 5)) == 1 and len(other.fresh(open_jobs, 1)) == 1
    both = states.np.concatenate([open_jobs, done])
    assert KnownStates(states).fresh(both, 1).tolist() == [1]


def test_what_is_known_of_a_later_step_takes_nothing_from_an_earlier_one() -> None:
    """Four parties and two bills in the report's hall: 14 steps, of which 14 were once refuted."""
    layout = replace(read_layout("report_large"), agents=(("r1", "n1"), ("r2", "n7")))
    scenario = read_scenario(SEATING, "evening.yaml", layout)
    assert asked(pose_problem(layout, scenario)) == 14
