"""Shortest joint walks of robots that are only wanted somewhere. Entry point `walk_together`.

Nothing but walking is to be done, so a robot is on a node at a step only where it can have got there by
then and can still get to its end in time.  That leaves few nodes a robot and step (the decision diagrams
of Sharon et al., 2013), and each length is one small question of satisfiability (Surynek et al., 2016).
"""

from __future__ import annotations

from collections.abc import Iterator

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.fleets.routing import alone
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

__all__ = ["JointWalks", "only_walks", "walk_together"]

CONFLICTS = 100_000
"""The search of one length ends after so many."""
TRIED = 40
"""So many lengths are tried where no plan is known."""

_PROGRAM = """\
at(R,N,0) :- start(R,N).
:- start(R,N), not can(R,N,0).
{ goes(R,N,M,T) : next(N,M), can(R,M,T+1) } = 1 :- at(R,N,T), T < length.
at(R,M,T+1) :- goes(R,N,M,T).
shared(N,T) :- can(R,N,T), can(Q,N,T), R < Q.
:- shared(N,T), #count { R : at(R,N,T) } > 1.
:- goes(R,N,M,T), goes(Q,M,N,T), M < N.
"""  # ways are chosen, not nodes: the other way takes 2 to 14 times as many conflicts in the hotel


@dataclass(frozen=True)
class JointWalks:
    """``lower``: no plan is shorter.  ``plan`` is one of that length, None where none was found."""

    lower: int
    plan: Plan | None


def only_walks(problem: Problem) -> bool:
    """Returns whether all that is wanted is certain robots on certain nodes, in any order."""
    named = all(goal.kind == "at" and goal.robot is not None for goal in problem.goals)
    return named and not problem.before and not problem.layout.timetable


def walk_together(
    problem: Problem, lower: int, upper: int | None = None, deadline: float | None = None
) -> JointWalks:
    """Returns a shortest plan of a problem that is `only_walks`, or the bound that the search reached.

    No plan is shorter than ``lower``; one of ``upper`` steps is known.  ``deadline`` is of
    `time.monotonic`.
    """
    from sparc.solving.clingo_threads import Abandoned

    floor = _Floor(problem)
    last = lower + TRIED if upper is None else upper
    while lower < last:
        try:
            possible, plan = floor.walks(lower, deadline)
        except Abandoned:
            return JointWalks(lower, None)
        if possible is not False:
            return JointWalks(lower, plan)
        lower += 1
    return JointWalks(lower, None)


class _Floor:
    """The nodes that each robot can be on at a step, and joint walks of one length."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.robots = problem, problem.state.robots
        posts = standing(problem).fixed.values()
        self.floor = WalkDistances(alone(problem, self.robots[0]), posts)
        self.ends = {goal.robot: goal.node or "" for goal in problem.goals}

    def walks(self, length: int, deadline: float | None) -> tuple[bool | None, Plan | None]:
        """Returns whether there are walks of so many steps (None: not known), and the plan."""
        from sparc.solving.clingo_solver import Grounding
        from sparc.translation.asp_program import AspProgram

        text = f"#const length = {length}.\n{_PROGRAM}{' '.join(self._facts(length))}\n"
        grounding = Grounding(AspProgram(text, "#show at/3."))
        grounding.ground(deadline)
        for model in grounding.models(limit=1, deadline=deadline, conflicts=CONFLICTS):
            at = {}
            for symbol in model.symbols(shown=True):
                robot, node, step = (argument.number for argument in symbol.arguments)
                at[robot, step] = node
            return True, self._plan(at, length)
        known = grounding.outcome.satisfiability.value != "unknown"
        return (False if known else None), None

    def _facts(self, length: int) -> Iterator[str]:
        """The floor, and for each robot the nodes it can be on, with the steps."""
        number = self.floor.number
        for node, near in enumerate(self.floor.near):
            yield from (f"next({node},{other})." for other in (node, *near))
        for k, robot in enumerate(self.robots):
            start = number[robot.at]
            yield f"start({k},{start})."
            here = self.floor.row(start)
            end = self.ends.get(robot.name)
            there = [0] * len(here) if end is None else self.floor.column(number[end])
            for node, (way, left) in enumerate(zip(here, there)):
                yield from (f"can({k},{node},{t})." for t in range(way, length - left + 1))

    def _plan(self, at: dict[tuple[int, int], int], length: int) -> Plan | None:
        """Returns the plan of these walks, None where the rules do not take it."""
        actions = tuple(
            Action(step, "go_to", (robot.name, self.floor.names[at[k, step + 1]]))
            for step in range(length)
            for k, robot in enumerate(self.robots)
            if at[k, step] != at[k, step + 1]
        )
        plan = Plan(actions, length)
        verdict = run(self.problem, plan)
        return plan if verdict.valid and verdict.makespan == length else None
