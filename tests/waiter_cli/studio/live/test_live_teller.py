"""What the page is told of an evening."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.support.browsing import needs_studio
from tests.support.clicking import Clicks, fleet_floor

pytestmark = needs_studio


def test_what_has_changed_is_told_once_and_the_whole_to_who_comes_later(tmp_path: Path) -> None:
    with Clicks(fleet_floor(2, 2), tmp_path) as clicks:
        told: list[dict[str, Any]] = []
        clicks.live.teller.tell = told.append
        clicks.tell({"guests": 2})
        views = [each["view"] for each in told if "view" in each]
        assert views and views[-1]["horizon"] > 0 and views[-1]["parties"] == [["c1", "c2"]]
        first, *_, last = clicks.live.whole()
        assert first == {"view": clicks.live.teller.view()}
        assert last["whole"] and {"@c1", "robot r1", "robot r2"} <= set(last["world"][1])
        clicks.live.teller.show(0.0)
        told.clear()
        clicks.live.teller.show(0.0)
        assert not any("view" in each for each in told)


def test_the_step_that_a_robot_is_at_is_told(tmp_path: Path) -> None:
    with Clicks(fleet_floor(2, 2), tmp_path) as clicks:
        assert [each["at_step"] for each in clicks.live.teller.view()["robots"]] == [None, None]
        clicks.tell({"guests": 2})
        while not clicks.executive.moving:
            clicks.play(1)
        steps = {each["name"]: each["at_step"] for each in clicks.live.teller.view()["robots"]}
        for action in clicks.executive.moving:
            assert steps[action.arguments[0]] == action.step


def test_a_layout_that_was_saved_otherwise_is_newer(tmp_path: Path) -> None:
    with Clicks(fleet_floor(2, 2), tmp_path) as clicks:
        for text, newer in ((clicks.live.opened.text, False), ("nodes: {}", True)):
            clicks.live.note_saved(text)
            assert clicks.live.teller.stale
            assert clicks.live.teller.view()["newer"] is newer
