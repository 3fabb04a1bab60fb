"""The protocol: JSON lines ⇄ values, of requests and of answers. Entry points `read_line`, `answer`.

One object a line, with exactly one of the keys in `line_kinds.EVENTS`, and an ``id`` if wanted.  Observations
and goals have the forms of a scenario and are read by the same code.  What is wrong with a line is
a `BadLine`; nothing else can come of any bytes.
"""

from __future__ import annotations

import json
import re
from math import isfinite
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import LayoutError, Where
from waiter_cli.execution.agenda import Pending
from waiter_cli.execution.decision import Decision
from waiter_cli.files.documents import (
    action_document,
    explanation_document,
    goals_document,
    reason_document,
    wish_document,
)
from waiter_cli.files.goal_reader import read_goal, read_observations
from waiter_cli.files.names import Names
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.serve.line_kinds import ASKS, EVENTS
from waiter_cli.spelling import did_you_mean
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Document, Node, node_from_value

__all__ = [
    "BadLine",
    "LiveEvent",
    "MAX_LINE",
    "MOST_INSIDE",
    "MOST_SEEN",
    "PROTOCOL",
    "answer",
    "error_document",
    "hello",
    "pending_document",
    "read_event",
    "read_line",
    "read_wanted",
    "to_json",
]

PROTOCOL = "waiter.serve/1"
MAX_LINE = 1 << 20
"""The longest line that is read, in bytes."""
_MAX_STEP = 10**9
MOST_SEEN = 200
"""So many observations (two for each table, if that is more), or twice as many names in them, may one
line hold."""
MOST_INSIDE = 400
"""So many guests may be inside (twice as many as there are seats, if that is more), and so many
goals open, at one time."""
_MENDED = 4000
_MOST_DIGITS = 4300
_SHOWN = "<line>"
_ANY = '{"ask": "state"}'
_EACH = f"each line holds one JSON object, such as {_ANY}"
_HALF = re.compile(r"\\u[dD][89a-fA-F]")


