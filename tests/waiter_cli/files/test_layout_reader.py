"""Layouts: every key, every fault in its place, what is only a warning."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from tests.support.marked import Case, differences, read_cases
from waiter_cli.errors import LayoutError, Where
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.model.graph import layout_warnings
from waiter_cli.model.layout import Bar, Layout, Node, Table

GOOD = {
    "nodes": "nodes: {a: [0, 0], b: [1, 0], c: [2, 0]}",
    "edges": "edges: [[a, b], [b, c]]",
    "tables": "tables: {table1: {capacity: 2, nodes: [c]}}",
    "entrance": "entrance: a",
    "agent": "agent: b",
}
SMALL = "\n".join(GOOD.values())


def small(**changed: str) -> Layout:
    """The small layout with some keys changed or added."""
    return read_layout("\n".join((GOOD | changed).values()), "small.yaml")


@pytest.mark.parametrize(
    "case", read_cases("layout_faults.yaml", GOOD), ids=lambda case: case.title
)
def test_every_fault_is_reported_in_its_line(case: Case) -> None:
    with pytest.raises(LayoutError) as raised:
        read_layout(case.text, "hall.yaml")
    assert differences(case, raised.value.faults) == []
    assert [f.where for f in raised.value.faults] == sorted(f.where for f in raised.value.faults)


def test_a_fault_says_file_line_column_and_shows_the_line() -> None:
    with pytest.raises(LayoutError) as raised:
        read_layout(SMALL.replace("[b, c]]", "[b, d]]"), "hall.yaml")
    (fault,) = raised.value.faults
    assert str(fault) == "hall.yaml:2:21: unknown node d; known: a, b, c"
    assert fault.excerpt == "edges: [[a, b], [b, d]]"


def test_every_key_is_read() -> None:
    layout = read_layout(
        """
name: hall
nodes: {a: [0, 0.5], b: [1.0, -2], c: [2e0, 0]}
edges: [[a, b], [b, c]]
entrance: a
tables:
  t1: {capacity: 4, nodes: [c, b], at: [5, 6], size: [0.8, 1.6], chairs: 3}
