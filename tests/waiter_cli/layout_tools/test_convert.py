"""``waiter layout convert``: programs in the report's words, there and back, and what is missing."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import dist
from pathlib import Path

import pytest

from sparc.errors import SourceError
from sparc.source import Source
from tests.support.cli import waiter
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import InputError
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.layout_tools.convert import convert
from waiter_cli.room.coordinates import spread

REPORT = """\
#const nnum = 7.
#const tnum = 2.
sorts
#step = 0..7.
#num = 0..4.
#node = [n][0..nnum].
#table = [table][1..tnum].
#furniture = #table.
#customer = [c][1..5].
#waiter = [w][1..1].
#agent = {agent}.
#employee = #waiter + #agent.
#fluent = currentlocation(#employee, #node) + iswaiting(#customer).
#action = go_to(#agent, #node) + pick(#agent, #customer).
predicates
edge(#node, #node).
areassociated(#node, #furniture).
hascapacity(#table, #num).
holds(#fluent, #step).
occurs(#action, #step).
rules
holds(currentlocation(agent, n1), 0).
holds(currentlocation(w1, n7), 0).
holds(iswaiting(c1), 0).
hascapacity(table1, 2).
hascapacity(table2, 4).
edge(n1, n2).
edge(n2, n3).
edge(n3, n4).
edge(n4, n5).
edge(n4, n7).
edge(n5, n6).
edge(N2, N1) :- edge(N1, N2).
-edge(N1, N2) :- not edge(N1, N2).
areassociated(n6, table1).
areassociated(n6, table2).
areassociated(n7, table2).
-occurs(pick(agent, Cu), I) :- holds(currentlocation(agent, N), I), N != n5.
"""


def remarks(text: str) -> list[str]:
    """What is remarked about a program, without the word about coordinates."""
    found = [fault.message for fault in convert(Source("p.sparc", text), "p").remarks]
    assert found[-1] == "no coordinates found: SPARC has none"
    return found[:-1]


def test_the_words_of_the_report() -> None:
    made = convert(Source("report.sparc", REPORT), "report")
    layout, shipped = made.layout, read_layout_file("report")
    assert {node.name for node in layout.nodes} == {node.name for node in shipped.nodes}
    assert set(layout.edges) == set(shipped.edges) - {("n0", "n5")}
    assert (layout.entrance, layout.agent, layout.waiters) == ("n5", "n1", (("w1", "n7"),))
    assert [(t.name, t.capacity, t.nodes) for t in layout.tables] == [
        ("table1", 2, ("n6",)),
        ("table2", 4, ("n6", "n7")),
    ]
    assert layout.customers == 5
    assert layout.bar is None
    assert "# 1 fact about a situation left out" in made.text
    assert read_layout(made.text, "again.yaml") == replace(layout, file="again.yaml")


@pytest.mark.parametrize("name", built_in("layout"))
@pytest.mark.parametrize("domain", ["restaurant", "report"])
def test_the_project_s_own_programs_come_back_as_their_layouts(name: str, domain: str) -> None:
    layout = read_layout_file(name)
    if domain == "report" and (layout.bar or len(layout.nodes) > 9):
        pytest.skip("the domain has no such words, or it takes long")
    program = waiter(
        "plan",
        "-l",
        name,
        "--goal",
        "at: " + layout.entrance,
        "--domain",
        domain,
        "--show",
        "sparc",
    )
    assert program.code == 0
    back = convert(Source("p.sparc", program.out), name).layout
    assert [node.name for node in back.nodes] == [node.name for node in layout.nodes]
    assert set(map(frozenset, back.edges)) == set(map(frozenset, layout.edges))
    for field in ("entrance", "agent", "waiters"):
        assert getattr(back, field) == getattr(layout, field)
    assert [(t.name, t.capacity, set(t.nodes), t.chairs) for t in back.tables] == [
        (t.name, t.capacity, set(t.nodes), t.chairs) for t in layout.tables
    ]
    assert (back.bar.nodes if back.bar else ()) == (layout.bar.nodes if layout.bar else ())


def _program(facts: list[str]) -> str:
    return "sorts\npredicates\nrules\n" + "".join(f"{fact}.\n" for fact in facts)


def test_several_robots_come_back_and_one_without_a_place_gets_one() -> None:
    facts = ["edge(n1, n2)", "edge(n2, n3)", "robot(r1)", "robot(r2)", "areassociated(n3, t1)"]
    places = ["holds(currentlocation(r2, n1), 0)", "holds(currentlocation(w1, n3), 0)"]
    found = convert(Source("p.sparc", _program([*facts, *places])), "p")
    assert found.layout.agents == (("r1", "n2"), ("r2", "n1"))
    assert found.layout.waiters == (("w1", "n3"),)
    assert "no place of r1 found, so it starts on n2" in [one.message for one in found.remarks]
    crowded = [*facts, "robot(r3)", "robot(r4)", *places]
    with pytest.raises(InputError, match="no node is left for r4"):
        convert(Source("p.sparc", _program(crowded)), "p")


def test_a_timetable_comes_back() -> None:
    program = find_domain("restaurant").template.text
    layout = convert(Source("domain.sparc", program), "domain").layout
    assert layout.timetable == (("w1", 2, "n4"),)
    assert layout.entrance == "n1"


@pytest.mark.parametrize(
    ("cut", "remark"),
    [
        ("edge(n", "no edges found"),
        ("areassociated(n6, table1)", "table table1 is beside no node, and is left out"),
        ("hascapacity(table2", "no capacity of table2 found, so it seats 2"),
        ("holds(currentlocation(agent", "no place of the robot found, so it starts on n0"),
        ("-occurs(pick", "no entrance found, so n1 stands in for it"),
    ],
)
def test_what_is_missing_is_said_and_the_layout_is_valid_all_the_same(
    cut: str, remark: str
) -> None:
    text = "\n".join(line for line in REPORT.split("\n") if not line.startswith(cut)) + "\n"
    assert text != REPORT
    assert remark in remarks(text)
    assert remark not in remarks(REPORT)


def test_a_program_with_faults_is_read_as_far_as_its_facts_go() -> None:
    found = convert(Source("p.sparc", REPORT.replace("#num).", "#nmu).")), "p")
    assert any("the program has faults" in fault.message for fault in found.remarks)
    assert len(found.layout.tables) == 2
    assert "n0" not in {node.name for node in found.layout.nodes}  # in the sort only


def test_numbers_and_plain_vertices_become_names() -> None:
    text = "sorts\n#vertex = 1..3.\npredicates\nvertex(#vertex).\nedge(#vertex, #vertex).\nrules\nedge(1, 2).\nedge(2, 1).\n"
    layout = convert(Source("g.sparc", text), "g").layout
    assert [node.name for node in layout.nodes] == ["n1", "n2", "n3"]
    assert layout.edges == (("n1", "n2"),)


def test_more_than_one_entrance_is_said() -> None:
    program = find_domain("restaurant").template.text
    text = program.replace("entrance(n1).", "entrance(n1). entrance(n2).")
    found = convert(Source("d", text), "d").remarks
    assert any("more than one entrance found: n1 is used, n2 are not" in r.message for r in found)


def test_what_is_no_restaurant_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="no nodes and no edges"):
        convert(Source("f", "sorts\n#p = {a}.\npredicates\nq(#p).\nrules\nq(a).\n"), "f")
    with pytest.raises(SourceError):
        convert(Source("f", "sorts\n#p = {a.\n"), "f")
    monkeypatch.setattr("waiter_cli.layout_tools.convert.MOST_NAMES", 7)
    with pytest.raises(InputError, match="#node has more than 7 elements"):
        convert(Source("f", REPORT), "f")
    clash = "sorts\n#node = {agent, x}.\n#table = {x}.\npredicates\nq(#node).\nrules\nq(x).\n"
    with pytest.raises(InputError, match="agent is no name for a node") as caught:
        convert(Source("f", clash), "f")
    assert len(caught.value.faults) == 2


def test_the_command_writes_yaml_and_remarks(tmp_path: Path) -> None:
    source, target = tmp_path / "my report.sparc", tmp_path / "my-report.yaml"
    source.write_text(REPORT)
    ran = waiter("layout", "convert", str(source), "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    assert "no coordinates found" in ran.err
    assert (
        waiter("plan", "-l", str(target), "--enter", "2", "--json").json()["layout"] == "my_report"
    )
    ran = waiter("layout", "convert", "-", stdin=REPORT)
    assert read_layout(ran.out, "x").name == "converted"
    assert waiter("layout", "convert", "-", stdin="sorts #a").code == 2
    assert waiter("layout", "convert", str(tmp_path / "none")).code == 2
    assert waiter("layout", "convert", "-", "--name", "A b", stdin=REPORT).code == 2


def test_nodes_get_places_that_fit_the_edges() -> None:
    made = convert(Source("report.sparc", REPORT), "report", place=True)
    layout = made.layout
    at = {node.name: node.at for node in layout.nodes}
    for a, b in layout.edges:
        start, end = at[a], at[b]
        assert start is not None
        assert end is not None
        assert 1.2 < dist(start, end) < 3
    assert len({*at.values()}) == len(at)
    assert all(table.at is not None for table in layout.tables)
    assert waiter("layout", "draw", "-", stdin=made.text).code == 0


@pytest.mark.parametrize("name", built_in("layout"))
def test_a_layout_without_places_gets_them_and_nothing_else(name: str, tmp_path: Path) -> None:
    whole = read_layout_file(name)
    tables = tuple(replace(table, at=None) for table in whole.tables)
    nodes = tuple(replace(node, at=None) for node in whole.nodes)
    bar = None if whole.bar is None else replace(whole.bar, corners=None)
    bare = replace(whole, nodes=nodes, tables=tables, bar=bar, walls=(), customers=9)
    file, target = tmp_path / "bare.yaml", tmp_path / "placed.yaml"
    file.write_text(write_layout(bare) + "customers: 9\n")
    ran = waiter("layout", "convert", "--place", str(file), "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    assert "the nodes are placed by their edges" in ran.err
    placed = read_layout_file(str(target))
    assert len({node.at for node in placed.nodes} - {None}) == len(nodes)
    assert all(table.at is not None for table in placed.tables)
    again = replace(
        placed,
        nodes=tuple(replace(node, at=None) for node in placed.nodes),
        tables=tuple(replace(table, at=None) for table in placed.tables),
        bar=None if placed.bar is None else replace(placed.bar, corners=None),
    )
    assert write_layout(again) == write_layout(bare) and again.customers == 9


def test_a_layout_is_converted_only_to_place_its_nodes(tmp_path: Path) -> None:
    file = tmp_path / "row.yaml"
    file.write_text(
        "nodes: [a, b]\nedges: [[a, b]]\nentrance: a\ntables: {t: {capacity: 2, nodes: [b]}}\nagent: a\n"
    )
    ran = waiter("simulate", "--layout", str(file), "--enter", "1")
    assert (ran.code, ran.err.count(": error: ")) == (2, 1)
    assert f"{file}:1:8: error: 2 nodes have no coordinates" in ran.err
    assert f"`waiter layout convert --place {file}`" in ran.err
    ran = waiter("layout", "convert", str(file))
    assert ran.code == 2 and "is a layout already" in ran.err and "--place" in ran.err
    placed = waiter("layout", "convert", "--place", str(file))
    file.write_text(placed.out)
    assert waiter("simulate", "--layout", str(file), "--enter", "1").code == 0
    ran = waiter("layout", "convert", "--place", str(file))
    assert ran.code == 2 and "every node has its place already" in ran.err


@pytest.mark.parametrize(
    "near",
    [
        {},
        {"a": ()},
        {"a": (), "b": ()},
        {"a": ("b",), "b": ("a",), "c": ("d",), "d": ("c",)},
        {f"n{k}": tuple(f"n{j}" for j in range(6) if j != k) for k in range(6)},
        {f"n{k}": (f"n{(k + 1) % 9}", f"n{(k - 1) % 9}") for k in range(9)},
        read_layout_file("bistro").neighbours(),
    ],
    ids=["none", "one", "two apart", "two pairs", "complete", "ring", "bistro"],
)
def test_places_are_apart(near: dict[str, tuple[str, ...]]) -> None:
    at = spread(near)
    assert list(at) == list(near)
    assert spread(near) == at
    for a, b in combinations(at, 2):
        assert dist(at[a], at[b]) > 0.9, (a, b)
    assert all(x >= 0 and y >= 0 for x, y in at.values())
