"""The threads in which clingo works, and how they end: entry points `in_thread`, `held`.

clingo's own threads do not survive the end of Python, and what cannot be stopped does not survive
the end of C++: both are seen to here, also where a program that uses this package just ends.
"""

from __future__ import annotations

import atexit
import sys
import time
from _thread import LockType, allocate_lock, start_new_thread
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import clingo

__all__ = ["POLL", "Abandoned", "held", "in_thread", "left_behind"]

Value = TypeVar("Value")

_START = 10.0  # seconds after which a thread that does not begin never will
_PATIENCE = 0.2  # seconds at the end for threads that are about to end
POLL = 0.05  # seconds between two looks at the clock and at Ctrl-C
_open: set[clingo.SolveHandle] = set()  # searches that were neither read to the end nor closed
_left: list[LockType] = []  # the locks of threads that nobody waits for


@atexit.register
def _end_threads() -> None:
    """Ends the searches of iterators that are left half-read, and waits a moment for what ends by itself."""
    for handle in list(_open):
        handle.cancel()
    latest = time.monotonic() + _PATIENCE
    for done in _left:
        done.acquire(timeout=max(0.0, latest - time.monotonic()))


class Abandoned(Exception):
    """The time was up while clingo could not be stopped; its thread still runs.

    What it holds is freed at the end of the process.  A process that should not wait for anything
    then ends with `os._exit` once its output is flushed.
    """


def in_thread(work: Callable[[], Value], deadline: float | None) -> Value:
    """Returns the value of ``work()``, run in a daemon thread until ``deadline``
    (`time.monotonic`).

    Raises `Abandoned` when the deadline passes first, and whatever ``work`` raises.  A Ctrl-C is
    seen within a twentieth of a second, also while C code runs.
    """
    done = allocate_lock()  # a thread without memory can let go of a lock, and set no event
    done.acquire()
    box: list[Any] = [None, None, False]

    def run() -> None:
        try:
            box[2] = True
            box[0] = work()
        except BaseException as error:  # handed to the caller below
            box[1] = error
        finally:
            done.release()

    begun = time.monotonic()
    try:
        start_new_thread(run, ())
    except RuntimeError as error:
        raise MemoryError("there is no room for a thread") from error
    try:
        while not done.acquire(
            timeout=POLL if deadline is None else max(0.0, min(POLL, deadline - time.monotonic()))
        ):
            if deadline is not None and time.monotonic() >= deadline:
                raise Abandoned
            if not box[2] and time.monotonic() > begun + _START:
                raise MemoryError("a thread did not start")
    except BaseException:  # of Ctrl-C, too
        _leave_behind(done)
        raise
    if box[1] is not None:
        raise box[1]
    value: Value = box[0]
    return value


@contextmanager
def held(handle: clingo.SolveHandle) -> Iterator[clingo.SolveHandle]:
    """Closes a search at the end of the block, or at the end of Python where that comes first."""
    _open.add(handle)
    try:
        with handle:
            yield handle
    finally:
        _open.discard(handle)


def left_behind() -> int:
    """Returns how many threads that nobody waits for run still: each holds memory, and takes a core's time."""
    return sum(done.locked() for done in list(_left))


def _leave_behind(done: LockType) -> None:
    """Lets the process end while clingo's thread runs.

    At its end C++ frees what that thread works on, and it would die of that: where libc tells the
    exit status to those it calls at the end (`on_exit`), the process ends before.
    """
    _left.append(done)
    if len(_left) == 1 and sys.platform == "linux":
        import ctypes

        libc = ctypes.CDLL(None)
        if hasattr(libc, "on_exit"):
            libc.on_exit(libc._exit, None)
