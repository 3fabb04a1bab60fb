"""Scenarios in a restaurant → how far the robot walks and how long guests wait, by the plans found.

Entry points `find_scenarios` and `measure`; ``compare`` and ``layout improve`` use both.  Plans have
the fewest steps, and of these the shortest walk, unless the scenario has preferences of its own.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from math import dist
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, InputError, LayoutError, Where
from waiter_cli.file_access.locate import BuiltIn, is_layout, is_stream
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.translators.base import Translator

__all__ = [
    "Measured",
    "MeasuringPlanner",
    "TIES",
    "Totals",
    "find_scenarios",
    "length",
    "measure",
    "pose_all",
    "total",
]

SPEED = 0.8
"""Metres a second, as fast as ``simulate`` drives."""

TIES = 4.0
"""Seconds in which the shortest walk is looked for among the plans with the fewest steps."""


@dataclass(frozen=True)
class MeasuringPlanner:
    """The way plans are found: by which rules and translator (None: ours), with which search."""

    domain: Domain | None = None
    translator: Translator | None = None
    strategy: str = "binary"
    max_steps: int | None = None


@dataclass(frozen=True)
class Measured:
    """The measures of one scenario.

    ``status`` is ``plan``, ``no_plan``, ``contradiction``, ``undecided`` or ``no_fit`` (the scenario
    is not about this restaurant); ``message`` says why there is no plan.  ``metres`` counts 1 for an
    edge without coordinates.  ``seconds`` is how long the robot takes, None without coordinates.
    ``waits`` has for each wish the step at which it is first fulfilled, ``wait_seconds`` the moment;
    wishes that hold from the start have none.  ``limit`` is what came first where it is undecided.
    """

    scenario: str
    file: str
    status: str
    message: str = ""
    plan: Plan | None = None
    minimal: bool = False
    metres: float = 0.0
    seconds: float | None = None
    waits: tuple[int, ...] = ()
    wait_seconds: tuple[float, ...] = ()
    limit: str | None = None

    @property
    def steps(self) -> int:
        """Returns the length of the plan; 0 where there is none."""
        return 0 if self.plan is None else self.plan.horizon

    def document(self) -> dict[str, Any]:
        """Returns the JSON form."""
        limit = {"limit": self.limit} if self.status == "undecided" else {}
        if self.plan is None:
            return {"status": self.status, **limit, "message": self.message}
        return {
            "status": self.status,
            **limit,
            "steps": self.steps,
            "minimal": self.minimal,
            "metres": round(self.metres, 3),
            "seconds": None if self.seconds is None else round(self.seconds, 2),
            "waiting": {
                "mean_steps": _mean(self.waits),
                "longest_steps": max(self.waits, default=0),
                "mean_seconds": None if self.seconds is None else _mean(self.wait_seconds),
                "longest_seconds": None
                if self.seconds is None
                else round(max(self.wait_seconds, default=0.0), 2),
            },
        }


@dataclass(frozen=True)
class Totals:
    """Sums over scenarios; ``waiting`` is the mean of all waits, in seconds or (no metres) steps."""

    scenarios: int
    steps: int
    metres: float
    seconds: float | None
    waiting: float
    waiting_unit: str

    @property
    def unit(self) -> str:
        """Returns the unit of ``waiting`` as figures have it beside them."""
        return "s" if self.waiting_unit == "seconds" else self.waiting_unit

    def document(self) -> dict[str, Any]:
        """Returns the JSON form."""
        return {
            "scenarios": self.scenarios,
            "steps": self.steps,
            "metres": round(self.metres, 3),
            "seconds": None if self.seconds is None else round(self.seconds, 2),
            "waiting": round(self.waiting, 3),
            "waiting_unit": self.waiting_unit,
        }


def _mean(values: Sequence[float]) -> float:
    return round(sum(values) / len(values), 3) if values else 0.0


def total(measured: Sequence[Measured], in_seconds: bool) -> Totals:
    """Returns the sums over scenarios that have plans."""
    waits: list[float] = []
    for one in measured:
        waits += one.wait_seconds if in_seconds else one.waits
    return Totals(
        len(measured),
        sum(one.steps for one in measured),
        sum(one.metres for one in measured),
        sum(one.seconds or 0.0 for one in measured) if in_seconds else None,
        _mean(waits),
        "seconds" if in_seconds else "steps",
    )


def find_scenarios(folders: Sequence[str], names: Sequence[str]) -> list[str]:
    """Returns the scenarios in folders (files that end in .yaml or .yml, by name), and those named.

    Layouts that lie in such a folder, too, are left out.

    Raises `InputError` where a folder is none or there is no scenario at all.
    """
    paths: list[str] = []
    for folder in folders:
        try:
            inside = sorted(os.listdir(folder))
        except (OSError, ValueError) as error:
            what = getattr(error, "strerror", None) or str(error)
            raise InputError(
                [Fault(Where("--scenarios"), f"{folder}: {what.lower()}", "give a folder")]
            ) from None
        files = [os.path.join(folder, n) for n in inside if n.endswith((".yaml", ".yml"))]
        files = [path for path in files if not is_stream(path)]
        files = [path for path in files if not (os.path.isfile(path) and is_layout(path))]
        if not files:
            fault = f"{folder} has no scenario in it"
            raise InputError([Fault(Where("--scenarios"), fault, "scenarios end in .yaml")])
        paths += files
    paths += names
    if not paths:
        raise InputError("which scenarios?", "give --scenarios DIR, or --scenario S")
    if "-" in paths:
        raise InputError("scenarios are read more than once", "give a file, not standard input")
    return paths


def pose_all(layout: Layout, scenarios: Sequence[str]) -> list[Problem | Measured]:
    """Returns a problem for each scenario in this restaurant.

    What does not fit is measured already.
    """
    from waiter_cli.files.scenario_reader import read_scenario_file
    from waiter_cli.problems.pose import pose_problem

    out: list[Problem | Measured] = []
    for name in scenarios:
        try:
            _, scenario = read_scenario_file(name, layout, several=True)
            problem = pose_problem(layout, scenario)
        except LayoutError as error:
            if error.faults[0].where is not None and error.faults[0].where.name == "--scenario":
                raise
            shown = os.path.basename(name).rsplit(".", 1)[0]
            out.append(Measured(shown, name, "no_fit", str(error.faults[0])))
            continue
        if not problem.prefer:
            problem = replace(problem, prefer=("shortest_walk",))
        out.append(problem)
    return out


def measure(
    problem: Problem,
    time_limit: float | None = None,
    ties: float = TIES,
    planner: MeasuringPlanner = MeasuringPlanner(),
) -> Measured:
    """Returns the figures of a problem's plan; ``time_limit`` in seconds.

    Ties among minimal plans are settled for ``ties`` seconds at most: after that the best one so
    far stands, as short as any and a little longer in metres perhaps.
    """
    from waiter_cli.encoding.domains import find_domain
    from waiter_cli.planning.planner import find_plan
    from waiter_cli.planning.search_results import SearchOptions
    from waiter_cli.translators.native import NativeTranslator

    domain = planner.domain or find_domain(BuiltIn("restaurant"))
    translator = planner.translator or NativeTranslator()
    quick = ties if time_limit is None else min(ties, time_limit)
    options = SearchOptions(planner.strategy, planner.max_steps, quick)
    answer = find_plan(problem, translator, domain, options)
    if answer.result.status.value == "undecided" and (time_limit is None or time_limit > quick):
        plain = replace(problem, prefer=())
        options = SearchOptions(planner.strategy, planner.max_steps, time_limit)
        answer = find_plan(plain, translator, domain, options)
    file, limit = problem.scenario_file, answer.result.limit
    name = os.path.basename(file).rsplit(".", 1)[0]
    status = answer.result.status.value
    if answer.plan is None:
        reasons = "; ".join(reason.message for reason in answer.result.reasons)
        return Measured(name, file, status, reasons or answer.headline(), limit=limit)
    walked, moments = _times(problem, answer.plan)
    first = [_first(problem, goal, answer.states) for goal in dict.fromkeys(problem.goals)]
    waits = tuple(step for step in first if step)
    return Measured(
        name,
        file,
        status,
        "" if status == "plan" else answer.headline(),
        answer.plan,
        answer.result.minimal,
        walked,
        moments[-1] if moments is not None else None,
        waits,
        tuple(moments[step] for step in waits) if moments is not None else (),
        limit,
    )


def _first(problem: Problem, goal: Any, states: Sequence[Any]) -> int:
    """Returns the first step at which a goal holds; 0 where it never does or does from the start."""
    from waiter_cli.rules.actions import holds

    return next((step for step, state in enumerate(states) if holds(goal, state, problem)), 0)


def _times(problem: Problem, plan: Plan) -> tuple[float, list[float] | None]:
    """Returns metres walked, and the second at which each step begins.

    None without coordinates, and for several robots.
    """
    layout = problem.layout
    here = problem.state.stations()
    metres = 0.0
    for action in plan.actions:
        if action.name == "go_to":
            who, node = action.arguments
            metres += length(layout, here[who], node)
            here[who] = node
    if layout.agents:  # which do not march in step
        return metres, None
    if any(node.at is None for node in layout.nodes):
        return metres, None
    from waiter_cli.room.motion import script_of_plan
    from waiter_cli.room.room import build_room

    room = build_room(layout)
    scripts = script_of_plan(plan, (*room.nodes[problem.state.agent], 0.0), room, SPEED)
    due = {
        action.step: sum(move.seconds for move in moves)
        for action, moves in zip(plan.actions, scripts)
    }
    moments = [0.0]
    for step in range(plan.horizon):
        moments.append(moments[-1] + due.get(step, 1.0))  # an idle step waits for a second
    return metres, moments


def length(layout: Layout, a: str, b: str) -> float:
    """Returns metres between two nodes as the crow flies; 1 where they have no coordinates."""
    start, end = layout.node(a).at, layout.node(b).at
    return 1.0 if start is None or end is None else dist(start, end)
