"""Events of a run → sentences: the list that a page shows. Entry points `tell_all`, `event_by_whom`.

>>> event_in_words({"type": "bill", "table": "table1"})
'table1 gets its bill'
>>> event_in_words({"type": "end", "status": "done", "failed_checks": 0, "min_clearance": 0.15})
'the end: goals reached; never closer than 0.15 m to anything'
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from waiter_cli.model.state import Observation
from waiter_cli.model.wording import in_words
from waiter_cli.pictures.snapshot import meaning
from waiter_cli.simulation.outcome import sentence

__all__ = ["event_by_whom", "event_in_words", "tell_all"]

_BAD = ("collision", "action_failed", "precondition_failed", "blocked", "clearance_low")

_DEEDS = {
    "bill": "{table} gets its bill",
    "ordered": "{table} has ordered",
    "sent": "the order of {table} is sent",
    "taken_up": "takes up the {object} for {table}",
    "brought": "brings {table} the {object}",
    "refilled": "fills the {object} of {table}",
    "chairs": "{table} has {number} chairs now",
    "acted": "{text}",
    "unblocked": "{edge} is free again",
    "clearance_low": "only {clearance:.2f} m to {other}",
    "collision": "runs into {other}",
}
_ANSWERS = {
    "reroute": "going round it",
    "replan": "planning anew",
    "wait": "waiting",
    "stop": "stopping",
}
_ENDS = {"done": "goals reached", "failed": "failed", "gave_up": "gave up"}


def tell_all(events: Iterable[dict[str, Any]]) -> list[list[Any]]:
    """Returns for each event that is listed its time, its words, and 1 for bad news, else 0."""
    rows: list[list[Any]] = []
    for event in events:
        words = event_by_whom(event)
        if words is None:
            continue
        if event["type"] == "replan" and rows and event["reason"] in rows[-1][1]:
            words = words.removesuffix(f": {event['reason']}")  # it was said just now
        rows.append([event["t"], words, int(event["type"] in _BAD)])
    return rows


def event_by_whom(event: dict[str, Any]) -> str | None:
    """Returns an event in words, with the name of the robot where there are several."""
    words, name = event_in_words(event), event.get("robot", {}).get("name")
    return words if words is None or name is None else f"{name}: {words}"


def event_in_words(event: dict[str, Any]) -> str | None:
    """Returns an event in words; None for one that another event implies."""
    match event["type"]:
        case "start" | "action_start" | "action_end" | "left":
            return None
        case "observed" | "injected":
            return _happening(event)
        case "arrived":
            passing = "passes {} on the way round" if event.get("detour") else "arrives at {}"
            return passing.format(event["node"])
        case "picked":
            return f"{_party(event)} follow{_s(event)}"
        case "seated":
            return f"{_party(event)} sit{_s(event)} down at {event['table']}"
        case "blocked":
            return f"{event['edge']} is blocked: {_ANSWERS[event['answer']]}"
        case "precondition_failed":
            return f"cannot {_deed(event)}: {event['reason']}"
        case "action_failed":
            return f"fails to {_deed(event)}: {event['reason']}"
        case "replan":
            return _plan(event)
        case "end":
            return _end(event)
    return _DEEDS[event["type"]].format(**event)


def _happening(event: dict[str, Any]) -> str:
    kind = event["kind"]
    if kind == "slip":
        return f"slips: {_deed(event)}"
    if kind in ("out", "back"):
        lasting = f" for {event['seconds']:g} s" if "seconds" in event else ""
        return f"stops{lasting}" if kind == "out" else "is back"
    if kind == "stall":
        return f"stands still for {event['seconds']:g} s"
    if kind == "block":
        lasting = f" for {event['seconds']:g} s" if "seconds" in event else ""
        return f"somebody stands on {event['edge']}{lasting}"
    if "party" in event:
        said = f"{_party(event)} {'come' if kind == 'enter' else 'leave'}{_s(event)}"
        said += " in" if kind == "enter" else ""
    else:
        keys = ("who", "table", "node", "object", "what")
        said = sentence(Observation(kind, tuple(event[key] for key in keys if key in event)))
    if "ignored" in event:
        return f"{said}: ignored, {event['ignored']}"
    return f"{said}; the plan stands" if event.get("answer") == "the plan stands" else said


def _deed(event: dict[str, Any]) -> str:
    return event.get("text") or meaning(event["action"], event["robot"]["node"])


def _plan(event: dict[str, Any]) -> str:
    found = {"no_plan": "there is no plan", "undecided": "no plan is known to be shortest"}
    what = found.get(event["status"], "plans anew")
    return f"{what}: {event['reason']}" if event["reason"] else what


def _end(event: dict[str, Any]) -> str:
    how, why = _ENDS[event["status"]], event.get("why", "")
    said = [why if why.startswith(how) else f"{how}: {why}" if why else how]
    if event["failed_checks"]:
        said.append(f"{event['failed_checks']} failed checks")
    gap = event["min_clearance"]
    if gap is not None:
        near = f"never closer than {gap:.2f} m to anything"
        said.append(near if gap >= 0 else "something was touched")
    return f"the end: {'; '.join(said)}"


def _party(event: dict[str, Any]) -> str:
    return in_words(event["party"])


def _s(event: dict[str, Any]) -> str:
    return "s" if len(event["party"]) == 1 else ""
