"""PyBullet, used by this module and `wheels` alone: clearances, the window, cameras.

Its C code writes to both streams, so every call that may speak runs with the file descriptors
pointed elsewhere.  Bodies of mass 0 make no contact points: clearances come from
``getClosestPoints`` after a look at bounding boxes.  Shapes are never freed, so they are shared;
there can be three clients at most.  Collision margins are set to nothing, else corners are round.
Entry points `Bullet` and `require`.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from math import asin, atan2, cos, degrees, sin
from typing import Any

from waiter_cli.errors import MissingError
from waiter_cli.optional_packages import pybullet_line
from waiter_cli.room.camera import Camera, Vec
from waiter_cli.room.figures import Figure, Part
from waiter_cli.room.motion import Pose
from waiter_cli.room.room import ROBOT
from waiter_cli.room.shapes import Box, Solid
from waiter_cli.simulation.clearance import REACH
from waiter_cli.simulation.wheels import Wheels

__all__ = ["Bullet", "Studio", "look_at", "quiet", "require"]

HEIGHT = 1.1
NEARER = 0.42
"""How far a window's camera is, of the distance of that of pictures: it sees a wider field."""


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


def hush() -> None:
    """Silences C code for good: a window's own thread prints when it likes.

    Python's streams go on to where they went.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    sys.stdout = os.fdopen(os.dup(1), "w", buffering=1, encoding="utf-8")
    sys.stderr = os.fdopen(os.dup(2), "w", buffering=1, encoding="utf-8")
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    os.close(nothing)


def require() -> Any:
    """Returns the module ``pybullet``; raises `MissingError` with the line that mends it."""
    try:
        with quiet():
            import numpy  # noqa: F401  # pybullet needs it and does not say so
            import pybullet
    except ImportError as error:
        raise MissingError(f"PyBullet is not installed ({error.name or error})", mend()) from None
    return pybullet


def mend() -> str:
    """Returns the line that gets PyBullet, or what to do where it has no wheels."""
    instead = "use --backend geometric --view 2d, or Python 3.10 or 3.11 on Linux x86_64"
    return pybullet_line() or instead


FAR_AWAY = -1000.0


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
        self._wheels = Wheels(p, self._client) if physics else None
        self._robot = self._wheels.body if self._wheels else self._hull()

    def add_hull(self) -> int:
        """Returns the number of a new hull of a robot, far from everything."""
        body = self._hull()
        self.move_hull(body, FAR_AWAY, FAR_AWAY)
        return body

    def move_hull(self, body: int, x: float, y: float) -> None:
        """Puts a hull somewhere, upright."""
        self._p.resetBasePositionAndOrientation(
            body, (x, y, HEIGHT / 2), (0, 0, 0, 1), physicsClientId=self._client
        )

    def _hull(self) -> int:
        p, c = self._p, self._client
        shape = p.createCollisionShape(
            p.GEOM_CYLINDER, radius=ROBOT, height=HEIGHT, physicsClientId=c
        )
        body: int = p.createMultiBody(0, shape, -1, (0, 0, HEIGHT / 2), physicsClientId=c)
        p.changeDynamics(body, -1, collisionMargin=0.0, physicsClientId=c)
        return body

    def put(self, solids: Iterable[Solid]) -> None:
        """Implements `Backend.put`."""
        p, c = self._p, self._client
        numbers = set(solids)
        for solid in [s for s in self._bodies if s not in numbers]:
            body = self._bodies.pop(solid)
            del self._names[body]  # numbers are used again
            p.removeBody(body, physicsClientId=c)
        fresh = [s for s in numbers if s not in self._bodies]
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
        """Implements `Backend.clearance`."""
        p, c, robot = self._p, self._client, self._robot
        if self._wheels is None:
            self.move_hull(robot, x, y)
        low = (x - ROBOT - REACH, y - ROBOT - REACH, 0.0)
        high = (x + ROBOT + REACH, y + ROBOT + REACH, HEIGHT)
        best, name = REACH, None
        for body in {
            pair[0] for pair in p.getOverlappingObjects(low, high, physicsClientId=c) or ()
        }:
            if body not in self._names:  # the robot, and the floor under its wheels
                continue
            for point in p.getClosestPoints(robot, body, REACH, linkIndexA=-1, physicsClientId=c):
                gap, other = point[8], self._names[body]
                if gap < best - 2e-5 or (name is not None and gap < best + 2e-5 and other < name):
                    best, name = gap, other
        return best, name

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Returns the target; by physics, the pose nearest to it that the wheels reach in that time."""
        return target if self._wheels is None else self._wheels.steer(here, target, dt)

    def steering(self, name: str) -> Callable[[Pose, Pose, float], Pose]:
        """Implements `Backend.steering`: one drives as the other."""
        return self.steer

    def close(self) -> None:
        """Ends the client."""
        if self._client >= 0:
            with quiet():
                self._p.disconnect(self._client)
            self._client = -1


