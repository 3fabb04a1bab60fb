"""Watching: again after a change, on in spite of faults, a quiet end."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from waiter_cli.exits import InputError
from waiter_cli.watching import watch


def script(*changes: Callable[[], None]) -> Callable[[float], None]:
    """A sleep that makes one change a time, and then is interrupted."""
    rest = list(changes)

    def sleep(seconds: float) -> None:
        assert 0 < seconds < 1
        if not rest:
            raise KeyboardInterrupt
        rest.pop(0)()

    return sleep


def test_each_change_is_seen_once(tmp_path: Path) -> None:
    one, two = tmp_path / "one.yaml", tmp_path / "two.yaml"
    one.write_text("a")
    two.write_text("b")
    seen: list[str] = []

    def action() -> int:
        seen.append(one.read_text() + two.read_text())
        return 0

    def replace() -> None:
        new = tmp_path / "new"
        new.write_text("z")
        new.replace(two)

    sleep = script(lambda: None, lambda: one.write_text("aa") and None, lambda: None, replace)
    assert watch([str(one), str(two)], action, sleep=sleep) == 0
    assert seen == ["ab", "aab", "aaz"]


def test_a_change_while_it_runs_is_not_lost(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text("1")
    runs: list[str] = []

    def action() -> int:
        runs.append(file.read_text())
        if len(runs) == 1:
            file.write_text("changed")
        return 0

    assert watch([str(file)], action, sleep=script()) == 0
    assert runs == ["1", "changed"]


def test_faults_are_printed_and_watching_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.yaml"
    file.write_text("1")
    runs: list[int] = []

    def action() -> int:
        runs.append(1)
        if len(runs) == 1:
            raise InputError("this is wrong", "mend it")
        return 0

    sleep = script(file.unlink, lambda: None, lambda: file.write_text("22") and None)
    assert watch([str(file)], action, sleep=sleep) == 0
    assert len(runs) == 2
    err = capsys.readouterr().err
    assert "error: this is wrong" in err
    assert "watching a.yaml" in err


def test_an_interrupt_while_it_runs_ends_quietly(tmp_path: Path) -> None:
    def action() -> int:
        raise KeyboardInterrupt

    assert watch([str(tmp_path)], action) == 0
