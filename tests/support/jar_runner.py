"""Answer sets as the real sparc.jar gives them, for comparison."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory, mkdtemp

from tests.support.jar import JAR

__all__ = ["jar_answer_sets", "many_jar_answer_sets"]


@cache
def _folder_with_clingo() -> Path:
    """A folder with an executable ``clingo``: this Python's module.

    The jar starts it once without arguments, to see whether it is there; that needs no Python.
    """
    folder = Path(mkdtemp(prefix="clingo-"))
    launcher = folder / "clingo"
    launcher.write_text(
        f'#!/bin/sh\n[ $# -eq 0 ] && exit 0\nexec "{sys.executable}" -m clingo "$@"\n'
    )
    launcher.chmod(0o755)
    return folder


def jar_answer_sets(program: str, time_limit: float = 60) -> tuple[str, ...] | None:
    """The distinct answer sets as text, sorted; None when the jar refuses the program."""
    path = os.pathsep.join((str(_folder_with_clingo()), os.environ.get("PATH", "")))
    with TemporaryDirectory() as folder:
        file = Path(folder) / "program.sp"
        file.write_text(program, encoding="utf-8")
        command = ["java", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-jar", str(JAR)]
        out = _run([*command, str(file), "-A", "-n", "0"], {**os.environ, "PATH": path}, time_limit)
    if not out:
        return None
    lines = [line for line in out.splitlines() if line.startswith("{")]
    sets = {", ".join(sorted(filter(None, line[1:-1].split(", ")))) for line in lines}
    return tuple(sorted("{" + shown + "}" for shown in sets))


def _run(command: list[str], environment: dict[str, str], time_limit: float) -> str:
    """What a command prints; at the limit its whole group is ended, clingo with it."""
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        text=True, env=environment, start_new_session=True,
    )  # fmt: skip
    try:
        return process.communicate(timeout=time_limit)[0]
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def many_jar_answer_sets(programs: Iterable[str]) -> list[tuple[str, ...] | None]:
    """The same for several programs, two at a time."""
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(jar_answer_sets, programs))
