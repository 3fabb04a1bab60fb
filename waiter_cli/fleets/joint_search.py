"""All joint states of several robots, where they are few: `Problem` → `Exhausted`. Entry point `exhaust`.

Breadth first, so the plan that is found is a shortest one; where all states were seen and none of
them will do, there is no plan of any length.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.joint_world import JointCode, JointWorld
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem

__all__ = ["Exhausted", "exhaust"]

MOST_ROBOTS = 12


@dataclass(frozen=True)
class Exhausted:
    """``plan`` is a shortest one; without one there is none, of all ``states`` that can be reached."""

    states: int
    plan: Plan | None


def exhaust(
    problem: Problem, most: int, deadline: float | None = None, required: Action | None = None
) -> Exhausted | None:
    """Returns what trying everything comes to, None beyond ``most`` steps from state to state.

    ``deadline`` is of `time.monotonic`.  A plan is one in which ``required`` occurs, where that is given.
    """
    if len(problem.state.robots) > MOST_ROBOTS:
        return None  # a single step has too many ways
    world = JointWorld(problem)
    wanted = [world.test(goal) for goal in problem.goals]
    pairs = [(world.test(early), world.test(late)) for early, late in problem.before]
    start = world.start()
    if start is None:
        return Exhausted(0, None)
    marks = _advanced(pairs, start, (0,) * len(pairs))
    if marks is None:
        return Exhausted(1, None)
    first = (start, marks, required is None)
    came: dict[Any, Any] = {first: None}
    frontier, seen, length = [first], 0, 0
    while frontier:
        fresh, missing = [], []
        for node in frontier:
            code, marks, done = node
            if not (all(mark == 2 for mark in marks) and all(test(code) for test in wanted)):
                missing.append(node)
            elif done:
                return Exhausted(len(came), _plan(world, came, node, length))
        for node in missing:  # where the goals hold nothing more is done
            code, marks, done = node
            for chosen, after in world.successors(code):
                seen += 1
                if seen > most:
                    return None
                later = _advanced(pairs, after, marks) if pairs else ()
                if later is None:
                    continue
                known = done or _has(world, chosen, required)
                if (state := (after, later, known)) not in came:
                    came[state] = (node, chosen)
                    fresh.append(state)
            if deadline is not None and time.monotonic() > deadline:
                return None
        frontier, length = fresh, length + 1
    return Exhausted(len(came), None)


def _has(world: JointWorld, chosen: Any, action: Action | None) -> bool:
    """Returns whether an action is among those of a step."""
    return action is not None and any(each.text == action.text for each in world.actions(chosen, 0))


_Test = Callable[[JointCode], bool]


def _advanced(
    pairs: list[tuple[_Test, _Test]], code: JointCode, marks: tuple[int, ...]
) -> tuple[int, ...] | None:
    """Returns for each pair 0 (none has held), 1 (the early one has) or 2 (both in order); None: too late."""
    found = []
    for (early, late), mark in zip(pairs, marks):
        if mark == 1 and late(code):
            mark = 2
        elif mark == 0:
            if late(code):
                return None
            mark = int(early(code))
        found.append(mark)
    return tuple(found)


def _plan(world: JointWorld, came: dict[Any, Any], node: Any, length: int) -> Plan:
    """The plan that leads to ``node``."""
    actions: list[Action] = []
    step = length
    while came[node] is not None:
        node, chosen = came[node]
        step -= 1
        actions[:0] = world.actions(chosen, step)
    return Plan(tuple(actions), length)
