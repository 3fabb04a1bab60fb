"""The plan as the page lists it: what is behind us, and what remains. Class `PlanList`."""

from __future__ import annotations

import dataclasses
from typing import Any

from waiter_cli.execution.executive import Executive
from waiter_cli.serve.session import Session
from waiter_cli.studio.live.live_view import PlannedAction, planned_words

__all__ = ["PlanList"]

MOST_PAST = 40


@dataclasses.dataclass
class _Past:
    """An action that has begun: ``state`` is now, done or failed."""

    planned: PlannedAction
    state: str


class PlanList:
    """The rows of a plan; ``robots`` are their names where there are several."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._robots = [name for name, _ in session.executive.layout.agents]
        self._past: list[_Past] = []
        self._over = True  # the plan at hand is done
        self._known: tuple[Executive, list[PlannedAction]] | None = None

    def started(self, step: int, robot: str) -> None:
        """Notes that an action has begun."""
        for planned in planned_words(self._session.executive, self._session.thinker.domain):
            if (planned.step, planned.robot) == (step, robot):
                self._past.append(_Past(planned, "now"))
                return

    def ended(self, kind: str, step: int, robot: str) -> None:
        """Notes that an action is ``done`` or ``failed``."""
        for row in self._past:
            if row.state == "now" and (row.planned.step, row.planned.robot) == (step, robot):
                row.state = kind
                del self._past[:-MOST_PAST]
                return

    def changed(self) -> None:
        """Begins the list anew where the plan before was done and there is another."""
        busy = self._session.executive.decision.horizon > 0
        if busy and self._over:
            self._past = [row for row in self._past if row.state == "now"]
        self._over = not busy

    def rows(self) -> list[list[Any]]:
        """Returns each action in words with its state (done, failed, now, next).

        Of several robots the name stands before the words, and the number of the robot behind the state.
        """
        past = [self._row(row.planned, row.state) for row in self._past]
        return past + [self._row(planned, "next") for planned in self._ahead()]

    def doing(self, robot: str) -> str:
        """Returns what a robot does, in words; empty where it does nothing."""
        now = (row.planned for row in self._past if row.state == "now")
        return next((planned.words for planned in now if planned.robot == robot), "")

    def step_of(self, robot: str) -> int | None:
        """Returns the step that a robot is at, None where it is at none."""
        now = (row.planned for row in self._past if row.state == "now")
        return next((each.step for each in now if each.robot == robot), None)

    def _ahead(self) -> list[PlannedAction]:
        """Returns what nobody has begun."""
        executive = self._session.executive
        if self._known is None or self._known[0] is not executive:
            words = planned_words(executive, self._session.thinker.domain)
            self._known = executive, words
        now = {(r.planned.step, r.planned.robot) for r in self._past if r.state == "now"}
        left = self._known[1] if executive.decision.plan else []
        return [each for each in left if (each.step, each.robot) not in now]

    def _row(self, planned: PlannedAction, state: str) -> list[Any]:
        if not self._robots:
            return [planned.words, state]
        number = self._robots.index(planned.robot)
        return [f"{planned.robot}: {planned.words}", state, number]
