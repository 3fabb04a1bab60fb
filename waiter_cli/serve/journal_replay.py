"""Replays a journal: each answer that was given, and whether it was right. Entry point `replay`."""

from __future__ import annotations

from collections.abc import Callable

from waiter_cli.errors import Exit, Fault, InputError, Where
from waiter_cli.execution.decision import Diagnoser
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run
from waiter_cli.serve.journal import stream_journal
from waiter_cli.serve.protocol import to_json
from waiter_cli.serve.startup import (
    Damaged,
    executive_of,
    layout_of,
    replay_record,
    revive,
)

__all__ = ["replay"]


def replay(
    path: str,
    thinker: OnlinePlanner,
    explain: Diagnoser | None,
    tell: Callable[[str], None],
    warn: Callable[[str], None],
) -> Exit:
    """Prints the answers of a journal, and lives through its events in a fresh run meanwhile.

    The state after each event must be the recorded one, and each plan must lead from it to what
    was wanted: else the exit code is 3.  Raises `InputError` where the journal is damaged.
    """
    records = stream_journal(path, warn)
    _, header = next(records, (0, None))
    if header is None:
        raise InputError([Fault(Where(path), "the journal is empty", "name another file")])
    layout = layout_of(header, path)
    executive = executive_of(layout, thinker, explain, state=state_of_layout(layout)[0])
    revive(executive, header, path)
    wrong = 0
    for number, record in records:
        if isinstance(record.get("answer"), dict):
            tell(to_json(record["answer"]))
        try:
            replay_record(executive, record)
        except Damaged as error:
            warn(f"{path}:{number}:1: {error}")
            return Exit.PROVED
        if objection := _objection(executive):
            warn(f"{path}:{number}:1: {objection}")
            wrong += 1
    return Exit.PROVED if wrong else Exit.OK


def _objection(executive: Executive) -> str | None:
    """Returns the fault of the plan that is followed now, by the rules."""
    if isinstance(executive, FleetExecutive):
        found = executive.objection()
        return None if found is None else f"the plan is not possible: {found}"
    decision = executive.decision
    problem: Problem | None = executive.planned
    if problem is None or decision.status == "no_plan" or not decision.plan:
        return None
    start = executive.step + (executive.running is not None)
    if decision.abandoned is not None:
        start = executive.step + 1
    left = executive.remainder(start) or Plan((), 0)
    verdict = run(problem, left, executive.belief.rules)
    return None if verdict.valid else f"the plan is not possible: {'; '.join(verdict.reasons)}"
