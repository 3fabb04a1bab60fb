"""The nodes on which a robot can stand for an action. Entry point `places_for`."""

from __future__ import annotations

from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action

__all__ = ["places_for"]


def places_for(layout: Layout, action: Action) -> tuple[str, ...]:
    """Returns the nodes where a robot can stand for an action; for a step, where it can come from.

    >>> from waiter_cli.model.layout import Node
    >>> row = Layout("row", (Node("a"), Node("b")), (("a", "b"),), "a", (), "a")
    >>> places_for(row, Action(0, "go_to", ("agent", "b"))), places_for(row, Action(0, "pick", ("agent", "c1")))
    (('a',), ('a',))
    """
    match action.name, action.arguments:
        case "go_to", (_, node):
            return tuple(here for here, near in layout.neighbours().items() if node in near)
        case "pick", _:
            return (layout.entrance,)
        case (("send_order" | "take_up"), _):
            return layout.bar.nodes if layout.bar is not None else ()
        case "bring_chairs", (_, table, _):
            return layout.table(table).nodes
    return layout.table(action.arguments[-1]).nodes
