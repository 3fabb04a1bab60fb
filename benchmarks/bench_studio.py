"""How quick the page of `waiter studio` is, in a real headless Chromium.

    python benchmarks/bench_studio.py [start] [click] [drag] [frame] [memory] [--runs N] [--minutes N]

`start`: from the command to a page that can be used, and beside it a bare page of uvicorn that says
so as soon as its script runs (bar: 1 s).  `click`: from a click to the new plan on the page (p95 100 ms on
the report's layout, 300 ms at 50 nodes and 20 tables).  `drag`: from letting a table go to its findings
and the pinned plan (p95 150 ms at 20 nodes, 400 ms at 50).  `frame`: what scripts take of a frame, with 50
tables, 60 guests and a robot that walks (p95 8 ms).  `memory`: of the server, at 60 times the clock with
200 guests, after `--minutes` (bar: 150 MB, and flat after an hour); a party goes and another comes every
few minutes of the evening, so that it is busy to the end.  It needs the extra `studio`, Chromium and playwright.
"""

from __future__ import annotations

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import environment, table
from tests.support.browsing import Lines, RunningStudio, browser, opened_page, running_studio
from waiter_cli.layout_tools.generate import generate_layout

BARE = """
import socket, sys
import uvicorn
PAGE = b'<!doctype html><title>bare</title><script type="module" src="/x.js"></script>'
SCRIPT = b'document.body.textContent = "bare"; document.body.dataset.ready = "true";'
async def app(scope, receive, send):
    script = scope["path"] == "/x.js"
    kind = b"text/javascript" if script else b"text/html"
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-type", kind)]})
    await send({"type": "http.response.body", "body": SCRIPT if script else PAGE})
listening = socket.socket()
listening.bind(("127.0.0.1", 0))
listening.listen()
print(f"bare: http://127.0.0.1:{listening.getsockname()[1]}/", flush=True)
config = uvicorn.Config(app, log_config=None, access_log=False, lifespan="off")
uvicorn.Server(config).run([listening])
"""
STUDIO = (sys.executable, "-m", "waiter_cli", "studio", "--no-open")
WATCH = """([thing, label]) => {
  const [drawn, told] = [document.querySelector(thing), document.querySelector(`[aria-label="${label}"]`)];
  window.seen = {begun: 0, drawn: 0, told: 0};
  const see = (key) => new MutationObserver(() => {
    if (seen.begun && !seen[key]) requestAnimationFrame(() => { seen[key] = performance.now() - seen.begun; });
  });
  if (drawn) see("drawn").observe(drawn, {childList: true, subtree: true});
  see("told").observe(told, {childList: true, characterData: true, subtree: true});
  for (const kind of ["click", "pointerup"]) {
    document.addEventListener(kind, (event) => { seen = {begun: event.timeStamp, drawn: 0, told: 0}; }, true);
  }
}"""
FRAMES = """() => {
  window.frames_ = [];
  let spent = 0;
  const timed = (act) => function (...given) {
    const began = performance.now();
    try { return act.apply(this, given); } finally { spent += performance.now() - began; }
  };
  const listen = EventTarget.prototype.addEventListener;
  EventTarget.prototype.addEventListener = function (kind, act, ...rest) {
    return listen.call(this, kind, this instanceof WebSocket ? timed(act) : act, ...rest);
  };
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) => request(timed(act));
  const turn = () => { window.frames_.push(spent); spent = 0; request(turn); };
  request(turn);
}"""


def p95(times: list[float]) -> float:
    """The time that one in twenty exceeds."""
    return statistics.quantiles(times, n=20, method="inclusive")[-1] if len(times) > 1 else times[0]


READY = """
new MutationObserver(() => {
  if (document.body?.dataset.ready && !window.ready_) window.ready_ = performance.timeOrigin + performance.now();
}).observe(document, {subtree: true, attributes: true, childList: true});
"""


def ready_after(found: Any, command: tuple[str, ...]) -> float:
    """Seconds from the start of a server to a page of it that can be used."""
    context = found.new_context()
    page = context.new_page()
    page.add_init_script(READY)
    began = time.time()
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment()
    )
    try:
        assert process.stdout is not None
        page.goto(process.stdout.readline().split(" ")[1].strip(), wait_until="commit")
        page.wait_for_selector('body[data-ready="true"]', timeout=20_000)
        return float(page.evaluate("() => window.ready_")) / 1000 - began
    finally:
        context.close()
        process.terminate()
        process.wait()


