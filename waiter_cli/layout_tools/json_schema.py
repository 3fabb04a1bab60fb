"""JSON Schemas of layout and scenario files, for editors. Entry points `layout_schema`, `scenario_schema`.

A schema says what a file may look like: keys, kinds of values, forms of names.  What needs the
whole file (does that node exist, is a name given twice) is for ``waiter layout check``.  Draft
2020-12; keys, limits and names are those of the readers.
"""

from __future__ import annotations

from typing import Any

from waiter_cli.files.goal_reader import GOALS, OBSERVATIONS
from waiter_cli.files.guests_reader import GUEST_KEYS, MOST_MINUTES
from waiter_cli.files.layout_reader import (
    EDGE_KEYS,
    KEYS,
    MAX_CUSTOMERS,
    MAX_SEATS,
    TABLE_KEYS,
)
from waiter_cli.files.scenario_reader import KEYS as SCENARIO_KEYS
from waiter_cli.files.scenario_reader import PREFERENCES
from waiter_cli.files.state_reader import STATE_KEYS
from waiter_cli.model.layout import OBJECTS, REFILLABLES
from waiter_cli.yaml_reading.node_reader import RESERVED

__all__ = ["MODELINE", "layout_schema", "scenario_schema"]

DRAFT = "https://json-schema.org/draft/2020-12/schema"
MODELINE = "# yaml-language-server: $schema="
"""The first line of a YAML file whose editor is to check it, without the path of the schema."""

Schema = dict[str, Any]


def layout_schema() -> Schema:
    """Returns the schema of layout files."""
    point = _ref("point")
    names = _list_of(_ref("name"))
    table = _object(
        {
            "capacity": _whole(1, MAX_SEATS, "How many guests it has room for."),
            "nodes": _described(names | {"minItems": 1}, "The nodes it is served from."),
            "at": _described(point, "Its centre in metres; beside its first node unless told."),
            "size": {
                "description": "Its size in metres, along x and y; 0.8 by 0.8 unless told.",
                "type": "array",
                "items": {"type": "number", "exclusiveMinimum": 0},
                "minItems": 2,
                "maxItems": 2,
            },
            "chairs": _whole(
                0, MAX_SEATS, "How many chairs stand there; its capacity unless told."
            ),
        },
        TABLE_KEYS,
        required=("capacity", "nodes"),
    )
    bar_nodes = _described(names | {"minItems": 1}, "Where orders are sent and jugs are filled.")
    bar = _object(
        {
            "nodes": bar_nodes,
            "from": _described(point, "One corner of the counter, in metres."),
            "to": _described(point, "The opposite corner."),
        },
        ("nodes", "from", "to"),
        required=("nodes",),
    ) | {"dependentRequired": {"from": ["to"], "to": ["from"]}}
    pair = {
        "type": "array",
        "items": _ref("name"),
        "minItems": 2,
        "maxItems": 2,
        "uniqueItems": True,
    }
    one_way = _object(
        {
            "from": _described(_ref("name"), "The node that a one-way path begins at."),
            "to": _described(_ref("name"), "The node that it leads to."),
        },
        EDGE_KEYS,
        required=EDGE_KEYS,
    )
    properties: dict[str, Schema] = {
        "name": {"description": "What the restaurant is called.", "type": ["string", "number"]},
        "nodes": {
            "description": "Places the robot can stand: a place in metres for each, or names only.",
            "oneOf": [
                _map_of(_ref("name"), point) | {"minProperties": 1},
                {"type": "array", "items": _ref("name"), "minItems": 1, "uniqueItems": True},
            ],
        },
        "edges": {
            "description": "Paths between nodes: pairs lead both ways, from and to one way only.",
            "type": "array",
            "items": {"oneOf": [pair, one_way]},
        },
        "entrance": _described(_ref("name"), "The node where arriving parties are picked up."),
        "tables": _described(_map_of(_ref("name"), table), "The tables by name."),
        "agent": _described(_ref("name"), "The node where the robot starts."),
        "agents": _described(
            _map_of(_ref("name"), _ref("name")) | {"minProperties": 1},
            "Several robots and the nodes where they start, in place of agent.",
        ),
        "waiters": _described(
            _map_of(_ref("name"), _ref("name")), "Other waiters and the nodes they stand on."
        ),
        "bar": {
            "description": "Where orders are sent and jugs and baskets are filled.",
            "oneOf": [bar_nodes, bar, {"type": "null"}],
        },
        "objects": _described(_list_of({"enum": list(OBJECTS)}), "What is carried; needs a bar."),
        "timetable": _described(
            _map_of(_ref("name"), _map_of({"pattern": "^[0-9]+$"}, _ref("name"))),
            "Where waiters will stand from which step on: {w1: {3: n4}}.",
        ),
        "walls": {
            "description": "Line segments in metres, drawn and simulated, never reasoned about.",
            "type": "array",
            "items": {"type": "array", "items": point, "minItems": 2, "maxItems": 2},
        },
        "customers": _whole(0, MAX_CUSTOMERS, "How many customer names c1, c2, … are known."),
    }
    required = ("nodes", "edges", "entrance", "tables")
    either = {"oneOf": [{"required": ["agent"]}, {"required": ["agents"]}]}
    return _document(
        "A restaurant", "layout.schema.json", _object(properties, KEYS, required=required) | either
    )


