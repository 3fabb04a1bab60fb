"""Reasons why several robots can never reach their goals, with their places. Entry point `find_barriers`.

None of them needs a search: nodes behind colleagues who never move, robots that keep their order on a
path without a siding, robots that leave each other no place.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from waiter_cli.bounds import find_impossible
from waiter_cli.bounds.distances import standing
from waiter_cli.bounds.reasons import Barriers, place_of_goal
from waiter_cli.errors import Where
from waiter_cli.fleets.narrow_rows import floor_parts, narrow_rows
from waiter_cli.fleets.routing import alone
from waiter_cli.model.graph import reachable
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Robot

__all__ = ["find_barriers"]


def find_barriers(problem: Problem) -> tuple[Reason, ...]:
    """Returns reasons why there is no plan of any length, empty where none was found."""
    found = [*_shared(problem), *_behind(problem), *_packed(problem), *_in_order(problem)]
    if not found:
        found = list(_as_one(problem))
    return tuple(dict.fromkeys(found))


def _ends(problem: Problem) -> list[Goal]:
    """The goals that want a certain robot somewhere."""
    return [goal for goal in problem.goals if goal.kind == "at" and goal.robot is not None]


def _place(problem: Problem, robot: str) -> Where | None:
    places = dict(problem.layout.key_where) | dict(problem.state_where)
    return places.get(f"agents.{robot}") or places.get("agents")


def _shared(problem: Problem) -> Iterator[Reason]:
    """Goals that want two robots on one node, one robot on two, or robots on more nodes than there are."""
    for first, then in combinations(_ends(problem), 2):
        if first.node == then.node and first.robot != then.robot:
            yield Reason(
                f"{first.robot} and {then.robot} are both wanted at {then.node}", then.where
            )
        elif first.robot == then.robot and first.node != then.node:
            yield Reason(f"{then.robot} is wanted at {first.node} and at {then.node}", then.where)
    nodes = dict.fromkeys(goal.node for goal in problem.goals if goal.kind == "at")
    robots = len(problem.state.robots)
    if len(nodes) > robots:
        last = [goal for goal in problem.goals if goal.kind == "at"][-1]
        yield Reason(f"robots are wanted at {len(nodes)} nodes, and there are {robots}", last.where)


def _behind(problem: Problem) -> Iterator[Reason]:
    """Nodes that robots cannot get to because of colleagues who never move, or for want of a path."""
    staff = standing(problem)
    robots = {robot.name: robot for robot in problem.state.robots}
    for goal in problem.goals:
        if goal.kind == "at" and goal.node is not None:
            able = [robots[goal.robot]] if goal.robot is not None else list(robots.values())
            blocked = []
            for robot in able:
                barriers = Barriers(alone(problem, robot), staff)
                blocked.append(
                    barriers.before(goal.node, (goal.node,), place_of_goal(problem, goal))
                )
            if all(blocked):
                yield from (reason for _, reason in blocked[0])


def _packed(problem: Problem) -> Iterator[Reason]:
    """Robots on every node of a part without a way round, so that none can move."""
    near = problem.layout.joined()
    for part, robots in floor_parts(problem):
        edges = sum(len(part.intersection(near[node])) for node in part) // 2
        if len(robots) < len(part) or edges >= len(part):
            continue
        names = {robot.name: robot.at for robot in robots}
        for goal in _ends(problem):
            if goal.robot in names and names[goal.robot] != goal.node:
                here = f"as many robots as nodes ({len(part)}) where {goal.robot} stands"
                yield Reason(
                    f"{here}: none of them can move", _place(problem, goal.robot) or goal.where
                )


def _in_order(problem: Problem) -> Iterator[Reason]:
    """Robots that would have to pass each other on a path that has no siding."""
    for row, robots in narrow_rows(problem):
        at = {node: k for k, node in enumerate(row)}
        wanted = {goal.robot: goal for goal in _ends(problem) if goal.node in at}
        known = [robot for robot in robots if robot.name in wanted]
        for one, other in combinations(known, 2):
            before = at[one.at] < at[other.at]
            first, then = wanted[one.name], wanted[other.name]
            after = at[first.node or ""] < at[then.node or ""]
            if before != after and first.node != then.node:
                message = (
                    f"{one.name} and {other.name} cannot pass each other between {row[0]} and "
                    f"{row[-1]}: the path has no siding"
                )
                yield Reason(message, then.where or _place(problem, other.name))


def _as_one(problem: Problem) -> Iterator[Reason]:
    """Reasons why one robot alone, whose hands are free, could not do it either.

    It can do what they can where all of them get to the same nodes: parties that are led wait at the
    entrance for it, what is carried stands at the bar, and the orders that were taken are its own.
    With what one of them has in its hands it could be stuck where the others are not.
    """
    state, robots, layout = problem.state, problem.state.robots, problem.layout
    shut = set(standing(problem).fixed.values())
    near = problem.layout.neighbours()
    reached = [reachable(near, robot.at, shut) for robot in robots]
    if any(other != reached[0] for other in reached) or not all(r.at in reached[0] for r in robots):
        return
    bar = layout.bar.nodes if layout.bar is not None else ()
    if state.led() and layout.entrance not in reached[0]:
        return
    if state.carried() and reached[0].isdisjoint(bar):
        return
    free = replace(
        state, waiting=(*state.waiting, *state.led()), ready=state.ready | state.carried() - state.empty
    )  # fmt: skip
    merged = Robot(robots[0].name, robots[0].at, orders=state.held_orders())
    goals = tuple(goal for goal in problem.goals if goal.kind != "at")
    one = replace(alone(replace(problem, state=free), merged), goals=goals, before=())
    yield from find_impossible(one)
