"""An evening by a domain of one's own, in a real browser and by lines: its words in plan, menus and floor."""

from __future__ import annotations

import re
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

pytestmark = needs_studio

HOUSEKEEPING = ("--domain", "housekeeping", "--layout", "report", "--speed", "60")


def test_lines_speak_the_words_of_the_domain() -> None:
    with running_studio(*HOUSEKEEPING) as studio, Lines(studio) as lines:
        lines.tell({"play": False})
        assert "error" not in lines.tell({"observe": {"obs": "spilled(table1)"}})
        assert (
            "did you mean table1"
            in lines.tell({"observe": {"obs": "spilled(tabel1)"}})["error"]["message"]
        )
        told = lines.tell({"goal": {"holds_not": "isdirty(table1)"}})
        assert told["plan"][-1]["text"] == "clean(agent,table1)"
        lines.tell({"play": True})
        lines.until(0)
        assert lines.view["rows"][-1] == ["wipe table1", "done"]
        assert not any(each["holds"] for each in lines.view["own"]["fluents"])


@needs_browser
@pytest.mark.browser
@pytest.mark.wide
def test_the_rooms_show_what_only_the_domain_knows(chromium: Any) -> None:
    with running_studio(*HOUSEKEEPING) as studio:
        page = opened_page(chromium, studio)
        press(page, "Pause")
        table = page.get_by_label("table table1", exact=True)
        table.click()
        page.get_by_role("menuitem", name="seen: spilled(table1)", exact=True).click()
        holding = page.get_by_role("list", name="own fluents").get_by_role("listitem")
        expect(holding).to_have_text(["isdirty(table1)"])
        expect(page.locator("#panel-live svg .note")).to_have_text(["isdirty"])
        press(page, "Own words")
        page.get_by_role("menuitem", name="wanted: not isdirty(table1)", exact=True).click()
        rows = page.get_by_role("list", name="plan").get_by_role("listitem")
        expect(rows.last).to_have_text("wipe table1")
        expect(page.get_by_role("list", name="goals")).to_contain_text(
            "isdirty(table1) does not hold"
        )
        press(page, "Play")
        expect(page.get_by_role("status", name="proof")).to_have_text(re.compile("^0 steps"))
        expect(page.get_by_role("log", name="events")).to_contain_text("wiping table1")
        expect(page.locator("#panel-live svg .note")).to_have_count(0)
        page.context.close()


@needs_browser
@pytest.mark.browser
@pytest.mark.wide
def test_the_room_why_asks_the_domain(chromium: Any) -> None:
    scenario = ("--scenario", "domains/housekeeping/scenario.yaml")
    with running_studio("--domain", "housekeeping", *scenario) as studio:
        page = opened_page(chromium, studio)
        press(page, "Pause")
        page.get_by_role("tab", name="Why").click()
        answer = page.get_by_role("status", name="answer")
        expect(answer).to_have_text(re.compile("^6 steps, "))
        step = page.get_by_role("button", name="wipe table2", exact=True)
        step.click()
        alternatives = page.get_by_role("list", name="alternatives")
        expect(alternatives).to_contain_text("why not go_to(agent,n5)?")
        expect(page.get_by_role("status", name="why not")).to_contain_text("clean(agent,table2)")
        page.get_by_label("Search").fill("isdirty")
        expect(page.get_by_role("list", name="knowledge")).to_contain_text(
            "holds(isdirty(table2),4)"
        )
        page.context.close()