def start(runs: int) -> list[tuple[object, ...]]:
    """Medians of pages that were opened in turn."""
    commands = {"bare uvicorn page": (sys.executable, "-c", BARE), "waiter studio": STUDIO}
    with browser() as found:
        for command in commands.values():
            ready_after(found, command)
        turns = [
            {name: ready_after(found, each) for name, each in commands.items()} for _ in range(runs)
        ]
    return [
        (f"start: {name}", runs, *figures([1000 * turn[name] for turn in turns]), bar)
        for name, bar in (("bare uvicorn page", ""), ("waiter studio", "p50 1000"))
    ]


def figures(times: list[float]) -> tuple[str, str]:
    """Median and p95 in words."""
    return f"{statistics.median(times):.1f}", f"{p95(times):.1f}"


@contextmanager
def layout_file(nodes: int, tables: int) -> Iterator[str]:
    """A generated layout in a file of its own."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "generated.yaml")
        path.write_text(generate_layout(1, nodes, tables, bar=True, waiters=2), encoding="utf-8")
        yield str(path)


def seen(page: Any, key: str) -> float:
    """Milliseconds from the last click to what the page watches; waits for it."""
    until = time.monotonic() + 20
    while not (found := page.evaluate(f"() => window.seen.{key}")):
        assert time.monotonic() < until, f"nothing was {key}"
        page.wait_for_timeout(5)
    return float(found)


def clicks(found: Any, layout: str, runs: int) -> list[float]:
    """Milliseconds from a click on New guests, or on a party's leaving, to the plan."""
    times = []
    with running_studio("--layout", layout) as studio:
        page = opened_page(found, studio)
        page.get_by_role("button", name="Pause").click()
        page.evaluate(WATCH, ["nothing", "proof"])
        page.wait_for_timeout(1500)
        for _ in range(runs):
            page.get_by_role("button", name="New guests").click()
            times.append(seen(page, "told"))
            page.wait_for_timeout(150)
            party = page.locator("[data-thing^='party ']").last
            party.focus()
            page.keyboard.press("Enter")
            page.get_by_role("menuitem", name="guests leave").click()
            times.append(seen(page, "told"))
            page.wait_for_timeout(150)
        page.context.close()
    return times


def click(runs: int) -> list[tuple[object, ...]]:
    """Rows for both sizes."""
    with browser() as found, layout_file(50, 20) as large:
        return [
            ("click to plan: report", 2 * runs, *figures(clicks(found, "report", runs)), "p95 100"),
            (
                "the same, 50 nodes 20 tables",
                2 * runs,
                *figures(clicks(found, large, runs)),
                "p95 300",
            ),
        ]


def drags(found: Any, layout: str, runs: int) -> tuple[list[float], list[float]]:
    """Milliseconds from letting a table go to its findings, and to the pinned plan."""
    drawn, planned = [], []
    with running_studio("--layout", layout) as studio:
        page = opened_page(found, studio, viewport={"width": 1280, "height": 800})
        page.get_by_role("tab", name="Layout").click()
        page.get_by_label("Pinned scenario").select_option(label="2 guests arrive")
        told = page.get_by_role("status", name="pinned plan")
        while not re.match(r"\d", told.inner_text()):
            page.wait_for_timeout(20)
        thing = "#panel-layout [data-thing='table table2']"
        page.evaluate(WATCH, [thing, "pinned plan"])
        page.wait_for_timeout(500)
        for turn in range(runs):
            box = page.locator(thing).locator(".table-top").bounding_box()
            x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
            page.mouse.move(x, y)
            page.mouse.down()
            page.mouse.move(x + (14 if turn % 2 else -14), y, steps=3)
            page.mouse.up()
            drawn.append(seen(page, "drawn"))
            planned.append(seen(page, "told"))
            page.wait_for_timeout(100 + 37 * (turn % 20))
        page.context.close()
    return drawn, planned


