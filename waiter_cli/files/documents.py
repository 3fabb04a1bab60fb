"""States, goals, actions, reasons and faults → JSON objects, in the shapes of every command.

Each function ``…_document`` makes one shape; `state_document` makes that of a scenario's ``state``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from waiter_cli.errors import Fault, Where
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Observation, State

if TYPE_CHECKING:
    from waiter_cli.rules.rulebook import Rulebook
    from waiter_cli.rules.validator import Verdict

__all__ = [
    "action_document",
    "advice_document",
    "converted_document",
    "drawing_document",
    "explanation_document",
    "fault_document",
    "goals_document",
    "message_document",
    "observation_document",
    "order_document",
    "place_document",
    "reason_document",
    "state_document",
    "verdict_document",
    "verdict_reasons",
    "wish_document",
]


def state_document(state: State, layout: Layout) -> dict[str, Any]:
    """Returns every key that holds, so that a scenario can start from it.

    ``agent`` is always there, ``waiters`` where there are any; tables come in the order of the
    layout.  ``ordered`` lists tables whose order was taken, sent ones too.  An object stands by
    itself where a table has one (``{"table1": "jug"}``), in a list where it has several.
    ``chairs`` is there where some table has fewer than its capacity, or other than the layout says.
    """
    tables = [table.name for table in layout.tables]

    def by_table(names: Iterable[str]) -> list[str]:
        found = set(names)
        return [table for table in tables if table in found]

    def by_object(pairs: Iterable[tuple[str, str]]) -> dict[str, Any]:
        out: dict[str, list[str]] = {}
        for table, item in sorted(pairs, key=lambda pair: (tables.index(pair[0]), pair[1])):
            out.setdefault(table, []).append(item)
        return {table: items[0] if len(items) == 1 else items for table, items in out.items()}

    seated = dict(state.seated)
    chairs = dict(state.chairs)
    own_chairs = any(
        chairs[t.name] != t.chairs or chairs[t.name] < t.capacity for t in layout.tables
    )
    robots = {
        "agents": {robot.name: robot.at for robot in state.robots},
        "with_agent": {robot.name: list(robot.leads) for robot in state.robots if robot.leads},
        "ordered": {t: r.name for t in tables for r in state.robots if t in r.orders},
        "carrying": {r.name: by_object([r.carries]) for r in state.robots if r.carries},
    }
    document: dict[str, Any] = {
        "agent": state.agent,
        "agents": {},
        "waiters": dict(state.waiters),
        "seated": {table: list(seated[table]) for table in by_table(seated)},
        "waiting": [list(party) for party in state.waiting],
        "with_agent": list(state.with_agent),
        "wants_bill": by_table(state.wants_bill),
        "paid": by_table(state.paid),
        "ready_to_order": by_table(state.ready_to_order),
        "ordered": by_table(state.ordered | state.sent),
        "sent": by_table(state.sent),
        "served": by_table(state.served),
        "ready": by_object(state.ready),
        "carrying": by_object([state.carrying] if state.carrying else []),
        "empty": by_object(state.empty),
        "chairs": {table: chairs[table] for table in tables} if own_chairs else {},
        "fluents": list(state.fluents),
    }
    document |= robots if state.robots else {}
    return {key: value for key, value in document.items() if value}


def place_document(where: Where | None) -> dict[str, Any]:
    """Returns the keys ``file``, ``line`` and ``column`` of a place.

    Each is None where there is none.
    """
    return {
        "file": where.name if where else None,
        "line": (where.line or None) if where else None,
        "column": (where.column or None) if where else None,
    }


def message_document(message: str, where: Where | None) -> dict[str, Any]:
    """Returns a sentence and the place that it speaks of."""
    return {"message": message, **place_document(where)}


def fault_document(fault: Fault) -> dict[str, Any]:
    """Returns a fault in the shape of the contract's JSON errors."""
    return {**message_document(fault.message, fault.where), "hint": fault.hint}


def advice_document(layout: Layout, advice: Iterable[tuple[str, Fault]]) -> dict[str, Any]:
    """Returns the figures of a layout, and what is to be said about it, by kinds."""
    document = [{"kind": kind, **fault_document(fault)} for kind, fault in advice]
    return {
        "status": "advice" if document else "ok",
        "layout": layout.name,
        "file": layout.file,
        "nodes": len(layout.nodes),
        "edges": len(layout.edges),
        "tables": len(layout.tables),
        "seats": sum(table.capacity for table in layout.tables),
        "advice": document,
    }


