"""Changes of a layout that are worth a look: edges, moves and swaps, and what limits them."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from time import monotonic

import pytest

from sparc import limits
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.layout_changes import ChangesEnded, changes, passed
from waiter_cli.model.layout import Layout

SQUARE = """\
nodes: {a: [0, 0], b: [4, 0], c: [4, 4], d: [0, 4]}
edges: [[a, b], [b, c], [c, d]]
entrance: a
agent: a
tables:
  one: {capacity: 2, nodes: [b], at: [6, 0]}
  two: {capacity: 4, nodes: [c], at: [6, 4]}
"""


def square(**more: object) -> Layout:
    return replace(read_layout(SQUARE, "f.yaml"), **more)  # type: ignore[arg-type]


def texts(layout: Layout, used: set[str] | None = None, **more: object) -> list[str]:
    return [change.text for change in changes(layout, used, **more)]  # type: ignore[arg-type]


def test_every_kind_of_change_is_looked_at() -> None:
    assert texts(square()) == [
        "add the edge a-c", "add the edge a-d", "add the edge b-d",
        "move one to d", "move two to d", "swap one and two",
    ]  # fmt: skip


def test_one_kind_alone() -> None:
    assert {text.split()[0] for text in texts(square(), tables=False)} == {"add"}
    assert {text.split()[0] for text in texts(square(), edges=False)} == {"move", "swap"}


def test_only_tables_that_are_used_are_moved() -> None:
    assert texts(square(), {"two"}, edges=False) == ["move two to d", "swap one and two"]
    assert texts(square(), set(), edges=False) == []


def test_a_change_is_made_in_its_layout() -> None:
    made = {change.text: change for change in changes(square(), None)}
    edge, move, swap = (made[t] for t in ("add the edge a-d", "move one to d", "swap one and two"))
    assert edge.edge == ("a", "d") and edge.layout.leads("d", "a") and edge.kind == "edge"
    moved = move.layout.table("one")
    assert moved.nodes == ("d",) and moved.at != square().table("one").at
    assert move.tables == ("one",) and move.layout.table("two") == square().table("two")
    one, two = swap.layout.tables
    assert (one.nodes, two.nodes) == (("c",), ("b",)) and (one.capacity, two.capacity) == (2, 4)


def test_an_edge_past_a_third_node_or_through_furniture_is_no_way() -> None:
    text = SQUARE.replace("b: [4, 0]", "b: [2, 2]")
    assert "add the edge a-c" not in texts(read_layout(text, "f.yaml"), tables=False)
    walled = square(walls=(((-2.0, 2.0), (2.0, 2.0)),))
    assert "add the edge a-d" not in texts(walled, tables=False)


def test_without_coordinates_edges_join_what_is_two_or_three_apart() -> None:
    text = (
        "nodes: [a, b, c, d, e, f]\nedges: [[a, b], [b, c], [c, d], [d, e]]\nentrance: a\n"
        "agent: a\ntables: {t: {capacity: 2, nodes: [e]}}\n"
    )
    found = texts(read_layout(text, "f.yaml"), tables=False)
    assert "add the edge a-c" in found and "add the edge a-d" in found
    assert "add the edge a-e" not in found
    assert "add the edge a-f" in found, "what no edge leads to is joined to anything"


def test_time_that_is_over_ends_it() -> None:
    with pytest.raises(ChangesEnded) as caught:
        list(changes(square(), None, end=monotonic() - 1))
    assert caught.value.limit == "time"
    assert passed(monotonic() - 1) == "time" and passed(inf) == ""


def test_memory_that_is_used_up_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "reached", lambda: "memory")
    with pytest.raises(ChangesEnded) as caught:
        list(changes(square(), None, edges=False))
    assert caught.value.limit == "memory"
