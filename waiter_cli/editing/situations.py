"""Situations that the room Why asks about: texts → a problem, and how a change is kept.

Entry points `posed`, `kept_by`.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Where
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.explanation.causes_and_changes import Relaxation

__all__ = ["SCENARIO", "Asked", "kept_by", "posed"]

SCENARIO = "the scenario"
"""The name of the scenario's text in messages."""


@dataclass(frozen=True)
class Asked:
    """The layout's text and its file, a scenario's text (empty: none) and guests who come besides."""

    layout: str
    file: str
    scenario: str
    enter: int

    def place(self, where: Where | None) -> dict[str, Any]:
        """Returns which of the two texts a place is in, and its line."""
        text = {self.file: "layout", SCENARIO: "scenario"}.get(where.name) if where else None
        return {"in": text, "line": where.line if where and where.line and text else None}


@lru_cache(maxsize=8)
def posed(asked: Asked) -> Problem:
    """Returns the problem; raises `InputError` with the faults of the texts."""
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.files.scenario_reader import read_scenario
    from waiter_cli.problems.pose import pose_problem

    layout = read_layout(asked.layout, asked.file)
    scenario = read_scenario(asked.scenario, SCENARIO, layout) if asked.scenario.strip() else None
    return pose_problem(layout, scenario, enter=[asked.enter] if asked.enter else [])


def kept_by(asked: Asked, problem: Problem, change: Relaxation) -> dict[str, Any] | None:
    """Returns the edit of a text by which a change is kept: ``{"in", "edits"}``, None where there is none."""
    after = change.problem
    old, new = problem.layout, after.layout
    for a, b in new.edges:
        if (a, b) not in old.edges:
            return _in_layout({"do": "add_path", "ends": [a, b]})
    for a, b in old.one_way - new.one_way:
        return _in_layout({"do": "one_way", "what": f"path {a} {b}", "from": None})
    for before, grown in zip(old.tables, new.tables):
        if before.capacity != grown.capacity:
            what = f"table {grown.name}"
            return _in_layout(
                {"do": "set", "what": what, "key": "capacity", "value": grown.capacity}
            )
    in_layout = change.where is not None and change.where.name == asked.file
    for (waiter, node), (_, stood) in zip(after.state.waiters, problem.state.waiters):
        if node != stood:
            if in_layout:
                return _in_layout({"do": "stand", "what": f"waiter {waiter}", "node": node})
            return _in_scenario(asked, {"do": "stand", "waiter": waiter, "node": node})
    sitting = dict(after.state.seated)
    for table, _ in problem.state.seated:
        if table not in sitting:
            return _in_scenario(asked, {"do": "free", "table": table})
    for table in sorted(after.state.wants_bill - problem.state.wants_bill):
        return _in_scenario(asked, {"do": "bill", "table": table})
    for index, goal in enumerate(problem.goals):
        if goal not in after.goals:
            return _in_scenario(asked, {"do": "drop_goal", "index": index})
    return None


def _in_layout(edit: dict[str, Any]) -> dict[str, Any]:
    return {"in": "layout", "edits": [edit]}


def _in_scenario(asked: Asked, edit: dict[str, Any]) -> dict[str, Any] | None:
    """Returns an edit of the scenario, where it is possible in its text."""
    from waiter_cli.editing.scenario_edits import edited_scenario
    from waiter_cli.errors import InputError

    try:
        return {"in": "scenario", "text": edited_scenario(asked.scenario, edit)}
    except InputError:
        return None
