"""Keeps old objects out of garbage collection, and returns free memory to the system. Entry points `nothing_is_frozen`, `count_all_as_old`, `collect_often`, `give_back`."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from functools import cache

__all__ = ["collect_often", "count_all_as_old", "give_back", "nothing_is_frozen"]

_FROM_THE_START = gc.get_freeze_count() if sys.version_info[:2] == (3, 12) else 0
"""Python 3.12 starts with some hundred objects of its own frozen; the others with none."""

_CALLS = 50
"""After so many programs a process is no short command, and may look for garbage."""

_somebody_froze = False
_calls = 0
_blocks = 0  # of memory, in use after the last search through all


def nothing_is_frozen() -> bool:
    """Returns whether nobody in this process has frozen anything (`gc.freeze`).

    Only then may it be unfrozen again: what a caller froze for good is not ours to give back.  Once
    somebody has, it stays so: to count what is frozen takes as long as there is much of it.
    """
    global _somebody_froze
    _somebody_froze = _somebody_froze or gc.get_freeze_count() > _FROM_THE_START
    return not _somebody_froze


def count_all_as_old() -> None:
    """Has no search for garbage begin with what was made until now, unless somebody froze some of it.

    Python itself looks through what is old when enough has come there by way of the young, so once
    in many calls that is done here, if twice as much memory is in use as after the last time.
    """
    global _calls, _blocks
    if not nothing_is_frozen():
        return
    gc.freeze()
    gc.unfreeze()
    _calls += 1
    if _calls % _CALLS == 0 and sys.getallocatedblocks() > 2 * _blocks:
        gc.collect()
        _blocks = sys.getallocatedblocks()


def collect_often() -> None:
    """Has garbage collected as it comes: short commands put that off, a run of days must not.

    What was loaded until now stays for good, and is not looked through again.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(700, 10, 10)


def give_back() -> None:
    """Gives memory that is free back to the system, where the C library keeps it for itself (glibc).

    What a large search took stays with the process otherwise; it takes a few milliseconds.
    """
    trim = _trim()
    if trim is not None:
        trim(0)


@cache
def _trim() -> Callable[[int], int] | None:
    """Returns glibc's ``malloc_trim``, None where there is none."""
    if not sys.platform.startswith("linux"):
        return None
    import ctypes

    found: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    return found
