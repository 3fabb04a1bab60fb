"""A studio in a process of its own, and a real headless browser that opens it."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
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
    """A studio that runs: its address with the token, and its process."""

    url: str
    process: subprocess.Popen[str]

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


def opened_page(found: Any, studio: RunningStudio, **context: Any) -> Any:
    """Opens the studio's page in a context of its own and waits until it can be used."""
    page = found.new_context(**context).new_page()
    page.goto(studio.url)
    page.wait_for_selector('body[data-ready="true"]', timeout=20_000)
    return page
