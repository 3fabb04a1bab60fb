"""The room Layout in a real browser: a restaurant drawn, edited, mended, saved."""

from __future__ import annotations

import json
import re
import shutil
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path
from typing import Any

import pytest

from tests.support.browsing import (
    expect,
    needs_browser,
    needs_studio,
    opened_page,
    running_studio,
)
from tests.support.paths import ROOT

pytestmark = [pytest.mark.browser, needs_browser, needs_studio]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return Path(shutil.copy(ROOT / "layouts" / "report.yaml", tmp_path / "my.yaml"))


def layout_room(chromium: Any, studio: Any, **context: Any) -> Any:
    page = opened_page(chromium, studio, **{"viewport": {"width": 1280, "height": 800}, **context})
    page.wrong = []
    page.on("pageerror", lambda error: page.wrong.append(str(error)))
    page.get_by_role("tab", name="Layout").click()
    page.get_by_label("YAML").wait_for()
    wait(page, "document.querySelector('[aria-label=YAML]').value.length > 10")
    return page


def wait(page: Any, what: str, given: Any = None) -> None:
    """Waits until an expression of the page is true; its policy lets nothing wait inside."""
    until = time.monotonic() + 15
    while not page.evaluate(f"given => {what}", given):
        assert time.monotonic() < until, what
        page.wait_for_timeout(20)


def text_of(page: Any) -> str:
    return str(page.get_by_label("YAML").input_value())


def until(page: Any, what: str) -> None:
    """Waits until the text on the page holds something."""
    wait(page, "document.querySelector('[aria-label=YAML]').value.includes(given)", what)


def place(page: Any, x: float, y: float) -> tuple[float, float]:
    """Where metres of the floor are on the screen."""
    found = page.evaluate(
        """([x, y]) => {
            const svg = document.querySelector('#panel-layout svg.floor');
            const at = new DOMPoint(x, -y).matrixTransform(svg.getScreenCTM());
            return [at.x, at.y];
        }""",
        [x, y],
    )
    return found[0], found[1]


def planned(layout: Path, *options: str) -> dict[str, Any]:
    command = [
        sys.executable,
        "-m",
        "waiter_cli",
        "plan",
        "--json",
        "--layout",
        str(layout),
        *options,
    ]
    run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    return dict(json.loads(run.stdout))


def test_six_tables_from_an_empty_floor(chromium: Any, tmp_path: Path) -> None:
    """A restaurant drawn by clicks alone is saved, and planned in as many steps by `waiter plan`."""
    file = Path(shutil.copy(ROOT / "layouts" / "report.yaml", tmp_path / "my.yaml"))
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        page.get_by_role("button", name="Empty floor").click()
        until(page, "nodes: {}")
        wait(page, "!document.querySelector('#panel-layout [data-thing=\"node n1\"]')")
        page.get_by_role("button", name="Add path").click()
        for number, at in enumerate([(1, 3), (3, 3), (5, 3), (7, 3)], 1):
            page.mouse.click(*place(page, *at))
            until(page, f"n{number}:")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="Add table").click()
        for number, at in enumerate(
            [(3, 4.5), (5, 4.5), (7, 4.5), (3, 1.5), (5, 1.5), (7, 1.5)], 1
        ):
            page.mouse.click(*place(page, *at))
            until(page, f"table{number}:")
        page.keyboard.press("Escape")
        page.get_by_label("Pinned scenario").select_option(label="2 guests arrive")
        status = page.get_by_role("status", name="pinned plan")
        wait(
            page,
            "document.querySelector('[aria-label=\"pinned plan\"]').textContent.includes('steps')",
        )
        page.get_by_role("button", name="Save").click()
        wait(page, "document.querySelector('[aria-label=file]').textContent.endsWith(': saved')")
        found = planned(file, "--enter", "2")
        assert found["status"] == "plan" and found["minimal"]
        expect(status).to_have_text(re.compile(f"^{found['horizon']} steps"))
        assert file.read_text().count("capacity") == 6
        assert page.wrong == []


