"""Lines on their way to the loop: a queue whose head can be looked at. Entry points `Inbox`, `read_into`.

Whoever reads puts lines in, the loop takes them out.  Each line is counted with what it costs in
memory, so that empty ones count, too.  A reader of stdin waits while too much lies there (`put`);
one that has others to serve asks first (`full`) and is told when there is room again.  The loop
waits for nobody but for the next line.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import BinaryIO

from sparc.lazy_dataclass import dataclass
from waiter_cli.serve.protocol import MAX_LINE

__all__ = ["Inbox", "ReceivedLine", "read_into"]

MAX_BYTES = 8 << 20
"""So much memory the lines that wait may take, and one line more."""
LINE_COST = 320
"""What a line takes beside its bytes: itself, its numbers, its places in queues."""
_CHUNK = 1 << 16


@dataclass(frozen=True)
class ReceivedLine:
    """One line without its end: its number from 1, when it was read (`time.perf_counter`).

    Of a line that is too long only so much is kept that this can be seen.
    """

    number: int
    data: bytes
    received: float


class Inbox:
    """Lines in the order of their arrival; ``on_room`` is called when it is no longer full."""

    def __init__(self, on_room: Callable[[], None] | None = None) -> None:
        self._lines: deque[ReceivedLine] = deque()
        self._cost = 0
        self._closed = False
        self._changed = threading.Condition()
        self._on_room = on_room

    @property
    def full(self) -> bool:
        """Returns whether there is too much already."""
        return self._cost > MAX_BYTES

    def put(self, line: ReceivedLine) -> None:
        """Adds a line; waits while there is too much already."""
        with self._changed:
            while self.full and not self._closed:
                self._changed.wait()
            self._add(line)

    def add(self, line: ReceivedLine) -> None:
        """Adds a line without waiting; for readers that have seen that there is room."""
        with self._changed:
            self._add(line)

    def _add(self, line: ReceivedLine) -> None:
        self._lines.append(line)
        self._cost += len(line.data) + LINE_COST
        self._changed.notify_all()

    def close(self) -> None:
        """Closes the inbox: no line will be added any more."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def get(self) -> ReceivedLine | None:
        """Takes the next line out; waits for it; None when there will be none."""
        with self._changed:
            while not self._lines and not self._closed:
                self._changed.wait()
            if not self._lines:
                return None
            line = self._lines.popleft()
            was_full = self.full
            self._cost -= len(line.data) + LINE_COST
            has_room = was_full and not self.full
            if has_room:
                self._changed.notify_all()
        if has_room and self._on_room is not None:
            self._on_room()
        return line

    def peek(self, timeout: float) -> ReceivedLine | None:
        """Returns the next line, left where it is.

        None when there is none after ``timeout`` seconds.
        """
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
            inbox.put(ReceivedLine(number, data.rstrip(b"\r\n"), received))
    except (OSError, ValueError):  # the stream was closed under our hands
        return
    finally:
        inbox.close()
