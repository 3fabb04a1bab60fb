"""What can be taken along of an evening is what other commands read."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.browsing import (
    Lines,
    browser,
    cookie_of,
    expect,
    get,
    needs_browser,
    needs_studio,
    running_studio,
)
from tests.support.cli import waiter
from tests.support.paths import ROOT

pytestmark = needs_studio


def lived(tmp_path: Path) -> dict[str, str]:
    """The keepsakes of an evening in which guests were seated and more came."""
    with running_studio("--speed", "60") as studio:
        cookie = cookie_of(studio)
        with Lines(studio, cookie=cookie) as lines:
            assert lines.tell({"guests": 1})["horizon"] == 7
            lines.until(7)
            lines.until(0)
            lines.tell({"play": False})
            lines.tell({"block": ["n1", "n2"]})
            lines.tell({"observe": [{"bill": "table1"}, {"enter": ["dora", "emil"]}]})
            found = {}
            for name in ("scenario.yaml", "plan.json", "replay.html", "evening.journal"):
                status, headers, body = get(studio, f"/keep/{name}", cookie=cookie)
                assert status == 200 and name in headers["content-disposition"]
                (tmp_path / name).write_bytes(body)
                found[name] = body.decode()
            assert get(studio, "/keep/other", cookie=cookie)[0] == 404
            assert get(studio, "/keep/plan.json")[0] == 401
    return found


def test_each_keepsake_is_read_again(tmp_path: Path) -> None:
    kept = lived(tmp_path)
    scenario = kept["scenario.yaml"]
    assert 'layout: "report"' in scenario and "enter: [dora, emil]" in scenario
    assert "# at " in scenario and "block: [n1, n2]" in scenario
    ran = waiter("simulate", "--scenario", str(tmp_path / "scenario.yaml"), "--headless", "--json")
    assert ran.code == 0 and ran.json()["status"] == "done"
    seated = ran.json()["final_state"]["seated"]
    assert seated["table1"] == ["c1"] and seated["table2"] == ["dora", "emil"]
    assert waiter("validate", "--layout", "report", str(tmp_path / "plan.json")).code == 0
    assert json.loads(kept["plan.json"])["minimal"]
    replayed = waiter("serve", "--replay", str(tmp_path / "evening.journal"))
    assert replayed.code == 0, replayed.err
    assert "http" not in kept["replay.html"] and "dora" in kept["replay.html"]


def test_the_scenario_of_an_evening_in_a_file_names_that_file(tmp_path: Path) -> None:
    """Its name inside may be that of a restaurant that comes with waiter."""
    layout = tmp_path / "two.yaml"
    text = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    layout.write_text(text.replace("agent: n1", "agents: {r1: n4, r2: n0}"), encoding="utf-8")
    with running_studio("--layout", str(layout), "--speed", "60") as studio, Lines(studio) as lines:
        lines.tell({"guests": 2})
        kept = get(studio, "/keep/scenario.yaml", cookie=cookie_of(studio))[2].decode()
    scenario = tmp_path / "evening.yaml"
    scenario.write_text(kept, encoding="utf-8")
    ran = waiter("simulate", "--scenario", str(scenario), "--headless", "--json")
    assert ran.code == 0 and ran.json()["final_state"]["seated"], ran.err


@needs_browser
@pytest.mark.browser
@pytest.mark.wide
def test_the_replay_page_plays_without_a_server(tmp_path: Path) -> None:
    lived(tmp_path)
    with browser() as found:
        page = found.new_page()
        wrong: list[str] = []
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.goto((tmp_path / "replay.html").as_uri())
        page.wait_for_selector('body[data-ready="yes"]')
        page.get_by_label("time", exact=True).fill("1")
        expect(page.locator(".robot")).to_have_count(1)
        expect(page.get_by_text("c1 comes in")).to_have_count(1)
        assert not wrong
