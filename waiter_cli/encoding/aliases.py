"""Customers under names that come again: problems for a solver that forgets no name. Entry point `Aliases`.

clingo keeps every symbol that it has seen for as long as the process lives.  In a run of days every
guest brings a name of its own, so those who are inside go by numbers in what is solved, in the
order of their names, and get their names back in what comes of it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Observation, State

__all__ = ["Aliases"]

_BY_NAME = ("enter", "leave")


class Aliases:
    """The names of some customers and what they go by, both ways."""

    def __init__(self, customers: Iterable[str], layout: Layout) -> None:
        staff = [who for who, _ in layout.waiters]
        taken = [node.name for node in layout.nodes] + [t.name for t in layout.tables] + staff
        prefix = "guest"
        while any(name.startswith(prefix) for name in taken):
            prefix += "x"
        names = sorted(set(customers))
        self._alias = {name: f"{prefix}{number:03}" for number, name in enumerate(names, 1)}
        self._name = {alias: name for name, alias in self._alias.items()}

    @classmethod
    def of_problem(cls, problem: Problem) -> Aliases:
        """Returns the aliases of all customers of whom a problem speaks."""
        parties = [*problem.state.parties(), *problem.before_observations.parties()]
        goals = [*problem.goals, *(goal for pair in problem.before for goal in pair)]
        parties += [goal.party for goal in goals]
        parties += [
            observation.arguments
            for observation in problem.observations
            if observation.kind in _BY_NAME
        ]
        return cls((name for party in parties for name in party), problem.layout)

    def problem(self, problem: Problem) -> Problem:
        """Returns the same problem under the aliases."""
        return replace(
            problem,
            state=self.state(problem.state),
            before_observations=self.state(problem.before_observations),
            observations=self.seen(problem.observations),
            goals=tuple(map(self._goal, problem.goals)),
            before=tuple((self._goal(a), self._goal(b)) for a, b in problem.before),
        )

    def state(self, state: State) -> State:
        """Returns the same state under the aliases."""
        return replace(
            state,
            seated=tuple((table, self._party(party)) for table, party in state.seated),
            waiting=tuple(map(self._party, state.waiting)),
            with_agent=self._party(state.with_agent),
            robots=tuple(replace(robot, leads=self._party(robot.leads)) for robot in state.robots),
        )

    def seen(self, observations: Iterable[Observation]) -> tuple[Observation, ...]:
        """Returns the same observations under the aliases."""
        return tuple(
            replace(o, arguments=self._party(o.arguments)) if o.kind in _BY_NAME else o
            for o in observations
        )

    def plan(self, plan: Plan) -> Plan:
        """Returns a plan made under the aliases, with the names."""
        return replace(
            plan,
            actions=tuple(
                replace(action, arguments=self.names(action.arguments)) for action in plan.actions
            ),
        )

    def posed(self, plan: Plan) -> Plan:
        """Returns a plan of the problem as it was given, in the names of `problem`."""
        return replace(
            plan,
            actions=tuple(
                replace(action, arguments=self._party(action.arguments)) for action in plan.actions
            ),
        )

    def names(self, arguments: tuple[str, ...]) -> tuple[str, ...]:
        """Arguments with the names of the customers among them."""
        return tuple(self._name.get(each, each) for each in arguments)

    def _party(self, party: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(self._alias.get(name, name) for name in party)

    def _goal(self, goal: Goal) -> Goal:
        return replace(goal, party=self._party(goal.party))
