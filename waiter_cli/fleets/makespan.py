"""Lower bounds on the length of a plan for several robots. Entry point `least_steps`.

Each leaves something out, so none can be too large: robots are never in each other's way, a job is
done by whoever is nearest, or one robot walks all tours one after the other.
"""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.bounds import find_bounds
from waiter_cli.bounds.distances import FAR, WalkDistances, standing
from waiter_cli.fleets.jobs import Job, Jobs, find_jobs
from waiter_cli.fleets.routing import alone
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

__all__ = ["least_steps"]

MOST_PARTIES, MOST_TURNS = 6, 40_000
"""So many parties may take turns at the door, and so many ways of it are looked at."""


def least_steps(problem: Problem, deadline: float | None = None) -> int:
    """Returns a number of steps that no plan falls short of; `FAR` or more: there is none."""
    jobs = find_jobs(problem)
    if jobs is None:
        return 0
    floor = _Floor(problem)
    bounds = [0, *floor.ends(jobs)]
    bounds += [floor.job(job) for job in jobs.jobs]
    bounds.append(floor.door(jobs))
    if max(bounds) < FAR:
        bounds.append(_one_after_the_other(problem, jobs, floor, deadline))
    return max(bounds)


class _Floor:
    """Distances for each robot, past colleagues who never move."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.robots = problem.state.robots
        staff = standing(problem)
        self.floor = WalkDistances(alone(problem, self.robots[0]), staff.fixed.values())
        self.number = self.floor.number

    def from_(self, robot: Robot) -> list[int]:
        return self.floor.row(self.number[robot.at])

    def open(self, nodes: tuple[str, ...]) -> list[int]:
        return [self.number[n] for n in nodes if self.number[n] not in self.floor.shut]

    def ends(self, jobs: Jobs) -> list[int]:
        """Returns the ways of named robots to their places, and of the nearest to others."""
        found = []
        for robot in self.robots:
            if robot.name in jobs.ends:
                found.append(self._to(robot, jobs.ends[robot.name]))
        for node in jobs.anywhere:
            found.append(min(self._to(robot, node) for robot in self.robots))
        return found

    def _to(self, robot: Robot, node: str) -> int:
        return self.from_(robot)[self.number[node]]

    def job(self, job: Job) -> int:
        """Returns the least steps until a job can be done, by the robot that has to or the nearest."""
        able = [robot for robot in self.robots if job.robot in (None, robot.name)]
        return min((self._alone(robot, job) for robot in able), default=FAR)

    def _alone(self, robot: Robot, job: Job) -> int:
        costs = {self.number[robot.at]: 0}
        places = [self.open(stage.nodes) for stage in job.stages]
        deeds = [bool(stage.name) for stage in job.stages]
        if job.party:
            tables = [table for table in self.problem.layout.tables if table.name in job.tables]
            places.append(self.open(tuple(node for table in tables for node in table.nodes)))
            deeds.append(True)
        for k, (nodes, deed) in enumerate(zip(places, deeds)):
            if k and job.stages[k - 1].name == "send_order":  # whoever comes may go on from there
                costs = self._handed_over(min(costs.values(), default=FAR), nodes)
            costs = {
                node: deed
                + min((c + self.floor.row(n)[node] for n, c in costs.items()), default=FAR)
                for node in nodes
            }
        return min(costs.values(), default=FAR)

    def _handed_over(self, ready: int, nodes: list[int]) -> dict[int, int]:
        """Returns when the nearest robot can be at each node, from the step ``ready`` on."""
        return {
            node: max(ready, min(self.from_(robot)[node] for robot in self.robots))
            for node in nodes
        }

    def door(self, jobs: Jobs) -> int:
        """Returns when the last party can sit: parties are picked up one by one, on one node.

        Another robot that comes for the next one has to enter the door as the last leaves it, or,
        where the door is the end of an aisle, the node before it.  The same one has to be back.
        """
        waiting = [job for job in jobs.jobs if job.party and job.robot is None]
        if not waiting:
            return 0
        aisle = len(self.problem.layout.joined()[self.problem.layout.entrance]) == 1
        ways = []
        for job in waiting:
            tables = [table for table in self.problem.layout.tables if table.name in job.tables]
            own = {table.name: self._from_door(table.nodes) for table in tables}
            ways.append({name: way for name, way in own.items() if way < FAR})
        first = tuple(self.from_(robot)[self.floor.door] for robot in self.robots)
        if not all(ways) or min(first) >= FAR:
            return FAR
        return _Turns(ways, 4 if aisle else 2).least(first)

    def _from_door(self, nodes: tuple[str, ...]) -> int:
        row = self.floor.row(self.floor.door)
        return min((row[node] for node in self.open(nodes)), default=FAR)


class _Turns:
    """Robots that take turns at the door; ``ways`` are each party's tables and the walks there."""

    def __init__(self, ways: list[dict[str, int]], gap: int) -> None:
        self.ways, self.gap = ways, gap
        self.shortest = min(min(own.values()) for own in ways)
        self.spacing = min(gap, 2 + 2 * self.shortest)
        self.best = FAR
        self.looked = 0

    def least(self, ready: tuple[int, ...]) -> int:
        """Returns the least step at which all can sit, when robots are at the door from ``ready`` on."""
        parties = frozenset(range(len(self.ways)))
        if len(parties) <= MOST_PARTIES:
            self._pick(parties, frozenset(), ready, -FAR, -1, 0)
            if self.looked <= MOST_TURNS:
                return self.best
        return min(ready) + self.spacing * (len(parties) - 1) + 2 + self.shortest

    def _pick(
        self,
        waiting: frozenset[int],
        used: frozenset[str],
        ready: tuple[int, ...],
        last: int,
        who: int,
        end: int,
    ) -> None:
        self.looked += 1
        if not waiting:
            self.best = min(self.best, end)
            return
        if self.looked > MOST_TURNS:
            return
        shortest = min(min(self.ways[k].values()) for k in waiting)
        for robot, at in sorted(enumerate(ready), key=lambda pair: pair[1]):
            step = max(at, last + self.gap) if robot != who else at
            if step + self.spacing * (len(waiting) - 1) + 2 + shortest >= self.best:
                continue
            for k in waiting:
                for table, way in sorted(self.ways[k].items(), key=lambda pair: pair[1]):
                    if table in used:
                        continue
                    then = (*ready[:robot], step + 2 + 2 * way, *ready[robot + 1 :])
                    done = max(end, step + 2 + way)
                    if done < self.best:
                        self._pick(waiting - {k}, used | {table}, then, step, robot, done)


