"""The parts of JSON Schemas that several files have in common. Entry point `document`.

Draft 2020-12; names are those of the readers.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from waiter_cli.yaml_reading.node_reader import RESERVED

__all__ = [
    "MODELINE",
    "Schema",
    "described",
    "document",
    "list_of",
    "map_of",
    "object_of",
    "one_or_more",
    "ref",
    "whole",
]

DRAFT = "https://json-schema.org/draft/2020-12/schema"
MODELINE = "# yaml-language-server: $schema="
"""The first line of a YAML file whose editor is to check it, without the path of the schema."""

Schema: TypeAlias = "dict[str, Any]"


def document(title: str, file: str, body: Schema) -> Schema:
    """Returns a whole schema, with the names and points that both kinds of files have."""
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


def ref(name: str) -> Schema:
    """Returns what stands for a definition of the document."""
    return {"$ref": f"#/$defs/{name}"}


def described(schema: Schema, description: str) -> Schema:
    """Returns a schema with its description."""
    return {"description": description, **schema}


def whole(least: int, most: int, description: str) -> Schema:
    """Returns the schema of a whole number between two others."""
    return {"description": description, "type": "integer", "minimum": least, "maximum": most}


def map_of(key: Schema, value: Schema) -> Schema:
    """Returns the schema of a mapping, by those of its keys and values."""
    return {"type": "object", "propertyNames": key, "additionalProperties": value}


def list_of(item: Schema) -> Schema:
    """Returns the schema of a list in which nothing stands twice."""
    return {"type": "array", "items": item, "uniqueItems": True}


def one_or_more(item: Schema) -> Schema:
    """Returns the schema of one item, or a list of them."""
    return {"oneOf": [item, {"type": "array", "items": item}]}


def object_of(
    properties: dict[str, Schema], keys: tuple[str, ...], required: tuple[str, ...] = ()
) -> Schema:
    """Returns a mapping with these keys and no others.

    ``keys`` are those of the reader, in its order.
    """
    assert set(properties) == set(keys), set(properties) ^ set(keys)
    schema: Schema = {"type": "object", "properties": {key: properties[key] for key in keys}}
    if required:
        schema["required"] = list(required)
    return schema | {"additionalProperties": False}
