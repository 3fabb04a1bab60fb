"""`State` → who is left unserved, and who still calls. Entry point `unserved`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.state import Party, State
from waiter_cli.model.wording import people

__all__ = ["Call", "unserved"]


@dataclass(frozen=True)
class Call:
    """Something that is still to be done for somebody.

    ``kind`` is ``waiting following bill to_order order kitchen ready carried`` or ``empty``; it is
    about a party or a table, and about ``item`` there.
    """

    kind: str
    text: str
    party: Party = ()
    table: str | None = None
    item: str | None = None

    def as_dict(self) -> dict[str, Any]:
        """As ``simulate --json`` lists it."""
        whose: dict[str, Any] = {"party": list(self.party)} if self.party else {"table": self.table}
        if self.item is not None:
            whose["object"] = self.item
        return {"kind": self.kind, **whose, "text": self.text}


def unserved(state: State) -> tuple[Call, ...]:
    """Whoever waits or calls in ``state``: parties by arrival, then tables by name."""
    return (*_parties(state), *_tables(state))


def _parties(state: State) -> Iterator[Call]:
    for party in state.waiting:
        yield Call("waiting", f"{people(party)} waits at the entrance", party)
    if state.with_agent:
        party = state.with_agent
        yield Call("following", f"{people(party)} follows the robot and has no table", party)


def _tables(state: State) -> Iterator[Call]:
    for table in sorted(state.wants_bill):
        yield Call("bill", f"{table} wants its bill", table=table)
    for table in sorted(state.ready_to_order):
        yield Call("to_order", f"{table} is ready to order", table=table)
    for table in sorted(state.ordered):
        yield Call("order", f"the order of {table} is not sent", table=table)
    at_the_bar = {table for table, item in state.ready if item == "plate"}
    carried = state.carrying
    on_its_way = {carried[0]} if carried is not None and carried[1] == "plate" else set()
    for table in sorted(state.sent - state.served - at_the_bar - on_its_way):
        yield Call("kitchen", f"the kitchen has not made what {table} ordered", table=table)
    for table, item in sorted(state.ready - {carried}):
        yield Call("ready", f"the {item} for {table} is not brought", table=table, item=item)
    if carried is not None:
        table, item = carried
        yield Call("carried", f"the robot still has the {item} of {table}", table=table, item=item)
    for table, item in sorted(state.empty - {carried}):
        yield Call("empty", f"the {item} of {table} is empty", table=table, item=item)
