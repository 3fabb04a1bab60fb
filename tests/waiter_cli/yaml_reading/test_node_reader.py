"""Nodes of a YAML tree read as values: what is taken, what is a fault, and how it is told."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.support.reading import reading
from waiter_cli.errors import LayoutError
from waiter_cli.yaml_reading.node_reader import NodeReader, describe, is_empty, is_identifier
from waiter_cli.yaml_reading.yaml_tree import compose

Read = Callable[[NodeReader, Any], Any]


def whole(reader: NodeReader, node: Any) -> Any:
    return reader.integer(node, "the size", 1, 8)


def metres(reader: NodeReader, node: Any) -> Any:
    return reader.number(node, "the width", 0.5)


def truth(reader: NodeReader, node: Any) -> Any:
    return reader.boolean(node, "instant")


def named(reader: NodeReader, node: Any) -> Any:
    return reader.name(node, "a table")


def one_of(reader: NodeReader, node: Any) -> Any:
    return reader.known(node, "the goal", "node", ["n1", "n2", "kitchen"])


def placed(reader: NodeReader, node: Any) -> Any:
    return reader.point(node, "the door")


def line(reader: NodeReader, node: Any) -> Any:
    return reader.text(node, "the title")


@pytest.mark.parametrize(
    ("read", "text", "value"),
    [
        (whole, "4", 4), (whole, "+8", 8), (metres, "2.5", 2.5), (metres, "1e1", 10.0),
        (truth, "yes", True), (truth, "Off", False), (named, "table_1", "table_1"),
        (one_of, "n2", "n2"), (placed, "[1, -2.5]", (1.0, -2.5)), (line, "À table", "À table"),
    ],
)  # fmt: skip
def test_what_is_right_is_taken(read: Read, text: str, value: object) -> None:
    assert reading(text, read) == (value, [])


@pytest.mark.parametrize(
    ("read", "text", "fault"),
    [
        (whole, "9", "the size must be a whole number from 1 to 8, found 9"),
        (whole, "0x4", "the size must be a whole number from 1 to 8, found 0x4"),
        (whole, '"4"', 'the size must be a whole number from 1 to 8, found the text "4"'),
        (whole, "4.0", "the size must be a whole number from 1 to 8, found 4.0"),
        (metres, "0.4", "the width must be a finite number from 0.5, found 0.4"),
        (metres, "1e8", "the width must be at most 10000000, found 1e8"),
        (metres, "nan", "the width must be a finite number from 0.5, found nan"),
        (metres, "[1]", "the width must be a finite number from 0.5, found a list of 1 item"),
        (truth, "maybe", "instant must be true or false, found maybe"),
        (truth, '"yes"', 'instant must be true or false, found the text "yes"'),
        (named, "Table 1", "Table 1 is no name for a table"),
        (named, "not", "not is a reserved word, no name for a table"),
        (named, "{}", "a table must be a name, found an empty mapping"),
        (one_of, "n3", "unknown node n3"),
        (one_of, "[n1]", "the goal must be the name of a node, found a list of 1 item"),
        (placed, "[1]", "the door must be a place [x, y] in metres, found a list of 1 item"),
        (placed, "[1, up]", "y of the door must be a finite number, found up"),
        (line, '" "', 'the title must be a text on one line, found the text " "'),
    ],
)  # fmt: skip
def test_what_is_wrong_is_none_and_a_fault(read: Read, text: str, fault: str) -> None:
    value, faults = reading(text, read)
    assert value is None
    assert [each.split(": ", 1)[1] for each in faults] == [fault]


def test_a_name_that_is_nearly_right_has_a_mend() -> None:
    reader = NodeReader(compose("[Table 1, kitchn, 2.5x]", "f.yaml"))
    first, second, third = reader.document.root.items  # type: ignore[union-attr]
    reader.name(first, "a table")
    reader.known(second, "the goal", "node", ["kitchen"])
    reader.name(third, "a table")
    hints = [fault.hint or "" for fault in reader.faults]
    assert hints[0].endswith(": table_1") and "kitchen" in hints[1]
    assert "letter" in hints[2] and not hints[2].endswith("x"), "no name can be made of it"


def test_keys_that_mean_nothing_are_faults_where_they_stand() -> None:
    def read(reader: NodeReader, node: Any) -> Any:
        return reader.mapping(node, "a table", ["capacity", "nodes"])

    value, faults = reading("capacity: 2\ncapcity: 3\n<<: 4\n", read)
    assert list(value) == ["capacity"]
    assert faults == ["2:1: unknown key capcity in a table", "3:1: unknown key << in a table"]


@pytest.mark.parametrize(
    ("text", "lacks"),
    [("capacity: 2", True), ("~", True), ("nodes: []", False), ("node: []", False), ("[1]", False)],
)
def test_a_key_that_is_misspelt_does_not_lack(text: str, lacks: bool) -> None:
    def read(reader: NodeReader, node: Any) -> bool:
        return reader.lacks(node, "nodes", ["capacity", "nodes"])

    assert reading(text, read)[0] is lacks


def test_names_in_a_list_are_known_and_there_once() -> None:
    def read(reader: NodeReader, node: Any) -> Any:
        return reader.known_names(node, "the bar", "node", ["n1", "n2"])

    found, faults = reading("[n1, n3, n1, n2]", read)
    assert [(name, where.column) for name, where in found] == [("n1", 2), ("n2", 14)]
    assert faults == ["1:6: unknown node n3", "1:10: the bar: n1 is listed twice"]


@pytest.mark.parametrize(
    ("text", "kind", "empty"),
    [
        ("[]", "an empty list", True), ("[a, b]", "a list of 2 items", False),
        ("{}", "an empty mapping", True), ("a: b", "a mapping", False),
        ("~", "nothing", True), ("word", "word", False), ("'w'", 'the text "w"', False),
    ],
)  # fmt: skip
def test_nodes_are_told_by_their_kind(text: str, kind: str, empty: bool) -> None:
    root = compose(text, "f.yaml").root
    assert root is not None and (describe(root), is_empty(root)) == (kind, empty)


def test_an_identifier_is_ascii() -> None:
    assert is_identifier("table_1") and not is_identifier("tablé") and not is_identifier("²")


def test_all_faults_come_at_once_in_the_order_of_the_file() -> None:
    reader = NodeReader(compose("[b, a, b]", "f.yaml"))
    nodes = reader.document.root.items  # type: ignore[union-attr]
    for node in (nodes[2], nodes[0], nodes[0]):
        reader.wrong(node, "this", "a number")
    with pytest.raises(LayoutError) as caught:
        reader.finish()
    columns = [fault.where.column for fault in caught.value.faults if fault.where]
    assert columns == [2, 8], "each once"


def test_hundreds_of_faults_end_in_a_number() -> None:
    text = f"[{', '.join(['x'] * 250)}]"
    reader = NodeReader(compose(text, "f.yaml"))
    for node in reader.document.root.items:  # type: ignore[union-attr]
        reader.known(node, "this", "node", ["y"])
    assert reader.faults[-1].hint is None, "nobody reads so many"
    with pytest.raises(LayoutError) as caught:
        reader.finish()
    assert len(caught.value.faults) == 201
    assert caught.value.faults[-1].message == "and 50 more faults"


def test_nothing_is_raised_without_a_fault() -> None:
    NodeReader(compose("a: 1", "f.yaml")).finish()