def converted_document(
    name: str, file: str | None, text: str, remarks: Iterable[Fault]
) -> dict[str, Any]:
    """Returns a layout that was made of something else, and what is to be said about it."""
    faults = [fault_document(each) for each in remarks]
    return {"status": "converted", "layout": name, "file": file, "text": text, "remarks": faults}


def drawing_document(
    layout: Layout, files: Iterable[str], text: str | None, note: str
) -> dict[str, Any]:
    """Returns where a layout was drawn to, or the drawing itself in ``text``."""
    return {
        "status": "drawn",
        "layout": layout.name,
        "files": list(files),
        "text": text,
        "note": note or None,
    }


def verdict_document(
    problem: Problem, plan: Plan, verdict: Verdict, rules: Rulebook | None = None
) -> dict[str, Any]:
    """Returns what the rules say about a plan."""
    from waiter_cli.rules.rulebook import HOUSE

    holds = (rules or HOUSE).holds
    by_domain = {} if rules is None or rules is HOUSE else {"validated": "domain"}
    reasons = verdict_reasons(problem, verdict)
    final = verdict.final_state
    return {
        "status": "invalid" if reasons else "valid",
        "layout": problem.layout.name,
        "steps": len(verdict.states) - 1,
        "horizon": plan.horizon,
        "makespan": verdict.makespan,
        "goals": goals_document(problem.goals),
        "before": order_document(problem.before),
        "unmet": goals_document(goal for goal in problem.goals if not holds(goal, final, problem)),
        "reasons": reasons,
        "notes": list(verdict.notes),
        "final_state": state_document(final, problem.layout),
        **by_domain,
    }


def verdict_reasons(problem: Problem, verdict: Verdict) -> list[dict[str, Any]]:
    """Returns the reasons why a plan is invalid; ``step`` where there is one."""
    out = [message_document(each.message, each.where) for each in problem.contradictions]
    step = {} if verdict.misstep is None else {"step": verdict.misstep.step}
    return out + [{**message_document(message, None), **step} for message in verdict.reasons]


def observation_document(seen: Observation) -> dict[str, Any]:
    """Returns an observation in the shape that scenarios have.

    >>> observation_document(Observation("ready", ("table1", "plate")))
    {'ready': {'table1': 'plate'}}
    """
    first, *rest = seen.arguments
    if seen.kind == "enter":
        return {"enter": list(seen.arguments)}
    if seen.kind == "leave":
        return {"leave": [first]}
    return {seen.kind: {first: rest[0]} if rest else first}


def goals_document(goals: Iterable[Goal]) -> list[dict[str, Any]]:
    """Goals in the shape that scenarios have."""
    return [goal.as_dict() for goal in goals]


def order_document(before: Iterable[tuple[Goal, Goal]]) -> list[list[dict[str, Any]]]:
    """Returns pairs of goals, the first of each to be reached before the second."""
    return [goals_document(pair) for pair in before]


def wish_document(goal: Goal, then: Goal | None, reasons: list[Any]) -> dict[str, Any]:
    """Returns a goal that must wait, or a pair of ``before`` that must, and why."""
    if then is not None:
        return {"before": goals_document((goal, then)), "reasons": reasons}
    return {"goal": goal.as_dict(), "reasons": reasons}


def action_document(action: Action) -> dict[str, Any]:
    """Returns an action in the shape that plans have everywhere."""
    args = [int(name) if name.isdigit() else name for name in action.arguments]
    return {"step": action.step, "name": action.name, "args": args, "text": action.text}


def reason_document(reason: Reason) -> dict[str, Any]:
    """Returns a reason, and where in the user's files it lies: a line that was heard is no file."""
    where = reason.where
    heard = where is not None and where.name.startswith("<")
    return message_document(reason.message, None if heard else where)


def explanation_document(explanation: Diagnosis) -> dict[str, Any]:
    """Returns an explanation: events in their order, each in words too."""
    events = zip(explanation.events, explanation.text, strict=True)
    return {
        "cost": explanation.cost,
        "events": [
            {"step": step, "name": name, "args": list(arguments), "text": text}
            for (step, name, arguments), text in events
        ],
    }
