"""Reasons in the user's terms: where in his files a waiter, a party or a goal comes from.

`Barriers` says who stands in the way of a place, or that no path leads there.
"""

from __future__ import annotations

from collections.abc import Iterable

from waiter_cli.bounds.distances import FAR, Staff, WalkDistances
from waiter_cli.errors import Where
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Party
from waiter_cli.model.wording import in_words

__all__ = [
    "Barriers",
    "party_text",
    "place_of_bill",
    "place_of_goal",
    "place_of_party",
    "place_of_waiter",
    "state_place",
]


def party_text(party: Party) -> str:
    """Returns a party as one speaks of it: ``a party of 2 (c1 …)``, ``c1`` when it is one."""
    return party[0] if len(party) == 1 else f"a party of {len(party)} ({party[0]} …)"


def state_place(problem: Problem, *keys: str) -> Where | None:
    """Returns the place of the first of ``keys`` that the scenario's ``state`` has."""
    known = dict(problem.state_where)
    return next((known[key] for key in keys if key in known), None)


def place_of_waiter(problem: Problem, waiter: str) -> Where | None:
    """Returns the source of a waiter's place: seen, or the scenario's state, or the layout."""
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
    """Returns the source of a party: it entered, or the scenario's state has it."""
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
    """Returns the place of a goal; left-out goals come from what asks for them."""
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
    """Returns the place that says that a table wants its bill."""
    for seen in problem.observations:
        if seen.kind == "bill" and seen.arguments[:1] == (table,):
            return seen.where
    return state_place(problem, f"wants_bill.{table}", "wants_bill")


class Barriers:
    """The obstacles on a floor and what they bar; remembers what it has computed."""

    def __init__(self, problem: Problem, staff: Staff) -> None:
        self.problem, self.fixed = problem, staff.fixed
        self._open: dict[frozenset[str], frozenset[str]] = {}

    def reached(self, waiters: Iterable[str]) -> frozenset[str]:
        """Returns the nodes that the agent can get to when only these waiters are there."""
        key = frozenset(waiters)
        if key not in self._open:
            floor = WalkDistances(self.problem, [self.fixed[waiter] for waiter in key])
            row = floor.row(floor.number[self.problem.state.agent])
            nodes = (name for name, steps in zip(floor.names, row) if steps < FAR)
            self._open[key] = frozenset(nodes) - {self.fixed[waiter] for waiter in key}
        return self._open[key]

    def before(
        self, what: str, nodes: Iterable[str], at: Where | None
    ) -> list[tuple[tuple[str, ...], Reason]]:
        """Returns why none of ``nodes`` can be reached by the agent; empty when one can.

        One reason, with the waiters it is about, for each smallest group of waiters that is in the
        way by itself (of those who stand for ever: those who will move are not looked at), or a
        single one when no path leads there.
        """
        wanted = list(nodes)
        if not self.reached(()) & set(wanted):
            start = self.problem.state.agent
            named = f"{what} ({in_words(wanted, 'or')})" if wanted else what
            there = what if wanted and what.endswith(wanted[0]) else named
            return [((), Reason(f"no path of edges leads from {start} to {there}", at))]
        in_way = list(self.fixed)
        reasons = []
        while not self.reached(in_way) & set(wanted):
            group = list(in_way)
            for waiter in in_way:
                rest = [other for other in group if other != waiter]
                if not self.reached(rest) & set(wanted):
                    group = rest
            message = self._message(what, wanted, group)
            reason = Reason(message, place_of_waiter(self.problem, group[0]) or at)
            reasons.append((tuple(group), reason))
            in_way = [waiter for waiter in in_way if waiter not in group]
        return reasons

    def _message(self, what: str, wanted: list[str], group: list[str]) -> str:
        first = group[0]
        if [self.fixed[first]] != wanted:
            spots = [f"{self.fixed[waiter]}, where {waiter} stands" for waiter in group]
            return f"{what} can be reached only through {' or through '.join(spots)}"
        if what.endswith(wanted[0]):
            return f"{first} stands on {what}"
        return f"{first} stands on {wanted[0]}, the only place from which {what} can be reached"
