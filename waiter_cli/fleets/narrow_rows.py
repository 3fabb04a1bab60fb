"""Paths without a siding, on which robots keep their order for ever. Entry points `narrow_rows`, `out_of_bounds`."""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.bounds.distances import standing
from waiter_cli.model.graph import reachable
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

__all__ = ["floor_parts", "narrow_rows", "out_of_bounds"]


def floor_parts(problem: Problem) -> Iterator[tuple[set[str], list[Robot]]]:
    """Yields the parts of the floor that colleagues who never move leave, and the robots in each."""
    shut = set(standing(problem).fixed.values())
    near, left = problem.layout.joined(), {node.name for node in problem.layout.nodes} - shut
    while left:
        part = reachable(near, min(left), shut)
        left -= part
        yield part, [robot for robot in problem.state.robots if robot.at in part]


def narrow_rows(problem: Problem) -> Iterator[tuple[list[str], list[Robot]]]:
    """Yields the nodes of each part that is a single path, from tip to tip, and the robots in that order."""
    near = problem.layout.joined()
    for part, robots in floor_parts(problem):
        degrees = {node: len(part.intersection(near[node])) for node in part}
        tips = sorted(node for node, degree in degrees.items() if degree == 1)
        if len(part) < 2 or max(degrees.values()) > 2 or len(tips) != 2:
            continue
        row = [tips[0]]
        while row[-1] != tips[1]:
            row.append(next(n for n in near[row[-1]] if n in part and n not in row[-2:]))
        yield row, sorted(robots, key=lambda robot: row.index(robot.at))


def out_of_bounds(problem: Problem) -> dict[str, frozenset[str]]:
    """Returns for robots on such a path the nodes at its tips that the others never leave to them."""
    nodes = {}
    for row, robots in narrow_rows(problem):
        for k, robot in enumerate(robots):
            own = row[k : len(row) - len(robots) + k + 1]
            nodes[robot.name] = frozenset(row).difference(own)
    return nodes
