"""What JSON Schemas find wrong with YAML texts: `schema_faults`."""

from __future__ import annotations

import json
from typing import Any

import yaml

__all__ = ["schema_faults"]


def value_of(text: str) -> Any:
    """A YAML text as JSON sees it: keys are texts."""
    return json.loads(json.dumps(yaml.safe_load(text)))


def schema_faults(schema: dict[str, Any], text: str) -> list[str]:
    """What a schema finds wrong with a YAML text."""
    import jsonschema

    checker = jsonschema.Draft202012Validator(schema)
    return [error.message for error in checker.iter_errors(value_of(text))]
