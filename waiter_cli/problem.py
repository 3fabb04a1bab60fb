"""`Layout`, goals, observations → `Problem`. Entry point `pose_problem`."""

from __future__ import annotations

from dataclasses import dataclass, field

from waiter_cli.layout import Layout
from waiter_cli.situation import Goal, Observation, State, Where

__all__ = ["Problem", "Reason"]


@dataclass(frozen=True, slots=True)
class Reason:
    """Why something cannot be, and the place in the user's file that it comes down to."""

    message: str
    where: Where | None = None


@dataclass(frozen=True)
class Problem:
    """All that a plan depends on: the restaurant, what holds at step 0, what is wanted.

    ``before_observations`` is what was believed, ``state`` what holds at step 0 after them.
    ``goals`` is never left out: serving everybody is spelled out (``everybody`` says so).
    Parties in ``goals`` and ``before`` are whole parties, as ``state`` lists them.
    ``contradictions`` is empty, or says why the observations cannot be; then nothing is planned.
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
    state_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)
