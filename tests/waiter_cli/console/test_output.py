"""Text for people: faults with their line, tables, JSON; escaped, and broken to a terminal's width."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import pytest

from tests.support.cli import Screen
from waiter_cli.console.output import (
    print_document,
    print_faults,
    print_json,
    print_table,
    print_text,
    say,
)
from waiter_cli.errors import Fault, Where

LONG = "a word and another word and one more " * 4


@pytest.fixture(autouse=True)
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "40")


def test_lines_are_broken_on_a_terminal_only() -> None:
    pipe, screen = io.StringIO(), Screen()
    say(LONG.strip(), pipe)
    say(LONG.strip(), screen)
    assert pipe.getvalue().count("\n") == 1
    lines = screen.getvalue().splitlines()
    assert len(lines) > 3 and max(map(len, lines)) <= 40
    assert [line.startswith("  ") for line in lines] == [False] + [True] * (len(lines) - 1)


def test_what_is_shown_is_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    print_text("table\x1b[2J")
    assert "\x1b" not in capsys.readouterr().out


def test_a_document_stays_as_it_is_but_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    for stream, kept in ((io.StringIO(), True), (Screen(), False)):
        monkeypatch.setattr(sys, "stdout", stream)
        print_document("a\x1b[2J\n")
        assert ("\x1b" in stream.getvalue()) is kept


def test_json_is_one_line_of_what_was_given(capsys: pytest.CaptureFixture[str]) -> None:
    print_json({"name": "Büro", "odd": "\x1b"})
    out = capsys.readouterr().out
    assert out.count("\n") == 1 and "Büro" in out and "\x1b" not in out
    assert json.loads(out) == {"name": "Büro", "odd": "\x1b"}


def test_a_fault_has_its_line_its_caret_and_its_mend(capsys: pytest.CaptureFixture[str]) -> None:
    fault = Fault(Where("my.yaml", 3, 5), "there is no node x", "did you mean y?", "at: x")
    print_faults([fault])
    assert capsys.readouterr().err == (
        "my.yaml:3:5: error: there is no node x\n"
        "    3 | at: x\n"
        "      |     ^\n"
        "  hint: did you mean y?\n"
    )


def test_the_line_of_a_fault_is_read_where_it_is_not_at_hand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "my.yaml"
    file.write_text("one\n\ttwo\n")
    print_faults([Fault(Where(str(file), 2, 2), "no")])
    _, shown, caret = capsys.readouterr().err.splitlines()
    assert shown == "    2 | \ttwo" and caret == "      | \t^"
    print_faults([Fault(Where(str(tmp_path / "gone"), 2, 2), "no")])
    assert capsys.readouterr().err.count("\n") == 1
    print_faults([Fault(Where(str(file), 1, 1), "so so")], "warning")
    err = capsys.readouterr().err
    assert "warning: so so" in err and "|" not in err


def test_a_long_line_is_cut_about_its_fault(capsys: pytest.CaptureFixture[str]) -> None:
    line = "x" * 300 + "!" + "y" * 300
    print_faults([Fault(Where("f", 1, 301), "here", None, line)])
    _, shown, caret = capsys.readouterr().err.splitlines()
    assert len(shown) < 130 and shown[caret.index("^")] == "!"


def test_a_table_has_its_numbers_to_the_right(capsys: pytest.CaptureFixture[str]) -> None:
    print_table(["step", "action"], [["9", "pick"], ["10", "seat\nhim"]])
    lines = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
    assert lines[0] == "step  action"
    assert lines[1].startswith("   9  pick") and lines[2].startswith("  10  seat")
    assert len(lines) == 3  # a cell is one line
