"""PyBullet, and nothing else knows it: clearances, the physics drive, the window, cameras.

Its C code writes to both streams, so every call that may speak runs with the file descriptors
pointed elsewhere.  Bodies of mass 0 make no contact points: clearances come from
``getClosestPoints`` after a look at bounding boxes.  Shapes are never freed, so they are shared;
there can be three clients at most.  Collision margins are set to nothing, else corners are round.
Entry points `Bullet` and `require`.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from math import cos, hypot, sin
from typing import Any

from waiter_cli.exits import MissingError
from waiter_cli.replay.backend import REACH
from waiter_cli.replay.room import ROBOT
from waiter_cli.replay.script import Pose
from waiter_cli.replay.shapes import Box, Solid

__all__ = ["Bullet", "quiet", "require"]

HEIGHT = 1.1
SUBSTEPS = 4
GRIP = 12.0  # how hard the physics drive pulls toward where it should be, per second


@contextmanager
def quiet() -> Iterator[None]:
    """Silences what C code prints: points both file descriptors at nothing for a while."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    nothing = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nothing, 1)
        os.dup2(nothing, 2)
        yield
    finally:
        for descriptor, copy in zip((1, 2), kept):
            os.dup2(copy, descriptor)
            os.close(copy)
        os.close(nothing)


def require() -> Any:
    """The module ``pybullet``; raises `MissingError` with the line that mends it."""
    try:
        with quiet():
            import numpy  # noqa: F401  # pybullet needs it and does not say so
            import pybullet
    except ImportError as error:
        raise MissingError(f"PyBullet is not installed ({error.name or error})", mend()) from None
    return pybullet


def mend() -> str:
    """The line that gets PyBullet, or what to do where it has no wheels."""
    wheels = sys.platform == "linux" and sys.version_info < (3, 12)
    if wheels:
        return f"{os.path.basename(sys.executable)} -m pip install 'waiter-planner[sim]'"
    return "use --backend geometric --view 2d, or Python 3.10 or 3.11 on Linux"


class Bullet:
    """A client with collision shapes only, that measures clearance and drives by physics."""

    def __init__(self, *, physics: bool = False) -> None:
        self.name = "pybullet"
        self._p = p = require()
        with quiet():
            self._client = p.connect(p.DIRECT)
        self._names: dict[int, str] = {}
        self._bodies: dict[Solid, int] = {}
        self._shapes: dict[tuple[float, ...], int] = {}
        self._physics = physics
        self._robot = self._robot_body(physics)

    def _robot_body(self, physics: bool) -> int:
        p, c = self._p, self._client
        shape = p.createCollisionShape(
            p.GEOM_CYLINDER, radius=ROBOT, height=HEIGHT, physicsClientId=c
        )
        body: int = p.createMultiBody(
            30.0 if physics else 0.0, shape, -1, (0, 0, HEIGHT / 2), physicsClientId=c
        )
        p.changeDynamics(body, -1, collisionMargin=0.0, physicsClientId=c)
        if physics:
            p.changeDynamics(
                body, -1, lateralFriction=0.0, linearDamping=0.0, angularDamping=0.0,
                localInertiaDiagonal=(0, 0, 0), physicsClientId=c,
            )  # fmt: skip
            p.setTimeStep(1 / 240, physicsClientId=c)
        return body

    def put(self, solids: Iterable[Solid]) -> None:
        """As `Backend.put`."""
        p, c = self._p, self._client
        wanted = set(solids)
        for solid in [s for s in self._bodies if s not in wanted]:
            body = self._bodies.pop(solid)
            del self._names[body]  # numbers are used again
            p.removeBody(body, physicsClientId=c)
        fresh = [s for s in wanted if s not in self._bodies]
        for solid in sorted(fresh, key=lambda s: (s.name, s.x, s.y)):
            yaw = solid.yaw if isinstance(solid, Box) else 0.0
            turn = (0.0, 0.0, sin(yaw / 2), cos(yaw / 2))
            at = (solid.x, solid.y, solid.height / 2)
            body = p.createMultiBody(0, self._shape(solid), -1, at, turn, physicsClientId=c)
            p.changeDynamics(body, -1, collisionMargin=0.0, physicsClientId=c)
            self._bodies[solid] = body
            self._names[body] = solid.name

    def _shape(self, solid: Solid) -> int:
        p, c = self._p, self._client
        if isinstance(solid, Box):
            key: tuple[float, ...] = (solid.half_x, solid.half_y, solid.height)
            if key not in self._shapes:
                self._shapes[key] = p.createCollisionShape(
                    p.GEOM_BOX, halfExtents=(key[0], key[1], key[2] / 2), physicsClientId=c
                )
        else:
            key = (solid.radius, solid.height)
            if key not in self._shapes:
                self._shapes[key] = p.createCollisionShape(
                    p.GEOM_CYLINDER, radius=key[0], height=key[1], physicsClientId=c
                )
        return self._shapes[key]

    def clearance(self, x: float, y: float) -> tuple[float, str | None]:
        """As `Backend.clearance`."""
        p, c, robot = self._p, self._client, self._robot
        if not self._physics:
            p.resetBasePositionAndOrientation(
                robot, (x, y, HEIGHT / 2), (0, 0, 0, 1), physicsClientId=c
            )
        low = (x - ROBOT - REACH, y - ROBOT - REACH, 0.0)
        high = (x + ROBOT + REACH, y + ROBOT + REACH, HEIGHT)
        best, name = REACH, None
        for body in {
            pair[0] for pair in p.getOverlappingObjects(low, high, physicsClientId=c) or ()
        }:
            if body == robot:
                continue
            for point in p.getClosestPoints(robot, body, REACH, physicsClientId=c):
                gap, other = point[8], self._names[body]
                if gap < best - 2e-5 or (name is not None and gap < best + 2e-5 and other < name):
                    best, name = gap, other
        return best, name

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Exactly there; by physics, as near as pushing gets in that time."""
        if not self._physics:
            return target
        p, c, robot = self._p, self._client, self._robot
        x, y = here[0], here[1]
        level = (0, 0, 0, 1)
        p.resetBasePositionAndOrientation(robot, (x, y, HEIGHT / 2), level, physicsClientId=c)
        for _ in range(SUBSTEPS):
            pull = (GRIP * (target[0] - x), GRIP * (target[1] - y))
            fast = hypot(*pull)
            cut = min(1.0, 1.6 / fast) if fast > 0 else 0.0
            p.resetBaseVelocity(
                robot, (pull[0] * cut, pull[1] * cut, 0), (0, 0, 0), physicsClientId=c
            )
            p.stepSimulation(physicsClientId=c)
            (x, y, _z), _turn = p.getBasePositionAndOrientation(robot, physicsClientId=c)
            p.resetBasePositionAndOrientation(robot, (x, y, HEIGHT / 2), level, physicsClientId=c)
        return (x, y, target[2])

    def close(self) -> None:
        """Ends the client."""
        if self._client >= 0:
            with quiet():
                self._p.disconnect(self._client)
            self._client = -1
