"""Happenings while several robots act, each of which may stop and go on. Classes `FleetHappenings`, `FleetClearance`."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

from waiter_cli.evenings.injections import Injection
from waiter_cli.execution.precedence import robot_of
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Observation, Party
from waiter_cli.room.room import Room
from waiter_cli.room.shapes import Solid
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import OngoingAction, SimulatedClock
from waiter_cli.simulation.clearance import LOW, REACH, RECOVERY, Backend, ClearanceMonitor
from waiter_cli.simulation.fleet.fleet_actor import FleetActor
from waiter_cli.simulation.fleet.fleet_bodies import FleetBody, Job, RobotBody
from waiter_cli.simulation.fleet.fleet_crowd import FleetCrowd
from waiter_cli.simulation.fleet.fleet_mind import FleetDeliberation, FleetReporter
from waiter_cli.simulation.fleet.fleet_world import FleetWorld
from waiter_cli.simulation.happenings import Happenings
from waiter_cli.simulation.outcome import Happening
from waiter_cli.simulation.world import Violation

__all__ = ["FleetClearance", "FleetHappenings"]

AT_NODE = 1e-6
"""Metres from a node within which a robot stands on it."""


class FleetHappenings(Happenings):
    """Does the same as `Happenings`; ``actor`` takes a robot that goes on back to its node."""

    def __init__(
        self,
        problem: Problem,
        timed: Sequence[TimedEvent],
        injections: Sequence[Injection],
        room: Room,
        *,
        clock: SimulatedClock,
        fleet: FleetBody,
        actor: FleetActor,
        world: FleetWorld,
        crowd: FleetCrowd,
        blocks: Blocks,
        deliberation: FleetDeliberation,
        ongoing: OngoingAction,
        reporter: FleetReporter,
        guests: GuestModel | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(
            problem, timed, injections, room, clock=clock, body=fleet, world=world, crowd=crowd,
            blocks=blocks, deliberation=deliberation, ongoing=ongoing, reporter=reporter,
            guests=guests, seed=seed,
        )  # fmt: skip
        self._fleet, self._actor = fleet, actor
        self._minds, self._told, self._hands = deliberation, reporter, world.hands

    def _inject(self, injection: Injection) -> None:
        match injection.kind, injection.subject:
            case "stall", (who,):
                robot = self._fleet.robots[who]
                self._told.say_of(robot, "injected", kind="stall", seconds=injection.amount)
                robot.stall(injection.amount or 0.0)
            case "out", (who,):
                self._stop(self._fleet.robots[who], injection)
            case "back", (who,):
                self._go_on(self._fleet.robots[who])
            case _:
                super()._inject(injection)

    def _stop(self, robot: RobotBody, injection: Injection) -> None:
        """A robot stands still from now on, for a while or for good."""
        lasting = {} if injection.amount is None else {"seconds": injection.amount}
        if robot.out:
            self._told.say_of(robot, "injected", kind="out", ignored="it is out already", **lasting)
            return
        self._told.say_of(robot, "injected", kind="out", **lasting)
        revision = self._minds.mind.decision.revision
        known = robot.name in self._minds.fleet_mind.out  # it is on its way back to its node
        self._stand(robot, not known and self._minds.take_out(robot.name))
        self._minds.tell(revision, f"{robot.name} is out")
        if injection.amount is not None:
            back = Injection("back", injection.text, 0.0, (robot.name,))
            end = self._clock.time + injection.amount
            self._coming.append(Happening(end, len(self._coming), (), back))
            self._coming.sort(key=lambda each: each.time)

    def _stand(self, robot: RobotBody, kept: bool) -> None:
        """Has a robot stand; unless its job is ``kept`` for later, it has failed."""
        robot.out, robot.kept = True, kept
        if not kept:
            if robot.action is not None:
                self._actor.note_failure(robot, robot.action, f"{robot.name} is out")
            robot.job = None

    def stand_still(self, name: str) -> None:
        """Has a robot stand from now on, as whoever decides knows already."""
        moving = self._minds.fleet_mind.moving
        self._stand(self._fleet.robots[name], any(robot_of(each) == name for each in moving))
        self._told.say_of(self._fleet.robots[name], "injected", kind="out")

    def is_ready(self, name: str) -> bool:
        """Returns whether a robot that is out can go on where it stands."""
        robot, at = self._fleet.robots[name], self._room.nodes[self._hands[name].node]
        return robot.kept or robot.away(at) < AT_NODE

    def go_on(self, name: str) -> None:
        """Has a robot go on that `is_ready`, as whoever decides knows already."""
        robot = self._fleet.robots[name]
        robot.out = False
        if not robot.kept:
            self._hands[name].walks = False
        robot.kept = False
        self._told.say_of(robot, "injected", kind="back")

    def go_back(self, name: str) -> None:
        """Has a robot that stopped on its way drive back to its node; then it goes on."""
        self._go_on(self._fleet.robots[name])

    def _go_on(self, robot: RobotBody) -> None:
        """A robot goes on: first back to its node, where it stopped on its way."""
        robot.out = False
        if robot.kept:
            self._bring_back(robot)
        else:
            robot.job = self._home(robot)
        robot.kept = False

    def _home(self, robot: RobotBody) -> Job:
        yield from self._actor.back_to(robot, self._hands[robot.name].node)
        self._hands[robot.name].walks = False
        self._bring_back(robot)

    def _bring_back(self, robot: RobotBody) -> None:
        revision = self._minds.mind.decision.revision
        self._minds.bring_back(robot.name)
        self._told.say_of(robot, "injected", kind="back")
        self._minds.tell(revision, f"{robot.name} is back")

    def _acts(self, who: str) -> bool:
        robot = self._fleet.robots.get(who)
        return robot is not None and (robot.job is not None or robot.out)

    def _show(self, seen: Observation, party: Party | None) -> None:
        robot = self._fleet.robots.get(seen.arguments[0]) if seen.kind == "at" else None
        if robot is None:
            super()._show(seen, party)
        else:
            robot.put(self._room.nodes[seen.arguments[1]])


class FleetClearance(ClearanceMonitor):
    """Says where a robot comes too close to something, or to another robot."""

    def __init__(
        self,
        room: Room,
        world: FleetWorld,
        crowd: FleetCrowd,
        fleet: FleetBody,
        backend: Backend,
        reporter: FleetReporter,
    ) -> None:
        super().__init__(room, world, crowd, fleet, backend, reporter)
        self._fleet, self._escorted, self._sayer = fleet, crowd, reporter
        self._last: dict[Any, str | None] = {}
        self.apart = REACH
        """The least distance between two robots, as far as it was less than that."""

    def _solids(self, chairs: dict[str, int]) -> list[Solid]:
        escort = self._escorted.everybody_who_follows()
        people = [disc for disc in self._crowd.solids() if disc.name not in escort]
        return [*self._room.furniture(chairs), *people]

    def check(self) -> None:
        """Does the same as `ClearanceMonitor.check`, for every robot and every two of them."""
        robots = list(self._fleet.robots.values())
        self._body.moved = any(robot.moved for robot in robots)
        super().check()
        for one, other in combinations(robots, 2):
            if one.moved or other.moved:
                gap = one.gap(other)
                self.apart = min(self.apart, gap)
                self._judge((one.name, other.name), one, gap, other.name if gap < REACH else None)

    def _measure(self) -> None:
        for robot in self._fleet.robots.values():
            x, y, _ = robot.pose
            self._judge(robot.name, robot, *self._backend.clearance(x, y))

    def _judge(self, key: Any, robot: RobotBody, gap: float, name: str | None) -> None:
        if gap < self.least - 2e-5:
            self.least, self.nearest = gap, name
        last = self._last.get(key)
        if gap >= LOW + RECOVERY:
            last = None
        elif gap < LOW and name not in (last, None) and last != f"in {name}":
            last = name
            self._sayer.say_of(robot, "clearance_low", other=name, clearance=round(gap, 2))
        if gap < -1e-4 and last != f"in {name}":
            last = f"in {name}"
            self._sayer.say_of(robot, "collision", other=name, depth=round(-gap, 2))
            self._sayer.fail(Violation("clearance", f"{robot.name} ran into {name}"))
        self._last[key] = last
