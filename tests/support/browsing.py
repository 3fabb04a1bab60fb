"""A studio in a process of its own, and a real headless browser that opens it."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.client import HTTPConnection
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from tests.support.paths import ROOT

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
FLAGS = (
    "--no-sandbox", "--disable-gpu", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
)  # fmt: skip
needs_browser = pytest.mark.skipif(
    CHROMIUM is None or find_spec("playwright") is None,
    reason="Chromium or playwright is not installed",
)
needs_studio = pytest.mark.skipif(
    any(find_spec(name) is None for name in ("starlette", "uvicorn", "websockets")),
    reason="the extra studio is not installed",
)


@dataclass(frozen=True)
class RunningStudio:
    """A studio that runs: its address with the token, its process, and the cookie once it is known."""

    url: str
    process: subprocess.Popen[str]
    cookies: list[str] = field(default_factory=list)

    @property
    def port(self) -> int:
        return int(self.url.split(":")[2].split("/")[0])

    @property
    def token(self) -> str:
        return self.url.partition("#")[2]


@contextmanager
def running_studio(*options: str, cwd: Path | None = None) -> Iterator[RunningStudio]:
    """Starts ``waiter studio --no-open``; ends it afterwards."""
    command = [sys.executable, "-m", "waiter_cli", "studio", "--no-open", *options]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd or ROOT
    )
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        if not line.startswith("studio: "):
            process.wait(10)
            assert process.stderr is not None
            raise AssertionError(line + process.stderr.read())
        yield RunningStudio(line.removeprefix("studio: ").strip(), process)
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()


def get(
    studio: RunningStudio, path: str, body: Any = None, cookie: str = "", **headers: str
) -> tuple[int, dict[str, str], bytes]:
    """The status, headers and body of what is asked for as the page itself would."""
    connection = HTTPConnection("127.0.0.1", studio.port, timeout=10)
    told = {"Cookie": cookie} if cookie else {}
    if body is not None:
        told |= {"Content-Type": "application/json", "Origin": f"http://127.0.0.1:{studio.port}"}
    told |= {name.replace("_", "-"): value for name, value in headers.items()}
    data = None if body is None else json.dumps(body)
    connection.request("GET" if body is None else "POST", path, data, told)
    answer = connection.getresponse()
    found = answer.status, dict(answer.getheaders()), answer.read()
    connection.close()
    return found


def cookie_of(studio: RunningStudio) -> str:
    """The cookie for which the page trades its token, once."""
    if not studio.cookies:
        status, headers, _ = get(studio, "/token", {"token": studio.token})
        assert status == 200
        assert "HttpOnly" in headers["set-cookie"] and "SameSite=Strict" in headers["set-cookie"]
        studio.cookies.append(headers["set-cookie"].partition(";")[0])
    return studio.cookies[0]


class Lines:
    """A client of ``/live`` without a page: lines out, what the studio says in."""

    def __init__(self, studio: RunningStudio, **options: Any) -> None:
        from websockets.sync.client import connect

        cookie = options.pop("cookie", None) or cookie_of(studio)
        host = f"127.0.0.1:{studio.port}"
        self._opened = connect(
            f"ws://{host}/live", origin=options.pop("origin", f"http://{host}"),
            additional_headers={"Cookie": cookie}, **options,
        )  # fmt: skip
        self.socket = self._opened.__enter__()
        self.view: dict[str, Any] = {}
        self.count = 0

    def said(self) -> dict[str, Any]:
        """The next thing that the studio says."""
        told: dict[str, Any] = json.loads(self.socket.recv(timeout=10))
        self.view = told.get("view", self.view)
        return told

    def tell(self, line: Any) -> dict[str, Any]:
        """The answer to a line."""
        self.count += 1
        self.socket.send(line if isinstance(line, (str, bytes)) else json.dumps(line))
        while True:
            told = self.said()
            if told.get("line") == self.count and "from" not in told:
                return told

    def until(self, horizon: int, seconds: float = 20.0) -> None:
        """Waits until so many steps remain."""
        end = time.monotonic() + seconds
        while self.view.get("horizon") != horizon:
            assert time.monotonic() < end, self.view
            self.said()

    def __enter__(self) -> Lines:
        return self

    def __exit__(self, *_: object) -> None:
        self._opened.__exit__(None, None, None)


@contextmanager
def browser() -> Iterator[Any]:
    """A headless Chromium; `new_context` of it is a visitor of his own."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        try:
            yield found
        finally:
            found.close()


def expect(thing: Any) -> Any:
    """Playwright's assertions on a thing of the page: they wait until they hold.

    What is read at once is read before the page has drawn it, on some machine some day.
    """
    from playwright.sync_api import expect as expected

    expected.set_options(timeout=15_000)
    return expected(thing)


def opened_page(found: Any, studio: RunningStudio, **options: Any) -> Any:
    """Opens the studio's page in a context of its own and waits until it can be used.

    The first one trades the token; those after it are given the cookie.
    """
    context = found.new_context(**options)
    for cookie in studio.cookies:
        name, _, value = cookie.partition("=")
        context.add_cookies([{"name": name, "value": value, "url": studio.url.partition("#")[0]}])
    page = context.new_page()
    page.goto(studio.url.partition("#")[0] if studio.cookies else studio.url)
    page.wait_for_selector('body[data-ready="true"]', timeout=20_000)
    if not studio.cookies:
        studio.cookies.extend(f"{each['name']}={each['value']}" for each in context.cookies())
    return page


def press(page: Any, name: str) -> None:
    """Clicks on the button of exactly that name."""
    page.get_by_role("button", name=name, exact=True).click()
