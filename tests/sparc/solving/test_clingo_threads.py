"""A program that uses the package just ends, whatever clingo is at: with its own status, and not by a signal."""

from __future__ import annotations

import subprocess
import sys
import time
from threading import Event

import pytest

from sparc.solving.clingo_threads import Abandoned, in_thread, left_behind

CHOICE = "sorts #n = 1..3. predicates p(#n). rules {p(X)}."
LARGE = (
    "#maxint = 100000. sorts #n = 0..1200. predicates p(#n,#n,#n). q(#n). rules q(X). "
    "p(X,Y,Z) :- q(X), q(Y), q(Z), X{0}*Y != Z{0}*3."
)
HALF_READ = (
    f"searches = [sparc.solve({CHOICE!r}) for _ in range(3)]\nfor each in searches: next(each)"
)
LATE = "found = sparc.solve({!r}, time_limit=0.3)\nassert list(found) == []"


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(HALF_READ, id="half-read"),
        pytest.param(LATE.format(LARGE.format("")), id="grounding"),
        pytest.param(LATE.format(LARGE.format("*70000")), id="grounding with exact arithmetic"),
    ],
)
def test_a_program_ends_with_its_own_status(text: str) -> None:
    begun = time.monotonic()
    ran = subprocess.run(
        [sys.executable, "-c", f"import sys, sparc\n{text}\nprint('read')\nsys.exit(3)"],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ran.returncode, ran.stdout, ran.stderr) == (3, "read\n", "")
    assert time.monotonic() - begun < 20


@pytest.mark.wide
def test_what_was_abandoned_stops_where_it_can() -> None:
    text = (
        "import time, sparc\n" + LATE.format(LARGE.format("*70000")) + "\ntime.sleep(0.2)\n"
        "begun = time.process_time()\ntime.sleep(0.3)\nprint(time.process_time() - begun < 0.1)"
    )
    assert subprocess.check_output([sys.executable, "-c", text], text=True) == "True\n"


def test_what_is_left_behind_is_counted_until_it_ends() -> None:
    before, may_end, ended = left_behind(), Event(), Event()

    def work() -> None:
        may_end.wait(10)
        ended.set()

    with pytest.raises(Abandoned):
        in_thread(work, time.monotonic() + 0.05)
    assert left_behind() == before + 1
    may_end.set()
    assert ended.wait(10)
    while left_behind() > before:
        time.sleep(0.001)