@pytest.mark.wide
def test_a_drag_changes_its_own_characters_only(chromium: Any, file: Path) -> None:
    before = file.read_text()
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        page.mouse.move(*place(page, 0, -2.6))
        page.mouse.down()
        page.mouse.move(*place(page, 0.2, -2.5), steps=4)
        page.mouse.move(*place(page, 0.63, -2.43), steps=4)
        page.mouse.up()
        until(page, "at: [0.65, -2.45]")
        assert text_of(page) == before.replace("at: [0, -2.6]", "at: [0.65, -2.45]")
        page.keyboard.press("ArrowLeft")
        until(page, "at: [0.6, -2.45]")
        page.keyboard.press("Shift+ArrowUp")
        until(page, "at: [0.6, -1.95]")
        for _ in range(3):
            page.get_by_role("button", name="Undo").click()
        assert text_of(page) == before
        page.get_by_role("button", name="Redo").click()
        until(page, "at: [0.65, -2.45]")
        page.keyboard.press("Control+s")
        wait(page, "document.querySelector('[aria-label=file]').textContent.endsWith(': saved')")
        assert file.read_text() == before.replace("at: [0, -2.6]", "at: [0.65, -2.45]")
        assert page.wrong == []


@pytest.mark.slow
def test_what_is_typed_moves_on_the_floor_and_names_change_everywhere(
    chromium: Any, file: Path
) -> None:
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        area = page.get_by_label("YAML")
        area.fill(text_of(page).replace("n6: [0, -1.75]", "n6: [1, -1.75]"))
        wait(
            page,
            "document.querySelector('#panel-layout [data-thing=\"node n6\"] .spot').getAttribute('cx') === '1'",
        )
        page.get_by_role("button", name="node n6", exact=True).focus()
        page.get_by_label("Name", exact=True).fill("window")
        page.get_by_label("Name", exact=True).press("Enter")
        until(page, "window: [1, -1.75]")
        assert "n6" not in text_of(page).partition("name:")[2]
        page.get_by_role("button", name="node window", exact=True).wait_for()
        area.fill("nodes: [")
        wait(page, "document.querySelectorAll('[aria-label=findings] .bad').length > 0")
        assert page.wrong == []


@pytest.mark.slow
def test_a_mend_is_one_click_away(chromium: Any, file: Path) -> None:
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        findings = page.get_by_role("list", name="findings")
        findings.get_by_role("button", name="Delete n0").first.click()
        wait(page, "!document.querySelector('[aria-label=YAML]').value.includes('n0:')")
        assert "[n0, n5]" not in text_of(page)
        wait(
            page,
            "!document.querySelector('[aria-label=findings]').textContent.includes('dead end')",
        )


@pytest.mark.slow
def test_a_change_made_elsewhere_is_asked_about(chromium: Any, file: Path) -> None:
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        page.get_by_role("button", name="node n0", exact=True).focus()
        page.keyboard.press("ArrowUp")
        until(page, "n0: [-1.9, -2.85]")
        theirs = file.read_text() + "# theirs\n"
        file.write_text(theirs)
        page.get_by_role("button", name="Save").click()
        question = page.get_by_role("dialog", name="Changed elsewhere")
        question.get_by_role("button", name="Cancel").click()
        assert file.read_text() == theirs
        page.get_by_role("button", name="Save").click()
        question.get_by_role("button", name="Write over it").click()
        wait(page, "document.querySelector('[aria-label=file]').textContent.endsWith(': saved')")
        assert file.read_text() == theirs.replace("# theirs\n", "").replace(
            "-1.9, -2.9", "-1.9, -2.85"
        )


