"""Runs of the simulator as tests ask for them: a problem in, an outcome and its events out."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from waiter_cli.bounds import find_bounds
from waiter_cli.evenings.injections import read_injections
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.execution.plan_follower import PlanFollower, thinking
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.layout_tools.generate_floor import build_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import State
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.room.room import build_room
from waiter_cli.rules.validator import run as verify
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.open_backend import open_backend
from waiter_cli.simulation.outcome import Rules, RunOutcome
from waiter_cli.simulation.run import Run

__all__ = [
    "SHIPPED",
    "WALK",
    "Builder",
    "PlayedRun",
    "corridor",
    "layout_of",
    "play",
    "plan_of",
    "scene",
]

WALK = ("go_to(agent,n2)", "go_to(agent,n3)", "go_to(agent,n4)", "go_to(agent,n5)")
"""From where the robot of ``report`` starts to the entrance."""
SHIPPED = ("report", "report_large", "bistro", "walled_off")


class Builder:
    """A planner that puts plans together without search: legal, not always shortest, and quick."""

    def plan(self, problem: Problem) -> PlannerAnswer:
        found = find_bounds(problem, deadline=None)
        legal = found.plan is not None and verify(problem, found.plan).valid
        status = "plan" if legal else "no_plan"
        reasons = found.impossible if not legal else ()
        return PlannerAnswer(status, found.plan if legal else None, False, reasons)

    def impossible(self, problem: Problem) -> tuple[Reason, ...]:
        return find_bounds(problem).impossible

    def least(self, problem: Problem) -> int:
        return 0


@dataclass(frozen=True)
class PlayedRun:
    """What came of a run; ``lines`` is the event log as it is written."""

    outcome: RunOutcome
    lines: tuple[str, ...]

    @property
    def events(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.lines]

    def types(self) -> list[str]:
        return [event["type"] for event in self.events]

    def of(self, kind: str) -> list[dict[str, Any]]:
        return [event for event in self.events if event["type"] == kind]


def play(
    problem: Problem,
    plan: Sequence[str] | Plan | None = None,
    *,
    inject: Sequence[str] = (),
    backend: str = "geometric",
    rules: Rules | None = None,
    timed: Sequence[TimedEvent] = (),
    predicted: State | None = None,
    watch: Any = None,
) -> PlayedRun:
    """Plays a problem, by a plan given as texts of actions, or as the planner decides."""
    rules = rules or Rules()
    brain = Builder()
    if plan is None:
        mind: Any = thinking(problem, brain)
    else:
        mind = PlanFollower(problem, plan if isinstance(plan, Plan) else plan_of(*plan), brain)
    lines: list[str] = []
    measuring = open_backend(backend, rules.drive)
    try:
        run = Run(
            build_room(problem.layout), problem, mind, measuring, EventLog(lines.append), rules,
            timed, read_injections(inject, problem, timed), watch, predicted,
        )  # fmt: skip
        return PlayedRun(run.play(), tuple(lines))
    finally:
        measuring.close()


def plan_of(*texts: str) -> Plan:
    """A plan of actions one a step."""
    actions = []
    for step, text in enumerate(texts):
        name, _, rest = text.partition("(")
        actions.append(Action(step, name, tuple(rest.rstrip(")").split(","))))
    return Plan(tuple(actions), len(actions))


def layout_of(name: str) -> Layout:
    """A shipped layout, or ``generatedN``: one made by chance."""
    if name.startswith("generated"):
        seed = int(name.removeprefix("generated"))
        return build_layout(
            seed,
            10 + 3 * seed,
            4 + seed,
            bar=seed % 2 == 0,
            waiters=seed % 3,
            handsome=seed % 3 > 0,
        )
    return read_layout_file(name)


def scene(name: str) -> Problem:
    """The problem of a shipped scenario."""
    return read_problem(None, name)[0]


def corridor(spacing: float, due: dict[int, str]) -> Problem:
    """Five nodes in a row, a colleague beside the last, the robot on its way along them all."""
    nodes = {f"n{k}": [spacing * k, 0] for k in range(5)} | {"side": [spacing * 4, spacing]}
    edges = [[f"n{k}", f"n{k + 1}"] for k in range(4)] + [["n4", "side"]]
    layout = {
        "nodes": nodes, "edges": edges, "entrance": "n0", "agent": "n0",
        "tables": {"table1": {"capacity": 2, "nodes": ["n0"], "at": [0, -3]}},
        "waiters": {"anna": "side"}, "timetable": {"anna": due},
    }  # fmt: skip
    read = read_layout(json.dumps(layout), "corridor.yaml")
    return pose_problem(read, None, goals=["at: n4"])
