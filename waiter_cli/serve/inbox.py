"""Lines on their way to the loop: a queue whose head can be looked at. Entry points `Inbox`, `read_into`.

Whoever reads puts lines in, the loop takes them out.  A reader waits while too much lies there.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from dataclasses import dataclass
from typing import BinaryIO

from waiter_cli.serve.protocol import MAX_LINE

__all__ = ["Inbox", "Line", "read_into"]

MAX_BYTES = 32 << 20
_CHUNK = 1 << 16


@dataclass(frozen=True)
class Line:
    """One line without its end: its number from 1, when it was read (`time.perf_counter`).

    Of a line that is too long only so much is kept that this can be seen.
    """

    number: int
    data: bytes
    received: float


class Inbox:
    """Lines in the order of their arrival."""

    def __init__(self) -> None:
        self._lines: deque[Line] = deque()
        self._bytes = 0
        self._closed = False
        self._changed = threading.Condition()

    def put(self, line: Line) -> None:
        """Adds a line; waits while there is too much already."""
        with self._changed:
            while self._bytes > MAX_BYTES and not self._closed:
                self._changed.wait()
            self._lines.append(line)
            self._bytes += len(line.data)
            self._changed.notify_all()

    def close(self) -> None:
        """No line will be added any more."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def get(self) -> Line | None:
        """Takes the next line out; waits for it; None when there will be none."""
        with self._changed:
            while not self._lines and not self._closed:
                self._changed.wait()
            if not self._lines:
                return None
            line = self._lines.popleft()
            self._bytes -= len(line.data)
            self._changed.notify_all()
            return line

    def peek(self, timeout: float) -> Line | None:
        """The next line, left where it is; None when there is none after ``timeout`` seconds."""
        with self._changed:
            if not self._lines and not self._closed:
                self._changed.wait(timeout)
            return self._lines[0] if self._lines else None


def read_into(inbox: Inbox, stream: BinaryIO) -> None:
    """Reads lines until the stream ends, then closes the inbox; made to be run in a thread."""
    number = 0
    try:
        while True:
            data = stream.readline(MAX_LINE + 2)
            if not data:
                return
            number += 1
            received = time.perf_counter()
            if len(data) > MAX_LINE + 1 and not data.endswith(b"\n"):
                rest = data
                while rest and not rest.endswith(b"\n"):
                    rest = stream.readline(_CHUNK)
            inbox.put(Line(number, data.rstrip(b"\r\n"), received))
    except (OSError, ValueError):  # the stream was closed under our hands
        return
    finally:
        inbox.close()
