"""Shows one line on a terminal while a long search runs, and removes it at the end.

Entry point `alive`.

Nothing appears where standard error is no terminal, or where the work is done sooner than `PATIENCE`.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from sparc.escaping import on_one_line

__all__ = ["alive"]

PATIENCE = 1.5
"""Seconds of silence that nobody minds."""
PULSE = 0.5
"""Seconds from one line to the next."""


@contextmanager
def alive(doing: str) -> Iterator[Callable[[str], None]]:
    """Shows ``doing``, the seconds that have passed, and what it was told last, until the block ends."""
    if not sys.stderr.isatty() or os.environ.get("TERM") in ("dumb", "unknown"):
        yield lambda text: None
        return
    line = _Line(doing)
    line.thread.start()
    try:
        yield line.note
    finally:
        line.end()


class _Line:
    """The line, written by a thread of its own."""

    def __init__(self, doing: str) -> None:
        self.doing = doing
        self.told = ""
        self.begun = time.monotonic()
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.run, name="progress", daemon=True)

    def note(self, text: str) -> None:
        """Sets what the next line says."""
        self.told = text

    def run(self) -> None:
        from waiter_cli.console.wrapping import columns

        wait = PATIENCE
        while not self.ended.wait(wait):
            wait = PULSE
            seconds = time.monotonic() - self.begun
            text = f"{self.doing}, {seconds:.0f} s" + (f"; {self.told}" if self.told else "")
            text = on_one_line(text)
            width = (columns(sys.stderr) or 80) - 1
            self.write(f"\r\x1b[2K{text if len(text) <= width else text[: width - 1] + '…'}")
        if wait == PULSE:
            self.write("\r\x1b[2K")

    def write(self, text: str) -> None:
        try:
            sys.stderr.write(text)
            sys.stderr.flush()
        except (OSError, ValueError):  # the terminal is gone: the work goes on
            self.ended.set()

    def end(self) -> None:
        self.ended.set()
        self.thread.join()
