"""Writes a layout as YAML."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

from waiter_cli.model.layout import Layout

if TYPE_CHECKING:
    from typing import Any

__all__ = ["edge_text", "flow", "quoted", "write_layout"]


def write_layout(layout: Layout) -> str:
    """Returns the YAML text from which the same layout is read.

    ``timetable`` and ``walls`` included.
    """
    lines = [f"name: {quoted(layout.name)}", "nodes:"]
    if all(node.at for node in layout.nodes):
        lines += [f"  {node.name}: {flow(node.at)}" for node in layout.nodes]
    else:
        lines += [f"  - {node.name}" for node in layout.nodes]
    lines.append("edges:")
    lines += [f"  - {edge_text(layout, edge)}" for edge in layout.edges]
    lines += [f"entrance: {layout.entrance}", "tables:"]
    for table in layout.tables:
        what: dict[str, Any] = {"capacity": table.capacity, "nodes": list(table.nodes)}
        if table.at is not None:
            what |= {"at": list(table.at)}
        what |= {"size": list(table.size)}
        if table.chairs != table.capacity:
            what |= {"chairs": table.chairs}
        lines.append(f"  {table.name}: {flow(what)}")
    if layout.agents:
        lines.append(f"agents: {flow(dict(layout.agents))}")
    else:
        lines.append(f"agent: {layout.agent}")
    if layout.waiters:
        lines.append(f"waiters: {flow(dict(layout.waiters))}")
    if layout.bar is not None:
        bar: Any = list(layout.bar.nodes)
        if layout.bar.corners:
            first, second = layout.bar.corners
            bar = {"nodes": bar, "from": list(first), "to": list(second)}
        lines += [f"bar: {flow(bar)}", f"objects: {flow(list(layout.objects))}"]
    if layout.timetable:
        due: dict[str, dict[int, str]] = {}
        for waiter, step, place in layout.timetable:
            due.setdefault(waiter, {})[step] = place
        lines.append(f"timetable: {flow(due)}")
    if layout.walls:
        lines.append(f"walls: {flow([[list(a), list(b)] for a, b in layout.walls])}")
    return "\n".join(lines) + "\n"


def edge_text(layout: Layout, edge: tuple[str, str]) -> str:
    """Returns an edge of a layout as YAML on one line."""
    a, b = edge
    return flow({"from": a, "to": b} if edge in layout.one_way else edge)


def quoted(text: str) -> str:
    """Returns a name as a YAML scalar on one line."""
    plain = re.fullmatch(r"[A-Za-z][A-Za-z0-9_./-]*|[./]+[A-Za-z0-9_./-]+", text)
    return text if plain else json.dumps(text, ensure_ascii=False)


def flow(value: Any) -> str:
    """Returns a value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {flow(what)}" for key, what in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    return str(value)
