"""Deletes a thing from the text of a layout, wherever it is named. Entry point `without_thing`."""

from __future__ import annotations

from math import hypot

from waiter_cli.editing.sketch import sketch
from waiter_cli.editing.spans import Piece, pieces_of
from waiter_cli.editing.splices import applied, new_value, renamed, without_entry, without_item
from waiter_cli.errors import InputError

__all__ = ["without_thing"]

_KEPT = ("nodes", "edges", "tables")
"""Sections that a layout must have, empty or not."""


def without_thing(text: str, what: str) -> str:
    """Returns the text without a thing, named as on the floor; without what cannot be without it, too.

    Of a node go its paths and who stands there; a table, the entrance and the robot that had only
    that node get the nearest one that is left.  Deleting what is not there changes nothing.
    """
    kind, _, name = what.partition(" ")
    if kind == "node":
        return _without_node(text, name)
    if kind == "table":
        return _without_entry(text, "tables", name)
    if kind == "path":
        return _without_path(text, *name.split(" "))
    if kind == "wall":
        return _without_item(text, "walls", int(name) - 1)
    if kind == "waiter":
        return _without_entry(_without_entry(text, "waiters", name), "timetable", name)
    if kind == "objects":
        root = _root(text)
        there = root.get("objects") is not None
        return applied(text, [without_entry(text, root, "objects")]) if there else text
    if kind == "bar":
        for key in ("objects", "bar"):
            root = _root(text)
            if root.get(key) is not None:
                text = applied(text, [without_entry(text, root, key)])
        return text
    if kind == "robot" and name != "agent" and len(sketch(text).robots) > 1:
        return _without_entry(text, "agents", name)
    raise InputError("a restaurant needs its robot", "move it instead")


def _root(text: str) -> Piece:
    root = pieces_of(text)
    return root if root is not None else Piece("map", 0, 0)


def _without_entry(text: str, section: str, name: str) -> str:
    root = _root(text)
    found = root.get(section)
    if found is None or found.get(name) is None:
        return text
    if len(found.entries) == 1 and section not in _KEPT:
        return applied(text, [without_entry(text, root, section)])
    return applied(text, [without_entry(text, found, name, root.key(section))])


def _without_item(text: str, section: str, index: int) -> str:
    root = _root(text)
    found = root.get(section)
    if found is None or not 0 <= index < len(found.items):
        return text
    if len(found.items) == 1 and section not in _KEPT:
        return applied(text, [without_entry(text, root, section)])
    return applied(text, [without_item(text, found, index, root.key(section))])


def _ends(item: Piece) -> list[str]:
    if item.kind == "map":
        return [value.text for _, value in item.entries]
    return [end.text for end in item.items]


def _without_path(text: str, a: str, b: str) -> str:
    edges = _root(text).get("edges")
    for index, item in enumerate(edges.items if edges else ()):
        if sorted(_ends(item)) == sorted((a, b)):
            return _without_item(text, "edges", index)
    return text


def _without_node(text: str, name: str) -> str:
    drawn = sketch(text)
    if name not in drawn.nodes:
        return text
    heir = _heir(text, name)
    edges = _root(text).get("edges")
    for index in reversed(range(len(edges.items) if edges else 0)):
        assert edges is not None
        if name in _ends(edges.items[index]):
            text = _without_item(text, "edges", index)
    for waiter, node in drawn.staff.items():
        if node == name:
            text = without_thing(text, f"waiter {waiter}")
    text = _out_of_timetable(text, name)
    for table, known in drawn.tables.items():
        if name in known.nodes:
            text = _out_of_list(text, ("tables", table, "nodes"), name, heir)
    if drawn.bar is not None and name in drawn.bar:
        text = _out_of_list(text, ("bar",), name, heir)
    for key in ("entrance", "agent"):
        piece = _root(text).get(key)
        if piece is not None and piece.text == name and heir:
            text = applied(text, [renamed(text, piece, heir)])
    agents = _root(text).get("agents")
    for _, value in agents.entries if agents else ():
        if value.text == name and heir:
            text = applied(text, [renamed(text, value, heir)])
    root = _root(text)
    nodes = root["nodes"]
    if nodes.kind == "map":
        return applied(text, [without_entry(text, nodes, name, root.key("nodes"))])
    index = [item.text for item in nodes.items].index(name)
    return applied(text, [without_item(text, nodes, index, root.key("nodes"))])


def _heir(text: str, name: str) -> str | None:
    """Returns the nearest other node, one where nobody stands if there is one; None where none is left."""
    drawn = sketch(text)
    x, y = drawn.nodes[name] or (0.0, 0.0)
    taken = {*drawn.staff.values(), *drawn.robots.values()}

    def farness(other: str) -> tuple[bool, float]:
        at = drawn.nodes[other] or (x, y)
        return other in taken, hypot(at[0] - x, at[1] - y)

    return min((other for other in drawn.nodes if other != name), key=farness, default=None)


def _out_of_list(text: str, keys: tuple[str, ...], name: str, heir: str | None) -> str:
    """Takes a node out of a list of nodes; the heir is there in its place if it was the only one."""
    piece = _root(text)
    owner = None
    for key in keys:
        owner, piece = piece.key(key), piece[key]
    if keys == ("bar",) and piece.kind == "map":
        owner, piece = piece.key("nodes"), piece["nodes"]
    if piece.kind == "scalar":
        return applied(text, [renamed(text, piece, heir)]) if heir else text
    names = [item.text for item in piece.items]
    if names == [name]:
        if heir is None:
            return applied(text, [new_value(text, piece, [])])
        return applied(text, [renamed(text, piece.items[0], heir)])
    return applied(text, [without_item(text, piece, names.index(name), owner)])


def _out_of_timetable(text: str, node: str) -> str:
    while True:
        root = _root(text)
        whole = root.get("timetable")
        found = next(
            (
                (name.text, step.text)
                for name, own in (whole.entries if whole else ())
                for step, place in own.entries
                if place.text == node
            ),
            None,
        )
        if whole is None or found is None:
            return text
        own = whole[found[0]]
        if len(own.entries) > 1:
            text = applied(text, [without_entry(text, own, found[1], whole.key(found[0]))])
        else:
            text = _without_entry(text, "timetable", found[0])