def drag(runs: int) -> list[tuple[object, ...]]:
    """Rows for both sizes."""
    rows: list[tuple[object, ...]] = []
    with browser() as found:
        for nodes, tables, bar in ((20, 8, "p95 150"), (50, 20, "p95 400")):
            with layout_file(nodes, tables) as layout:
                drawn, planned = drags(found, layout, runs)
            name = f"drag, {nodes} nodes {tables} tables"
            rows.append((f"{name}: findings", runs, *figures(drawn), bar))
            rows.append((f"{name}: pinned plan", runs, *figures(planned), bar))
    return rows


def crowd(lines: Lines, guests: int) -> None:
    """Has so many guests come in, in fours."""
    while guests > 0:
        told = lines.tell({"guests": min(4, guests)})
        assert "error" not in told, told
        guests -= 4


def frame(runs: int) -> list[tuple[object, ...]]:
    """The scripts' time in each of the frames of some seconds."""
    with browser() as found, layout_file(120, 50) as layout:
        with running_studio("--layout", layout, "--speed", "2") as studio:
            page = found.new_context(viewport={"width": 1280, "height": 800}).new_page()
            page.add_init_script(f"({FRAMES})()")
            page.goto(studio.url)
            page.wait_for_selector('body[data-ready="true"]')
            known = page.context.cookies()
            studio.cookies.extend(f"{each['name']}={each['value']}" for each in known)
            with Lines(studio) as lines:
                crowd(lines, 60)
            page.wait_for_timeout(3000)
            page.evaluate("() => { window.frames_.length = 0; }")
            page.wait_for_timeout(1000 * runs)
            times = page.evaluate("() => window.frames_")
            people = page.locator("[data-thing^='party '], [data-thing^='guest ']").count()
            assert people >= 60, people
    return [("scripts in a frame", len(times), *figures(times), "p95 8")]


TURNOVER = 15.0
"""Seconds on the wall after which a party goes and another one comes, once all guests are there."""


def turn_over(lines: Lines) -> None:
    """Has the first party that sits leave, and another come."""
    seated = lines.view.get("state", {}).get("seated", {})
    if seated:
        told = lines.tell({"observe": {"leave": [next(iter(seated.values()))[0]]}})
        assert "error" not in told, told
        crowd(lines, 4)


def memory(minutes: float) -> list[tuple[object, ...]]:
    """Megabytes of the server, eleven times from the beginning to the end."""
    with (
        layout_file(120, 50) as layout,
        running_studio("--layout", layout, "--speed", "60") as studio,
    ):
        begun = time.monotonic()
        taken: list[float] = []
        came, turned = 0, 0.0
        with Lines(studio) as lines:
            while (past := time.monotonic() - begun) < 60 * minutes:
                if (
                    came < 200 and came <= 8 * past
                ):  # a party of four every half minute of the evening
                    crowd(lines, 4)
                    came += 4
                elif came >= 200 and past >= turned:
                    turn_over(lines)
                    turned = past + TURNOVER
                if len(taken) <= 10 * past / (60 * minutes):
                    taken.append(megabytes(studio))
                lines.said()
        taken.append(megabytes(studio))
    told = ", ".join(f"{each:.0f}" for each in taken)
    print(f"memory: {told} MB in the course of {minutes:g} minutes")
    return [
        (f"memory after {minutes:g} minutes, MB", 1, f"{taken[-1]:.1f}", f"{max(taken):.1f}", "150")
    ]


def megabytes(studio: RunningStudio) -> float:
    """What the studio has in memory."""
    pages = Path(f"/proc/{studio.process.pid}/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE") / (1 << 20)


def main() -> None:
    """Prints one table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parts = ("start", "click", "drag", "frame", "memory")
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(parts))
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--minutes", type=float, default=3.0)
    given = parser.parse_args()
    measured: dict[str, Callable[[], list[tuple[object, ...]]]] = {
        "start": lambda: start(given.runs),
        "click": lambda: click(2 * given.runs),
        "drag": lambda: drag(4 * given.runs),
        "frame": lambda: frame(given.runs),
        "memory": lambda: memory(given.minutes),
    }
    rows = [row for part in given.parts or parts for row in measured[part]()]
    table(("milliseconds", "n", "p50", "p95", "bar"), rows)


if __name__ == "__main__":
    main()
