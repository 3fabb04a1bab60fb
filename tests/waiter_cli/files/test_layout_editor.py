"""Layouts with one change: all that the change is not about stays, to the letter."""

from __future__ import annotations

import difflib
import random
from dataclasses import replace

import pytest

from waiter_cli.files.layout_editor import edited
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.layout_writer import flow, write_layout
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.layout_tools.improve import changes
from waiter_cli.model.layout import Layout
from waiter_cli.room.coordinates import place

CAFE = """\
# A small café.
name: café   # by the river
nodes: {a: [0, 0], b: [2, 0], c: [4, 0]}
edges:
  - [a, b]   # past the door
  - [b, c]   # to the window

entrance: a
agent: a
tables:
  t1: {capacity: 2, nodes: [c], at: [4, 1.5]}   # the quiet one
  t2:
    nodes: [b]
    at: [2, 1.5]
    capacity: 4
"""


def layout(text: str) -> Layout:
    return read_layout(text, "cafe.yaml")


def with_edge(text: str) -> tuple[str | None, list[str]]:
    """The text with one edge more, and the lines in which it differs."""
    before = layout(text)
    new = edited(text, before, replace(before, edges=(*before.edges, ("a", "c")), edge_where=()))
    if new is None:
        return None, []
    told = difflib.ndiff(text.splitlines(), new.splitlines())
    return new, [line for line in told if line[0] in "+-"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (CAFE, ["+   - [a, c]"]),
        (CAFE.replace("  - [", "- ["), ["+ - [a, c]"]),
        (CAFE.replace("\n", "\r\n"), ["+   - [a, c]"]),
        (
            CAFE.replace("edges:\n  - [a, b]   # past the door\n  - [b, c]   # to the window\n",
                         "edges: [[a, b],  # here\n  [b, c]]\n"),
            ["-   [b, c]]", "+   [b, c], [a, c]]"],
        ),
    ],
    ids=["block", "no indent", "line ends of Windows", "brackets"],
)  # fmt: skip
def test_an_edge_is_one_line(text: str, expected: list[str]) -> None:
    new, told = with_edge(text)
    assert new is not None and told == expected
    assert ("\r\n" in new) == ("\r\n" in text) and new.count("\r\n") in (0, new.count("\n"))


def test_tables_move_and_their_comments_stay() -> None:
    before = layout(CAFE)
    one, two = before.tables
    new = edited(CAFE, before, replace(before, tables=(
        replace(one, nodes=two.nodes, at=two.at), replace(two, nodes=one.nodes, at=one.at),
    )))  # fmt: skip
    assert new == (
        CAFE.replace("nodes: [c], at: [4, 1.5]", "nodes: [b], at: [2.0, 1.5]")
        .replace("    nodes: [b]\n    at: [2, 1.5]", "    nodes: [c]\n    at: [4.0, 1.5]")
    )  # fmt: skip


@pytest.mark.parametrize(
    "text",
    [
        CAFE.replace("  - [b, c]   # to the window", "  -\n    - b\n    - c"),
        CAFE.replace("  - [a, b]   # past the door\n  - [b, c]   # to the window", "  []"),
    ],
    ids=["an item over lines", "no edges yet"],
)
def test_what_has_no_place_for_it_is_left_to_be_written_whole(text: str) -> None:
    assert with_edge(text) == (None, [])


def test_a_table_without_a_place_gets_none_in_its_text() -> None:
    text = CAFE.replace(", at: [4, 1.5]", "")
    before = layout(text)
    one, two = before.tables
    moved = replace(before, tables=(replace(one, nodes=("a",), at=(0.0, 1.5)), two))
    assert edited(text, before, moved) is None


def test_another_change_is_no_edit() -> None:
    before = layout(CAFE)
    assert edited(CAFE, before, replace(before, agent="b")) is None


@pytest.mark.parametrize("seed", range(6))
def test_every_change_of_a_generated_layout(seed: int) -> None:
    made = generate_layout(seed, 8 + 2 * seed, 3 + seed, bar=seed % 2 == 0)
    text = made.replace("\n", "   # as it was\n")
    before = layout(text)
    found = list(changes(before, None, True, True))
    assert found
    for change in random.Random(seed).sample(found, min(8, len(found))):
        new = edited(text, before, change.layout)
        assert new is not None, change.text
        assert write_layout(layout(new)) == write_layout(change.layout)
        kept = [line for line in new.splitlines() if line.endswith("   # as it was")]
        assert len(kept) == len(text.splitlines())


BARE = """\
# A small café.
name: café   # by the river
nodes: [a, b,   # two of them
  c]
edges: [[a, b], [b, c]]
entrance: a
agent: a
tables: {t1: {capacity: 2, nodes: [c]}}   # the quiet one
"""
LISTED = BARE.replace("[a, b,   # two of them\n  c]", "\n  - a   # by the door\n  -  b\n  - 'c'")


@pytest.mark.parametrize(
    ("text", "nodes"),
    [
        (BARE, "nodes: {a: AT_A, b: AT_B,   # two of them\n  c: AT_C}\n"),
        (LISTED, "nodes: \n  a: AT_A   # by the door\n  b: AT_B\n  c: AT_C\n"),
        (LISTED.replace("\n  -", "\n-"), None),  # a mapping has to stand further in
    ],
    ids=["between brackets", "one a line", "not indented"],
)
def test_nodes_get_places_and_the_rest_stays(text: str, nodes: str | None) -> None:
    before = layout(text)
    placed = place(before)
    new = edited(text, before, placed)
    for node in placed.nodes:
        nodes = nodes and nodes.replace(f"AT_{node.name.upper()}", flow(node.at))
    head, _, rest = text.partition("nodes:")
    assert new == (nodes and head + nodes + rest[rest.index("edges:") :])
