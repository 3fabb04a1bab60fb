"""The simulated clock and the robot's body. Entry points `SimulatedClock` and `Body`.

Time passes in ticks of a sixtieth of a second; whoever is listed in the clock is called at each.
`OngoingAction` and `Shown` are the values that the parts of a run share.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import atan2, hypot

from waiter_cli.model.layout import Point
from waiter_cli.model.plan import Action
from waiter_cli.room.motion import Move, Pose
from waiter_cli.room.room import Room
from waiter_cli.simulation.outcome import TICKS, BlockedEdge, ShownAction

__all__ = ["AT_REST", "Body", "SimulatedClock", "Odometer", "OngoingAction", "Shown", "pose_at"]

AT_REST = 0.03
"""Metres from its goal at which the physics drive has come to rest."""


IMPOSSIBLE = "it has become impossible"


@dataclass
class OngoingAction:
    """The action of the robot, None where it does nothing; ``abandoned`` once it makes no sense, and ``why``."""

    action: Action | None = None
    abandoned: bool = False
    why: str = IMPOSSIBLE

    def begin(self, action: Action) -> None:
        """Notes what the robot is at from now on."""
        self.action, self.abandoned, self.why = action, False, IMPOSSIBLE

    def let_fail(self, why: str) -> None:
        """Has the action come to nothing as soon as the robot heeds it."""
        self.abandoned, self.why = True, why


@dataclass
class Shown:
    """The state of a run that pictures show beside the room: its title, captions and past actions."""

    title: str = ""
    banner: str = ""
    saying: str = ""
    deeds: list[ShownAction] = field(default_factory=list)


class SimulatedClock:
    """Counts ticks.  Each calls all of ``passing``, then those of ``due`` unless they are held back."""

    def __init__(self) -> None:
        self.ticks = 0
        self.passing: list[Callable[[], None]] = []
        self.due: list[Callable[[], None]] = []

    @property
    def time(self) -> float:
        """Returns the simulated seconds since the start."""
        return self.ticks / TICKS

    def tick(self, *, due: bool = True) -> None:
        """Lets a sixtieth of a second pass."""
        self.ticks += 1
        for call in (*self.passing, *(self.due if due else ())):
            call()

    def skip_to(self, ticks: int) -> None:
        """Goes ahead to a tick, never back; nothing happens in between."""
        self.ticks = max(self.ticks, ticks)


def pose_at(room: Room, node: str) -> Pose:
    """Returns the pose of a robot that stands on a node and looks along its first edge."""
    x, y = room.nodes[node]
    for first in room.near[node][:1]:
        to = room.nodes[first]
        return (x, y, round(atan2(to[1] - y, to[0] - x), 6))
    return (x, y, 0.0)


class Body:
    """The robot in the plane, moved tick by tick.

    ``steer`` gives the pose after some seconds of heading for another one.  ``moved`` says whether
    the last tick may have moved the robot, ``paused`` counts the ticks in which it stood still.
    """

    def __init__(
        self,
        pose: Pose,
        clock: SimulatedClock,
        steer: Callable[[Pose, Pose, float], Pose],
        ongoing: OngoingAction,
        shown: Shown,
    ) -> None:
        self.pose = pose
        self.moved = True
        self.paused = 0
        self._clock = clock
        self._steer = steer
        self._ongoing = ongoing
        self._shown = shown
        self._stalled_until = 0.0

    def away(self, at: Point) -> float:
        """Returns the metres from the robot to a point."""
        return hypot(self.pose[0] - at[0], self.pose[1] - at[1])

    def put(self, at: Point) -> None:
        """Puts the robot somewhere at once, its heading kept."""
        self.pose, self.moved = (at[0], at[1], self.pose[2]), True

    def stall(self, seconds: float) -> None:
        """Keeps the robot where it is from now on, for so long."""
        self._stalled_until = max(self._stalled_until, self._clock.time + seconds)

    def play(
        self, move: Move, ahead: Callable[[], BlockedEdge | None] | None = None
    ) -> str | BlockedEdge | None:
        """Plays a piece of motion; returns why it was broken off, or what ``ahead`` found in the way."""
        elapsed = 0.0
        while elapsed < move.seconds - 1e-9:
            block = ahead() if ahead is not None else None
            if block is not None:
                return block
            if self._clock.time < self._stalled_until:
                self._wait_stalled()
                continue
            elapsed += 1 / TICKS
            self.moved = move.kind != "gesture"
            if self.moved:
                self.pose = self._steer(self.pose, move.pose_at(elapsed), 1 / TICKS)
            self._clock.tick()
            if self._ongoing.abandoned:
                return self._ongoing.why
        return None

    def _wait_stalled(self) -> None:
        self._shown.banner = "stalled"
        self._stand()
        if self._clock.time >= self._stalled_until:
            self._shown.banner = ""

    def settle(self, at: Point) -> None:
        """Gives the physics drive a second to come to rest at a point."""
        for _ in range(TICKS):
            if self.away(at) < AT_REST:
                return
            self.pose = self._steer(self.pose, (at[0], at[1], self.pose[2]), 1 / TICKS)
            self.moved = True
            self._clock.tick()

    def hold(self, seconds: float, *, due: bool = True) -> None:
        """Stands still for a while; what is ``due`` comes, unless it is held back."""
        end = self._clock.ticks + round(seconds * TICKS)
        while self._clock.ticks < end:
            self._stand(due=due)

    def _stand(self, *, due: bool = True) -> None:
        self.moved = False
        self.paused += 1
        self._clock.tick(due=due)


class Odometer:
    """Counts, tick by tick, the metres that a body drives and the ticks in which it does something."""

    def __init__(self, body: Body, clock: SimulatedClock, ongoing: OngoingAction) -> None:
        self.metres = 0.0
        self._body, self._clock, self._ongoing = body, clock, ongoing
        self._at, self._busy = body.pose[:2], 0

    def tick(self) -> None:
        """Counts one tick."""
        if self._ongoing.action is not None:
            self._busy += 1
        if self._body.moved:
            at = self._body.pose[:2]
            self.metres += hypot(at[0] - self._at[0], at[1] - self._at[1])
            self._at = at

    @property
    def idle(self) -> float:
        """The share of the time so far in which nothing was done."""
        return 1.0 - self._busy / self._clock.ticks if self._clock.ticks else 1.0
