"""Guests and colleagues: where they stand, walk, follow, sit. Entry point `Crowd`.

People walk round tables, follow the robot's trail, and make way for the robot while they are on
their feet and moving; who stands or sits is an obstacle.  A colleague whose place the robot is still
leaving waits beside it.  No chance is involved.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import atan2, cos, hypot, pi, sin

from waiter_cli.model.layout import Point
from waiter_cli.room.room import PERSON, ROBOT, Chair, Room
from waiter_cli.room.shapes import Box, Disc

__all__ = ["Crowd", "Person", "footpath"]

STRIDE = 1.25  # metres a second on foot
TIE = 1e-6
"""Metres below which lengths are the same."""
CATCH_UP = 1.1
SPACING = 0.58  # metres between followers
COMFORT = 0.07  # metres that walkers leave between themselves and the robot


@dataclass
class Person:
    """Somebody: ``role`` is guest, waiter or stranger; ``mode`` stand, walk, follow or sit."""

    name: str
    role: str
    number: int
    x: float
    y: float
    yaw: float
    mode: str = "stand"
    path: list[Point] = field(default_factory=list)
    walked: float = 0.0
    speed: float = STRIDE
    then: str = "stand"
    then_yaw: float | None = None
    shown: Point = (0.0, 0.0)
    waits: bool = False


class Crowd:
    """Everybody but the robot; `tick` moves them, ``version`` grows when obstacles change."""

    def __init__(self, room: Room) -> None:
        self.room = room
        self.people: dict[str, Person] = {}
        self.version = 0
        self.followers: list[str] = []
        self._spots: dict[str, int] = {}
        self._trail: list[Point] = []
        self._count = 0
        self._moving: set[str] = set()
        self._blocks = [_around(room.tables[t], room.chairs[t]) for t in room.tables]
        self._blocks += [room.bar] if room.bar else []
        self._blocks += list(room.walls)

    # ------------------------------------------------------------ coming and going

    def add(self, name: str, role: str, at: Point, yaw: float = -pi / 2) -> Person:
        """Returns a new person, who stands at a point."""
        person = Person(name, role, self._count, at[0], at[1], yaw, shown=at)
        self._count += 1
        self.people[name] = person
        self.version += 1
        return person

    def remove(self, name: str) -> None:
        """Removes somebody."""
        self.people.pop(name, None)
        self._spots.pop(name, None)
        self._moving.discard(name)
        self.followers = [other for other in self.followers if other != name]
        self.version += 1

    def wait(self, party: Sequence[str], *, come_in: bool) -> None:
        """A party stands at the entrance, or comes in by the door and walks there."""
        for number, name in enumerate(party):
            spot = self._spot(name)
            toward = self.room.nodes[self.room.layout.entrance]
            yaw = atan2(toward[1] - spot[1], toward[0] - spot[0])
            if come_in:
                self.add(name, "guest", self.room.door)
                self.walk(name, [spot], "stand", yaw)
                self.people[name].walked = -0.7 * number  # one after the other
            else:
                self.add(name, "guest", spot, yaw)

    def follow(self, party: Sequence[str], robot: tuple[float, float, float]) -> None:
        """A party follows the robot from now on."""
        self._trail = [(robot[0], robot[1])]
        before, self.followers = self.followers, [n for n in party if n in self.people]
        for name in before:
            if name not in self.followers:  # left behind
                self._set(self.people[name], "stand")
        for name in self.followers:
            self._spots.pop(name, None)
            self._set(self.people[name], "follow")

    def sit(self, party: Sequence[str], chairs: Sequence[Chair], *, at_once: bool = False) -> float:
        """Returns a party goes to its chairs; seconds until everybody sits."""
        self.followers = []
        longest = 0.0
        for name, chair in zip(party, chairs):
            person = self.people.get(name) or self.add(name, "guest", (chair.x, chair.y))
            if at_once:
                person.x, person.y, person.yaw = chair.x, chair.y, chair.yaw
                person.shown = (chair.x, chair.y)
                self._set(person, "sit")
                continue
            length = self.walk(name, [chair.behind, (chair.x, chair.y)], "sit", chair.yaw)
            longest = max(longest, length / STRIDE)
        return longest

    def leave(self, party: Sequence[str]) -> None:
        """A party gets up, walks to the door and is gone."""
        for name in party:
            person = self.people.get(name)
            if person is None:
                continue
            self._spots.pop(name, None)
            self.followers = [other for other in self.followers if other != name]
            stops = [self.room.door]
            if person.mode == "sit":
                c, s = cos(person.yaw), sin(person.yaw)
                stops.insert(0, (person.x - 0.36 * c, person.y - 0.36 * s))
            self.walk(name, stops, "gone")

    def walk(
        self,
        name: str,
        stops: Sequence[Point],
        then: str,
        yaw: float | None = None,
        seconds: float = 0.0,
    ) -> float:
        """Sends somebody to each stop in turn, round furniture; returns the length of the way.

        ``seconds`` is how long the way may take at most; walking is faster then, if need be.
        """
        person = self.people[name]
        here = (person.x, person.y)
        path = [here]
        for number, stop in enumerate(stops):
            if then == "sit" and number == len(stops) - 1:
                path.append(stop)  # the last step, into the chair
            elif person.mode == "sit" and number == 0 and len(stops) > 1:
                path.append(stop)  # out of the chair
            else:
                path += footpath(path[-1], stop, self._blocks)[1:]
        length = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in itertools.pairwise(path))
        person.path, person.walked, person.then, person.then_yaw = path, 0.0, then, yaw
        person.speed = max(STRIDE, length / seconds) if seconds > 0 else STRIDE
        self._set(person, "walk")
        return length

    # ------------------------------------------------------------ time

    def put(self, name: str, at: Point) -> None:
        """Puts somebody somewhere at once."""
        person = self.people.get(name)
        if person is not None:
            person.x, person.y, person.path = at[0], at[1], []
            self._set(person, "stand")
            self.version += 1

    def send(self, name: str, to: Point, seconds: float) -> None:
        """Has somebody walk to a place within so many seconds, where he is there at all."""
        if name in self.people:
            self.walk(name, [to], "stand", None, seconds)

    def busy(self) -> bool:
        """Returns whether anybody is walking, and not following or waiting for a place."""
        people = [self.people[name] for name in self._moving]
        return any(person.mode == "walk" and not person.waits for person in people)

    def tick(self, dt: float, robot: tuple[float, float, float], robot_moves: bool) -> None:
        """Moves everybody for ``dt`` seconds."""
        if self.followers and robot_moves:
            self._lengthen((robot[0], robot[1]))
        if not self._moving:
            return
        for name in sorted(self._moving):
            self._move(self.people[name], dt, robot)

    def _move(self, person: Person, dt: float, robot: tuple[float, float, float]) -> None:
        """Moves somebody on foot for ``dt`` seconds, out of the robot's way."""
        if person.mode == "follow":
            self._tick_follower(person, dt)
        elif person.mode == "walk":
            person.waits = _must_wait(person, robot)
            if not person.waits:
                self._tick_walker(person, dt)
            if person.mode == "gone":
                self.remove(person.name)
                return
        person.shown = _pushed(person, robot)

    def escorted(self) -> bool:
        """Returns whether anybody follows the robot."""
        return bool(self.followers)

    def solids(self) -> Iterator[Disc]:
        """Yields those who do not make way: whoever stands or sits."""
        for person in self.people.values():
            if person.mode in ("stand", "sit"):
                yield Disc(person.name, person.x, person.y, PERSON)

    def seated_on(self) -> dict[str, Point]:
        """Returns the places of those who sit."""
        return {p.name: (p.x, p.y) for p in self.people.values() if p.mode == "sit"}

    # ------------------------------------------------------------ inside

    def _set(self, person: Person, mode: str) -> None:
        if (person.mode in ("stand", "sit")) or mode in ("stand", "sit"):
            self.version += 1
        person.mode = mode
        if mode in ("walk", "follow"):
            self._moving.add(person.name)
        else:
            self._moving.discard(person.name)
            person.shown = (person.x, person.y)

    def _spot(self, name: str) -> Point:
        queue = self.room.queue
        taken = set(self._spots.values())
        number = next((k for k in range(len(queue)) if k not in taken), len(taken) % len(queue))
        self._spots[name] = number
        return queue[number]

    def _lengthen(self, at: Point) -> None:
        last = self._trail[-1]
        if hypot(at[0] - last[0], at[1] - last[1]) >= 0.04 - TIE:
            self._trail.append(at)
            keep = int((SPACING * (len(self.followers) + 2)) / 0.04) + 8
            if len(self._trail) > 2 * keep:
                del self._trail[:-keep]

    def _tick_follower(self, person: Person, dt: float) -> None:
        need = SPACING * (self.followers.index(person.name) + 1)
        trail = self._trail
        x, y = trail[-1]
        left = need
        for index in range(len(trail) - 1, 0, -1):
            (ax, ay), (bx, by) = trail[index], trail[index - 1]
            piece = hypot(bx - ax, by - ay)
            if piece >= left:
                break
            left -= piece
            x, y = bx, by
        else:  # the robot has not come that far yet: who is near stays where he is
            if hypot(person.x - x, person.y - y) < need + 0.5:
                return
        dx, dy = x - person.x, y - person.y
        far = hypot(dx, dy)
        if far < 0.02:
            return
        step = min(CATCH_UP * dt * (1.0 if far < 1.0 else 1.6), far)
        person.x += dx / far * step
        person.y += dy / far * step
        person.yaw = _eased(person.yaw, atan2(dy, dx), 6.0 * dt)

    def _tick_walker(self, person: Person, dt: float) -> None:
        person.walked += person.speed * dt
        left = person.walked
        if left < 0.0:
            return
        for a, b in zip(person.path, person.path[1:]):
            piece = hypot(b[0] - a[0], b[1] - a[1])
            if left < piece:
                part = left / piece
                person.x, person.y = a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])
                toward = atan2(b[1] - a[1], b[0] - a[0])
                person.yaw = _eased(person.yaw, toward, 8.0 * dt)
                return
            left -= piece
        person.x, person.y = person.path[-1]
        if person.then_yaw is not None:
            person.yaw = person.then_yaw
        if person.then == "gone":
            person.mode = "gone"
        else:
            self._set(person, person.then)


