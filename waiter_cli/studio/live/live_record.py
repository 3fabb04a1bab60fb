"""Deeds of an evening since it began, for a scenario of it. Class `LiveRecord`."""

from __future__ import annotations

from typing import Any

from waiter_cli.execution.executive import Executive
from waiter_cli.serve.session import Session

__all__ = ["LiveRecord"]

MOST_DEEDS = 20_000


class LiveRecord:
    """``deeds`` since ``begin_state``, with the time of each; it begins anew once they are too many."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._begin_time = 0.0
        self._begin(session.executive)

    def _begin(self, executive: Executive) -> None:
        self.begin_state, self.begin_goals = executive.state, executive.goals
        self.deeds: list[tuple[float, dict[str, Any]]] = []

    def note(self, time: float, deed: dict[str, Any]) -> None:
        """Keeps what happened at a time: a line of a person, or what a robot saw by itself."""
        if len(self.deeds) >= MOST_DEEDS:
            self._begin(self._session.executive)
            self._begin_time = time
            return
        self.deeds.append((time - self._begin_time, deed))
