"""The stage of a run: its clock, the robot's body, people, and how near they come. Class `Stage`.

Time passes in ticks; each moves people, measures the robot's clearance where something has moved, and
lets happen what is due.  `waiter_cli.simulation.news` says what that is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import atan2, hypot
from random import Random
from typing import Any

from waiter_cli.execution.protocols import Controller
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import State
from waiter_cli.room.motion import Move, Pose
from waiter_cli.room.room import Room
from waiter_cli.room.shapes import Solid
from waiter_cli.simulation.clearance import REACH, Backend
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.injections import Injection
from waiter_cli.simulation.outcome import TICKS, BlockedEdge, CheckFailure, Rules, ShownAction
from waiter_cli.simulation.world import Violation, World

__all__ = ["Stage"]

LOW = 0.05
"""Metres: a clearance below is worth a warning."""
STOP_SHORT = 0.75
"""Metres between the middle of the robot and whoever blocks its way."""


@dataclass
class Stage:
    """Where a run takes place.  ``watch`` is called after every tick, to draw what is there.

    ``predicted`` is the final state of a plan made before, compared where nothing came between.
    """

    room: Room
    problem: Problem
    mind: Controller
    backend: Backend
    log: EventLog
    rules: Rules = field(default_factory=Rules)
    timed: Sequence[TimedEvent] = ()
    injections: Sequence[Injection] = ()
    watch: Callable[[Any], None] | None = None
    predicted: State | None = None
    title: str = ""

    def __post_init__(self) -> None:
        problem, room = self.problem, self.room
        self.world = World(problem.layout, problem.state, problem.instant_kitchen)
        self.crowd = Crowd(room)
        at = room.nodes[problem.state.agent]
        self.pose: Pose = (at[0], at[1], 0.0)
        neighbours = room.near[problem.state.agent]
        if neighbours:
            to = room.nodes[neighbours[0]]
            self.pose = (at[0], at[1], round(atan2(to[1] - at[1], to[0] - at[0]), 6))
        self.ticks = 0
        self.deeds: list[ShownAction] = []
        self.banner = ""
        self.saying = ""
        self.blocks: list[BlockedEdge] = []
        self.failures: list[CheckFailure] = []
        self.min_clearance = REACH
        self.nearest: str | None = None
        self._low: str | None = None
        self._shut: set[frozenset[str]] | None = None  # to be planned without, once this failed
        self._paused = 0
        self._stalled_until = 0.0
        self._moved = True
        self._synced: tuple[int, tuple[int, ...]] = (-1, ())
        self._rng = Random(f"slip {self.rules.seed}")
        self._slip = sum(i.amount or 0.0 for i in self.injections if i.kind == "slip")
        self._failed_in_a_row = 0
        self._failed_actions = self._done_actions = self._replans = 0
        self._disturbed = False
        self._action: Action | None = None
        self._abandoned = False
        self._people_at_start()

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self.ticks / TICKS

    # ------------------------------------------------------------ motion

    def _move(self, move: Move, edge: tuple[str, str] | None = None) -> str | BlockedEdge | None:
        """Plays a piece of motion tick by tick; why it was broken off, or who is in the way."""
        elapsed = 0.0
        while elapsed < move.seconds - 1e-9:
            if edge is not None and move.kind == "drive":
                block = self._block_on(*edge)
                if block is not None and self._ahead(block, edge[1]):
                    return block
            if self.time < self._stalled_until:
                self.banner = "stalled"
                self._moved = False
                self._paused += 1
                self._tick()
                if self.time >= self._stalled_until:
                    self.banner = ""
                continue
            elapsed += 1 / TICKS
            target = move.pose_at(elapsed)
            self._moved = move.kind != "gesture"
            self.pose = (
                self.backend.steer(self.pose, target, 1 / TICKS) if self._moved else self.pose
            )
            self._tick()
            if self._abandoned:
                return "it has become impossible"
        return None

    def _settle(self, at: tuple[float, float]) -> None:
        """The physics drive gets time to come to rest."""
        for _ in range(TICKS):
            if hypot(self.pose[0] - at[0], self.pose[1] - at[1]) < 0.03:
                return
            self.pose = self.backend.steer(self.pose, (at[0], at[1], self.pose[2]), 1 / TICKS)
            self._moved = True
            self._tick()

    def _hold(self, seconds: float, *, stop: bool = True) -> None:
        """Stands still for a while; what comes, comes."""
        end = self.ticks + round(seconds * TICKS)
        while self.ticks < end:
            self._moved = False
            self._paused += 1
            self._tick(news=stop)

    def _block_on(self, a: str, b: str) -> BlockedEdge | None:
        return next((x for x in self.blocks if x.standing and set(x.edge) == {a, b}), None)

    def _ahead(self, block: BlockedEdge, goal: str) -> bool:
        """Whether a block lies between the robot and the end of the edge."""
        who, end = self.crowd.people[block.name], self.room.nodes[goal]
        x, y = self.pose[0], self.pose[1]
        beyond = hypot(who.x - end[0], who.y - end[1]) < hypot(x - end[0], y - end[1])
        return beyond and hypot(who.x - x, who.y - y) < STOP_SHORT

    # ------------------------------------------------------------ one tick

    def _tick(self, news: bool = True) -> None:
        self.ticks += 1
        self.crowd.tick(1 / TICKS, self.pose, self._moved)
        self._update_blocks()
        key = (self.crowd.version, tuple(p.chairs for p in self.world.tables.values()))
        fresh = key != self._synced
        if fresh:
            self._synced = key
            self.backend.put(self._solids())
        if fresh or self._moved:
            self._measure()
        if self.watch is not None:
            self.watch(self)
        if news:
            self._happen()

    def _solids(self) -> list[Solid]:
        chairs = {name: place.chairs for name, place in self.world.tables.items()}
        escort = set(self.crowd.followers)
        people = [disc for disc in self.crowd.solids() if disc.name not in escort]
        return [*self.room.furniture(chairs), *people]

    def _measure(self) -> None:
        gap, name = self.backend.clearance(self.pose[0], self.pose[1])
        if gap < self.min_clearance - 2e-5:
            self.min_clearance, self.nearest = gap, name
        if gap >= LOW + 0.03:
            self._low = None
        elif gap < LOW and name != self._low:
            self._low = name
            self._say("clearance_low", other=name, clearance=round(gap, 2))
        if gap < -1e-4 and self._low != f"in {name}":
            self._low = f"in {name}"
            self._say("collision", other=name, depth=round(-gap, 2))
            self._fail(Violation("clearance", f"the robot ran into {name}"))

    def _update_blocks(self) -> None:
        for block in self.blocks:
            if not block.standing and block.time <= self.time and block.until != -1.0:
                if block.until is not None and block.until <= self.time:
                    block.until = -1.0
                    continue
                a, b = (self.room.nodes[n] for n in block.edge)
                x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
                if hypot(self.pose[0] - x, self.pose[1] - y) >= STOP_SHORT + 0.05:
                    block.standing = True
                    self.crowd.add(block.name, "stranger", (x, y))
            elif block.standing and block.until is not None and block.until <= self.time:
                block.standing, block.until = False, -1.0
                self.crowd.remove(block.name)
                self._say("unblocked", edge="-".join(block.edge))
                self._reopened()

    def _happen(self) -> None:
        """Lets happen what is due."""

    def _reopened(self) -> None:
        """A way is clear again."""

    # ------------------------------------------------------------ people

    def _people_at_start(self) -> None:
        state = self.problem.state
        for who, node in state.waiters:
            self.crowd.add(who, "waiter", self.room.nodes[node])
        for table, party in state.seated:
            self.crowd.sit(party, self.room.chairs[table], at_once=True)
        fresh = {o.arguments for o in self.problem.observations if o.kind == "enter"}
        for party in state.waiting:
            self.crowd.wait(party, come_in=party in fresh)
        if state.with_agent:
            for name in state.with_agent:
                self.crowd.add(name, "guest", self.pose[:2])
            self.crowd.follow(state.with_agent, self.pose)

    def _walk_staff(self, who: str, node: str, seconds: float) -> None:
        person = self.crowd.people.get(who)
        if person is None:
            return
        self.crowd.walk(who, [self.room.nodes[node]], "stand", None, seconds)

    # ------------------------------------------------------------ what is said

    def _fail(self, wrong: Violation) -> None:
        self.failures.append(
            CheckFailure(wrong.check, wrong.reason, round(self.time, 3), self.mind.step)
        )
        self.banner = wrong.reason

    def _say(self, kind: str, /, **details: Any) -> None:
        x, y, yaw = self.pose
        robot = {"x": x, "y": y, "yaw": yaw, "node": self.world.robot}
        step = self.mind.step if self._action is None else self._action.step
        self.log.add(kind, self.time, step, robot, details)
