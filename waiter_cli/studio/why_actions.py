"""Actions of the room Why: why a plan is as it is, why there is none, what is known at a step.

Each takes ``layout`` and ``scenario`` (texts) and ``enter`` (guests who come besides, or 0), and
``change``, the number of a change that is tried, or null.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from waiter_cli.editing.situations import Asked, kept_by, posed
from waiter_cli.model.wording import counted
from waiter_cli.studio.layout_actions import answer_to, planned, scenario_names
from waiter_cli.studio.page_requests import BadRequest, text_of

if TYPE_CHECKING:
    from waiter_cli.explanation.causes_and_changes import Cause
    from waiter_cli.explanation.explain import Explanation
    from waiter_cli.explanation.knowledge import Knowledge
    from waiter_cli.model.plan import Plan
    from waiter_cli.model.problem import Problem
    from waiter_cli.model.state import Party, State
    from waiter_cli.studio.opened import Opened

__all__ = ["WHY_ACTIONS"]

Given = dict[str, Any]
Case: TypeAlias = "tuple[Asked, int | None]"
"""What is asked about, and the number of the change that is tried."""
SECONDS = 8.0
"""The time that an explanation may take."""


def open_why(opened: Opened, given: Given) -> Given:
    """Answers ``why_open``: the scenarios, and the one that was opened."""
    return {"scenarios": list(scenario_names(opened)), "opened": opened.scenario_name}


def read_why_scenario(opened: Opened, given: Given) -> Given:
    """Answers ``why_scenario`` with ``name``: its text."""
    from waiter_cli.file_access.locate import read_text

    name = text_of(given, "name")
    if name not in scenario_names(opened):
        raise BadRequest("there is no such scenario")
    return {"text": read_text(name, "scenario").text}


def write_evening(opened: Opened, given: Given) -> Given:
    """Answers ``why_now``: the evening of the room Live as it is at this moment, as a scenario's text."""
    import json

    from waiter_cli.files.documents import goals_document, state_document

    live = opened.live
    if live is None:
        raise BadRequest("there is no evening")
    executive = live.session.executive
    state, goals = live.call(lambda: (executive.state, tuple(executive.goals)))
    known = state_document(state, opened.layout)
    lines = ["# The evening as it is.", "name: now", "state:"]
    lines += [f"  {key}: {json.dumps(value)}" for key, value in known.items()]
    if goals:
        lines += ["goals:", *(f"  - {json.dumps(goal)}" for goal in goals_document(goals))]
    return {"text": "\n".join(lines) + "\n"}


def answer_why(opened: Opened, given: Given) -> Given:
    """Answers ``why_plan``: the plan with its states, or why there is none and what would help.

    ``causes`` are in sets, each of which leaves no plan by itself.  A change has ``keep``: how it is kept.
    """
    from waiter_cli.files.documents import message_document

    asked = _asked(opened, given)
    problem = posed(asked)
    found = planned(opened, problem)
    if found["status"] == "plan" or "steps" in found:
        return {**found, **_shown(opened, problem, found)}
    explained = _explanation(asked, opened)
    conflicts = [
        [
            {"message": cause.message, "about": _about(cause, problem), **asked.place(cause.where)}
            for cause in causes
        ]
        for causes in explained.conflicts
    ]
    changes = [
        {
            "message": helped.change.message,
            "horizon": helped.horizon,
            "keep": kept_by(asked, problem, helped.change),
            **asked.place(helped.change.where),
        }
        for helped in explained.helped
    ]
    reasons = [
        {**message_document(reason.message, reason.where), **asked.place(reason.where)}
        for reason in explained.reasons
    ]
    stories = [list(diagnosis.text) for diagnosis in explained.diagnoses]
    return {
        **found,
        "reasons": reasons,
        "conflicts": conflicts,
        "changes": changes,
        "stories": stories,
        **_shown(opened, problem, found),
    }


def try_change(opened: Opened, given: Given) -> Given:
    """Answers ``why_try``: the plan that a change gives."""
    _, problem = _case(opened, given)
    found = planned(opened, problem)
    return {**found, **_shown(opened, problem, found)}


