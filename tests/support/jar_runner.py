"""Answer sets as the real sparc.jar gives them, for comparison."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory, mkdtemp

from tests.support.jar import JAR

__all__ = ["jar_answer_sets", "many_jar_answer_sets"]

MANY = Path(__file__).with_name("ManyPrograms.java")
_SHORT_LIVED = ("-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-XX:Tier3InvocationThreshold=2000")
"""What Java compiles while it translates a small program is hardly used."""


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
    with TemporaryDirectory() as folder:
        file = Path(folder) / "program.sp"
        file.write_text(program, encoding="utf-8")
        command = ["java", *_SHORT_LIVED, "-jar", str(JAR)]
        return _read(_run([*command, str(file), "-A", "-n", "0"], time_limit))


def _read(out: str) -> tuple[str, ...] | None:
    """The answer sets that the jar printed."""
    if not out:
        return None
    lines = [line for line in out.splitlines() if line.startswith("{")]
    sets = {", ".join(sorted(filter(None, line[1:-1].split(", ")))) for line in lines}
    return tuple(sorted("{" + shown + "}" for shown in sets))


def _run(command: list[str], time_limit: float) -> str:
    """What a command prints; at the limit its whole group is ended, clingo with it."""
    path = os.pathsep.join((str(_folder_with_clingo()), os.environ.get("PATH", "")))
    environment = {**os.environ, "PATH": path}
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
    """The same for several programs, in one Java where it can compile `MANY`.

    A program at which the jar ends Java is one that it refuses; another Java goes on after it.
    """
    with TemporaryDirectory() as folder:
        files = []
        for number, program in enumerate(programs):
            files.append(Path(folder) / f"{number}.sp")
            files[-1].write_text(program, encoding="utf-8")
        found: list[tuple[str, ...] | None] = []
        while len(found) < len(files):
            left = files[len(found) :]
            _run(["java", *_SHORT_LIVED, str(MANY), str(JAR), *map(str, left)], 60 + 5 * len(left))
            for file in left:
                out = file.with_name(f"{file.name}.out")
                if not out.exists():
                    # Asked alone, in case that Java cannot compile, or has no such limit on time.
                    found.append(jar_answer_sets(file.read_text(encoding="utf-8")))
                    break
                found.append(_read(out.read_text(encoding="utf-8")))
        return found
