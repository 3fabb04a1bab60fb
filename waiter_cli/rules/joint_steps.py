"""Performs what several robots do in one step: `State`, actions → `State`. Entry points `apply_together`, `begin_together`,
`legal_instead`.

Each action is judged in the state at the step's beginning, by the rules for one robot (`actions`);
what is done is done at once.  Beyond that, in one step: no two of robots and colleagues come to
stand on one node, no two robots exchange nodes, nothing is done twice, and no action undoes what
another one does (such as sending an order that is taken anew).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot, State
from waiter_cli.rules.actions import REFILLABLE, Illegal, apply_alone, imaginable_actions

__all__ = ["apply_together", "begin_together", "legal_instead"]

# What an action is done to, among its arguments: no two robots do the same to it at once.
_DONE_TO = {
    "pick": slice(1, 2),
    "seat": slice(2, 3),
    "give_bill": slice(1, 2),
    "take_order": slice(1, 2),
    "send_order": slice(1, 2),
    "take_up": slice(1, 3),
    "bring": slice(1, 3),
    "refill": slice(1, 3),
    "bring_chairs": slice(1, 2),
}
_SETS = ("wants_bill", "paid", "ready_to_order", "sent", "served", "ready", "empty")


def begin_together(problem: Problem) -> State:
    """Returns the state at step 0, with what follows from it; raises `Illegal` on a shared node."""
    return _settle(problem, problem.state, 0)


def apply_together(problem: Problem, state: State, actions: Sequence[Action], step: int) -> State:
    """Returns the state at ``step + 1`` when all ``actions`` are done in ``state`` at ``step``.

    Raises `Illegal` with the first reason why they cannot be: one of them is not possible, or they
    do not go together.
    """
    after: dict[str, State] = {}
    for action in actions:
        name = action.arguments[0] if action.arguments else ""
        robot = state.robot(name)
        if robot is None:
            raise Illegal(f"{action.text}: there is no robot {name}".rstrip())
        if name in after:
            raise Illegal(f"{action.text}: {name} does another action at this step")
        if action.name == "refill" and action.arguments[:0:-1] in state.carried():
            raise Illegal(f"{action.text}: it is carried already")
        after[name] = apply_alone(problem, _as_seen_by(robot, state), action)
    _require_once(actions)
    _require_harmony(problem, actions)
    _require_no_exchange(state, actions, step)
    return _settle(problem, _merged(state, after, actions), step + 1)


def legal_instead(
    problem: Problem, state: State, actions: Sequence[Action], step: int
) -> list[Action]:
    """Returns what some robot could do at ``step`` while the others do their ``actions``, what it does
    itself included; each party by its first member, robot by robot.
    """
    found = []
    for robot in state.robots:
        others = [action for action in actions if action.arguments[0] != robot.name]
        for seen in imaginable_actions(problem, _as_seen_by(robot, state), step):
            action = replace(seen, arguments=(robot.name, *seen.arguments[1:]))
            try:
                apply_together(problem, state, [*others, action], step)
            except Illegal:
                continue
            found.append(action)
    return found


def _as_seen_by(robot: Robot, state: State) -> State:
    """The state as if the robot were the only one."""
    return replace(
        state,
        agent=robot.at,
        with_agent=robot.leads,
        carrying=robot.carries,
        ordered=robot.orders,
        robots=(robot,),
    )


def _require_once(actions: Sequence[Action]) -> None:
    done: dict[tuple[str, tuple[str, ...]], str] = {}
    for action in actions:
        if action.name in _DONE_TO:
            what = (action.name, action.arguments[_DONE_TO[action.name]])
            first = done.setdefault(what, action.arguments[0])
            if first != action.arguments[0]:
                raise Illegal(f"{action.text}: {first} does the same at this step")


def _require_harmony(problem: Problem, actions: Sequence[Action]) -> None:
    """Raises `Illegal` where one action undoes at once what another one does."""
    if len(actions) < 2:
        return
    taken = {action.arguments[1]: action for action in actions if action.name == "take_order"}
    at_once = problem.instant_kitchen and "plate" in problem.layout.objects
    sent = {a.arguments[1]: a for a in actions if a.name == "send_order"} if at_once else {}
    for action in actions:
        table, other = action.arguments[-1], None
        if action.name == "send_order" or (action.name, action.arguments[1]) == ("bring", "plate"):
            other = taken.get(table)
        elif (action.name, action.arguments[1]) == ("take_up", "plate"):
            other = sent.get(table)
        if other is not None:
            raise Illegal(f"{action.text}: it does not go together with {other.text}")


def _require_no_exchange(state: State, actions: Sequence[Action], step: int) -> None:
    stations = state.stations()
    moves = {
        (stations[action.arguments[0]], action.arguments[1]): action.arguments[0]
        for action in actions
        if action.name == "go_to"
    }
    for (start, end), name in moves.items():
        other = moves.get((end, start))
        if other is not None:
            raise Illegal(f"{name} and {other} would exchange {start} and {end} at step {step}")


def _merged(state: State, after: dict[str, State], actions: Sequence[Action]) -> State:
    """The state in which all has changed that some robot changed."""
    changes = {}
    for key in _SETS:
        before = getattr(state, key)
        own = [getattr(one, key) for one in after.values()]
        gone = frozenset(thing for thing in before if any(thing not in one for one in own))
        changes[key] = (before - gone).union(*own) - gone
    seated, chairs, waiting = dict(state.seated), dict(state.chairs), state.waiting
    for one in after.values():
        seated |= {table: party for table, party in one.seated if table not in seated}
        chairs |= dict(set(one.chairs) - set(state.chairs))
        waiting = tuple(party for party in waiting if party in one.waiting)
    taken = {a.arguments[1]: a.arguments[0] for a in actions if a.name == "take_order"}
    return replace(
        state,
        seated=tuple(sorted(seated.items())),
        chairs=tuple(sorted(chairs.items())),
        waiting=waiting,
        robots=tuple(_changed(robot, after.get(robot.name), taken) for robot in state.robots),
        **changes,
    )


def _changed(robot: Robot, after: State | None, taken: dict[str, str]) -> Robot:
    """A robot after the step; an order that another one takes anew is no longer its own."""
    orders = robot.orders
    if after is not None:
        orders = after.ordered
        robot = Robot(robot.name, after.agent, after.with_agent, after.carrying, orders)
    lost = {table for table in orders if taken.get(table, robot.name) != robot.name}
    return replace(robot, orders=orders - lost) if lost else robot


def _settle(problem: Problem, state: State, step: int) -> State:
    """``state`` at ``step``, once the waiters due then have moved and carried things have filled.

    Raises `Illegal` where a robot shares its node.
    """
    due = {who: to for who, at, to in problem.layout.timetable if at == step}
    if due:
        state = replace(state, waiters=tuple(sorted((dict(state.waiters) | due).items())))
    posts = {node: waiter for waiter, node in state.waiters}
    for name, node in state.stations().items():
        other = posts.setdefault(node, name)
        if other != name:
            raise Illegal(f"{other} and {name} would both stand on {node} at step {step}")
    bar = problem.layout.bar
    if bar is None:
        return state
    filled = {
        robot.carries
        for robot in state.robots
        if robot.carries and robot.carries[1] in REFILLABLE and robot.at in bar.nodes
    }
    return replace(state, empty=state.empty - filled) if filled else state