def ask_why_not(opened: Opened, given: Given) -> Given:
    """Answers ``why_not`` with an ``action``: its price in steps, or the conflict, in ``words``."""
    from waiter_cli.explanation.explain import explain_foil
    from waiter_cli.explanation.foil_reader import read_foil

    _, problem = _case(opened, given)
    domain = opened.planner.domain
    action = read_foil(text_of(given, "action"), problem, domain)
    foil = explain_foil(problem, action, opened.planner.translator, domain, _options())
    document = foil.document()
    there = foil.best.plan.actions if foil.best.plan else ()
    own = action.text in [each.text for each in there]
    return {**document, "words": _foil_words(document, own)}


def ask_wishes(opened: Opened, given: Given) -> Given:
    """Answers ``why_wishes``: what each wish costs beside the others."""
    return {"wishes": _explanation(_asked(opened, given), opened).document()["not_sooner"]}


def list_alternatives(opened: Opened, given: Given) -> Given:
    """Answers ``why_else`` with a ``step``: what else could be done there, by the rules.

    Of several robots: what each could do while the others do what they do.
    """
    from waiter_cli.domain_execution.domain_rules import DomainRules
    from waiter_cli.encoding.declarations import words_for
    from waiter_cli.rules.actions import legal_actions
    from waiter_cli.rules.joint_steps import legal_instead
    from waiter_cli.rules.validator import run

    _, problem = _case(opened, given)
    step, plan = given.get("step"), _plan(opened, problem)
    rules, domain = opened.planner.rules, opened.planner.domain
    states = run(problem, plan, rules).states if plan is not None else (problem.state,)
    if not isinstance(step, int) or not 0 <= step < len(states):
        raise BadRequest("there is no such step")
    here = states[step]
    now = [action for action in plan.actions if action.step == step] if plan else []
    own = rules.possible(problem, here, step) if isinstance(rules, DomainRules) else None
    if own is None:
        own = (
            legal_instead(problem, here, now, step)
            if here.robots
            else legal_actions(problem, here, step)
        )
    done = {action.text for action in now}
    told = [{"text": a.text, "words": words_for(domain, a, here)} for a in own]
    return {"actions": [each for each in told if each["text"] not in done]}


def list_knowledge(opened: Opened, given: Given) -> Given:
    """Answers ``why_known`` with ``step``, ``grep``, ``positive`` and ``changed``: what is known there."""
    from waiter_cli.answersets.timeline import read_patterns
    from waiter_cli.explanation.knowledge import find_knowledge

    case, problem = _case(opened, given)
    plan = _plan(opened, problem)
    if plan is None:
        return {"literals": [], "of": 0}
    step, grep = given.get("step"), given.get("grep") or ""
    if not isinstance(step, int) or not isinstance(grep, str):
        raise BadRequest("step must be a number")
    patterns = read_patterns([grep]) if grep else ()
    knowledge = _known.get(case)
    if knowledge is None:
        knowledge = find_knowledge(problem, plan, opened.planner.domain, opened.planner.translator)
        _known.clear()
        _known[case] = knowledge
    rows = knowledge.at(step)
    kept = [
        row
        for row in rows
        if (not patterns or patterns[0].search(row["text"]))
        and not (given.get("positive") is True and row["negative"])
        and not (given.get("changed") is True and row["change"] == "same")
    ]
    return {"literals": kept, "of": len(rows)}


# -- what they share --------------------------------------------------------------------------


def _asked(opened: Opened, given: Given) -> Asked:
    enter = given.get("enter", 0)
    if not isinstance(enter, int) or not 0 <= enter <= 20:
        raise BadRequest("enter must be a number of guests")
    return Asked(text_of(given, "layout"), opened.layout.file, text_of(given, "scenario"), enter)


def _options() -> Any:
    from waiter_cli.planning.search_results import SearchOptions

    return SearchOptions(time_limit=SECONDS)


_explained: dict[Asked, Explanation] = {}
_known: dict[Case, Knowledge] = {}
"""What was found last, for the questions that follow."""


def _explanation(asked: Asked, opened: Opened) -> Explanation:
    from waiter_cli.explanation.explain import explain

    found = _explained.get(asked)
    if found is None:
        planner = opened.planner
        found = explain(posed(asked), planner.translator, planner.domain, _options())
        _explained.clear()
        _explained[asked] = found
    return found


def _case(opened: Opened, given: Given) -> tuple[Case, Problem]:
    """Returns the problem that is asked about, with one of the changes that help where it is tried."""
    asked, number = _asked(opened, given), given.get("change")
    if number is None:
        return (asked, None), posed(asked)
    helped = _explanation(asked, opened).helped
    if not isinstance(number, int) or not 0 <= number < len(helped):
        raise BadRequest("there is no such change")
    return (asked, number), helped[number].change.problem


