"""Keeps what is believed during a run: `Belief`, at the next step; events lead to another one.

Nothing here plans.  A timetable counts from the start of the run, so the layout of a later step has
a shorter one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Fact, Observation, State
from waiter_cli.model.timetable import put_off
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.rulebook import HOUSE, Rulebook

__all__ = ["TRAIL", "Belief", "is_elsewhere"]

TRAIL = 64
"""So many of the agent's last places are kept, for diagnosis."""


@dataclass(frozen=True)
class Belief:
    """The state at ``step``, the next one, and the action that is running there.

    ``trail`` has the agent's places at earlier steps, oldest first; ``facts`` hold for good.
    """

    layout: Layout
    state: State
    step: int = 0
    running: Action | None = None
    trail: tuple[tuple[int, str], ...] = ()
    instant_kitchen: bool = False
    rules: Rulebook = HOUSE
    facts: tuple[Fact, ...] = ()

    def layout_at(self, step: int) -> Layout:
        """Returns the layout whose timetable counts from ``step``."""
        table = self.layout.timetable
        if not table or step == 0:
            return self.layout
        later = tuple((who, at - step, node) for who, at, node in table if at > step)
        return replace(self.layout, timetable=later)

    def world(self) -> Problem:
        """Returns a problem without goals, for the rules: the state at its step 0."""
        layout = self.layout_at(self.step)
        kitchen = self.instant_kitchen
        return Problem(
            layout, self.state, (), self.state, (), instant_kitchen=kitchen, facts=self.facts
        )

    def after(self, action: Action | None) -> State | Illegal:
        """Returns the state at the next step when ``action`` is done (None:
        nothing), or why there is none.
        """
        world = self.world()
        try:
            if action is None:
                return self.rules.after(world, self.state, (), 0)
            if action.name == "go_to" and action.arguments[1] == self.state.agent:
                return self.rules.after(world, self.state, (), 0)  # seen to have arrived already
            return self.rules.after(world, self.state, (action,), 0)
        except Illegal as fault:
            return fault

    def held_up(self) -> Belief:
        """Returns the same where the agent stays for another step: who is due on its
        node comes later.
        """
        table, posts = self.layout.timetable, dict(self.state.waiters)
        later = put_off(posts, table, self.step + 1, self.state.agent)
        if later == table:
            return self
        return replace(self, layout=replace(self.layout, timetable=later))

    def after_failure(self) -> State:
        """Returns the state at the next step when nothing came of it; only the timetable goes on."""
        waited = self.held_up().after(None)
        return self.state if isinstance(waited, Illegal) else waited

    def ahead(self) -> tuple[int, State, Action | None]:
        """Returns the step from which to plan, the state there, and a running action
        that cannot end.
        """
        if self.running is None:
            return self.step, self.state, None
        after = self.after(self.running)
        if isinstance(after, Illegal):
            return self.step + 1, self.after_failure(), self.running
        return self.step + 1, after, None

    def passed(self, after: State) -> Belief:
        """Returns the belief one step later."""
        trail = (*self.trail, (self.step, self.state.agent))[-TRAIL:]
        return replace(self, state=after, step=self.step + 1, running=None, trail=trail)

    def with_arrival(self, seen: Sequence[Observation]) -> State:
        """Returns the state; with the robot where it is walking to, when it was seen there."""
        walk = self.running
        if walk is None or walk.name != "go_to":
            return self.state
        there = walk.arguments[1]
        arrived = any(o.kind == "at" and o.arguments == ("agent", there) for o in seen)
        return replace(self.state, agent=there) if arrived else self.state


def is_elsewhere(state: State, seen: Sequence[Observation]) -> bool:
    """Returns whether somebody was seen at another place than was believed."""
    places = {"agent": state.agent, **dict(state.waiters)}
    told = [o.arguments for o in seen if o.kind == "at"]
    return any(places.get(who) not in (None, node) for who, node in told)
