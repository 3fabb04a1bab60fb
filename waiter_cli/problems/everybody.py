"""Makes the goals that mean serving everybody."""

from __future__ import annotations

from waiter_cli.errors import Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Goal, State

__all__ = ["serve_everybody"]


def serve_everybody(
    state: State, layout: Layout, instant_kitchen: bool, places: dict[str, Where]
) -> tuple[Goal, ...]:
    """Returns the goals of serving everybody, spelled out from a state.

    First every party that waits gets a seat, then bills, orders, what is ready or carried, and
    what is empty, by table in the order of the layout; each goal keeps the place of its cause.
    """
    tables = [table.name for table in layout.tables]
    goals: list[Goal] = []
    for party in (*state.led(), *state.waiting):
        goals.append(Goal("seated", party=party, where=places.get(f"party.{party[0]}")))
    for table in tables:
        if table in state.wants_bill:
            goals.append(Goal("paid", table=table, where=places.get(f"wants_bill.{table}")))
    for table in tables:
        for key in ("ready_to_order", "ordered"):
            if table in (state.ready_to_order if key != "ordered" else state.held_orders()):
                kind = "served" if instant_kitchen else "sent"
                goals.append(Goal(kind, table=table, where=places.get(f"{key}.{table}")))
    objects = [(table, item) for table in tables for item in layout.objects]
    for table, item in objects:
        if (table, item) in state.ready:
            where = places.get(f"ready.{table}.{item}")
            goals.append(Goal("served", table=table, item=item, where=where))
    for table, item in (thing for thing in objects if thing in state.carried()):
        kind = "served" if item == "plate" else "filled"
        where = places.get(f"carrying.{table}.{item}")
        goals.append(Goal(kind, table=table, item=item, where=where))
    for table, item in objects:
        if (table, item) in state.empty:
            where = places.get(f"empty.{table}.{item}")
            goals.append(Goal("filled", table=table, item=item, where=where))
    return tuple(dict.fromkeys(goals))
