"""Layouts written as YAML, from which the same layout is read."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.layout_writer import edge_text, flow, quoted, write_layout
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.model.layout import Layout


def as_read(layout: Layout) -> Layout:
    return read_layout(write_layout(layout), "again.yaml")


@pytest.mark.parametrize("name", built_in("layout"))
def test_what_is_shipped_comes_back(name: str) -> None:
    layout = read_layout_file(name)
    again = as_read(layout)
    for key in ("name", "nodes", "edges", "entrance", "tables", "agent", "waiters", "bar", "objects",
                "timetable", "walls", "one_way"):  # fmt: skip
        assert getattr(again, key) == getattr(layout, key), key


@pytest.mark.parametrize("seed", range(4))
def test_what_is_made_by_chance_comes_back(seed: int) -> None:
    layout = read_layout(generate_layout(seed, 12, 4, bar=True, waiters=1), "made.yaml")
    assert write_layout(as_read(layout)) == write_layout(layout)


def test_keys_that_few_layouts_have() -> None:
    layout = replace(
        HALL,
        one_way=frozenset({("b", "d")}),
        timetable=(("w", 2, "b"), ("w", 5, "c")),
        name="Zur Post: 2",
    )
    text = write_layout(layout)
    assert 'name: "Zur Post: 2"' in text and "  - {from: b, to: d}" in text
    again = as_read(layout)
    assert again.one_way == layout.one_way and again.timetable == layout.timetable
    assert again.name == layout.name and again.nodes == layout.nodes


def test_parts_of_a_line() -> None:
    assert flow({"a": [1, 2.5], "b": {"c": "d"}}) == "{a: [1, 2.5], b: {c: d}}"
    assert [quoted(text) for text in ("bar", "./a/b.yaml", "no name", "1")] == [
        "bar",
        "./a/b.yaml",
        '"no name"',
        '"1"',
    ]
    assert edge_text(HALL, ("a", "b")) == "[a, b]"
