"""Runs a command in a child process where the system limits its memory (``ulimit -v``). Entry point `guarded`.

Memory may end anywhere there: in C code that ends the process, or in whatever would tell of it.
The parent has the last word, which was written before and takes no memory to say.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from typing import Any

__all__ = ["FAULT", "STARVED", "guarded"]

STARVED = 113
"""How a child ends that has no memory left to speak."""
FAULT = 114
"""How a child ends with exit code 1: what ends with that code itself is a library without memory."""
_PATIENCE = 2.0
"""Seconds that a child has to end once it was told to."""


def guarded(out: bytes, err: bytes, code: int) -> None:
    """Returns in a child; this process waits for it, and ends as it does.

    Where the child ends without memory, ``out`` and ``err`` are written to the streams of that name
    and the exit code is ``code``.  Signals are handed on.
    """
    parent = os.getpid()
    heard = (signal.SIGINT, signal.SIGTERM)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, heard)  # until somebody hands them on
    child = os.fork()
    if child == 0:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        _quiet()
        from sparc import limits

        limits.stay_with(parent)
        return
    told: list[int] = []
    hand_on = _hand_on(child, told)
    for number in heard:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, hand_on)
    signal.pthread_sigmask(signal.SIG_SETMASK, before)
    status = os.waitpid(child, 0)[1]
    ended = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)
    if told:
        os._exit(128 + told[0])
    if ended in (STARVED, 1) or ended < 0:
        for descriptor, text in ((1, out), (2, err)):
            with suppress(OSError):
                os.write(descriptor, text)
        os._exit(code)
    os._exit(1 if ended == FAULT else ended)


def _hand_on(child: int, told: list[int]) -> Callable[[int, Any], None]:
    """Returns a handler that hands a signal on, and ends a child that does not listen."""

    def kill(number: int, frame: Any) -> None:
        with suppress(OSError):
            os.kill(child, signal.SIGKILL)

    def hand_on(number: int, frame: Any) -> None:
        if not told:
            signal.signal(signal.SIGALRM, kill)
            signal.setitimer(signal.ITIMER_REAL, _PATIENCE)
        told.append(number)
        with suppress(OSError):
            os.kill(child, number)

    return hand_on


def _quiet() -> None:
    """Has a child without memory end without a word."""
    import threading

    def starving(kind: type[BaseException] | None) -> None:
        if kind is not None and issubclass(kind, MemoryError):
            os._exit(STARVED)

    sys.unraisablehook = lambda seen: starving(seen.exc_type)
    threading.excepthook = lambda seen: starving(seen.exc_type)
    sys.excepthook = lambda kind, error, trace: os._exit(STARVED)
