"""Measures the robot's distance from its surroundings: `ClearanceMonitor` by a `Backend`.

`Geometric` needs nothing but arithmetic; `waiter_cli.simulation.bullet.Bullet` measures with PyBullet.
Both agree within a millimetre, for every shape is an upright box or cylinder.  `open_backend` opens one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import floor, hypot
from typing import Protocol

from waiter_cli.room.motion import Pose
from waiter_cli.room.room import ROBOT, Room
from waiter_cli.room.shapes import Solid, distance
from waiter_cli.simulation.body import Body
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.world import Violation, World

__all__ = ["LOW", "REACH", "RECOVERY", "Backend", "ClearanceMonitor", "Geometric"]

REACH = 0.3
"""Metres: clearances beyond are not measured."""
CELL = 1.5
LOW = 0.05
"""Metres: a clearance below is worth a warning, again once it has been higher by `RECOVERY`."""
RECOVERY = 0.03


class Backend(Protocol):
    """Keeps the solids of the room and measures the robot's clearance among them."""

    name: str

    def put(self, solids: Iterable[Solid]) -> None:
        """Sets the bodies that are there, and no others; unchanged ones cost nothing."""
        ...

    def clearance(self, x: float, y: float) -> tuple[float, str | None]:
        """Returns metres from the robot's hull to the nearest solid, and its name.

        (`REACH`, None) beyond.
        """
        ...

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Returns the robot's pose after ``dt`` seconds of heading for ``target``."""
        ...

    def steering(self, name: str) -> Callable[[Pose, Pose, float], Pose]:
        """Returns how the robot of that name, of several, is steered."""
        ...

    def close(self) -> None:
        """Lets go of everything."""
        ...


class Geometric:
    """Distances in the plane, by plain arithmetic; solids are found by the square they lie in."""

    name = "geometric"

    def __init__(self) -> None:
        self._solids: set[Solid] = set()
        self._cells: dict[tuple[int, int], list[Solid]] = {}

    def put(self, solids: Iterable[Solid]) -> None:
        """Implements `Backend.put`."""
        numbers = set(solids)
        for solid in self._solids - numbers:
            for cell in _cells(solid):
                self._cells[cell].remove(solid)
        for solid in sorted(numbers - self._solids, key=lambda s: (s.name, s.x, s.y)):
            for cell in _cells(solid):
                self._cells.setdefault(cell, []).append(solid)
        self._solids = numbers

    def clearance(self, x: float, y: float) -> tuple[float, str | None]:
        """Implements `Backend.clearance`."""
        best, name = REACH, None
        for solid in self._cells.get((floor(x / CELL), floor(y / CELL)), ()):
            if hypot(x - solid.x, y - solid.y) - solid.reach - ROBOT >= best:
                continue
            gap = distance(x, y, solid) - ROBOT
            if gap < best - 2e-5 or (name is not None and gap < best + 2e-5 and solid.name < name):
                best, name = gap, solid.name
        return best, name

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Returns the target."""
        return target

    def steering(self, name: str) -> Callable[[Pose, Pose, float], Pose]:
        """Implements `Backend.steering`."""
        return self.steer

    def close(self) -> None:
        """Does nothing: there is nothing to release."""


def _cells(solid: Solid) -> list[tuple[int, int]]:
    """Returns the squares in which the robot could be within `REACH` of a solid."""
    grown = solid.reach + ROBOT + REACH
    across = range(floor((solid.x - grown) / CELL), floor((solid.x + grown) / CELL) + 1)
    along = range(floor((solid.y - grown) / CELL), floor((solid.y + grown) / CELL) + 1)
    return [(i, j) for i in across for j in along]


class ClearanceMonitor:
    """Says where the robot comes too close; ``least`` is the smallest clearance, to ``nearest``."""

    def __init__(
        self,
        room: Room,
        world: World,
        crowd: Crowd,
        body: Body,
        backend: Backend,
        reporter: Reporter,
    ) -> None:
        self.least = REACH
        self.nearest: str | None = None
        self._room, self._world, self._crowd = room, world, crowd
        self._body, self._backend, self._reporter = body, backend, reporter
        self._told: str | None = None
        self._version: tuple[int, tuple[int, ...]] = (-1, ())

    def check(self) -> None:
        """Measures where the robot or something else has moved since the last time."""
        chairs = {name: place.chairs for name, place in self._world.tables.items()}
        version = (self._crowd.version, tuple(chairs.values()))
        fresh = version != self._version
        if fresh:
            self._version = version
            self._backend.put(self._solids(chairs))
        if fresh or self._body.moved:
            self._measure()

    def _solids(self, chairs: dict[str, int]) -> list[Solid]:
        escort = set(self._crowd.followers)
        people = [disc for disc in self._crowd.solids() if disc.name not in escort]
        return [*self._room.furniture(chairs), *people]

    def _measure(self) -> None:
        x, y, _ = self._body.pose
        gap, name = self._backend.clearance(x, y)
        if gap < self.least - 2e-5:
            self.least, self.nearest = gap, name
        if gap >= LOW + RECOVERY:
            self._told = None
        elif gap < LOW and name != self._told:
            self._told = name
            self._reporter.say("clearance_low", other=name, clearance=round(gap, 2))
        if gap < -1e-4 and self._told != f"in {name}":
            self._told = f"in {name}"
            self._reporter.say("collision", other=name, depth=round(-gap, 2))
            self._reporter.fail(Violation("clearance", f"the robot ran into {name}"))
