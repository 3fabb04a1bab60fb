"""Rules by which plans are played and observations believed: `Rulebook`, and `HOUSE` in plain Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.rules import actions as rules
from waiter_cli.rules import observations

__all__ = ["HOUSE", "HouseRules", "Rulebook"]


class Rulebook(Protocol):
    """Says what comes of actions and of what is seen; raises `Illegal` for what cannot be."""

    def begin(self, problem: Problem) -> State:
        """Returns the state at step 0 of a problem, with what follows from it at once."""
        ...

    def after(self, problem: Problem, state: State, actions: Sequence[Action], step: int) -> State:
        """Returns the state at ``step + 1`` when these actions, at most one a robot, are done."""
        ...

    def holds(self, goal: Goal, state: State, problem: Problem) -> bool:
        """Returns whether a goal holds in a state."""
        ...

    def observe(
        self, state: State, seen: Sequence[Observation], layout: Layout
    ) -> tuple[State, tuple[Reason, ...]]:
        """Returns the state after what was seen, and why that which cannot be cannot be."""
        ...

    def unknown_words(self, problem: Problem) -> tuple[Reason, ...]:
        """Returns what a problem says that the rules have no words for, and the mends."""
        ...


class HouseRules:
    """The rules of the restaurant as `waiter_cli.rules` has them."""

    def begin(self, problem: Problem) -> State:
        """Implements `Rulebook.begin`."""
        if problem.layout.agents:
            from waiter_cli.rules.joint_steps import begin_together

            return begin_together(problem)
        return rules.begin(problem)

    def after(self, problem: Problem, state: State, actions: Sequence[Action], step: int) -> State:
        """Implements `Rulebook.after`."""
        if problem.layout.agents:
            from waiter_cli.rules.joint_steps import apply_together

            return apply_together(problem, state, actions, step)
        if not actions:
            return rules.idle(problem, state, step)
        return rules.apply(problem, state, actions[0], step)

    def holds(self, goal: Goal, state: State, problem: Problem) -> bool:
        """Implements `Rulebook.holds`."""
        return rules.holds(goal, state, problem)

    def observe(
        self, state: State, seen: Sequence[Observation], layout: Layout
    ) -> tuple[State, tuple[Reason, ...]]:
        """Implements `Rulebook.observe`."""
        return observations.observe(state, seen, layout)

    def unknown_words(self, problem: Problem) -> tuple[Reason, ...]:
        """Implements `Rulebook.unknown_words`: the house knows nothing but its own."""
        if not problem.has_own_words:
            return ()
        hint = "give --domain: only a domain of one's own has fluents of its own"
        return (Reason(f"these rules know no words of a domain's own; {hint}"),)


HOUSE = HouseRules()
