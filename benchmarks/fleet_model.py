"""Several robots for CP-SAT: one time-expanded model of walks, seating, bills and orders. Entry point `solve_length`."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterable
from typing import Any

from ortools.sat.python import cp_model

from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

__all__ = ["solve_length"]


def solve_length(problem: Problem, length: int, end: float) -> bool:
    """Returns whether a plan of so many steps was found before the ``end`` (of `time.monotonic`)."""
    made = _Model(problem, length)
    if not all(made.walk(robot) for robot in problem.state.robots):
        return False
    made.keep_apart()
    made.serve()
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.max_time_in_seconds = max(0.01, end - time.monotonic())
    return bool(solver.solve(made.model) in (cp_model.OPTIMAL, cp_model.FEASIBLE))


class _Model:
    """``stays``: robot, step and node at which it stands still; ``done``: deed and robot, by step."""

    def __init__(self, problem: Problem, length: int) -> None:
        self.problem, self.length, self.model = problem, length, cp_model.CpModel()
        self.shut = {node for _, node in problem.state.waiters}
        self.stays: dict[tuple[str, int, str], Any] = {}
        self.into: dict[tuple[int, str], list[Any]] = defaultdict(list)
        self.across: dict[tuple[int, str, str], list[Any]] = defaultdict(list)
        self.done: dict[tuple[Any, str], list[Any]] = {}
        self.busy: dict[tuple[str, int], list[Any]] = defaultdict(list)

    def walk(self, robot: Robot) -> bool:
        """The walk of a robot; False where it cannot be where it is wanted in time."""
        near = self.problem.layout.neighbours()
        arrivals: dict[str, list[Any]] = {robot.at: []}
        for step in range(self.length):
            after: dict[str, list[Any]] = defaultdict(list)
            for node, came in arrivals.items():
                ways = (node, *(other for other in near[node] if other not in self.shut))
                leave = [self.model.new_bool_var("") for _ in ways]
                self.model.add(sum(leave) == (sum(came) if step else 1))
                self.stays[robot.name, step, node] = leave[0]
                for other, move in zip(ways, leave):
                    after[other].append(move)
                    self.into[step, other].append(move)
                    if other != node:
                        self.across[step, min(node, other), max(node, other)].append(move)
            arrivals = after
        wanted = [g.node for g in self.problem.goals if g.kind == "at" and g.robot == robot.name]
        for node in wanted:
            if node not in arrivals:
                return False
            if self.length:
                self.model.add(sum(arrivals[node or ""]) == 1)
        return True

    def keep_apart(self) -> None:
        """No two robots on one node, none exchange nodes."""
        for moves in (*self.into.values(), *self.across.values()):
            if len(moves) > 1:
                self.model.add(sum(moves) <= 1)

    def serve(self) -> None:
        """Everything that is wanted is done, once, by one robot, in its order."""
        state, layout = self.problem.state, self.problem.layout
        tables = {table.name: table for table in layout.tables}
        free = [t for t in tables.values() if t.name not in dict(state.seated)]
        for goal in self.problem.goals:
            if goal.kind == "seated" and goal.party in state.waiting:
                who = goal.party[0]
                self.deed(("pick", who), (layout.entrance,))
                fit = [t for t in free if t.capacity >= len(goal.party)]
                for table in fit:
                    self.deed(("seat", who, table.name), table.nodes, once=False)
                self.once(("seat", who, table.name) for table in fit)
                self.follow(("pick", who), [("seat", who, table.name) for table in fit])
            elif goal.kind == "paid" and (table := goal.table or self._table(goal.party)):
                self.deed(("bill", table), tables[table].nodes)
            elif goal.kind == "sent" and goal.table:
                self.deed(("take", goal.table), tables[goal.table].nodes)
                self.deed(("send", goal.table), layout.bar.nodes if layout.bar else ())
                self.follow(("take", goal.table), [("send", goal.table)])
        for table in free:
            self.at_most(key for key, _ in self.done if key[0] == "seat" and key[2] == table.name)
        for steps in self.busy.values():
            self.model.add(sum(steps) <= 1)
        self._lead_one()

    def deed(self, key: Any, nodes: Iterable[str], *, once: bool = True) -> None:
        """Something that one robot does while it stands on one of these nodes."""
        for robot in self.problem.state.robots:
            steps = []
            for step in range(self.length):
                here = [self.stays[k] for n in nodes if (k := (robot.name, step, n)) in self.stays]
                act = self.model.new_bool_var("")
                self.model.add(act <= sum(here))
                self.busy[robot.name, step].append(act)
                steps.append(act)
            self.done[key, robot.name] = steps
        if once:
            self.once([key])

    def once(self, keys: Iterable[Any]) -> None:
        """One of these deeds is done once."""
        self.model.add(sum(self._all(keys)) == 1)

    def at_most(self, keys: Iterable[Any]) -> None:
        """At most one of these deeds is done."""
        self.model.add(sum(self._all(dict.fromkeys(keys))) <= 1)

    def follow(self, first: Any, then: list[Any]) -> None:
        """Whoever does one of the latter has done the first before."""
        for robot in self.problem.state.robots:
            for step in range(self.length):
                before = sum(self.done[first, robot.name][:step])
                self.model.add(sum(self.done[key, robot.name][step] for key in then) <= before)

    def _lead_one(self) -> None:
        """A robot leads one party at a time."""
        for robot in self.problem.state.robots:
            mine = [(k[0], acts) for (k, name), acts in self.done.items() if name == robot.name]
            for step in range(1, self.length + 1):
                picked = [act for kind, acts in mine if kind == "pick" for act in acts[:step]]
                seated = [act for kind, acts in mine if kind == "seat" for act in acts[:step]]
                if len(picked) > step:
                    self.model.add(sum(picked) - sum(seated) <= 1)

    def _all(self, keys: Iterable[Any]) -> list[Any]:
        names = [robot.name for robot in self.problem.state.robots]
        return [act for key in keys for name in names for act in self.done[key, name]]

    def _table(self, party: tuple[str, ...]) -> str | None:
        return self.problem.state.table_of(party[0]) if party else None
