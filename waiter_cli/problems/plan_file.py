"""Judges plan files: `PlanDocument` → `Problem`, `Verdict`. Entry points `problem_of`, `judge`."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from waiter_cli.errors import Fault, InputError, LayoutError, Where
from waiter_cli.files.plan_reader import PlanDocument, read_final_state
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.problems.from_options import read_layout_of, what_changed
from waiter_cli.problems.pose import problem_from_plan_document
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.rules.validator import run

if TYPE_CHECKING:
    from waiter_cli.rules.validator import Verdict

__all__ = ["judge", "problem_of"]


def problem_of(document: PlanDocument, layout: Layout | None = None) -> Problem:
    """Returns the problem that a plan file was made for; without a ``layout``, on the one it remembers.

    Raises `InputError` where that layout is not there or has changed, and where the plan is for another
    one; `LayoutError` with every fault of the file's state and goals.
    """
    where = read_layout_of(document) if layout is None else layout
    try:
        return problem_from_plan_document(document.text, document.name, where)
    except LayoutError:
        if document.layout in (None, where.name):
            raise
        message = f"the plan is for the layout {document.layout}, not for {where.name}"
        hint = "give the layout that it was made for"
        raise InputError([Fault(Where(document.name), message, hint)]) from None


def judge(
    document: PlanDocument, problem: Problem, *, own: bool = True, rules: Rulebook = HOUSE
) -> Verdict:
    """Returns the verdict on a plan file, with notes on what the file contradicts.

    ``own`` says that the problem is the file's, so that its final state can be held to what was found.
    """
    verdict = run(problem, document.plan, rules)
    changed = what_changed(document, problem.layout)
    notes = [*verdict.notes, *document.remarks, *changed]
    if own and not changed and verdict.valid and not _as_predicted(document, problem, verdict):
        notes.append("the final_state in the file is not where the actions lead")
    return replace(verdict, notes=tuple(notes))


def _as_predicted(document: PlanDocument, problem: Problem, verdict: Verdict) -> bool:
    """Returns whether the file's final state, where it has one, is the one that was found."""
    try:
        predicted = read_final_state(document, problem.layout)
    except InputError:
        return False
    return predicted is None or predicted == verdict.final_state
