"""Readers of nodes as tests ask for them: YAML in, a value and the faults out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Node, compose

__all__ = ["reading"]

Value = TypeVar("Value")


def reading(text: str, read: Callable[[NodeReader, Any], Value]) -> tuple[Value, list[str]]:
    """What ``read`` makes of the root of a YAML text, and the faults it noted: ``LINE:COLUMN: what``."""
    document = compose(text, "f.yaml")
    reader = NodeReader(document)
    root: Node | None = document.root
    value = read(reader, root)
    told = [
        f"{each.where.line}:{each.where.column}: {each.message}"
        for each in reader.faults
        if each.where
    ]
    return value, told
