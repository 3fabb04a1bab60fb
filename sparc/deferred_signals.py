"""Defers signals over a few lines, such as the start of a child process that must be known to be ended.

Entry point `undisturbed`.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

__all__ = ["undisturbed"]

_SIGNALS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGALRM") if hasattr(signal, name)
]


@contextmanager
def undisturbed() -> Iterator[None]:
    """Has signals that come meanwhile handled at the end, as they would have been at once.

    Only the main thread handles signals, so in any other this does nothing.  Keep it short.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    kept: dict[int, Callable[..., Any]] = {}
    try:
        with _held():
            for number in _SIGNALS:
                handler = signal.getsignal(number)
                if callable(handler):  # what ends the process without a word, or is ignored, stays
                    kept[number] = handler
                    signal.signal(number, lambda number, frame: came.append(number))
        yield
    finally:
        with _held():
            for number, handler in kept.items():
                signal.signal(number, handler)
            for each in came:
                signal.raise_signal(each)


@contextmanager
def _held() -> Iterator[None]:
    """Has the system hold signals back, so that no handler sees handlers half exchanged.

    A child must not be started meanwhile: it would hold them back for ever.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    try:
        signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
