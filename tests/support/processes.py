"""Commands as processes of their own: in any surroundings, ended at any moment, counted to the last child."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import uuid
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from tests.support.cli import Ran
from tests.support.paths import ROOT

__all__ = ["Running", "at_once", "started", "surroundings", "waiter_process"]

PATIENCE = 120.0
"""Seconds that anything may take on a machine that has other things to do."""

_OWN = ("LC_", "LANG", "PYTHONIO", "PYTHONUTF8", "PYTHONCOERCE", "NO_COLOR", "WAITER_")
_FROM_ITS_FIRST_LINE = """\
import os
from waiter_cli import app
from waiter_cli.console.streams import prepare
def begin():
    gate = int(os.environ["GATE"])
    os.write(gate, b"x")
    os.close(gate)
    prepare()
app.prepare = begin  # which comes right after signals are handled
app.main()
"""
One, Other = TypeVar("One"), TypeVar("Other")


def surroundings(**variables: str | None) -> dict[str, str]:
    """This process's environment in English and UTF-8, with these variables (None: without)."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(_OWN)}
    changed = {"LC_ALL": "C.UTF-8", "PYTHONPATH": str(ROOT), **variables}
    both = {**kept, **changed}
    return {name: value for name, value in both.items() if value is not None}


def started(
    *arguments: object, begin: str | None = None, environment: dict[str, str] | None = None,
    **more: Any,
) -> subprocess.Popen[bytes]:  # fmt: skip
    """``waiter ARGUMENTS``, in a session of its own; ``begin`` is Python to run instead of it."""
    start = ["-m", "waiter_cli"] if begin is None else ["-c", begin]
    streams = dict.fromkeys(("stdout", "stderr"), subprocess.PIPE)
    return subprocess.Popen(
        [sys.executable, *start, *map(str, arguments)],
        env=surroundings() if environment is None else environment,
        start_new_session=True,
        **{"stdin": subprocess.DEVNULL, **streams, **more},
    )


def waiter_process(
    *arguments: object, cwd: Path | None = None, stdin: str = "", begin: str | None = None,
    **variables: str | None,
) -> Ran:  # fmt: skip
    """What ``waiter ARGUMENTS`` did, in a process of its own."""
    process = started(
        *arguments, begin=begin, cwd=cwd, environment=surroundings(**variables),
        stdin=subprocess.PIPE,
    )  # fmt: skip
    out, err = process.communicate(stdin.encode(), timeout=PATIENCE)
    return Ran(process.returncode, out.decode(), err.decode())


def at_once(work: Callable[[One], Other], jobs: Iterable[One], most: int = 2) -> list[Other]:
    """The results of the jobs, ``most`` of them done at the same time."""
    with ThreadPoolExecutor(most) as pool:
        return list(pool.map(work, jobs))


class Running:
    """``waiter ARGUMENTS`` at its first line; whatever is left of it ends with the ``with`` block."""

    def __init__(self, *arguments: object, cwd: Path | None = None, **variables: str) -> None:
        gate, its_gate = os.pipe()
        self._mark = uuid.uuid4().hex
        self.process = started(
            *arguments, begin=_FROM_ITS_FIRST_LINE, pass_fds=(its_gate,), cwd=cwd,
            environment=surroundings(GATE=str(its_gate), MARK=self._mark, **variables),
        )  # fmt: skip
        os.close(its_gate)
        os.read(gate, 1)
        os.close(gate)

    def __enter__(self) -> Running:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number in self.left():
            os.kill(number, signal.SIGKILL)
        self.process.kill()
        self.process.communicate()

    def after(self, seconds: float, *signals: signal.Signals) -> None:
        """Lets it run so long, then sends the signals, a thousandth of a second apart."""
        time.sleep(seconds)
        for each in signals:
            self.process.send_signal(each)
            time.sleep(0.001)

    def end(self, patience: float = PATIENCE) -> Ran:
        """What it did, once it has ended and, so many seconds later, all it started."""
        out, err = self.process.communicate(timeout=PATIENCE)
        deadline = time.monotonic() + patience
        while left := self.left():
            assert time.monotonic() < deadline, f"still running: {left}"
            time.sleep(0.02)
        return Ran(self.process.returncode, out.decode(), err.decode())

    def left(self) -> dict[int, list[bytes]]:
        """The processes that it started, directly or not, and itself, with their command lines."""
        found = {}
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                if f"MARK={self._mark}".encode() not in (folder / "environ").read_bytes():
                    continue
                if (folder / "stat").read_text().rpartition(")")[2].split()[0] != "Z":
                    line = (folder / "cmdline").read_bytes().split(b"\0")
                    found[int(folder.name)] = line
            except OSError:  # it has just ended, or is somebody else's
                continue
        return found
