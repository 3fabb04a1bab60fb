"""Rooms in which several robots act while robots slip, stall, stop and go on, and paths are blocked, by chance."""

from __future__ import annotations

import json
from random import Random
from typing import Any

from tests.support.fleet_evenings import quick_planner
from waiter_cli.evenings.injections import read_injections
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.barriers import find_barriers
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.pictures.filmed_run import Showing, build_checked_room, play_run
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.outcome import Rules, RunOutcome
from waiter_cli.simulation.run_request import RunRequest

__all__ = ["AISLE", "HALL", "LUNCH", "RING", "SCENES", "SWAP", "TURN", "calm", "play"]

AISLE = """
name: aisle
nodes: {a: [0, 0], b: [1.2, 0], c: [2.4, 0], bay: [2.4, 1.2], d: [3.6, 0], e: [4.8, 0]}
edges: [[a, b], [b, c], [c, d], [d, e], [c, bay]]
entrance: a
tables:
  table1: {capacity: 2, nodes: [e], at: [5.9, 0]}
agents: {r1: a, r2: e}
"""
SWAP = "goals: [{at: {r1: e}}, {at: {r2: a}}]"
RING = """
name: ring
nodes: {a: [0, 0], b: [1.5, 0], c: [1.5, 1.5], d: [0, 1.5]}
edges: [[a, b], [b, c], [c, d], [d, a]]
entrance: a
tables:
  table1: {capacity: 4, nodes: [c], at: [2.8, 1.5]}
agents: {r1: a, r2: b, r3: c, r4: d}
"""
TURN = "goals: [{at: {r1: b}}, {at: {r2: c}}, {at: {r3: d}}, {at: {r4: a}}]"
HALL = """
name: hall
nodes: {a: [0, 0], b: [1.4, 0], c: [2.8, 0], d: [0, 1.4], e: [1.4, 1.4], f: [2.8, 1.4]}
edges: [[a, b], [b, c], [a, d], [d, e], [e, f], [c, f]]
entrance: a
tables:
  table1: {capacity: 2, nodes: [c], at: [4.1, 0], size: [0.6, 0.6]}
  table2: {capacity: 2, nodes: [f], at: [4.1, 1.9], size: [0.6, 0.6]}
  table3: {capacity: 2, nodes: [e], at: [1.4, 2.7], size: [0.6, 0.6]}
bar: {nodes: [b], from: [0.9, -1.5], to: [1.9, -0.9]}
objects: [plate, jug]
agents: {r1: b, r2: d}
"""
LUNCH = """
state: {seated: {table3: [c9]}, wants_bill: [table3]}
observe:
  - enter: [c1, c2]
events:
  - {time: 6, enter: [c3]}
  - {time: 9, order: table3}
  - {time: 14, empty: {table3: jug}}
"""


class Quick:
    """The planner of the bounds: quick, and none of its plans need be least."""

    def plan(self, problem: Problem) -> PlannerAnswer:
        return quick_planner(problem)

    def impossible(self, problem: Problem) -> tuple[Reason, ...]:
        return find_barriers(problem)

    def least(self, problem: Problem) -> int:
        return 0


def play(
    layout: str, scenario: str, *injected: str, seed: int = 0, backend: str = "geometric",
    on_failure: str = "replan",
) -> tuple[RunOutcome, list[dict[str, Any]]]:  # fmt: skip
    where = read_layout(layout, "layout.yaml")
    found = read_scenario(scenario, "scenario.yaml", where)
    problem = pose_problem(where, found)
    lines: list[str] = []
    request = RunRequest(problem, found.events)
    injections = read_injections(injected, problem, found.events)
    rules = Rules(seed=seed, on_failure=on_failure)
    room = build_checked_room(problem)
    outcome, _ = play_run(
        request, room, Quick(), backend, rules, injections, Showing(listener=lines.append)
    )
    return outcome, [json.loads(line) for line in lines]


SCENES = ((AISLE, SWAP), (HALL, LUNCH), (RING, TURN))


def calm(layout: str, scenario: str, seed: int) -> str:
    """Plays a scene with trouble by chance, twice; returns its status.

    Raises `AssertionError` where robots or people are touched, the run does not end well though every robot
    that stopped goes on, a party is lost, nothing says why it was given up, or the second run differs.
    """
    rng = Random(f"trouble {seed}")
    names = [name for name, _ in read_layout(layout, "l").agents]
    edges = read_layout(layout, "l").edges
    trouble = [f"slip:{rng.choice(['0', '0.1', '0.2'])}"]
    for _ in range(rng.randrange(3)):
        trouble.append(f"stall:{rng.choice(names)}:{rng.randrange(1, 9)}@{rng.randrange(20)}")
        trouble.append(f"out:{rng.choice(names)}@{rng.randrange(20)}+{rng.randrange(1, 20)}")
        edge = "-".join(rng.choice(edges))
        trouble.append(f"block:{edge}@{rng.randrange(20)}+{rng.randrange(1, 15)}")
    lost = rng.choice(names) if rng.random() < 0.25 else None
    if lost is not None:  # for good
        trouble.append(f"out:{lost}@{rng.randrange(20)}")
    outcome, events = play(layout, scenario, *trouble, seed=seed)
    assert outcome.failures == (), (seed, trouble, outcome.failures)
    if lost is None:
        assert outcome.status == "done", (seed, trouble, outcome.why)
    else:
        assert outcome.status == "done" or outcome.why, (seed, trouble, outcome.status)
    state = outcome.final_state
    guests = {name for party in state.parties() for name in party}
    came = {"c1", "c2", "c9"} if scenario == LUNCH else set()
    assert came <= guests, (seed, trouble, guests)
    if scenario == LUNCH and outcome.status == "done":
        assert len(state.seated) == 3, (seed, trouble, state)
    assert play(layout, scenario, *trouble, seed=seed)[1] == events
    return outcome.status