def scenario_schema() -> Schema:
    """Returns the schema of scenario files."""
    name, party, term = _ref("name"), _ref("party"), _ref("term")
    tables = _list_of(name)
    things = _described(
        _map_of(name, _one_or_more({"enum": list(OBJECTS)})), "A table and its objects."
    )
    refills = _map_of(name, _one_or_more({"enum": list(REFILLABLES)}))
    places = _map_of(name, name)
    seen_at = _map_of({"anyOf": [name, {"const": "agent"}]}, name) | {"minProperties": 1}
    numbers = _map_of(name, _whole(0, MAX_SEATS, "A number of chairs."))
    sets = ("wants_bill", "paid", "ready_to_order", "ordered", "sent", "served")
    state = _object(
        {
            "agent": _described(name, "The node the robot stands on."),
            "agents": _described(places, "The nodes that several robots stand on."),
            "waiters": _described(places, "The nodes other waiters stand on."),
            "seated": _described(_map_of(name, party), "Who sits at which table."),
            "waiting": {
                "description": "Parties at the entrance, in the order in which they came.",
                "type": "array",
                "items": {"type": "array", "items": name, "minItems": 1},
            },
            "with_agent": {
                "description": "The party that follows the robot, or each of several robots.",
                "oneOf": [party, _map_of(name, party)],
            },
            **dict.fromkeys(sets, tables),
            "ordered": {
                "description": "Tables whose order was taken, and by which of several robots.",
                "oneOf": [tables, places],
            },
            "ready": things,
            "carrying": {
                "description": "What the robot carries, or each of several robots.",
                "oneOf": [things, _map_of(name, things)],
            },
            "empty": refills,
            "chairs": numbers,
            "fluents": _described(_list_of(term), "Inertial fluents of the domain's own."),
        },
        STATE_KEYS,
    )
    seen = {
        "enter": _described(party, "One party comes in."),
        "leave": _described(party, "A party leaves; one of its members is enough."),
        "bill": _described(name, "A table wants its bill."),
        "at": _described(seen_at, "An employee was seen on a node."),
        "order": _described(name, "A table is ready to order."),
        "ready": things,
        "empty": refills,
        "free": _described(name, "A table was seen to be free."),
        "obs": _described(term, "An observable of the domain's own was seen."),
    }
    wishes = {
        "seated": {
            "description": "A party sits, at any table or at the one that is named.",
            "oneOf": [
                party,
                _object({"party": party, "table": name}, ("party", "table"), required=("party",)),
            ],
        },
        "paid": _described(name, "A table, or the table of a customer, has paid."),
        "at": {
            "description": "The robot stands on a node; or that one of several robots.",
            "oneOf": [name, places | {"minProperties": 1}],
        },
        "ordered": _described(name, "The order of a table was taken."),
        "sent": _described(name, "The order of a table was sent."),
        "served": {"oneOf": [name, things]},
        "filled": refills,
        "chairs": numbers,
        "serve": _described(party, "A party's whole visit."),
        "holds": _described(term, "A fluent of the domain holds."),
        "holds_not": _described(term, "A fluent of the domain does not hold."),
    }
    event = _object(
        {"time": {"description": "Simulated seconds.", "type": "number", "minimum": 0}, **seen},
        ("time", *OBSERVATIONS),
        required=("time",),
    ) | {"minProperties": 2}
    goal, observation = _ref("goal"), _ref("observation")
    pair = {"type": "array", "items": goal, "minItems": 2, "maxItems": 2}
    properties: dict[str, Schema] = {
        "name": {"description": "What the scenario is called.", "type": ["string", "number"]},
        "layout": {
            "description": "Its layout: a built-in name, or a path from this file.",
            "type": ["string", "null"],
        },
        "state": _described(state, "What holds already."),
        "observe": _described(_one_or_more(observation), "What has just been seen, all at step 0."),
        "goals": {
            "description": "What is wanted, all of it; left out: everybody is served.",
            "oneOf": [goal, {"type": "array", "items": goal}, {"type": "null"}],
        },
        "before": {
            "description": "Pairs of goals: the first is reached before the second.",
            "type": "array",
            "items": pair,
        },
        "prefer": _described(
            _list_of({"enum": list(PREFERENCES)}),
            "How ties among minimal plans are settled, in this order.",
        ),
        "events": {
            "description": "What happens later, for simulate.",
            "type": "array",
            "items": event,
        },
        "instant_kitchen": {
            "description": "Whether what was ordered is ready at once.",
            "type": "boolean",
        },
        "guests": _described(_guests(), "Guests who come by chance, for simulate."),
        "minutes": {
            "description": "How long guests come.",
            "type": "number",
            "minimum": 0,
            "maximum": MOST_MINUTES,
        },
        "facts": _described(
            {"type": "array", "items": {"type": "string"}},
            "Facts in SPARC, for a domain of one's own.",
        ),
    }
    document = _document("A situation", "scenario.schema.json", _object(properties, SCENARIO_KEYS))
    document["$defs"] |= {
        "term": {"description": "A term of SPARC: isdirty(table1).", "type": "string"},
        "party": {
            "description": "The customers of one party: a list, or one name.",
            "oneOf": [{"type": "array", "items": name, "uniqueItems": True}, name],
        },
        "observation": _object(seen, OBSERVATIONS) | {"minProperties": 1},
        "goal": _object(wishes, GOALS) | {"minProperties": 1, "maxProperties": 1},
    }
    return document


