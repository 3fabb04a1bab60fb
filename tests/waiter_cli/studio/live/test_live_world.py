"""The room Live in a real browser: the four scenes, by pointer and by keyboard alone."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.browsing import (
    expect,
    needs_browser,
    needs_studio,
    opened_page,
    press,
    running_studio,
)

pytestmark = [needs_studio, needs_browser, pytest.mark.browser]


@pytest.fixture
def page(chromium: Any) -> Iterator[Any]:
    """The report's restaurant, paused, at full speed."""
    with running_studio("--layout", "report", "--speed", "60") as studio:
        page = opened_page(chromium, studio)
        press(page, "Pause")
        yield page
        page.context.close()


def proof(page: Any) -> Any:
    return page.get_by_role("status", name="proof")


def must_say(page: Any, steps: int) -> None:
    """Waits until the proof begins with so many steps."""
    expect(proof(page)).to_have_text(re.compile(f"^{steps} step{'' if steps == 1 else 's'}\\."))


def play_out(page: Any) -> None:
    """Plays until the plan is done, and pauses."""
    press(page, "Play")
    must_say(page, 0)
    press(page, "Pause")
    expect(page.locator("[aria-label=plan] [aria-current]")).to_have_count(0)


def choose(page: Any, thing: str, item: str) -> None:
    page.get_by_label(thing, exact=True).click()
    page.get_by_role("menuitem", name=item, exact=True).click()


def test_the_scenes_of_the_report_by_clicks_alone(page: Any) -> None:
    press(page, "New guests")
    must_say(page, 7)
    expect(proof(page)).to_contain_text("Minimal: a lower bound proves that 6 are too few")
    expect(page.get_by_label("party c1", exact=True)).to_have_count(1)
    rows = page.get_by_role("list", name="plan").get_by_role("listitem")
    expect(rows).to_have_count(7)
    expect(rows.nth(0)).to_have_attribute("aria-current", "step")
    play_out(page)
    expect(rows).to_have_count(7)
    page.get_by_label("Guests", exact=True).fill("4")
    press(page, "New guests")
    must_say(page, 4)
    expect(rows).to_have_count(4)
    play_out(page)
    choose(page, "table table1", "wants the bill")
    must_say(page, 1)
    play_out(page)
    choose(page, "table table2", "wants the bill")
    must_say(page, 1)
    play_out(page)
    log = page.get_by_role("log", name="events").text_content()
    assert "table2 gets its bill" in log and "sit down at table2" in log


KEYS_TO = """target => {
  const svg = document.activeElement.closest("svg.floor");
  const start = document.activeElement;
  const ways = new Map([[start.dataset.thing, []]]);
  for (const [here, keys] of ways) {
    for (const key of ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"]) {
      const thing = svg.querySelector(`[data-thing="${here}"]`);
      thing.focus();
      thing.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
      const there = document.activeElement.dataset.thing;
      if (!ways.has(there)) ways.set(there, [...keys, key]);
    }
  }
  start.focus();
  const all = [...svg.querySelectorAll("[data-thing][tabindex]")].map((each) => each.dataset.thing);
  return [ways.get(target), all.filter((each) => !ways.has(each))];
}"""