def _without_unasked(robot: Robot, jobs: Jobs) -> Robot:
    """Returns a robot without what it has in its hands that no job asks for.

    One robot alone would have to get rid of it first; of several the others go about their jobs.
    """
    leads = robot.leads if any(job.party == robot.leads for job in jobs.jobs) else ()
    held = any(job.hands and job.robot == robot.name for job in jobs.jobs)
    return replace(robot, leads=leads, carries=robot.carries if held else None)


def _one_after_the_other(
    problem: Problem, jobs: Jobs, floor: _Floor, deadline: float | None
) -> int:
    """Returns a bound: one robot that walks the tours of all in turn takes no more than all of them.

    What it walks from the end of one tour to the beginning of the next is taken off.
    """
    state = problem.state
    robots = tuple(_without_unasked(robot, jobs) for robot in state.robots)
    if problem.before or problem.layout.timetable or len(robots) < 2:
        return 0
    if problem.instant_kitchen or any(goal.kind == "serve" for goal in problem.goals):
        return 0
    goals = tuple(goal for goal in problem.goals if goal.kind != "at")
    stops = {node for job in jobs.jobs for stage in job.stages for node in floor.open(stage.nodes)}
    for job in jobs.jobs:
        tables = [table for table in problem.layout.tables if table.name in job.tables]
        stops |= set(floor.open(tuple(node for table in tables for node in table.nodes)))
    chairs = dict(state.chairs)
    lacking = any(len(job.party) > chairs[table] for job in jobs.jobs for table in job.tables)
    if not stops or lacking or any(goal.kind == "chairs" for goal in goals):
        return 0
    best = 0
    for first in robots:
        if any((r.leads or r.carries) and r != first for r in robots):
            continue
        links = 0
        for other in robots:
            if other != first:
                column = floor.floor.column(floor.number[other.at])
                links += max(column[node] for node in (*stops, floor.number[first.at]))
        if links >= FAR:
            continue
        merged = replace(first, orders=state.held_orders())
        one = replace(alone(problem, merged), goals=goals, prefer=())
        total = find_bounds(one, deadline=deadline)
        if not total.impossible:
            best = max(best, -(-(total.lower - links) // len(robots)))
    return best
