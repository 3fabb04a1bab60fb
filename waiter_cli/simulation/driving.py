"""Driving from node to node: round what blocks the way, or back. Class `Driver`."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from math import hypot
from typing import Any

from waiter_cli.model.plan import Action
from waiter_cli.room.motion import way
from waiter_cli.simulation.news import Happenings
from waiter_cli.simulation.outcome import TICKS, BlockedEdge, RunEnded
from waiter_cli.simulation.world import Violation

__all__ = ["Driver"]

PATIENCE = 30.0
"""Seconds to wait for a way that is blocked before giving up."""


class Driver(Happenings):
    """A stage on which the robot drives."""

    def _drive(self, action: Action) -> str | None:
        """Drives to a neighbour node, or round what blocks the way; why it did not get there.

        When it did not, the robot is back at the node it came from.
        """
        goal, here = action.arguments[1], self.world.robot
        began, paused = self.ticks, self._paused
        path: tuple[str, ...] = (here, goal)
        at, allowed = 0, 0.0
        while at < len(path) - 1:
            a, b = path[at], path[at + 1]
            block: str | BlockedEdge | None = self._block_on(a, b)
            if block is None:
                allowed += 1.5 * self.room.length(a, b) / self.rules.speed + 4.0
                block = self._leg(a, b)
            if isinstance(block, BlockedEdge):
                found = self._meet(block, a, goal)
                if found == (a, goal):  # waited
                    continue
                self._back_to((a,))
                allowed += 1.5 * self.room.length(a, b) / self.rules.speed + 4.0
                if isinstance(found, tuple):
                    path, at = (*path[:at], *found), at
                    continue
                block = found
            if isinstance(block, str):
                self._back_to(path[at::-1])
                return block
            at += 1
            if path[at] != goal:
                self._say("arrived", node=path[at], detour=True)
        if self.rules.drive == "physics":
            self._settle(self.room.nodes[goal])
        took = (self.ticks - began - (self._paused - paused)) / TICKS
        if took > allowed:
            self._fail(Violation("arrival", f"{goal} was reached {took - allowed:.1f} s late"))
        return None

    def _leg(self, a: str, b: str) -> str | BlockedEdge | None:
        """Drives along one edge; a block ahead on it, or why it was broken off."""
        for move in way(self.pose, self.room.nodes[b], self.rules.speed):
            ended = self._move(move, (a, b))
            if ended is not None:
                return ended
        return None

    def _back_to(self, nodes: Sequence[str]) -> None:
        """Drives back to each node in turn, whatever comes."""
        self._abandoned = False
        for node in nodes:
            at = self.room.nodes[node]
            if hypot(self.pose[0] - at[0], self.pose[1] - at[1]) > 0.01:
                for move in way(self.pose, at, self.rules.speed):
                    self._move(move)
                    self._abandoned = False
                if self.rules.drive == "physics":
                    self._settle(at)

    def _meet(self, block: BlockedEdge, here: str, goal: str) -> tuple[str, ...] | str:
        """What to do about a blocked edge: the way round it, or why to give up going there."""
        shut = {frozenset(b.edge) for b in self.blocks if b.standing}
        taken = set(self.world.staff.values())
        other = self.room.route(here, goal, shut, taken)
        block.told = True
        edge = "-".join(block.edge)
        details: dict[str, Any] = {"edge": edge, "by": block.name}
        if self.rules.on_failure == "replan" and other is not None:
            self._say("blocked", **details, answer="reroute", route=list(other))
            self.banner = f"{edge} is blocked: going round by {' '.join(other[1:])}"
            self._hold(0.8)
            self.banner = ""
            return other
        if self.rules.on_failure == "stop":
            self._say("blocked", **details, answer="stop")
            return f"{edge} is blocked"
        if self.rules.on_failure == "replan" and self._replannable(shut):
            self._say("blocked", **details, answer="replan")
            self._shut = shut
            return f"{edge} is blocked"
        self._say("blocked", **details, answer="wait")
        self.banner = f"{edge} is blocked: waiting"
        waited = self.time
        while block.standing:
            self._hold(0.5)
            if self._abandoned:
                self.banner = ""
                return "the plan has changed"
            if self.time - waited > PATIENCE:
                raise RunEnded("gave_up", f"gave up: {edge} stayed blocked for {PATIENCE:.0f} s")
        self.banner = ""
        return (here, goal)

    def _replannable(self, shut: set[frozenset[str]]) -> bool:
        """Whether there is a plan that needs none of the shut edges, and nothing is given up for it."""
        mind = copy(self.mind)
        layout = self.problem.layout
        edges = tuple(edge for edge in layout.edges if frozenset(edge) not in shut)
        had = len(mind.decision.pending)
        if self._action is not None:
            mind.failed(self._action.step, "blocked")
        decision = mind.change_layout(replace(layout, edges=edges, edge_where=()))
        return bool(decision.plan) and len(decision.pending) <= had
