"""A command in a child: its end is the parent's, and one without memory is spoken for."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

from sparc.memory_guard import FAULT, STARVED
from tests.support.paths import ROOT

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


def ended(body: str) -> tuple[int, str, str]:
    """How a process ends whose child does that, and what it says."""
    code = f"import os, sys, time\nfrom sparc.memory_guard import guarded\nguarded(b'out', b'err', 4)\n{body}\n"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=False
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("code", [0, 2, 3])
def test_the_parent_ends_as_the_child_does(code: int) -> None:
    assert ended(f"print('done', flush=True); os._exit({code})") == (code, "done\n", "")


@pytest.mark.parametrize(
    "body",
    [
        f"os._exit({STARVED})", "os._exit(1)", "os.kill(os.getpid(), 9)", "raise MemoryError",
        "raise RuntimeError('anything')",
    ],
)  # fmt: skip
def test_a_child_without_memory_is_spoken_for(body: str) -> None:
    assert ended(body) == (4, "out", "err")


def test_a_fault_of_the_child_is_its_own() -> None:
    assert ended(f"os._exit({FAULT})") == (1, "", "")


def test_signals_are_handed_on() -> None:
    code = (
        "import time\nfrom sparc.memory_guard import guarded\nguarded(b'', b'', 4)\n"
        "print('here', flush=True)\ntime.sleep(60)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, cwd=ROOT)
    assert process.stdout is not None and process.stdout.readline() == b"here\n"
    process.send_signal(signal.SIGTERM)
    assert process.wait(30) == 128 + signal.SIGTERM
    process.stdout.close()


def test_a_signal_is_handed_on_that_comes_before_the_parent_waits() -> None:
    code = (
        "import os, signal, time\nfork = os.fork\n"
        "def forked():\n    child = fork()\n    if child:\n"
        "        os.kill(os.getpid(), signal.SIGTERM)\n    return child\n"
        "os.fork = forked\nfrom sparc.memory_guard import guarded\nguarded(b'', b'', 4)\n"
        "time.sleep(60)\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], cwd=ROOT, timeout=30, check=False)
    assert ran.returncode == 128 + signal.SIGTERM
