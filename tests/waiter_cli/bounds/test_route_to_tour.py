"""Routes as tours: parties at the tables of a route, what it left out put in."""

from __future__ import annotations

from dataclasses import replace

from tests.support.hall import posed
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.relaxed_route import Route, RouteEvent
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.route_to_tour import Unfolder
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.bounds.tour import Tour
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

PAIR, ONE = ("c1", "c2"), ("c3",)
SEATED = (Goal("seated", party=PAIR), Goal("seated", party=ONE))
BOTH = posed(State("a", waiting=(PAIR, ONE)), *SEATED)


def unfolder(problem: Problem) -> Unfolder:
    floor = WalkDistances(problem, ())
    return Unfolder(Builder(Seating(problem, find_needs(problem), floor), Clock(10_000, None)))


def route(unfolding: Unfolder, *tables: str) -> Route:
    """A route that leads somebody to each of these tables, one after the other."""
    floor = unfolding.floor
    events: list[RouteEvent] = []
    for table in tables:
        events.append(RouteEvent("pick", floor.door))
        events.append(RouteEvent("seat", floor.nodes_of[table][0], table))
    return Route(0, tuple(events), tuple((table, False) for table in tables), 0, len(tables), 1)


def seats(tour: Tour | None) -> list[str]:
    assert tour is not None
    return [stop.link.table for stop in tour.stops if stop.link.name == "seat"]


def test_parties_sit_where_the_route_leads() -> None:
    unfolding = unfolder(BOTH)
    assert seats(unfolding.realise(TableChoice(), route(unfolding, "big", "small"))) == [
        "big",
        "small",
    ]
    assert seats(unfolding.realise(TableChoice(), route(unfolding, "small", "big"))) == [
        "small",
        "big",
    ]


def test_a_table_used_twice_is_left_to_one_party() -> None:
    unfolding = unfolder(BOTH)
    tour = unfolding.realise(TableChoice(), route(unfolding, "small", "small"))
    assert sorted(seats(tour)) == ["big", "small"]


def test_what_the_route_left_out_is_put_in() -> None:
    state = replace(
        BOTH.state, waiting=(ONE,), seated=(("big", PAIR),), wants_bill=frozenset({"big"})
    )
    unfolding = unfolder(posed(state, SEATED[1], Goal("paid", table="big")))
    tour = unfolding.realise(TableChoice(), route(unfolding, "small"))
    assert tour is not None
    assert sorted(stop.link.name for stop in tour.stops) == ["give_bill", "pick", "seat"]


def test_an_order_of_goals_is_kept_by_insertion() -> None:
    unfolding = unfolder(replace(BOTH, before=((SEATED[1], SEATED[0]),)))
    tour = unfolding.realise(TableChoice(), route(unfolding, "big", "small"))
    assert tour is not None
    assert [stop.party for stop in tour.stops if stop.link.name == "seat"] == [ONE, PAIR]


def test_a_choice_that_cannot_be_has_no_tour() -> None:
    unfolding = unfolder(BOTH)
    assert unfolding.seats(TableChoice(never=frozenset({"big", "small"}))) is None
    assert unfolding.plain(TableChoice(never=frozenset({"big", "small"}))) is None
