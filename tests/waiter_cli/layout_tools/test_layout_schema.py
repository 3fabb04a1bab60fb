"""Layouts that the reader takes fit their schema, and those that it refuses do not."""

from __future__ import annotations

import pytest

from tests.support.cli import waiter
from tests.support.schemas import schema_faults
from waiter_cli.file_access.locate import built_in, read_text
from waiter_cli.layout_tools.layout_schema import layout_schema

pytest.importorskip("jsonschema")


LAYOUT = read_text("report", "layout").text + "timetable: {w1: {3: n4}}\ncustomers: 6\nbar: [n3]\n"


@pytest.mark.parametrize("name", built_in("layout"))
def test_shipped_layouts_fit(name: str) -> None:
    assert schema_faults(layout_schema(), read_text(name, "layout").text) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("entrance: n5", "entrence: n5"),
        ("entrance: n5", "entrance: [n5]"),
        ("agent: n1", "agent: N1"),
        ("agent: n1", "agent: and"),
        ("- [n1, n2]", "- [n1, n2, n3]"),
        ("- [n1, n2]", "- [n1, n1]"),
        ("n0: [-1.9, -2.9]", "n0: [-1.9]"),
        ("capacity: 2", "capacity: 0"),
        ("capacity: 2", "capacity: two"),
        ("capacity: 2, nodes: [n6]", "capacity: 2, nodes: []"),
        ("capacity: 2, nodes: [n6]", "nodes: [n6]"),
        ("size: [0.8, 0.8]", "size: [0.8, 0]"),
        ("{3: n4}", "{soon: n4}"),
        ("bar: [n3]", "bar: {from: [0, 1], nodes: [n3]}"),
        ("customers: 6", "customers: -1"),
    ],
)
def test_what_the_reader_refuses_the_schema_refuses(old: str, new: str) -> None:
    assert schema_faults(layout_schema(), LAYOUT) == []
    assert old in LAYOUT
    broken = LAYOUT.replace(old, new)
    assert schema_faults(layout_schema(), broken)
    assert waiter("layout", "check", "-", stdin=broken).code == 2
