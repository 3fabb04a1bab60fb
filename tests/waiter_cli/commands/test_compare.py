"""``waiter compare``: figures of plans, side by side; scenarios that fit only one; sums and limits."""

from __future__ import annotations

from math import dist
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.jar import JAR_MARKS
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.measure import Measured, find_scenarios, measure, pose_all, total
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem

LINE = """\
nodes: {a: [0, 0], b: [2, 0], c: [5, 0], d: [5, 3]}
edges: [[a, b], [b, c], [c, d]]
entrance: a
agent: a
tables: {t1: {capacity: 2, nodes: [d], at: [5, 4]}}
"""
SHORT = LINE.replace("nodes: [d], at: [5, 4]", "nodes: [b], at: [2, 1]")
COME = "observe: [{enter: [g1]}]\n"


def written(folder: Path, **texts: str) -> Path:
    """A folder with these files."""
    folder.mkdir(exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.yaml").write_text(text)
    return folder


def figures(layout: Layout, scenario: Path) -> Measured:
    """The figures of a scenario that fits."""
    (problem,) = pose_all(layout, [str(scenario)])
    assert isinstance(problem, Problem)
    return measure(problem)


def test_the_figures_of_one_plan(tmp_path: Path) -> None:
    written(tmp_path, come=COME)
    found = figures(read_layout(LINE, "line"), tmp_path / "come.yaml")
    assert (found.scenario, found.status, found.steps, found.minimal) == ("come", "plan", 5, True)
    assert found.metres == pytest.approx(dist((0, 0), (5, 0)) + 3)
    assert found.waits == (5,)
    assert found.seconds == found.wait_seconds[0]
    assert found.seconds is not None
    assert found.seconds > 8 / 0.8
    without = LINE.replace("{a: [0, 0], b: [2, 0], c: [5, 0], d: [5, 3]}", "[a, b, c, d]")
    found = figures(
        read_layout(without.replace(", at: [5, 4]", ""), "line"), tmp_path / "come.yaml"
    )
    assert (found.metres, found.seconds, found.wait_seconds) == (3.0, None, ())


def test_wishes_that_hold_from_the_start_do_not_wait(tmp_path: Path) -> None:
    written(tmp_path, s=COME + "goals: [{at: a}, {at: b}]\n", done="goals: [{at: a}]\n")
    layout = read_layout(LINE, "line")
    assert figures(layout, tmp_path / "done.yaml").waits == ()
    document = figures(layout, tmp_path / "done.yaml").document()
    assert document["steps"] == 0
    assert document["waiting"]["mean_steps"] == 0
    assert figures(layout, tmp_path / "s.yaml").status == "no_plan"


def test_ties_go_to_the_shorter_walk(tmp_path: Path) -> None:
    square = (
        "nodes: {a: [0, 0], far: [9, 9], near: [1, 0], z: [2, 0]}\n"
        "edges: [[a, far], [far, z], [a, near], [near, z]]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 1, nodes: [z], at: [2, 1]}}\n"
    )
    written(tmp_path, s="goals: [{at: z}]\n")
    assert figures(read_layout(square, "f"), tmp_path / "s.yaml").metres == pytest.approx(2)


def test_two_layouts_side_by_side(tmp_path: Path) -> None:
    written(tmp_path, line=LINE, short=SHORT)
    evenings = written(tmp_path / "evenings", one=COME, two=COME + "goals: [{at: c}]\n")
    files = (str(tmp_path / "line.yaml"), str(tmp_path / "short.yaml"))
    document = waiter("compare", *files, "--scenarios", str(evenings), "--json").json()
    assert document["status"] == "compared"
    assert [layout["name"] for layout in document["layouts"]] == ["line", "short"]
    one, two = document["scenarios"]
    assert (one["scenario"], two["scenario"]) == ("one", "two")
    assert [result["steps"] for result in one["results"]] == [5, 3]
    assert [result["metres"] for result in one["results"]] == [8.0, 2.0]
    assert document["totals"][0]["steps"] == 5 + 2
    assert document["totals"][1]["scenarios"] == 2
    assert document["difference"]["steps"] == -2
    assert document["difference"]["metres"] == -6.0
    assert document["difference"]["waiting"] < 0
    ran = waiter("compare", *files, "--scenarios", str(evenings))
    assert ran.code == 0
    rows = [line.split() for line in ran.out.splitlines()]
    assert next(row for row in rows if row[:1] == ["one"])[:5] == ["one", "5", "3", "8.00", "2.00"]
    assert next(row for row in rows if row[:1] == ["all"])[1:5] == ["7", "5", "13.00", "7.00"]
    assert "B takes 2 steps less (-29%), walks 6.00 metres less (-46%)" in ran.out


def test_a_layout_against_itself(tmp_path: Path) -> None:
    ran = waiter("compare", "report", "report", "-s", "b1", "-s", "b3")
    assert ran.code == 0
    assert "B takes as many steps, walks as far, and lets guests wait as long." in ran.out


def test_what_does_not_fit_or_has_no_plan_is_said(tmp_path: Path) -> None:
    written(
        tmp_path, line=LINE, short=SHORT.replace("c:", "k:").replace("c]", "k]").replace("[c", "[k")
    )
    written(tmp_path, s="goals: [{at: c}]\n", big="observe: [{enter: [g1, g2, g3]}]\n", ok=COME)
    files = (str(tmp_path / "line.yaml"), str(tmp_path / "short.yaml"))
    names = [word for name in ("s", "big", "ok") for word in ("-s", str(tmp_path / f"{name}.yaml"))]
    ran = waiter("compare", *files, *names)
    assert ran.code == 0
    assert "s, B:" in ran.out
    assert "unknown node c" in ran.out
    assert "big, A: a party of 3" in ran.out
    assert "Over 1 scenario" in ran.out
    ran = waiter("compare", *files, *names[:2])
    assert ran.code == 2
    assert "no scenario fits both layouts" in ran.err


def test_time_that_runs_out_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "waiter_cli.layout_tools.measure.measure",
        lambda problem, limit, *rest: Measured("x", "x.yaml", "undecided", f"after {limit:g} s"),
    )
    ran = waiter("compare", "report", "report", "-s", "b1", "--time-limit", "3")
    assert ran.code == 4
    assert "x, B: after 3 s" in ran.out


