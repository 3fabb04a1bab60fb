"""Actions of the room Layout: a text in, what is to be shown of it out. Entry points are the functions.

The page has the text, and its history; nothing of it is kept here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

from waiter_cli.editing.layout_file import save, state_of
from waiter_cli.files.documents import action_document
from waiter_cli.studio.page_requests import BadRequest, text_of

if TYPE_CHECKING:
    from waiter_cli.execution.agenda import PlannerAnswer
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.problem import Problem
    from waiter_cli.studio.opened import Opened

__all__ = ["LAYOUT_ACTIONS", "answer_to", "planned", "problem_of", "scenario_names"]

Given = dict[str, Any]
PLAN_SECONDS = 2.0
MOST_ENTER = 20


def open_layout(opened: Opened, given: Given) -> Given:
    """Answers ``layout_open``: the file as it is now, and the scenarios that can be pinned."""
    found = state_of(opened.path)
    return {
        "text": found.text,
        "digest": found.digest,
        "kept": found.kept,
        "file": opened.layout.file,
        "scenarios": list(scenario_names(opened)),
        "pinned": opened.scenario_name,
        **_view(opened, found.text),
    }


def look_at_layout(opened: Opened, given: Given) -> Given:
    """Answers ``layout_look`` with ``text``: as `view_of`."""
    return _view(opened, text_of(given, "text"))


def edit_layout(opened: Opened, given: Given) -> Given:
    """Answers ``layout_edit`` with ``text`` and ``edits``: the ``text`` after them, and as `view_of`.

    ``added`` is the name of what was added last; with ``quiet`` nothing is looked at.
    """
    from waiter_cli.editing.edits import edited_text

    edits = given.get("edits")
    if not isinstance(edits, list):
        raise BadRequest("edits must be a list")
    text, added = edited_text(text_of(given, "text"), edits)
    answer = {"text": text, "added": added}
    return answer if given.get("quiet") is True else {**answer, **_view(opened, text)}


def mend_layout(opened: Opened, given: Given) -> Given:
    """Answers ``layout_mends`` with ``text``: for each remark a mend, or null."""
    from waiter_cli.editing.mends import find_mends
    from waiter_cli.errors import LayoutError

    looked = _looked[0]
    try:
        text = text_of(given, "text")
        found = find_mends(text, opened.layout.file, wanted=lambda: _looked[0] == looked)
    except LayoutError:
        found = []
    return {"mends": [each and {"label": each.label, "edits": each.edits} for each in found]}


def save_layout(opened: Opened, given: Given) -> Given:
    """Answers ``layout_save`` with ``text`` and the ``digest`` of what was read, null to write over it.

    Status 409 where the file holds something else by now.
    """
    known = None if given.get("digest", "") is None else text_of(given, "digest")
    digest = save(opened.path, text_of(given, "text"), known)
    if digest is None:
        message = f"{opened.layout.file} was changed elsewhere since it was read"
        raise BadRequest(message, "read it anew, or write over it", 409)
    if opened.live is not None:
        opened.live.note_saved(text_of(given, "text"))
    return {"digest": digest}


def plan_pinned(opened: Opened, given: Given) -> Given:
    """Answers ``layout_plan`` with ``text`` and ``pin``: the plan there, its steps and its metres."""
    from waiter_cli.errors import InputError
    from waiter_cli.files.layout_reader import read_layout

    try:
        layout = read_layout(text_of(given, "text"), opened.layout.file)
        problem = problem_of(opened, layout, given.get("pin"))
    except InputError as error:
        return {"status": "error", "message": error.faults[0].message}
    return planned(opened, problem)


def _seconds(opened: Opened) -> float:
    """Returns how long a person waits for a plan on the page."""
    return max(PLAN_SECONDS, opened.planner.time_limit or 0.0)


_answered: list[tuple[Problem, PlannerAnswer]] = []
"""What was asked last, for the questions that follow."""


def answer_to(opened: Opened, problem: Problem) -> PlannerAnswer:
    """Returns the planner's answer; to what was asked last, that of before."""
    for known, answer in _answered:
        if known is problem:
            return answer
    planner = replace(opened.planner, time_limit=_seconds(opened), by_bounds=True)
    answer = planner.plan(problem)
    _answered[:] = [(problem, answer)]
    return answer