def _around(table: Box, chairs: Sequence[Chair]) -> Box:
    """Returns a table with its chairs as one block that people walk round."""
    points = [*table.corners(0.1)] + [
        (c.x + d, c.y + e) for c in chairs for d in (-0.3, 0.3) for e in (-0.3, 0.3)
    ]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    half = (max(xs) - min(xs)) / 2, (max(ys) - min(ys)) / 2
    return Box(table.name, (max(xs) + min(xs)) / 2, (max(ys) + min(ys)) / 2, *half)


def _must_wait(person: Person, robot: tuple[float, float, float]) -> bool:
    """Returns whether a colleague has come near a place that the robot has not left yet."""
    if person.role != "waiter":
        return False
    need = ROBOT + PERSON + COMFORT
    end_x, end_y = person.path[-1]
    taken = hypot(end_x - robot[0], end_y - robot[1]) < need
    return taken and hypot(person.x - robot[0], person.y - robot[1]) < need + COMFORT


def _pushed(person: Person, robot: tuple[float, float, float]) -> Point:
    """Returns the point to which somebody on the move is pushed: out of the robot's way."""
    dx, dy = person.x - robot[0], person.y - robot[1]
    far, need = hypot(dx, dy), ROBOT + PERSON + COMFORT
    if far >= need:
        return (person.x, person.y)
    side = (-sin(robot[2]), cos(robot[2]))
    across = dx * side[0] + dy * side[1]
    sign = -1.0 if across < 0 else 1.0
    along = dx * cos(robot[2]) + dy * sin(robot[2])
    out = max(need * need - along * along, 0.0) ** 0.5
    return (
        robot[0] + along * cos(robot[2]) + sign * out * side[0],
        robot[1] + along * sin(robot[2]) + sign * out * side[1],
    )


