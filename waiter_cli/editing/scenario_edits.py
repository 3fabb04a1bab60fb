"""Edits of a scenario's text, as `edits` has them for layouts. Entry point `edited_scenario`.

>>> edited_scenario("state: {waiters: {w1: n7}}  # here\\n", {"do": "stand", "waiter": "w1", "node": "n2"})
'state: {waiters: {w1: n2}}  # here\\n'
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from waiter_cli.editing.spans import Piece, pieces_of
from waiter_cli.editing.splices import (
    applied,
    new_entry,
    new_item,
    renamed,
    without_entry,
    without_item,
)
from waiter_cli.errors import InputError

__all__ = ["SCENARIO_EDITS", "edited_scenario"]

Given = dict[str, Any]


def edited_scenario(text: str, given: Given) -> str:
    """Returns the text after one edit; raises `InputError` where it has no place for it."""
    root = pieces_of(text)
    edit = SCENARIO_EDITS.get(given.get("do", ""))
    if root is None or root.kind != "map" or edit is None:
        raise InputError("the scenario cannot be edited there", "change its text")
    try:
        return edit(text, root, given)
    except (KeyError, IndexError, ValueError):
        raise InputError("the scenario has no place for that", "change its text") from None


def _stand(text: str, root: Piece, given: Given) -> str:
    """Puts a waiter elsewhere: where he was seen last, else in the state."""
    waiter, node = str(given["waiter"]), str(given["node"])
    seen = [place for key, place in _seen_at(root) if key.text == waiter]
    if seen:
        return applied(text, [renamed(text, seen[-1], node)])
    state = root.get("state")
    if state is None:
        return applied(text, [new_entry(text, root, "state", {"waiters": {waiter: node}})])
    waiters = state.get("waiters")
    if waiters is None:
        splice = new_entry(text, state, "waiters", {waiter: node}, root.key("state"))
    elif waiters.get(waiter) is None:
        splice = new_entry(text, waiters, waiter, node, state.key("waiters"))
    else:
        splice = renamed(text, waiters[waiter], node)
    return applied(text, [splice])


def _seen_at(root: Piece) -> Iterator[tuple[Piece, Piece]]:
    """Yields who was seen, and where."""
    observed = root.get("observe")
    for seen in observed.items if observed else ():
        at = seen.get("at")
        yield from at.entries if at else ()


def _drop_goal(text: str, root: Piece, given: Given) -> str:
    """Takes out a goal by its number, counted from 0."""
    index, goals = int(given["index"]), root["goals"]
    if not 0 <= index < len(goals.items):
        raise IndexError(index)
    return applied(text, [without_item(text, goals, index, root.key("goals"))])


def _free(text: str, root: Piece, given: Given) -> str:
    """Lets the party at a table leave: nobody sits there."""
    state = root["state"]
    return applied(
        text, [without_entry(text, state["seated"], str(given["table"]), state.key("seated"))]
    )


def _ask_bill(text: str, root: Piece, given: Given) -> str:
    """Lets a table ask for its bill."""
    seen = {"bill": str(given["table"])}
    observed = root.get("observe")
    if observed is None:
        return applied(text, [new_entry(text, root, "observe", [seen])])
    return applied(text, [new_item(text, observed, seen, root.key("observe"))])


SCENARIO_EDITS: dict[str, Callable[[str, Piece, Given], str]] = {
    "stand": _stand,
    "drop_goal": _drop_goal,
    "free": _free,
    "bill": _ask_bill,
}
