"""Small restaurants for several robots, written out: `aisle` is a path, `square` has a way round."""

from __future__ import annotations

from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem

__all__ = ["aisle", "posed", "square"]

AISLE = """\
name: aisle
nodes: [n1, n2, n3, n4, n5, n6]
edges: [[n1, n2], [n2, n3], [n3, n4], [n4, n5], [n5, n6]]
entrance: n1
bar: [n6]
tables: {t2: {capacity: 2, nodes: [n2]}, t5: {capacity: 2, nodes: [n5]}}
"""
SQUARE = """\
name: square
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d], [d, a]]
entrance: a
bar: [c]
tables: {tb: {capacity: 2, nodes: [b]}, td: {capacity: 4, nodes: [d]}}
"""


def posed(layout: str, agents: str, scenario: str) -> Problem:
    """The problem of a layout's text, its ``agents`` and a scenario's text."""
    made = read_layout(f"{layout}agents: {{{agents}}}\n", "layout.yaml")
    return pose_problem(made, read_scenario(scenario, "scenario.yaml", made))


def aisle(agents: str, scenario: str) -> Problem:
    """Six nodes in a row, the entrance at n1, the bar at n6, tables at n2 and n5."""
    return posed(AISLE, agents, scenario)


def square(agents: str, scenario: str) -> Problem:
    """A ring of a, b, c and d: entrance, a table for two, the bar, a table for four."""
    return posed(SQUARE, agents, scenario)
