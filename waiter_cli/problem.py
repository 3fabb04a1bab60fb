"""`Layout`, goals, observations → `Problem`. Entry point `pose_problem`.

`problem_from_plan_document` reads a problem back from what ``waiter plan --json`` printed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sparc.values import dataclass, field
from waiter_cli.layout import Layout
from waiter_cli.situation import Goal, Observation, State, Where

if TYPE_CHECKING:
    from waiter_cli.scenario import Scenario

__all__ = ["Problem", "Reason", "pose_problem", "problem_from_plan_document"]


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
    ``state_where`` says where in the user's files the state comes from: under the keys of a
    scenario's ``state``, and for single entries under ``waiters.w1``, ``party.c1`` (first-listed
    member), ``wants_bill.table1``, ``ready.table1.plate``, ``chairs.table1`` and the like.
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


def pose_problem(
    layout: Layout,
    scenario: Scenario | None = None,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
) -> Problem:
    """What is to be planned: the scenario, and what the command line adds to it.

    ``enter`` are sizes of parties (their customers get names), ``bills`` tables, ``goals`` goals in
    YAML; they are observed and wanted besides what the scenario has.  Without any goals everybody
    is to be served.  Raises `LayoutError` with every fault; an observation that cannot be is no
    fault but one of the problem's ``contradictions``.
    """
    from waiter_cli.posing import pose

    return pose(layout, scenario, enter, bills, goals)


def problem_from_plan_document(text: str, name: str, layout: Layout) -> Problem:
    """The problem that a plan file was made for: ``initial_state``, ``goals`` and ``before``.

    Raises `LayoutError` with every fault, each with its line and column in the JSON text.
    """
    from waiter_cli.posing import pose_plan_document

    return pose_plan_document(text, name, layout)