class Studio:
    """A client with visual shapes only: what is drawn. Bodies come and go, their shapes stay.

    TinyRenderer costs by the pixels it covers and by every body that exists: so there are only those
    that a shot needs.
    """

    def __init__(self, *, window: bool = False) -> None:
        self._p = p = require()
        if window:
            hush()
        with quiet():
            self.client: int = p.connect(p.GUI if window else p.DIRECT)
        if self.client < 0:
            raise MissingError("PyBullet could not open a window", "leave --gui out")
        if window:  # a window that draws while it is furnished takes a frame for every chair
            p.configureDebugVisualizer(p.COV_ENABLE_RENDERING, 0, physicsClientId=self.client)
        self._shapes: dict[Part, int] = {}

    def add(self, figure: Figure, x: float, y: float, yaw: float) -> tuple[int, ...]:
        """Returns the bodies of a figure that stands there."""
        p, turn = self._p, (0.0, 0.0, sin(yaw / 2), cos(yaw / 2))
        bodies = []
        for part in figure:
            shape = self._shapes.get(part)
            if shape is None:
                with quiet():
                    shape = p.createVisualShape(
                        p.GEOM_MESH, vertices=part.vertices, indices=part.indices,
                        normals=part.normals, rgbaColor=(*part.colour, 1.0),
                        specularColor=(0.05, 0.05, 0.05), physicsClientId=self.client,
                    )  # fmt: skip
                self._shapes[part] = shape
            bodies.append(
                p.createMultiBody(0, -1, shape, (x, y, 0.0), turn, physicsClientId=self.client)
            )
        return tuple(bodies)

    def move(self, bodies: tuple[int, ...], x: float, y: float, yaw: float) -> None:
        """Puts the bodies of a figure elsewhere."""
        turn = (0.0, 0.0, sin(yaw / 2), cos(yaw / 2))
        for body in bodies:
            self._p.resetBasePositionAndOrientation(
                body, (x, y, 0.0), turn, physicsClientId=self.client
            )

    def remove(self, bodies: tuple[int, ...]) -> None:
        """Takes the bodies of a figure away."""
        for body in bodies:
            self._p.removeBody(body, physicsClientId=self.client)

    def clear(self) -> None:
        """Forgets all bodies; shapes are to be made again."""
        with quiet():
            self._p.resetSimulation(physicsClientId=self.client)
        self._shapes.clear()

    def shoot(
        self, camera: Camera, window: tuple[int, int, int, int], fineness: int
    ) -> tuple[Any, Any, Any]:
        """Colours (h, w, 3), depths and body numbers (-1: nothing) in a window of the picture.

        ``window`` is left, top, right, bottom in pixels; each pixel is drawn ``fineness`` times finer.
        Depths are those of the whole picture's frustum, so windows fit together.
        """
        import numpy as np

        p = self._p
        left, top, right, bottom = window
        half_x, half_y = camera.half
        near = camera.near
        r, t = near * half_x, near * half_y
        frustum = p.computeProjectionMatrix(
            -r + 2 * r * left / camera.width, -r + 2 * r * right / camera.width,
            t - 2 * t * bottom / camera.height, t - 2 * t * top / camera.height, near, camera.far,
        )  # fmt: skip
        target = [e + f for e, f in zip(camera.eye, camera.forward)]
        view = p.computeViewMatrix(camera.eye, target, camera.up)
        w, h = (right - left) * fineness, (bottom - top) * fineness
        image = p.getCameraImage(
            w, h, view, frustum, lightDirection=(-4.0, -5.0, 9.0), lightColor=(1.0, 0.985, 0.95),
            lightDistance=30.0, lightAmbientCoeff=0.60, lightDiffuseCoeff=0.42,
            lightSpecularCoeff=0.04, shadow=0, renderer=p.ER_TINY_RENDERER,
            physicsClientId=self.client,
        )  # fmt: skip
        colours = np.reshape(np.asarray(image[2], dtype=np.uint8), (h, w, 4))[..., :3]
        depths = np.reshape(np.asarray(image[3], dtype=np.float32), (h, w))
        bodies = np.reshape(np.asarray(image[4], dtype=np.int32), (h, w))
        return colours, depths, bodies

    def close(self) -> None:
        """Ends the client."""
        if self.client >= 0:
            with quiet():
                self._p.disconnect(self.client)
            self.client = -1


def look_at(
    studio: Studio, camera: Camera, names: list[tuple[str, Vec]], ways: list[tuple[Vec, Vec]]
) -> None:
    """Points a window's camera at the room, without PyBullet's own panels, with names and ways in it.

    From then on the window draws.
    """
    p, c = require(), studio.client
    with quiet():
        for what in (p.COV_ENABLE_GUI, p.COV_ENABLE_SHADOWS, p.COV_ENABLE_RGB_BUFFER_PREVIEW,
                     p.COV_ENABLE_DEPTH_BUFFER_PREVIEW, p.COV_ENABLE_SEGMENTATION_MARK_PREVIEW):  # fmt: skip
            p.configureDebugVisualizer(what, 0, physicsClientId=c)
        away = -camera.eye[2] / camera.forward[2]
        target = [e + away * f for e, f in zip(camera.eye, camera.forward)]
        yaw = degrees(atan2(camera.forward[1], camera.forward[0])) - 90.0
        pitch = degrees(asin(camera.forward[2]))
        p.resetDebugVisualizerCamera(away * NEARER, yaw, pitch, target, physicsClientId=c)
        for start, end in ways:
            p.addUserDebugLine(start, end, (0.20, 0.42, 0.60), 3, physicsClientId=c)
        for name, at in names:
            p.addUserDebugText(name, at, (0.1, 0.1, 0.1), 1.2, physicsClientId=c)
        p.configureDebugVisualizer(p.COV_ENABLE_RENDERING, 1, physicsClientId=c)
