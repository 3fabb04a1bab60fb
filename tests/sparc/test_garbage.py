"""What is frozen for good is not counted again and again, and what nobody needs goes."""

from __future__ import annotations

import gc
import subprocess
import sys
from collections.abc import Callable

import pytest

import sparc
from sparc import garbage
from sparc.solving.clingo_solver import Grounding

PROGRAM = """
import gc
from sparc import garbage
assert garbage.nothing_is_frozen()
kept = [[] for _ in range(10)]
garbage.count_all_as_old()
print(gc.get_freeze_count() > garbage._FROM_THE_START)
gc.freeze()
frozen = gc.get_freeze_count()
asked = []
count = gc.get_freeze_count
gc.get_freeze_count = lambda: asked.append(1) or count()
for _ in range(5):
    garbage.count_all_as_old()
print(count() == frozen, len(asked))
"""


def test_what_somebody_froze_stays_and_is_counted_once() -> None:
    ran = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=60
    )
    assert ran.stdout.split() == ["False", "True", "1"], ran.stderr


TAKEN = """
import os
from sparc import garbage

def megabytes():
    return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE") >> 20

taken = [bytes(1000 + k % 2) for k in range(60_000)]
last = bytes(1000)  # so that what is below it cannot go by itself
del taken
before = megabytes()
garbage.give_back()
print(before - megabytes())
"""


@pytest.mark.skipif(garbage._trim() is None, reason="the C library is not glibc")
def test_what_is_free_is_given_back() -> None:
    ran = subprocess.run([sys.executable, "-c", TAKEN], capture_output=True, text=True, timeout=60)
    assert int(ran.stdout) > 40, ran.stderr


CIRCLES = """
import gc, sys, weakref
from sparc import garbage

class Circle:
    def __init__(self):
        self.itself = self
        self.much = [[] for _ in range(3_000)]

alive = []
for _ in range(5 * garbage._CALLS):
    alive.append(weakref.ref(Circle()))
    garbage.count_all_as_old()
print(sum(one() is not None for one in alive) <= 2 * garbage._CALLS)
"""


def test_garbage_that_was_counted_as_old_is_found_after_many_programs() -> None:
    program = f"import gc; gc.set_threshold(100_000, 20, 20)\n{CIRCLES}"
    ran = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60
    )
    assert ran.stdout.split() == ["True"], ran.stderr


BROKEN = "sorts #s = {a, b}. predicates p(#s). q(#s). rules p(a). q(X) :- p(X), not q(b). :- q(a)."


@pytest.mark.wide
@pytest.mark.parametrize(
    "asked",
    [
        lambda: sparc.explain(BROKEN, every=True),
        lambda: sparc.why(BROKEN.replace(":- q(a).", ""), "q(a)"),
        lambda: sparc.why(BROKEN.replace(":- q(a).", ""), "q(b)"),
        lambda: list(sparc.solve(BROKEN.replace(":- q(a).", ""))),
    ],
    ids=["explain", "why", "why not", "solve"],
)
def test_no_grounding_waits_for_a_search_for_garbage(asked: Callable[[], object]) -> None:
    """clingo's memory is large, and is not counted where Python decides when to search."""
    gc.collect()
    gc.disable()
    try:
        asked()
        assert not any(isinstance(one, Grounding) for one in gc.get_objects())
    finally:
        gc.enable()
