"""A layout's own text with one change in it: comments and order stay. Entry point `edited`.

Only what the change is about is written anew.  Whether the text then says what it should is found
out by reading it; where it does not, the layout is written whole.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from waiter_cli.errors import LayoutError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.layout_writer import edge_text, flow, write_layout
from waiter_cli.model.layout import Layout

__all__ = ["edited"]


def edited(text: str, before: Layout, after: Layout) -> str | None:
    """``text``, from which ``before`` was read, such that ``after`` is read from it.

    None where that takes more than one more edge, other places of tables, and places for nodes
    that have none.
    """
    try:
        new = _spliced(text, list(_edits(text, before, after)))
        same = write_layout(read_layout(new, before.file)) == write_layout(after)
    except (LookupError, LayoutError):
        return None
    return new if same else None


def _spliced(text: str, edits: list[tuple[int, int, str]]) -> str:
    """Returns the text with other text in the place of each stretch from start to end."""
    for start, end, instead in sorted(edits, reverse=True):
        text = text[:start] + instead + text[end:]
    return text


def _edits(text: str, before: Layout, after: Layout) -> Iterator[tuple[int, int, str]]:
    """Yields each stretch and its new text.

    Raises `LookupError` where the text has no place for it.
    """
    import yaml

    root = _entries(yaml.compose(text, Loader=yaml.SafeLoader))
    if before.nodes[0].at is None and after.nodes[0].at is not None:
        yield from _places(text, root["nodes"], {node.name: flow(node.at) for node in after.nodes})
    for edge in after.edges:
        if edge not in before.edges:
            yield _one_more(text, root["edges"], edge_text(after, edge))
    tables = _entries(root["tables"])
    for old, new in zip(before.tables, after.tables, strict=True):
        if old.nodes == new.nodes and old.at in (new.at, None):
            continue  # what has no place gets one when it is read
        entries = _entries(tables[new.name])
        yield _instead(entries["nodes"], flow(new.nodes))
        if old.at != new.at and new.at is not None:
            yield _instead(entries["at"], flow(new.at))


def _places(text: str, node: Any, at: dict[str, str]) -> Iterator[tuple[int, int, str]]:
    """Makes a mapping to places of a list of names."""
    if node.id != "sequence":
        raise LookupError("no list of names")
    for item in node.value:
        start = item.start_mark.index
        if not node.flow_style:
            start = text.rindex("-", 0, start)
        yield start, item.end_mark.index, f"{item.value}: {at[item.value]}"
    if node.flow_style:
        yield node.start_mark.index, node.start_mark.index + 1, "{"
        yield node.end_mark.index - 1, node.end_mark.index, "}"


def _entries(node: Any) -> dict[str, Any]:
    if not isinstance(getattr(node, "value", None), list) or node.id != "mapping":
        raise LookupError("no mapping")
    return {key.value: value for key, value in node.value}


def _instead(node: Any, value: str) -> tuple[int, int, str]:
    """Writes ``value`` for a value that stands between brackets, or is a single word."""
    if node.id != "scalar" and not node.flow_style:
        raise LookupError("a value over several lines")
    return node.start_mark.index, node.end_mark.index, value


def _one_more(text: str, node: Any, item: str) -> tuple[int, int, str]:
    """Adds an item to a list, after its last one."""
    if node.id != "sequence" or not node.value:
        raise LookupError("no list with an item")
    last = node.value[-1]
    end = last.end_mark.index
    if node.flow_style:
        return end, end, f", {item}"
    if last.id == "scalar" or not last.flow_style:
        raise LookupError("an item over several lines")
    newline = "\r\n" if "\r\n" in text else "\n"
    line_end = text.find(newline, end)
    end = len(text) if line_end < 0 else line_end
    return end, end, f"{newline}{' ' * node.start_mark.column}- {item}"
