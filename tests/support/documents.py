"""The documents of the commands that plan and act, as shapes: what ``--json`` prints, key by key."""

from __future__ import annotations

from typing import Any

from tests.support.shapes import ANY, Either, optional

__all__ = [
    "ACTION", "ANSWER_SET", "ANSWER_SETS", "CONTRADICTION", "COUNTED", "DIAGNOSIS", "DIFFERENCES", "ERROR",
    "EXPLANATION", "FAULT", "FOIL", "GOAL", "LIMIT", "NO_PLAN", "PLAN", "REASON", "REFUSED", "SERVED",
    "SIMULATED", "STATE", "UNDECIDED", "VALIDATED",
]  # fmt: skip

REASON = {
    "message": str,
    "file": optional(str),
    "line": optional(int),
    "column": optional(int),
}
FAULT = {**REASON, "hint": optional(str)}
ERROR = {"status": "error", "errors": [FAULT]}

TABLES = [str]
OF_TABLES = {ANY: Either((str, [str]))}
STATE = {
    "agent?": str,
    "agents?": {ANY: str},
    "waiters?": {ANY: str},
    "seated?": {ANY: [str]},
    "waiting?": [[str]],
    "with_agent?": Either(([str], {ANY: [str]})),
    "wants_bill?": TABLES,
    "paid?": TABLES,
    "ready_to_order?": TABLES,
    "ordered?": Either((TABLES, {ANY: str})),
    "sent?": TABLES,
    "served?": TABLES,
    "ready?": OF_TABLES,
    "carrying?": Either((OF_TABLES, {ANY: OF_TABLES})),
    "empty?": OF_TABLES,
    "chairs?": {ANY: int},
    "fluents?": [str],
}
GOAL = Either(
    (
        {"seated": Either(([str], {"party": str, "table": str}))},
        {"paid": str},
        {"at": Either((str, {ANY: str}))},
        {"ordered": str},
        {"sent": str},
        {"served": Either((str, {ANY: str}))},
        {"filled": {ANY: str}},
        {"chairs": {ANY: int}},
        {"serve": str},
        {"holds": str},
        {"holds_not": str},
    )
)
ACTION = {
    "step": int,
    "name": {
        "go_to", "pick", "seat", "give_bill", "take_order", "send_order", "take_up", "bring",
        "refill", "bring_chairs",
    },
    "args": [Either((str, int))],
    "text": str,
}  # fmt: skip
EVENT = {"step": int, "name": str, "args": [str], "text": str}
DIAGNOSIS = [{"cost": int, "events": [EVENT]}]
LIMIT = {"time", "memory", "max_steps"}

# -- plan, answersets, explain, validate --------------------------------------------------------

_PROBE = {"horizon": int, "result": {"sat", "unsat", "unknown"}, "seconds": float}
_COMMON: dict[str, Any] = {
    "layout": str,
    "bounds": [optional(int)],
    "initial_state": STATE,
    "goals": [GOAL],
    "before": [[GOAL]],
    "instant_kitchen?": True,
    "diagnosis?": DIAGNOSIS,
    "search": {
        "strategy": {"binary", "linear", "gallop", "minimize"},
        "horizons": [_PROBE],
        "seconds": float,
        "proof?": {"unsat", "bound"},
        "ties?": {"budget", "limit"},
        "fewest_actions?": {"proved", "best found", "off"},
    },
    "translator": {"native", "jar"},
    "domain": str,
    "validated": {True, False, "domain"},
}
_FILE = {"digest": str, "path?": str}
PLAN = {
    **_COMMON,
    "layout_file": _FILE,
    "domain_file": _FILE,
    "status": "plan",
    "horizon": int,
    "minimal": True,
    "actions": [ACTION],
    "agents?": [str],
    "final_state": STATE,
}
UNDECIDED = {
    **_COMMON,
    "status": "undecided",
    "limit": LIMIT,
    "minimal": False,
    "actions": [ACTION],
    "layout_file?": _FILE,
    "domain_file?": _FILE,
    "horizon?": int,
    "agents?": [str],
    "final_state?": STATE,
}
NO_PLAN = {**_COMMON, "status": "no_plan", "reasons": [REASON]}
CONTRADICTION = {**_COMMON, "status": "contradiction", "reasons": [REASON]}

ANSWER_SET = {"literals": [str], "cost": [int]}
ANSWER_SETS = {
    "satisfiable": optional(bool),
    "complete": bool,
    "answer_sets": [ANSWER_SET],
    "limit?": LIMIT,
    "reasons?": [REASON],
}
COUNTED = {"satisfiable": optional(bool), "complete": bool, "count": int, "limit?": LIMIT}
DIFFERENCES = {**ANSWER_SETS, "common": [str]}

