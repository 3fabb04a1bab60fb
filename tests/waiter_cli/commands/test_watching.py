"""Watching: again after a change, on in spite of faults, a quiet end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support import paths
from waiter_cli.commands.watching import watch
from waiter_cli.errors import InputError

ROOT = str(paths.ROOT)
LAYOUT = """\
nodes: {a: [0, 0], b: [2, 0], c: [1, 2]}
edges: [[a, b], [b, c], [a, c]]
entrance: a
agent: a
tables: {t1: {capacity: 2, nodes: [b], at: [3.2, 0]}}
"""


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


@pytest.mark.parametrize("command", ["check", "draw"])
def test_the_commands_watch_their_file_until_interrupted(command: str, tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text(LAYOUT.replace("entrance: a", "entrance: z"))
    arguments = [sys.executable, "-m", "waiter_cli", "layout", command, str(file), "--watch"]
    log = tmp_path / "log"
    with log.open("w") as out:
        child = subprocess.Popen(
            arguments, stdout=out, stderr=out, env={**os.environ, "PYTHONPATH": ROOT}
        )
        try:
            wait_for(log, "unknown node z", "watching a.yaml")
            file.write_text(LAYOUT)
            wait_for(log, "in order" if command == "check" else "R robot")
            child.send_signal(signal.SIGINT)
            assert child.wait(10) == 0
        finally:
            child.kill()
            child.wait()
    assert "Traceback" not in log.read_text()
    assert "interrupted" not in log.read_text()


def wait_for(log: Path, *texts: str) -> None:
    """Waits until all the texts are in a file."""
    end = time.monotonic() + 30
    while not all(text in log.read_text() for text in texts):
        assert time.monotonic() < end, log.read_text()
        time.sleep(0.05)
