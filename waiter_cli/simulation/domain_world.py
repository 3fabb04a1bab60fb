"""The simulated restaurant of a domain of one's own: each step is computed by its program. Class `DomainWorld`."""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Fact, Goal, Observation, State
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.rulebook import Rulebook
from waiter_cli.simulation.world import Violation, World

__all__ = ["DomainWorld"]


class DomainWorld(World):
    """A world whose actions and happenings a domain plays; ``fluents`` are those that only it knows."""

    def __init__(
        self,
        layout: Layout,
        state: State,
        rules: Rulebook,
        instant_kitchen: bool = False,
        facts: tuple[Fact, ...] = (),
    ) -> None:
        super().__init__(layout, state, instant_kitchen)
        self.facts = facts
        self.fluents = state.fluents
        self._rules = rules
        self._still = replace(layout, timetable=())  # colleagues are moved by `tick_over`

    def state(self) -> State:
        """Returns the world in the words of a state, the domain's own fluents included."""
        return replace(super().state(), fluents=self.fluents)

    def breach(self, action: Action) -> Violation | None:
        """Returns why an action cannot be done now, by the domain; None when it can."""
        try:
            self._after(action)
        except Illegal as fault:
            return Violation("preconditions", fault.reason)
        return None

    def perform(self, action: Action) -> None:
        """The effects of an action that `breach` allows."""
        self.changes += 1
        self.become(self._after(action))

    def suffer(self, seen: Observation) -> str | None:
        """Applies what happens; returns why it cannot be, None when done."""
        before = self.state()
        if seen.kind == "obs":
            self.changes += 1
        else:
            refusal = super().suffer(seen)
            if refusal is not None:
                return refusal
        after, reasons = self._rules.observe(before, (seen,), self._still)
        if reasons:
            self.become(before)
            return reasons[0].message
        self.become(after)
        return None

    def met(self, goal: Goal) -> bool:
        """Returns whether a goal holds now; of a fluent the domain is asked."""
        if goal.fluent is None:
            return super().met(goal)
        return self._rules.holds(goal, self.state(), self._problem(self.state()))

    def _after(self, action: Action) -> State:
        now = self.state()
        return self._rules.after(self._problem(now), now, (action,), 0)

    def _problem(self, state: State) -> Problem:
        kitchen = self.instant_kitchen
        return Problem(self._still, state, (), state, (), instant_kitchen=kitchen, facts=self.facts)

    def become(self, state: State) -> None:
        """Does the same as `World.become`; who sits where he sat keeps his chair."""
        changes, late, old = self.changes, self.late, self.tables
        layout, rules = self.layout, self._rules
        DomainWorld.__init__(self, layout, state, rules, self.instant_kitchen, self.facts)
        self.changes, self.late = changes, late
        for name, place in self.tables.items():
            if place.party == old[name].party:
                place.seats = old[name].seats
