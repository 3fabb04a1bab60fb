"""Drives the robot from node to node: round what blocks the way, or back. Class `Driver`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from waiter_cli.room.motion import way
from waiter_cli.room.room import Room
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import Body, OngoingAction, Shown, SimulatedClock
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.outcome import TICKS, BlockedEdge, Rules, RunEnded
from waiter_cli.simulation.world import Violation, World

__all__ = ["PATIENCE", "Driver"]

PATIENCE = 30.0
"""Seconds to wait for a way that is blocked before giving up."""


class Driver:
    """Takes the robot along edges, by the rules of a run for what stands in the way."""

    def __init__(
        self,
        room: Room,
        rules: Rules,
        *,
        clock: SimulatedClock,
        body: Body,
        world: World,
        blocks: Blocks,
        deliberation: Deliberation,
        ongoing: OngoingAction,
        reporter: Reporter,
        shown: Shown,
    ) -> None:
        self._room, self._rules, self._clock, self._body = room, rules, clock, body
        self._world, self._blocks, self._deliberation = world, blocks, deliberation
        self._ongoing, self._reporter, self._shown = ongoing, reporter, shown

    def drive(self, goal: str) -> str | None:
        """Drives to a neighbour node, or round what blocks the way; returns why it did not get there.

        When it did not, the robot is back at the node it came from.
        """
        here = self._world.robot
        began, paused = self._clock.ticks, self._body.paused
        path: tuple[str, ...] = (here, goal)
        at, allowed = 0, 0.0
        while at < len(path) - 1:
            a, b = path[at], path[at + 1]
            block: str | BlockedEdge | None = self._blocks.on(a, b)
            if block is None:
                allowed += self._allowed(a, b)
                block = self._leg(a, b)
            if isinstance(block, BlockedEdge):
                found = self._meet(block, a, goal)
                if found == (a, goal):  # waited
                    continue
                self.back_to((a,))
                allowed += self._allowed(a, b)
                if isinstance(found, tuple):
                    path = (*path[:at], *found)
                    continue
                block = found
            if isinstance(block, str):
                self.back_to(path[at::-1])
                return block
            at += 1
            if path[at] != goal:
                self._reporter.say("arrived", node=path[at], detour=True)
        if self._rules.drive == "physics":
            self._body.settle(self._room.nodes[goal])
        took = (self._clock.ticks - began - (self._body.paused - paused)) / TICKS
        if took > allowed:
            late = f"{goal} was reached {took - allowed:.1f} s late"
            self._reporter.fail(Violation("arrival", late))
        return None

    def back_to(self, nodes: Sequence[str]) -> None:
        """Drives back to each node in turn, whatever comes."""
        self._ongoing.abandoned = False
        for node in nodes:
            at = self._room.nodes[node]
            if self._body.away(at) > 0.01:
                for move in way(self._body.pose, at, self._rules.speed):
                    self._body.play(move)
                    self._ongoing.abandoned = False
                if self._rules.drive == "physics":
                    self._body.settle(at)

    def _allowed(self, a: str, b: str) -> float:
        """Returns the seconds that an edge may take."""
        return 1.5 * self._room.length(a, b) / self._rules.speed + 4.0

    def _leg(self, a: str, b: str) -> str | BlockedEdge | None:
        """Drives along one edge; returns a block ahead on it, or why it was broken off."""

        def ahead() -> BlockedEdge | None:
            return self._blocks.ahead(a, b)

        for move in way(self._body.pose, self._room.nodes[b], self._rules.speed):
            ended = self._body.play(move, ahead if move.kind == "drive" else None)
            if ended is not None:
                return ended
        return None

    def _meet(self, block: BlockedEdge, here: str, goal: str) -> tuple[str, ...] | str:
        """Decides about a blocked edge: returns the way round it, or why to give up going there."""
        shut = {frozenset(b.edge) for b in self._blocks.standing()}
        other = self._room.route(here, goal, shut, set(self._world.staff.values()))
        block.told = True
        edge = "-".join(block.edge)
        details: dict[str, Any] = {"edge": edge, "by": block.name}
        if self._rules.on_failure == "replan" and other is not None:
            self._reporter.say("blocked", **details, answer="reroute", route=list(other))
            self._shown.banner = f"{edge} is blocked: going round by {' '.join(other[1:])}"
            self._body.hold(0.8)
            self._shown.banner = ""
            return other
        if self._rules.on_failure == "stop":
            self._reporter.say("blocked", **details, answer="stop")
            return f"{edge} is blocked"
        if self._rules.on_failure == "replan" and self._deliberation.avoid(shut):
            self._reporter.say("blocked", **details, answer="replan")
            return f"{edge} is blocked"
        self._reporter.say("blocked", **details, answer="wait")
        return self._wait(block, edge) or (here, goal)

    def _wait(self, block: BlockedEdge, edge: str) -> str | None:
        """Waits until an edge is clear; returns why no longer, raises `RunEnded` after `PATIENCE`."""
        self._shown.banner = f"{edge} is blocked: waiting"
        began = self._clock.time
        while block.standing:
            self._body.hold(0.5)
            if self._ongoing.abandoned:
                self._shown.banner = ""
                return "the plan has changed"
            if self._clock.time - began > PATIENCE:
                raise RunEnded("gave_up", f"gave up: {edge} stayed blocked for {PATIENCE:.0f} s")
        self._shown.banner = ""
        return None
