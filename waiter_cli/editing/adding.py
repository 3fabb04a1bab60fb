"""Adds things to the text of a layout. Entry points are the functions ``with_…``."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from math import hypot
from typing import Any

from waiter_cli.editing.sketch import sketch
from waiter_cli.editing.spans import Piece, pieces_of
from waiter_cli.editing.splices import applied, new_entry, new_item, new_value, renamed, written
from waiter_cli.errors import InputError

__all__ = [
    "fresh_name",
    "next_to",
    "with_bar",
    "with_node",
    "with_path",
    "with_robot",
    "with_table",
    "with_waiter",
    "with_wall",
]

Place = tuple[float, float]


def fresh_name(text: str, stem: str) -> str:
    """Returns a name that nothing has: the stem and a number.

    >>> fresh_name("nodes: {n1: [0, 0]}", "n")
    'n2'
    """
    return next(_fresh_names(text, stem))


def _fresh_names(text: str, stem: str) -> Iterator[str]:
    """Yields names that nothing has."""
    drawn = sketch(text)
    taken = {*drawn.nodes, *drawn.tables, *drawn.staff, *drawn.robots}
    return (name for k in count(1) if (name := f"{stem}{k}") not in taken)


def next_to(text: str, at: Place) -> str:
    """Returns the node nearest to a place; raises `InputError` where there is none."""
    placed = {name: where for name, where in sketch(text).nodes.items() if where is not None}
    if not placed:
        raise InputError("there is no node to reach it from", "add a node first")
    return min(placed, key=lambda n: hypot(placed[n][0] - at[0], placed[n][1] - at[1]))


def with_node(text: str, name: str, at: Place) -> str:
    """Adds a node; the first of all is the entrance, and the robot starts on it."""
    first = not sketch(text).nodes
    text = _with(text, "nodes", name, list(at))
    if first:
        for key in ("entrance", "agent"):
            root = pieces_of(text)
            assert root is not None
            if root.get(key) is None and not (key == "agent" and root.get("agents")):
                text = applied(text, [new_entry(text, root, key, name)])
            elif root.get(key) is not None:
                text = applied(text, [new_value(text, root[key], name)])
    return text


def with_path(text: str, a: str, b: str) -> str:
    """Adds a path between two nodes, which lies there not yet."""
    drawn = sketch(text)
    if a == b or a not in drawn.nodes or b not in drawn.nodes:
        raise InputError("a path joins two nodes")
    if any({a, b} == {x, y} for x, y, _ in drawn.paths):
        raise InputError(f"there is a path between {a} and {b} already")
    return _with_item(text, "edges", [a, b])


def with_table(text: str, name: str, capacity: int, nodes: list[str], at: Place) -> str:
    """Adds a table that is reached from nodes."""
    return _with(text, "tables", name, {"capacity": capacity, "nodes": nodes, "at": list(at)})


def with_wall(text: str, start: Place, end: Place) -> tuple[str, str]:
    """Adds a wall; returns its name, too."""
    text = _with_item(text, "walls", [list(start), list(end)])
    return text, f"wall {len(sketch(text).walls)}"


def with_bar(text: str, start: Place, end: Place) -> str:
    """Draws the bar from corner to corner; where there is none it gets the nearest node."""
    root = _root(text)
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    bar = root.get("bar")
    nodes = list(sketch(text).bar or (next_to(text, middle),))
    value: dict[str, Any] = {"nodes": nodes, "from": list(start), "to": list(end)}
    if bar is None:
        return applied(text, [new_entry(text, root, "bar", value)])
    return applied(text, [new_value(text, bar, value)])


def with_waiter(text: str, name: str, node: str) -> str:
    """Adds a colleague who stands on a node, which nobody else does."""
    _require_free(text, node)
    return _with(text, "waiters", name, node)


def with_robot(text: str, node: str, name: str | None = None) -> tuple[str, str]:
    """Adds a robot that starts on a node, where nobody else stands; returns its name, too.

    The single ``agent: n1`` becomes the first of ``agents``, named as nothing is; only the key and its
    value are written anew.
    """
    _require_free(text, node)
    root = _root(text)
    single = root.get("agent")
    free = (each for each in _fresh_names(text, "r") if each != name)
    if single is None or single.is_nothing or root.get("agents") is not None:
        name = name or next(free)
        return _with(text, "agents", name, node), f"robot {name}"
    first = next(free)
    name = name or next(free)
    robots = {first: single.text, name: node}
    key = renamed(text, root.key("agent"), "agents")
    return applied(text, [key, new_value(text, single, robots)]), f"robot {name}"


def _require_free(text: str, node: str) -> None:
    """Raises `InputError` where there is no such node, or somebody stands on it."""
    drawn = sketch(text)
    if node not in drawn.nodes:
        raise InputError(f"there is no node {node}")
    if node in (*drawn.staff.values(), *drawn.robots.values()):
        raise InputError(f"somebody stands on {node} already", "give each a node of its own")


def _root(text: str) -> Piece:
    root = pieces_of(text)
    if root is None:
        return Piece("map", 0, 0)
    if root.kind != "map":
        raise InputError("the text is no layout", "a layout begins with nodes, edges and tables")
    return root


def _with(text: str, section: str, key: str, value: Any) -> str:
    """Adds an entry to a section of the root, and the section where it is not there."""
    root = _root(text)
    found = root.get(section)
    if found is not None:
        return applied(text, [new_entry(text, found, key, value, root.key(section))])
    return _with_section(text, root, section, {key: value}, f"  {key}: {written(text, value)}")


def _with_item(text: str, section: str, value: Any) -> str:
    root = _root(text)
    found = root.get(section)
    if found is not None:
        return applied(text, [new_item(text, found, value, root.key(section))])
    return _with_section(text, root, section, [value], f"  - {written(text, value)}")


def _with_section(text: str, root: Piece, section: str, value: Any, line: str) -> str:
    if not root.entries:
        kept = text if not text or text.endswith("\n") or root.flow else text + "\n"
        if root.flow:
            return applied(text, [new_entry(text, root, section, value)])
        return f"{kept}{section}:\n{line}\n"
    if root.flow:
        return applied(text, [new_entry(text, root, section, value)])
    newline = "\r\n" if "\r\n" in text else "\n"
    splice = new_entry(text, root, section, 0)
    new = splice.new.replace(f"{section}: 0", f"{section}:{newline}{line}")
    return applied(text, [splice._replace(new=new)])
