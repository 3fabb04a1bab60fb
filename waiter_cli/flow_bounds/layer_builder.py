"""Makes the graph of modes and places: `OrderedJobs`, `Floor` → `Layers`.

Entry point `build_layers`.  Arcs are walks inside a mode, over a floor without the nodes that have no
job in it, and the deeds that change the mode (`mode_changes`).  Rows say that what flows in flows out,
how often a deed occurs, and who sits where.
"""

from __future__ import annotations

from waiter_cli.flow_bounds.contraction import Floor, contract
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.mode_changes import ModeChanges
from waiter_cli.flow_bounds.modes import (
    ALONE,
    FREE,
    SENT,
    Deed,
    FlowRow,
    Key,
    Mode,
    VisitSet,
)
from waiter_cli.flow_bounds.ordered_jobs import OrderedJobs

__all__ = ["build_layers"]


class _Builder:
    def __init__(self, jobs: OrderedJobs, floor: Floor, tracked: tuple[int, ...]) -> None:
        self.jobs, self.floor, self.tracked = jobs, floor, tracked
        self.changes = ModeChanges(jobs, tracked)
        self.layers = Layers()

    def build(self) -> Layers:
        """Returns the graph with all its rows."""
        jobs, layers = self.jobs, self.layers
        first = self.changes.first()
        self.last = Mode(SENT, frozenset(self.tracked), ALONE, FREE)
        deeds: dict[Mode, list[Deed]] = {}
        queue = [first]
        for mode in queue:
            if mode not in deeds:
                deeds[mode] = list(self.changes.possible(mode))
                queue += [deed.mode for deed in deeds[mode]]
        back: dict[Mode, list[Mode]] = {}
        for mode, found in deeds.items():
            for deed in found:
                back.setdefault(deed.mode, []).append(mode)
        useful, queue = {self.last}, [self.last]
        for mode in queue:
            for before in back.get(mode, ()):
                if before not in useful:
                    useful.add(before)
                    queue.append(before)
        layers.modes = [mode for mode in deeds if mode in useful]
        keep: dict[Mode, set[int]] = {
            mode: set(self.changes.seen_in(mode)) for mode in layers.modes
        }
        for mode in layers.modes:
            for deed in deeds[mode]:
                if deed.mode in useful:
                    keep[mode].update(deed.nodes)
                    keep[deed.mode].update(deed.nodes)
        keep.setdefault(first, set()).add(jobs.start)
        if jobs.end is not None:
            keep[self.last].add(jobs.end)
        self._floors(keep)
        for index, mode in enumerate(layers.modes):
            for deed in deeds[mode]:
                if deed.mode in useful:
                    there = self.index[deed.mode]
                    for node in deed.nodes:
                        if (index, node) in layers.number:
                            tail, head = layers.number[index, node], layers.number[there, node]
                            layers.arc(tail, head, 0, deed.key)
        self._ends()
        layers.start = layers.number[self.index[first], jobs.start]
        self._rows()
        self._visits()
        return layers

    def _floors(self, keep: dict[Mode, set[int]]) -> None:
        """Adds the nodes of every mode and the walks between them."""
        layers = self.layers
        self.index = {mode: k for k, mode in enumerate(layers.modes)}
        common = contract(self.floor, set().union(*keep.values()) & self.floor.keys())
        floors: dict[frozenset[int], Floor] = {}
        for index, mode in enumerate(layers.modes):
            kept = frozenset(keep[mode] & self.floor.keys())
            if kept not in floors:
                floors[kept] = contract(common, kept)
            floor = floors[kept]
            for node in sorted(floor):
                layers.number[index, node] = len(layers.places)
                layers.places.append((index, node))
            for a in sorted(floor):
                for b, steps in sorted(floor[a].items()):
                    tail, head = layers.number[index, a], layers.number[index, b]
                    layers.arc(tail, head, steps, ("walk",))

    def _ends(self) -> None:
        """Adds the sink: a plan ends in the last mode, where it may."""
        layers = self.layers
        layers.sink = len(layers.places)
        layers.places.append((-1, -1))
        last = self.index[self.last]
        for (index, node), number in layers.number.items():
            if index == last and self.jobs.end in (None, node):
                layers.arc(number, layers.sink, 0, ("end",))

    def _rows(self) -> None:
        """Adds what flows in flows out; how often deeds occur; who sits where."""
        layers, jobs = self.layers, self.jobs
        balance: list[list[tuple[int, int]]] = [[] for _ in layers.places]
        for column, (tail, head) in enumerate(zip(layers.tails, layers.heads)):
            balance[tail].append((column, -1))
            balance[head].append((column, 1))
        for node, columns in enumerate(balance):
            total = (node == layers.sink) - (node == layers.start)
            layers.rows.append(FlowRow(total, total, tuple(columns)))
        for nodes, count in self.changes.refills.items():
            self._times(("refill", nodes), count)
        for key, carryings in self.changes.take_ups.items():
            self._times(key, len(carryings))
        for nodes in {carrying.target for carrying in jobs.carryings}:
            layers.times["bring", nodes] = sum(c.target == nodes for c in jobs.carryings)
            layers.times["fill", nodes] = sum(c.target == nodes and c.empty for c in jobs.carryings)
        once: list[Key] = [("send",), ("first",), *(("take", k) for k in self.tracked)]
        layers.times |= dict.fromkeys(once, 1)
        self._last_plate()
        self._seats()

    def _times(self, key: Key, count: int) -> None:
        self.layers.times[key] = count
        columns = tuple((column, 1) for column in self.layers.deeds.get(key, ()))
        self.layers.rows.append(FlowRow(count, count, columns))

    def _last_plate(self) -> None:
        """Adds that the plate of the order taken last is taken up after it was sent."""
        layers = self.layers
        taken = [order for order in self.jobs.orders if order.nodes or order.table]
        if not taken or not all(order.plate for order in taken):
            return
        columns = [
            (column, 1)
            for key in self.changes.take_ups
            for column in layers.deeds.get(key, ())
            if layers.modes[layers.places[layers.tails[column]][0]].phase == SENT
        ]
        layers.rows.append(FlowRow(1, None, tuple(columns)))

    def _seats(self) -> None:
        """Adds columns for who sits where, and that every table is used once."""
        layers, jobs = self.layers, self.jobs
        used: dict[str, list[int]] = {}
        for kind, led in (("seat", False), ("led", True)):
            at: dict[str, list[int]] = {}
            for index, sitting in enumerate(jobs.sittings):
                if sitting.led != led:
                    continue
                mine = []
                for name, cost in sitting.costs:
                    if (kind, name) in layers.deeds:
                        layers.costs.append(cost)
                        layers.keys.append(("sits", index, name))
                        mine.append(len(layers.costs) - 1)
                        at.setdefault(name, []).append(mine[-1])
                        used.setdefault(name, []).append(mine[-1])
                columns = tuple((column, 1) for column in mine)
                layers.rows.append(FlowRow(sitting.least, sitting.count, columns))
            for name, columns_at in at.items():
                arcs = [(arc, 1) for arc in layers.deeds[kind, name]]
                sits = [(column, -1) for column in columns_at]
                layers.rows.append(FlowRow(0, 0, (*arcs, *sits)))
                layers.times[kind, name] = 1
        self._together()
        for name in dict.fromkeys([*used, *sorted(jobs.forced)]):
            sits = [(column, 1) for column in used.get(name, ())]
            layers.rows.append(FlowRow(int(name in jobs.forced), 1, tuple(sits)))

    def _together(self) -> None:
        """Says of picks, of seats, and of seats beside the same nodes how often they occur at most."""
        layers = self.layers
        most = sum(sitting.count for sitting in self.changes.fetched)
        if ("pick",) in layers.deeds:
            layers.times["pick",] = most
        groups: dict[Key, list[str]] = {}
        for name in [str(key[1]) for key in layers.deeds if key[0] == "seat"]:
            groups.setdefault(("seats", self.changes.nodes_of[name]), []).append(name)
            groups.setdefault(("seats",), []).append(name)
        for key, names in groups.items():
            if len(names) > 1:
                layers.times[key] = min(len(names), most)
                layers.deeds[key] = [c for name in names for c in layers.deeds["seat", name]]

    def _visits(self) -> None:
        """Adds the sets of nodes one of which every plan is at."""
        layers, jobs = self.layers, self.jobs
        wanted = [(nodes, None) for nodes in jobs.visits]
        plain = [k for k, o in enumerate(jobs.orders) if o.nodes and k not in self.tracked]
        for nodes, order in (*wanted, *((jobs.orders[k].nodes, k) for k in plain)):
            inside = frozenset(
                layers.number[index, node]
                for index, mode in enumerate(layers.modes)
                if order is None or self.changes.counts(order, mode)
                for node in nodes
            )
            if layers.start not in inside:
                layers.visits.append(VisitSet(inside))


_TRACKED = 3
"""The most orders that modes tell apart: each may double the modes."""
_LARGEST = 16_000
"""The most columns of a graph that tells orders apart."""


def build_layers(jobs: OrderedJobs, floor: Floor, tracked: tuple[int, ...] | None = None) -> Layers:
    """Returns the graph; ``tracked`` are the orders (by index) that its modes tell apart.

    Only orders with a plate that are still to be taken at some node can be tracked, and none where
    one such waits for a party to sit down.  None: as many as a graph of some size has room for.
    """
    if tracked is not None:
        return _Builder(jobs, floor, tracked).build()
    plates = [k for k, order in enumerate(jobs.orders) if order.plate and order.nodes]
    if any(order.plate and order.table for order in jobs.orders):
        plates = []
    for count in range(min(_TRACKED, len(plates)), 0, -1):
        layers = _Builder(jobs, floor, tuple(plates[:count])).build()
        if len(layers.costs) <= _LARGEST:
            return layers
    return _Builder(jobs, floor, ()).build()
