"""Applies observations to what is believed: `State`, observations → `State`. Entry point `observe`.

Observations hold at one step, all of them, and are taken in the order given.  One that cannot be
true of the state is left out and its reason returned.  Source: contract, "Scenario (YAML)".
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from waiter_cli.errors import Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Reason
from waiter_cli.model.state import Observation, Robot, State
from waiter_cli.model.timetable import clashes, places_at

__all__ = ["each_party_once", "observe", "settle"]


def observe(
    state: State, observations: Sequence[Observation], layout: Layout
) -> tuple[State, tuple[Reason, ...]]:
    """Returns the state after all observations, and why those that cannot be cannot be."""
    reasons: list[Reason] = []
    observations = each_party_once(observations, state)
    for observation in observations:
        objection = _objection(state, observation)
        if objection is None:
            state = _believe(state, observation)
        else:
            reasons.append(Reason(objection, observation.where))
    places = {
        observation.arguments[0]: observation.where
        for observation in observations
        if observation.kind == "at"
    }
    reasons += _shared_nodes(state, places)
    if places:
        reasons += _timetable_broken(state, places, layout)
    return settle(state, layout), tuple(reasons)


def each_party_once(seen: Sequence[Observation], state: State) -> tuple[Observation, ...]:
    """Returns the observations without a party's leaving being told again for its other members."""
    kept: list[Observation] = []
    gone: set[str] = set()
    for each in seen:
        if each.kind == "enter":
            gone.difference_update(each.arguments)
        elif each.kind == "leave":
            if each.arguments[0] in gone:
                continue
            party = state.party_of(each.arguments[0])
            gone.update(name for name in party or () if name != each.arguments[0])
        kept.append(each)
    return tuple(kept)


def settle(state: State, layout: Layout) -> State:
    """Returns the state with its indirect effect: at a bar node what is carried empty becomes full."""
    bar = layout.bar
    if bar is None:
        return state
    filled = {robot.carries for robot in state.crew() if robot.carries and robot.at in bar.nodes}
    return replace(state, empty=state.empty - filled) if filled else state


def _objection(state: State, seen: Observation) -> str | None:
    """Returns why an observation cannot be, None when it can."""
    first = seen.arguments[0]
    seated = dict(state.seated)
    match seen.kind:
        case "enter":
            inside = [name for name in seen.arguments if state.party_of(name) is not None]
            if inside:
                return f"{inside[0]} enters, but is inside already: {_place(state, inside[0])}"
        case "leave" if state.party_of(first) is None:
            return f"{first} leaves, but is not inside"
        case "order" if first not in seated:
            return f"{first} is ready to order, but nobody sits there"
        case "free" if first in seated:
            return f"{first} is seen free, but {', '.join(seated[first])} should sit there"
        case "empty" if seen.arguments in state.carried():
            who = next(robot.name for robot in state.crew() if robot.carries == seen.arguments)
            who = who if state.robots else "the robot"
            return f"the {seen.arguments[1]} of {first} is seen empty there, but {who} carries it"
    return None


def _place(state: State, customer: str) -> str:
    table = state.table_of(customer)
    if table is not None:
        return f"at {table}"
    leader = next((robot.name for robot in state.robots if customer in robot.leads), None)
    if leader is not None:
        return f"with {leader}"
    return "with the robot" if customer in state.with_agent else "waiting at the entrance"


def _believe(state: State, seen: Observation) -> State:
    """Returns the state with one observation that can be."""
    first = seen.arguments[0]
    match seen.kind:
        case "enter":
            return replace(state, waiting=(*state.waiting, seen.arguments))
        case "leave":
            return _without(state, first)
        case "bill":
            return replace(state, wants_bill=state.wants_bill | {first}, paid=state.paid - {first})
        case "order":
            return replace(state, ready_to_order=state.ready_to_order | {first})
        case "empty":
            return replace(state, empty=state.empty | {(first, seen.arguments[1])})
        case "ready":
            return _ready(state, first, seen.arguments[1])
        case "at" if first == "agent":
            return replace(state, agent=seen.arguments[1])
        case "at" if state.robot(first) is not None:
            return _with_robots(state, lambda robot: robot.name == first, at=seen.arguments[1])
        case "at":
            waiters = dict(state.waiters) | {first: seen.arguments[1]}
            return replace(state, waiters=tuple(sorted(waiters.items())))
    return state


def _ready(state: State, table: str, item: str) -> State:
    ready = state.ready | {(table, item)}
    if item != "plate":
        return replace(state, ready=ready)
    state = _orders_gone(state, table)
    return replace(
        state,
        ready=ready,
        sent=state.sent | {table},
        ordered=state.ordered - {table},
        served=state.served - {table},
    )


def _without(state: State, customer: str) -> State:
    """Returns the state once the whole party of a customer has gone; its table is free and as new."""
    party = state.party_of(customer)
    table = state.table_of(customer)
    if table is None:
        waiting = tuple(other for other in state.waiting if other != party)
        led = () if state.with_agent == party else state.with_agent
        state = _with_robots(state, lambda robot: robot.leads == party, leads=())
        return replace(state, waiting=waiting, with_agent=led)
    carried = state.carrying
    state = _orders_gone(state, table)
    state = _with_robots(state, lambda robot: robot.carries == (table, "plate"), carries=None)
    return replace(
        state,
        seated=tuple(pair for pair in state.seated if pair[0] != table),
        wants_bill=state.wants_bill - {table},
        paid=state.paid - {table},
        ready_to_order=state.ready_to_order - {table},
        ordered=state.ordered - {table},
        sent=state.sent - {table},
        served=state.served - {table},
        ready=frozenset(pair for pair in state.ready if pair[0] != table),
        carrying=None if carried == (table, "plate") else carried,
    )


def _with_robots(state: State, which: Callable[[Robot], bool], **changes: Any) -> State:
    """Returns the state with some of several robots changed."""
    if not any(map(which, state.robots)):
        return state
    robots = (replace(robot, **changes) if which(robot) else robot for robot in state.robots)
    return replace(state, robots=tuple(robots))


def _orders_gone(state: State, table: str) -> State:
    """Returns the state in which none of several robots holds an order of ``table``."""
    robots = tuple(replace(robot, orders=robot.orders - {table}) for robot in state.robots)
    return replace(state, robots=robots) if robots else state


def _shared_nodes(state: State, places: dict[str, Where | None]) -> list[Reason]:
    reasons: list[Reason] = []
    on_node: dict[str, str] = {}
    for name, node in (*state.stations().items(), *state.waiters):
        other = on_node.setdefault(node, name)
        if other != name:
            where = places.get(name) or places.get(other)
            who = "the agent" if other == "agent" else other
            reasons.append(Reason(f"{name} and {who} cannot both stand on {node}", where))
    return reasons


def _timetable_broken(
    state: State, places: dict[str, Where | None], layout: Layout
) -> list[Reason]:
    """Returns reasons where what was seen and the timetable cannot both be."""
    start = dict(state.waiters)
    reasons = [
        Reason(
            f"{name} is seen at {start[name]}, but the timetable has him on {node}", places[name]
        )
        for name, node in places_at(start, layout.timetable, 0).items()
        if name in places and node != start[name]
    ]
    for clash in clashes(start, layout.timetable):
        where = places.get(clash.first) or places.get(clash.second)
        if clash.entry is not None and {clash.first, clash.second} & places.keys():
            message = (
                f"{clash.first} and {clash.second} would both stand on {clash.node} "
                f"at step {clash.step}, says the timetable"
            )
            reasons.append(Reason(message, where))
    return reasons
