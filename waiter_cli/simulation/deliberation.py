"""Connects a run with its controller, and detects where they disagree. Class `Deliberation`."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from typing import Any

from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.protocols import Controller
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Observation
from waiter_cli.simulation.body import OngoingAction
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.outcome import BlockedEdge, RunEnded, differences, pending_document
from waiter_cli.simulation.world import Violation, World

__all__ = ["Deliberation"]


class Deliberation:
    """A controller as a run deals with it: changes of plan are said, what is not believed ends it.

    ``replans`` counts the changes, ``late`` the decisions that were not settled within a limit.
    """

    def __init__(
        self,
        mind: Controller,
        layout: Layout,
        world: World,
        ongoing: OngoingAction,
        reporter: Reporter,
    ) -> None:
        self.mind = mind
        self.replans = self.late = 0
        self._layout, self._world = layout, world
        self._ongoing, self._reporter = ongoing, reporter
        self._edges = layout.edges  # those that are planned with
        self._avoided: set[frozenset[str]] | None = None

    def observe(self, seen: Sequence[Observation]) -> Decision:
        """Tells what is seen; raises `RunEnded` where it is not believed."""
        try:
            decision = self.mind.observe(seen)
        except Refused as refused:
            raise self._disbelieved("what was seen", refused) from None
        if self._ongoing.action is not None and decision.abandoned is not None:
            self._ongoing.abandoned = True
        return decision

    def done(self, step: int) -> None:
        """Tells that a step is done; raises `RunEnded` where it is not believed."""
        try:
            self.mind.done(step)
        except Refused as refused:
            raise self._disbelieved("what was done", refused) from None

    def failed(self, step: int, why: str) -> None:
        """Tells that a step failed, and plans round what is to be avoided since."""
        self.mind.failed(step, why)
        if self._avoided is not None:
            self.plan_without(self._avoided)
            self._avoided = None

    def _disbelieved(self, what: str, refused: Refused) -> RunEnded:
        self._reporter.fail(Violation("effects", f"{what} is not believed: {refused.message}"))
        return RunEnded("failed", refused.message)

    def compare(self) -> None:
        """Compares the world with what is believed of it; raises `RunEnded` where they differ."""
        different = differences(self._world.state(), self.mind.state)
        if different:
            why = f"the world is not as predicted: {different}"
            self._reporter.fail(Violation("effects", why))
            raise RunEnded("failed", why)

    def tell(self, revision: int, why: str) -> None:
        """Says that the plan has changed since a revision, where it has."""
        decision = self.mind.decision
        if decision.revision == revision:
            return
        self.replans += 1
        self.late += decision.status == "undecided"
        extra: dict[str, Any] = {}
        if decision.pending:
            extra["pending"] = [pending_document(wish) for wish in decision.pending]
        self._reporter.say(
            "replan", reason=why, status=decision.status,
            plan=[action.text for action in decision.plan], **extra,
        )  # fmt: skip

    # ------------------------------------------------------------ edges

    def plan_without(self, shut: set[frozenset[str]]) -> None:
        """Has the controller plan without the shut edges."""
        changed = self._without(shut)
        self._edges = changed.edges
        self.mind.change_layout(self._layout if changed.edges == self._layout.edges else changed)

    def reopen(self, blocks: Sequence[BlockedEdge]) -> None:
        """Plans again with whatever is no longer blocked; ``blocks`` are those that stand."""
        if self._edges == self._layout.edges:
            return
        revision = self.mind.decision.revision
        self.plan_without({frozenset(block.edge) for block in blocks if block.told})
        self.tell(revision, "the way is clear again")

    def avoid(self, shut: set[frozenset[str]]) -> bool:
        """Returns whether a plan needs none of the shut edges and gives nothing up for it.

        Where one does, they are planned without as soon as the ongoing action has `failed`.
        """
        mind = copy(self.mind)
        had = len(mind.decision.pending)
        if self._ongoing.action is not None:
            mind.failed(self._ongoing.action.step, "blocked")
        decision = mind.change_layout(self._without(shut))
        if not decision.plan or len(decision.pending) > had:
            return False
        self._avoided = shut
        return True

    def _without(self, shut: set[frozenset[str]]) -> Layout:
        edges = tuple(edge for edge in self._layout.edges if frozenset(edge) not in shut)
        return replace(self._layout, edges=edges, edge_where=())
