"""The bodies of several robots, all of them moved in the same tick. Classes `RobotBody` and `FleetBody`."""

from __future__ import annotations

from collections.abc import Callable, Generator
from math import hypot
from typing import TypeAlias

from waiter_cli.model.layout import Point
from waiter_cli.model.plan import Action
from waiter_cli.room.motion import Move, Pose
from waiter_cli.room.room import ROBOT
from waiter_cli.simulation.body import AT_REST, Body, OngoingAction, Shown, SimulatedClock
from waiter_cli.simulation.outcome import TICKS, BlockedEdge, ShownAction

__all__ = ["FleetBody", "Job", "RobotBody"]

KEEP = 0.08
"""Metres between the hulls of two robots within which neither drives nearer to the other."""
PATIENCE = 10.0
"""Seconds for which a robot waits for another one that stands in its way."""

Job: TypeAlias = Generator[None, None, None]
"""What a robot is at; each turn of it is a tick."""


class RobotBody(Body):
    """One robot in the plane, and what it is at."""

    def __init__(
        self, name: str, pose: Pose, clock: SimulatedClock, steer: Callable[[Pose, Pose, float], Pose]
    ) -> None:  # fmt: skip
        self.name = name
        self.ongoing = OngoingAction()
        self.job: Job | None = None
        self.deed: ShownAction | None = None
        self.saying = ""
        self.out = self.kept = False
        """Whether it stands still; whether it goes on with its job once it does not."""
        self.done = self.failed = self.failed_in_a_row = 0
        self.metres, self.busy = 0.0, 0
        self._own = Shown()
        super().__init__(pose, clock, steer, self.ongoing, self._own)

    @property
    def action(self) -> Action | None:
        """Returns the action that it is at, None when it is at none."""
        return self.ongoing.action

    @property
    def stalled(self) -> bool:
        """Returns whether it cannot move now."""
        return self._clock.time < self._stalled_until

    def gap(self, other: RobotBody, pose: Pose | None = None) -> float:
        """Returns metres between its hull (in ``pose``, where one is given) and that of another one."""
        x, y, _ = pose or self.pose
        return hypot(x - other.pose[0], y - other.pose[1]) - 2 * ROBOT

    def work(self) -> None:
        """Goes on with its job for a tick."""
        self.moved = False
        if self.job is None or self.out:
            return
        before = self.pose
        try:
            next(self.job)
        except StopIteration:
            self.job = None
        self.metres += hypot(self.pose[0] - before[0], self.pose[1] - before[1])
        self.busy += self.action is not None

    def glide(
        self,
        move: Move,
        held_up: Callable[[Pose], str | None],
        ahead: Callable[[], BlockedEdge | None] | None = None,
        *,
        heeds: bool = True,
    ) -> Generator[None, None, str | BlockedEdge | None]:
        """Plays a piece of motion, tick by tick; returns why it was broken off, None where it was not.

        ``held_up`` names another robot that is in the way of a pose.  Unless it ``heeds`` that, an
        action that has become impossible goes on.
        """
        elapsed = waited = 0.0
        while elapsed < move.seconds - 1e-9:
            block = ahead() if ahead is not None else None
            if block is not None:
                return block
            then = move.pose_at(elapsed + 1 / TICKS)
            other = held_up(then) if move.kind == "drive" else None
            if self.stalled or other is not None:
                waited += 0.0 if self.stalled else 1 / TICKS
                if waited > PATIENCE:
                    return f"{other} is in the way"
            else:
                elapsed += 1 / TICKS
                self.moved = move.kind != "gesture"
                if self.moved:
                    self.pose = self._steer(self.pose, then, 1 / TICKS)
            yield
            if heeds and self.ongoing.abandoned:
                return self.ongoing.why
        return None

    def come_to_rest(self, at: Point) -> Job:
        """Gives the physics drive a second to come to rest at a point."""
        for _ in range(TICKS):
            if self.away(at) < AT_REST:
                return
            self.pose, self.moved = self._steer(self.pose, (*at, self.pose[2]), 1 / TICKS), True
            yield

    def rest(self, seconds: float) -> Job:
        """Stands still for a while."""
        for _ in range(round(seconds * TICKS)):
            yield


class FleetBody(Body):
    """All robots, as far as a run deals with them as with one."""

    def __init__(self, robots: dict[str, RobotBody], clock: SimulatedClock, shown: Shown) -> None:
        self.robots = robots
        first = next(iter(robots.values()))
        super().__init__(first.pose, clock, first._steer, OngoingAction(), shown)

    def away(self, at: Point) -> float:
        """Returns the metres from the nearest robot to a point."""
        return min(robot.away(at) for robot in self.robots.values())

    def stall(self, seconds: float) -> None:
        """Keeps every robot where it is from now on, for so long."""
        for robot in self.robots.values():
            robot.stall(seconds)

    def hold(self, seconds: float, *, due: bool = True) -> None:
        """Lets time pass; whoever is at something goes on with it."""
        end = self._clock.ticks + round(seconds * TICKS)
        while self._clock.ticks < end:
            self.tick(due=due)

    def tick(self, *, due: bool = True) -> None:
        """Lets every robot go on for a tick."""
        for robot in self.robots.values():
            robot.work()
        self._clock.tick(due=due)

    def held_up(self, robot: RobotBody, pose: Pose) -> str | None:
        """Returns the robot to which another one would come too near in a pose."""
        for other in self.robots.values():
            if other is not robot:
                gap = robot.gap(other, pose)
                if gap < KEEP and gap < robot.gap(other) - 1e-9:
                    return other.name
        return None
