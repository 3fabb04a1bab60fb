"""An executive's memory ⇄ JSON, so that a run can go on in another process.

Entry points: `snapshot` and `restore` for all that an executive knows, `read_decision` for a
decision as it was printed.  Parties in goals are whole again once they are read.
"""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from waiter_cli.errors import Where
from waiter_cli.execution.agenda import Agenda, Pending, whole_party
from waiter_cli.execution.belief import Belief
from waiter_cli.execution.decision import Decision
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.files.documents import (
    action_document,
    explanation_document,
    goals_document,
    order_document,
)
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Reason
from waiter_cli.model.state import Fact, Goal, Robot, State
from waiter_cli.serve.protocol import answer, read_wanted

__all__ = ["memorize", "read_decision", "remember", "restore", "snapshot"]


def snapshot(executive: Executive) -> dict[str, Any]:
    """Returns all that an executive knows, but for its layout and its planner."""
    agenda = executive.agenda
    more = {"fleet": _fleet(executive)} if isinstance(executive, FleetExecutive) else {}
    facts = [fact.text for fact in executive.belief.facts]
    return (more | {"facts": facts} if facts else more) | {
        "step": executive.step,
        "state": memorize(executive.state),
        "running": action_document(executive.running) if executive.running else None,
        "trail": [list(place) for place in executive.belief.trail],
        "shut": [list(edge) for edge in executive.shut],
        "timetable": [list(entry) for entry in executive.layout.timetable],
        "goals": goals_document(agenda.goals),
        "before": order_document(agenda.before),
        "first_held": [[goal.as_dict(), moment] for goal, moment in agenda.first_held],
        "moment": agenda.moment,
        "ages": [[goal.as_dict(), age] for goal, age in agenda.ages],
        "instant_kitchen": agenda.instant_kitchen,
        "prefer": list(executive.prefer),
        "decision": answer(executive.decision),
        "explained": [explanation_document(each) for each in executive.explained],
    }


def _fleet(executive: FleetExecutive) -> dict[str, Any]:
    """Returns what several robots are at."""
    return {
        "moving": [action_document(action) for action in executive.moving],
        "finished": [action_document(action) for action in executive.finished],
        "out": list(executive.out),
        "halted": [list(each) for each in executive.halted],
        "used": executive.used,
    }


def restore(found: dict[str, Any], executive: Executive) -> None:
    """Gives an executive the memory of another one.

    Raises ``KeyError``, ``TypeError``, ``ValueError``, `BadLine` or `LayoutError` where ``found``
    is no snapshot.
    """
    layout = executive.layout
    if "timetable" in found:  # some of it may have been put off
        timetable = tuple((str(w), int(at), str(node)) for w, at, node in found["timetable"])
        layout = replace(layout, timetable=timetable)
    shut = {(str(a), str(b)) for a, b in found.get("shut", ())}
    if shut:
        if not shut <= set(layout.edges):
            raise ValueError("unknown paths are shut")
        open_edges = tuple(edge for edge in layout.edges if edge not in shut)
        layout = replace(layout, edges=open_edges, edge_where=())
    state = remember(found["state"])
    _must_fit(state, layout)

    def goal(value: object) -> Goal:
        return _goal(value, layout, state)

    if isinstance(executive, FleetExecutive):
        _restore_fleet(found["fleet"], executive, layout)
    kitchen = bool(found["instant_kitchen"])
    executive.prefer = tuple(found["prefer"])
    executive.resume(
        Belief(
            layout,
            state,
            int(found["step"]),
            _action(found["running"]) if found["running"] else None,
            tuple((int(step), str(node)) for step, node in found["trail"]),
            kitchen,
            executive.belief.rules,
            tuple(Fact(str(text)) for text in found.get("facts", ())),
        ),
        Agenda(
            tuple(map(goal, found["goals"])),
            tuple((goal(a), goal(b)) for a, b in found["before"]),
            kitchen,
            tuple((goal(value), int(moment)) for value, moment in found["first_held"]),
            int(found["moment"]),
            tuple((goal(value), int(age)) for value, age in found["ages"]),
        ),
        read_decision(found["decision"], layout, state),
    )
    executive.explained = tuple(
        _explanation(each, executive.state) for each in found.get("explained", ())
    )


def _restore_fleet(found: dict[str, Any], executive: FleetExecutive, layout: Layout) -> None:
    names = {name for name, _ in layout.agents}
    out = tuple(str(name) for name in found["out"])
    halted = tuple((str(name), str(node)) for name, node in found["halted"])
    if not names.issuperset((*out, *(name for name, _ in halted))):
        raise ValueError("unknown robots are out")
    moving, finished = (tuple(map(_action, found[key])) for key in ("moving", "finished"))
    executive.resume_fleet(moving, finished, out, halted, int(found["used"]))


