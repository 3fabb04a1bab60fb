"""The graph that a plan is a walk through: its nodes are pairs of a mode and a place.

`Layers` is what `layer_builder` makes.  Arcs are walks inside a mode and deeds, which change the mode
and cost nothing here: their steps are counted in `OrderedJobs.deeds`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from waiter_cli.flow_bounds.modes import FlowRow, Key, Mode, VisitSet

__all__ = ["Layers"]


@dataclass
class Layers:
    """Nodes, arcs and rows; arc k is column k, columns for who sits where come after the arcs.

    ``deeds`` are the arcs of each key, ``times`` how often its deed occurs (seats: at most).
    """

    modes: list[Mode] = field(default_factory=list)
    places: list[tuple[int, int]] = field(default_factory=list)  # (index of mode, node)
    number: dict[tuple[int, int], int] = field(default_factory=dict)
    tails: list[int] = field(default_factory=list)
    heads: list[int] = field(default_factory=list)
    costs: list[int] = field(default_factory=list)
    keys: list[Key] = field(default_factory=list)  # of each column; ("walk",) for a walk
    deeds: dict[Key, list[int]] = field(default_factory=dict)
    times: dict[Key, int] = field(default_factory=dict)
    rows: list[FlowRow] = field(default_factory=list)
    visits: list[VisitSet] = field(default_factory=list)
    start: int = 0
    sink: int = 0
    _entering: list[list[int]] = field(default_factory=list)

    def entering(self) -> list[list[int]]:
        """Returns the arcs that lead to each node; there are no more once it was asked for."""
        if not self._entering:
            self._entering = [[] for _ in self.places]
            for column, head in enumerate(self.heads):
                self._entering[head].append(column)
        return self._entering

    def arc(self, tail: int, head: int, cost: int, key: Key) -> int:
        """Adds an arc; returns its column."""
        self.tails.append(tail)
        self.heads.append(head)
        self.costs.append(cost)
        self.keys.append(key)
        if key[0] != "walk":
            self.deeds.setdefault(key, []).append(len(self.tails) - 1)
        return len(self.tails) - 1
