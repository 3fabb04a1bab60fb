"""Protocols of a planner and of a controller, for execution and simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.execution.decision import Decision
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Observation, State
from waiter_cli.rules.rulebook import HOUSE, Rulebook

__all__ = ["PlannerProtocol", "Controller", "JointController", "rules_of"]


class Controller(Protocol):
    """The controller that a run asks and informs; `Executive` is one.

    ``state`` is what is believed at ``step``, the next one.
    """

    @property
    def step(self) -> int: ...

    @property
    def state(self) -> State: ...

    @property
    def decision(self) -> Decision: ...

    def observe(self, seen: Sequence[Observation]) -> Decision: ...

    def started(self, step: int) -> Decision: ...

    def done(self, step: int) -> Decision: ...

    def failed(self, step: int, reason: str = "") -> Decision: ...

    def change_layout(self, layout: Layout) -> Decision: ...


class JointController(Controller, Protocol):
    """The controller of several robots; `waiter_cli.execution.fleet_executive.FleetExecutive` is one.

    ``moving`` are the actions that have begun, ``finished`` those of them that are over and wait for others to
    have their effect; robots that are ``out`` stand still, paths that are ``shut`` are not planned with.
    """

    @property
    def moving(self) -> tuple[Action, ...]: ...

    @property
    def finished(self) -> tuple[Action, ...]: ...

    @property
    def out(self) -> tuple[str, ...]: ...

    @property
    def shut(self) -> tuple[tuple[str, str], ...]: ...

    def mates(self, action: Action) -> tuple[Action, ...]: ...

    def possible(self, action: Action) -> bool: ...

    def ahead(self) -> tuple[State, tuple[Action, ...]]: ...

    def decide(self) -> Decision: ...

    def started_by(self, robot: str, step: int) -> Decision: ...

    def done_by(self, steps: Mapping[str, int]) -> Decision: ...

    def failed_by(
        self, robot: str, step: int, reason: str = "", *, plan: bool = True
    ) -> Decision: ...

    def take_out(self, robot: str) -> Decision: ...

    def bring_back(self, robot: str) -> Decision: ...

    def block(self, edge: tuple[str, str]) -> Decision: ...

    def clear(self, edge: tuple[str, str]) -> Decision: ...


class PlannerProtocol(Protocol):
    """The planner of an executive: a plan, and two quick tests;
    `waiter_cli.execution.online_planner.OnlinePlanner` is one.
    """

    def plan(self, problem: Problem) -> PlannerAnswer: ...

    def impossible(self, problem: Problem) -> tuple[Reason, ...]: ...

    def least(self, problem: Problem) -> int: ...


def rules_of(planner: PlannerProtocol) -> Rulebook:
    """Returns the rules by which a planner's plans are played; unless it has some, those of the house."""
    rulebook: Rulebook = getattr(planner, "rules", HOUSE)
    return rulebook
