"""Reasons why no plan of several robots can have an action. Entry point `find_foil_barriers`.

None of them needs a search.  Nobody comes in while a plan is carried out, no table wants anything anew,
and whoever sits goes on sitting: what the action needs and is not there, nor can be brought about, never is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from waiter_cli.fleets.barriers import find_barriers
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Robot
from waiter_cli.rules.places import places_for

__all__ = ["find_foil_barriers"]


def find_foil_barriers(problem: Problem, foil: Action) -> tuple[Reason, ...]:
    """Returns reasons why no plan that reaches the goals has ``foil``; empty where none was found."""
    robot = problem.state.robot(foil.arguments[0])
    if robot is None:
        return (Reason(f"there is no robot {foil.arguments[0]}"),)
    lacking = _at_door(problem, robot, foil) or _at_table(problem, robot, foil)
    if lacking is not None:
        return (Reason(lacking),)
    return tuple(_barred(problem, robot, foil)) or tuple(_lost(problem, foil))


def _at_door(problem: Problem, robot: Robot, foil: Action) -> str | None:
    """Returns why a party can never be picked up or seated."""
    state, layout = problem.state, problem.layout
    if foil.name not in ("pick", "seat"):
        return None
    who = foil.arguments[1]
    party, sits = state.party_of(who) or (), state.table_of(who)
    if sits is not None:
        return f"the party of {who} sits at {sits} already"
    leader = next((each.name for each in state.robots if party and each.leads == party), None)
    if leader is not None and (foil.name == "pick" or leader != robot.name):
        return f"the party of {who} follows {leader} already"
    if foil.name == "pick":
        return None
    table = layout.table(foil.arguments[2])
    if table.name in dict(state.seated):
        return f"{table.name} is not free"
    if len(party) > table.capacity:
        return f"{table.name} is for {table.capacity}, the party of {who} has {len(party)}"
    return None


def _at_table(problem: Problem, robot: Robot, foil: Action) -> str | None:
    """Returns why something can never be done for a table."""
    state = problem.state
    match foil.name, foil.arguments[1:]:
        case "give_bill", (table,) if table not in state.wants_bill:
            return f"{table} wants no bill"
        case "take_order", (table,) if table not in state.ready_to_order:
            return f"{table} is not ready to order"
        case "send_order", (table,) if table not in state.ready_to_order | robot.orders:
            return f"{robot.name} has no order of {table}, and {table} is not ready to order"
        case (("take_up" | "bring"), (item, table)):
            if not _can_hold(problem, robot, item, table, brings=foil.name == "bring"):
                return f"no {item} for {table} is ready"
        case "refill", (item, table) if (table, item) not in state.empty:
            return f"the {item} of {table} is not empty"
        case "bring_chairs", (name, count):
            known = problem.layout.table(name)
            there = dict(state.chairs).get(name, known.chairs)
            if not there < int(count) <= known.capacity:
                return f"{name} has {there} chairs, and room for {known.capacity}"
    return None


def _can_hold(problem: Problem, robot: Robot, item: str, table: str, *, brings: bool) -> bool:
    """Returns whether a robot may come to take something up, or to have it in its hands."""
    state = problem.state
    if (table, item) in state.ready:
        return True
    if brings and (robot.carries == (table, item) or (table, item) in state.empty):
        return True
    orders = state.ready_to_order | state.held_orders()
    return item == "plate" and problem.instant_kitchen and table in orders


def _barred(problem: Problem, robot: Robot, foil: Action) -> Iterator[Reason]:
    """Reasons why the robot never stands where it would have to."""
    ends = (foil.arguments[1],) if foil.name == "go_to" else places_for(problem.layout, foil)
    found = []
    for node in ends:
        goal = Goal("at", node=node, robot=robot.name)
        there = robot.at == node
        found.append(() if there else find_barriers(replace(problem, goals=(goal,), before=())))
    if not ends:
        yield Reason("there is no bar")
    elif all(found):
        yield from found[0]


def _lost(problem: Problem, foil: Action) -> Iterator[Reason]:
    """Reasons why the goals are out of reach once a party sits where the action seats it.

    A plan that seats it then would also be one, but for that, if it sat there from the start.
    """
    if foil.name != "seat":
        return
    _, who, table = foil.arguments
    state = problem.state
    party = state.party_of(who) or ()
    robots = tuple(
        replace(each, leads=()) if each.leads == party else each for each in state.robots
    )
    seated = replace(
        state,
        robots=robots,
        seated=tuple(sorted((*state.seated, (table, party)))),
        waiting=tuple(other for other in state.waiting if other != party),
    )
    for reason in find_barriers(
        replace(problem, state=seated, before_observations=seated, observations=())
    ):
        yield replace(reason, message=f"after it {reason.message}")
