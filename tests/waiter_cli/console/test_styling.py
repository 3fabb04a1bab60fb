"""Colour that nothing from outside can imitate, on terminals that want it."""

from __future__ import annotations

import io

import pytest

from tests.support.cli import Screen
from waiter_cli.console.styling import between_marks, printable, styled, unmarked, visible


@pytest.fixture(autouse=True)
def colour_is_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")


def test_a_style_becomes_what_a_terminal_obeys() -> None:
    marked = styled("late", "bold red", Screen())
    assert printable(f"it is {marked}") == "it is \x1b[1;31mlate\x1b[0m"
    assert unmarked(marked) == "late"


def test_colour_is_for_terminals_that_want_it(monkeypatch: pytest.MonkeyPatch) -> None:
    assert styled("late", "red", io.StringIO()) == "late"
    monkeypatch.setenv("TERM", "dumb")
    assert styled("late", "red", Screen()) == "late"
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")
    assert styled("late", "red", Screen()) == "late"


def test_what_comes_from_outside_commands_nothing() -> None:
    name = "table\x1b[31m1\x07"
    shown = printable(styled(name, "green", Screen()))
    assert shown.startswith("\x1b[32m") and shown.endswith("\x1b[0m")
    assert shown.count("\x1b") == 2 and "\x07" not in shown
    assert "\x1b" not in printable(name)
    assert unmarked(name) == name


def test_marks_are_kept_where_a_text_is_changed() -> None:
    marked = "a " + styled("b", "red", Screen()) + " c"
    assert unmarked(between_marks(marked, str.upper)) == "A B C"
    assert printable(between_marks(marked, str.upper)) == "A \x1b[31mB\x1b[0m C"
    assert between_marks("plain", str.upper) == "PLAIN"
    assert unmarked(visible(marked)) == "a b c"
