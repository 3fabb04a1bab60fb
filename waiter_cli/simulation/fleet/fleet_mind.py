"""Several robots in touch with their executive, and what is said of them. Classes `FleetDeliberation`, `FleetReporter`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.precedence import robot_of
from waiter_cli.execution.protocols import JointController
from waiter_cli.model.layout import Point
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation
from waiter_cli.simulation.body import OngoingAction, Shown, SimulatedClock
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.event_log import EventLog, Reporter
from waiter_cli.simulation.fleet.fleet_bodies import FleetBody, RobotBody
from waiter_cli.simulation.fleet.fleet_world import FleetWorld
from waiter_cli.simulation.outcome import BlockedEdge

__all__ = ["FleetDeliberation", "FleetReporter"]


class FleetReporter(Reporter):
    """Says what happens in a run, with the moment and the places of whoever it is about."""

    def __init__(
        self,
        log: EventLog,
        clock: SimulatedClock,
        fleet: FleetBody,
        world: FleetWorld,
        mind: JointController,
        shown: Shown,
        origin: Point = (0.0, 0.0),
    ) -> None:
        super().__init__(log, clock, fleet, world, mind, OngoingAction(), shown, origin)
        self._fleet, self._hands = fleet, world.hands

    def say(self, kind: str, /, **details: Any) -> None:
        """Writes an event about all robots."""
        where = {name: self._where(robot) for name, robot in self._fleet.robots.items()}
        self._log.add(kind, self._clock.time, self._mind.step, where, details, "robots")

    def say_of(self, robot: RobotBody, kind: str, /, **details: Any) -> None:
        """Writes an event about one robot."""
        step = self._mind.step if robot.action is None else robot.action.step
        where = {"name": robot.name, **self._where(robot)}
        self._log.add(kind, self._clock.time, step, where, details)

    def _where(self, robot: RobotBody) -> dict[str, Any]:
        (x, y, yaw), (x0, y0) = robot.pose, self._origin
        return {"x": x + x0, "y": y + y0, "yaw": yaw, "node": self._hands[robot.name].node}


class FleetDeliberation(Deliberation):
    """The executive as a run of several robots deals with it."""

    def __init__(
        self,
        mind: JointController,
        problem: Problem,
        world: FleetWorld,
        fleet: FleetBody,
        reporter: FleetReporter,
    ) -> None:
        super().__init__(mind, problem.layout, world, OngoingAction(), reporter)
        self.fleet_mind, self._fleet = mind, fleet

    def observe(self, seen: Sequence[Observation]) -> Decision:
        """Does the same as `Deliberation.observe`."""
        decision = super().observe(seen)
        self.give_up()
        return decision

    def compare(self) -> None:
        """Does the same as `Deliberation.compare`, unless effects are still to come together with others."""
        if not self.fleet_mind.finished:
            super().compare()

    def done_by(self, robot: str, step: int) -> str | None:
        """Tells that a robot has done its step; returns why that is not believed, None where it is."""
        try:
            self.fleet_mind.done_by({robot: step})
        except Refused as refused:
            return refused.message
        self.give_up()
        return None

    def failed_by(self, robot: str, step: int, why: str, shut: BlockedEdge | None = None) -> None:
        """Tells that the step of a robot failed, and at which path if it was one."""
        self.fleet_mind.failed_by(robot, step, why, plan=shut is None)
        if shut is not None:
            self._without_too(shut)
        self.give_up()

    def _without_too(self, block: BlockedEdge) -> None:
        if any(set(edge) == set(block.edge) for edge in self.fleet_mind.shut):
            self.fleet_mind.decide()
        else:
            self.fleet_mind.block(block.edge)

    def take_out(self, robot: str) -> bool:
        """Tells that a robot stands still; returns whether what it is at goes on once it is back."""
        self.fleet_mind.take_out(robot)
        self.give_up()
        return any(robot_of(action) == robot for action in self.fleet_mind.moving)

    def bring_back(self, robot: str) -> None:
        """Tells that a robot is back."""
        self.fleet_mind.bring_back(robot)
        self.give_up()

    def reopen(self, blocks: Sequence[BlockedEdge]) -> None:
        """Does the same as `Deliberation.reopen`."""
        shut = [set(block.edge) for block in blocks if block.told]
        for edge in self.fleet_mind.shut:
            if set(edge) not in shut:
                revision = self.mind.decision.revision
                self.fleet_mind.clear(edge)
                self.give_up()
                self.tell(revision, "the way is clear again")

    def believes(self, action: Action) -> bool:
        """Returns whether an action can be done in what is believed."""
        return self.fleet_mind.possible(action)

    def give_up(self) -> None:
        """Has the robots give up what cannot end well any more."""
        for action in self.fleet_mind.ahead()[1]:
            robot = self._fleet.robots[robot_of(action)]
            if robot.action == action:
                robot.ongoing.abandoned = True
