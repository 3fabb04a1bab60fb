"""A problem for one robot with more robots: `Problem` → `Problem`. Entry point `with_robots`."""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.graph import distances
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot, State

__all__ = ["with_robots"]


def with_robots(problem: Problem, count: int) -> Problem:
    """Returns the problem with ``count`` robots; with one it is the same.

    The first is the robot that was there, with all that it has; the others start on the nodes
    nearest to it on which nobody stands, now or by the timetable.  Raises `InputError` where there
    are too few such nodes.
    """
    if count == 1:
        return problem
    layout, state = problem.layout, problem.state
    taken = {node for _, node in state.waiters} | {node for _, _, node in layout.timetable}
    near = distances(layout.joined(), state.agent, {node for _, node in state.waiters})
    free = [node for node in near if node not in taken and node != state.agent]
    if len(free) < count - 1:
        where = dict(layout.key_where).get("agent") or Where(layout.file or layout.name)
        message = f"there is no place for {count} robots: {len(free) + 1} nodes are free"
        raise InputError([Fault(where, message, "compare fewer, or add nodes")])
    names = _names(problem, count)
    first = Robot(names[0], state.agent, state.with_agent, state.carrying, state.ordered)
    robots = (first, *(Robot(name, node) for name, node in zip(names[1:], free)))

    def enlarged(one: State) -> State:
        return replace(
            one, agent="", with_agent=(), carrying=None, ordered=frozenset(), robots=robots
        )

    return replace(
        problem,
        layout=replace(layout, agents=tuple((robot.name, robot.at) for robot in robots)),
        state=enlarged(state),
        before_observations=enlarged(problem.before_observations),
    )


def _names(problem: Problem, count: int) -> list[str]:
    """Returns r1, r2, …, or robot1, robot2, … where something else is called so."""
    layout, state = problem.layout, problem.state
    taken = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    taken |= {who for who, _ in state.waiters} | {name for p in state.parties() for name in p}
    for prefix in ("r", "robot", "robot_"):
        names = [f"{prefix}{k + 1}" for k in range(count)]
        if not taken.intersection(names):
            return names
    raise InputError("no names are left for robots", "rename what is called r1 and robot1")
