"""Evenings of several robots that begin, end, fail, stop and go on by chance, and what must hold of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from random import Random

from tests.support.serving import thinker
from tests.support.small_worlds import fleet_problem
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.execution.decision import Refused
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.fleets.barriers import find_barriers
from waiter_cli.fleets.fleet_bounds import find_fleet_bounds
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation, State
from waiter_cli.rules.actions import holds
from waiter_cli.rules.joint_steps import apply_together

__all__ = ["Evening", "quick_planner"]


def quick_planner(problem: Problem) -> PlannerAnswer:
    """The plan that the bounds have, least or not; else the search."""
    bounds = find_fleet_bounds(problem)
    if bounds.impossible:
        return PlannerAnswer("no_plan", reasons=bounds.impossible)
    if bounds.plan is not None:
        return PlannerAnswer("plan", bounds.plan, bounds.plan.horizon == bounds.lower)
    return thinker(5.0).plan(problem)


@dataclass
class Counts:
    done: int = 0
    failed: int = 0
    out: int = 0
    refused: int = 0


class Evening:
    """One evening by chance; ``play`` raises `AssertionError` where robots meet or nobody goes on.

    What really happens is kept apart from what the executive believes: who stands where, and
    between which nodes somebody walks.
    """

    def __init__(self, seed: int, planner=quick_planner) -> None:  # type: ignore[no-untyped-def]
        problem = fleet_problem(seed)
        layout = replace(problem.layout, timetable=(), key_where=())
        self.rng = Random(f"evening {seed}")
        self.problem = replace(problem, layout=layout)
        self.executive = FleetExecutive(
            layout, planner, state=problem.state, goals=problem.goals, before=problem.before,
            instant_kitchen=problem.instant_kitchen, impossible=find_barriers,
        )  # fmt: skip
        self.at = dict(self.executive.state.stations())
        self.walks: dict[str, tuple[str, str]] = {}
        self.running: dict[str, Action] = {}
        self.out: set[str] = set()
        self.counts = Counts()
        self.troubles = 6

    def play(self) -> str:
        """Plays to the end; ``served``, or ``pending`` where the rest is impossible."""
        for _ in range(2000):
            if not self.turn():
                break
        else:
            raise AssertionError("the evening does not end")
        decision = self.executive.decision
        assert not decision.plan, decision.plan
        if decision.status == "plan" and not decision.pending:
            state = self.executive.state
            assert all(holds(goal, state, self.problem) for goal in self.executive.goals)
            return "served"
        assert decision.reasons or decision.pending or decision.status == "undecided"
        return "pending"

    def turn(self) -> bool:
        rng = self.rng
        free = [r for r, _ in self.executive.decision.next or () if r not in self.running]
        choices = [("start", r) for r in free for _ in range(3)]
        choices += [("end", r) for r in self.running for _ in range(3)]
        choices += [("back", r) for r in self.out]
        if self.troubles and choices:
            choices += [("out", r) for r in self.at if r not in self.out]
            choices += [("news", "")]
        if not choices:
            return False
        what, robot = rng.choice(choices)
        getattr(self, f"_{what}")(robot)
        self._agree()
        return True

    def _start(self, robot: str) -> None:
        action = dict(self.executive.decision.next or ())[robot]
        order = self.executive._order()
        for mate in order.groups[action]:  # those of a ring set out together
            if (other := mate.arguments[0]) in self.running:
                continue
            self.executive.started_by(other, mate.step)
            self.running[other] = mate
            if mate.name == "go_to":
                self.walks[other] = (self.at[other], mate.arguments[1])
        self._apart(len(order.groups[action]) > 1)

    def _apart(self, ring: bool) -> None:
        """Nobody is where another one stands, leaves or comes to; but in a ring each leaves for the next."""
        places: dict[str, str] = {}
        for robot, node in self.at.items():
            places[node] = robot
        for waiter, node in self.executive.state.waiters:
            assert places.setdefault(node, waiter) == waiter, (node, waiter, places)
        targets: dict[str, str] = {}
        for robot, (start, end) in self.walks.items():
            assert targets.setdefault(end, robot) == robot, f"two come to {end}"
            other = places.get(end)
            if other is None:
                continue
            assert ring and other in self.walks, f"{robot} comes to {end}, where {other} is"
            assert self.walks[other][1] != start, f"{robot} and {other} change places"

    def _end(self, robot: str) -> None:
        action = self.running[robot]
        group = self.executive._order().groups[action]
        mates = [each for each in group if each.arguments[0] in self.running]
        fails = self.troubles > 0 and self.rng.random() < 0.25
        if action.name == "go_to" and set(group) & set(self.executive.finished):
            fails = False  # another one came to where this one was: it must have left
        if fails or (len(group) == 1 and self.rng.random() < 0.15 and self._impossible(action)):
            self.troubles -= 1
            for each in (
                mates if action.name == "go_to" else [action]
            ):  # nobody gets round a ring alone
                self._over(each.arguments[0])
                self.executive.failed_by(each.arguments[0], each.step, "by chance")
                self.counts.failed += 1
            return
        try:
            self.executive.done_by({robot: action.step})
        except Refused:
            assert self._impossible(action), action
            self._over(robot)
            self.executive.failed_by(robot, action.step)
            self.counts.refused += 1
            return
        self._over(robot)
        if action.name == "go_to":
            self.at[robot] = action.arguments[1]
        self.counts.done += 1

    def _impossible(self, action: Action) -> bool:
        from waiter_cli.rules.actions import Illegal

        try:
            apply_together(self.executive.belief.world(), self.executive.state, [action], 0)
        except Illegal:
            return True
        return False

    def _over(self, robot: str) -> None:
        del self.running[robot]
        self.walks.pop(robot, None)

    def _out(self, robot: str) -> None:
        action = self.running.get(robot)
        if action is not None:
            if len(self.executive._order().groups[action]) > 1:
                return
            # It stands between two nodes: it keeps both until it is back.
            self.running.pop(robot)
        self.executive.take_out(robot)
        self.out.add(robot)
        self.troubles -= 1
        self.counts.out += 1

    def _back(self, robot: str) -> None:
        self.walks.pop(robot, None)  # it goes back to where it came from
        self.out.remove(robot)
        self.executive.bring_back(robot)

    def _news(self, _: str) -> None:
        self.troubles -= 1
        state: State = self.executive.state
        fresh = Observation("enter", (f"x{self.troubles}",))
        seen = [fresh] + [Observation("bill", (table,)) for table, _ in state.seated]
        seen += [Observation("leave", (party[0],)) for _, party in state.seated]
        self.executive.observe([self.rng.choice(seen)])

    def _agree(self) -> None:
        """What is believed of the robots' places is so, and the rest of the plan can be done."""
        believed = self.executive.state.stations()
        over = {each.arguments[0] for each in self.executive.finished}
        for robot, node in self.at.items():
            assert believed[robot] == node or robot in over, (robot, node, believed)
        assert self.executive.objection() is None, self.executive.objection()
        decision = self.executive.decision
        if decision.plan and not self.running:
            left = {action.arguments[0] for action in decision.plan} - self.out
            assert decision.next or not left, f"nobody can go on: {decision.plan}"
