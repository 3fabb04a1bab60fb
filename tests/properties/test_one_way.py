"""One-way paths: whoever reads, writes, draws or imports a layout keeps them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from sparc.source import Source
from tests.support.cli import waiter
from waiter_cli.bounds.distances import FAR, WalkDistances
from waiter_cli.drawing.characters import ASCII, BOXES
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.template import fill_template
from waiter_cli.files.layout_editor import edited
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.layout_tools.advice import advise
from waiter_cli.layout_tools.convert import convert, place_nodes
from waiter_cli.layout_tools.layout_changes import changes
from waiter_cli.layout_tools.layout_schema import layout_schema
from waiter_cli.model.graph import cut_nodes
from waiter_cli.model.layout import Layout
from waiter_cli.problems.pose import pose_problem
from waiter_cli.room.room import build_room

RING = """\
name: ring
nodes: {a: [0, 0], b: [3, 0], c: [3, 3], d: [0, 3], x: [6, 0]}
edges:
  - {from: a, to: b}
  - {from: b, to: c}   # past the window
  - {from: c, to: d}
  - [d, a]
  - {from: b, to: x}
entrance: a
agent: b
tables: {t1: {capacity: 2, nodes: [c]}, t2: {capacity: 4, nodes: [x]}}
bar: [d]
"""


def ring() -> Layout:
    return read_layout(RING, "ring.yaml")


def test_neighbours_are_where_an_edge_leads_to_and_people_walk_either_way() -> None:
    assert ring().neighbours() == {
        "a": ("b", "d"), "b": ("c", "x"), "c": ("d",), "d": ("a",), "x": (),
    }  # fmt: skip
    assert ring().joined()["x"] == ("b",)
    assert ring().leads("d", "a") and ring().leads("a", "d") and not ring().leads("b", "a")


def test_what_is_written_reads_the_same() -> None:
    again = read_layout(write_layout(ring()), "ring.yaml")
    assert (again.edges, again.one_way) == (ring().edges, ring().one_way)


def test_an_edge_more_leaves_the_others_as_they_are() -> None:
    layout = ring()
    after = replace(
        layout, edges=(*layout.edges, ("x", "d")), one_way=layout.one_way | {("x", "d")}
    )
    assert edited(RING, layout, after) == RING.replace(
        "b, to: x}\n", "b, to: x}\n  - {from: x, to: d}\n"
    )


def test_placing_nodes_and_improving_lose_no_direction() -> None:
    bare = RING.replace(
        "{a: [0, 0], b: [3, 0], c: [3, 3], d: [0, 3], x: [6, 0]}", "[a, b, c, d, x]"
    )
    placed = place_nodes(bare, read_layout(bare, "ring.yaml"))
    assert placed.layout.one_way == ring().one_way
    assert all(ring().one_way <= change.layout.one_way for change in changes(ring(), None))


def test_distances_are_told_apart_by_direction() -> None:
    floor = WalkDistances(pose_problem(ring()), ())
    a, b, c, d, x = range(5)
    assert [floor.row(b)[n] for n in (a, b, c, d, x)] == [3, 0, 1, 2, 1]
    assert [floor.column(a)[n] for n in (a, b, c, d, x)] == [0, 3, 2, 1, FAR]
    assert floor.path(b, a) == [c, d, a]


def test_advice_names_what_cannot_be_left_once() -> None:
    found = {one.about: one.fault.message for one in advise(ring()) if one.kind == "no_way_back"}
    assert found == {"x": "node x cannot be left: every path to it is one way"}
    two_way = RING.replace("{from: b, to: x}", "[b, x]")
    assert not [one for one in advise(read_layout(two_way, "r")) if one.kind == "no_way_back"]


def test_what_is_lost_with_a_node_is_found_by_direction() -> None:
    lost = {cut.node: cut.lost for cut in cut_nodes(ring().neighbours(), "a")}
    assert lost == {"b": (("c", "x"),)}


def test_drawings_point_the_way() -> None:
    text = waiter("layout", "draw", "-", stdin=RING).out
    heads = ASCII.heads if "^" in text else BOXES.heads
    assert [text.count(head) for head in heads] == [2, 1, 1, 0]
    room = build_room(ring())
    tip, left, right = room.arrow("a", "b")
    assert tip[1] == 0 and 1.5 < tip[0] < 3 and left[0] == right[0] < tip[0]


def test_a_schema_takes_what_the_reader_takes() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    yaml = pytest.importorskip("yaml")
    jsonschema.validate(yaml.safe_load(RING), layout_schema())
    for wrong in ("{from: b}", "{from: b, too: x}"):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(
                yaml.safe_load(RING.replace("{from: b, to: x}", wrong)), layout_schema()
            )


def facts(edges: str, rule: str = "") -> Layout:
    nodes = (
        "sorts\n#node = {a, b, c}.\npredicates\nedge(#node, #node).\noneway(#node, #node).\nrules\n"
    )
    return convert(Source("f.sparc", f"{nodes}{edges}\n{rule}\n"), "f").layout


@pytest.mark.parametrize(
    ("edges", "rule", "one_way"),
    [
        ("edge(a, b). edge(b, a). edge(b, c).", "", {("b", "c")}),
        ("edge(a, b). edge(b, c).", "", set()),
        ("edge(a, b). edge(b, a). edge(b, c).", "edge(M, N) :- edge(N, M).", set()),
        ("edge(a, b). edge(b, c). oneway(a, b).", "edge(M, N) :- edge(N, M).", {("a", "b")}),
    ],
    ids=["both written", "one each", "a rule turns them", "said to be"],
)
def test_facts_say_which_edges_are_one_way(edges: str, rule: str, one_way: set[object]) -> None:
    assert facts(edges, rule).one_way == one_way


def test_the_program_of_a_layout_gives_the_layout_back() -> None:
    source = fill_template(find_domain("restaurant").template, pose_problem(ring()), 3)
    again = convert(Source("r", source.text), "ring").layout
    assert (again.edges, again.one_way) == (ring().edges, ring().one_way)


def test_a_domain_without_words_for_them_says_so_at_the_edge(tmp_path: Path) -> None:
    template = find_domain("restaurant").template.text
    start = template.index("%{ one_way")
    own = template[:start] + template[template.index("%}", start) + 2 :]
    (tmp_path / "own.sparc").write_text(own)
    (tmp_path / "ring.yaml").write_text(RING)
    ran = waiter("plan", "-l", str(tmp_path / "ring.yaml"), "--domain", str(tmp_path / "own.sparc"))
    assert ran.code == 2
    assert "ring.yaml:4:5: error: this domain knows no one-way paths" in ran.err


def test_plans_go_round_and_are_judged(tmp_path: Path) -> None:
    (tmp_path / "ring.yaml").write_text(RING)
    layout = str(tmp_path / "ring.yaml")
    for domain in ("restaurant", "report"):
        document = waiter("plan", "-l", layout, "--enter", "2", "--domain", domain, "--json").json()
        assert (document["horizon"], document["minimal"]) == (7, True)
    document["actions"][0] = {
        "step": 0,
        "name": "go_to",
        "args": ["agent", "a"],
        "text": "go_to(agent,a)",
    }
    plan = tmp_path / "plan.json"
    import json

    plan.write_text(json.dumps(document))
    ran = waiter("validate", "-l", layout, str(plan))
    assert ran.code == 3 and "the path between a and b leads to b only" in ran.out + ran.err


@pytest.mark.wide
def test_explain_says_which_one_way_path_leaves_no_plan(tmp_path: Path) -> None:
    (tmp_path / "ring.yaml").write_text(RING)
    ran = waiter(
        "explain", "-l", str(tmp_path / "ring.yaml"), "--enter", "3",
        "--goal", "at: d", "--goal", "seated: [c1, c2, c3]",
    )  # fmt: skip
    assert ran.code == 0
    assert "ring.yaml:8:5: the path from b to x is one way" in ran.out
    assert "if the path from b to x led back as well: a plan of" in ran.out
