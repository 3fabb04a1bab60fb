"""The end of the process: nothing of clingo's is left to run while the interpreter goes away."""

from __future__ import annotations

import subprocess
import sys

LEFT_BEHIND = """
import atexit, time
from sparc.solving.clingo_threads import Abandoned, in_thread
from waiter_cli import app

atexit.register(lambda: print("torn down", flush=True))
try:
    in_thread(lambda: time.sleep({seconds}), time.monotonic() + 0.05)
except Abandoned:
    print("abandoned", flush=True)
app._leave(0)
"""


def left(seconds: float) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", LEFT_BEHIND.format(seconds=seconds)],
        capture_output=True,
        text=True,
        timeout=60,
    )


def test_a_grounding_that_was_given_up_does_not_outlive_the_interpreter() -> None:
    ran = left(30.0)
    assert (ran.returncode, ran.stdout) == (0, "abandoned\n")


def test_without_one_the_interpreter_ends_as_usual() -> None:
    ran = left(0.0)
    assert (ran.returncode, ran.stdout) == (0, "torn down\n")


def test_whoever_measures_a_command_gets_to_say_what() -> None:
    ran = subprocess.run(
        [sys.executable, "-m", "cProfile", "-m", "waiter_cli", "--version"],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert ran.returncode == 0 and "function calls" in ran.stdout
