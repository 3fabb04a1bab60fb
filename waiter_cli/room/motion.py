"""The robot's motion: `Action` → turns, drives and gestures, timed. Pure.

Entry points `write_script` for one action and `script_of_plan` for a whole plan.  A script is a tuple
of `Move`; ``pose_at`` says where the robot is so many seconds into one.  Driving speeds up and slows
down; turning on the spot comes first.  Metres, radians, seconds.
"""

from __future__ import annotations

from math import atan2, hypot, pi, sqrt
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.plan import Action, Plan
from waiter_cli.room.room import Room

__all__ = ["Move", "Pose", "drive", "gesture", "script_of_plan", "turn", "way", "write_script"]

Pose: TypeAlias = tuple[float, float, float]

TURN = 2.6  # radians a second
GAIN = 1.2  # metres a second, gained or lost a second
GESTURES = {
    "pick": 1.5,
    "seat": 1.2,
    "give_bill": 1.6,
    "take_order": 2.0,
    "send_order": 1.4,
    "take_up": 1.2,
    "bring": 1.4,
    "refill": 1.2,
    "bring_chairs": 2.0,
}
"""Seconds that each deed takes, besides walking to one's chair."""


@dataclass(frozen=True)
class Move:
    """A piece of motion: ``kind`` is ``turn``, ``drive`` or ``gesture``; it lasts ``seconds``."""

    kind: str
    start: Pose
    end: Pose
    seconds: float
    speed: float = 0.0

    def pose_at(self, elapsed: float) -> Pose:
        """Returns the robot's pose after so many seconds.

        >>> drive((0.0, 0.0, 0.0), (2.0, 0.0), 0.8).pose_at(99.0)
        (2.0, 0.0, 0.0)
        """
        if elapsed >= self.seconds:
            return self.end
        (ax, ay, at), (bx, by, bt) = self.start, self.end
        if self.kind == "turn":
            return (ax, ay, _wrapped(at + _wrapped(bt - at) * elapsed / self.seconds))
        if self.kind == "gesture":
            return self.start
        length = hypot(bx - ax, by - ay)
        part = _travelled(length, self.speed, elapsed) / length
        return (ax + part * (bx - ax), ay + part * (by - ay), bt)


def turn(start: Pose, toward: float) -> Move:
    """Returns a turn on the spot."""
    away = abs(_wrapped(toward - start[2]))
    return Move("turn", start, (start[0], start[1], toward), away / TURN)


def drive(start: Pose, end: tuple[float, float], speed: float) -> Move:
    """Returns a straight drive, the robot looking where it drives."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    yaw = atan2(end[1] - start[1], end[0] - start[0]) if length > 1e-9 else start[2]
    begin = (start[0], start[1], yaw)
    return Move("drive", begin, (end[0], end[1], yaw), _duration(length, speed), speed)


def gesture(start: Pose, seconds: float) -> Move:
    """Returns a pause of some seconds."""
    return Move("gesture", start, start, seconds)


def way(start: Pose, end: tuple[float, float], speed: float) -> tuple[Move, ...]:
    """Returns a turn toward a point, where needed, and the drive there."""
    moves: list[Move] = []
    target = drive(start, end, speed)
    if target.seconds <= 0.0:
        return ()
    if abs(_wrapped(target.end[2] - start[2])) > 1e-6:
        moves.append(turn(start, target.end[2]))
    return (*moves, target)


def write_script(
    action: Action, start: Pose, room: Room, speed: float, place: str | None = None
) -> tuple[Move, ...]:
    """Returns the robot's moves for an action, from a pose on; at a table it turns to it first.

    ``place`` is the table or node at which an action of a domain of one's own is done.
    """
    if action.name == "go_to":
        return way(start, room.nodes[action.arguments[1]], speed)
    target = _faced(action, room) if place is None else _middle_of(place, room)
    moves: list[Move] = []
    if target is not None and target != start[:2]:
        toward = atan2(target[1] - start[1], target[0] - start[0])
        if abs(_wrapped(toward - start[2])) > 1e-6:
            moves.append(turn(start, toward))
            start = moves[-1].end
    return (*moves, gesture(start, GESTURES.get(action.name, 1.0)))


def script_of_plan(
    plan: Plan, start: Pose, room: Room, speed: float
) -> tuple[tuple[Move, ...], ...]:
    """Returns the script of each action in turn, each from where the one before ends."""
    scripts = []
    for action in plan.actions:
        moves = write_script(action, start, room, speed)
        start = moves[-1].end if moves else start
        scripts.append(moves)
    return tuple(scripts)


def _faced(action: Action, room: Room) -> tuple[float, float] | None:
    """Returns the point that the robot faces while it acts."""
    if action.name == "pick":
        return room.queue[0]
    if action.name in ("send_order", "take_up"):
        return (room.bar.x, room.bar.y) if room.bar else None
    table = next((room.tables[name] for name in action.arguments if name in room.tables), None)
    return (table.x, table.y) if table is not None else None


def _middle_of(place: str, room: Room) -> tuple[float, float]:
    """Returns the middle of a table, or a node."""
    table = room.tables.get(place)
    return room.nodes[place] if table is None else (table.x, table.y)


def _wrapped(angle: float) -> float:
    return (angle + pi) % (2 * pi) - pi


def _duration(length: float, speed: float) -> float:
    ramp = speed * speed / GAIN  # metres to speed up and slow down again
    if length >= ramp:
        return length / speed + speed / GAIN
    return 2 * sqrt(length / GAIN)


def _travelled(length: float, speed: float, elapsed: float) -> float:
    """Returns metres driven after ``elapsed`` seconds of a drive over ``length`` metres."""
    total = _duration(length, speed)
    rise = min(speed / GAIN, total / 2)
    if elapsed <= rise:
        return GAIN * elapsed * elapsed / 2
    if elapsed >= total - rise:
        left = total - elapsed
        return length - GAIN * left * left / 2
    return GAIN * rise * rise / 2 + speed * (elapsed - rise)
