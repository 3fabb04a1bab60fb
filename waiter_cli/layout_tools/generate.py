"""Restaurants and evenings made by chance, the same for the same seed: numbers → YAML text.

Entry points: `generate_layout`, `generate_scenario`, and `generate_instance` for a pair of both in
one of the `SIZES`.  An evening can be solved unless `generate_scenario` is asked for one that
cannot, for one of the reasons in `UNSOLVABLE`.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from random import Random

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import InputError
from waiter_cli.files.layout_writer import flow, write_layout
from waiter_cli.layout_tools.generate_floor import build_layout, find_cut
from waiter_cli.model.graph import reachable
from waiter_cli.model.layout import Layout, Table

__all__ = [
    "SIZES",
    "UNSOLVABLE",
    "Size",
    "generate_instance",
    "generate_layout",
    "generate_scenario",
]


@dataclass(frozen=True)
class Size:
    """The size of an instance; ``customers`` bounds their number, all parties together."""

    nodes: int
    tables: int
    parties: int
    bills: int
    waiters: int
    customers: tuple[int, int] | None = None


SIZES = {
    "S": Size(8, 3, 2, 1, 1),
    "M": Size(20, 8, 4, 2, 1),
    "L": Size(50, 20, 6, 3, 2),
    "XL": Size(120, 50, 10, 5, 3, (38, 57)),
}


def generate_layout(
    seed: int,
    nodes: int,
    tables: int,
    *,
    name: str = "generated",
    bar: bool = False,
    waiters: int = 0,
    flaw: str | None = None,
) -> str:
    """Returns the YAML text of a layout with so many nodes, tables and waiters.

    As `build_layout` says.
    """
    made = build_layout(
        seed, nodes, tables, name=name, bar=bar, waiters=waiters, flaw=flaw, handsome=True
    )
    return f"# {nodes} nodes and {tables} tables, generated with seed {seed}\n{write_layout(made)}"


def generate_instance(
    seed: int, size: str, *, bar: bool = False, unsolvable: str | None = None
) -> tuple[str, str]:
    """Returns the YAML texts of a layout and a scenario of one of the `SIZES`."""
    s = SIZES[size]
    flaw = unsolvable if unsolvable in ("unreachable_table", "blocked_aisle") else None
    name = f"{size.lower()}{seed}"
    made = build_layout(seed, s.nodes, s.tables, name=name, bar=bar, waiters=s.waiters, flaw=flaw)
    spare = s.tables - s.parties - (unsolvable is not None)
    bills = min(s.bills, spare - (flaw is not None))
    orders = min(s.bills, spare - bills) if bar else 0
    scenario = generate_scenario(
        seed,
        made,
        s.parties,
        bills,
        orders=orders,
        refills=s.bills if bar else 0,
        customers=s.customers,
        unsolvable=unsolvable,
    )
    return write_layout(made), scenario


@dataclasses.dataclass
class _Evening:
    """A scenario in the making; ``goals`` None is to serve everybody."""

    rng: Random
    layout: Layout
    free: list[Table]
    seated: dict[Table, int] = dataclasses.field(default_factory=dict)
    waiting: list[int] = dataclasses.field(default_factory=list)
    observe: list[dict[str, object]] = dataclasses.field(default_factory=list)
    agent: str | None = None
    waiters: dict[str, str] = dataclasses.field(default_factory=dict)
    wishes: list[dict[str, object]] = dataclasses.field(default_factory=list)
    at: dict[int, str] = dataclasses.field(default_factory=dict)
    """Parties (by their index in ``waiting``) that are wanted at a table of a certain name."""

    def sit(self, table: Table, size: int) -> None:
        """A party of that size sits there from the start."""
        self.free.remove(table)
        self.seated[table] = size


def generate_scenario(
    seed: int,
    layout: Layout,
    parties: int,
    bills: int = 0,
    *,
    orders: int = 0,
    refills: int = 0,
    customers: tuple[int, int] | None = None,
    unsolvable: str | None = None,
) -> str:
    """Returns the YAML text of an evening: parties come in, seated ones want their bills.

    ``parties`` are not seated yet; ``bills`` and ``orders`` ask for a seated party each, ``refills``
    for a table with an empty jug.  ``customers`` bounds the number of guests, all together.
    ``unsolvable`` is None or one of `UNSOLVABLE`.  Raises `InputError` where that cannot be had.
    """
    if unsolvable not in (None, *UNSOLVABLE):
        raise InputError(
            f"no such reason to be unsolvable: {unsolvable}", f"there are {', '.join(UNSOLVABLE)}"
        )
    rng = Random(f"scenario {seed} {layout.name} {parties} {bills} {orders}")
    shut = [] if unsolvable == "blocked_aisle" else [node for _, node in layout.waiters]
    open_ = reachable(layout.neighbours(), layout.agent, shut)
    usable = [table for table in layout.tables if set(table.nodes) & open_]
    evening = _Evening(rng, layout, list(layout.tables))
    if layout.bar is None and orders + refills:
        raise InputError("orders and refills take a bar", "use a layout that has one")
    if unsolvable is None and parties and layout.entrance not in open_:
        raise InputError("the agent cannot get to the entrance", "use a layout without flaw")
    if len(usable) < parties + bills + orders:
        words = (parties, "party", "parties"), (bills, "bill", "bills"), (orders, "order", "orders")
        asked = [f"{n} {one if n == 1 else many}" for n, one, many in words if n]
        raise InputError(
            f"{' and '.join(asked)} would take {parties + bills + orders} tables, "
            f"and only {len(usable)} can be reached",
            "ask for fewer, or for a layout with more tables",
        )
    chosen = rng.sample(usable, parties + bills + orders)
    sizes = _sizes(rng, chosen, customers)
    evening.waiting = sizes[:parties]
    for table, size in zip(chosen[parties:], sizes[parties:]):
        evening.sit(table, size)
    asking = list(evening.seated)
    evening.observe += [{"bill": table.name} for table in asking[:bills]]
    evening.observe += [{"order": table.name} for table in asking[bills:]]
    thirsty = rng.sample(usable, min(refills, len(usable)))
    evening.observe += [{"empty": f"{{{table.name}: jug}}"} for table in thirsty]
    for index, table in enumerate(chosen[:parties]):
        evening.at[index] = table.name  # forgotten again unless a wish is spelled out
    if unsolvable is None:
        evening.at.clear()
    else:
        UNSOLVABLE[unsolvable](evening)
    return _write(evening, f"evening{seed}", unsolvable)


def _sizes(rng: Random, tables: list[Table], customers: tuple[int, int] | None) -> list[int]:
    """Returns a size for the party at each table: it fits, and the sum lies within ``customers``."""
    sizes = [rng.randint((table.capacity + 1) // 2, table.capacity) for table in tables]
    low, high = customers or (0, sum(sizes))
    if low > sum(table.capacity for table in tables) or high < len(tables):
        raise InputError(
            f"{len(tables)} parties at these tables cannot be {low} to {high} customers",
            "ask for another number of customers or parties",
        )
    while not low <= sum(sizes) <= high:
        step = 1 if sum(sizes) < low else -1
        index = rng.randrange(len(tables))
        if 1 <= sizes[index] + step <= tables[index].capacity:
            sizes[index] += step
    return sizes


def _need(condition: object, what: str) -> None:
    if not condition:
        raise InputError(f"this evening would take {what}", "ask for more, or another layout")


def _too_big(evening: _Evening) -> None:
    _need(evening.waiting, "a party that comes in")
    evening.at.clear()
    evening.waiting[-1] = max(table.capacity for table in evening.layout.tables) + 1


def _too_many_parties(evening: _Evening) -> None:
    _need(evening.waiting, "a party that comes in")
    evening.at.clear()
    for table in evening.free[len(evening.waiting) - 1 :]:
        evening.sit(table, 1)


def _too_few_big_tables(evening: _Evening) -> None:
    _need(len(evening.waiting) >= 2, "two parties that come in")
    evening.at.clear()
    big = max(table.capacity for table in evening.free)
    for table in [table for table in evening.free if table.capacity == big][1:]:
        evening.sit(table, big)
    evening.waiting[:2] = [big, big]


def _unreachable_table(evening: _Evening) -> None:
    _need(evening.waiting, "a party that comes in")
    layout = evening.layout
    open_ = reachable(layout.neighbours(), layout.agent, [node for _, node in layout.waiters])
    lost = [table for table in evening.free if not set(table.nodes) & open_]
    _need(lost, "a table that cannot be reached")
    evening.at = {0: lost[0].name}
    evening.waiting[0] = min(evening.waiting[0], lost[0].capacity)


def _blocked_aisle(evening: _Evening) -> None:
    _need(evening.waiting, "a party that comes in")
    evening.at.clear()
    layout, near = evening.layout, evening.layout.neighbours()
    shut = [node for _, node in layout.waiters]
    if layout.entrance in reachable(near, layout.agent, shut):
        _need(layout.waiters, "a waiter to stand in the way")
        cut = find_cut(evening.rng, near, layout.entrance)
        _need(cut, "an aisle that one waiter could block")
        assert cut is not None
        others = {name: node for name, node in layout.waiters[1:] if node not in cut}
        _need(len(others) == len(layout.waiters) - 1, "waiters who keep clear of the aisle")
        evening.waiters, evening.agent = {layout.waiters[0][0]: cut[0]}, cut[1]


def _waiter_on_entrance(evening: _Evening) -> None:
    layout = evening.layout
    _need(evening.waiting, "a party that comes in")
    _need(layout.waiters and layout.agent != layout.entrance, "a waiter to stand on the entrance")
    evening.at.clear()
    evening.waiters = {layout.waiters[0][0]: layout.entrance}


def _bill_nobody(evening: _Evening) -> None:
    wanted = set(evening.at.values())
    empty = [table for table in evening.free if table.name not in wanted]
    _need(empty, "a table at which nobody will sit")
    evening.observe.append({"bill": empty[0].name})
    evening.wishes.append({"paid": empty[0].name})


def _unwanted_bill(evening: _Evening) -> None:
    wanted = set(evening.at.values())
    empty = [table for table in evening.free if table.name not in wanted]
    _need(empty, "one more table")
    evening.at.clear()
    evening.sit(empty[0], 1)
    evening.wishes.append({"paid": empty[0].name})


UNSOLVABLE: dict[str, Callable[[_Evening], None]] = {
    "too_big": _too_big,
    "too_many_parties": _too_many_parties,
    "too_few_big_tables": _too_few_big_tables,
    "unreachable_table": _unreachable_table,
    "blocked_aisle": _blocked_aisle,
    "waiter_on_entrance": _waiter_on_entrance,
    "bill_nobody": _bill_nobody,
    "unwanted_bill": _unwanted_bill,
}


def _write(evening: _Evening, name: str, unsolvable: str | None) -> str:
    """Returns the evening as YAML; customers are numbered through, seated ones first."""
    taken = {node.name for node in evening.layout.nodes} | {t.name for t in evening.layout.tables}
    taken |= {waiter for waiter, _ in evening.layout.waiters}
    number = 0

    def party(size: int) -> list[str]:
        nonlocal number
        names: list[str] = []
        while len(names) < size:
            number += 1
            if f"c{number}" not in taken:
                names.append(f"c{number}")
        return names

    seated = {table.name: party(size) for table, size in evening.seated.items()}
    comers = [party(size) for size in evening.waiting]
    early = evening.rng.randint(0, len(comers))
    lines = [f"# unsolvable: {unsolvable}"] if unsolvable else []
    lines += [f"name: {name}", f"layout: {evening.layout.name}"]
    state: dict[str, object] = {"agent": evening.agent} if evening.agent else {}
    state |= {"waiters": evening.waiters} if evening.waiters else {}
    state |= {"seated": seated} if seated else {}
    state |= {"waiting": comers[:early]} if early else {}
    if state:
        lines += ["state:", *(f"  {key}: {flow(value)}" for key, value in state.items())]
    observe = [*({"enter": who} for who in comers[early:]), *evening.observe]
    if observe:
        lines += ["observe:", *(f"  - {flow(observation)[1:-1]}" for observation in observe)]
    wishes = list(evening.wishes)
    if wishes or evening.at:
        wishes += [
            {
                "seated": {"party": who[0], "table": evening.at[index]}
                if index in evening.at
                else who
            }
            for index, who in enumerate(comers)
        ]
        lines += ["goals:", *(f"  - {flow(wish)[1:-1]}" for wish in wishes)]
    return "\n".join(lines) + "\n"
