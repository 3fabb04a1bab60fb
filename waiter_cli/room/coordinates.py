"""Places for nodes that have none: edges → coordinates. Entry points `spread`, `place`.

Nodes are moved until their distances in metres are nearly their distances in edges (stress
majorization: de Leeuw 1977; Gansner, Koren and North 2004), from a start in which two pairs of far
nodes span the plane.  The same graph gets the same places.  Good enough to draw a restaurant of
which only the paths are known, and to move things about from there.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import cos, hypot, sin
from typing import TYPE_CHECKING

from waiter_cli.model.graph import distances

if TYPE_CHECKING:
    from waiter_cli.model.layout import Layout, Table

__all__ = ["EDGE", "place", "spread"]

EDGE = 2.0
"""Metres that an edge should be long."""
ROUNDS = 60
WORK = 3_000_000
"""Pairs looked at in all, at most: a large graph gets fewer rounds."""

Point = tuple[float, float]


def spread(near: Mapping[str, Sequence[str]]) -> dict[str, Point]:
    """Returns a place for every node, in metres, from (0, 0) upwards, by the neighbours of each.

    >>> spread({"a": ("b",), "b": ("a",)})
    {'a': (2.0, 0.0), 'b': (0.0, 0.0)}
    """
    names = list(near)
    if not names:
        return {}
    number = {name: k for k, name in enumerate(names)}
    far = _distances(names, near)
    places = _start(far)
    for _ in range(max(4, min(ROUNDS, WORK // (len(names) ** 2 + 1)))):
        places = [_pulled(k, places, far[k]) for k in range(len(names))]
    places = _upright(places, [(k, number[n]) for k, a in enumerate(names) for n in near[a]])
    left, low = min(x for x, _ in places), min(y for _, y in places)
    return {
        name: (round(x - left, 1) + 0.0, round(y - low, 1) + 0.0)
        for name, (x, y) in zip(names, places)
    }


def place(layout: Layout) -> Layout:
    """Returns the layout with a place for every node, and tables beside theirs where
    they have none.
    """
    from waiter_cli.model.geometry import beside

    at = spread(layout.joined())
    nodes = tuple(replace(node, at=at[node.name]) for node in layout.nodes)
    walks = [(at[a], at[b]) for a, b in layout.edges]
    tables: list[Table] = []
    for table in layout.tables:
        centre = table.at
        if centre is None:
            taken = [other.at for other in tables if other.at is not None]
            centre = beside(at[table.nodes[0]], table.size, walks, taken)
        tables.append(replace(table, at=centre))
    return replace(layout, nodes=nodes, tables=tuple(tables))


def _distances(names: Sequence[str], near: Mapping[str, Sequence[str]]) -> list[list[float]]:
    """Returns metres wanted between any two nodes.

    Parts that no edge joins stand beside each other.
    """
    number = {name: k for k, name in enumerate(names)}
    out: list[list[float]] = []
    for start in names:
        steps = distances(near, start)
        apart = max(steps.values()) + 3
        row = [float(apart)] * len(names)
        for node, count in steps.items():
            row[number[node]] = float(count)
        out.append(row)
    return [
        [EDGE * max(out[i][j], out[j][i]) for j in range(len(names))] for i in range(len(names))
    ]


def _start(far: Sequence[Sequence[float]]) -> list[Point]:
    """Returns each node by how much nearer it is to one end than to the other, along and across."""
    count = range(len(far))
    west = max(count, key=lambda k: far[0][k])
    east = max(count, key=lambda k: far[west][k])
    south = max(count, key=lambda k: min(far[west][k], far[east][k]))
    north = max(count, key=lambda k: (far[south][k], -abs(far[west][k] - far[east][k])))
    wide = far[west][east] > 0 and far[south][west] > 0 and south not in (west, east)
    return [
        (
            (far[west][k] - far[east][k]) / 2,
            # A little apart, so that no two nodes begin at the same place.
            ((far[south][k] - far[north][k]) / 2 + 0.01 * (k % 7)) if wide else 0.0,
        )
        for k in count
    ]


def _upright(places: Sequence[Point], edges: Sequence[tuple[int, int]]) -> list[Point]:
    """Returns the places turned so that as many edges as possible run along an axis."""
    turn = 0j
    for a, b in edges:
        way = complex(places[b][0] - places[a][0], places[b][1] - places[a][1])
        if abs(way) > 1e-9:
            turn += (way / abs(way)) ** 4  # the same for all four directions along the axes
    angle = phase(turn) / 4 if abs(turn) > 1e-9 else 0.0
    c, s = cos(angle), sin(angle)
    return [(c * x + s * y, c * y - s * x) for x, y in places]


def _pulled(k: int, places: Sequence[Point], wanted: Sequence[float]) -> Point:
    """Returns the place that the others pull a node to: each at its ideal distance,
    near ones count more.
    """
    x, y = places[k]
    sum_x = sum_y = weight = 0.0
    for j, (ox, oy) in enumerate(places):
        if j == k:
            continue
        away = hypot(x - ox, y - oy)
        part = wanted[j] / away if away > 1e-9 else 0.0
        share = 1.0 / (wanted[j] * wanted[j])
        sum_x += share * (ox + part * (x - ox))
        sum_y += share * (oy + part * (y - oy))
        weight += share
    return (sum_x / weight, sum_y / weight) if weight else (x, y)