def read_decision(found: dict[str, Any], layout: Layout, state: State) -> Decision:
    """Returns a decision from the answer that told of it, diagnosis left out."""
    abandoned = found.get("abandoned")
    return Decision(
        revision=int(found["revision"]),
        plan=tuple(_action(each) for each in found["plan"]),
        horizon=int(found["horizon"]),
        minimal=bool(found["minimal"]),
        status=str(found.get("status", "plan")),
        reasons=_reasons(found.get("reasons", ())),
        limit=found.get("limit"),
        pending=tuple(_pending(each, layout, state) for each in found.get("pending", ())),
        abandoned=_action(abandoned) if abandoned else None,
    )


def memorize(state: State) -> dict[str, Any]:
    """Returns a state, exactly.

    What a scenario says is shorter and leaves some things to be inferred.

    >>> memorize(State("n1", paid=frozenset({"t2", "t1"})))
    {'agent': 'n1', 'paid': ['t1', 't2']}
    """
    document: dict[str, Any] = {}
    for field in fields(state):
        value = getattr(state, field.name)
        if value:
            document[field.name] = sorted(value) if isinstance(value, frozenset) else value
    if state.robots:
        document["robots"] = [_robot_document(robot) for robot in state.robots]
    # Tuples become lists in JSON; so they are here, that both compare equal.
    return {key: _lists(value) for key, value in document.items()}


def remember(found: dict[str, Any]) -> State:
    """Returns the state that was memorized."""
    values: dict[str, Any] = {} if "agent" in found or not found.get("robots") else {"agent": ""}
    for field in fields(State):
        if field.name in found:
            if field.name == "robots":
                values["robots"] = tuple(map(_robot, found["robots"]))
                continue
            value = _tuples(found[field.name])
            is_set = str(field.type).startswith("frozenset")
            values[field.name] = frozenset(value) if is_set else value
    return State(**values)


def _robot_document(robot: Robot) -> dict[str, Any]:
    return {
        "name": robot.name,
        "at": robot.at,
        "leads": list(robot.leads),
        "carries": list(robot.carries) if robot.carries else None,
        "orders": sorted(robot.orders),
    }


def _robot(found: dict[str, Any]) -> Robot:
    table, item = found["carries"] or ("", "")
    return Robot(
        str(found["name"]), str(found["at"]), tuple(map(str, found["leads"])),
        (str(table), str(item)) if item else None, frozenset(map(str, found["orders"])),
    )  # fmt: skip


def _must_fit(state: State, layout: Layout) -> None:
    """Raises ``ValueError`` where a state speaks of what the restaurant does not have."""
    nodes = {node.name for node in layout.nodes}
    tables = {table.name for table in layout.tables}
    kinds = (state.wants_bill, state.paid, state.ready_to_order, state.ordered, state.sent)
    named = [name for kind in (*kinds, state.served) for name in kind]
    named += [table for table, _ in (*state.seated, *state.ready, *state.empty, *state.chairs)]
    named += [table for table, _ in state.carried()]
    named += [table for robot in state.robots for table in robot.orders]
    if [robot.name for robot in state.robots] != [name for name, _ in layout.agents]:
        raise ValueError("the robots are others")
    for name in (*state.stations().values(), *(node for _, node in state.waiters)):
        if name not in nodes:
            raise ValueError(f"unknown node {name}")
    for name in named:
        if name not in tables:
            raise ValueError(f"unknown table {name}")
    parties = state.parties()
    if not all(isinstance(name, str) for party in parties for name in party) or str in map(
        type, parties
    ):
        raise ValueError("customers have names")
    if not all(isinstance(count, int) for _, count in state.chairs):
        raise ValueError("chairs are counted")


def _explanation(found: dict[str, Any], state: State) -> Diagnosis:
    """Returns an explanation as it was told; what was believed after it is no longer known."""
    events = tuple(
        (int(each["step"]), str(each["name"]), tuple(map(str, each["args"])))
        for each in found["events"]
    )
    texts = tuple(str(each["text"]) for each in found["events"])
    return Diagnosis(events, texts, int(found["cost"]), state)


def _lists(value: Any) -> Any:
    return [_lists(each) for each in value] if isinstance(value, (list, tuple)) else value


def _tuples(value: Any) -> Any:
    return tuple(_tuples(each) for each in value) if isinstance(value, list) else value


def _goal(value: object, layout: Layout, state: State) -> Goal:
    (goal,) = read_wanted(value, layout, state)
    return replace(whole_party(goal, state) or goal, where=None)


def _action(found: dict[str, Any]) -> Action:
    return Action(int(found["step"]), str(found["name"]), tuple(map(str, found["args"])))


def _reasons(found: Any) -> tuple[Reason, ...]:
    reasons = []
    for each in found:
        where = (
            Where(each["file"], each["line"] or 0, each["column"] or 0) if each["file"] else None
        )
        reasons.append(Reason(str(each["message"]), where))
    return tuple(reasons)


def _pending(found: dict[str, Any], layout: Layout, state: State) -> Pending:
    reasons = _reasons(found["reasons"])
    if "before" in found:
        first, then = found["before"]
        return Pending(_goal(first, layout, state), reasons, _goal(then, layout, state))
    return Pending(_goal(found["goal"], layout, state), reasons)