def _guests() -> Schema:
    """Returns the schema of the key ``guests``."""
    minutes: Schema = {"type": "number", "minimum": 0, "maximum": MOST_MINUTES}
    pair = {"type": "array", "items": minutes, "minItems": 2, "maxItems": 2}
    span: Schema = {
        "oneOf": [
            minutes,
            pair,
            _object({"mean": minutes, "sd": minutes}, ("mean", "sd"), ("mean",)),
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
        "per_hour": _described(rate, "Parties an hour, by chance."),
        "at": {"description": "Minutes and heads.", "type": "array", "items": arrival},
    }
    properties: dict[str, Schema] = {
        "arrivals": _object(arrivals, ("per_hour", "at"))
        | {"minProperties": 1, "maxProperties": 1},
        "sizes": {
            "description": "The share of parties by heads.",
            "type": "object",
            "patternProperties": {"^[0-9]+$": rate},
            "additionalProperties": False,
        },
        "order_after": _described(span, "Minutes until a party that sits is ready to order."),
        "cook": _described(span, "Minutes that the kitchen takes for an order."),
        "eat": _described(span, "Minutes that a party eats."),
        "refills": _described(rate, "How often an hour a guest empties the jug."),
        "bill_after": _described(span, "Minutes until a party that has eaten wants its bill."),
        "patience": _described(minutes, "Minutes after which a party without a table leaves."),
        "patience_served": _described(
            minutes, "Minutes after which a party that waits for its plate leaves."
        ),
    }
    return _object(properties, GUEST_KEYS, ("arrivals",))


def _document(title: str, file: str, body: Schema) -> Schema:
    return {
        "$schema": DRAFT,
        "$comment": f"begin a YAML file with the line: {MODELINE}{file}",
        "title": title,
        **body,
        "$defs": {
            "name": {
                "type": "string",
                "pattern": "^[a-z][A-Za-z0-9_]*$",
                "not": {"enum": sorted(RESERVED)},
            },
            "point": {
                "description": "x and y in metres",
                "type": "array",
                "items": {"type": "number"},
                "minItems": 2,
                "maxItems": 2,
            },
        },
    }


def _ref(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name}"}


def _described(schema: Schema, description: str) -> Schema:
    return {"description": description, **schema}


def _whole(least: int, most: int, description: str) -> Schema:
    return {"description": description, "type": "integer", "minimum": least, "maximum": most}


def _map_of(key: Schema, value: Schema) -> Schema:
    return {"type": "object", "propertyNames": key, "additionalProperties": value}


def _list_of(item: Schema) -> Schema:
    return {"type": "array", "items": item, "uniqueItems": True}


def _one_or_more(item: Schema) -> Schema:
    return {"oneOf": [item, {"type": "array", "items": item}]}


def _object(
    properties: dict[str, Schema], keys: tuple[str, ...], required: tuple[str, ...] = ()
) -> Schema:
    """Returns a mapping with these keys and no others.

    ``keys`` are those of the reader, in its order.
    """
    assert set(properties) == set(keys), set(properties) ^ set(keys)
    found: Schema = {"type": "object", "properties": {key: properties[key] for key in keys}}
    if required:
        found["required"] = list(required)
    return found | {"additionalProperties": False}