def test_which_scenarios(tmp_path: Path) -> None:
    folder = written(tmp_path / "d", b=COME, a=COME)
    (folder / "notes.txt").write_text("")
    (folder / "c.yaml").write_text(LINE)  # a layout
    assert find_scenarios([str(folder)], ["b1"]) == [
        str(folder / "a.yaml"), str(folder / "b.yaml"), "b1",
    ]  # fmt: skip
    for folders, names in (
        ([], []),
        ([str(tmp_path / "no")], []),
        ([str(tmp_path)], []),
        ([], ["-"]),
    ):
        with pytest.raises(InputError):
            find_scenarios(folders, names)
    assert waiter("compare", "report", "report", "-s", "nosuch").code == 2
    assert waiter("compare", "report", "report").code == 2
    assert waiter("compare", "-", "-", "-s", "b1", stdin=LINE).code == 2


def test_sums_without_seconds() -> None:
    found = total([Measured("a", "a", "plan", metres=2.0, waits=(2, 4))], in_seconds=False)
    assert (found.seconds, found.waiting, found.waiting_unit) == (None, 3.0, "steps")
    assert found.document()["metres"] == 2.0


# -- how plans are found ----------------------------------------------------------------------


@pytest.mark.parametrize(
    "options",
    [
        ("--search", "linear"),
        ("--domain", "report"),
        pytest.param(("--translator", "jar"), marks=JAR_MARKS),
    ],
    ids=" ".join,
)
def test_other_ways_to_the_same_lengths(options: tuple[str, ...]) -> None:
    arguments = ("compare", "report", "report_large", "--scenario", "b1", "--json")
    usual, other = waiter(*arguments).json(), waiter(*arguments, *options)
    assert other.code == 0
    steps = [total["steps"] for total in usual["totals"]]
    assert [total["steps"] for total in other.json()["totals"]] == steps == [7, 7]


def test_what_needs_more_steps_than_allowed_is_undecided() -> None:
    ran = waiter("compare", "report", "report", "--scenario", "b1", "--max-steps", "3", "--json")
    results = ran.json()["scenarios"][0]["results"]
    assert ran.code == 4
    assert [(one["status"], one["limit"]) for one in results] == [("undecided", "max_steps")] * 2


def test_rules_of_ones_own_cannot_tell_when_a_wish_is_fulfilled(tmp_path: Path) -> None:
    own = tmp_path / "own.sparc"
    own.write_text(waiter("domain", "show", "--source").out)
    ran = waiter("compare", "report", "report", "--scenario", "b1", "--domain", str(own))
    assert ran.code == 2 and "--domain" in ran.err and "restaurant or report" in ran.err
