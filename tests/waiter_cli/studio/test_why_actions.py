"""The room Why: what its actions answer, and the room itself in a real browser."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

import waiter_cli
from tests.support.browsing import (
    browser,
    expect,
    needs_browser,
    needs_studio,
    opened_page,
    running_studio,
)
from tests.support.paths import ROOT
from waiter_cli.errors import InputError
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.studio.opened import Opened, open_files
from waiter_cli.studio.page_requests import BadRequest
from waiter_cli.studio.why_actions import WHY_ACTIONS


@pytest.fixture(scope="module")
def opened() -> Opened:
    planner = OnlinePlanner(
        waiter_cli.find_translator("native"), waiter_cli.find_domain("restaurant")
    )
    return open_files("report", "b1", planner)


def ask(opened: Opened, name: str, scenario: str = "b1", **given: Any) -> dict[str, Any]:
    if "\n" not in scenario and scenario:
        scenario = (ROOT / "layouts" / "scenarios" / f"{scenario}.yaml").read_text(encoding="utf-8")
    asked = {"layout": opened.text, "scenario": scenario, "enter": 0, **given}
    return WHY_ACTIONS[name](opened, asked)


def test_a_plan_with_its_frames(opened: Opened) -> None:
    found = ask(opened, "why_plan")
    assert (found["horizon"], found["minimal"], len(found["frames"])) == (7, True, 8)
    assert found["frames"][0]["waiting"] == [["c1"]]
    assert found["frames"][-1]["seated"] == {"table1": ["c1"]}
    assert ask(opened, "why_plan", "", enter=2)["horizon"] == 7


def test_a_plan_that_brings_chairs_has_its_frames(opened: Opened) -> None:
    """The number of chairs is a number in a document, and a term in a plan."""
    bistro = open_files("bistro", None, opened.planner)
    found = ask(bistro, "why_plan", "", enter=6)
    assert "bring_chairs" in {each["name"] for each in found["steps"]}
    assert len(found["frames"]) == found["horizon"] + 1
    assert "table5" in found["frames"][-1]["seated"]


def test_a_step_has_alternatives_and_an_action_its_price(opened: Opened) -> None:
    texts = [each["text"] for each in ask(opened, "why_else", step=4)["actions"]]
    assert texts == ["go_to(agent,n4)", "go_to(agent,n6)", "go_to(agent,n0)"]
    assert "costs 2 more: 9 steps" in ask(opened, "why_not", action="go_to(agent,n0)")["words"]
    assert "minimal plan" in ask(opened, "why_not", action="seat(agent,c1,table2)")["words"]
    assert ask(opened, "why_not", action="give_bill(agent,table2)")["words"].startswith("No plan")
    own = ask(opened, "why_not", action="pick(agent,c1)")["words"]
    assert own == "pick(agent,c1) is part of a minimal plan of 7 steps."
    with pytest.raises(InputError):
        ask(opened, "why_not", action="dance(agent)")


def test_each_of_several_robots_has_alternatives_that_have_their_price(
    opened: Opened, tmp_path: Path
) -> None:
    file = tmp_path / "two.yaml"
    file.write_text(
        "name: two\nnodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [2, 2]}\nedges: [[a, b], [b, c], [b, d]]\n"
        "entrance: a\ntables: {t: {capacity: 2, nodes: [c]}}\nagents: {r1: a, r2: d}\n"
    )
    two = open_files(str(file), None, opened.planner)
    first = ask(two, "why_plan", "", enter=1)["steps"][0]
    assert first["text"] == "pick(r1,c1)"
    texts = [each["text"] for each in ask(two, "why_else", "", enter=1, step=0)["actions"]]
    assert texts == ["go_to(r1,b)", "go_to(r2,b)"]
    words = ask(two, "why_not", "", enter=1, action="go_to(r1,b)")["words"]
    assert "costs" in words or "part of a minimal plan" in words


def test_no_plan_has_causes_and_changes_that_can_be_tried_and_kept(opened: Opened) -> None:
    found = ask(opened, "why_plan", "blocked_aisle")
    (causes,) = found["conflicts"]
    assert [(each["about"], each["in"], each["line"]) for each in causes] == [
        (["waiter w1"], "scenario", 7),
        (["party c1"], "scenario", 10),
    ]
    change = found["changes"][0]
    tried = ask(opened, "why_try", "blocked_aisle", change=0)
    assert tried["horizon"] == change["horizon"] == 7
    kept = change["keep"]["text"]
    assert re.sub("n4|n7", "", kept) != kept and "# No plan" in kept
    assert ask(opened, "why_plan", kept)["horizon"] == 7
    with pytest.raises(BadRequest):
        ask(opened, "why_try", "blocked_aisle", change=9)


@pytest.mark.parametrize("scenario", ["too_big", "unwanted_bill", "blocked_aisle"])
def test_what_is_kept_gives_the_plan_that_was_promised(opened: Opened, scenario: str) -> None:
    """Every change that can be kept is: the texts after it have a plan of as many steps."""
    from waiter_cli.editing.edits import edited_text

    text = (ROOT / "layouts" / "scenarios" / f"{scenario}.yaml").read_text(encoding="utf-8")
    changes = [each for each in ask(opened, "why_plan", text)["changes"] if each["keep"]]
    assert changes
    for change in changes:
        keep = change["keep"]
        if keep["in"] == "layout":
            layout, _ = edited_text(opened.text, keep["edits"])
            found = ask(opened, "why_plan", text, layout=layout)
        else:
            found = ask(opened, "why_plan", keep["text"])
        assert found["horizon"] == change["horizon"], change["message"]


def test_what_is_known_at_a_step(opened: Opened) -> None:
    rows = {each["text"]: each for each in ask(opened, "why_known", step=5)["literals"]}
    followed = rows["holds(iswith(agent,c1),5)"]
    assert followed["change"] == "new"
    assert (
        "A party that was picked up follows the robot and waits no longer." in followed["sentences"]
    )
    assert rows["holds(iswaiting(c1),4)"]["change"] == "gone"
    assert rows["holds(currentlocation(w1,n7),5)"]["change"] == "same"
    free = rows["holds(isfree(table1),5)"]["sentences"]
    assert free == ["A table is not free while a party sits at it, and free otherwise."]
    found = ask(opened, "why_known", step=5, grep="isfree", positive=True)["literals"]
    assert [each["text"] for each in found] == [
        "holds(isfree(table1),5)",
        "holds(isfree(table2),5)",
    ]
    changed = ask(opened, "why_known", step=5, changed=True)["literals"]
    assert {each["change"] for each in changed} == {"new", "gone"}
    with pytest.raises(InputError):
        ask(opened, "why_known", step=5, grep="(")


def test_the_plan_that_is_known_is_the_one_that_is_shown(opened: Opened) -> None:
    for step in ask(opened, "why_plan", "b2")["steps"]:
        known = ask(opened, "why_known", "b2", step=step["step"], grep="^occurs")["literals"]
        assert [each["text"] for each in known] == [f"occurs({step['text']},{step['step']})"]


def test_faults_of_the_texts_have_their_places(opened: Opened) -> None:
    with pytest.raises(InputError) as caught:
        ask(opened, "why_plan", "observe:\n  - bill: tabel1\n")
    assert caught.value.faults[0].where is not None and caught.value.faults[0].where.line == 2
    with pytest.raises(BadRequest):
        ask(opened, "why_plan", enter=10**6)
    with pytest.raises(BadRequest):
        WHY_ACTIONS["why_scenario"](opened, {"name": "../report"})


def hold_up(action: str, route: Any, held: list[Any]) -> None:
    """Keeps the question about one action back; the others go on."""
    if route.request.post_data_json["action"] == action:
        held.append(route)
    else:
        route.continue_()


@pytest.mark.browser
@needs_browser
@needs_studio
@pytest.mark.wide
def test_a_blocked_aisle_is_explained_and_its_mend_tried_and_kept(tmp_path: Path) -> None:
    file = Path(shutil.copy(ROOT / "layouts" / "report.yaml", tmp_path / "my.yaml"))
    text = file.read_text().replace("waiters: {w1: n7} ", "waiters: {w1: n4} ")
    file.write_text(text)
    scenario = tmp_path / "guest.yaml"
    scenario.write_text("observe:\n  - enter: [c1]\ngoals:\n  - seated: [c1]\n")
    with (
        running_studio("--layout", str(file), "--scenario", str(scenario)) as studio,
        browser() as found,
    ):
        page = opened_page(found, studio, viewport={"width": 1280, "height": 800})
        page.get_by_role("button", name="Pause", exact=True).click()
        page.get_by_role("tab", name="Why", exact=True).click()
        page.get_by_role("list", name="causes").get_by_text("w1 stands at n4").wait_for()
        expect(page.locator("#panel-why [data-thing='waiter w1'].cause")).to_have_count(1)
        expect(page.locator("#panel-why [aria-label=layout] .gutter .bad")).to_have_count(1)
        page.get_by_role("button", name=re.compile("^Try it: if w1 stood")).click()
        answer = page.get_by_role("status", name="answer")
        page.get_by_role("button", name="Back to what is").wait_for()
        expect(answer).to_contain_text("7 steps")
        page.get_by_role("button", name="Next step").press("Enter")
        known = page.get_by_role("list", name="knowledge")
        known.get_by_text("holds(currentlocation(agent,n2),1)", exact=False).first.wait_for()
        expect(page.locator("#panel-why [data-thing='robot agent']")).to_have_attribute(
            "transform", re.compile(r"^translate\(-4\.700 -0\.150\)")
        )
        page.get_by_role("button", name="Back to what is").click()
        page.get_by_role("button", name=re.compile("^Keep it: if w1 stood")).click()
        page.get_by_role("list", name="explained plan").wait_for()
        held: list[Any] = []
        page.route("**/do/why_not", lambda route: hold_up("pick(agent,c1)", route, held))
        page.get_by_role("button", name="ask c1 to follow").click()
        page.get_by_role("button", name="why not go_to(agent,n0)?").click()
        page.get_by_text("go_to(agent,n0) costs 2 more", exact=False).wait_for()
        with page.expect_response("**/do/why_not"):
            held.pop().continue_()
        page.wait_for_timeout(100)
        expect(page.get_by_role("status", name="why not")).to_contain_text("costs 2 more")
        page.unroute("**/do/why_not")
        page.get_by_label("Situation").select_option("now")
        page.get_by_role("list", name="causes").get_by_text("w1 stands at n4").wait_for()
        now = page.get_by_label("Scenario YAML")
        expect(now).to_have_value(re.compile(r'^# The evening as it is\.[^\0]*"w1": "n4"'))
        page.get_by_role("tab", name="Layout", exact=True).click()
        page.get_by_role("button", name="Save").click()
        page.get_by_text("my.yaml: saved").wait_for()
        assert re.sub("w1: n[0-9]", "", file.read_text()) == text.replace("w1: n4", "")
        assert file.read_text() != text
