"""Signals that wait: nothing is cut short, nothing is forgotten."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tests.support.paths import ROOT

SENDS_ITSELF = """\
import os, signal
from sparc.deferred_signals import undisturbed
signal.signal(signal.SIGTERM, lambda number, frame: print("terminated"))
{ignored}
try:
    with undisturbed():
        for number in (signal.SIGTERM, signal.SIGINT):
            os.kill(os.getpid(), number)
        print("whole")
    print("nothing came")
except KeyboardInterrupt:
    print("interrupted")
os.kill(os.getpid(), signal.SIGTERM)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize(
    ("ignored", "last"),
    [("", "interrupted"), ("signal.signal(signal.SIGINT, signal.SIG_IGN)", "nothing came")],
)
def test_signals_wait_for_the_end(ignored: str, last: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", SENDS_ITSELF.format(ignored=ignored)],
        capture_output=True, text=True, cwd=ROOT, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split("\n")[:-1] == ["whole", "terminated", last, "terminated"]


def test_a_handler_that_raises_leaves_every_handler_in_place() -> None:
    text = """\
import os, signal
from sparc.deferred_signals import undisturbed
class Alarm(BaseException): pass
def alarm(number, frame): raise Alarm
signal.signal(signal.SIGALRM, alarm)
signal.signal(signal.SIGTERM, lambda number, frame: print("terminated"))
before = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)]
signal.setitimer(signal.ITIMER_REAL, 0.0001, 0.0001)
came = 0
for _ in range(3000):
    try:
        with undisturbed():
            pass
    except Alarm:
        came += 1
    except KeyboardInterrupt:
        pass
    try:
        now = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)]
        assert now == before, now
        assert not signal.pthread_sigmask(signal.SIG_BLOCK, ())
    except Alarm:
        pass
signal.setitimer(signal.ITIMER_REAL, 0)
print(came > 0)
"""
    done = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert "AssertionError" not in done.stderr, done.stderr
