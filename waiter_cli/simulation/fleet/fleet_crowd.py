"""Guests and colleagues among several robots, each of which may lead a party. Class `FleetCrowd`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import hypot

from waiter_cli.model.layout import Point
from waiter_cli.room.motion import Pose
from waiter_cli.room.room import Room
from waiter_cli.simulation.crowd import Crowd

__all__ = ["FleetCrowd"]


@dataclass
class _Escort:
    """Those who follow a robot, and where it went."""

    followers: list[str] = field(default_factory=list)
    trail: list[Point] = field(default_factory=list)


class FleetCrowd(Crowd):
    """Everybody but the robots; ``who`` is the robot of which ``followers`` speaks."""

    def __init__(self, room: Room, robots: Iterable[str]) -> None:
        self._escorts = {name: _Escort() for name in robots}
        self.who = next(iter(self._escorts))
        super().__init__(room)

    @property
    def followers(self) -> list[str]:
        """Returns those who follow the robot, the first one first."""
        return self._escorts[self.who].followers

    @followers.setter
    def followers(self, names: list[str]) -> None:
        self._escorts[self.who].followers = names

    @property
    def _trail(self) -> list[Point]:
        return self._escorts[self.who].trail

    @_trail.setter
    def _trail(self, points: list[Point]) -> None:
        self._escorts[self.who].trail = points

    def escorted(self) -> bool:
        """Does the same as `Crowd.escorted`, of any robot."""
        return any(each.followers for each in self._escorts.values())

    def everybody_who_follows(self) -> set[str]:
        """Returns those who follow some robot."""
        return {name for each in self._escorts.values() for name in each.followers}

    def remove(self, name: str) -> None:
        """Does the same as `Crowd.remove`."""
        self._lead(name)
        super().remove(name)

    def leave(self, party: Sequence[str]) -> None:
        """Does the same as `Crowd.leave`."""
        self._lead(party[0])
        super().leave(party)

    def tick_among(self, dt: float, robots: dict[str, tuple[Pose, bool]]) -> None:
        """Moves everybody for ``dt`` seconds; of each robot the pose is given, and whether it moves."""
        for name, (pose, moves) in robots.items():
            self.who = name
            if self.followers and moves:
                self._lengthen((pose[0], pose[1]))
        poses = [pose for pose, _ in robots.values()]
        for name in sorted(self._moving):
            person = self.people[name]
            self._lead(name)
            self._move(
                person, dt, min(poses, key=lambda p: hypot(p[0] - person.x, p[1] - person.y))
            )

    def _lead(self, name: str) -> None:
        """Speaks of the robot that somebody follows, if there is one."""
        found = (robot for robot, each in self._escorts.items() if name in each.followers)
        self.who = next(found, self.who)
