"""A planning problem, `Problem`: the restaurant, what holds at step 0, and what is wanted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Fact, Goal, Observation, State

if TYPE_CHECKING:
    pass

__all__ = ["Problem", "Reason"]


@dataclass(frozen=True)
class Reason:
    """A reason for something being impossible, and the place in the user's file that
    it comes down to.
    """

    message: str
    where: Where | None = None


@dataclass(frozen=True)
class Problem:
    """All that a plan depends on: the restaurant, what holds at step 0, what is wanted.

    ``before_observations`` is what was believed, ``state`` what holds at step 0 after them.
    ``goals`` is never left out: serving everybody is spelled out (``everybody`` says so).
    Parties in ``goals`` and ``before`` are whole parties, as ``state`` lists them.
    ``contradictions`` is empty, or says why the observations cannot be; then nothing is planned.
    ``state_where`` says where in the user's files the state comes from: under the keys of a
    scenario's ``state``, and for single entries under ``waiters.w1``, ``party.c1`` (first-listed
    member), ``wants_bill.table1``, ``ready.table1.plate``, ``chairs.table1`` and the like.
    ``facts`` are literals that the scenario adds to the program.
    """

    layout: Layout
    before_observations: State
    observations: tuple[Observation, ...]
    state: State
    goals: tuple[Goal, ...]
    before: tuple[tuple[Goal, Goal], ...] = ()
    prefer: tuple[str, ...] = ()
    instant_kitchen: bool = False
    everybody: bool = False
    contradictions: tuple[Reason, ...] = ()
    scenario_file: str = ""
    facts: tuple[Fact, ...] = ()
    state_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)

    def all_goals(self) -> tuple[Goal, ...]:
        """Returns the goals, then those that only an order names; numbered from 1 in a program."""
        goals = list(self.goals)
        for pair in self.before:
            goals.extend(goal for goal in pair if goal not in goals)
        return tuple(goals)

    @property
    def has_own_words(self) -> bool:
        """Returns whether the problem speaks of what only its domain knows."""
        if self.facts or self.state.fluents or self.before_observations.fluents:
            return True
        if any(observation.kind == "obs" for observation in self.observations):
            return True
        return any(goal.fluent is not None for goal in self.all_goals())
