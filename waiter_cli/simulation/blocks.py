"""Strangers who block edges: their times, and whether one stands ahead. Class `Blocks`."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

from waiter_cli.model.layout import Point
from waiter_cli.room.room import Room
from waiter_cli.simulation.body import Body, SimulatedClock
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.outcome import BlockedEdge

__all__ = ["Blocks"]

STOP_SHORT = 0.75
"""Metres between the middle of the robot and whoever blocks its way."""
OVER = -1.0
"""The end of a block that has been."""


class Blocks:
    """Blocked edges, those that have been and those that are to come among them."""

    def __init__(
        self, room: Room, crowd: Crowd, clock: SimulatedClock, body: Body, reporter: Reporter
    ) -> None:
        self._room, self._crowd, self._clock = room, crowd, clock
        self._body, self._reporter = body, reporter
        self._blocks: list[BlockedEdge] = []

    def add(self, edge: tuple[str, str], seconds: float | None) -> None:
        """Sends a stranger to stand on an edge from now on, for so long; None: for good."""
        now = self._clock.time
        until = None if seconds is None else now + seconds
        self._blocks.append(BlockedEdge(edge, f"stranger{len(self._blocks) + 1}", now, until))

    def end(self, edge: tuple[str, str]) -> None:
        """Has whoever stands on an edge, or is about to, go at the next tick."""
        for block in self._blocks:
            if set(block.edge) == set(edge) and block.until != OVER:
                block.until = self._clock.time

    def standing(self) -> list[BlockedEdge]:
        """Returns the blocks in which somebody stands now."""
        return [block for block in self._blocks if block.standing]

    def on(self, a: str, b: str) -> BlockedEdge | None:
        """Returns the block on an edge, None where it is clear."""
        return next((block for block in self.standing() if set(block.edge) == {a, b}), None)

    def ahead(self, a: str, b: str, body: Body | None = None) -> BlockedEdge | None:
        """Returns the block right before the robot, or another ``body``, on its way from ``a`` to ``b``."""
        block = self.on(a, b)
        if block is None:
            return None
        body = body or self._body
        who, end = self._crowd.people[block.name], self._room.nodes[b]
        beyond = hypot(who.x - end[0], who.y - end[1]) < body.away(end)
        return block if beyond and body.away((who.x, who.y)) < STOP_SHORT else None

    def update(self, reopened: Callable[[], None]) -> None:
        """Lets strangers come where there is room for them, and go; then calls ``reopened``."""
        now = self._clock.time
        for block in self._blocks:
            over = block.until is not None and block.until <= now
            if block.standing and over:
                block.standing, block.until = False, OVER
                self._crowd.remove(block.name)
                self._reporter.say("unblocked", edge="-".join(block.edge))
                reopened()
            elif not block.standing and block.until != OVER and block.time <= now:
                if over:
                    block.until = OVER
                elif self._body.away(self._middle(block)) >= STOP_SHORT + 0.05:
                    block.standing = True
                    self._crowd.add(block.name, "stranger", self._middle(block))

    def _middle(self, block: BlockedEdge) -> Point:
        a, b = (self._room.nodes[node] for node in block.edge)
        return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
