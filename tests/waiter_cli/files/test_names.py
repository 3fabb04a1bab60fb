"""Names looked up as a file is read: one thing has one name, and each party its members once."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import pytest

from tests.support.reading import reading
from tests.support.rule_cases import HALL
from waiter_cli.errors import Where
from waiter_cli.files.names import Names, fresh_customers, read_table_objects, stocked
from waiter_cli.model.layout import Layout
from waiter_cli.yaml_reading.node_reader import NodeReader


def test_new_customers_have_names_of_their_own() -> None:
    assert list(islice(fresh_customers({"c1", "c3"}), 2)) == ["c2", "c4"]


@pytest.mark.parametrize(
    ("text", "names", "faults"),
    [
        ("[c1, c2]", ["c1", "c2"], []),
        ("c1", ["c1"], []),
        ("[c1, c1]", ["c1"], ["1:6: c1 is named twice in one party"]),
        ("[big, c1]", ["c1"], ["1:2: big is a table, so no customer can be called that"]),
        ("[plate]", [], ["1:2: plate is an object, so no customer can be called that"]),
        ("w", [], ["1:1: w is a waiter, so no customer can be called that"]),
    ],
)
def test_a_party(text: str, names: list[str], faults: list[str]) -> None:
    party, told = reading(text, lambda reader, node: Names(HALL).party(reader, node, "a party"))
    assert [name for name, _ in party] == names and told == faults


def test_a_number_of_guests_is_no_party() -> None:
    party, told = reading("2", lambda reader, node: Names(HALL).party(reader, node, "a party"))
    assert party == () and len(told) == 1


def test_names_that_were_read_before_are_taken() -> None:
    names = Names(HALL)
    names.adopt("customer", ["c1"])
    names.adopt("waiter", ["v"])
    assert {"c1", "v", "big", "a", "plate"} <= names.taken()
    assert names.customers == {"c1"} and names.waiters == {"w", "v"}
    _, told = reading("c1", lambda reader, node: names.declare(reader, node, "waiter"))
    assert told == ["1:1: c1 is a customer, so no waiter can be called that"]


@pytest.mark.parametrize(
    ("layout", "item", "fault"),
    [
        (HALL, "jug", None),
        (HALL, "cake", "the layout has no object cake"),
        (replace(HALL, bar=None), None, "ready needs a bar, and the layout has none"),
    ],
)
def test_what_is_served_needs_a_bar_that_has_it(
    layout: Layout, item: str | None, fault: str | None
) -> None:
    def ask(reader: NodeReader, _: object) -> bool:
        return stocked(reader, layout, Where("f.yaml", 1, 1), "ready", item)

    found, told = reading("x", ask)
    assert found is (fault is None) and told == ([f"1:1: {fault}"] if fault else [])


def test_things_of_tables() -> None:
    kinds = ("plate", "jug")

    def read(text: str) -> tuple[list[tuple[str, str]], list[str]]:
        found, told = reading(
            text, lambda reader, node: read_table_objects(reader, Names(HALL), node, "ready", kinds)
        )
        return [(table, item) for table, item, _ in found], told

    assert read("{big: [plate, jug], small: jug}") == (
        [("big", "plate"), ("big", "jug"), ("small", "jug")],
        [],
    )
    assert read("{big: [jug, jug]}") == (
        [("big", "jug")],
        ["1:13: ready: jug of big is listed twice"],
    )
    found, told = read("{bigg: jug, big: spoon}")
    assert found == [] and len(told) == 2
