"""Jobs dealt out to robots: `Jobs` → tours, of which the longest is short. Entry point `Router.find`.

Jobs are put into tours one by one where the longest tour grows least, then taken out and put back in
other ways while that helps (ruin and recreate, Schrimpf et al., 2000).  Robots in each other's way are
not looked at here.
"""

from __future__ import annotations

import time
from dataclasses import replace
from random import Random

from waiter_cli.bounds.distances import FAR, WalkDistances, standing
from waiter_cli.bounds.service_chains import Link
from waiter_cli.bounds.tour import Task, Tour
from waiter_cli.fleets.jobs import Job, Jobs, Stage
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

__all__ = ["Router", "alone"]


def alone(problem: Problem, robot: Robot) -> Problem:
    """Returns the problem as if one of several robots were the only one, called ``agent``."""
    state = replace(
        problem.state,
        agent=robot.at,
        with_agent=robot.leads,
        carrying=robot.carries,
        ordered=robot.orders,
        robots=(),
    )
    layout = replace(problem.layout, agent=robot.at, agents=())
    return replace(problem, layout=layout, state=state, before_observations=state)


def _link(stage: Stage) -> Link:
    """Returns the deed of a stage as a link of a tour."""
    match stage.name, stage.arguments:
        case "", _:
            return Link("fill")
        case "pick", (who,):
            return Link("pick", "", who)
        case "bring_chairs", (table, count):
            return Link("bring_chairs", table, "", int(count))
        case name, (item, table):
            return Link(name, table, item)
        case name, (table,):
            return Link(name, table)
    raise ValueError(stage)