def _eased(yaw: float, toward: float, most: float) -> float:
    away = (toward - yaw + pi) % (2 * pi) - pi
    return yaw + max(-most, min(most, away))


def footpath(start: Point, end: Point, blocks: Sequence[Box]) -> list[Point]:
    """Returns a short way on foot round blocks.

    Straight through where one stands inside or all is full.
    """
    near = [b for b in blocks if not _inside(start, b) and not _inside(end, b)]
    around: list[Box] = []
    path = [start, end]
    for _ in range(6):
        hit = [b for b in near if b not in around and any(map(_crosses_of(b), path, path[1:]))]
        if not hit:
            return path
        around += hit
        path = _shortest(start, end, around) or [start, end]
    return path


def _inside(point: Point, box: Box) -> bool:
    c, s = cos(box.yaw), sin(box.yaw)
    dx, dy = point[0] - box.x, point[1] - box.y
    return abs(c * dx + s * dy) < box.half_x - TIE and abs(c * dy - s * dx) < box.half_y - TIE


def _crosses_of(box: Box):  # type: ignore[no-untyped-def]
    return lambda a, b: _crosses(a, b, box)


def _crosses(a: Point, b: Point, box: Box) -> bool:
    """Returns whether a straight walk leads through the inside of a box."""
    c, s = cos(box.yaw), sin(box.yaw)
    ax, ay = a[0] - box.x, a[1] - box.y
    bx, by = b[0] - box.x, b[1] - box.y
    enter, leave = 0.0, 1.0
    for p, q, half in (
        (c * ax + s * ay, c * bx + s * by, box.half_x - 1e-6),
        (c * ay - s * ax, c * by - s * bx, box.half_y - 1e-6),
    ):
        d = q - p
        if abs(d) < 1e-12:
            if abs(p) >= half:
                return False
            continue
        first, last = sorted(((-half - p) / d, (half - p) / d))
        enter, leave = max(enter, first), min(leave, last)
    return enter < leave


def _shortest(start: Point, end: Point, blocks: Sequence[Box]) -> list[Point] | None:
    corners = [corner for box in blocks for corner in box.corners(0.05)]
    points = [start, end, *(p for p in corners if not any(_inside(p, box) for box in blocks))]
    best = {0: 0.0}
    rest: list[tuple[float, int, tuple[int, ...]]] = [(0.0, 0, (0,))]
    while rest:
        walked, here, path = heapq.heappop(rest)
        if here == 1:
            return [points[k] for k in path]
        if walked > best[here]:
            continue
        for k, point in enumerate(points):
            far = walked + hypot(point[0] - points[here][0], point[1] - points[here][1])
            if far >= best.get(k, float("inf")) - TIE:
                continue
            if any(_crosses(points[here], point, box) for box in blocks):
                continue
            best[k] = far
            heapq.heappush(rest, (far, k, (*path, k)))
    return None
