"""Gives a thing another name in the text of a layout, everywhere it is named. Entry point `with_name`."""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.editing.sketch import sketch
from waiter_cli.editing.spans import Piece, pieces_of
from waiter_cli.editing.splices import applied, renamed
from waiter_cli.errors import InputError
from waiter_cli.yaml_reading.node_reader import NAME_RULE, RESERVED, is_identifier

__all__ = ["require_new", "with_name"]


def with_name(text: str, what: str, name: str) -> str:
    """Returns the text in which ``what`` (``node n5``, ``table t``, ``waiter w1``) has another name.

    Raises `InputError` for a name that is none or is taken.
    """
    kind, _, old = what.partition(" ")
    if kind not in _PLACES or what == "robot agent":
        raise InputError(f"{what} has no name of its own")
    if name == old:
        return text
    require_new(text, name)
    root = pieces_of(text)
    assert root is not None
    named = [piece for piece in _PLACES[kind](root) if piece.text == old]
    return applied(text, [renamed(text, piece, name) for piece in named])


def require_new(text: str, name: object) -> str:
    """Returns a name that nothing has yet; raises `InputError` where it is none or is taken."""
    if not isinstance(name, str) or not is_identifier(name) or name in RESERVED:
        raise InputError(f"{str(name)[:40]} is no name", NAME_RULE)
    drawn = sketch(text)
    if name in {*drawn.nodes, *drawn.tables, *drawn.staff, *drawn.robots}:
        raise InputError(f"{name} is there already", "names are given once")
    return name


def _keys(piece: Piece | None) -> Iterator[Piece]:
    yield from (key for key, _ in (piece.entries if piece else ()))


def _of_tables(root: Piece) -> Iterator[Piece]:
    return _keys(root.get("tables"))


def _of_waiters(root: Piece) -> Iterator[Piece]:
    yield from _keys(root.get("waiters"))
    yield from _keys(root.get("timetable"))


def _of_robots(root: Piece) -> Iterator[Piece]:
    return _keys(root.get("agents"))


def _listed(piece: Piece | None) -> Iterator[Piece]:
    if piece is not None:
        yield from piece.items or (piece,)


def _of_nodes(root: Piece) -> Iterator[Piece]:
    nodes = root.get("nodes")
    yield from _keys(nodes)
    yield from nodes.items if nodes else ()
    edges = root.get("edges")
    for edge in edges.items if edges else ():
        yield from edge.items
        yield from (value for _, value in edge.entries)
    tables = root.get("tables")
    for _, table in tables.entries if tables else ():
        yield from _listed(table.get("nodes"))
    yield from (piece for key in ("entrance", "agent") if (piece := root.get(key)) is not None)
    for key in ("agents", "waiters"):
        section = root.get(key)
        yield from (value for _, value in (section.entries if section else ()))
    bar = root.get("bar")
    if bar is not None:
        yield from _listed(bar.get("nodes") if bar.kind == "map" else bar)
    timetable = root.get("timetable")
    for _, own in timetable.entries if timetable else ():
        yield from (value for _, value in own.entries)


_PLACES = {"node": _of_nodes, "table": _of_tables, "waiter": _of_waiters, "robot": _of_robots}
"""For each kind of thing all the places in a text where one of its kind is named."""
