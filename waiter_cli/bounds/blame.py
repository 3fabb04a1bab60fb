"""Reasons in the user's terms: where in his files a waiter, a party or a goal comes from.

`unreachable` says who stands in the way of a place, or that no path leads there.
"""

from __future__ import annotations

from collections.abc import Iterable

from waiter_cli.bounds.floor import FAR, Floor, Staff
from waiter_cli.problem import Problem, Reason
from waiter_cli.situation import Goal, Party, Where

__all__ = [
    "listed",
    "party_text",
    "place_of_bill",
    "place_of_goal",
    "place_of_party",
    "place_of_waiter",
    "state_place",
    "unreachable",
]


def listed(names: Iterable[str], last: str = "and") -> str:
    """Names in a row: ``a, b and c``."""
    found = list(names)
    return found[0] if len(found) == 1 else f"{', '.join(found[:-1])} {last} {found[-1]}"


def party_text(party: Party) -> str:
    """A party as one speaks of it: ``a party of 2 (c1 …)``, ``c1`` when it is one."""
    return party[0] if len(party) == 1 else f"a party of {len(party)} ({party[0]} …)"


def state_place(problem: Problem, *keys: str) -> Where | None:
    """Where the scenario's ``state`` says something: the first of ``keys`` that it has."""
    known = dict(problem.state_where)
    return next((known[key] for key in keys if key in known), None)


def place_of_waiter(problem: Problem, waiter: str) -> Where | None:
    """Where a waiter's place comes from: seen, or the scenario's state, or the layout."""
    for seen in reversed(problem.observations):
        if seen.kind == "at" and seen.arguments[:1] == (waiter,):
            return seen.where
    layout = dict(problem.layout.key_where)
    of_layout = layout.get(f"waiters.{waiter}", layout.get("waiters"))
    own = state_place(problem, f"waiters.{waiter}")
    if own is None and dict(problem.layout.waiters).get(waiter) != dict(
        problem.before_observations.waiters
    ).get(waiter):
        own = state_place(problem, "waiters", "state")
    return own or of_layout or state_place(problem, "waiters")


def place_of_party(problem: Problem, party: Party) -> Where | None:
    """Where a party comes from: it entered, or the scenario's state has it."""
    for seen in problem.observations:
        if seen.kind == "enter" and set(seen.arguments) & set(party):
            return seen.where
    state = problem.state
    if party in state.waiting:
        return state_place(problem, f"party.{party[0]}", "waiting")
    if party == state.with_agent:
        return state_place(problem, f"party.{party[0]}", "with_agent")
    table = state.table_of(party[0])
    return state_place(problem, f"party.{party[0]}", f"seated.{table}", "seated")


def place_of_goal(problem: Problem, goal: Goal) -> Where | None:
    """Where a goal is written; left-out goals come from what asks for them."""
    if goal.where is not None:
        return goal.where
    if goal.party:
        party = problem.state.party_of(goal.party[0])
        return place_of_party(problem, party or goal.party)
    if goal.kind == "paid" and goal.table is not None:
        return place_of_bill(problem, goal.table)
    if goal.table is not None:
        kinds = {"order", "ready", "empty"}
        for seen in problem.observations:
            if seen.kind in kinds and seen.arguments[:1] == (goal.table,):
                return seen.where
        thing = f"{goal.table}.{goal.item or 'plate'}"
        orders = [f"{key}.{goal.table}" for key in ("ready_to_order", "ordered", "sent")]
        things = [f"{key}.{thing}" for key in ("ready", "empty", "carrying")]
        return state_place(problem, *things, *orders)
    return None


def place_of_bill(problem: Problem, table: str) -> Where | None:
    """Where it is said that a table wants its bill."""
    for seen in problem.observations:
        if seen.kind == "bill" and seen.arguments[:1] == (table,):
            return seen.where
    return state_place(problem, f"wants_bill.{table}", "wants_bill")


def unreachable(
    problem: Problem, staff: Staff, what: str, nodes: Iterable[str], at: Where | None
) -> list[tuple[tuple[str, ...], Reason]]:
    """Why none of ``nodes`` can be reached by the agent; empty when one can.

    One reason, with the waiters it is about, for each smallest group of waiters that is in the way by itself (one that stands
    ever after; those who will move are not looked at), or a single one when no path leads there.
    """
    wanted = list(nodes)
    in_way = dict(staff.fixed)
    reasons: list[tuple[tuple[str, ...], Reason]] = []

    def closed(waiters: Iterable[str]) -> bool:
        floor = Floor(problem, [staff.fixed[waiter] for waiter in waiters])
        row = floor.row(floor.number[problem.state.agent])
        return all(
            row[floor.number[node]] == FAR or floor.number[node] in floor.shut for node in wanted
        )

    if not wanted:
        return [((), Reason(f"{what} has no node", at))]
    if closed(()):
        start = problem.state.agent
        there = what if what.endswith(wanted[0]) else f"{what} ({listed(wanted, 'or')})"
        return [((), Reason(f"no path of edges leads from {start} to {there}", at))]
    while closed(in_way):
        group = list(in_way)
        for waiter in list(in_way):
            rest = [other for other in group if other != waiter]
            if rest and closed(rest):
                group = rest
        spots = [f"{staff.fixed[waiter]}, where {waiter} stands" for waiter in group]
        if [staff.fixed[group[0]]] == wanted:
            message = (
                f"{group[0]} stands on {wanted[0]}, and {what} can be reached from nowhere else"
            )
            if what == wanted[0]:
                message = f"{group[0]} stands on {what}"
        else:
            message = f"{what} can be reached only through {' or through '.join(spots)}"
        reason = Reason(message, place_of_waiter(problem, group[0]) or at)
        reasons.append((tuple(group), reason))
        for waiter in group:
            del in_way[waiter]
    return reasons
