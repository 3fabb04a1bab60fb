"""Keeps who was where when, so that it can be looked back at; old parts make room. Class `FilmReel`.

Changes are kept in stretches that each begin with a whole moment, compressed; the oldest stretches
are forgotten once all of them take more than `MOST_BYTES`.
"""

from __future__ import annotations

import json
import threading
import zlib
from collections import deque
from typing import Any

from waiter_cli.pictures.moments import Change

__all__ = ["FilmReel"]

STRETCH = 20.0
"""Simulated seconds in a stretch."""
MOST_BYTES = 24 << 20
MOST_EVENTS = 5_000


class FilmReel:
    """Changes and events of a run; written by one thread, read by any."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._stretches: deque[tuple[float, bytes]] = deque()  # when each begins
        self._size = 0
        self._open: list[Change] = []
        self._events: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)
        self.end = 0.0

    def add(self, change: Change, whole: dict[str, Any]) -> None:
        """Keeps a change; ``whole`` is the moment after it."""
        with self._lock:
            if self._open and change[0] - self._open[0][0] >= STRETCH:
                self._close()
            self._open.append(change if self._open else [change[0], dict(whole), change[2]])
            self.end = change[0]

    def _close(self) -> None:
        data = zlib.compress(json.dumps(self._open, separators=(",", ":")).encode(), 6)
        self._stretches.append((self._open[0][0], data))
        self._size += len(data)
        self._open = []
        while self._size > MOST_BYTES and len(self._stretches) > 1:
            self._size -= len(self._stretches.popleft()[1])

    def event(self, event: dict[str, Any]) -> None:
        """Keeps an event."""
        with self._lock:
            self._events.append(event)

    def events(self) -> list[dict[str, Any]]:
        """Returns the events that are kept."""
        with self._lock:
            return list(self._events)

    @property
    def begin(self) -> float:
        """Returns the time before which nothing is known any more."""
        with self._lock:
            if self._stretches:
                return self._stretches[0][0]
            return self._open[0][0] if self._open else 0.0

    def since(self, time: float, seconds: float = STRETCH) -> list[Change]:
        """Returns the changes about a time, the first of them a whole moment, and some seconds after."""
        with self._lock:
            parts = [part for part in self._stretches if part[0] <= time + seconds]
            first = max((i for i, part in enumerate(parts) if part[0] <= time), default=0)
            live = list(self._open)
        found: list[Change] = []
        for _, data in parts[first:]:
            found += json.loads(zlib.decompress(data))
        if live and live[0][0] <= time + seconds:
            found += live
        if live and live[0][0] <= time:
            found = live
        return found

    def all(self) -> list[Change]:
        """Returns all changes that are kept."""
        return self.since(self.begin, float("inf"))
