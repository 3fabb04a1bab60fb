"""A robot on two driven wheels, moved by contact and friction alone, for ``--drive physics``.

The wheels' speeds follow a moving pose by the tracking law of Kanayama and others ("A stable
tracking control method for an autonomous mobile robot", 1990).  Entry point `Wheels`.
"""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import Any

from waiter_cli.room.motion import Pose
from waiter_cli.room.room import ROBOT

__all__ = ["Wheels"]

BASE_MASS, WHEEL_MASS, CASTER_MASS = 26.0, 1.5, 0.5  # kilograms
HEIGHT = 1.1  # metres, of the hull
OFF_FLOOR = 0.03
WEIGHT = 0.12  # height of the centre of mass, the origin of the body
RADIUS, TRACK = 0.09, 0.36  # metres: of a wheel, and between the two
CASTER = 0.04
LIFT = 0.001  # the casters only catch what tips: the weight is on the wheels
SUBSTEPS = 4  # of 1/240 s
TORQUE = 12.0  # newton metres that a motor can give
FASTEST, QUICKEST = 1.6, 4.0  # metres and radians a second
ALONG, ACROSS, ROUND = 4.0, 12.0, 5.0  # gains for what is missing ahead, beside and in heading


class Wheels:
    """The body in PyBullet's client ``client``; ``p`` is the module."""

    def __init__(self, p: Any, client: int) -> None:
        self._p, self._client = p, client
        p.setGravity(0, 0, -9.81, physicsClientId=client)
        p.setTimeStep(1 / 240, physicsClientId=client)
        floor = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
        ground = p.createMultiBody(0, floor, physicsClientId=client)
        p.changeDynamics(ground, -1, lateralFriction=1.0, physicsClientId=client)
        self.body = self._build()
        self._at: Pose | None = None
        self._target: Pose | None = None

    def _build(self) -> int:
        p, c = self._p, self._client
        tall = HEIGHT - OFF_FLOOR
        hull = p.createCollisionShape(
            p.GEOM_CYLINDER, radius=ROBOT, height=tall,
            collisionFramePosition=(0, 0, OFF_FLOOR + tall / 2 - WEIGHT), physicsClientId=c,
        )  # fmt: skip
        # A tyre is round across too: it touches the floor in one point, about which it can turn.
        wheel = p.createCollisionShape(p.GEOM_SPHERE, radius=RADIUS, physicsClientId=c)
        ball = p.createCollisionShape(p.GEOM_SPHERE, radius=CASTER, physicsClientId=c)
        level, lying = (0.0, 0.0, 0.0, 1.0), (sin(pi / 4), 0.0, 0.0, cos(pi / 4))  # axis sideways
        body: int = p.createMultiBody(
            BASE_MASS, hull, -1, (0, 0, WEIGHT),
            linkMasses=[WHEEL_MASS, WHEEL_MASS, CASTER_MASS, CASTER_MASS],
            linkCollisionShapeIndices=[wheel, wheel, ball, ball],
            linkVisualShapeIndices=[-1] * 4,
            linkPositions=[
                (0, TRACK / 2, RADIUS - WEIGHT), (0, -TRACK / 2, RADIUS - WEIGHT),
                (0.17, 0, CASTER + LIFT - WEIGHT), (-0.17, 0, CASTER + LIFT - WEIGHT),
            ],
            linkOrientations=[lying, lying, level, level],
            linkInertialFramePositions=[(0, 0, 0)] * 4,
            linkInertialFrameOrientations=[level] * 4,
            linkParentIndices=[0] * 4,
            linkJointTypes=[p.JOINT_REVOLUTE, p.JOINT_REVOLUTE, p.JOINT_FIXED, p.JOINT_FIXED],
            linkJointAxis=[(0, 0, 1)] * 4,
            physicsClientId=c,
        )  # fmt: skip
        for link in range(-1, 4):
            p.changeDynamics(
                body, link, lateralFriction=1.2 if link in (0, 1) else 0.0, collisionMargin=0.0,
                linearDamping=0.0, angularDamping=0.0, physicsClientId=c,
            )  # fmt: skip
        return body

    def place(self, pose: Pose) -> None:
        """Puts the robot down at a pose, at rest."""
        p, c = self._p, self._client
        x, y, yaw = pose
        turn = (0, 0, sin(yaw / 2), cos(yaw / 2))
        p.resetBasePositionAndOrientation(self.body, (x, y, WEIGHT), turn, physicsClientId=c)
        p.resetBaseVelocity(self.body, (0, 0, 0), (0, 0, 0), physicsClientId=c)
        for wheel in (0, 1):
            p.resetJointState(self.body, wheel, 0.0, 0.0, physicsClientId=c)
        self._at = self._target = pose

    def steer(self, here: Pose, target: Pose, dt: float) -> Pose:
        """Returns the robot's pose after ``dt`` seconds in which its wheels follow ``target``."""
        p, c = self._p, self._client
        if self._at is None or hypot(here[0] - self._at[0], here[1] - self._at[1]) > 1e-6:
            self.place(here)
        before = self._target or here
        ahead = hypot(target[0] - before[0], target[1] - before[1]) / dt
        turning = _wrapped(target[2] - before[2]) / dt
        if ahead > FASTEST or abs(turning) > QUICKEST:  # another path begins
            ahead = turning = 0.0
        self._target = target
        for _ in range(SUBSTEPS):
            x, y, yaw = self._pose()
            dx, dy = target[0] - x, target[1] - y
            along, across = cos(yaw) * dx + sin(yaw) * dy, cos(yaw) * dy - sin(yaw) * dx
            away = _wrapped(target[2] - yaw)
            speed = ahead * cos(away) + ALONG * along
            spin = turning + ROUND * sin(away) + ahead * ACROSS * across
            speed = max(-FASTEST, min(FASTEST, speed))
            spin = max(-QUICKEST, min(QUICKEST, spin))
            for wheel, side in ((0, -1), (1, 1)):
                p.setJointMotorControl2(
                    self.body, wheel, p.VELOCITY_CONTROL,
                    targetVelocity=-(speed + side * spin * TRACK / 2) / RADIUS, force=TORQUE,
                    physicsClientId=c,
                )  # fmt: skip
            p.stepSimulation(physicsClientId=c)
        self._at = self._pose()
        return self._at

    def _pose(self) -> Pose:
        (x, y, _), turn = self._p.getBasePositionAndOrientation(
            self.body, physicsClientId=self._client
        )
        return (x, y, atan2(2 * (turn[3] * turn[2]), 1 - 2 * turn[2] ** 2))


def _wrapped(angle: float) -> float:
    return (angle + pi) % (2 * pi) - pi