class BadLine(Exception):
    """A line that says nothing that can be understood; ``id`` is its own, if that could be read.

    ``meant`` is the line that was probably meant.
    """

    def __init__(
        self,
        message: str,
        hint: str | None = None,
        id: object = None,
        meant: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(message)
        self.meant = meant
        self.message = message
        self.hint = hint
        self.id = id


@dataclass(frozen=True)
class LiveEvent:
    """One line, understood.  ``kind`` is one of `line_kinds.EVENTS`; ``source`` is the object it was.

    ``step`` goes with ``done``, ``failed`` and ``started``, ``seen`` with ``observe``, ``goals``
    with ``goal`` and ``drop``, ``edge`` with ``block`` and ``clear``, ``ask`` with ``ask``.  Where there
    are several robots ``steps`` has their names, and ``out`` and ``back`` name those that stop and go on.
    """

    kind: str
    source: dict[str, Any]
    id: Any = None
    step: int = -1
    steps: tuple[tuple[str, int], ...] = ()
    out: tuple[str, ...] = ()
    back: str = ""
    reason: str = ""
    seen: tuple[Observation, ...] = ()
    goals: tuple[Goal, ...] = ()
    edge: tuple[str, str] = ("", "")
    ask: str = ""


def hello(layout: Layout) -> dict[str, Any]:
    """Returns the first line that a client reads."""
    return {"hello": PROTOCOL, "layout": layout.name}


def to_json(document: dict[str, Any]) -> str:
    """Returns one line of JSON, ASCII only, without its end."""
    return json.dumps(document, allow_nan=False)


# -- reading --------------------------------------------------------------------------------


def read_line(data: bytes, layout: Layout, state: State) -> LiveEvent:
    """Returns the event that a line describes, against the names that are known; raises `BadLine`.

    Its hint shows the line that is meant, where that can be told.
    """
    try:
        found = _parse(data)
    except _NoJson as fault:
        raise _mended(fault, fault.text if len(data) <= _MENDED else None, layout, state) from None
    try:
        event = read_event(found, layout, state)
    except BadLine as fault:
        raise _mended(fault, found if len(data) <= _MENDED else None, layout, state) from None
    most = max(MOST_SEEN, 2 * len(layout.tables))
    if len(event.seen) > most or sum(len(o.arguments) for o in event.seen) > 2 * most:
        message = f"more than {most} things, or {2 * most} names, are observed at once"
        raise BadLine(message, "tell them in several lines", event.id)
    if len(event.goals) > MOST_SEEN:
        raise BadLine(f"more than {MOST_SEEN} goals in one line", "tell them one by one", event.id)
    return event


def read_event(found: object, layout: Layout, state: State) -> LiveEvent:
    """Returns the event that a parsed line describes; raises `BadLine`."""
    if not isinstance(found, dict):
        raise BadLine(
            "a line must be a JSON object", 'for example: {"observe": {"bill": "table1"}}'
        )
    given = found.get("id")
    if isinstance(given, (dict, list)):
        raise BadLine("an id must be a string or a number")
    try:
        return _event(found, given, layout, state)
    except BadLine as fault:
        fault.id = given
        raise


def _mended(fault: BadLine, found: object, layout: Layout, state: State) -> BadLine:
    """Returns the fault with the line that is meant in its hint, where that can be told."""
    from waiter_cli.serve.line_hints import meant

    def understood(line: dict[str, Any]) -> bool:
        try:
            read_event(line, layout, state)
        except BadLine:
            return False
        return True

    line = meant(found, understood)
    if line is None:
        return fault
    return BadLine(fault.message, f"write {to_json(line)}", fault.id, line)


class _NoJson(BadLine):
    """A text that is no JSON."""

    def __init__(self, message: str, hint: str, text: str) -> None:
        super().__init__(message, hint)
        self.text = text


def _parse(data: bytes) -> object:
    if len(data) > MAX_LINE:
        raise BadLine(f"the line is longer than {MAX_LINE} bytes", "send less at a time")
    if not data.strip():
        raise BadLine("the line is empty", _EACH)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        message = f"the line is not UTF-8 at byte {error.start}"
        raise BadLine(message, "write UTF-8, or ASCII with \\u escapes") from None
    try:
        found = json.loads(
            text,
            object_pairs_hook=_object,
            parse_constant=_no_constant,
            parse_int=_whole,
            parse_float=_finite,
        )
    except json.JSONDecodeError as error:
        message = f"the line is no JSON: {error.msg.lower()} at column {error.colno}"
        raise _NoJson(message, _EACH, text) from None
    except RecursionError:
        raise BadLine("the line is nested too deeply", _EACH) from None
    if _HALF.search(text):
        _must_be_whole(found)
    return found


def _must_be_whole(found: object) -> None:
    """Raises `BadLine` where a text holds half of a surrogate pair, which no file can hold."""
    todo = [found]
    while todo:
        each = todo.pop()
        if isinstance(each, str):
            if any("\ud800" <= char <= "\udfff" for char in each):
                hint = "write the character itself, or both halves of its pair"
                raise BadLine("half of a surrogate pair is no name and no text", hint)
        elif isinstance(each, dict):
            todo += [*each, *each.values()]
        elif isinstance(each, list):
            todo += each


def _whole(digits: str) -> int:
    if len(digits) > _MOST_DIGITS:
        hint = f"give a number of at most {_MOST_DIGITS} digits, or a text"
        raise BadLine("the line holds a number that is too long", hint)
    return int(digits)


def _finite(digits: str) -> float:
    value = float(digits)
    if not isfinite(value):
        shown = _short(digits)
        raise BadLine(f"the number {shown} is too large", "give a smaller number, or a text")
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) < len(pairs):
        keys: set[str] = set()
        twice = next(key for key, _ in pairs if key in keys or keys.add(key))  # type: ignore[func-returns-value]
        raise BadLine(f"the key {_short(twice)} is given twice")
    return values


