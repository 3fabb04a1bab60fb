"""A plan for several robots without search: tours dealt out, then walked one after the other. Entry point `construct`."""

from __future__ import annotations

import time
from collections.abc import Iterator
from itertools import chain, islice, permutations
from random import Random

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.jobs import Stage, find_jobs
from waiter_cli.fleets.routing import Router
from waiter_cli.fleets.space_time import SpaceTime, Trail
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

__all__ = ["Construction", "construct"]

ORDERS, ROUNDS = 6, 24
"""So many orders of robots are tried, the longest tours first, and so many by chance."""
TRIED = 3000
"""So many jobs are dealt out anew."""


@dataclass(frozen=True)
class Construction:
    """``plan`` is legal and reaches the goals, None where none was found this way.

    ``deals`` say which robot does what (`Action`, each at step 0), and ``length`` how many steps
    that takes where none is in another one's way.
    """

    plan: Plan | None
    deals: tuple[Action, ...]
    length: int


def construct(problem: Problem, least: int, deadline: float | None = None) -> Construction | None:
    """Returns tours for the robots and a plan that follows them, None where goals are no jobs.

    It looks for better ones until one has ``least`` steps, or ``deadline`` (of `time.monotonic`).
    """
    jobs = find_jobs(problem)
    if jobs is None or problem.before:
        return None
    router = Router(problem, jobs)
    if not router.find(max(40, TRIED // (1 + len(jobs.jobs))), least, deadline):
        return None
    names = [robot.name for robot in problem.state.robots]
    stages = {name: router.stages(name) for name in names}
    lengths = {name: len(stages[name]) for name in names}
    deals = tuple(
        Action(0, stage.name, (name, *stage.arguments))
        for name in names
        for stage in stages[name]
        if stage.name
    )
    best: Plan | None = None
    longest_first = sorted(names, key=lambda name: -router.tours[name].walk() - lengths[name])
    rng = Random(2)
    for order in chain(islice(permutations(longest_first), ORDERS), _shuffles(names, rng)):
        late = {} if best is None else {name: rng.choice((0, 0, 1, 2, 3, 5)) for name in names}
        plan = _walked(problem, router, stages, order, late, deadline)
        if plan is not None and (best is None or plan.horizon < best.horizon):
            best = plan
        enough = best is not None and best.horizon <= max(least, router.length)
        if enough or (deadline is not None and time.monotonic() > deadline):
            break
    return Construction(best, deals, router.length)


def _shuffles(names: list[str], rng: Random) -> Iterator[tuple[str, ...]]:
    """Orders of robots by chance, without end."""
    for _ in range(ROUNDS):
        yield tuple(rng.sample(names, len(names)))


def _walked(
    problem: Problem,
    router: Router,
    stages: dict[str, list[Stage]],
    order: tuple[str, ...],
    late: dict[str, int],
    deadline: float | None,
) -> Plan | None:
    """The plan in which robots find their ways in this order; None where one finds none.

    Some do nothing but walk for the first steps, so that others can go before them.
    """
    most = 4 * max(len(problem.layout.nodes), 10) + 4 * sum(map(len, stages.values()))
    floor = SpaceTime(problem, most, deadline)
    stations = problem.state.stations()
    trails: dict[str, Trail] = {}
    for k, name in enumerate(order):
        waiting = [stations[other] for other in order[k + 1 :]]
        trail = floor.travel(
            stations[name],
            stages[name],
            router.ends.get(name),
            waiting=waiting,
            late=late.get(name, 0),
        )
        if trail is None:
            return None
        trails[name] = trail
        floor.trails.append(trail)
    horizon = max(trail.finished for trail in trails.values())
    actions = []
    for rank, name in enumerate(stations):
        trail = trails[name]
        done = dict(trail.done)
        for step in range(horizon):
            here, there = trail.at(step), trail.at(step + 1)
            if step in done:
                actions.append(
                    (step, rank, Action(step, done[step].name, (name, *done[step].arguments)))
                )
            elif here != there:
                actions.append((step, rank, Action(step, "go_to", (name, there))))
    plan = Plan(tuple(action for *_, action in sorted(actions, key=lambda a: a[:2])), horizon)
    verdict = run(problem, plan)
    if not verdict.valid or verdict.makespan is None:
        return None
    kept = tuple(action for action in plan.actions if action.step < verdict.makespan)
    return Plan(kept, verdict.makespan)
