"""Least routes of the relaxation: what they cost, what happens on them, and the tolls for loops."""

from __future__ import annotations

from tests.support.hall import posed
from waiter_cli.bounds.chain_automaton import build_machine
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.relaxed_route import Route, Tolls, find_route
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.route_to_tour import Unfolder
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

PAIR, ONE = ("c1", "c2"), ("c3",)


def parts(problem: Problem) -> tuple[Seating, Builder]:
    seating = Seating(problem, find_needs(problem), WalkDistances(problem, ()))
    return seating, Builder(seating, Clock(10_000, None))


def route_of(problem: Problem, trips: int, limit: int = 10_000) -> Route | None:
    seating, builder = parts(problem)
    solved = seating.solve(TableChoice())
    assert solved is not None
    machine = build_machine(builder, 1000)
    return find_route(seating, solved, machine, builder.end, trips, limit=limit)


def test_a_walk_without_parties_is_the_shortest_one() -> None:
    found = route_of(posed(State("a"), Goal("at", node="e")), 0)
    assert found is not None and (found.cost, found.loops, found.seats) == (3, 0, ())


def test_what_lies_on_the_way_costs_no_step_more() -> None:
    state = State("a", seated=(("small", ONE),), wants_bill=frozenset({"small"}))
    found = route_of(posed(state, Goal("at", node="e"), Goal("paid", table="small")), 0)
    assert found is not None and found.cost == 3
    assert [event.name for event in found.events] == ["give_bill"]


def test_a_party_is_a_loop() -> None:
    found = route_of(posed(State("a", waiting=(PAIR,)), Goal("seated", party=PAIR)), 1)
    assert found is not None and found.cost == 4  # to the entrance and to the table; deeds apart


def test_too_many_states_are_no_route() -> None:
    problem = posed(State("a", waiting=(PAIR,)), Goal("seated", party=PAIR))
    assert route_of(problem, 1, limit=1) is None


def test_a_route_is_put_in_terms_of_parties_and_tables() -> None:
    goals = (Goal("seated", party=PAIR), Goal("seated", party=ONE))
    problem = posed(State("a", waiting=(PAIR, ONE)), *goals)
    found = route_of(problem, 2)
    assert found is not None
    tour = Unfolder(parts(problem)[1]).realise(TableChoice(), found)
    assert tour is not None
    assert [stop.link.name for stop in tour.stops] == ["pick", "seat", "pick", "seat"]
    assert {stop.link.table for stop in tour.stops} == {"", "big", "small"}


def test_tolls_rise_for_a_route_of_too_many_loops() -> None:
    few, many = (Route(5, (), (), 0, loops, 9) for loops in (1, 3))
    assert Tolls().raised(few, 1, 2) == Tolls()
    assert Tolls().raised(many, 1, 2) != Tolls()
