"""Numbers the states of one robot, and the options in each: `Problem`, `TourTable` → `RobotMoves`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from waiter_cli.fleets.tour_table import TourTable
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Numbers

__all__ = ["RobotOption", "RobotMoves"]

InHand: TypeAlias = tuple[tuple[int, int], ...]
"""Pairs of a job's number and how many of its stages are done, sorted."""


class RobotOption(NamedTuple):
    """``job`` is begun by it (as a bit, 0: none), ``table`` is seated at (as a bit), ``need`` is done before (as a bit)."""

    after: int
    name: str = "go_to"
    arguments: tuple[str, ...] = ()
    job: int = 0
    table: int = 0
    need: int = 0


class RobotMoves:
    """States of one robot: the number of what it has in hand, times the nodes, plus its node.

    Of each state, ``first`` and ``first`` of the next are where its options begin and end.
    """

    def __init__(self, problem: Problem, table: TourTable) -> None:
        np = table.np
        self.problem, self.table = problem, table
        self.nodes = len(table.floor.names)
        self.tables = [t.name for t in problem.layout.tables]
        self.bar = set(table.floor.bar)
        self.hands: dict[InHand, int] = {}
        self.order: list[InHand] = []
        self.options: list[RobotOption] = []
        counts: list[int] = []
        for robot in problem.state.robots:
            self.number(table.begun(robot))
        for hand in self.order:  # grows while it runs
            for node in range(self.nodes):
                before = len(self.options)
                self.options.append(RobotOption(self._state(hand, node), ""))
                self.options.extend(self._from(hand, node))
                counts.append(len(self.options) - before)
        self.first: Numbers = np.concatenate([[0], np.cumsum(counts)])
        self.after: Numbers = np.array([option.after for option in self.options])
        self.job: Numbers = np.array([option.job for option in self.options])
        self.seat: Numbers = np.array([option.table for option in self.options])
        self.need: Numbers = np.array([option.need for option in self.options])
        self.row: Numbers = np.array([table.row_of(hand) for hand in self.order])
        self.busy: Numbers = np.array([sum(1 << k for k, _ in hand) for hand in self.order])

    def number(self, hand: InHand) -> int:
        """Returns the number of what is in hand."""
        if hand not in self.hands:
            self.hands[hand] = len(self.order)
            self.order.append(hand)
        return self.hands[hand]

    def start(self, robot: Robot) -> int:
        """Returns the state of a robot at step 0."""
        hand, node = self.table.begun(robot), self.table.floor.number[robot.at]
        return self._state(self._passed(hand, node), node)

    def of(self, state: int) -> list[RobotOption]:
        """Returns the options in a state, to stand still first."""
        return self.options[int(self.first[state]) : int(self.first[state + 1])]

    def _state(self, hand: InHand, node: int) -> int:
        return self.number(hand) * self.nodes + node

    def _passed(self, hand: InHand, node: int) -> InHand:
        """Returns what is in hand once stages that only take a place have been passed on ``node``."""
        found = []
        for k, stage in hand:
            job = self.table.jobs[k]
            while stage < job.last and not job.deeds[stage] and node in job.places[stage]:
                stage += 1
            found.append((k, stage))
        return tuple(found)

    def _from(self, hand: InHand, node: int) -> Iterator[RobotOption]:
        names = self.table.floor.names
        for other in self.table.floor.near[node]:
            yield RobotOption(
                self._state(self._passed(hand, other), other), "go_to", (names[other],)
            )
        stages = dict(hand)
        for k, job in enumerate(self.table.jobs):
            stage = stages.get(k, 0)
            if k not in stages and (job.job.robot is not None or self._hindered(stages, k)):
                continue
            if not job.deeds[stage] or node not in job.places[stage]:
                continue
            left = {n: s for n, s in hand if n != k}
            if stage + 1 < job.last:
                left[k] = stage + 1
            own = self._passed(tuple(sorted(left.items())), node)
            begins = 0 if k in stages else 1 << k
            need = 1 << job.after if job.after >= 0 and stage == 0 else 0
            after = self._state(own, node)
            if stage < len(job.job.stages):
                what = job.job.stages[stage]
                yield RobotOption(after, what.name, what.arguments, begins, 0, need)
                continue
            for table in self._choices(job.job.tables, node):
                bit = 1 << self.tables.index(table)
                yield RobotOption(after, "seat", (job.job.party[0], table), begins, bit, need)

    def _hindered(self, stages: dict[int, int], k: int) -> bool:
        """Returns whether what is in hand keeps a robot from beginning a job."""
        jobs, job = self.table.jobs, self.table.jobs[k].job
        leads = bool(job.party) and any(jobs[other].job.party for other in stages)
        return leads or (job.hands and any(jobs[other].job.hands for other in stages))

    def _choices(self, tables: tuple[str, ...], node: int) -> Iterator[str]:
        """The tables of a party at a node."""
        name = self.table.floor.names[node]
        for table in self.problem.layout.tables:
            if table.name in tables and name in table.nodes:
                yield table.name