def _no_constant(name: str) -> None:
    raise BadLine(f"the line is no JSON: {name} is no number", "leave it out, or give a number")


def _event(found: dict[str, Any], given: Any, layout: Layout, state: State) -> LiveEvent:
    kinds = [key for key in found if key in EVENTS]
    for key in found:
        if key not in EVENTS and key != "id" and not (key == "reason" and "failed" in found):
            raise BadLine(f"unknown key {_short(key)}", did_you_mean(key, EVENTS))
    if len(kinds) != 1:
        what = "nothing is said" if not kinds else f"{' and '.join(kinds)} in one line"
        raise BadLine(what, f"one of {', '.join(EVENTS)} a line, such as {_ANY}")
    kind = kinds[0]
    value = found[kind]
    match kind:
        case "done" | "failed" | "started" if layout.agents:
            return _read_steps(kind, found, value, given, layout)
        case "back":
            if not layout.agents:
                raise BadLine("there is one robot, which is never out", "leave the line out")
            return LiveEvent(kind, found, given, back=_robot(kind, value, layout))
        case "done" | "failed" | "started":
            if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value < _MAX_STEP:
                raise BadLine(f"{kind} takes the number of a step", 'for example: {"done": 0}')
            return LiveEvent(kind, found, given, step=value, reason=_reason(found))
        case "ask":
            if value not in ASKS or not isinstance(value, str):
                hint = did_you_mean(value, ASKS) if isinstance(value, str) else None
                raise BadLine("unknown question", hint or f"ask one of {', '.join(ASKS)}")
            return LiveEvent(kind, found, given, ask=value)
        case "observe":
            out, rest = _read_out(value, layout)
            seen = () if out and not rest else read_seen(rest, layout, state)
            return LiveEvent(kind, found, given, seen=seen, out=out)
        case "block" | "clear":
            return LiveEvent(kind, found, given, edge=_read_edge(kind, value, layout))
    return LiveEvent(kind, found, given, goals=read_wanted(value, layout, state))


def _reason(found: dict[str, Any]) -> str:
    reason = found.get("reason", "")
    if not isinstance(reason, str):
        raise BadLine("a reason must be a text")
    return reason


def _read_steps(
    kind: str, found: dict[str, Any], value: object, given: Any, layout: Layout
) -> LiveEvent:
    """Returns the event of robots that begin or end their steps; raises `BadLine`."""
    first = layout.agents[0][0]
    example = to_json({kind: {first: 0}})
    if isinstance(value, int) and not isinstance(value, bool):
        raise BadLine(f"{kind} has to say of which robot", f"for example: {example}")
    if not isinstance(value, dict) or not value:
        raise BadLine(f"{kind} takes robots and their steps", f"for example: {example}")
    if kind != "done" and len(value) > 1:
        raise BadLine(f"{kind} is told of one robot a line", f"for example: {example}")
    steps = []
    for name, step in value.items():
        if not isinstance(step, int) or isinstance(step, bool) or not 0 <= step < _MAX_STEP:
            raise BadLine(f"{kind} takes the number of a step", f"for example: {example}")
        steps.append((_robot(kind, name, layout), step))
    return LiveEvent(kind, found, given, steps=tuple(steps), reason=_reason(found))


def _robot(kind: str, value: object, layout: Layout) -> str:
    """Returns the name of a robot; raises `BadLine`."""
    names = [name for name, _ in layout.agents]
    if not isinstance(value, str):
        raise BadLine(f"{kind} takes the name of a robot", f"robots: {', '.join(names)}")
    if value not in names:
        hint = did_you_mean(value, names) or f"robots: {', '.join(names)}"
        raise BadLine(f"unknown robot {_short(value)}", hint)
    return value


def _read_out(value: object, layout: Layout) -> tuple[tuple[str, ...], object]:
    """Returns the robots that are seen to be out, and what else is observed."""
    if not layout.agents:
        return (), value
    given = value if isinstance(value, list) else [value]
    outs = [each for each in given if isinstance(each, dict) and list(each) == ["out"]]
    if not outs:
        return (), value
    names = tuple(dict.fromkeys(_robot("out", each["out"], layout) for each in outs))
    return names, [each for each in given if each not in outs]


