"""`Layout`, scenarios → the changes that save most walking. Entry point `improve`.

A change is one more edge, a table moved to a free node, or two tables that swap places.  There may be
thousands; each is first judged by walking the plans of today again on the changed floor, stop by
stop, which takes no planning.  Then those that promise most are planned, with proof, as long as
the budget lasts; only planned figures are reported.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import monotonic

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import InputError
from waiter_cli.layout_tools.advice import physical
from waiter_cli.layout_tools.layout_changes import ChangesEnded, LayoutChange, changes, passed
from waiter_cli.layout_tools.measure import Measured, Totals, measure, pose_all, total
from waiter_cli.layout_tools.stop_walks import StopJudge, WalkedTour, stops_of_plan
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem

__all__ = ["Budget", "Improvement", "Report", "improve"]

PER_PLAN, PER_TIE = 10.0, 1.0
"""Seconds for a plan, and for the shortest walk among the plans of its length."""


@dataclass(frozen=True)
class Improvement:
    """A change and the figures of its plans, over the scenarios that had one before.

    ``solved`` counts the scenarios that have a plan now, the others included.
    """

    change: LayoutChange
    after: Totals
    solved: int
    rows: tuple[Measured, ...] = ()


@dataclass(frozen=True)
class Budget:
    """``seconds`` for everything, ``tries`` changes that are planned at most."""

    seconds: float = 30.0
    tries: int = 24


@dataclass(frozen=True)
class Report:
    """The improvements: best first, and only changes that save walking or solve more scenarios.

    ``rows`` are the scenarios as the layout is today, ``before`` their sums; ``tried`` of
    ``candidates`` changes were planned; ``stopped`` is what ended it: ``time``, ``memory``, ``tries`` or empty.
    """

    rows: tuple[Measured, ...]
    before: Totals
    found: tuple[Improvement, ...]
    tried: int
    candidates: int
    stopped: str = ""
    unfit: tuple[Measured, ...] = field(default=())


def improve(
    layout: Layout,
    scenarios: Sequence[str],
    *,
    edges: bool = True,
    tables: bool = True,
    budget: Budget | None = None,
    progress: Callable[[str], object] = lambda text: None,
) -> Report:
    """Returns the changes that save most metres over the scenarios, judged by plans.

    Raises `InputError` where no scenario fits the layout.
    """
    budget = budget or Budget()
    end = monotonic() + budget.seconds
    posed = pose_all(layout, scenarios)
    problems = [each for each in posed if isinstance(each, Problem)]
    unfit = tuple(each for each in posed if isinstance(each, Measured))
    if not problems:
        raise InputError(f"no scenario fits this layout; {unfit[0].message}", "name others")
    timed = all(node.at is not None for node in layout.nodes)
    rows = tuple(measure(problem, _seconds(end), PER_TIE) for problem in problems)
    before = total([row for row in rows if row.plan is not None], timed)
    used = {word for row in rows if row.plan for a in row.plan.actions for word in a.arguments}
    judge = _judge(layout, problems, rows)
    stopped = ""
    everything: list[LayoutChange] = []
    promise: dict[int, tuple[int, float, int, float]] = {}
    try:
        for change in changes(layout, used if before.scenarios else None, edges, tables, end):
            promise[id(change)] = judge.promise(change)
            everything.append(change)
    except ChangesEnded as ended:
        stopped = ended.limit
    everything.sort(key=lambda change: (promise[id(change)], change.text))
    flaws = sum(1 for _ in physical(layout))
    improvements: list[Improvement] = []
    tried = 0
    for change in everything:
        if stopped:
            break
        if tried == budget.tries:
            stopped = "tries"
            break
        stopped = passed(end)
        if stopped:
            break
        if timed and sum(1 for _ in physical(change.layout)) > flaws:
            continue
        tried += 1
        progress(f"{tried}: {change.text}")
        planned = _planned(change, problems, rows, timed, end)
        if planned is not None and _saves(planned, before, rows):
            improvements.append(planned)
    improvements.sort(key=lambda one: (-one.solved, round(one.after.metres, 6), one.after.steps))
    return Report(rows, before, tuple(improvements), tried, len(everything), stopped, unfit)


def _judge(layout: Layout, problems: Sequence[Problem], rows: Sequence[Measured]) -> StopJudge:
    """Returns what walks the plans of today again."""
    tours = [
        WalkedTour(
            problem.state.agent,
            frozenset(node for _, node in problem.state.waiters),
            stops_of_plan(problem, row.plan),
        )
        for problem, row in zip(problems, rows)
        if row.plan is not None
    ]
    return StopJudge(layout, tours, unreached=any(row.plan is None for row in rows))


def _seconds(end: float) -> float:
    """Returns the seconds that one plan may take."""
    return max(0.5, min(PER_PLAN, end - monotonic()))


def _planned(
    change: LayoutChange,
    problems: Sequence[Problem],
    rows: Sequence[Measured],
    timed: bool,
    end: float,
) -> Improvement | None:
    """Returns the figures after a change; None where a scenario that had a plan gets none in time."""
    after: list[Measured] = []
    for problem, row in zip(problems, rows, strict=True):
        made = measure(replace(problem, layout=change.layout), _seconds(end), PER_TIE)
        if row.plan is not None and (made.plan is None or not made.minimal):
            return None
        after.append(made)
    both = [made for made, row in zip(after, rows) if row.plan is not None]
    solved = sum(1 for made in after if made.plan is not None)
    return Improvement(change, total(both, timed), solved, tuple(after))


def _saves(one: Improvement, before: Totals, rows: Sequence[Measured]) -> bool:
    solved = sum(1 for row in rows if row.plan is not None)
    metres = before.metres - one.after.metres
    return (
        one.solved > solved or metres > 1e-6 or (metres > -1e-6 and one.after.steps < before.steps)
    )
