"""Measures, and drives several robots by physics: each in a client of its own. Class `FleetBullet`.

A step of PyBullet moves all that is in a client, and the robots set out and stand still at different ticks: so
each has its wheels in its own client, in which the others are hulls that stand where they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from waiter_cli.room.motion import Pose
from waiter_cli.room.shapes import Solid
from waiter_cli.simulation.bullet import Bullet

__all__ = ["FleetBullet"]


class FleetBullet(Bullet):
    """Implements `Bullet`, for the robots of these names."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__()
        self._each = {name: Bullet(physics=True) for name in names}
        self._hulls = {
            name: {other: own.add_hull() for other in names if other != name}
            for name, own in self._each.items()
        }
        self._seen: dict[str, Pose] = {}

    def put(self, solids: Iterable[Solid]) -> None:
        """Implements `Backend.put`."""
        there = tuple(solids)
        super().put(there)
        for own in self._each.values():
            own.put(there)

    def steering(self, name: str) -> Callable[[Pose, Pose, float], Pose]:
        """Implements `Backend.steering`."""
        own, hulls = self._each[name], self._hulls[name]

        def steer(here: Pose, target: Pose, dt: float) -> Pose:
            for other, hull in hulls.items():
                if other in self._seen:
                    own.move_hull(hull, *self._seen[other][:2])
            self._seen[name] = pose = own.steer(here, target, dt)
            return pose

        return steer

    def close(self) -> None:
        """Ends all clients."""
        for own in self._each.values():
            own.close()
        super().close()