def picture(width: int, height: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        whole = kind + data
        return struct.pack(">I", len(data)) + whole + struct.pack(">I", zlib.crc32(whole))

    rows = b"".join(b"\0" + b"\xff\xc0\x80" * width for _ in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


@pytest.mark.slow
def test_a_picture_is_laid_under_and_scaled(chromium: Any, file: Path) -> None:
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        chooser = page.get_by_label("Floor plan picture")
        chooser.set_input_files({"name": "a.txt", "mimeType": "text/plain", "buffer": b"no"})
        page.get_by_text("a.txt is no PNG or JPEG").wait_for()
        chooser.set_input_files(
            {"name": "p.png", "mimeType": "image/png", "buffer": picture(200, 100)}
        )
        image = page.locator("#panel-layout .layer-picture image")
        image.wait_for(state="attached")
        wide, high = (float(image.get_attribute(f"data-{side}")) for side in ("width", "height"))
        assert wide == pytest.approx(2 * high, abs=0.01)
        page.get_by_role("button", name="Scale picture").click()
        page.mouse.click(*place(page, -4, 0))
        page.mouse.click(*place(page, -2, 0))
        page.get_by_label("Metres between the points").fill("4")
        page.get_by_role("button", name="Set scale").click()
        wait(
            page,
            "Math.abs(document.querySelector('#panel-layout .layer-picture image').dataset.width / given - 1) < 0.02",
            2 * wide,
        )
        page.get_by_role("button", name="Remove picture").click()
        expect(image).to_have_count(0)
        assert page.wrong == []


@pytest.mark.slow
def test_all_of_it_by_keys(chromium: Any, file: Path) -> None:
    """A node, a path and a table without the mouse; several things at once; deleted and undone."""
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        before = text_of(page)
        page.get_by_role("button", name="node n0", exact=True).focus()
        page.get_by_role("button", name="Add node").press("Enter")
        page.keyboard.press("Shift+ArrowLeft")
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("Enter")
        until(page, "n8: [-2.45, -2.9]")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="node n8", exact=True).focus()
        page.get_by_role("button", name="Add path").press("Enter")
        page.keyboard.press("Shift+ArrowRight")
        page.keyboard.press("Enter")
        until(page, "- [n8, n0]")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="node n8", exact=True).focus()
        page.keyboard.press("Control+Shift+ArrowRight")  # the path
        page.keyboard.press("Control+Shift+ArrowRight")  # and its other end
        page.keyboard.press("ArrowUp")
        until(page, "n8: [-2.45, -2.85]")
        until(page, "n0: [-1.9, -2.85]")
        page.keyboard.press("Control+z")
        until(page, "n8: [-2.45, -2.9]")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="node n8", exact=True).focus()
        page.keyboard.press("Delete")
        wait(page, "!document.querySelector('[aria-label=YAML]').value.includes('n8')")
        assert text_of(page) == before
        page.get_by_role("button", name="waiter w1", exact=True).focus()
        page.keyboard.press("ArrowLeft")
        until(page, "waiters: {w1: n4}")
        page.get_by_role("button", name="robot agent", exact=True).focus()
        page.keyboard.press("ArrowUp")
        until(page, "agent: n2")
        assert page.wrong == []


@pytest.mark.wide
def test_a_second_robot_is_added_named_moved_and_taken_away(chromium: Any, file: Path) -> None:
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        before = text_of(page)
        yaml = page.get_by_label("YAML", exact=True)
        board = page.locator("#panel-layout")

        def thing(name: str) -> Any:
            return board.get_by_role("button", name=name, exact=True)

        thing("Add robot").click()
        thing("node n2").click()
        expect(yaml).to_have_value(before.replace("agent: n1", "agents: {r1: n1, r2: n2}"))
        page.keyboard.press("Escape")  # the focus is on the tool still
        expect(thing("Add robot")).to_have_attribute("aria-pressed", "false")
        expect(thing("robot r2")).to_have_attribute("aria-pressed", "true")
        name = board.get_by_label("Name", exact=True)
        name.fill("carla")
        name.press("Enter")
        expect(yaml).to_have_value(re.compile(r"agents: \{r1: n1, carla: n2\}"))
        expect(thing("robot carla")).to_have_attribute("aria-pressed", "true")
        start, goal = place(page, -4.7, 0.15), place(page, -1.9, -2.9)
        page.mouse.move(*start)
        page.mouse.down()
        page.mouse.move((start[0] + goal[0]) / 2, goal[1], steps=3)
        page.mouse.move(*goal, steps=3)
        page.mouse.up()
        expect(yaml).to_have_value(re.compile(r"agents: \{r1: n1, carla: n0\}"))
        expect(thing("robot carla")).to_have_count(1)
        thing("robot r1").focus()
        page.keyboard.press("Delete")
        expect(yaml).to_have_value(re.compile(r"agents: \{carla: n0\}"))
        expect(thing("robot r1")).to_have_count(0)
        for _ in range(4):
            thing("Undo").click()
        expect(yaml).to_have_value(before)
        expect(thing("robot agent")).to_have_count(1)
        thing("node n3").focus()
        thing("Add robot").press("Enter")  # by keys: the cross begins on what is selected
        page.keyboard.press("Enter")
        expect(yaml).to_have_value(before.replace("agent: n1", "agents: {r1: n1, r2: n3}"))
        assert page.wrong == []
        page.context.close()


