"""Reads what a run needs: names of files → `RunRequest`. Entry point `read_run_request`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.scenario_reader import read_scenario_file
from waiter_cli.model.graph import layout_warnings
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import Scenario, TimedEvent
from waiter_cli.model.state import State
from waiter_cli.problems.from_options import read_layout_of, what_changed
from waiter_cli.problems.guests import require_guests
from waiter_cli.problems.pose import pose_problem, problem_from_plan_document

if TYPE_CHECKING:
    from waiter_cli.files.plan_reader import PlanDocument

__all__ = ["RunRequest", "read_run_request"]


@dataclass(frozen=True)
class RunRequest:
    """The problem, what happens later, and a plan made before with its final state, if there is one.

    ``made`` is the plan's file, ``changed`` says what is not as it was when the plan was made.
    ``guests`` come by chance.
    """

    problem: Problem
    events: tuple[TimedEvent, ...] = ()
    plan: Plan | None = None
    predicted: State | None = None
    scenario: str | None = None
    warnings: tuple[Fault, ...] = ()
    made: PlanDocument | None = None
    changed: tuple[str, ...] = ()
    guests: GuestModel | None = None


def read_run_request(
    layout: str | None,
    scenario: str | None,
    plan: str | None,
    enter: Sequence[str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
    seen: Sequence[str] = (),
) -> RunRequest:
    """Returns the run that a command line asks for; raises `InputError` with every fault.

    A plan file starts from its own initial state and is held to its own goals, unless a scenario is
    given too.
    """
    if [layout, scenario, plan].count("-") > 1:
        raise InputError("only one file can come from standard input", "name a file for the others")
    if plan is not None and (enter or bills or goals or seen):
        raise InputError("a plan file has its own situation and goals", "leave these options out")
    document: PlanDocument | None = None
    if plan is not None:
        from waiter_cli.files.plan_reader import read_plan_file

        document = read_plan_file(plan)
    where = None if layout is None else read_layout_file(layout, several=True)
    if where is None and scenario is None:
        if document is None:
            raise InputError("which restaurant?", "give --layout, or a --scenario that names one")
        where = read_layout_of(document)
    found: Scenario | None = None
    if scenario is not None:
        where, found = read_scenario_file(scenario, where, several=True)
    assert where is not None
    if document is not None and not where.agents:
        _in_order(document)
    if document is not None and scenario is None:
        problem = problem_from_plan_document(document.text, document.name, where)
    else:
        problem = pose_problem(where, found, enter, bills, goals, seen)
    predicted = None
    if document is not None:
        from waiter_cli.files.plan_reader import read_final_state

        predicted = read_final_state(document, where)
    events = found.events if found is not None else ()
    if not problem.contradictions:
        require_guests(problem, events)
    return RunRequest(
        problem,
        events,
        document.plan if document is not None else None,
        predicted,
        found.name if found is not None else None,
        layout_warnings(where),
        document,
        what_changed(document, where) if document is not None else (),
        found.guests if found is not None else None,
    )


def _in_order(document: PlanDocument) -> None:
    """Raises `InputError` where two actions share a step, or the order is another."""
    last = -1
    for action in document.plan.actions:
        if action.step <= last or action.step >= document.plan.horizon:
            message = f"step {action.step} ({action.text}) is out of order or past the horizon"
            raise InputError([Fault(Where(document.name), message, "number the actions 0, 1, …")])
        last = action.step
