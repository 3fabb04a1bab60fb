"""`State` → the shape of a scenario's ``state``, for JSON. Entry point `state_document`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from waiter_cli.layout import Layout
from waiter_cli.situation import State

__all__ = ["state_document"]


def state_document(state: State, layout: Layout) -> dict[str, Any]:
    """Every key that holds, so that a scenario can start from it.

    ``agent`` is always there, ``waiters`` where there are any; tables come in the order of the
    layout.  ``ordered`` lists tables whose order was taken, sent ones too.  An object stands by
    itself where a table has one (``{"table1": "jug"}``), in a list where it has several.
    ``chairs`` is there where some table has fewer than its capacity, or other than the layout says.
    """
    tables = [table.name for table in layout.tables]

    def by_table(names: Iterable[str]) -> list[str]:
        found = set(names)
        return [table for table in tables if table in found]

    def by_object(pairs: Iterable[tuple[str, str]]) -> dict[str, Any]:
        out: dict[str, list[str]] = {}
        for table, item in sorted(pairs, key=lambda pair: (tables.index(pair[0]), pair[1])):
            out.setdefault(table, []).append(item)
        return {table: items[0] if len(items) == 1 else items for table, items in out.items()}

    seated = dict(state.seated)
    chairs = dict(state.chairs)
    own_chairs = any(
        chairs[t.name] != t.chairs or chairs[t.name] < t.capacity for t in layout.tables
    )
    document: dict[str, Any] = {
        "agent": state.agent,
        "waiters": dict(state.waiters),
        "seated": {table: list(seated[table]) for table in by_table(seated)},
        "waiting": [list(party) for party in state.waiting],
        "with_agent": list(state.with_agent),
        "wants_bill": by_table(state.wants_bill),
        "paid": by_table(state.paid),
        "ready_to_order": by_table(state.ready_to_order),
        "ordered": by_table(state.ordered | state.sent),
        "sent": by_table(state.sent),
        "served": by_table(state.served),
        "ready": by_object(state.ready),
        "carrying": by_object([state.carrying] if state.carrying else []),
        "empty": by_object(state.empty),
        "chairs": {table: chairs[table] for table in tables} if own_chairs else {},
    }
    return {key: value for key, value in document.items() if value}
