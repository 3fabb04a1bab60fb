"""Edits of a layout's text: ``{"do": NAME, …}`` → the text after it. Entry points `edited_text`, `EDITS`.

Things bear the accessible names of the floor: ``node n5``, ``table table1``, ``path n4 n5``, ``wall 1``,
``bar``, ``robot agent``, ``waiter w1``.  Places are metres, as the file has them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import hypot, isfinite
from typing import Any

from waiter_cli.editing.adding import (
    fresh_name,
    next_to,
    with_bar,
    with_node,
    with_path,
    with_robot,
    with_table,
    with_waiter,
    with_wall,
)
from waiter_cli.editing.removing import without_thing
from waiter_cli.editing.renaming import require_new, with_name
from waiter_cli.editing.sketch import sketch
from waiter_cli.editing.spans import Piece, pieces_of
from waiter_cli.editing.splices import (
    Splice,
    applied,
    new_entry,
    new_number,
    new_value,
    renamed,
    without_entry,
)
from waiter_cli.errors import InputError

__all__ = ["EDITS", "edited_text"]

Given = dict[str, Any]
MOST_METRES = 1e7


def edited_text(text: str, edits: Sequence[Given]) -> tuple[str, str]:
    """Returns the text after edits, one after the other, and the name of the thing added last.

    Raises `InputError` for an edit that cannot be, or for a text that it cannot be done in; nothing
    of what is passed is changed then.
    """
    added = ""
    for given in edits:
        edit = EDITS.get(given.get("do", "")) if isinstance(given, dict) else None
        if edit is None:
            raise InputError("there is no such edit", f"edits are {', '.join(EDITS)}")
        try:
            text, named = edit(text, given)
        except (KeyError, IndexError, StopIteration):
            raise InputError("what is to be changed is not in the text") from None
        except (AttributeError, OverflowError, TypeError, ValueError):
            raise InputError(f"the edit {given['do']} lacks something it needs") from None
        added = named or added
        pieces_of(text)
    return text, added


def _root(text: str) -> Piece:
    found = pieces_of(text)
    if found is None or found.kind != "map":
        raise InputError("the text is no layout", "a layout begins with nodes, edges and tables")
    return found


def _metres(value: Any) -> float:
    number = float(value)
    if not isfinite(number) or abs(number) > MOST_METRES:
        raise InputError("a place must be a number of metres")
    return number


def _point(value: Any) -> tuple[float, float]:
    x, y = value
    return round(_metres(x), 3), round(_metres(y), 3)


def _strings(value: Any) -> list[str]:
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        raise ValueError
    return value


# -- moving ---------------------------------------------------------------------------------


def _move(text: str, given: Given) -> tuple[str, str]:
    """Moves nodes, tables, walls and the bar: ``what`` is a list of things, ``by`` [x, y]."""
    dx, dy = _point(given["by"])
    splices: list[Splice] = []
    for what in dict.fromkeys(_strings(given["what"])):
        splices += _moved(text, what, dx, dy, given.get("drawn") or {})
    return applied(text, splices), ""


def _moved(text: str, what: str, dx: float, dy: float, drawn: Given) -> list[Splice]:
    root = _root(text)
    kind, _, name = what.partition(" ")
    if kind == "node":
        return _shifted(text, root["nodes"][name], dx, dy)
    if kind == "wall":
        ends = root["walls"].items[int(name) - 1].items
        return [splice for end in ends for splice in _shifted(text, end, dx, dy)]
    if kind == "bar":
        bar = root["bar"]
        if bar.get("from") is not None and bar.get("to") is not None:
            return [splice for key in ("from", "to") for splice in _shifted(text, bar[key], dx, dy)]
        x, y, half_x, half_y = (_metres(value) for value in drawn["bar"][:4])
        corners = ([x - half_x + dx, y - half_y + dy], [x + half_x + dx, y + half_y + dy])
        ends_ = {key: [round(v, 3) for v in at] for key, at in zip(("from", "to"), corners)}
        return [_with_corners(text, root, ends_)]
    if kind == "table":
        table = root["tables"][name]
        at = table.get("at")
        if at is not None:
            return _shifted(text, at, dx, dy)
        x, y = _point(drawn[what][:2])
        return [new_entry(text, table, "at", [round(x + dx, 3), round(y + dy, 3)])]
    raise InputError(f"{what} stands where its node is", "give it another node")


def _with_corners(text: str, root: Piece, ends: dict[str, list[float]]) -> Splice:
    bar = root["bar"]
    if bar.kind == "map":
        whole: dict[str, Any] = {"nodes": [item.text for item in bar["nodes"].items]}
    else:
        whole = {"nodes": [item.text for item in bar.items] or [bar.text]}
    return new_value(text, bar, {**whole, **ends})


def _shifted(text: str, point: Piece, dx: float, dy: float) -> list[Splice]:
    x, y = point.items
    return [
        *new_number(x, round(float(x.text) + dx, 3)),
        *new_number(y, round(float(y.text) + dy, 3)),
    ]


def _place(text: str, given: Given) -> tuple[str, str]:
    """Puts a node or a table, or an end (``end`` 0 or 1) of a wall, at a place."""
    at = _point(given["at"])
    root = _root(text)
    kind, _, name = str(given["what"]).partition(" ")
    if kind == "wall":
        point = root["walls"].items[int(name) - 1].items[int(given["end"])]
    elif kind == "node":
        point = root["nodes"][name]
    else:
        table = root["tables"][name]
        found = table.get("at")
        if found is None:
            return applied(text, [new_entry(text, table, "at", list(at))]), ""
        point = found
    x, y = point.items
    return applied(text, [*new_number(x, at[0]), *new_number(y, at[1])]), ""


# -- what belongs to a thing -------------------------------------------------------------------


def _set(text: str, given: Given) -> tuple[str, str]:
    """Sets ``capacity``, ``chairs``, ``size``, ``at`` or ``nodes`` of a table, or ``nodes`` of the bar."""
    kind, _, name = str(given["what"]).partition(" ")
    key, value = str(given["key"]), given["value"]
    if key in ("capacity", "chairs"):
        value = int(value)
    elif key in ("size", "at"):
        value = list(_point(value))
    elif key == "nodes":
        value = _known(text, value)
    else:
        raise InputError(f"{key} cannot be set")
    root = _root(text)
    if kind == "bar":
        bar = root["bar"]
        piece = bar["nodes"] if bar.kind == "map" else bar
        return applied(text, [new_value(text, piece, value)]), ""
    table = root["tables"][name]
    piece_ = table.get(key)
    if piece_ is None:
        return applied(text, [new_entry(text, table, key, value)]), ""
    if key in ("size", "at") and len(piece_.items) == 2:
        x, y = piece_.items
        return applied(text, [*new_number(x, value[0]), *new_number(y, value[1])]), ""
    splices = [new_value(text, piece_, value)]
    chairs = table.get("chairs")
    if key == "capacity" and chairs is not None and int(chairs.text) > value:
        splices.append(new_value(text, chairs, value))
    return applied(text, splices), ""


def _turn(text: str, given: Given) -> tuple[str, str]:
    """Turns a table by a right angle: the lengths of its sides change places."""
    kind, _, name = str(given["what"]).partition(" ")
    size = _root(text)["tables"][name].get("size")
    if kind != "table" or size is None or size.items[0].text == size.items[1].text:
        return text, ""
    x, y = size.items
    return applied(text, [Splice(x.start, x.end, y.text), Splice(y.start, y.end, x.text)]), ""


def _stand(text: str, given: Given) -> tuple[str, str]:
    """Puts the robot or a waiter on a node, or the entrance."""
    kind, _, name = str(given["what"]).partition(" ")
    root, node = _root(text), str(given["node"])
    if node not in sketch(text).nodes:
        raise InputError(f"there is no node {node}")
    if kind == "waiter":
        piece = root["waiters"][name]
    elif kind == "robot" and name != "agent":
        piece = root["agents"][name]
    else:
        key = "agent" if kind == "robot" else "entrance"
        found = root.get(key)
        if found is None:
            return applied(text, [new_entry(text, root, key, node)]), ""
        piece = found
    return applied(text, [renamed(text, piece, node)]), ""


def _one_way(text: str, given: Given) -> tuple[str, str]:
    """Lets a path lead one way (``from`` its node) or, with ``from`` null, both ways."""
    a, b = _path_ends(given["what"])
    root = _root(text)
    for item in root["edges"].items:
        if item.kind == "map":
            ends = [item["from"].text, item["to"].text]
        else:
            ends = [end.text for end in item.items]
        if sorted(ends) == sorted((a, b)):
            start = given["from"]
            if start is None:
                value: Any = ends
            elif start in ends:
                value = {"from": start, "to": ends[1] if start == ends[0] else ends[0]}
            else:
                raise ValueError
            return applied(text, [new_value(text, item, value)]), ""
    raise KeyError(given["what"])


def _path_ends(what: Any) -> tuple[str, str]:
    kind, a, b = str(what).split(" ")
    if kind != "path":
        raise ValueError
    return a, b


def _timetable(text: str, given: Given) -> tuple[str, str]:
    """Sends a waiter to a node from a step on; ``node`` null takes the entry out."""
    _, _, name = str(given["what"]).partition(" ")
    step, node = str(int(given["step"])), given["node"]
    if node is not None:
        _known(text, [node])
    root = _root(text)
    whole = root.get("timetable")
    own = whole.get(name) if whole is not None else None
    if node is None:
        if whole is None or own is None:
            raise KeyError(name)
        if len(own.entries) > 1:
            return applied(text, [without_entry(text, own, step, whole.key(name))]), ""
        if len(whole.entries) > 1:
            return applied(text, [without_entry(text, whole, name, root.key("timetable"))]), ""
        return applied(text, [without_entry(text, root, "timetable")]), ""
    if whole is None:
        splice = new_entry(text, root, "timetable", {name: {step: node}})
    elif own is None:
        splice = new_entry(text, whole, name, {step: node}, root.key("timetable"))
    elif own.get(step) is not None:
        splice = renamed(text, own[step], str(node))
    else:
        splice = new_entry(text, own, step, node, whole.key(name))
    return applied(text, [splice]), ""


# -- adding, renaming, deleting ------------------------------------------------------------------


def _new_name(text: str, given: Given, stem: str) -> str:
    """Returns the name that was given for a new thing, or a fresh one; raises `InputError` as renaming does."""
    return require_new(text, given["name"]) if given.get("name") else fresh_name(text, stem)


def _known(text: str, value: Any) -> list[str]:
    """Returns names of nodes that are there; raises `InputError` for others."""
    names, nodes = _strings(value), sketch(text).nodes
    for name in names:
        if name not in nodes:
            raise InputError(f"there is no node {name[:40]}")
    return names


def _add_node(text: str, given: Given) -> tuple[str, str]:
    """Adds a node; ``joined`` to a node by a path, where that is given."""
    name = _new_name(text, given, "n")
    text = with_node(text, name, _point(given["at"]))
    if given.get("joined"):
        text = with_path(text, str(given["joined"]), name)
    return text, f"node {name}"


def _add_path(text: str, given: Given) -> tuple[str, str]:
    a, b = _strings(given["ends"])
    return with_path(text, a, b), f"path {a} {b}"


def _add_table(text: str, given: Given) -> tuple[str, str]:
    name, at = _new_name(text, given, "table"), _point(given["at"])
    nodes = _known(text, given["nodes"]) if given.get("nodes") else [next_to(text, at)]
    return with_table(text, name, int(given.get("capacity", 2)), nodes, at), f"table {name}"


def _add_wall(text: str, given: Given) -> tuple[str, str]:
    start, end = _point(given["from"]), _point(given["to"])
    if hypot(end[0] - start[0], end[1] - start[1]) < 0.05:
        raise InputError("a wall needs two ends")
    return with_wall(text, start, end)


def _add_bar(text: str, given: Given) -> tuple[str, str]:
    return with_bar(text, _point(given["from"]), _point(given["to"])), "bar"


def _add_waiter(text: str, given: Given) -> tuple[str, str]:
    name = _new_name(text, given, "w")
    return with_waiter(text, name, str(given["node"])), f"waiter {name}"


def _add_robot(text: str, given: Given) -> tuple[str, str]:
    """Adds a robot; the first one of several, where there was one, is named, too."""
    name = require_new(text, given["name"]) if given.get("name") else None
    return with_robot(text, str(given["node"]), name)


def _rename(text: str, given: Given) -> tuple[str, str]:
    what, name = str(given["what"]), str(given["name"]).strip()
    return with_name(text, what, name), f"{what.split(' ')[0]} {name}"


def _delete(text: str, given: Given) -> tuple[str, str]:
    """Deletes things; walls from the last on, since those after one that goes are numbered anew."""
    wanted = list(dict.fromkeys(_strings(given["what"])))
    numbered = [what for what in wanted if what.startswith("wall ")]
    others = [what for what in wanted if what not in numbered]
    order = sorted(others, key=lambda what: what.startswith("node "))
    for what in [*order, *sorted(numbered, key=lambda w: -int(w.split()[1]))]:
        text = without_thing(text, what)
    return text, ""


EDITS: dict[str, Callable[[str, Given], tuple[str, str]]] = {
    "move": _move,
    "place": _place,
    "set": _set,
    "turn": _turn,
    "stand": _stand,
    "one_way": _one_way,
    "timetable": _timetable,
    "add_node": _add_node,
    "add_path": _add_path,
    "add_table": _add_table,
    "add_wall": _add_wall,
    "add_bar": _add_bar,
    "add_waiter": _add_waiter,
    "add_robot": _add_robot,
    "rename": _rename,
    "delete": _delete,
}
