"""Explains why no plan has an action: `Problem`, foil, plan → a sentence. Entry
point `find_conflict`.

Where the robot stands and whom it leads is its own choice, so that is never the reason by itself: the
foil is tried in the states of a plan with the robot put where the action needs it.  What refuses it
even so, from the start, is the reason; where nothing does, it is what the action makes impossible.
"""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State
from waiter_cli.rules.actions import Illegal, apply
from waiter_cli.rules.places import places_for
from waiter_cli.rules.validator import run

__all__ = ["find_conflict"]


def find_conflict(problem: Problem, foil: Action, plan: Plan) -> str:
    """Returns why no plan that reaches the goals has ``foil``.

    ``plan`` is one that does reach them.

    >>> from waiter_cli.problems.from_options import read_problem
    >>> problem, _ = read_problem("report", None, enter=(1, 3))
    >>> plan = Plan((), 0)
    >>> find_conflict(problem, Action(0, "seat", ("agent", "c2", "table1")), plan)
    'table1 is for 2, the party of c2 has 3'
    """
    nodes = places_for(problem.layout, foil)
    barred = [_barred(problem, node) for node in nodes]
    if all(barred):
        return (
            barred[0] or f"no edge leads to {foil.arguments[-1]}" if barred else "there is no bar"
        )
    refused: list[str] = []
    legal = False
    for step, state in enumerate(run(problem, plan).states[:-1] or (problem.state,)):
        for node, why in zip(nodes, barred):
            if why:
                continue
            try:
                after = apply(problem, _poised(state, foil, node), foil, step)
            except Illegal as refusal:
                refused.append(
                    _settled(state, foil) or refusal.reason.removeprefix(f"{foil.text}: ")
                )
                continue
            legal = True
            lost = _impossible(problem, after, step + 1, problem.goals)
            if lost:
                return f"after it {lost}"
    if legal or not refused:
        return "after it the goals are out of reach"
    return refused[0]  # later the plan itself may have made it needless


def _barred(problem: Problem, node: str) -> str | None:
    """Returns why the robot can never stand on a node; None when it can, or nothing is known."""
    if problem.state.agent == node:
        return None
    return _impossible(problem, problem.state, 0, (Goal("at", node=node),))


def _impossible(problem: Problem, state: State, step: int, goals: tuple[Goal, ...]) -> str | None:
    """Returns the first reason why ``goals`` cannot be reached from a state at
    ``step``, None where none is found.
    """
    from waiter_cli.bounds import find_impossible

    table = problem.layout.timetable
    later = tuple((who, at - step, node) for who, at, node in table if at > step)
    posed = replace(
        problem,
        layout=replace(problem.layout, timetable=later),
        before_observations=state,
        observations=(),
        state=state,
        goals=goals,
        before=(),
    )
    reasons = find_impossible(posed)
    return reasons[0].message if reasons else None


def _poised(state: State, foil: Action, node: str) -> State:
    """Returns the state with the robot on ``node``, with whom it has to lead and
    what it has to hold.

    Only what it could lead or hold by then: a party that is on its feet, a thing that stands ready.
    """
    state = replace(state, agent=node)
    match foil.name, foil.arguments:
        case "pick", _:
            return _leading(state, ())
        case "seat", (_, customer, _):
            party = state.party_of(customer) or ()
            return _leading(state, party) if party in state.waiting else state
        case (("take_up" | "refill"), _):
            return replace(state, carrying=None)
        case "bring", (_, item, table) if (table, item) in state.ready:
            ready = state.ready - {(table, item)}
            return replace(state, ready=ready, carrying=(table, item))
    return state


def _settled(state: State, foil: Action) -> str | None:
    """Returns why an action has no object in a state, where its rule would only name the robot."""
    match foil.name, foil.arguments:
        case ("pick", (_, customer)) | ("seat", (_, customer, _)):
            table = state.table_of(customer)
            return f"the party of {customer} sits at {table} already" if table else None
        case "bring", (_, item, table) if (table, item) != state.carrying:
            return f"no {item} for {table} is ready" if (table, item) not in state.ready else None
    return None


def _leading(state: State, party: tuple[str, ...]) -> State:
    """Returns the state with another party behind the robot; who followed it before waits."""
    waiting = tuple(
        other for other in (*state.waiting, state.with_agent) if other and other != party
    )
    return replace(state, waiting=waiting, with_agent=party)
