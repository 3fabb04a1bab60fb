"""The JSON Schema of layout files, for editors. Entry point `layout_schema`.

A schema says what a file may look like: keys, kinds of values, forms of names.  What needs the
whole file (does that node exist, is a name given twice) is for ``waiter layout check``.
"""

from __future__ import annotations

from waiter_cli.files.layout_reader import (
    EDGE_KEYS,
    KEYS,
    MAX_CUSTOMERS,
    MAX_SEATS,
    TABLE_KEYS,
)
from waiter_cli.layout_tools.schema_parts import (
    Schema,
    described,
    document,
    list_of,
    map_of,
    object_of,
    ref,
    whole,
)
from waiter_cli.model.layout import OBJECTS

__all__ = ["layout_schema"]


def layout_schema() -> Schema:
    """Returns the schema of layout files."""
    point = ref("point")
    names = list_of(ref("name"))
    table = object_of(
        {
            "capacity": whole(1, MAX_SEATS, "How many guests it has room for."),
            "nodes": described(names | {"minItems": 1}, "The nodes it is served from."),
            "at": described(point, "Its centre in metres; beside its first node unless told."),
            "size": {
                "description": "Its size in metres, along x and y; 0.8 by 0.8 unless told.",
                "type": "array",
                "items": {"type": "number", "exclusiveMinimum": 0},
                "minItems": 2,
                "maxItems": 2,
            },
            "chairs": whole(0, MAX_SEATS, "How many chairs stand there; its capacity unless told."),
        },
        TABLE_KEYS,
        required=("capacity", "nodes"),
    )
    bar_nodes = described(names | {"minItems": 1}, "Where orders are sent and jugs are filled.")
    bar = object_of(
        {
            "nodes": bar_nodes,
            "from": described(point, "One corner of the counter, in metres."),
            "to": described(point, "The opposite corner."),
        },
        ("nodes", "from", "to"),
        required=("nodes",),
    ) | {"dependentRequired": {"from": ["to"], "to": ["from"]}}
    pair = {
        "type": "array",
        "items": ref("name"),
        "minItems": 2,
        "maxItems": 2,
        "uniqueItems": True,
    }
    one_way = object_of(
        {
            "from": described(ref("name"), "The node that a one-way path begins at."),
            "to": described(ref("name"), "The node that it leads to."),
        },
        EDGE_KEYS,
        required=EDGE_KEYS,
    )
    properties: dict[str, Schema] = {
        "name": {"description": "What the restaurant is called.", "type": ["string", "number"]},
        "nodes": {
            "description": "Places the robot can stand: a place in metres for each, or names only.",
            "oneOf": [
                map_of(ref("name"), point) | {"minProperties": 1},
                {"type": "array", "items": ref("name"), "minItems": 1, "uniqueItems": True},
            ],
        },
        "edges": {
            "description": "Paths between nodes: pairs lead both ways, from and to one way only.",
            "type": "array",
            "items": {"oneOf": [pair, one_way]},
        },
        "entrance": described(ref("name"), "The node where arriving parties are picked up."),
        "tables": described(map_of(ref("name"), table), "The tables by name."),
        "agent": described(ref("name"), "The node where the robot starts."),
        "agents": described(
            map_of(ref("name"), ref("name")) | {"minProperties": 1},
            "Several robots and the nodes where they start, in place of agent.",
        ),
        "waiters": described(
            map_of(ref("name"), ref("name")), "Other waiters and the nodes they stand on."
        ),
        "bar": {
            "description": "Where orders are sent and jugs and baskets are filled.",
            "oneOf": [bar_nodes, bar, {"type": "null"}],
        },
        "objects": described(list_of({"enum": list(OBJECTS)}), "What is carried; needs a bar."),
        "timetable": described(
            map_of(ref("name"), map_of({"pattern": "^[0-9]+$"}, ref("name"))),
            "Where waiters will stand from which step on: {w1: {3: n4}}.",
        ),
        "walls": {
            "description": "Line segments in metres, drawn and simulated, never reasoned about.",
            "type": "array",
            "items": {"type": "array", "items": point, "minItems": 2, "maxItems": 2},
        },
        "customers": whole(0, MAX_CUSTOMERS, "How many customer names c1, c2, … are known."),
    }
    required = ("nodes", "edges", "entrance", "tables")
    either = {"oneOf": [{"required": ["agent"]}, {"required": ["agents"]}]}
    return document(
        "A restaurant",
        "layout.schema.json",
        object_of(properties, KEYS, required=required) | either,
    )
