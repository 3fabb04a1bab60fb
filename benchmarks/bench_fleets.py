"""What several robots cost: walks on maps of rooms and corridors, service in the built-in restaurants.

    python benchmarks/bench_fleets.py

Processor seconds of planning alone, in one process; ``steps`` has a ``?`` where it is not proved least,
and then the lower bound behind it.
"""

from __future__ import annotations

import argparse
import random
import time
from collections.abc import Iterator
from dataclasses import replace

import waiter_cli
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.enlarge import with_robots
from waiter_cli.model.problem import Problem

SEATING = """\
state:
  seated: {table1: [a1], table5: [b1, b2]}
  waiting: [[c1, c2], [d1], [e1, e2, e3], [f1, f2]]
  wants_bill: [table1, table5]
"""
ORDERS = """\
state:
  seated: {table1: [a1], table4: [b1, b2], table7: [c1], table8: [d1]}
  ready_to_order: [table1, table4, table7, table8]
"""


def floor(nodes: int, seed: int) -> list[tuple[int, int]]:
    """Corridors with rooms beside them, and a way round here and there."""
    rng = random.Random(seed)
    edges = {
        (rng.choice((k - 1, k - 1, max(0, k - rng.randint(1, 4)))), k) for k in range(1, nodes)
    }
    while len(edges) < nodes + nodes // 5:
        first = rng.randrange(nodes - 6)
        edges.add((first, first + rng.randint(2, 6)))
    return sorted(edges)


def walk(nodes: int, robots: int, seed: int) -> Problem:
    """Robots on nodes by chance, each of whom has to be where the next one is."""
    rng = random.Random(seed)
    starts = rng.sample(range(nodes), robots)
    edges = ", ".join(f"[n{a}, n{b}]" for a, b in floor(nodes, seed))
    agents = ", ".join(f"r{k}: n{at}" for k, at in enumerate(starts))
    names = ", ".join(f"n{k}" for k in range(nodes))
    text = f"nodes: [{names}]\nedges: [{edges}]\nentrance: n0\ntables: {{}}\nagents: {{{agents}}}\n"
    ends = zip(range(robots), [*starts[1:], starts[0]])
    goal = ", ".join(f"r{k}: n{at}" for k, at in ends)
    return waiter_cli.pose_problem(read_layout(text, "map.yaml"), goals=[f"at: {{{goal}}}"])


def service(layout: str, scenario: str, starts: dict[str, str]) -> Problem:
    """A scenario in a built-in restaurant with these robots."""
    one = waiter_cli.read_layout(layout)
    several = replace(one, agents=tuple(starts.items()))
    return waiter_cli.pose_problem(several, read_scenario(scenario, "evening.yaml", several))


def problems() -> Iterator[tuple[str, Problem]]:
    for nodes, robots in ((21, 4), (29, 6), (60, 6), (126, 4), (126, 10)):
        for seed in (1, 2):
            yield f"{robots} change places on {nodes} nodes, map {seed}", walk(nodes, robots, seed)
    at_large = {"r1": "n1", "r2": "n7"}
    yield "report_large, 2 robots: 4 parties, 2 bills", service("report_large", SEATING, at_large)
    at_bistro = {"r1": "bar1", "r2": "south1"}
    yield "bistro, 2 robots: 4 orders to the bar", service("bistro", ORDERS, at_bistro)
    lunch = waiter_cli.pose_problem(*waiter_cli.read_scenario("lunch"))
    for count in (1, 2, 3, 4):
        yield f"bistro, lunch, {count} robots", with_robots(lunch, count)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--time-limit", type=float, default=60.0, help="seconds for each problem")
    parser.add_argument("--only", default="", help="those whose name has this in it")
    options = parser.parse_args()
    print("| problem | steps | fewest actions | seconds |\n|---|---|---|---|")
    for name, problem in problems():
        if options.only not in name:
            continue
        since = time.process_time()
        answer = waiter_cli.plan(problem, time_limit=options.time_limit)
        seconds = time.process_time() - since
        lower, upper = answer.result.bounds
        steps = str(upper) if answer.result.minimal else f"{upper or 'none'}? (≥ {lower})"
        fewest = answer.fewest_actions if problem.layout.agents and answer.plan else ""
        print(f"| {name} | {steps} | {fewest} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()
