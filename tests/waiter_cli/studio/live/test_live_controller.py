"""Several robots in the studio: all three rooms, in a real browser and by lines."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from tests.support.browsing import (
    Lines,
    expect,
    needs_browser,
    needs_studio,
    opened_page,
    press,
    running_studio,
)
from tests.support.paths import ROOT

pytestmark = needs_studio


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report's restaurant with two robots, each a step away from the entrance."""
    text = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    path = tmp_path_factory.mktemp("fleet") / "two.yaml"
    path.write_text(re.sub(r"(?m)^agent: .*$", "agents: {r1: n4, r2: n0}", text), encoding="utf-8")
    return path


def test_lines_move_robots_and_one_that_stops_is_planned_without(two: Path) -> None:
    with running_studio("--layout", str(two), "--speed", "60") as studio, Lines(studio) as lines:
        lines.tell({"play": False})
        told = lines.tell({"guests": 2})
        assert told["minimal"] and list(told["next"]) == ["r1"]
        out = lines.tell({"observe": {"out": "r1"}})
        assert out["out"] == ["r1"] and {action["args"][0] for action in out["plan"]} == {"r2"}
        again = lines.tell({"observe": {"out": "r1"}})
        assert "r1 is out already" in again["error"]["message"]
        lines.tell({"play": True})
        lines.until(0)
        assert lines.view["state"]["seated"]
        assert [robot["out"] for robot in lines.view["robots"]] == [True, False]
        assert "out" not in lines.tell({"back": "r1"})
        assert "error" in lines.tell({"done": {"r1": 3}})


@pytest.mark.wide
def test_a_robot_that_stopped_on_its_way_is_planned_with_once_it_is_at_its_node(two: Path) -> None:
    with running_studio("--layout", str(two), "--speed", "4") as studio, Lines(studio) as lines:
        lines.tell({"guests": 2})
        while not any(robot["doing"] for robot in lines.view["robots"]):
            lines.said()
        walking = next(robot["name"] for robot in lines.view["robots"] if robot["doing"])
        while not _far(lines.said(), walking):
            pass
        assert lines.tell({"observe": {"out": walking}})["out"] == [walking]
        told = lines.tell({"back": walking})
        assert told["out"] == [walking]  # it drives back before it is planned with
        lines.tell({"speed": 60})
        while any(robot["out"] for robot in lines.view["robots"]):
            lines.said()
        lines.until(0)
        assert lines.view["state"]["seated"]


def _far(told: dict[str, Any], robot: str) -> bool:
    """Whether a robot is seen, half a metre from the node on which it began."""
    if "world" not in told or f"robot {robot}" not in told["world"][1]:
        return False
    x, y = told["world"][1][f"robot {robot}"][:2]
    _far.first.setdefault(robot, (x, y))  # type: ignore[attr-defined]
    x0, y0 = _far.first[robot]  # type: ignore[attr-defined]
    return bool(abs(x - x0) + abs(y - y0) > 50)


_far.first = {}  # type: ignore[attr-defined]


@needs_browser
@pytest.mark.browser
@pytest.mark.wide
def test_the_three_rooms(chromium: Any, two: Path) -> None:
    with running_studio("--layout", str(two), "--speed", "60") as studio:
        page = opened_page(chromium, studio)
        press(page, "Pause")
        for name in ("robot r1", "robot r2"):
            expect(page.get_by_label(name, exact=True)).to_have_count(1)
        page.get_by_label("Guests", exact=True).fill("2")
        press(page, "New guests")
        proof = page.get_by_role("status", name="proof")
        expect(proof).to_have_text("4 steps. Minimal: it is proved that 3 are too few.")
        rows = page.get_by_role("list", name="plan").get_by_role("listitem")
        expect(rows).to_have_text(
            [
                "r1: walk from n4 to n5",
                "r1: ask the party of c1 (2) to follow",
                "r1: walk from n5 to n6",
                "r1: seat the party of c1 (2) at table1",
            ]
        )
        page.get_by_label("robot r1", exact=True).click()
        page.get_by_role("menuitem", name="robot is out", exact=True).click()
        robots = page.get_by_role("list", name="robots").get_by_role("listitem")
        expect(robots.first).to_contain_text("r1: stands still")
        expect(rows.first).to_have_text("r2: walk from n0 to n5")
        press(page, "go on r1")
        expect(robots.first).to_contain_text("r1: waits")
        page.get_by_label("robot r1", exact=True).focus()
        page.keyboard.press("Enter")
        fail = page.get_by_role("menuitem", name="fail this step", exact=True)
        expect(fail).to_have_attribute("title", "it is at no step")
        page.keyboard.press("Escape")
        press(page, "Play")
        expect(proof).to_have_text(re.compile("^0 steps"))
        expect(page.get_by_role("log", name="events")).to_contain_text("sit down at table1")

        page.get_by_role("tab", name="Layout").click()
        board = page.locator("#panel-layout")
        expect(board.get_by_label("robot r1", exact=True)).to_have_count(1)
        page.get_by_label("Pinned scenario").select_option(label="2 guests arrive")
        told = page.get_by_role("status", name="pinned plan")
        expect(told).to_have_text(re.compile(r"^4 steps"))
        board.get_by_label("robot r1", exact=True).focus()
        page.keyboard.press("ArrowLeft")
        expect(board.get_by_label("YAML")).to_have_value(re.compile(r"r1: n3, r2: n0"))
        expect(told).to_have_text(re.compile(r"^4 steps"))

        page.get_by_role("tab", name="Why").click()
        page.get_by_label("Situation").select_option(label="2 guests arrive")
        answer = page.get_by_role("status", name="answer")
        expect(answer).to_have_text(re.compile(r"^\d steps, .* m, minimal$"))
        expect(page.locator("#panel-why").get_by_label("robot r1", exact=True)).to_have_count(1)
        expect(page.get_by_role("status", name="known")).to_have_text(re.compile("^Step 0: "))
        asked = page.get_by_role("textbox", name="Action")
        expect(asked).to_have_attribute("placeholder", re.compile(r"^seat\(r[12],c1,table2\)$"))
        page.context.close()


@pytest.mark.wide
@needs_browser
@pytest.mark.browser
def test_a_step_fails_by_keyboard_alone(chromium: Any, two: Path) -> None:
    with running_studio("--layout", str(two), "--speed", "0.5") as studio:
        page = opened_page(chromium, studio)
        press(page, "New guests")
        robots = page.get_by_role("list", name="robots").get_by_role("listitem")
        expect(robots.first).to_contain_text("r1: walk from n4 to n5")
        press(page, "Pause")  # so it is at that step for as long as this takes
        page.get_by_label("robot r1", exact=True).focus()
        page.keyboard.press("Enter")
        item = page.get_by_role("menuitem", name="fail this step", exact=True)
        expect(item).to_be_focused()
        page.keyboard.press("Enter")
        expect(page.get_by_role("menu")).to_have_count(0)
        press(page, "Play")
        events = page.get_by_role("log", name="events")
        expect(events).to_contain_text("it was told to fail")
        page.context.close()