EXPLANATION = {
    "status": {"plan", "no_plan", "contradiction", "undecided"},
    "limit?": LIMIT,
    "bounds": [optional(int)],
    "reasons": [REASON],
    "causes": [REASON],
    "conflicts": [[REASON]],
    "changes": [{**REASON, "horizon": int}],
    "not_sooner": [{"goal": str, "without": int}],
    "diagnosis": [{"cost": int, "events": [str]}],
}
FOIL = {
    "status": {"plan", "no_plan", "undecided"},
    "limit?": LIMIT,
    "foil": str,
    "horizon": optional(int),
    "foil_horizon": optional(int),
    "price": optional(int),
    "conflict": optional(str),
    "actions": [str],
}
VALIDATED = {
    "status": {"valid", "invalid"},
    "layout": str,
    "steps": int,
    "horizon": int,
    "makespan": optional(int),
    "goals": [GOAL],
    "before": [[GOAL]],
    "unmet": [GOAL],
    "reasons": [{**REASON, "step?": int}],
    "notes": [str],
    "final_state": STATE,
    "validated?": {"domain"},
}

# -- simulate, serve -----------------------------------------------------------------------------

REFUSED = {"status": "contradiction", "layout": str, "reasons": [REASON]}
SIMULATED = Either(
    (
        {
            "status": {"done", "failed", "gave_up"},
            "layout": str,
            "scenario": optional(str),
            "backend": {"pybullet", "geometric"},
            "seconds": float,
            "steps": int,
            "actions": int,
            "failed_actions": int,
            "replans": int,
            "events": int,
            "min_clearance": optional(float),
            "nearest": optional(str),
            "failed_checks": [{"check": str, "reason": str, "time": float, "step": int}],
            "goals": [GOAL],
            "final_state": STATE,
            "robots?": {
                ANY: {"actions": int, "failed_actions": int, "metres": float, "idle": float}
            },
            "figures?": {
                **dict.fromkeys(("parties", "guests", "served", "late"), int),
                **dict.fromkeys(("lost", "lost_unseated", "lost_unserved"), int),
                **{
                    f"wait_{what}_{measure}": optional(float)
                    for what in ("seat", "order", "plate", "bill")
                    for measure in ("mean", "p50", "p95")
                },
                **dict.fromkeys(("table_use", "idle", "metres"), float),
            },
            "why?": str,
            "limit?": LIMIT,
            "pending?": [
                Either(({"goal": GOAL, "reasons": [str]}, {"before": [GOAL], "reasons": [str]}))
            ],
            "recording?": str,
            "unserved": [
                {"kind": str, "text": str, "party?": [str], "table?": str, "object?": str}
            ],
            "recordings?": [str],
        },
        REFUSED,
    )
)
_WAITING = Either(({"goal": GOAL, "reasons": [REASON]}, {"before": [GOAL], "reasons": [REASON]}))
_DECISION = {
    "line": int,
    "id?": Either((str, int)),
    "revision": int,
    "horizon": int,
    "minimal": bool,
    "plan": [ACTION],
    "status?": {"no_plan", "undecided"},
    "reasons?": [REASON],
    "limit?": LIMIT,
    "pending?": [_WAITING],
    "diagnosis?": DIAGNOSIS,
    "closed?": [GOAL],
    "next?": {ANY: ACTION},
    "out?": [str],
    "abandoned?": ACTION,
    "latency_ms?": float,
}
_WHY = {
    "everybody": bool,
    "status": {"plan", "no_plan", "undecided"},
    "minimal": bool,
    "goals": [{"goal": GOAL, "reached_at": optional(int)}],
    "steps": [{"step": int, "text": str}],
    "reasons": [REASON],
    "pending": [_WAITING],
    "diagnosis": DIAGNOSIS,
}
_STATS = {
    **dict.fromkeys(
        ("lines", "errors", "steps", "revision", "searches", "deadlines", "superseded"), int
    ),
    "latency": {
        "count": int,
        **dict.fromkeys(("p50_ms?", "p95_ms?", "p99_ms?", "max_ms?"), float),
    },
}
_LINE = {"line": int, "id?": Either((str, int))}
SERVED = {
    "hello": {"hello": "waiter.serve/1", "layout": str},
    "decision": _DECISION,
    "state": {**_LINE, "state": STATE, "step": int},
    "why": {**_LINE, "why": _WHY},
    "stats": {**_LINE, "stats": _STATS},
    "error": {**_LINE, "error": {"message": str, "hint?": str, "meant?": {ANY: object}}},
    "superseded": {**_LINE, "superseded_by": int},
}