def _read_edge(kind: str, value: object, layout: Layout) -> tuple[str, str]:
    """Returns the two nodes of a path; raises `BadLine`."""
    if not (isinstance(value, list) and len(value) == 2 and all(isinstance(n, str) for n in value)):
        raise BadLine(
            f"{kind} takes the two ends of a path", f'for example: {{"{kind}": ["n4", "n5"]}}'
        )
    known = [node.name for node in layout.nodes]
    for name in value:
        if name not in known:
            raise BadLine(f"unknown node {_short(name)}", did_you_mean(name, known))
    return value[0], value[1]


def read_seen(value: object, layout: Layout, state: State) -> tuple[Observation, ...]:
    """Observations in the forms of a scenario, one or a list; raises `BadLine`."""
    reader, node, names = _reading(value, layout, state)
    observations = read_observations(reader, node, names)
    _finish(reader)
    if not observations:
        raise BadLine("nothing is observed", 'for example: {"observe": {"bill": "table1"}}')
    return observations


def read_wanted(value: object, layout: Layout, state: State) -> tuple[Goal, ...]:
    """Returns a goal in the form of a scenario; several where it names several tables."""
    reader, node, names = _reading(value, layout, state)
    goals = read_goal(reader, node, names)
    _finish(reader)
    return tuple(goals)


def _reading(value: object, layout: Layout, state: State) -> tuple[NodeReader, Node, Names]:
    try:
        node = node_from_value(value, Where(_SHOWN, 1, 1))
    except LayoutError as error:
        raise BadLine(error.faults[0].message, error.faults[0].hint) from None
    names = Names(layout)
    names.adopt("waiter", (name for name, _ in state.waiters))
    for party in state.parties():
        names.adopt("customer", party)
    return NodeReader(Document(_SHOWN, (), node, ())), node, names


def _finish(reader: NodeReader) -> None:
    try:
        reader.finish()
    except LayoutError as error:
        message = "; ".join(fault.message for fault in error.faults)
        raise BadLine(message, error.faults[0].hint) from None


def _short(text: str) -> str:
    return text if len(text) <= 40 else text[:40] + "…"


# -- answering ------------------------------------------------------------------------------


def answer(decision: Decision) -> dict[str, Any]:
    """Returns a decision as a client is told it; only what there is to tell."""
    document: dict[str, Any] = {
        "revision": decision.revision,
        "horizon": decision.horizon,
        "minimal": decision.minimal,
        "plan": [action_document(action) for action in decision.plan],
    }
    if decision.next is not None:
        document["next"] = {robot: action_document(action) for robot, action in decision.next}
    if decision.out:
        document["out"] = list(decision.out)
    if decision.status != "plan":
        document["status"] = decision.status
    if decision.reasons:
        document["reasons"] = [reason_document(reason) for reason in decision.reasons]
    if decision.limit is not None:
        document["limit"] = decision.limit
    if decision.pending:
        document["pending"] = [pending_document(each) for each in decision.pending]
    if decision.diagnosis:
        document["diagnosis"] = [explanation_document(each) for each in decision.diagnosis]
    if decision.closed:
        document["closed"] = goals_document(decision.closed)
    if decision.abandoned is not None:
        document["abandoned"] = action_document(decision.abandoned)
    return document


def pending_document(pending: Pending) -> dict[str, Any]:
    """Returns a wish that must wait, or a pair of ``before``."""
    document = [reason_document(reason) for reason in pending.reasons]
    return wish_document(pending.goal, pending.then, document)


def error_document(
    message: str, hint: str | None = None, meant: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Returns the answer to a line that changed nothing, with the line that was meant, if known."""
    document: dict[str, Any] = {"message": message}
    if hint:
        document["hint"] = hint
    if meant is not None:
        document["meant"] = meant
    return {"error": document}
