"""What is frozen for good is not counted again and again."""

from __future__ import annotations

import subprocess
import sys

import pytest

from sparc import garbage

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