agent: b
waiters: {w2: c, w1: a}
bar: {nodes: [c], from: [0, 1], to: [2, 3]}
objects: [jug]
timetable: {w1: {9: b, 3: a}}
walls: [[[-3, -3.4], [-3, 0.4]]]
customers: 6
""",
        "dir/hall.yaml",
    )
    assert layout == Layout(
        name="hall",
        nodes=(Node("a", (0, 0.5)), Node("b", (1, -2)), Node("c", (2, 0))),
        edges=(("a", "b"), ("b", "c")),
        entrance="a",
        tables=(Table("t1", 4, ("c", "b"), (5, 6), (0.8, 1.6), 3),),
        agent="b",
        waiters=(("w1", "a"), ("w2", "c")),
        bar=Bar(("c",), ((0, 1), (2, 3))),
        objects=("jug",),
        timetable=(("w1", 3, "a"), ("w1", 9, "b")),
        walls=(((-3, -3.4), (-3, 0.4)),),
        customers=6,
        file="dir/hall.yaml",
    )
    places = dict(layout.key_where)
    assert places["waiters.w1"] == Where("dir/hall.yaml", 9, 18)
    assert places["timetable.w1.3"] == Where("dir/hall.yaml", 12, 24)
    assert layout.edge_where[1] == Where("dir/hall.yaml", 4, 17)
    assert layout.table("t1").where == Where("dir/hall.yaml", 7, 3)


def test_what_is_left_out_has_the_defaults() -> None:
    layout = small()
    table = layout.table("table1")
    assert (layout.name, layout.customers, layout.objects, layout.bar) == ("small", 0, (), None)
    assert (table.chairs, table.size) == (2, (0.8, 0.8))
    assert small(bar="bar: [c]").objects == ("plate", "jug", "basket")
    assert small(waiters="waiters:", bar="bar:", walls="walls:").waiters == ()


def test_a_table_without_a_place_stands_beside_its_first_node_and_off_the_paths() -> None:
    layout = small()
    at = layout.table("table1").at
    assert at is not None
    assert (at[0] - 2) ** 2 + at[1] ** 2 <= 1.3**2
    assert abs(at[1]) > 0.65 or at[0] > 2.65  # the paths run along y = 0, from x = 0 to 2


def test_two_tables_at_one_node_stand_apart() -> None:
    both = "tables: {t1: {capacity: 2, nodes: [c]}, t2: {capacity: 2, nodes: [c]}}"
    first, second = small(tables=both).tables
    assert first.at is not None and second.at is not None
    assert abs(first.at[0] - second.at[0]) + abs(first.at[1] - second.at[1]) > 0.8


def test_nodes_may_be_a_plain_list_of_names() -> None:
    layout = small(nodes="nodes: [a, b, c]")
    assert [(node.name, node.at) for node in layout.nodes] == [
        ("a", None),
        ("b", None),
        ("c", None),
    ]
    assert layout.table("table1").at is None


@pytest.mark.parametrize(
    "name", ["a", "i", "x", "n0_1", "no", "on", "y", "true", "null", "e1", "aB_"]
)
def test_any_identifier_is_a_name(name: str) -> None:
    layout = read_layout(
        f"nodes: [{name}, zz]\nedges: [[{name}, zz]]\nentrance: {name}\nagent: {name}\n"
        f"tables: {{t: {{capacity: 1, nodes: [{name}]}}}}\nwaiters: {{}}",
        "names.yaml",
    )
    assert layout.nodes[0].name == layout.agent == layout.tables[0].nodes[0] == name


def test_objects_are_no_reserved_names_where_there_is_no_bar() -> None:
    assert small(waiters="waiters: {jug: c}").waiters == (("jug", "c"),)


def test_json_is_read_too() -> None:
    value = {
        "nodes": {"a": [0, 0], "b": [1, 0]},
        "edges": [["a", "b"]],
        "entrance": "a",
        "agent": "b",
        "tables": {"t": {"capacity": 2, "nodes": ["a"]}},
        "waiters": {"w1": "a"},
        "timetable": {"w1": {"3": "b"}},
    }
    for text in (
        json.dumps(value),
        json.dumps(value, indent=2),
        json.dumps(value).replace(" ", ""),
    ):
        assert read_layout(text, "l.json").timetable == (("w1", 3, "b"),)


def test_waiters_may_follow_each_other_in_one_step() -> None:
    layout = small(
        waiters="waiters: {w1: c, w2: a}", timetable="timetable: {w1: {3: a}, w2: {3: c}}"
    )
    assert len(layout.timetable) == 2


def test_what_cannot_be_reached_is_a_warning() -> None:
    layout = small(edges="edges: [[a, b]]")
    found = [str(fault) for fault in layout_warnings(layout)]
    mend = "add an edge that leads there"
    assert found == [
        f"small.yaml:1:31: node c cannot be reached from b, where the robot starts; {mend}",
        f"small.yaml:3:10: table table1 cannot be reached: no path leads from b to c; {mend}",
    ]
    assert layout_warnings(small()) == ()


def test_an_entrance_out_of_reach_is_named_as_such() -> None:
    (found,) = layout_warnings(small(edges="edges: [[b, c]]"))
    assert "the entrance a cannot be reached" in found.message


def test_objects_without_a_bar_are_a_warning() -> None:
    (found,) = layout_warnings(small(objects="objects: [jug]"))
    assert "without a bar" in found.message


def test_layouts_are_equal_by_what_they_say_and_not_by_where() -> None:
    moved = read_layout("# a remark\n" + SMALL, "small.yaml")
    assert moved == small()
    assert replace(moved, agent="c") != small()


def test_very_many_faults_are_cut_off() -> None:
    edges = ", ".join(f"[x{i}, y{i}]" for i in range(3000))
    with pytest.raises(LayoutError) as raised:
        small(edges=f"edges: [{edges}]")
    assert len(raised.value.faults) == 201
    assert "more faults" in raised.value.faults[-1].message
