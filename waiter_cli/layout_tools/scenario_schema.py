"""The JSON Schema of scenario files, for editors. Entry point `scenario_schema`.

Keys, limits and names are those of the readers.
"""

from __future__ import annotations

from waiter_cli.files.goal_reader import GOALS, OBSERVATIONS
from waiter_cli.files.guests_reader import GUEST_KEYS, MOST_MINUTES
from waiter_cli.files.layout_reader import MAX_SEATS
from waiter_cli.files.scenario_reader import KEYS, PREFERENCES
from waiter_cli.files.state_reader import STATE_KEYS
from waiter_cli.layout_tools.schema_parts import (
    Schema,
    described,
    document,
    list_of,
    map_of,
    object_of,
    one_or_more,
    ref,
    whole,
)
from waiter_cli.model.layout import OBJECTS, REFILLABLES

__all__ = ["scenario_schema"]

_NAME, _PARTY, _TERM = ref("name"), ref("party"), ref("term")
_PLACES = map_of(_NAME, _NAME)
_TABLES = list_of(_NAME)
_CHAIRS = map_of(_NAME, whole(0, MAX_SEATS, "A number of chairs."))
_REFILLS = map_of(_NAME, one_or_more({"enum": list(REFILLABLES)}))
_THINGS = described(map_of(_NAME, one_or_more({"enum": list(OBJECTS)})), "A table and its objects.")


def scenario_schema() -> Schema:
    """Returns the schema of scenario files."""
    goal = ref("goal")
    pair = {"type": "array", "items": goal, "minItems": 2, "maxItems": 2}
    properties: dict[str, Schema] = {
        "name": {"description": "What the scenario is called.", "type": ["string", "number"]},
        "layout": {
            "description": "Its layout: a built-in name, or a path from this file.",
            "type": ["string", "null"],
        },
        "state": described(_state(), "What holds already."),
        "observe": described(
            one_or_more(ref("observation")), "What has just been seen, all at step 0."
        ),
        "goals": {
            "description": "What is wanted, all of it; left out: everybody is served.",
            "oneOf": [goal, {"type": "array", "items": goal}, {"type": "null"}],
        },
        "before": {
            "description": "Pairs of goals: the first is reached before the second.",
            "type": "array",
            "items": pair,
        },
        "prefer": described(
            list_of({"enum": list(PREFERENCES)}),
            "How ties among minimal plans are settled, in this order.",
        ),
        "events": {
            "description": "What happens later, for simulate.",
            "type": "array",
            "items": _event(),
        },
        "instant_kitchen": {
            "description": "Whether what was ordered is ready at once.",
            "type": "boolean",
        },
        "guests": described(_guests(), "Guests who come by chance, for simulate."),
        "minutes": {
            "description": "How long guests come.",
            "type": "number",
            "minimum": 0,
            "maximum": MOST_MINUTES,
        },
        "facts": described(
            {"type": "array", "items": {"type": "string"}},
            "Facts in SPARC, for a domain of one's own.",
        ),
    }
    schema = document("A situation", "scenario.schema.json", object_of(properties, KEYS))
    schema["$defs"] |= {
        "term": {"description": "A term of SPARC: isdirty(table1).", "type": "string"},
        "party": {
            "description": "The customers of one party: a list, or one name.",
            "oneOf": [{"type": "array", "items": _NAME, "uniqueItems": True}, _NAME],
        },
        "observation": object_of(_seen(), OBSERVATIONS) | {"minProperties": 1},
        "goal": object_of(_wishes(), GOALS) | {"minProperties": 1, "maxProperties": 1},
    }
    return schema


def _state() -> Schema:
    """Returns the schema of what holds already."""
    sets = ("wants_bill", "paid", "ready_to_order", "ordered", "sent", "served")
    return object_of(
        {
            "agent": described(_NAME, "The node the robot stands on."),
            "agents": described(_PLACES, "The nodes that several robots stand on."),
            "waiters": described(_PLACES, "The nodes other waiters stand on."),
            "seated": described(map_of(_NAME, _PARTY), "Who sits at which table."),
            "waiting": {
                "description": "Parties at the entrance, in the order in which they came.",
                "type": "array",
                "items": {"type": "array", "items": _NAME, "minItems": 1},
            },
            "with_agent": {
                "description": "The party that follows the robot, or each of several robots.",
                "oneOf": [_PARTY, map_of(_NAME, _PARTY)],
            },
            **dict.fromkeys(sets, _TABLES),
            "ordered": {
                "description": "Tables whose order was taken, and by which of several robots.",
                "oneOf": [_TABLES, _PLACES],
            },
            "ready": _THINGS,
            "carrying": {
                "description": "What the robot carries, or each of several robots.",
                "oneOf": [_THINGS, map_of(_NAME, _THINGS)],
            },
            "empty": _REFILLS,
            "chairs": _CHAIRS,
            "fluents": described(list_of(_TERM), "Inertial fluents of the domain's own."),
        },
        STATE_KEYS,
    )


