"""``waiter layout improve``: honest figures, changes that help, budgets, files that can be read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from sparc import limits
from tests.support.cli import waiter
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.layout_tools.improve import Budget, Report, improve
from waiter_cli.layout_tools.layout_changes import changes
from waiter_cli.layout_tools.measure import measure, pose_all
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem

# A detour of four nodes round an empty middle; the only table is at the far end.
DETOUR = """\
nodes: {a: [0, 0], b: [0, 2], c: [2, 2], d: [2, 0], e: [4, 0]}
edges: [[a, b], [b, c], [c, d], [d, e]]
entrance: a
agent: a
tables:
  far: {capacity: 2, nodes: [e], at: [4, 1]}
customers: 3
"""
COME = "observe: [{enter: [g1, g2]}]\n"


@pytest.fixture
def come(tmp_path: Path) -> str:
    """A scenario in which two guests come in."""
    path = tmp_path / "come.yaml"
    path.write_text(COME)
    return str(path)


def improved(text: str, *scenarios: str, seconds: float = 30.0, tries: int = 24) -> Report:
    return improve(read_layout(text, "f"), scenarios, budget=Budget(seconds, tries))


def test_the_short_cut_is_found_and_its_figures_are_those_of_plans(come: str) -> None:
    report = improved(DETOUR, come)
    assert (report.before.steps, report.before.metres) == (6, 8.0)
    by_text = {one.change.text: one for one in report.found}
    cut = by_text["add the edge a-d"]
    assert (cut.after.steps, cut.after.metres) == (4, 4.0)
    nearer = by_text["move far to b"]
    assert nearer.after.metres == 2.0
    assert report.found[0] is nearer
    for one in report.found:
        again = [measure(p) for p in pose_all(one.change.layout, [come]) if isinstance(p, Problem)]
        assert one.after.steps == sum(each.steps for each in again)
        assert one.after.metres == pytest.approx(sum(each.metres for each in again))
        assert one.after.metres < 8 or one.after.steps < 6
    metres = [one.after.metres for one in report.found]
    assert metres == sorted(metres)


def test_only_edges_or_only_tables(come: str) -> None:
    layout = read_layout(DETOUR, "f")
    assert {one.change.kind for one in improve(layout, [come], tables=False).found} == {"edge"}
    assert {one.change.kind for one in improve(layout, [come], edges=False).found} == {"move"}


def test_edges_keep_clear_of_furniture_walls_and_other_nodes() -> None:
    def edges(text: str) -> set[str]:
        return {one.text for one in changes(read_layout(text, "f"), None, tables=False)}

    free = {f"add the edge {pair}" for pair in ("a-c", "a-d", "b-d", "b-e")}
    assert edges(DETOUR) == free  # however long
    assert "add the edge a-d" not in edges(DETOUR + "walls: [[[1, -1], [1, 1]]]\n")
    table = "  mid: {capacity: 1, nodes: [a], at: [1, 0]}\n"
    assert "add the edge a-d" not in edges(DETOUR.replace("customers", table + "customers"))
    between = edges(DETOUR.replace("e: [4, 0]", "e: [1, 0]"))
    assert "add the edge a-e" in between
    assert "add the edge a-d" not in between  # e lies on it


def test_a_restaurant_without_coordinates_counts_edges(come: str) -> None:
    bare = DETOUR.replace(
        "{a: [0, 0], b: [0, 2], c: [2, 2], d: [2, 0], e: [4, 0]}", "[a, b, c, d, e]"
    )
    report = improved(bare.replace(", at: [4, 1]", ""), come)
    assert report.before.metres == 4
    assert report.before.waiting_unit == "steps"
    assert {one.change.text for one in report.found} >= {"add the edge b-e", "move far to b"}


def test_tables_swap_where_a_small_party_blocks_the_near_one(tmp_path: Path) -> None:
    text = DETOUR.replace("  far:", "  near: {capacity: 1, nodes: [b], at: [-1, 2]}\n  far:")
    path = tmp_path / "s.yaml"
    path.write_text(COME)
    report = improve(read_layout(text, "f"), [str(path)], edges=False, budget=Budget(30, 6))
    assert "swap near and far" in {one.change.text for one in report.found}
    assert report.found[0].after.metres == 2.0


def test_a_way_where_there_was_none_comes_first(tmp_path: Path) -> None:
    path = tmp_path / "two.yaml"
    path.write_text(COME)
    layout = read_layout_file("walled_off")
    report = improve(layout, [str(path)], tables=False, budget=Budget(30, 4))
    assert (report.before.scenarios, report.found) == (0, ())  # a wall stands in every way
    report = improve(layout, [str(path)], edges=False, budget=Budget(30, 1))
    assert [one.solved for one in report.found] == [1]
    open_ = replace(layout, walls=())
    report = improve(open_, [str(path)], tables=False, budget=Budget(30, 1))
    assert [one.solved for one in report.found] == [1]
    ends = set(report.found[0].change.edge or ())
    assert len(ends & {"n0", "n1", "n2", "n3"}) == 1


def test_budgets_end_the_search(come: str) -> None:
    report = improved(DETOUR, come, tries=1)
    assert (report.tried, report.stopped) == (1, "tries")
    assert report.found[0].change.text == "move far to b"  # what promises most is tried first
    report = improved(DETOUR, come, seconds=0)
    assert (report.tried, report.stopped, report.found) == (0, "time", ())


def test_scenarios_that_do_not_fit(come: str, tmp_path: Path) -> None:
    odd = tmp_path / "odd.yaml"
    odd.write_text("goals: [{at: nowhere}]\n")
    report = improved(DETOUR, come, str(odd), tries=2)
    assert [row.scenario for row in report.unfit] == ["odd"]
    with pytest.raises(InputError, match="no scenario fits"):
        improved(DETOUR, str(odd))


def test_the_command_reports_and_writes(come: str, tmp_path: Path) -> None:
    file, better = tmp_path / "detour.yaml", tmp_path / "better.yaml"
    file.write_text(DETOUR)
    ran = waiter("layout", "improve", str(file), "-s", come, "--only", "edges", "-o", str(better))
    assert ran.code == 0
    assert "over 1 scenario: 6 steps, 8.00 metres" in ran.out
    assert "6 -> 4" in ran.out
    assert "8.00 -> 4.00" in ran.out
    assert file.read_text() == DETOUR
    written: Layout = read_layout_file(str(better))
    assert ("a", "d") in written.edges
    assert written.customers == 3
    folder = str(tmp_path / "evenings")
    (tmp_path / "evenings").mkdir()
    (tmp_path / "evenings" / "one.yaml").write_text(COME)
    ran = waiter(
        "layout", "improve", str(better), "--scenarios", folder, "--only", "edges", "--json"
    )
    document = ran.json()
    assert document["status"] == "no_improvement"
    assert document["before"]["metres"] == 4.0
    assert document["scenarios"][0]["steps"] == 4
    document = waiter("layout", "improve", str(file), "-s", come, "--json", "--top", "1").json()
    assert document["status"] == "improved"
    assert len(document["improvements"]) == 1
    assert document["improvements"][0]["saved"]["metres"] == 6.0


def test_nothing_to_improve_and_nothing_to_go_by(tmp_path: Path) -> None:
    ran = waiter(
        "layout", "improve", "report", "-s", "b3", "--tries", "3", "-o", str(tmp_path / "x.yaml")
    )
    assert ran.code == 0
    assert "No change that was tried saves any walking." in ran.out
    assert not (tmp_path / "x.yaml").exists()
    assert waiter("layout", "improve", "report").code == 2
    ran = waiter("layout", "improve", "report", "-s", "too_big", "--tries", "1")
    assert ran.code == 0
    assert "no scenario has a plan" in ran.out


def test_changes_of_a_large_floor_end_with_the_time(come: str) -> None:
    nodes = ", ".join(f"n{i}: [{i}, 0]" for i in range(400))
    edges = ", ".join(f"[n{i}, n{i + 1}]" for i in range(399))
    text = (
        f"nodes: {{{nodes}}}\nedges: [{edges}]\nentrance: n0\nagent: n0\ncustomers: 3\n"
        "tables: {t1: {capacity: 2, nodes: [n3], at: [3, 1]}}\n"
    )
    report = improved(text, come, seconds=0.0)
    assert (report.stopped, report.tried) == ("time", 0)
    assert report.candidates < 5  # of 79,401 pairs


def test_memory_that_is_used_up_ends_it(come: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "reached", lambda: "memory")
    report = improved(DETOUR, come)
    assert (report.stopped, report.candidates) == ("memory", 0)
    assert report.rows[0].status == "undecided"
