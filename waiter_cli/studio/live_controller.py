"""The robot's half of the live loop: what it reports becomes lines of the same run. Class `LiveController`.

A `Run` of the simulation asks and tells it as it would an executive; each report goes through the
`Session`, so that it is in the journal before it counts, just like what a person says.
"""

from __future__ import annotations

import copy
import json
import time
from collections.abc import Callable, Sequence
from typing import Any

from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.files.documents import observation_document
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Observation, State
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.session import Session

__all__ = ["LiveController"]


class LiveController:
    """A `Controller` over a `Session`; ``changed`` is told each report's kind and step, ``noted`` what is seen."""

    def __init__(
        self,
        session: Session,
        changed: Callable[[str, int], None],
        noted: Callable[[dict[str, Any]], None],
    ) -> None:
        self._session = session
        self._changed = changed
        self._noted = noted
        self._lines = 0

    def __copy__(self) -> Executive:
        """Returns an executive that is asked what would be, and tells nobody."""
        return copy.copy(self._session.executive)

    @property
    def step(self) -> int:
        """Returns the next step."""
        return self._session.executive.step

    @property
    def state(self) -> State:
        """Returns what is believed at the next step."""
        return self._session.executive.state

    @property
    def decision(self) -> Decision:
        """Returns what is to be done."""
        return self._session.executive.decision

    def observe(self, seen: Sequence[Observation]) -> Decision:
        """Believes what was seen; raises `Refused` where it cannot be."""
        told = [observation_document(one) for one in seen]
        decision = self._tell("observe", told)
        self._noted({"observe": told})
        return decision

    def started(self, step: int) -> Decision:
        """Notes that a step is running."""
        return self._tell("started", step)

    def done(self, step: int) -> Decision:
        """Believes that a step was done; raises `Refused` where it cannot be."""
        return self._tell("done", step)

    def failed(self, step: int, reason: str = "") -> Decision:
        """Believes that a step had no effect."""
        return self._tell("failed", step, reason=reason)

    def drop(self, goal: dict[str, Any]) -> Decision:
        """Wants one thing no longer."""
        return self._tell("drop", goal)

    def change_layout(self, layout: Layout) -> Decision:
        """Plans with the edges of a layout, and no others."""
        executive = self._session.executive
        shut = [edge for edge in executive.layout.edges if edge not in layout.edges]
        opened = [edge for edge in executive.shut if edge in layout.edges]
        for kind, edges in (("block", shut), ("clear", opened)):
            for edge in edges:
                self._tell(kind, list(edge))
        return self.decision

    def _tell(self, kind: str, value: Any, **more: Any) -> Decision:
        self._lines += 1
        step = self.step
        data = json.dumps({kind: value, **more}).encode()
        line = ReceivedLine(self._lines, data, time.perf_counter())
        answer = json.loads(self._session.handle(line))
        if "error" in answer:
            raise Refused(answer["error"]["message"], answer["error"].get("hint"))
        self._changed(kind, step)
        return self.decision
