"""Stops in a row → `Plan`: the walks between them, chairs where a party lacks them.

Entry point `write_plan`.  With a timetable the agent finds its way step by step around those who
move, and waits where it must.
"""

from __future__ import annotations

from collections.abc import Iterable

from waiter_cli.bounds.distances import FAR, Staff, WalkDistances
from waiter_cli.bounds.tour import TourStop
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

__all__ = ["write_plan"]


class _Stuck(Exception):
    """The agent cannot get on without being in somebody's way, or no path leads there."""


class _Writer:
    def __init__(self, problem: Problem, floor: WalkDistances, staff: Staff) -> None:
        self.problem, self.floor, self.staff = problem, floor, staff
        self.here = floor.number[problem.state.agent]
        self.actions: list[Action] = []
        self.step = 0
        self.taken: list[set[int]] = []
        if staff.last:
            posts = dict(staff.now)
            for step in range(staff.last + 1):
                posts |= {who: to for who, at, to in problem.layout.timetable if at == step}
                self.taken.append({floor.number[node] for node in posts.values()})
            self.open = WalkDistances(problem, ())

    def at(self, step: int) -> set[int]:
        """Returns the nodes where others stand at ``step``."""
        return self.taken[min(step, len(self.taken) - 1)]

    def do(self, name: str, *arguments: str) -> None:
        if self.taken and self.here in self.at(self.step + 1):
            raise _Stuck
        self.actions.append(Action(self.step, name, ("agent", *arguments)))
        self.step += 1

    def go(self, nodes: Iterable[int], deed: bool) -> None:
        """Walks to one of ``nodes``, where a deed will take one more step."""
        if not self.taken:
            (target,) = nodes
            if self.floor.row(self.here)[target] >= FAR:
                raise _Stuck
            for node in self.floor.path(self.here, target):
                self.actions.append(Action(self.step, "go_to", ("agent", self.floor.names[node])))
                self.step += 1
            self.here = target
            return
        goals = set(nodes)
        came: dict[tuple[int, int], int] = {}
        edge = {self.here}
        step = self.step
        limit = self.step + 2 * len(self.floor.names) + self.staff.last + 2
        while edge:
            done = [n for n in edge if n in goals and not (deed and n in self.at(step + 1))]
            if done:
                self.back(came, done[0], step)
                return
            if step > limit:
                break
            now, then = self.at(step), self.at(step + 1)
            fresh = set()
            for node in edge:
                for after in (node, *self.open.near[node]):
                    if after in then or (after != node and after in now) or after in fresh:
                        continue
                    fresh.add(after)
                    came[after, step + 1] = node
            edge, step = fresh, step + 1
        raise _Stuck

    def back(self, came: dict[tuple[int, int], int], node: int, step: int) -> None:
        """Writes the way that leads to ``node`` at ``step``."""
        way = []
        here = node
        for at in range(step, self.step, -1):
            before = came[here, at]
            if before != here:
                way.append(Action(at - 1, "go_to", ("agent", self.floor.names[here])))
            here = before
        self.actions += reversed(way)
        self.here, self.step = node, step


def write_plan(
    problem: Problem, floor: WalkDistances, staff: Staff, stops: list[TourStop], end: int | None
) -> Plan | None:
    """Returns the plan that makes these stops, None when it breaks a rule or misses a goal."""
    writer = _Writer(problem, floor, staff)
    chairs = {table.name: table.chairs for table in problem.layout.tables}
    chairs |= dict(problem.state.chairs)
    needed_chairs: dict[str, int] = {}
    for goal in (*problem.goals, *(goal for pair in problem.before for goal in pair)):
        if goal.kind == "chairs" and goal.table is not None:
            needed_chairs[goal.table] = max(needed_chairs.get(goal.table, 0), goal.number or 0)
    try:
        for stop in stops:
            link = stop.link
            nodes = stop.nodes if staff.last else (stop.node,)
            writer.go(nodes, link.is_deed)
            if link.name in ("seat", "bring_chairs"):
                number = max(len(stop.party), link.number, needed_chairs.get(link.table, 0))
                if number > chairs[link.table]:
                    writer.do("bring_chairs", link.table, str(number))
                    chairs[link.table] = number
            if link.name == "pick":
                writer.do("pick", stop.party[0])
            elif link.name == "seat":
                writer.do("seat", stop.party[0], link.table)
            elif link.name in ("take_up", "bring", "refill"):
                writer.do(link.name, link.item, link.table)
            elif link.is_deed and link.name != "bring_chairs":
                writer.do(link.name, link.table)
        if end is not None:
            writer.go((end,), deed=False)
    except _Stuck:
        return None
    plan = Plan(tuple(writer.actions), writer.step)
    verdict = run(problem, plan)
    if not verdict.valid or verdict.makespan is None:
        return None
    kept = tuple(action for action in plan.actions if action.step < verdict.makespan)
    return Plan(kept, verdict.makespan)
