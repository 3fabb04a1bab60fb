"""What a browser finds behind the studio's address."""

from __future__ import annotations

import json
import os
import re
import socket
from pathlib import Path
from typing import Any

import pytest

from tests.support.browsing import (
    Lines,
    browser,
    cookie_of,
    expect,
    get,
    needs_browser,
    needs_studio,
    opened_page,
    running_studio,
)
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide
from waiter_cli.studio.page_files import page_files
from waiter_cli.studio.server import bind_port

pytestmark = needs_studio


def test_the_shell_is_for_anybody_and_all_else_needs_the_cookie() -> None:
    with running_studio() as studio:
        assert get(studio, "/healthz")[::2] == (200, b"ok")
        status, headers, shell = get(studio, "/")
        assert status == 200 and b"report" not in shell
        assert headers["content-security-policy"].startswith("default-src 'self'")
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert not [name for name in headers if name.startswith("access-control")]
        assert get(studio, "/page/main.js")[0] == 401
        assert get(studio, "/do/room", {})[0] == 401
        cookie = cookie_of(studio)
        assert get(studio, "/page/main.js", cookie=cookie)[0] == 200
        room = json.loads(get(studio, "/do/room", {}, cookie)[2])
        assert room["layout"] == "report" and "n5" in room["nodes"]
        assert get(studio, "/do/nothing", {}, cookie)[0] == 404
        assert get(studio, "/do/room", [], cookie)[0] == 400


def test_an_answer_does_not_wait_for_the_client_to_confirm_its_head() -> None:
    """asyncio sends at once where the listening socket names its protocol."""
    with bind_port(0) as listening:
        with socket.create_connection(listening.getsockname()), listening.accept()[0] as accepted:
            assert accepted.proto == socket.IPPROTO_TCP


def test_what_the_first_room_needs_is_asked_for_at_once() -> None:
    """`MODULES` of start.js are main.js and all that it leads to, and none of the other rooms."""

    def closure(name: str, found: set[str]) -> set[str]:
        if name not in found:
            found.add(name)
            for other in re.findall(r'^import .* from "\./(\w+)\.js";$', text(name), re.M):
                closure(other, found)
        return found

    def text(name: str) -> str:
        return page_files()[f"{name}.js"][0].decode()

    listed = re.search(r"const MODULES = \[(.*?)\];", text("start"), re.S)
    assert listed is not None
    assert sorted(re.findall(r'"(\w+)"', listed[1])) == sorted(closure("main", set()))
    for room in ("layout", "why"):
        assert f'await import("./{room}.js")' in text("main") and f'"{room}"' not in listed[1]


@needs_browser
@pytest.mark.browser
@pytest.mark.slow
def test_the_page_opens_and_things_have_their_names() -> None:
    with running_studio() as studio, browser() as found:
        page = opened_page(found, studio)
        assert "#" not in page.url
        for name in ("Live", "Layout", "Why"):
            expect(page.get_by_role("tab", name=name)).to_be_visible()
        floor = page.get_by_label("floor", exact=True)
        expect(floor).to_have_attribute("role", "application")
        for name in ("node n5", "table table1", "path n4 n5"):
            thing = floor.get_by_label(name, exact=True)
            thing.focus()
            assert page.evaluate("document.activeElement.getAttribute('aria-label')") == name


@needs_browser
@pytest.mark.browser
@pytest.mark.skipif("AXE_CORE" not in os.environ, reason="AXE_CORE names no axe.min.js")
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1280, 800), (820, 1180)])
def test_axe_finds_nothing(scheme: str, size: tuple[int, int]) -> None:
    look = "async () => (await axe.run()).violations.map(v => [v.id, v.nodes[0].html])"
    with running_studio("--scenario", "lunch", "--speed", "10") as studio, browser() as found:
        view = {"width": size[0], "height": size[1]}
        page = opened_page(found, studio, color_scheme=scheme, bypass_csp=True, viewport=view)
        page.add_script_tag(path=os.environ["AXE_CORE"])
        for _ in range(6):  # more wait than one card shows
            page.get_by_role("button", name="New guests", exact=True).click()
        for room in ("Live", "Layout", "Why"):
            page.get_by_role("tab", name=room).click()
            page.wait_for_timeout(300)
            assert page.evaluate(look) == []
        page.get_by_role("tab", name="Live").click()
        page.get_by_label("table table1", exact=True).click()
        page.wait_for_timeout(300)
        assert page.evaluate(look) == []


@pytest.mark.wide
def test_no_evening_begins_anew_where_it_cannot(tmp_path: Path) -> None:
    """The layout has faults by now, or a journal of the user's holds the one that is on."""
    layout = tmp_path / "my.yaml"
    text = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    layout.write_text(text)
    with running_studio("--layout", str(layout)) as studio, Lines(studio) as lines:
        lines.tell({"guests": 2})
        layout.write_text(text.replace("edges:", "edgy:"))
        status, _, body = get(studio, "/do/anew", {}, cookie_of(studio))
        assert status == 400 and json.loads(body)["error"]["line"]
        assert lines.tell({"ask": "state"})["state"]["waiting"]
        layout.write_text(text.replace("n5", "far"))
        assert get(studio, "/do/anew", {}, cookie_of(studio))[0] == 200
        assert "waiting" not in lines.tell({"ask": "state"})["state"]
        assert "far" in json.loads(get(studio, "/do/room", {}, cookie_of(studio))[2])["nodes"]
    journal = str(tmp_path / "evening.journal")
    with running_studio("--layout", str(layout), "--journal", journal) as studio:
        status, _, body = get(studio, "/do/anew", {}, cookie_of(studio))
        assert status == 400 and "evening.journal" in json.loads(body)["error"]["message"]


