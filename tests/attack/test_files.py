"""Files that are not what they are taken for: other kinds, foreign lines, read-only ones, odd coordinates."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.file_access.kinds import kind_of

SPARC = "sorts\n#p = {a}.\npredicates\nq(#p).\nrules\nq(a).\n"
LAYOUT = "nodes: {a: [0, 0], b: [1, 0]}\nedges: [[a, b]]\nentrance: a\nagent: b\ntables:\n  t: {capacity: 2, nodes: [b]}\n"
SECRET = "root:x:0:0:hidden:/root:/bin/sh\n"
BUILDING = "levels:\n  ground:\n    vertices: [[0, 0, 0, door]]\n    password: hidden\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (SPARC, "a SPARC program"),
        ("% a comment\n" + SPARC, "a SPARC program"),
        (LAYOUT, "a layout"),
        ("layout: report\ngoals: []\n", "a scenario"),
        ('{"state": {}, "observe": []}', "a scenario"),
        ('{"status": "plan", "layout": "report", "horizon": 0, "actions": []}', "a plan"),
        ('{"status": "plan", "horizon": 0, "actions": [], "edges": 1}', "a plan"),
        ("<svg xmlns='x'/>", "an SVG picture"),
        ("", "an empty file"),
        (SECRET, "a text of another kind"),
        (BUILDING, "YAML of another kind"),
        ("[1, 2]", "JSON of another kind"),
    ],
)
def test_kinds(text: str, kind: str) -> None:
    assert kind_of(text) == kind


def test_a_file_in_place_of_another_is_told_as_what_it_is(folder: Path) -> None:
    plan = waiter("plan", "--scenario", "b1", "--json").out
    texts = {
        "p.json": plan,
        "s.yaml": "layout: report\ngoals: []\n",
        "l.yaml": LAYOUT,
        "a.sparc": SPARC,
    }
    kinds = {
        "p.json": "a plan",
        "s.yaml": "a scenario",
        "l.yaml": "a layout",
        "a.sparc": "a SPARC program",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "x.png").write_bytes(b"\x89PNG\r\n\x1a\n\xff")
    for name, kind in kinds.items():
        for wanted, line in {
            "a layout": ("plan", "--enter", "1", "--layout", name),
            "a scenario": ("plan", "--layout", "report", "--scenario", name),
            "a plan": ("validate", "--layout", "report", name),
        }.items():
            if wanted != kind:
                ran = waiter(*line)
                assert (ran.code, f"this is {kind}, not {wanted}" in ran.err) == (2, True), ran.err
    assert "this is a PNG picture" in waiter("plan", "--layout", "x.png", "--enter", "1").err
    for name, kind in (("s.yaml", "a scenario"), ("b.yaml", "YAML of another kind")):
        (folder / "b.yaml").write_text(BUILDING)
        ran = waiter("layout", "convert", name)
        assert (
            ran.code == 2 and f"is {kind}, not a layout" in ran.err and "SPARC program" in ran.err
        )


@pytest.mark.parametrize("foreign", [SECRET, BUILDING, '{"hidden": 1}', "- hidden\n", "a: [hidden"])
def test_no_line_of_a_foreign_file_is_shown(foreign: str, folder: Path) -> None:
    (folder / "secret").write_text(foreign)
    (folder / "s.yaml").write_text("layout: secret\n")
    plan = {"status": "plan", "layout": "secret", "horizon": 0, "actions": []}
    (folder / "p.json").write_text(json.dumps(plan))
    for line in (
        ("plan", "-s", "s.yaml"),
        ("validate", "p.json"),
        ("plan", "-s", "s.yaml", "--json"),
    ):
        ran = waiter(*line)
        assert ran.code == 2 and "hidden" not in ran.out + ran.err
        assert "not a layout" in ran.out + ran.err


def test_no_file_stands_for_rules_that_nobody_asked_for(folder: Path) -> None:
    for name in ("restaurant", "report"):
        (folder / name).write_text("shopping list\n")
    (folder / "s.yaml").write_text("goals: [{at: n2}]\n")
    path = "layouts/report.yaml"
    ran = waiter("plan", "--layout", path, "--enter", "1", "--json")
    assert ran.code == 0 and ran.json()["domain"] == "restaurant"
    (folder / "p.json").write_text(ran.out)
    assert waiter("validate", "p.json").code == 0
    assert waiter("domain", "show").code == 0
    assert waiter("explain", "--layout", path, "--enter", "1").code == 0
    for name in ("restaurant", "./restaurant"):
        assert waiter("plan", "--layout", path, "--enter", "1", "--domain", name).code == 2


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_a_read_only_file_is_never_replaced(folder: Path) -> None:
    kept = folder / "kept.html"
    kept.write_text("kept")
    kept.chmod(0o444)
    (folder / "link.svg").symlink_to(kept)
    for line in (
        ("layout", "draw", "report", "-o", "link.svg"),
        ("simulate", "-s", "b1", "--headless", "--view", "2d", "--record", "kept.html"),
        ("simulate", "-s", "b1", "--headless", "--view", "2d", "--events", "kept.html"),
    ):
        ran = waiter(*line)
        assert ran.code == 2 and "read-only" in ran.err, ran.err
        assert kept.read_text() == "kept"


def test_coordinates_of_utm_are_metres_and_degrees_are_noticed(folder: Path) -> None:
    (folder / "utm.yaml").write_text(
        LAYOUT.replace("[0, 0]", "[484512.5, 9999999]").replace("[1, 0]", "[484514.5, 9999999]")
    )
    assert waiter("plan", "--layout", "utm.yaml", "--enter", "2").code == 0
    assert waiter("layout", "draw", "utm.yaml").code == 0
    assert "degrees" not in waiter("layout", "check", "utm.yaml").err
    (folder / "far.yaml").write_text(LAYOUT.replace("[1, 0]", "[1, 2e7]"))
    assert "at most 10000000" in waiter("layout", "check", "far.yaml").err
    (folder / "deg.yaml").write_text(
        LAYOUT.replace("[0, 0]", "[8.4032, 49.0092]").replace("[1, 0]", "[8.40325, 49.00921]")
    )
    ran = waiter("layout", "check", "deg.yaml")
    assert ran.code == 0 and "look like degrees" in ran.out + ran.err


def test_no_name_ends_the_script_of_a_page(folder: Path) -> None:
    (folder / "odd.yaml").write_text("name: '<!--<script>'\n" + LAYOUT)
    (folder / "s.yaml").write_text("layout: odd.yaml\nobserve: [{enter: [c1]}]\n")
    ran = waiter("simulate", "-s", "s.yaml", "--headless", "--view", "2d", "--record", "r.html")
    page = (folder / "r.html").read_text(encoding="utf-8")
    assert ran.code == 0 and "<!--<script>" not in page and "\\u003c!--\\u003cscript>" in page
