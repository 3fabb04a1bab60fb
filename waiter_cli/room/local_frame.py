"""Coordinates of a layout, counted from a point near the restaurant. Entry points `near_origin` and `to_local`.

Coordinates may be as large as UTM has them, and there a float of 64 bits is known to a nanometre
only, one of 32 bits, as physics and renderers use, to half a metre.  Whatever is measured or drawn
is therefore measured from a round point nearby.
"""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.model.layout import Layout, Point

__all__ = ["near_origin", "to_local"]

ROUND = 100.0
"""Metres: the new origin is a multiple of it both ways, so a room about (0, 0) stays where it is."""
DIGITS = 6
"""Decimals of a metre that are kept of what moves."""


def near_origin(layout: Layout) -> Point:
    """Returns a point at most 50 m, either way, from the middle of the nodes; (0, 0) where that is one."""
    places = [node.at for node in layout.nodes if node.at is not None]
    if not places:
        return 0.0, 0.0
    x, y = (_round_middle([at[axis] for at in places]) for axis in (0, 1))
    return x, y


def to_local(layout: Layout, origin: Point) -> Layout:
    """Returns the layout with coordinates from ``origin`` on; the same one where that is (0, 0).

    What moves is rounded to a micrometre: a layout and its copy far away become the same.

    >>> from waiter_cli.model.layout import Node
    >>> nodes = (Node("a", (500000.1, 5400001.0)), Node("b", (500003.3, 5400001.0)))
    >>> hall = Layout("hall", nodes, (), "a", (), "b")
    >>> near_origin(hall)
    (500000.0, 5400000.0)
    >>> [node.at for node in to_local(hall, near_origin(hall)).nodes]
    [(0.1, 1.0), (3.3, 1.0)]
    """
    x0, y0 = origin
    if x0 == y0 == 0.0:
        return layout

    def moved(at: Point) -> Point:
        return round(at[0] - x0, DIGITS), round(at[1] - y0, DIGITS)

    bar = layout.bar
    if bar is not None and bar.corners is not None:
        bar = replace(bar, corners=(moved(bar.corners[0]), moved(bar.corners[1])))
    return replace(
        layout,
        nodes=tuple(replace(n, at=moved(n.at)) if n.at else n for n in layout.nodes),
        tables=tuple(replace(t, at=moved(t.at)) if t.at else t for t in layout.tables),
        bar=bar,
        walls=tuple((moved(a), moved(b)) for a, b in layout.walls),
    )


def _round_middle(values: list[float]) -> float:
    return ROUND * round((min(values) + max(values)) / 2 / ROUND)
