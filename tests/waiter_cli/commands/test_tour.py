"""The tour: every stop works, and nothing is left behind."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.terminal import Terminal


def test_the_whole_tour(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    ran = waiter("tour", "--no-pause")
    assert ran.code == 0, ran.err
    for words in ("seat(agent,c1,table1)", "where w1 stands", "costs 2 more", "occurs("):
        assert words in ran.out
    assert not list(tmp_path.iterdir())


def test_the_end_of_input_is_an_interrupt() -> None:
    with Terminal("tour") as terminal:
        terminal.expect("[Enter]")
        terminal.type("\x04")
        assert terminal.end() == 130
    assert "fault" not in terminal.seen


def test_files_that_are_called_like_the_tours_own_do_not_disturb_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("report", "b1", "b2", "blocked_aisle"):
        (tmp_path / name).write_text("no layout at all\n")
    ran = waiter("tour", "--no-pause")
    assert ran.code == 0, ran.err