class Router:
    """The floor and the jobs of one problem."""

    def __init__(self, problem: Problem, jobs: Jobs) -> None:
        self.problem, self.jobs = problem, jobs.jobs
        staff = standing(problem)
        shut = staff.after.values() if staff.last else staff.fixed.values()
        robots = problem.state.robots
        self.floor = WalkDistances(alone(problem, robots[0]), shut)
        ends = dict(jobs.ends)
        free = [robot for robot in robots if robot.name not in ends]
        for node in jobs.anywhere:
            if node not in ends.values() and free:
                target = self.floor.number[node]
                robot = min(free, key=lambda r: self.floor.row(self.floor.number[r.at])[target])
                ends[robot.name] = node
                free.remove(robot)
        self.ends = ends
        self.tours = {robot.name: self._tour(robot) for robot in robots}
        self.who: dict[int, str] = {}
        self.length = 0

    def _tour(self, robot: Robot) -> Tour:
        end = self.ends.get(robot.name)
        number = self.floor.number
        return Tour(self.floor, number[robot.at], None if end is None else number[end])

    def find(self, rounds: int, least: int, deadline: float | None = None) -> bool:
        """Deals out all jobs and tries so many better ways; returns whether it could.

        ``deadline`` is of `time.monotonic`.
        """
        order = sorted(
            range(len(self.jobs)), key=lambda k: (self.jobs[k].robot is None, -self._reach(k))
        )
        if not all(self._insert(k) for k in order if not self._late(deadline)):
            return False
        if len(self.who) < len(self.jobs):
            return False
        rng = Random(1)
        best, kept = self._cost(), self._copy()
        for _ in range(rounds if self.jobs else 0):
            if best[0] <= least or self._late(deadline):
                break
            for k in self._chosen(rng):
                self.tours[self.who.pop(k)].remove(k)
            gone = [k for k in range(len(self.jobs)) if k not in self.who]
            rng.shuffle(gone)
            done = all(self._insert(k) for k in gone)
            cost = self._cost() if done else (FAR, FAR)
            if cost <= best:
                best, kept = cost, self._copy()
            else:
                self._restore(kept)
        self._restore(kept)
        self.length = best[0]
        return best[0] < FAR

    def _late(self, deadline: float | None) -> bool:
        return deadline is not None and time.monotonic() > deadline

    def _chosen(self, rng: Random) -> list[int]:
        """Returns some jobs of the longest tour, and some others."""
        longest = max(self.tours, key=lambda name: self._length(self.tours[name]))
        own = [k for k, name in self.who.items() if name == longest]
        count = min(len(self.jobs), rng.choice((1, 2, 2, 3, 4)))
        some = rng.sample(own, min(len(own), (count + 1) // 2))
        rest = [k for k in self.who if k not in some]
        return some + rng.sample(rest, min(len(rest), count - len(some)))

    def _copy(self) -> tuple[dict[str, tuple[list[object], dict[int, Task]]], dict[int, str]]:
        tours = {name: (list(tour.stops), dict(tour.tasks)) for name, tour in self.tours.items()}
        return tours, dict(self.who)  # type: ignore[return-value]

    def _restore(
        self, kept: tuple[dict[str, tuple[list[object], dict[int, Task]]], dict[int, str]]
    ) -> None:
        for name, (stops, tasks) in kept[0].items():
            self.tours[name].stops, self.tours[name].tasks = list(stops), dict(tasks)  # type: ignore[arg-type]
        self.who = dict(kept[1])

    def _length(self, tour: Tour) -> int:
        return tour.walk() + sum(stop.link.is_deed for stop in tour.stops)

    def _cost(self) -> tuple[int, int]:
        lengths = [self._length(tour) for tour in self.tours.values()]
        return max(lengths), sum(lengths)

    def _reach(self, k: int) -> int:
        """Returns how far away a job is, for the order in which jobs are dealt out."""
        job = self.jobs[k]
        nodes = [self.floor.number[node] for stage in job.stages for node in stage.nodes]
        door = self.floor.row(self.floor.door)
        far = [door[node] for node in nodes if door[node] < FAR]
        return max(far, default=0) + 10 * len(job.party)

    def _insert(self, k: int) -> bool:
        """Puts a job where the longest tour is then shortest."""
        job = self.jobs[k]
        best: tuple[tuple[int, int], str, object] | None = None
        for name, tour in self.tours.items():
            if job.robot not in (None, name):
                continue
            stops, tasks = list(tour.stops), dict(tour.tasks)
            task = self._task(k, job)
            if task is not None and tour.insert(task) is not None:
                cost = self._cost()
                if best is None or cost < best[0]:
                    best = (cost, name, (list(tour.stops), dict(tour.tasks)))
            tour.stops, tour.tasks = stops, tasks
        if best is None or best[0][0] >= FAR:
            return False
        name = best[1]
        self.tours[name].stops, self.tours[name].tasks = best[2]  # type: ignore[misc]
        self.who[k] = name
        return True

    def _task(self, k: int, job: Job) -> Task | None:
        links, places = [], []
        for stage in job.stages:
            links.append(_link(stage))
            places.append(dict.fromkeys(self._numbers(stage.nodes), links[-1].table))
        lead: list[bool] = []
        if job.party:
            used = {stop.link.table for tour in self.tours.values() for stop in tour.stops
                    if stop.link.name == "seat"}  # fmt: skip
            at: dict[int, str] = {}
            for table in self.problem.layout.tables:
                if table.name in job.tables and table.name not in used:
                    for node in self._numbers(table.nodes):
                        at.setdefault(node, table.name)
            links.append(Link("seat", "", job.party[0]))
            places.append(at)
            lead = [True, False] if job.robot is not None else [False, True, False]
        if not all(places):
            return None
        return Task(k, tuple(links), places, job.party, lead=lead)

    def _numbers(self, nodes: tuple[str, ...]) -> list[int]:
        number = self.floor.number
        return [number[node] for node in nodes if number[node] not in self.floor.shut]

    def stages(self, robot: str) -> list[Stage]:
        """Returns the stages of a robot's tour, chairs that a party lacks included."""
        found: list[Stage] = []
        chairs = dict(self.problem.state.chairs)
        for stop in self.tours[robot].stops:
            link = stop.link
            nodes = tuple(self.floor.names[node] for node in stop.nodes)
            if link.name == "seat":
                lacking = len(stop.party) > chairs.get(link.table, len(stop.party))
                if lacking:
                    found.append(Stage("bring_chairs", (link.table, str(len(stop.party))), nodes))
                found.append(Stage("seat", (link.item, link.table), nodes))
            elif link.name == "fill":
                found.append(Stage("", (), nodes))
            elif link.name == "pick":
                found.append(Stage("pick", (link.item,), nodes))
            elif link.name == "bring_chairs":
                found.append(Stage(link.name, (link.table, str(link.number)), nodes))
            else:
                found.append(Stage(link.name, tuple(filter(None, (link.item, link.table))), nodes))
        return found
