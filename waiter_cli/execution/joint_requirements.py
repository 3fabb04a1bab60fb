"""Refuses what several robots cannot act in: `Layout`, `Domain`, `Problem` → `InputError`, or nothing.

Entry points `require_joint_run`, `require_joint_words`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain

__all__ = ["require_joint_run", "require_joint_words"]


def require_joint_run(layout: Layout, domain: Domain | None = None) -> None:
    """Raises `InputError` where several robots cannot act: by a domain of the user's own, or one for one robot,
    and where colleagues come by a timetable.
    """
    if not layout.agents:
        return
    places = dict(layout.key_where)
    if domain is not None:
        from waiter_cli.encoding.domains import domain_for_layout
        from waiter_cli.encoding.template import require_robots

        require_robots(domain_for_layout(layout, domain).template, layout)
    if domain is not None and not domain.built_in:
        message = "several robots act by the restaurant's own rules only"
        hint = "leave --domain out, or look at the plan with waiter plan"
        raise InputError([Fault(places.get("agents") or _whole(layout), message, hint)])
    if layout.timetable:
        message = "colleagues who come by a timetable are not lived with by several robots"
        hint = "leave the timetable out and tell where they are with at, or plan with waiter plan"
        raise InputError([Fault(places.get("timetable") or _whole(layout), message, hint)])


def require_joint_words(problem: Problem) -> None:
    """Raises `InputError` where a problem of several robots speaks in words of a domain of the user's own."""
    if not problem.layout.agents or not problem.has_own_words:
        return
    told = [fact.where for fact in problem.facts]
    told += [seen.where for seen in problem.observations if seen.kind == "obs"]
    told += [goal.where for goal in problem.all_goals() if goal.fluent is not None]
    told += [where for key, where in problem.state_where if key.startswith("fluents")]
    place = next((where for where in told if where is not None), None)
    message = (
        "several robots act by the restaurant's own rules, which know no words of another domain"
    )
    raise InputError([Fault(place or _whole(problem.layout), message, "leave them out")])


def _whole(layout: Layout) -> Where:
    return Where(layout.file or layout.name)
