"""The line that says that a long search is alive: on a terminal only, and gone at the end."""

from __future__ import annotations

import io
import time
from contextlib import redirect_stderr

import pytest

from waiter_cli.commands.search_report import searching
from waiter_cli.console import progress
from waiter_cli.console.progress import alive
from waiter_cli.planning.search_results import SearchStage


class Screen(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def screen(monkeypatch: pytest.MonkeyPatch) -> Screen:
    monkeypatch.setattr(progress, "PATIENCE", 0.01)
    monkeypatch.setattr(progress, "PULSE", 0.01)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "40")
    return Screen()


def wait_for(screen: Screen, text: str) -> None:
    end = time.monotonic() + 10.0
    while text not in screen.getvalue():
        assert time.monotonic() < end, screen.getvalue()
        time.sleep(0.005)


def test_a_long_search_says_its_last_stage_and_takes_the_line_away(screen: Screen) -> None:
    with redirect_stderr(screen), searching() as listener:
        wait_for(screen, "searching, 0 s")
        listener(SearchStage("solve", "horizon 12: unsat", 0.1))
        wait_for(screen, "searching, 0 s; solve: horizon 12: unsat"[:38])
    assert screen.getvalue().endswith("\r\x1b[2K")
    lines = screen.getvalue().split("\r\x1b[2K")
    assert max(map(len, lines)) == 39 and lines[-1] == ""


def test_the_line_goes_when_the_work_fails(screen: Screen) -> None:
    with pytest.raises(ValueError, match="broken"), redirect_stderr(screen), alive("working"):
        wait_for(screen, "working")
        raise ValueError("broken")
    assert screen.getvalue().endswith("\r\x1b[2K")


def test_quick_work_leaves_no_trace(screen: Screen, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 60.0)
    with redirect_stderr(screen), alive("working") as note:
        note("half of it")
    assert screen.getvalue() == ""


@pytest.mark.parametrize("terminal", ["dumb", "unknown"])
def test_a_screen_that_cannot_take_a_line_away_gets_none(
    terminal: str, screen: Screen, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TERM", terminal)
    with redirect_stderr(screen), alive("working"):
        time.sleep(0.05)
    assert screen.getvalue() == ""


def test_a_file_gets_none(screen: Screen, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "isatty", lambda: False)
    with redirect_stderr(screen), alive("working"):
        time.sleep(0.05)
    assert screen.getvalue() == ""
