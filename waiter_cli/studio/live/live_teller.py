"""Tells the page of an evening: who is where, plan, proof, events, surprises. Class `LiveTeller`.

``{"view": …}`` (plan, proof, what waits) is told as soon as it has changed, ``{"world": change}`` at most
`FRAMES` times a second, ``{"event": …}`` as it comes.
"""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Callable
from typing import Any

from waiter_cli.domain_execution.vocabulary import vocabulary_of
from waiter_cli.model.state import Observation
from waiter_cli.pictures.event_text import event_by_whom
from waiter_cli.pictures.moments import MomentDiffer
from waiter_cli.pictures.snapshot import take
from waiter_cli.serve.session import Session
from waiter_cli.simulation.run import Run
from waiter_cli.studio.live.film_reel import FilmReel
from waiter_cli.studio.live.live_view import own_words, stories, view_of
from waiter_cli.studio.live.pace import Pace
from waiter_cli.studio.live.plan_list import PlanList
from waiter_cli.studio.opened import Opened

__all__ = ["LiveTeller"]

FRAMES = 20
"""So many times a second the page is told who is where."""
QUIET = 0.25
"""Seconds after which the page is told the time although nothing has moved."""
MOST_EVENTS = 300
BAD_EVENTS = ("collision", "action_failed", "precondition_failed", "blocked")


class LiveTeller:
    """Tells ``tell`` what has changed in ``run``, which is set before anything is told."""

    run: Run

    def __init__(self, opened: Opened, session: Session, pace: Pace) -> None:
        self.tell: Callable[[dict[str, Any]], None] = lambda told: None
        self.reel = FilmReel()
        self.plan = PlanList(session)
        self.stale = True  # the view has changed since it was told
        self._opened, self._session, self._pace = opened, session, pace
        self._newer = False  # the layout's file holds another text by now
        self._told = 0.0  # when the page was told last
        self._events: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)  # as the page lists them
        self._stories: dict[str, Any] | None = None
        self._differ = MomentDiffer()
        domain, state = opened.planner.domain, session.executive.state
        self._vocabulary = vocabulary_of(domain, opened.layout, state)

    # ------------------------------------------------------------ what is to be told

    def note_saved(self, text: str) -> None:
        """Tells the page whether the layout's file holds another text than that of this evening."""
        self._newer, self.stale = text != self._opened.text, True

    def note_change(self) -> None:
        """Begins the list anew where the plan before was done and there is another."""
        self.stale = True
        self.plan.changed()

    def event(self, line: str) -> None:
        """Keeps an event of the run, and lists it where there are words for it."""
        event = json.loads(line)
        self.reel.event(event)
        said = event_by_whom(event)
        if said is not None:
            self._list({"t": event["t"], "text": said, "bad": event["type"] in BAD_EVENTS})

    def say(self, text: str, bad: bool = False) -> None:
        """Lists something that is no event of the run."""
        self._list({"t": round(self.run.clock.time, 3), "text": text, "bad": bad})

    def _list(self, event: dict[str, Any]) -> None:
        self._events.append(event)
        self.tell({"event": event})

    def explain(self, seen: tuple[Observation, ...]) -> None:
        """Notes how what was seen can have come about, in words."""
        found = self._session.executive.decision.diagnosis
        if not found:
            return
        told = [" ".join(one.arguments) for one in seen if one.kind == "at"]
        self._stories = {"seen": told, "stories": stories([each.text for each in found])}
        for one in self._stories["stories"][:1]:
            self.say(f"that surprises the robot; the likeliest story: {one}")

    def forget_stories(self) -> None:
        """Tells of no surprise any more."""
        self._stories = None

    # ------------------------------------------------------------ telling

    def is_due(self, now: float) -> bool:
        """Returns whether the page is to see another frame."""
        return now - self._told >= 1 / FRAMES

    def show(self, now: float) -> None:
        """Tells what has changed since the last time: who is where first, then what is said of it."""
        change = self._differ.change(take(self.run), rows=self.plan.rows())
        if change is not None:
            self.reel.add(change, self._differ.moment)
        if change is not None or now - self._told >= QUIET:
            self._told = now
            self.tell({"world": change or [round(self.run.clock.time, 3), {}, []]})
        if self.stale:
            self.stale = False
            self.tell({"view": self.view()})

    def view(self) -> dict[str, Any]:
        """Returns what the page lists beside the floor."""
        rows = self.plan.rows()
        current = next((i for i, row in enumerate(rows) if row[1] in ("now", "next")), None)
        found = view_of(self._session.executive, self._opened.planner)
        for robot in found["robots"]:
            robot["doing"] = self.plan.doing(robot["name"])
            robot["at_step"] = self.plan.step_of(robot["name"])
        return {
            **found,
            "own": own_words(self._vocabulary, self._session.executive.state),
            "rows": rows,
            "current": current,
            "playing": self._pace.playing,
            "speed": self._pace.speed,
            "time": round(self.run.clock.time, 3),
            "begin": round(self.reel.begin, 3),
            "surprise": self._stories,
            "newer": self._newer,
        }

    def whole(self) -> list[dict[str, Any]]:
        """Returns what somebody is told who has just come."""
        moment = self._differ.moment
        return [
            {"view": self.view()},
            *({"event": event} for event in self._events),
            {"world": [round(self.run.clock.time, 3), moment, []], "whole": True},
        ]
