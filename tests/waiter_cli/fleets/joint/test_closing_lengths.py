"""`closing_lengths`, `joint_layers`, `joint_states` and `robot_moves`: lengths refuted and plans found, layer by layer."""

from __future__ import annotations

import time

import pytest

from tests.support.fleet_floors import aisle, square
from tests.support.joint_exhaustive import shortest_together
from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.jobs import find_jobs
from waiter_cli.fleets.joint.closing_lengths import close_lengths
from waiter_cli.fleets.joint.joint_layers import JointLayers
from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.tour_table import TourTable
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

BILLS = (
    "state: {seated: {t2: [c1], t5: [c2]}, wants_bill: [t2, t5]}\ngoals: [{paid: t2}, {paid: t5}"
)
CASES = {
    "two parties": square(
        "r1: a, r2: c", "state: {waiting: [[c1], [c2, c3]]}\ngoals: [{seated: c1}, {seated: c2}]\n"
    ),
    "orders and a jug": square(
        "r1: a, r2: b",
        "state: {seated: {tb: [c1], td: [c2]}, ready_to_order: [tb, td], empty: {td: jug}}\n"
        "goals: [{sent: tb}, {sent: td}, {filled: {td: jug}}]\n",
    ),
    "in each other's way": aisle("r1: n3, r2: n4", BILLS + ", at: {r1: n1}, at: {r2: n6}]\n"),
    "all in hand": square(
        "r1: c, r2: a",
        "state: {with_agent: {r1: [c1]}, carrying: {r2: {td: jug}}, empty: {td: jug},"
        " seated: {td: [c2]}}\ngoals: [{seated: {party: c1, table: tb}}, {filled: {td: jug}}, {at: a}]\n",
    ),
    "a colleague who moves": square(
        "r1: a, r2: c",
        "state: {seated: {tb: [c1], td: [c2]}, wants_bill: [tb, td]}\n"
        "goals: [{paid: tb}, {paid: td}, {at: {r1: c, r2: a}}]\n",
    ),
    "a plate by somebody else": square(
        "r1: d, r2: b",
        "instant_kitchen: true\nstate: {seated: {td: [c2]}, ready_to_order: [td]}\n"
        "goals: [{served: td}]\n",
    ),
}


@pytest.mark.parametrize("problem", CASES.values(), ids=CASES)
def test_both_bounds_meet_at_the_least_length(problem: Problem) -> None:
    expected = shortest_together(problem).length
    lengths = close_lengths(problem, 0, None)
    assert lengths.plan is not None
    assert (lengths.lower, lengths.plan.horizon) == (expected, expected)
    assert run(problem, lengths.plan).valid


def layers(problem: Problem) -> JointLayers:
    jobs = find_jobs(problem)
    assert jobs is not None
    deals = Deals(problem, TourTable(problem, jobs), jobs.ends)
    return JointLayers(JointStates(problem, deals, jobs.anywhere))


def test_a_length_is_refuted_only_where_all_states_were_looked_at() -> None:
    problem = square(
        "r1: a, r2: b",
        "state: {seated: {tb: [c1]}, wants_bill: [tb]}\ngoals: [{paid: tb}, {at: {r1: b, r2: a}}]\n",
    )
    least = shortest_together(problem).length
    assert least is not None
    searched = layers(problem)
    whole = searched.search(least - 1, 10_000)
    assert (whole.plan, whole.refuted) == (None, True)
    many = layers(CASES["orders and a jug"])
    length = shortest_together(CASES["orders and a jug"]).length
    assert length is not None and many.search(length, 10_000).plan is not None
    narrow = many.search(length, 1, beam=False)
    assert (narrow.plan, narrow.refuted) == (None, False)
    assert not many.search(length, 1, beam=True).refuted
    late = searched.search(least - 1, 10_000, time.monotonic() - 1)
    assert (late.plan, late.refuted) == (None, False)


def test_of_equally_long_plans_it_has_one_without_idle_walks() -> None:
    problem = square(
        "r1: a, r2: c", "state: {seated: {tb: [c1]}, wants_bill: [tb]}\ngoals: [{paid: tb}]\n"
    )
    found = layers(problem).search(2, 1000).plan
    assert found is not None and len(found.actions) == 2


@pytest.mark.parametrize(
    "state",
    ["chairs: {td: 1, tb: 1}, waiting: [[c1, c2]]", "with_agent: {r1: [c9]}, waiting: [[c1, c2]]"],
    ids=["chairs", "led"],
)
def test_what_takes_more_than_the_jobs_is_only_bounded(state: str) -> None:
    problem = square("r1: b, r2: c", f"state: {{{state}}}\ngoals: [{{seated: c1}}]\n")
    lengths = close_lengths(problem, 0, None)
    expected = shortest_together(problem).length
    assert lengths.plan is None and expected is not None and 0 < lengths.lower <= expected
