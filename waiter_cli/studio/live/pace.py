"""Real time against simulated time: play, pause, one step, faster and slower. Class `Pace`."""

from __future__ import annotations

import time

from waiter_cli.simulation.outcome import TICKS

__all__ = ["FASTEST", "SLOWEST", "Pace"]

SLOWEST, FASTEST = 0.5, 60.0
_LATE = 0.25
"""Seconds that the simulation may lag behind before the lag is forgotten."""


class Pace:
    """Says how long to wait at a tick.  ``until`` is the step at which a single step ends."""

    def __init__(self, speed: float) -> None:
        self.playing = True
        self.speed = speed
        self.until: int | None = None
        self._since: tuple[float, int] | None = None

    def play(self, playing: bool) -> None:
        """Goes on, or holds everything where it is."""
        self.playing, self.until, self._since = playing, None, None

    def step_to(self, step: int) -> None:
        """Goes on until ``step`` is the next one."""
        self.playing, self.until, self._since = True, step, None

    def at_speed(self, speed: float) -> None:
        """Goes on so many times as fast as the clock on the wall."""
        self.speed, self._since = min(FASTEST, max(SLOWEST, speed)), None

    def wait(self, ticks: int) -> float:
        """Returns the seconds until a tick is due."""
        now = time.perf_counter()
        if self._since is None:
            self._since = now, ticks
        began, first = self._since
        ahead = began + (ticks - first) / TICKS / self.speed - now
        if ahead < -_LATE:
            self._since = now, ticks
        return ahead
