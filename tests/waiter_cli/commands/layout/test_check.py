"""``waiter layout check``: faults, advice, places, exit codes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.file_access.locate import read_text
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.layout_tools.advice import advise
from waiter_cli.layout_tools.advice_text import told
from waiter_cli.layout_tools.generate_floor import build_layout

PLAIN = """\
nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [2, 2]}
edges: [[a, b], [b, c], [b, d], [a, d], [c, d]]
entrance: a
agent: a
tables:
  t1: {capacity: 2, nodes: [c], at: [5.2, 0]}
"""


def kinds(text: str) -> list[tuple[str, int]]:
    """The kind and the line of every piece of advice."""
    out = []
    for one in advise(read_layout(text, "cafe.yaml")):
        assert one.fault.where is not None
        out.append((one.kind, one.fault.where.line))
    return out


def test_a_layout_with_nothing_to_say_about() -> None:
    assert kinds(PLAIN) == []
    assert (
        kinds(PLAIN + "walls: [[[-2, -2], [8, -2]]]\nbar: {nodes: [d], from: [1, 3], to: [3, 4]}\n")
        == []
    )


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("d: [2, 2]}", "d: [2, 2], e: [9, 9]}", [("unreachable", 1), ("unused_node", 1)]),
        ("[b, d], [a, d], [c, d]", "[b, d], [a, d]", [("bottleneck", 1)]),
        ("[b, c], [b, d], [a, d], [c, d]", "[a, d], [b, d]", [("unreachable", 1), ("unreachable", 6)]),
        ("at: [5.2, 0]", "at: [3, 0]", [("edge_through_furniture", 2)] * 3),
        ("capacity: 2", "capacity: 9", [("seats_do_not_fit", 6)]),
        ("tables:\n", "tables:\n  t0: {capacity: 2, nodes: [c], at: [5.6, 0]}\n", [("tables_overlap", 7)]),
        ("agent: a", "agent: b\nwaiters: {w1: d, w2: c}", [("blocked", 7)]),
        ("agent: a", "agent: a\nobjects: [plate]", [("idle_objects", 5)]),
        ("{a: [0, 0], b: [2, 0], c: [4, 0], d: [2, 2]}", "[a, b, c, d]", [("no_coordinates", 1)]),
        ("agent: a", "agent: a\nwalls: [[[3, -1], [3, 0.5]]]", [("edge_through_furniture", 2)]),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 20 else "",
)  # fmt: skip
def test_what_is_remarked(old: str, new: str, expected: list[tuple[str, int]]) -> None:
    assert old in PLAIN
    found = kinds(PLAIN.replace(old, new))
    for one in expected:
        assert one in found
    assert {kind for kind, _ in expected} <= {kind for kind, _ in found}
    if expected[0][0] not in ("unreachable", "edge_through_furniture", "tables_overlap"):
        assert [kind for kind, _ in found] == [kind for kind, _ in expected]


LEAF = PLAIN.replace("d: [2, 2]}", "d: [2, 2], e: [2, 4]}").replace("[c, d]]", "[c, d], [d, e]]")


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", ["dead_end", "unused_node"]),
        ("nodes: [c]", "nodes: [e]", ["bottleneck"]),
        ("nodes: [c]", "nodes: [c, e]", []),
        ("entrance: a", "entrance: e", ["bottleneck"]),
        ("entrance: a", "entrance: a\nbar: {nodes: [e], from: [1, 5], to: [3, 6]}", ["bottleneck"]),
        ("entrance: a", "entrance: a\nbar: {nodes: [d, e], from: [1, 5], to: [3, 6]}", ["bottleneck"]),
        ("agent: a", "agent: e", ["bottleneck"]),
        ("agent: a", "agent: a\nwaiters: {w1: e}", []),
        ("agent: a", "agents: {r1: a, r2: b}", []),
    ],
    ids=["nothing", "table", "table of two nodes", "entrance", "bar", "all of the bar", "robot", "waiter", "several robots, one of which waits there"],
)  # fmt: skip
def test_a_leaf_is_a_dead_end_where_nothing_uses_it(
    old: str, new: str, expected: list[str]
) -> None:
    assert [kind for kind, _ in kinds(LEAF.replace(old, new))] == expected


def test_a_bottleneck_says_that_the_bar_is_lost() -> None:
    text = LEAF.replace("agent: a", "agent: a\nbar: {nodes: [d, e], from: [1, 5], to: [3, 6]}")
    (found,) = advise(read_layout(text, "f"))
    assert "d is a bottleneck: without it e and the bar are cut off" in found.fault.message


def test_what_several_have_in_common_is_told_once() -> None:
    faults = told(advise(read_layout_file("report_large")))
    messages = [f"{fault.where.line}: {fault.message}" for fault in faults if fault.where]
    assert messages[0].startswith("5: nodes n0_0 and n15 (23:3) are used by nothing")
    assert messages[1].startswith("6: n0_1, n0_2 (7:3), n0_3 (8:3), n14 (22:3), n16 (24:3) and n17")
    assert [fault.hint is None for fault in faults] == [True, False, True, True, True, True, False]
    faults = told(advise(read_layout_file("walled_off")))
    assert [str(fault.where).split(":", 1)[1] for fault in faults] == ["13:3", "32:3"]
    assert "nodes n4, n5 (14:3), n6 (15:3) and n7 (16:3) cannot be" in faults[0].message
    assert "tables table1 and table2 (33:3) cannot be" in faults[1].message


@pytest.mark.parametrize("command", ["plan", "simulate --headless"])
def test_a_warning_before_planning_is_told_once_too(command: str) -> None:
    ran = waiter(*command.split(), "--layout", "walled_off", "--enter", "1")
    assert ran.err.count("warning:") == 2 and ran.err.count("hint:") == 1
    assert "13:3: warning: nodes n4, n5 (14:3), n6 (15:3) and n7 (16:3) cannot be" in ran.err


def test_waiters_in_the_way_are_told_once() -> None:
    text = PLAIN.replace("agent: a", "agent: d\nwaiters: {w1: a, w2: b, w3: c}")
    found = advise(read_layout(text, "f"))
    assert [one.kind for one in found] == ["blocked"] * 2
    (fault,) = told(found)
    assert fault.message == (
        "the entrance and t1 (7:3) cannot be reached while w1 stands on a, w2 stands on b and "
        "w3 stands on c"
    )
    assert fault.hint is not None and fault.hint.startswith("let w1, w2 and w3 start elsewhere")


def test_advice_is_a_line_a_place_and_faults_show_theirs(tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text(read_text("report", "layout").text)
    advice = waiter("layout", "check", str(mine)).err
    assert f"{mine}:" in advice and " | " not in advice
    mine.write_text(mine.read_text().replace("entrance: n5", "entrance: m5"))
    assert " | entrance: m5 " in waiter("layout", "check", str(mine)).err


def long_hall(tables: int) -> str:
    """Nodes in a row, each with a table that is too small for its seats."""
    nodes = "".join(f"  n{k}: [{3 * k}, 0]\n" for k in range(tables))
    edges = ", ".join(f"[n{k}, n{k + 1}]" for k in range(tables - 1))
    rows = "".join(
        f"  t{k}: {{capacity: 9, nodes: [n{k}], at: [{3 * k}, 1.5]}}\n" for k in range(tables)
    )
    return f"nodes:\n{nodes}edges: [{edges}]\nentrance: n0\nagent: n0\ntables:\n{rows}"


def test_many_of_a_kind_are_counted() -> None:
    text = long_hall(40)
    ran = waiter("layout", "check", "-", stdin=text)
    assert ran.code == 0 and ran.err.count("advice:") == 2
    assert "40 tables have more seats than there is room for: t0, t1, t2 and 37 more" in ran.err
    assert (
        "38 nodes are bottlenecks, without which others are cut off: n1, n2, n3 and 35" in ran.err
    )
    assert "-v gives them all" in ran.err and "78 pieces of advice" in ran.out
    every = waiter("layout", "check", "-", "-v", stdin=text)
    assert every.err.count("advice:") == 78 and "-v" not in every.err
    assert len(waiter("layout", "check", "-", "--json", stdin=text).json()["advice"]) == 78
    few = waiter("layout", "check", "-", stdin=long_hall(8))
    assert few.err.count("seats and a rim for 8") == 8 and "-v" not in few.err


def test_many_names_in_one_remark_are_counted() -> None:
    """In a warning before planning, too, where there is no -v."""
    text = long_hall(40).replace("[n1, n2], ", "")
    fault = told(advise(read_layout(text, "f")))[0]
    assert "nodes n2, n3, n4 and 35 more cannot be reached" in fault.message
    ran = waiter("plan", "-l", "-", "--goal", "at: n0", stdin=text)
    assert "nodes n2, n3, n4 and 35 more cannot be reached" in ran.err


ROW = """\
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d]]
entrance: a
agent: %s
tables: {t1: {capacity: 2, nodes: [d]}}
waiters: %s
timetable: %s
"""


@pytest.mark.parametrize(
    ("agent", "staff", "timetable", "said"),
    [
        ("b", "{w1: a}", "{w1: {2: d}}", "w1 goes from a to d in one step, past whoever is on b"),
        ("a", "{w1: b}", "{w1: {3: c, 4: a}}", "w1 goes from c to a in one step, past whoever is on b"),
        ("a", "{w1: c, w2: d}", "{w1: {2: d}, w2: {2: c}}", "w1 and w2 change places at step 2"),
        ("d", "{w1: b}", "{w1: {1: c}}", "w1 goes from b to c, and no way leads past him"),
        ("a", "{w1: b}", "{w1: {1: c}}", None),
        ("a", "{w1: d}", "{w1: {2: c, 5: d}}", None),
    ],
)  # fmt: skip
def test_a_timetable_that_leads_through_somebody(
    agent: str, staff: str, timetable: str, said: str | None
) -> None:
    found = advise(read_layout(ROW % (agent, staff, timetable), "f"))
    messages = [one.fault.message for one in found if one.kind == "timetable"]
    assert len(messages) == (said is not None)
    assert said is None or messages[0].startswith(said)
    places = [one.fault.where for one in found if one.kind == "timetable"]
    assert all(where is not None and where.line == 7 for where in places)


def test_a_way_round_the_corridor_is_no_corridor() -> None:
    text = ROW % ("b", "{w1: a}", "{w1: {2: c}}")
    assert "timetable" in {one.kind for one in advise(read_layout(text, "f"))}
    round_it = text.replace("nodes: [a,", "nodes: [e, a,").replace(
        "[[a, b],", "[[a, b], [a, e], [e, c],"
    )
    assert "timetable" not in {one.kind for one in advise(read_layout(round_it, "f"))}


def test_one_remark_is_told_as_it_is() -> None:
    for name in ("report", "bistro"):
        found = advise(read_layout_file(name))
        single = [one.fault.message for one in found if one.kind != "unused_node"]
        assert [fault.message for fault in told(found)] == single


def test_a_chair_that_stands_in_something_is_named() -> None:
    rims = "[[4.45, -3], [4.45, 3]], [[5.95, -3], [5.95, 3]], [[4, 0.75], [6, 0.75]], [[4, -0.75], [6, -0.75]]"
    squeezed = PLAIN + f"walls: [{rims}]\n"
    found = [one for one in advise(read_layout(squeezed, "f")) if one.kind == "seats_do_not_fit"]
    assert len(found) == 1
    assert "chair 1 of table t1 stands in wall" in found[0].fault.message


def test_bottlenecks_say_what_is_lost() -> None:
    found = {a.fault.message for a in advise(read_layout_file("report")) if a.kind == "bottleneck"}
    assert "n4 is a bottleneck: without it n3, n2, n1 and n7 are cut off from the entrance" in found
    assert any(text.startswith("n5 is a bottleneck") and "table1" in text for text in found)
    large = [a.fault.message for a in advise(read_layout_file("bistro")) if a.kind == "bottleneck"]
    lost = "17 nodes, table1, table2, table3, 5 more tables and the bar are"
    assert any(lost in text for text in large)


def test_generated_layouts_have_no_furniture_in_the_way() -> None:
    for seed in range(4):
        layout = build_layout(seed, 30, 10, bar=True, waiters=1)
        found = {one.kind for one in advise(layout)}
        assert not found & {"edge_through_furniture", "tables_overlap", "seats_do_not_fit"}
        assert not found & {"unreachable", "blocked"}


def test_the_command_gives_advice_with_places_and_ends_well(tmp_path: Path) -> None:
    ran = waiter("layout", "check", "report")
    assert ran.code == 0
    assert "8 nodes, 7 edges, 2 tables with 6 seats" in ran.out
    assert "layouts/report.yaml:12:3: advice: n0 is a dead end that nothing uses" in ran.err
    assert "5 pieces of advice" in ran.out
    assert "used by nothing" not in ran.err and ran.err.count("hint:") == 2
    good = tmp_path / "good one.yaml"
    good.write_text(PLAIN)
    ran = waiter("layout", "check", str(good))
    assert (ran.code, ran.err) == (0, "")
    assert "in order" in ran.out


def test_every_fault_is_reported_with_its_place(tmp_path: Path) -> None:
    bad = tmp_path / "bad.yaml"
    bad.write_text(PLAIN.replace("[c, d]", "[c, x]").replace("entrance: a", "entrance: q"))
    ran = waiter("layout", "check", str(bad))
    assert (ran.code, ran.out) == (2, "")
    assert f"{bad}:2:45: error:" in ran.err
    assert f"{bad}:3:11: error:" in ran.err
    assert waiter("layout", "check", str(tmp_path / "none.yaml")).code == 2


def test_json_is_one_document(tmp_path: Path) -> None:
    document = waiter("layout", "check", "report", "--json").json()
    here = [one for one in document["advice"] if one["line"] == 12]
    assert [one["kind"] for one in here] == ["dead_end", "unused_node"]
    assert all(one["hint"] for one in document["advice"])
    document = waiter("layout", "check", "walled_off", "--json").json()
    assert len(document["advice"]) == 6
    assert document["status"] == "advice"
    assert document["tables"] == 2
    first = document["advice"][0]
    assert first["kind"] == "unreachable"
    assert (first["line"], first["column"]) == (13, 3)
    ran = waiter("layout", "check", "--json", "-", stdin=PLAIN)
    assert (ran.code, ran.err) == (0, "")
    assert ran.json()["status"] == "ok"
    ran = waiter("layout", "check", "--json", "-", stdin="nodes: {}")
    assert ran.code == 2
    assert ran.json()["status"] == "error"
