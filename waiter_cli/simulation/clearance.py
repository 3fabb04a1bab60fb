"""What measures how close the robot comes: `Backend`, and `Geometric`, which needs nothing but arithmetic.

The other one, `waiter_cli.simulation.bullet.Bullet`, measures with PyBullet; both agree within a millimetre,
for every shape is an upright box or cylinder.  `open_backend` opens one.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import floor, hypot
from typing import Protocol

from waiter_cli.room.motion import Pose
from waiter_cli.room.room import ROBOT
from waiter_cli.room.shapes import Solid, distance

__all__ = ["Backend", "Geometric", "REACH"]

REACH = 0.3
"""Metres: clearances beyond are not measured."""
CELL = 1.5


class Backend(Protocol):
    """Keeps the solids of the room and measures the robot's clearance among them."""

    name: str

    def put(self, solids: Iterable[Solid]) -> None:
        """These are there now, and nothing else; unchanged ones cost nothing."""
        ...

    def clearance(self, x: float, y: float) -> tuple[float, str | None]:
        """Metres from the robot's hull to the nearest solid, and its name; (`REACH`, None) beyond."""
        ...

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Where the robot is after ``dt`` seconds of heading for ``target``."""
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
        """As `Backend.put`."""
        wanted = set(solids)
        for solid in self._solids - wanted:
            for cell in _cells(solid):
                self._cells[cell].remove(solid)
        for solid in sorted(wanted - self._solids, key=lambda s: (s.name, s.x, s.y)):
            for cell in _cells(solid):
                self._cells.setdefault(cell, []).append(solid)
        self._solids = wanted

    def clearance(self, x: float, y: float) -> tuple[float, str | None]:
        """As `Backend.clearance`."""
        best, name = REACH, None
        for solid in self._cells.get((floor(x / CELL), floor(y / CELL)), ()):
            if hypot(x - solid.x, y - solid.y) - solid.reach - ROBOT >= best:
                continue
            gap = distance(x, y, solid) - ROBOT
            if gap < best - 2e-5 or (name is not None and gap < best + 2e-5 and solid.name < name):
                best, name = gap, solid.name
        return best, name

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Exactly there."""
        return target

    def close(self) -> None:
        """Nothing to let go of."""


def _cells(solid: Solid) -> list[tuple[int, int]]:
    """The squares in which the robot could be within `REACH` of a solid."""
    grown = solid.reach + ROBOT + REACH
    across = range(floor((solid.x - grown) / CELL), floor((solid.x + grown) / CELL) + 1)
    along = range(floor((solid.y - grown) / CELL), floor((solid.y + grown) / CELL) + 1)
    return [(i, j) for i in across for j in along]
