"""The event log: one JSON object a line, the same bytes for the same run.

Entry points `EventLog`, and `Reporter`, which adds where the robot is and when.  Numbers are given to
a thousandth and there are no wall times.  The types are those of `TYPES`.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from waiter_cli.execution.protocols import Controller
from waiter_cli.model.layout import Point
from waiter_cli.simulation.body import Body, OngoingAction, Shown, SimulatedClock
from waiter_cli.simulation.outcome import CheckFailure
from waiter_cli.simulation.world import Violation, World

__all__ = ["SCHEMA", "TYPES", "EventLog", "Reporter", "rounded"]

SCHEMA = "waiter.sim/1"
TYPES = (
    "start", "observed", "action_start", "arrived", "picked", "seated", "bill", "ordered", "sent",
    "taken_up", "brought", "refilled", "chairs", "acted", "left", "clearance_low", "collision", "blocked",
    "unblocked", "injected", "precondition_failed", "replan", "action_end", "action_failed", "end",
)  # fmt: skip


def rounded(value: Any) -> Any:
    """Returns a value whose numbers are given to a thousandth.

    >>> rounded({"x": -0.00001, "y": [1.23456, 2]})
    {'x': 0.0, 'y': [1.235, 2]}
    """
    if isinstance(value, float):
        return round(value, 3) + 0.0
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value


class EventLog:
    """Numbers events and hands each line to ``write``."""

    def __init__(self, write: Callable[[str], None] | None = None) -> None:
        self._write = write
        self.count = 0

    def add(
        self, kind: str, time: float, step: int, robot: dict[str, Any], details: dict[str, Any],
        key: str = "robot",
    ) -> dict[str, Any]:  # fmt: skip
        """Writes one event and returns it; ``kind`` is one of `TYPES`.

        ``robot`` stands under ``key``: ``robots`` for an event of several, by name.
        """
        if kind not in TYPES:
            raise ValueError(f"no such type of event: {kind}")
        event = {
            "schema": SCHEMA, "seq": self.count, "t": rounded(time), "step": step, "type": kind,
            key: rounded(robot), **rounded(details),
        }  # fmt: skip
        self.count += 1
        if self._write is not None:
            self._write(json.dumps(event, ensure_ascii=False, separators=(",", ":")) + "\n")
        return event


class Reporter:
    """Says what happens in a run, with the moment and the robot's place, and keeps what failed."""

    def __init__(
        self,
        log: EventLog,
        clock: SimulatedClock,
        body: Body,
        world: World,
        mind: Controller,
        ongoing: OngoingAction,
        shown: Shown,
        origin: Point = (0.0, 0.0),
    ) -> None:
        """``origin`` is that of the room, in the coordinates of the layout's file, as events have them."""
        self.failures: list[CheckFailure] = []
        self._log, self._clock, self._body, self._world = log, clock, body, world
        self._mind, self._ongoing, self._shown = mind, ongoing, shown
        self._origin = origin

    def say(self, kind: str, /, **details: Any) -> None:
        """Writes an event of a type, with its details."""
        x, y, yaw = self._body.pose
        x0, y0 = self._origin
        robot = {"x": x + x0, "y": y + y0, "yaw": yaw, "node": self._world.robot}
        action = self._ongoing.action
        step = self._mind.step if action is None else action.step
        self._log.add(kind, self._clock.time, step, robot, details)

    def fail(self, wrong: Violation) -> None:
        """Keeps a check that failed, and shows it."""
        time = round(self._clock.time, 3)
        self.failures.append(CheckFailure(wrong.check, wrong.reason, time, self._mind.step))
        self._shown.banner = wrong.reason