def _plan(opened: Opened, problem: Problem) -> Plan | None:
    """Returns the plan that `planned` shows."""
    return None if problem.contradictions else answer_to(opened, problem).plan


def _shown(opened: Opened, problem: Problem, found: Given) -> Given:
    """Returns the ``room``, the ``frames`` of what happens in it, and the ``goals`` in words."""
    from waiter_cli.model.wording import goal_text
    from waiter_cli.pictures.html_page import room_document
    from waiter_cli.room.room import build_room

    room = build_room(problem.layout)
    return {
        "room": {**room_document(room), "queue": [list(place) for place in room.queue]},
        "frames": _frames(opened, problem, found),
        "goals": [goal_text(goal) for goal in problem.goals],
    }


def _frames(opened: Opened, problem: Problem, found: Given) -> list[Given]:
    """Returns who is where at each step: ``robots``, ``waiters``, ``seated``, ``led`` and ``waiting``.

    ``led`` has the party that follows each robot.
    """
    from waiter_cli.model.plan import Action, Plan
    from waiter_cli.rules.validator import run

    states: tuple[State, ...] = (problem.state,)
    if "steps" in found:
        actions = tuple(
            Action(each["step"], each["name"], tuple(map(str, each["args"])))
            for each in found["steps"]
        )
        states = run(problem, Plan(actions, found["horizon"]), opened.planner.rules).states
    return [
        {
            "robots": state.stations(),
            "waiters": dict(state.waiters),
            "seated": {table: list(party) for table, party in state.seated},
            "led": {robot: list(party) for robot, party in _led(state).items()},
            "waiting": [list(party) for party in state.waiting],
        }
        for state in states
    ]


def _led(state: State) -> dict[str, Party]:
    if not state.robots:
        return {"agent": state.with_agent}
    return {robot.name: robot.leads for robot in state.robots}


def _about(cause: Cause, problem: Problem) -> list[str]:
    """Returns the accessible names of what a cause is about."""
    if cause.kind == "goal":
        gone = [goal for goal in problem.goals if goal not in cause.drop(problem).goals]
        named: list[tuple[str | None, str]] = []
        for goal in gone:
            named += [
                (goal.table, "table"),
                (goal.node, "node"),
                (next(iter(goal.party), None), "party"),
            ]
        return [f"{kind} {name}" for name, kind in named if name]
    layout = problem.layout
    for key, where in (*problem.state_where, *layout.key_where):
        kind, _, name = key.partition(".")
        if where == cause.where and kind in _THINGS and name:
            return [f"{_THINGS[kind]} {name}"]
    for table in layout.tables:
        if table.where is not None and table.where == cause.where:
            return [f"table {table.name}"]
    edges = zip(layout.edges, layout.edge_where)
    return [f"path {a} {b}" for (a, b), where in edges if where == cause.where]


_THINGS = {"waiters": "waiter", "seated": "table", "party": "party"}


def _foil_words(foil: Given, own: bool) -> str:
    """Returns what a foil costs, in a sentence; ``own`` where the plan has it."""
    action, steps, price = foil["foil"], foil["horizon"], foil["price"]
    if foil["status"] == "undecided":
        return f"Not decided in {SECONDS:g} seconds: nothing is proved of plans with {action}."
    if steps is None:
        return "There is no plan at all."
    if price is None:
        said = foil["conflict"] or f"no plan has {action}"
        return f"{said[0].upper()}{said[1:]}."
    if own:
        return f"{action} is part of a minimal plan of {counted(steps, 'step')}."
    if price == 0:
        return f"{action} costs nothing: a minimal plan of {counted(steps, 'step')} has it."
    return f"{action} costs {price} more: {foil['foil_horizon']} steps instead of {steps}."


WHY_ACTIONS: dict[str, Callable[[Opened, Given], Given]] = {
    "why_open": open_why,
    "why_scenario": read_why_scenario,
    "why_now": write_evening,
    "why_plan": answer_why,
    "why_try": try_change,
    "why_not": ask_why_not,
    "why_wishes": ask_wishes,
    "why_else": list_alternatives,
    "why_known": list_knowledge,
}