def planned(opened: Opened, problem: Problem) -> Given:
    """Returns the plan of a problem, as the page shows it."""
    from waiter_cli.encoding.declarations import words_for
    from waiter_cli.layout_tools.measure import length
    from waiter_cli.rules.validator import run

    if problem.contradictions:
        return {"status": "contradiction", "message": problem.contradictions[0].message}
    answer = answer_to(opened, problem)
    if answer.plan is None:
        reasons = [reason.message for reason in answer.reasons]
        message = reasons[0] if reasons else f"not decided in {_seconds(opened):g} seconds"
        return {"status": answer.status, "message": message, "reasons": reasons}
    states = run(problem, answer.plan, opened.planner.rules).states
    several = bool(problem.layout.agents)
    routes = {name: [node] for name, node in problem.state.stations().items()}
    steps, metres = [], 0.0
    for action in answer.plan.actions:
        if action.name == "go_to":
            robot, node = action.arguments
            metres += length(problem.layout, routes[robot][-1], node)
            routes[robot].append(node)
        words = words_for(opened.planner.domain, action, states[action.step])
        told = f"{action.arguments[0]}: {words}" if several else words
        steps.append({**action_document(action), "words": told})
    return {
        "status": answer.status,
        "minimal": answer.minimal,
        "horizon": answer.plan.horizon,
        "metres": round(metres, 2),
        "routes": list(routes.values()),
        "steps": steps,
    }


def problem_of(opened: Opened, layout: Layout, pin: Any) -> Problem:
    """Returns the problem of a layout and what is pinned: ``{"scenario": NAME}`` or ``{"enter": N}``.

    Raises `BadRequest` for something else, `InputError` where the scenario does not fit.
    """
    from waiter_cli.files.scenario_reader import read_scenario_file
    from waiter_cli.problems.pose import pose_problem

    pin = pin if isinstance(pin, dict) else {}
    name, enter = pin.get("scenario"), pin.get("enter")
    if isinstance(enter, int) and 1 <= enter <= MOST_ENTER:
        return pose_problem(layout, None, enter=[enter])
    if not isinstance(name, str) or name not in scenario_names(opened):
        raise BadRequest("there is no such scenario to pin")
    return pose_problem(layout, read_scenario_file(name, layout, several=True)[1])


_looked = [0]
"""How often a text was looked at: mends of the one before are wanted no more."""


def _view(opened: Opened, text: str) -> Given:
    from waiter_cli.studio.layout_view import view_of

    _looked[0] += 1
    return view_of(text, opened.layout.file)


@cache
def _shipped(layout: str) -> tuple[str, ...]:
    """Returns the built-in scenarios of a built-in layout."""
    from waiter_cli.errors import InputError
    from waiter_cli.file_access.locate import built_in
    from waiter_cli.files.scenario_reader import read_scenario_file

    found = []
    for name in built_in("scenario"):
        try:
            named, _ = read_scenario_file(name, several=True)
        except InputError:
            continue
        if named.name == layout:
            found.append(name)
    return tuple(found)


def scenario_names(opened: Opened) -> tuple[str, ...]:
    """Returns the scenarios that go with the layout: the one that was opened, and shipped ones."""
    own = (opened.scenario_name,) if opened.scenario_name else ()
    return tuple(dict.fromkeys((*own, *_shipped(opened.layout.name))))


LAYOUT_ACTIONS: dict[str, Callable[[Opened, Given], Given]] = {
    "layout_open": open_layout,
    "layout_look": look_at_layout,
    "layout_edit": edit_layout,
    "layout_mends": mend_layout,
    "layout_save": save_layout,
    "layout_plan": plan_pinned,
}