@pytest.mark.slow
def test_snapping_history_and_line_breaks(chromium: Any, file: Path) -> None:
    """The page's own logic: alignment before the grid, splices that undo, CR LF that stays."""
    with running_studio("--layout", str(file)) as studio:
        page = layout_room(chromium, studio)
        found = page.evaluate(
            """async () => {
                const { snap } = await import('/page/layout_snap.js');
                const { History } = await import('/page/layout_history.js');
                const { typed } = await import('/page/layout_text.js');
                const history = new History('a: 1\\nb: 2\\n');
                const texts = ['a: 1\\nb: 3\\n', '', 'ab', 'aab'];
                const seen = [];
                for (const text of texts) history.push(text, 'x');
                while (history.undo()) seen.push(history.text);
                while (history.redo()) seen.push(history.text);
                return {
                    grid: snap([1.023, 0.98], []).at, line: snap([1.02, 5], [[1.013, 2]]).at,
                    guides: snap([1.02, 5], [[1.013, 2]]).guides.length, free: snap([1.023, 5], [[1, 5]], true).at,
                    seen, typed: typed('a\\r\\nb\\nc\\r\\n', 'a\\nbX\\nc\\n'),
                };
            }"""
        )
        assert found["grid"] == [1, 1] and found["line"] == [1.013, 5] and found["guides"] == 1
        assert found["free"] == [1.023, 5]
        first, second = "a: 1\nb: 2\n", "a: 1\nb: 3\n"
        assert found["seen"] == ["ab", "", second, first, second, "", "ab", "aab"]
        assert found["typed"] == "a\r\nbX\nc\r\n"


@pytest.mark.wide
def test_after_a_save_a_new_evening_begins_in_that_layout(chromium: Any, file: Path) -> None:
    """Who lives in the old layout is told; each page goes on in the new one, and Layout keeps its history."""
    with running_studio("--layout", str(file), "--speed", "2") as studio:
        page = layout_room(chromium, studio)
        other = page.context.new_page()
        other.goto(studio.url.partition("#")[0])
        other.get_by_label("node n5", exact=True).wait_for()
        notice = other.get_by_role("status", name="layout")
        expect(notice).not_to_be_visible()
        page.get_by_label("node n5", exact=True).click()
        page.get_by_label("Name", exact=True).fill("far")
        page.get_by_label("Name", exact=True).press("Enter")
        until(page, "far:")
        page.get_by_role("button", name="Save").click()
        page.get_by_text("my.yaml: saved").wait_for()
        notice.wait_for()
        other.get_by_role("button", name="New guests").click()
        other.get_by_label("party c1", exact=True).wait_for()
        notice.get_by_role("button", name="New evening").click()
        other.get_by_label("node far", exact=True).wait_for()
        expect(other.get_by_label("node n5", exact=True)).to_have_count(0)
        expect(other.get_by_label("party c1", exact=True)).to_have_count(0)
        expect(notice).not_to_be_visible()
        expect(page.get_by_role("button", name="Undo")).to_be_enabled()
        page.get_by_role("tab", name="Live").click()
        page.get_by_label("node far", exact=True).wait_for()
        page.get_by_role("button", name="New guests").click()
        other.get_by_label("party c1", exact=True).wait_for()
        page.get_by_role("tab", name="Layout").click()
        page.get_by_role("button", name="Undo").click()
        page.get_by_label("node n5", exact=True).wait_for()
        assert page.wrong == []
        page.context.close()