def _seen() -> dict[str, Schema]:
    """Returns the schemas of what can be observed, by key."""
    return {
        "enter": described(_PARTY, "One party comes in."),
        "leave": described(_PARTY, "A party leaves; one of its members is enough."),
        "bill": described(_NAME, "A table wants its bill."),
        "at": described(
            map_of({"anyOf": [_NAME, {"const": "agent"}]}, _NAME) | {"minProperties": 1},
            "An employee was seen on a node.",
        ),
        "order": described(_NAME, "A table is ready to order."),
        "ready": _THINGS,
        "empty": _REFILLS,
        "free": described(_NAME, "A table was seen to be free."),
        "obs": described(_TERM, "An observable of the domain's own was seen."),
    }


def _event() -> Schema:
    """Returns the schema of an observation that comes later."""
    time: Schema = {"description": "Simulated seconds.", "type": "number", "minimum": 0}
    event = object_of({"time": time, **_seen()}, ("time", *OBSERVATIONS), required=("time",))
    return event | {"minProperties": 2}


def _wishes() -> dict[str, Schema]:
    """Returns the schemas of what can be wanted, by key."""
    return {
        "seated": {
            "description": "A party sits, at any table or at the one that is named.",
            "oneOf": [
                _PARTY,
                object_of(
                    {"party": _PARTY, "table": _NAME}, ("party", "table"), required=("party",)
                ),
            ],
        },
        "paid": described(_NAME, "A table, or the table of a customer, has paid."),
        "at": {
            "description": "The robot stands on a node; or that one of several robots.",
            "oneOf": [_NAME, _PLACES | {"minProperties": 1}],
        },
        "ordered": described(_NAME, "The order of a table was taken."),
        "sent": described(_NAME, "The order of a table was sent."),
        "served": {"oneOf": [_NAME, _THINGS]},
        "filled": _REFILLS,
        "chairs": _CHAIRS,
        "serve": described(_PARTY, "A party's whole visit."),
        "holds": described(_TERM, "A fluent of the domain holds."),
        "holds_not": described(_TERM, "A fluent of the domain does not hold."),
    }


def _guests() -> Schema:
    """Returns the schema of the key ``guests``."""
    minutes: Schema = {"type": "number", "minimum": 0, "maximum": MOST_MINUTES}
    pair = {"type": "array", "items": minutes, "minItems": 2, "maxItems": 2}
    span: Schema = {
        "oneOf": [
            minutes,
            pair,
            object_of({"mean": minutes, "sd": minutes}, ("mean", "sd"), ("mean",)),
        ]
    }
    arrival = {
        "type": "array",
        "prefixItems": [minutes, {"type": "integer", "minimum": 1}],
        "minItems": 2,
        "maxItems": 2,
    }
    rate: Schema = {"type": "number", "minimum": 0}
    arrivals = {
        "per_hour": described(rate, "Parties an hour, by chance."),
        "at": {"description": "Minutes and heads.", "type": "array", "items": arrival},
    }
    properties: dict[str, Schema] = {
        "arrivals": object_of(arrivals, ("per_hour", "at"))
        | {"minProperties": 1, "maxProperties": 1},
        "sizes": {
            "description": "The share of parties by heads.",
            "type": "object",
            "patternProperties": {"^[0-9]+$": rate},
            "additionalProperties": False,
        },
        "order_after": described(span, "Minutes until a party that sits is ready to order."),
        "cook": described(span, "Minutes that the kitchen takes for an order."),
        "eat": described(span, "Minutes that a party eats."),
        "refills": described(rate, "How often an hour a guest empties the jug."),
        "bill_after": described(span, "Minutes until a party that has eaten wants its bill."),
        "patience": described(minutes, "Minutes after which a party without a table leaves."),
        "patience_served": described(
            minutes, "Minutes after which a party that waits for its plate leaves."
        ),
    }
    return object_of(properties, GUEST_KEYS, ("arrivals",))
