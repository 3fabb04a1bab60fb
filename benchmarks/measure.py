"""Whole processes, measured: wall and CPU seconds and peak memory, medians of several runs."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["Figures", "WAITER", "measure", "once", "table"]

WAITER = (sys.executable, "-m", "waiter_cli")
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


@dataclass(frozen=True)
class Figures:
    """Medians over the runs: seconds of wall clock, seconds of CPU, megabytes at the peak."""

    wall: float
    cpu: float
    memory: float
    code: int = 0


def environment() -> dict[str, str]:
    """The environment of a measured process: byte code is kept, as an installed package has it."""
    variables = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    return {**variables, "PYTHONPATH": ROOT}


def once(command: Sequence[str], time_limit: float | None = None) -> Figures:
    """One run; children that the command waited for count too. ``code`` -1: the limit came first."""
    start = time.perf_counter()
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        env=environment(), start_new_session=True,
    )  # fmt: skip
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG if time_limit else 0)
        if pid:
            break
        if time.perf_counter() - start > (time_limit or 0):
            os.killpg(process.pid, 9)
            time_limit = None
            _, _, usage = os.wait4(process.pid, 0)
            status = -1
            break
        time.sleep(0.005)
    wall = time.perf_counter() - start
    process.returncode = 0
    code = os.waitstatus_to_exitcode(status) if status >= 0 else -1
    return Figures(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, code)


def measure(command: Sequence[str], runs: int = 5, time_limit: float | None = None) -> Figures:
    """Medians of ``runs`` runs after one to warm up; one run only where a limit was reached."""
    first = once(command, time_limit)
    if first.code == -1:
        return first
    found = [once(command, time_limit) for _ in range(runs)]
    return Figures(
        statistics.median(f.wall for f in found),
        statistics.median(f.cpu for f in found),
        max(f.memory for f in found),
        found[-1].code,
    )


def table(headings: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """Prints rows under their headings, numbers at the right."""
    cells = [[_cell(value) for value in row] for row in rows]
    widths = [max(len(row[i]) for row in [list(headings), *cells]) for i in range(len(headings))]
    for row in [list(headings), *cells]:
        print("  ".join(text.ljust(w) if i == 0 else text.rjust(w)
                        for i, (text, w) in enumerate(zip(row, widths))))  # fmt: skip
    print(flush=True)


def _cell(value: object) -> str:
    return f"{value:.3f}" if isinstance(value, float) else str(value)
