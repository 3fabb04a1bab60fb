"""Plans without search: tours built by insertion, their cost, and that improving never adds to it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.hall import posed
from tests.support.small_worlds import small_problem
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.insertion import Builder, Clock, nodes_of
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.route_to_tour import Unfolder
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.bounds.service_chains import Link
from waiter_cli.bounds.tour_to_plan import write_plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

PARTY = ("c1", "c2")


def builder_of(problem: Problem, work: int = 100_000) -> Builder:
    floor = WalkDistances(problem, standing(problem).fixed.values())
    return Builder(Seating(problem, find_needs(problem), floor), Clock(work, None))


def test_a_link_is_done_at_its_table_at_the_bar_or_at_its_node() -> None:
    floor = WalkDistances(posed(State("a")), ())
    number = floor.number
    assert nodes_of(floor, Link("give_bill", "big")) == (number["c"], number["a"])
    assert nodes_of(floor, Link("take_up", "big", "plate")) == (number["b"],)
    assert nodes_of(floor, Link("visit", node="e")) == (number["e"],)


def test_a_party_is_led_from_the_entrance_to_its_table() -> None:
    problem = posed(State("a", waiting=(PARTY,)), Goal("seated", party=PARTY))
    builder = builder_of(problem)
    tour = builder.build({0: "small"})
    assert tour is not None
    names = [(stop.link.name, builder.floor.names[stop.node]) for stop in tour.stops]
    assert names == [("pick", "e"), ("seat", "d")]
    assert tour.walk() == 4 and builder.cost(tour) == 6


def test_chairs_that_a_party_lacks_are_a_deed_more() -> None:
    state = State("a", waiting=(PARTY,), chairs=(("big", 4), ("small", 1)))
    builder = builder_of(posed(state, Goal("seated", party=PARTY)))
    tour = builder.build({0: "small"})
    assert tour is not None and builder.cost(tour) == 7


def test_an_order_of_goals_is_kept() -> None:
    state = State(
        "a", seated=(("big", ("c1",)), ("small", ("c2",))), wants_bill=frozenset({"big", "small"})
    )
    big, small = Goal("paid", table="big"), Goal("paid", table="small")
    problem = replace(posed(state, big, small), before=((small, big),))
    tour = builder_of(problem).build({})
    assert tour is not None
    assert [stop.link.table for stop in tour.stops] == ["small", "big"]


def test_a_clock_is_over_after_so_much_work_or_at_its_deadline() -> None:
    clock = Clock(2, None)
    clock.spend(1)
    assert not clock.over()
    clock.spend(1)
    assert clock.over()
    assert Clock(1000, 0.0).over()


@pytest.mark.parametrize("first", [0, 30])
def test_improving_keeps_a_tour_legal_and_never_makes_it_dearer(first: int) -> None:
    better = 0
    for seed in range(first, first + 30):
        problem = small_problem(seed)
        builder = builder_of(problem)
        if builder.needs.hopeless:
            continue
        tour = Unfolder(builder).plain(TableChoice())
        if tour is None:
            continue
        before = builder.cost(tour)
        builder.improve(tour, 0)
        builder.shake(tour, 0, tries=40)
        assert builder.cost(tour) <= before, seed
        better += builder.cost(tour) < before
        plan = write_plan(problem, builder.floor, standing(problem), tour.stops, builder.end)
        assert plan is None or plan.horizon <= builder.cost(tour) or problem.layout.timetable, seed
    assert better