def test_who_comes_later_is_told_what_has_happened() -> None:
    with running_studio("--speed", "60") as studio, Lines(studio) as lines:
        lines.tell({"guests": 1})
        told = []
        while not told or "sits down" not in told[-1]:
            said = lines.said()
            told += [said["event"]["text"]] if "event" in said else []
        with Lines(studio) as later:
            heard = []
            while "whole" not in (said := later.said()):
                heard += [said["event"]["text"]] if "event" in said else []
        assert heard[0] == "c1 comes in"
        assert heard[heard.index(told[0]) :][: len(told)] == told


SCROLLS = ".beside, .plan, .events, .findings, .fields, .knowledge, .card, .steps, .text-pane"
FAULTS = """scrolls => {
  const found = [];
  const name = (each) => each.getAttribute("aria-label") ?? each.textContent.slice(0, 30);
  const root = document.documentElement;
  if (root.scrollWidth > innerWidth + 1 || root.scrollHeight > innerHeight + 1) found.push("the page scrolls");
  const shown = [...document.querySelectorAll("button, select, input, h1, p, [role=tab], .card, .floor-host")]
    .filter((each) => each.offsetParent);
  for (const each of shown) {
    const box = each.getBoundingClientRect();
    if (box.right > innerWidth + 1 || box.left < -1) found.push(`${name(each)} leaves the page sideways`);
    if (!each.parentElement.closest(scrolls) && (box.bottom > innerHeight + 1 || box.top < -1)) {
      found.push(`${name(each)} leaves the page`);
    }
    if (each.matches("button, select") && each.scrollWidth > each.clientWidth + 1) found.push(`${name(each)} is cut`);
  }
  const hands = shown.filter((each) => each.matches("button, select, input") && !each.closest(".events, .plan"));
  hands.forEach((one, i) => hands.slice(i + 1).forEach((other) => {
    const [a, b] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
    const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (wide > 2 && high > 2) found.push(`${name(one)} and ${name(other)} overlap`);
  }));
  return found;
}"""


@needs_browser
@pytest.mark.browser
@pytest.mark.slow
@pytest.mark.parametrize(
    ("width", "height", "touch"), [(1280, 800, False), (1920, 1080, False), (820, 1180, True)]
)
def test_nothing_overlaps_or_is_cut(width: int, height: int, touch: bool) -> None:
    """A laptop, a large screen, and a tablet held upright."""
    with running_studio("--scenario", "lunch") as studio, browser() as found:
        size = {"width": width, "height": height}
        page: Any = opened_page(found, studio, viewport=size, has_touch=touch)
        assert page.evaluate(FAULTS, SCROLLS) == []
        page.get_by_role("button", name="New guests").click()
        page.get_by_label("path mid2 mid3", exact=True).click()
        assert page.evaluate(FAULTS, SCROLLS) == []
        page.get_by_role("menuitem", name="block").click()
        page.get_by_role("tab", name="Layout").click()
        page.get_by_label("table table1", exact=True).click()
        page.get_by_label("Pinned scenario").select_option(label="2 guests arrive")
        page.get_by_text("minimal").wait_for()
        assert page.evaluate(FAULTS, SCROLLS) == []
        page.get_by_role("tab", name="Why").click()
        page.get_by_label("Situation").select_option(label="2 guests arrive")
        page.get_by_role("list", name="explained plan").get_by_role("listitem").first.wait_for()
        assert page.evaluate(FAULTS, SCROLLS) == []
        page.context.close()


TOUCHED = """() => {
  const boxes = (what) => [...document.querySelectorAll(`#panel-live ${what}`)].map((each) => each.getBoundingClientRect());
  const apart = (gap) => (a, b) =>
    a.right + gap < b.left || b.right + gap < a.left || a.bottom + gap < b.top || b.bottom + gap < a.top;
  const [word] = boxes(".entrance-name");
  const said = boxes(".bubble:not(.hushed)");
  return boxes(".bubble").length >= 8
    && boxes(".person-name").every((each) => apart(8)(each, word))
    && [...boxes(".figure .core"), ...said].every((each) => apart(0)(each, word))
    && said.every((one, i) => said.slice(i + 1).every((other) => apart(-2)(one, other)));
}"""


@needs_browser
@pytest.mark.browser
@pytest.mark.parametrize("size", mostly_wide([(1280, 800), (820, 1180)], (820, 1180)))
def test_no_name_of_who_waits_touches_the_word_entrance(size: tuple[int, int]) -> None:
    with running_studio("--speed", "60") as studio, browser() as found:
        page = opened_page(found, studio, viewport={"width": size[0], "height": size[1]})
        with Lines(studio) as lines:
            lines.tell({"observe": {"at": {"w1": "n4"}}})  # in the robot's way: nobody is fetched
            for _ in range(8):
                lines.tell({"guests": 1})
        page.wait_for_function(TOUCHED, timeout=20_000)  # once all of them stand there
        page.context.close()