class Keyboard:
    """A person without a pointer: what has the focus was reached by keys alone."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def here(self) -> str:
        """The accessible name of what has the focus."""
        return str(
            self.page.evaluate(
                "() => { const a = document.activeElement; return a.getAttribute('aria-label') ?? a.textContent; }"
            )
        )

    def tab_to(self, name: str, key: str = "Tab") -> None:
        """Goes on by Tab until something has the focus."""
        for _ in range(60):
            if self.here() == name:
                return
            self.press(key)
        raise AssertionError(f"{name} is not reached by {key}")

    def floor_to(self, name: str) -> None:
        """Goes to the floor by Tab, then to a thing by arrow keys; nothing is out of their reach."""
        for _ in range(60):
            if self.page.evaluate("() => !!document.activeElement.closest('svg.floor')"):
                break
            self.press("Tab")
        self.page.wait_for_timeout(250)  # until nobody glides any more
        keys, unreached = self.page.evaluate(KEYS_TO, name)
        assert unreached == []
        self.press(*keys)
        assert self.here() == name

    def choose(self, item: str) -> None:
        """Opens the menu of what has the focus, and chooses an item of it."""
        self.press("Enter")
        self.page.get_by_role("menuitem", name=item, exact=True).wait_for()
        for _ in range(self.page.get_by_role("menuitem").count()):
            if self.here() == item:
                self.press("Enter")
                expect(self.page.get_by_role("menu")).to_have_count(0)
                return
            self.press("ArrowDown")
        raise AssertionError(f"no {item} in the menu")


@pytest.mark.slow
def test_the_whole_by_keyboard_alone(page: Any) -> None:
    """Each menu, what is otherwise dragged, and the tabs."""
    keyboard = Keyboard(page)
    keyboard.tab_to("Guests")
    keyboard.press("Control+a", "2")
    keyboard.tab_to("New guests", "Shift+Tab")
    keyboard.press("Enter")
    must_say(page, 7)
    keyboard.floor_to("path n4 n5")
    keyboard.choose("block")
    page.get_by_text("There is no plan").first.wait_for()
    keyboard.choose("clear")
    must_say(page, 7)
    keyboard.floor_to("node n4")
    keyboard.choose("send w1 here")
    page.get_by_role("list", name="diagnosis").wait_for()
    keyboard.floor_to("waiter w1")
    keyboard.choose("go to n7")
    must_say(page, 7)
    keyboard.tab_to("Play", "Shift+Tab")
    keyboard.press("Enter")
    must_say(page, 0)
    keyboard.tab_to("Pause")
    keyboard.press("Enter")
    keyboard.floor_to("party c1")
    keyboard.press("Enter", "Escape")
    expect(page.get_by_role("menu")).to_have_count(0)
    assert keyboard.here() == "party c1"
    keyboard.floor_to("table table1")
    keyboard.choose("wants the bill")
    must_say(page, 1)
    assert keyboard.here() == "table table1"
    keyboard.tab_to("Time")
    keyboard.press("Home")
    page.get_by_text("Looking back at 0:00").wait_for()
    keyboard.press("End")
    keyboard.tab_to("Keep", "Shift+Tab")
    with page.expect_download() as kept:
        keyboard.choose("plan (JSON)")
    assert kept.value.suggested_filename == "plan.json"
    keyboard.tab_to("Live", "Shift+Tab")
    keyboard.press("ArrowRight")
    assert keyboard.here() == "Layout"
    page.get_by_label("YAML", exact=True).wait_for()
    keyboard.press("ArrowRight")
    assert keyboard.here() == "Why"
    page.get_by_role("list", name="explained plan").wait_for()
    keyboard.press("Home")
    assert keyboard.here() == "Live"


@pytest.mark.slow
def test_a_colleague_is_dragged_and_the_robot_explains(page: Any) -> None:
    press(page, "New guests")
    must_say(page, 7)
    waiter = page.get_by_label("waiter w1", exact=True).bounding_box()
    node = page.get_by_label("node n4", exact=True).locator(".core").bounding_box()
    page.mouse.move(waiter["x"] + waiter["width"] / 2, waiter["y"] + 20)
    page.mouse.down()
    page.mouse.move(node["x"] + 60, node["y"] + 20, steps=4)
    page.mouse.move(node["x"] + 8, node["y"] + 8, steps=4)
    page.mouse.up()
    page.get_by_role("list", name="diagnosis").wait_for()
    stories = page.get_by_role("list", name="diagnosis")
    expect(stories).to_have_text(re.compile("^w1 walked from n7 to n4"))
    page.wait_for_function(
        """() => { const at = name => document.querySelector(`[data-thing="${name}"] .core`).getBoundingClientRect();
           const [a, b] = [at('waiter w1'), at('node n4')];
           return Math.hypot(a.x + a.width / 2 - b.x - b.width / 2, a.y + a.height / 2 - b.y - b.height / 2) < 9; }"""
    )
    expect(proof(page)).to_contain_text("There is no plan")
    pending = page.get_by_role("list", name="pending")
    expect(pending).to_contain_text("c1 is seated")
    expect(pending).to_contain_text("w1 stands")
    # By keyboard: sent back from his menu.
    page.get_by_label("waiter w1", exact=True).focus()
    page.keyboard.press("Enter")
    page.get_by_role("menuitem", name="go to n7").focus()
    page.keyboard.press("Enter")
    must_say(page, 7)


@pytest.mark.wide
def test_whoever_the_plan_is_for_is_on_the_floor_when_the_plan_is_told(page: Any) -> None:
    """Also on a page that draws no frame, as one in the background: no list is ahead of the floor."""
    page.evaluate("() => { window.requestAnimationFrame = () => 0; }")
    press(page, "New guests")
    must_say(page, 7)
    assert page.get_by_label("party c1", exact=True).count() == 1


@pytest.mark.wide
def test_a_path_is_blocked_and_cleared(page: Any) -> None:
    press(page, "New guests")
    must_say(page, 7)
    page.get_by_label("path n4 n5", exact=True).click(button="right")
    page.get_by_role("menuitem", name="block").click()
    expect(proof(page)).to_contain_text("no plan")
    expect(page.get_by_label("path n4 n5", exact=True)).to_have_class(re.compile("blocked"))
    choose(page, "path n4 n5", "clear")
    must_say(page, 7)


@pytest.mark.slow
def test_while_paused_nothing_moves(page: Any) -> None:
    press(page, "New guests")
    must_say(page, 7)
    robot = page.get_by_label("robot agent", exact=True)
    at = robot.get_attribute("transform")
    page.wait_for_timeout(300)
    assert robot.get_attribute("transform") == at
    press(page, "Step")
    must_say(page, 6)
    page.wait_for_function(
        "at => document.querySelector('[aria-label=\"robot agent\"]').getAttribute('transform') !== at",
        arg=at,
    )
    page.wait_for_timeout(200)
    expect(proof(page)).to_have_text(re.compile("^6 steps"))


@pytest.mark.slow
def test_looking_back_and_to_now(page: Any) -> None:
    press(page, "New guests")
    must_say(page, 7)
    play_out(page)
    page.wait_for_timeout(300)  # the last of its glide
    robot = page.get_by_label("robot agent", exact=True)
    now = robot.get_attribute("transform")
    page.get_by_label("Time", exact=True).fill("1")
    page.get_by_role("button", name="Now", exact=True).wait_for()
    page.wait_for_function(
        "at => document.querySelector('.robot').getAttribute('transform') !== at", arg=now
    )
    expect(page.get_by_role("alert")).to_contain_text("Looking back")
    press(page, "Now")
    page.wait_for_function(
        "at => document.querySelector('.robot').getAttribute('transform') === at", arg=now
    )
    expect(page.get_by_role("alert")).not_to_be_visible()


@pytest.mark.slow
def test_a_long_press_opens_the_menu(chromium: Any) -> None:
    with running_studio() as studio:
        page = opened_page(
            chromium, studio, has_touch=True, viewport={"width": 820, "height": 1180}
        )
        box = page.get_by_label("table table1", exact=True).locator(".cloth").bounding_box()
        x, y = box["x"] + 9, box["y"] + 9
        touch = page.context.new_cdp_session(page)
        touch.send(
            "Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]}
        )
        page.get_by_role("menu", name="table table1").wait_for(timeout=3000)
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        page.wait_for_timeout(150)
        expect(page.get_by_role("menu")).to_have_count(1)
        page.context.close()


@pytest.mark.slow
def test_two_pages_see_the_same_evening(chromium: Any) -> None:
    with running_studio() as studio:
        first = opened_page(chromium, studio)
        press(first, "Pause")
        second = first.context.new_page()
        second.goto(re.sub("#.*", "", studio.url))
        second.wait_for_selector('body[data-ready="true"]')
        press(second, "New guests")
        must_say(first, 7)
        must_say(second, 7)
        first.get_by_text("Another page has changed the evening.").wait_for()
        first.context.close()


@pytest.mark.wide
def test_what_people_called_themselves_is_text(page: Any) -> None:
    """No name can hold markup; a text of the studio that did would be shown as it is."""
    assert page.evaluate(
        """async () => {
          const { make } = await import('/page/build.js');
          const shown = make('p', {}, '<img src=x onerror=alert(1)>');
          return [shown.childElementCount, shown.textContent];
        }"""
    ) == [0, "<img src=x onerror=alert(1)>"]
