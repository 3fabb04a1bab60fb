"""Stops as plans: every walk and deed, chairs where a party lacks them, and others out of the way."""

from __future__ import annotations

from dataclasses import replace

from tests.support.hall import HALL, posed
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.service_chains import Link
from waiter_cli.bounds.tour import TourStop
from waiter_cli.bounds.tour_to_plan import write_plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

PARTY = ("c1", "c2")


def written(problem: Problem, *stops: tuple[Link, str], end: str | None = None) -> list[str] | None:
    staff = standing(problem)
    floor = WalkDistances(problem, staff.fixed.values())
    number = floor.number
    made = [
        TourStop(
            link, number[node], (number[node],), k, PARTY if link.name in ("pick", "seat") else ()
        )
        for k, (link, node) in enumerate(stops)
    ]
    plan = write_plan(problem, floor, staff, made, number[end] if end else None)
    return None if plan is None else [f"{a.step} {a.text}" for a in plan.actions]


def test_a_party_is_led_with_chairs_brought_first() -> None:
    state = State("d", waiting=(PARTY,), chairs=(("big", 4), ("small", 1)))
    problem = posed(state, Goal("seated", party=PARTY))
    found = written(problem, (Link("pick"), "e"), (Link("seat", "small"), "d"))
    assert found == [
        "0 go_to(agent,e)",
        "1 pick(agent,c1)",
        "2 go_to(agent,d)",
        "3 bring_chairs(agent,small,2)",
        "4 seat(agent,c1,small)",
    ]


def test_what_comes_after_the_goals_hold_is_left_out() -> None:
    state = State("a", seated=(("big", ("c1",)),), wants_bill=frozenset({"big"}))
    problem = posed(state, Goal("paid", table="big"))
    found = written(problem, (Link("give_bill", "big"), "a"), (Link("visit"), "d"))
    assert found == ["0 give_bill(agent,big)"]


def test_stops_that_break_a_rule_or_miss_a_goal_are_no_plan() -> None:
    state = State("a", seated=(("big", ("c1",)),))
    problem = posed(state, Goal("at", node="a"), Goal("paid", table="big"))
    assert written(problem, (Link("give_bill", "big"), "a")) is None  # nobody asked for it
    assert written(posed(State("a"), Goal("at", node="e")), (Link("visit"), "b")) is None
    shut = replace(posed(State("a"), Goal("at", node="e")), layout=replace(HALL, edges=()))
    assert written(shut, end="e") is None


def test_it_waits_until_who_moves_is_out_of_the_way() -> None:
    layout = replace(HALL, waiters=(("w", "b"),), timetable=(("w", 2, "c"),))
    state = State("a", waiters=layout.waiters)
    problem = Problem(layout, state, (), state, (Goal("at", node="d"),))
    assert written(problem, end="d") == ["2 go_to(agent,b)", "3 go_to(agent,d)"]
