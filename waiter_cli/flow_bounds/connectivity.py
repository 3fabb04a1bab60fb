"""Sets of nodes that a plan must enter and a flow does not: the cuts of the programme.

Entry points `FlowCut`, `row_of` and `Separator`.  A walk from the start that is at a node of a set, or
does a deed in it, enters the set unless it starts there.  A flow that keeps its balance may go round
in circles apart from the start instead; a least cut between the start and where the deed is done
finds the set that it should have entered.  Of all such sets the smallest is taken.

Sets of nodes of the graph are many and each says little.  So the graph is first looked at with
modes thrown together (all of them; those of one lead; those of one load of the hands): a set found
there stands for all its modes at once, and says more.  Modes one by one come last.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sparc.lazy_dataclass import dataclass
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.least_cuts import Net
from waiter_cli.flow_bounds.modes import FlowRow, Key

__all__ = ["FlowCut", "Separator", "row_of"]

_SCALE = 1 << 20
_LACK = _SCALE // 200
"""A cut is taken where the flow in falls short by so much (of one), and no less."""
_LITTLE = _SCALE // 100
"""A deed with less flow than this is not looked at."""


@dataclass(frozen=True)
class FlowCut:
    """A set that plans enter: as much flows in as is done there, a visit (by its index) or a deed."""

    inside: frozenset[int]
    visit: int = -1
    deed: Key = ()


def row_of(layers: Layers, cut: FlowCut) -> FlowRow:
    """Returns the row of a cut.

    Raises `ValueError` where the set is one that a plan need not enter: it has the start in it,
    or not all the nodes of the visit.
    """
    inside = cut.inside
    if layers.start in inside:
        raise ValueError("the start is in the set")
    factors: dict[int, int] = {}
    times = 1 if cut.visit >= 0 else layers.times[cut.deed]
    tails, entering = layers.tails, layers.entering()
    for node in inside:
        for column in entering[node]:
            if tails[column] not in inside:
                factors[column] = times
    if cut.visit >= 0:
        if not layers.visits[cut.visit].inside <= inside:
            raise ValueError("not all the nodes of the visit are in the set")
        return FlowRow(1, None, tuple(sorted(factors.items())))
    for column in layers.deeds[cut.deed]:
        if layers.tails[column] in inside:
            factors[column] = factors.get(column, 0) - 1
    return FlowRow(0, None, tuple(sorted(factors.items())))


class _View:
    """The graph with some of its modes thrown together; nodes are numbers of their own."""

    def __init__(self, layers: Layers, kind: str) -> None:
        self.layers = layers
        names: dict[object, int] = {}
        self.of: list[int] = []
        for index, (mode, place) in enumerate(layers.places):
            found = layers.modes[mode] if mode >= 0 else None
            name: object = (index, "sink")
            if found is not None:
                told = {"place": 0, "lead": found.lead, "hands": found.hands, "mode": mode}
                name = (place, told[kind])
            self.of.append(names.setdefault(name, len(names)))
        self.members: list[list[int]] = [[] for _ in names]
        for index, name in enumerate(self.of):
            self.members[name].append(index)
        self.start = self.of[layers.start]

    def cuts(self, flow: dict[int, int]) -> Iterator[FlowCut]:
        """Yields a cut for every visit and deed for which too little flows from the start."""
        layers, of = self.layers, self.of
        arcs: dict[tuple[int, int], int] = {}
        for column, amount in flow.items():
            arc = of[layers.tails[column]], of[layers.heads[column]]
            if arc[0] != arc[1]:
                arcs[arc] = arcs.get(arc, 0) + amount
        one = _together(arcs, _SCALE)
        start = one.get(self.start, self.start)
        members: dict[int, set[int]] = {}
        for node, name in one.items():
            members.setdefault(name, set()).add(node)
        net = Net()
        for (tail, head), amount in arcs.items():
            net.join(one[tail], one[head], amount)

        def set_of(near: set[int]) -> frozenset[int]:
            return self.whole({node for name in near for node in members.get(name, (name,))})

        for index, visit in enumerate(layers.visits):
            ends = {of[node] for node in visit.inside}
            names = {one.get(node, node) for node in ends}
            if start not in names and self.start not in ends:
                amounts = dict.fromkeys(names, 4 * _SCALE)
                near = net.short(start, amounts, _SCALE - _LACK)
                if near is not None:
                    yield FlowCut(set_of(near | names) | self.whole(ends), visit=index)
        for key, times in layers.times.items():
            columns = [column for column in layers.deeds.get(key, ()) if column in flow]
            total = sum(flow[column] for column in columns)
            if total < _LITTLE:
                continue
            amounts = {}
            for column in columns:
                tail = of[layers.tails[column]]
                tail = one.get(tail, tail)
                amounts[tail] = amounts.get(tail, 0) + flow[column]
            share = {node: -(-amount // times) for node, amount in amounts.items()}
            near = net.short(start, share, total // times - _LACK)
            if near:
                yield FlowCut(set_of(near), deed=key)

    def whole(self, nodes: set[int]) -> frozenset[int]:
        """Returns the nodes of the graph that these stand for."""
        return frozenset(node for name in nodes for node in self.members[name])


def _together(arcs: dict[tuple[int, int], int], enough: int) -> dict[int, int]:
    """Returns for each node the name of those that no set with a flow in of less than ``enough`` parts.

    As much flows out of a set as flows in, so an arc with ``enough`` on it has both its ends inside
    or both outside.  Arcs between the same groups add up, until nothing more can be thrown together.
    """
    one = {node: node for arc in arcs for node in arc}
    while True:
        changed = False
        sums: dict[tuple[int, int], int] = {}
        for (tail, head), amount in arcs.items():
            arc = _name(one, tail), _name(one, head)
            if arc[0] != arc[1]:
                sums[arc] = sums.get(arc, 0) + amount
        for (tail, head), amount in sums.items():
            if amount >= enough:
                tail, head = _name(one, tail), _name(one, head)
                changed |= tail != head
                one[tail] = head
        if not changed:
            return {node: _name(one, node) for node in one}
        arcs = sums


def _name(one: dict[int, int], node: int) -> int:
    """Returns the name of the group that a node is in."""
    while one[node] != node:
        one[node] = one[one[node]]
        node = one[node]
    return node


class Separator:
    """Finds cuts of one graph."""

    def __init__(self, layers: Layers) -> None:
        self.layers = layers
        self.views = [_View(layers, kind) for kind in ("place", "lead", "hands", "mode")]

    def cuts(self, values: Sequence[float]) -> list[FlowCut]:
        """Returns cuts that the flow ``values`` violates, none where it keeps to all there are."""
        flow: dict[int, int] = {}
        for column in range(len(self.layers.tails)):
            amount = round(values[column] * _SCALE)
            if amount > 2:
                flow[column] = amount
        *coarse, fine = self.views
        found = [cut for view in coarse for cut in view.cuts(flow)]
        return list(dict.fromkeys(found or fine.cuts(flow)))
