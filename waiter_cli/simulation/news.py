"""What comes by itself while a plan is carried out: guests, bills, blocks, stalls. Class `Happenings`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from waiter_cli.execution.decision import Refused
from waiter_cli.files.names import fresh_customers
from waiter_cli.model.state import Observation, Party
from waiter_cli.simulation.guests import names_in_use
from waiter_cli.simulation.injections import Injection
from waiter_cli.simulation.outcome import (
    TICKS,
    BlockedEdge,
    Happening,
    RunEnded,
    differences,
    pending_document,
    sentence,
    told,
)
from waiter_cli.simulation.stage import Stage
from waiter_cli.simulation.world import Violation

__all__ = ["Happenings"]


class Happenings(Stage):
    """A stage on which things happen, and whoever decides is told."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._edges = self.problem.layout.edges  # those that are planned with
        self._coming = self._happenings()
        self._names = fresh_customers(names_in_use(self.problem, self.timed))

    def _happenings(self) -> list[Happening]:
        found = [Happening(e.time, k, e.observations) for k, e in enumerate(self.timed)]
        later = [i for i in self.injections if i.kind != "slip"]
        found += [Happening(i.time, len(found) + k, (), i) for k, i in enumerate(later)]
        return sorted(found, key=lambda h: (h.time, h.order))

    def _happen(self) -> None:
        while self._coming and self._coming[0].time <= self.time + 1e-9:
            happening = self._coming.pop(0)
            self._disturbed = True
            if happening.injection is None:
                self._observed(happening.seen, "observed")
            else:
                self._inject(happening.injection)

    def _wait_for_news(self) -> bool:
        """Waits for what is still to come; False when nothing is, and everybody has come to rest."""
        if self.crowd.busy():
            self._hold(0.25)
            return True
        upcoming = [h.time for h in self._coming] + [
            b.until for b in self.blocks if b.standing and b.until is not None and b.told
        ]
        if not upcoming:
            return False
        if self.watch is None and not self.crowd.followers:
            self.ticks = max(self.ticks, int(min(upcoming) * TICKS) - 1)
        self._hold(max(1 / TICKS, min(0.5, min(upcoming) - self.time)))
        return True

    def _inject(self, injection: Injection) -> None:
        match injection.kind, injection.subject:
            case "block", (a, b):
                until = None if injection.amount is None else self.time + injection.amount
                name = f"stranger{len(self.blocks) + 1}"
                self.blocks.append(BlockedEdge((a, b), name, self.time, until))
                lasting = {} if until is None else {"seconds": injection.amount}
                self._say("injected", kind="block", edge=f"{a}-{b}", **lasting)
            case "stall", _:
                self._say("injected", kind="stall", seconds=injection.amount)
                self._stalled_until = max(
                    self._stalled_until, self.time + (injection.amount or 0.0)
                )
            case "leave", (who,):
                self._observed((Observation("leave", (who,)),), "injected")
            case "enter", (number,):
                party = tuple(next(self._names) for _ in range(int(number)))
                self._observed((Observation("enter", party),), "injected")
            case "bill", (table,):
                self._observed((Observation("bill", (table,)),), "injected")

    def _observed(self, seen: Sequence[Observation], kind: str) -> None:
        """Something happens in the world, and is told to whoever decides."""
        believed: list[Observation] = []
        leaving: list[Party] = []
        heard: list[dict[str, Any]] = []
        for one in seen:
            party = self.world.party_of(one.arguments[0]) if one.kind == "leave" else None
            if one.kind == "at" and one.arguments[0] == "agent" and self._action is not None:
                refusal: str | None = "the robot knows better where it is while it acts"
            else:
                refusal = self.world.suffer(one)
            if refusal is not None:
                self._say(kind, **told(one), ignored=refusal)
                continue
            believed.append(one)
            heard.append(told(one))
            leaving += [party] if party else []
            self._show(one, party)
        if not believed:
            return
        revision = self.mind.decision.revision
        try:
            decision = self.mind.observe(believed)
        except Refused as refused:
            self._fail(Violation("effects", f"what was seen is not believed: {refused.message}"))
            raise RunEnded("failed", refused.message) from None
        if self._action is not None and decision.abandoned is not None:
            self._abandoned = True
        changed = decision.revision != revision
        for each in heard:
            self._say(kind, **each, answer="replan" if changed else "the plan stands")
        for party in leaving:
            self._say("left", party=list(party))
        if self._action is None:
            self._compare()
        self._tell(revision, "; ".join(sentence(one) for one in believed))

    def _show(self, seen: Observation, party: Party | None) -> None:
        """People move as what happened has them move."""
        match seen.kind:
            case "enter":
                self.crowd.wait(seen.arguments, come_in=True)
            case "leave" if party:
                self.crowd.leave(party)
            case "at" if seen.arguments[0] == "agent":
                at = self.room.nodes[seen.arguments[1]]
                self.pose, self._moved = (at[0], at[1], self.pose[2]), True
            case "at":
                self._walk_staff(seen.arguments[0], seen.arguments[1], seconds=0.0)

    def _reopened(self) -> None:
        """What is open again is planned with again."""
        if self._edges == self.problem.layout.edges:
            return
        revision = self.mind.decision.revision
        self._plan_without({frozenset(b.edge) for b in self.blocks if b.standing and b.told})
        self._tell(revision, "the way is clear again")

    def _plan_without(self, shut: set[frozenset[str]]) -> None:
        layout = self.problem.layout
        self._edges = tuple(edge for edge in layout.edges if frozenset(edge) not in shut)
        whole = self._edges == layout.edges
        changed = replace(layout, edges=self._edges, edge_where=())
        self.mind.change_layout(layout if whole else changed)

    def _compare(self) -> None:
        """The world against what is believed of it."""
        real, believed = self.world.state(), self.mind.state
        different = differences(real, believed)
        if different:
            self._fail(Violation("effects", f"the world is not as predicted: {different}"))
            raise RunEnded("failed", f"the world is not as predicted: {different}")

    def _tell(self, revision: int | None, why: str = "") -> None:
        """Says that the plan has changed."""
        decision = self.mind.decision
        if revision is None or decision.revision == revision:
            return
        self._replans += 1
        extra: dict[str, Any] = {}
        if decision.pending:
            extra["pending"] = [pending_document(wish) for wish in decision.pending]
        self._say(
            "replan", reason=why, status=decision.status,
            plan=[action.text for action in decision.plan], **extra,
        )  # fmt: skip
