"""The robot's half of the live loop: what it reports becomes lines of the same run.

Classes `LiveController` and, for several robots, `JointLiveController`.

A `Run` of the simulation asks and tells it as it would an executive; each report goes through the
`Session`, so that it is in the journal before it counts, just like what a person says.
"""

from __future__ import annotations

import copy
import json
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.files.documents import observation_document
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Observation, State
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.session import Session

__all__ = ["JointLiveController", "LiveController", "Reported"]

Reported = Callable[[str, int, str], None]
"""Hears of each report its kind, its step and the robot."""


class LiveController:
    """A `Controller` over a `Session`; ``changed`` hears each report, ``noted`` what is seen."""

    def __init__(
        self,
        session: Session,
        changed: Reported,
        noted: Callable[[dict[str, Any]], None],
    ) -> None:
        self._session = session
        self._changed = changed
        self._noted = noted
        self._lines = 0

    def __copy__(self) -> Executive:
        """Returns an executive that is asked what would be, and tells nobody."""
        return copy.copy(self._session.executive)

    @property
    def step(self) -> int:
        """Returns the next step."""
        return self._session.executive.step

    @property
    def state(self) -> State:
        """Returns what is believed at the next step."""
        return self._session.executive.state

    @property
    def decision(self) -> Decision:
        """Returns what is to be done."""
        return self._session.executive.decision

    def observe(self, seen: Sequence[Observation]) -> Decision:
        """Believes what was seen; raises `Refused` where it cannot be."""
        told = [observation_document(one) for one in seen]
        decision = self._tell("observe", told)
        self._noted({"observe": told})
        return decision

    def started(self, step: int) -> Decision:
        """Notes that a step is running."""
        return self._tell("started", step)

    def done(self, step: int) -> Decision:
        """Believes that a step was done; raises `Refused` where it cannot be."""
        return self._tell("done", step)

    def failed(self, step: int, reason: str = "") -> Decision:
        """Believes that a step had no effect."""
        return self._tell("failed", step, reason=reason)

    def drop(self, goal: dict[str, Any]) -> Decision:
        """Wants one thing no longer."""
        return self._tell("drop", goal)

    def abandon(self, why: str) -> None:
        """Has nothing run any more."""
        executive = self._session.executive
        if executive.running is not None:
            self.failed(executive.step, why)

    def end_all(self, why: str) -> None:
        """Has nothing run any more, and nothing kept to go on with."""
        self.abandon(why)

    def change_layout(self, layout: Layout) -> Decision:
        """Plans with the edges of a layout, and no others."""
        executive = self._session.executive
        shut = [edge for edge in executive.layout.edges if edge not in layout.edges]
        opened = [edge for edge in executive.shut if edge in layout.edges]
        for kind, edges in (("block", shut), ("clear", opened)):
            for edge in edges:
                self._tell(kind, list(edge))
        return self.decision

    def _tell(self, kind: str, value: Any, **more: Any) -> Decision:
        return self._tell_of("agent", self.step, kind, value, **more)

    def _tell_of(self, robot: str, step: int, kind: str, value: Any, **more: Any) -> Decision:
        self._lines += 1
        data = json.dumps({kind: value, **more}).encode()
        line = ReceivedLine(self._lines, data, time.perf_counter())
        answer = json.loads(self._session.handle(line))
        if "error" in answer:
            raise Refused(answer["error"]["message"], answer["error"].get("hint"))
        self._changed(kind, step, robot)
        return self.decision


class JointLiveController(LiveController):
    """A `JointController` over a `Session` whose executive is that of several robots."""

    @property
    def _joint(self) -> FleetExecutive:
        executive = self._session.executive
        assert isinstance(executive, FleetExecutive)
        return executive

    @property
    def moving(self) -> tuple[Action, ...]:
        """Returns the actions that have begun and are not yet over."""
        return self._joint.moving

    @property
    def finished(self) -> tuple[Action, ...]:
        """Returns those that are over, but have their effect together with others."""
        return self._joint.finished

    @property
    def out(self) -> tuple[str, ...]:
        """Returns the robots that stand still."""
        return self._joint.out

    @property
    def shut(self) -> tuple[tuple[str, str], ...]:
        """Returns the paths that are not planned with."""
        return self._joint.shut

    def mates(self, action: Action) -> tuple[Action, ...]:
        """As `FleetExecutive.mates`."""
        return self._joint.mates(action)

    def possible(self, action: Action) -> bool:
        """As `FleetExecutive.possible`."""
        return self._joint.possible(action)

    def ahead(self) -> tuple[State, tuple[Action, ...]]:
        """As `FleetExecutive.ahead`."""
        return self._joint.ahead()

    def decide(self) -> Decision:
        """Returns what is to be done; each line has it decided anew."""
        return self.decision

    def started_by(self, robot: str, step: int) -> Decision:
        """Notes that a step of a robot is running."""
        return self._tell_of(robot, step, "started", {robot: step})

    def done_by(self, steps: Mapping[str, int]) -> Decision:
        """Believes that robots have done their steps; raises `Refused` where that cannot be."""
        for robot, step in steps.items():
            self._tell_of(robot, step, "done", {robot: step})
        return self.decision

    def failed_by(self, robot: str, step: int, reason: str = "", *, plan: bool = True) -> Decision:
        """Believes that a step of a robot had no effect; it is planned anew in any case."""
        return self._tell_of(robot, step, "failed", {robot: step}, reason=reason)

    def take_out(self, robot: str) -> Decision:
        """Believes that a robot stands still."""
        return self._tell_of(robot, self.step, "observe", {"out": robot})

    def bring_back(self, robot: str) -> Decision:
        """Believes that a robot acts again."""
        return self._tell_of(robot, self.step, "back", robot)

    def block(self, edge: tuple[str, str]) -> Decision:
        """Plans without a path."""
        return self._tell("block", list(edge))

    def clear(self, edge: tuple[str, str]) -> Decision:
        """Plans with a path again."""
        return self._tell("clear", list(edge))

    def abandon(self, why: str) -> None:
        """As `LiveController.abandon`; what others have ended together with it counts as done."""
        for action in self.moving:
            robot = action.arguments[0]
            if robot in self.out or action not in self.moving:
                continue
            try:
                self.failed_by(robot, action.step, why)
            except Refused:
                self.done_by({robot: action.step})

    def end_all(self, why: str) -> None:
        """As `LiveController.end_all`; whoever stands in a ring that others have been round is round it, too."""
        self.abandon(why)
        for action in self.moving:
            robot = action.arguments[0]
            if robot not in self.out:
                continue
            self.bring_back(robot)
            self.done_by({robot: action.step})
            self.take_out(robot)
