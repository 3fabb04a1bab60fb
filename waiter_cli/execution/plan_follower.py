"""Follows a plan made before for as long as nothing comes between, else the executive.

Entry points `PlanFollower`, `thinking`.  Both speak as `waiter_cli.execution.executive.Executive` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace

from waiter_cli.execution.agenda import Agenda, whole_party
from waiter_cli.execution.belief import Belief
from waiter_cli.execution.decision import Decision
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.protocols import PlannerProtocol, rules_of
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.rules.actions import Illegal

__all__ = ["PlanFollower", "thinking"]


def thinking(
    problem: Problem, brain: PlannerProtocol, *, base: int = 0, past: Agenda | None = None
) -> Executive:
    """Returns the executive for a problem, its steps counted from ``base``; it has decided.

    ``past`` knows which goals of ``before`` were reached when, where steps were done already.
    """
    executive = Executive.of_problem(problem, brain)
    executive.step = base
    if past is not None:
        executive.live_on(past)
    executive.decide()
    return executive


class PlanFollower:
    """Follows a plan to its end; when something comes between, the executive takes over.

    What is observed while an action runs is told to the executive once the action is over.
    """

    def __init__(self, problem: Problem, plan: Plan, brain: PlannerProtocol) -> None:
        self._problem = problem
        self._brain = brain
        self._rules = rules_of(brain)
        self._later: Executive | None = None
        self._seen: list[Observation] = []
        self._running = False
        self._step = 0
        self._state = problem.state
        self._decision = Decision(1, plan.actions, plan.horizon)
        self._past = Agenda(before=problem.before)
        self._notice()

    def __copy__(self) -> PlanFollower:
        """Returns an independent one."""
        other = object.__new__(PlanFollower)
        other.__dict__.update(self.__dict__)
        other._later = copy(self._later)
        other._seen = list(self._seen)
        return other

    @property
    def step(self) -> int:
        """Returns the next step."""
        return self._later.step if self._later else self._step

    @property
    def state(self) -> State:
        """Returns the state believed at the next step."""
        return self._later.state if self._later else self._state

    @property
    def decision(self) -> Decision:
        """Returns the decision: the rest of the plan."""
        return self._later.decision if self._later else self._decision

    def started(self, step: int) -> Decision:
        """Does the same as `Executive.started`."""
        self._running = True
        return self._later.started(step) if self._later else self._decision

    def observe(self, seen: Sequence[Observation]) -> Decision:
        """Does the same as `Executive.observe`, after the action that runs."""
        if self._later:
            return self._later.observe(seen)
        self._seen += seen
        return self._decision if self._running else self._hand_over()

    def done(self, step: int) -> Decision:
        """Does the same as `Executive.done`."""
        if self._later:
            return self._later.done(step)
        action = next((a for a in self._decision.plan if a.step == step), None)
        try:
            done = () if action is None else (action,)
            self._state = self._rules.after(self._problem, self._state, done, step)
        except Illegal:
            return self.failed(step)
        return self._next(step)

    def failed(self, step: int, reason: str = "") -> Decision:
        """Does the same as `Executive.failed`: the rest of the plan is worth nothing."""
        if self._later:
            return self._later.failed(step, reason)
        problem = self._problem
        kitchen = problem.instant_kitchen
        belief = Belief(
            problem.layout, self._state, step, instant_kitchen=kitchen, rules=self._rules
        )
        self._state = belief.after_failure()
        self._problem = replace(problem, layout=belief.held_up().layout)
        self._next(step, keep=True)
        return self._hand_over()

    def change_layout(self, layout: Layout) -> Decision:
        """Does the same as `Executive.change_layout`."""
        if self._later is None:
            self._hand_over()
        assert self._later is not None
        return self._later.change_layout(layout)

    def _next(self, step: int, keep: bool = False) -> Decision:
        self._step, self._running = step + 1, False
        self._notice()
        left = tuple(action for action in self._decision.plan if action.step > step)
        self._decision = replace(
            self._decision, plan=left, horizon=max(0, self._decision.horizon - 1)
        )
        return self._hand_over() if self._seen and not keep else self._decision

    def _notice(self) -> None:
        """Remembers which goals of ``before`` hold now."""

        def now(goal: Goal) -> bool:
            whole = whole_party(goal, self._state)
            return whole is not None and self._rules.holds(whole, self._state, self._problem)

        self._past = self._past.noticed(now)

    def _hand_over(self) -> Decision:
        problem = replace(
            self._problem, state=self._state, before_observations=self._state, observations=()
        )
        self._later = thinking(problem, self._brain, base=self._step, past=self._past)
        self._later.decision = replace(self._later.decision, revision=self._decision.revision + 1)
        if self._seen:
            seen, self._seen = self._seen, []
            return self._later.observe(seen)
        return self._later.decision
