"""What several robots cost: walks on real maps, service in built-in and in generated restaurants.

    python benchmarks/bench_fleets.py [--peers [--chart FILE]]

Processor seconds of planning alone, in one process; ``steps`` has a ``?`` where it is not proved least,
and then the lower bound behind it.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

import waiter_cli
from benchmarks.bars import draw_bars
from benchmarks.fleet_peers import cp_sat, has_cp_sat, program_alone, takes
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.fleets.enlarge import with_robots
from waiter_cli.layout_tools.generate import build_layout, generate_scenario, write_layout
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


MAPS = Path(__file__).parent / "maps"


def walk(name: str, robots: int, kind: str, seed: int) -> Problem:
    """Robots on nodes of a map by chance; two by two they change places, or all in a ring do."""
    rng = random.Random(f"{name} {robots} {kind} {seed}")
    layout = waiter_cli.read_layout(str(MAPS / f"{name}.yaml"))
    starts = rng.sample([node.name for node in layout.nodes], robots)
    pairs = [starts[k ^ 1] for k in range(robots)]
    ends = pairs if kind == "swap" else [*starts[1:], starts[0]]
    agents = tuple((f"r{k}", at) for k, at in enumerate(starts))
    goal = ", ".join(f"r{k}: {at}" for k, at in enumerate(ends))
    return waiter_cli.pose_problem(replace(layout, agents=agents), goals=[f"at: {{{goal}}}"])


def evening(seed: int, nodes: int, tables: int, work: tuple[int, ...], robots: int) -> Problem:
    """A generated restaurant; ``work`` counts its parties, bills, orders and refills."""
    made = build_layout(seed, nodes, tables, name=f"g{seed}", bar=True)
    parties, bills, orders, refills = work
    text = generate_scenario(seed, made, parties, bills, orders=orders, refills=refills)
    layout = read_layout(write_layout(made), "layout.yaml")
    one = waiter_cli.pose_problem(layout, read_scenario(text, "evening.yaml", layout))
    return with_robots(one, robots)


def service(layout: str, scenario: str, starts: dict[str, str]) -> Problem:
    """A scenario in a built-in restaurant with these robots."""
    one = waiter_cli.read_layout(layout)
    several = replace(one, agents=tuple(starts.items()))
    return waiter_cli.pose_problem(several, read_scenario(scenario, "evening.yaml", several))


def problems() -> Iterator[tuple[str, Problem]]:
    for name in ("hotel", "office", "clinic", "airport"):
        for robots in (2, 4, 6, 8, 10):
            for kind in ("swap", "permutation"):
                yield f"walk: {name}, {robots} robots, {kind}", walk(name, robots, kind, 0)
    at_large = {"r1": "n1", "r2": "n7"}
    yield "report_large, 2 robots: 4 parties, 2 bills", service("report_large", SEATING, at_large)
    at_bistro = {"r1": "bar1", "r2": "south1"}
    yield "bistro, 2 robots: 4 orders to the bar", service("bistro", ORDERS, at_bistro)
    lunch = waiter_cli.pose_problem(*waiter_cli.read_scenario("lunch"))
    for count in (1, 2, 3, 4):
        yield f"bistro, lunch, {count} robots", with_robots(lunch, count)
    for seed in range(20):
        robots = 2 + seed % 2
        name = f"generated {seed}: {robots} robots, 8 jobs, 50 nodes"
        yield name, evening(seed, 50, 10, (3, 2, 2, 1), robots)
    for seed in range(5):
        name = f"generated {seed}: 4 robots, 12 jobs, 120 nodes"
        yield name, evening(seed, 120, 20, (4, 3, 3, 2), 4)


def beside(name: str, problem: Problem, proved: int | None, limit: float) -> list[object]:
    """The seconds of the peers, ``>60`` where they did not get there, None where they cannot; a difference ends it."""
    found: list[object] = []
    for peer in (program_alone, cp_sat):
        if peer is cp_sat and not (has_cp_sat() and takes(problem)):
            found.append(None)
            continue
        since = time.process_time()
        length = peer(problem, limit)
        seconds = time.process_time() - since
        if None not in (length, proved) and length != proved:
            raise SystemExit(f"{name}: {peer.__name__} says {length}, not {proved}")
        found.append(seconds if length is not None else f">{limit:.0f}")
    return found


def small_service() -> Iterator[tuple[str, Problem]]:
    """Service that grows: parties and orders of 2 robots in the report's large hall and in the bistro."""
    waiting = ("c1, c2", "d1", "e1, e2, e3", "f1, f2")
    tables = ("table1", "table4", "table7", "table8")
    for count in (1, 2, 3, 4):
        parties = ", ".join(f"[{party}]" for party in waiting[:count])
        text = f"state: {{waiting: [{parties}]}}"
        starts = {"r1": "n1", "r2": "n7"}
        yield f"seating {count}", service("report_large", text, starts)
    for count in (1, 2, 3, 4):
        seated = ", ".join(f"{table}: [g{table[-1]}]" for table in tables[:count])
        ready = ", ".join(tables[:count])
        text = f"state: {{seated: {{{seated}}}, ready_to_order: [{ready}]}}"
        yield f"orders {count}", service("bistro", text, {"r1": "bar1", "r2": "south1"})


def walks_beside() -> Iterator[tuple[str, Problem]]:
    """Rings of robots on the maps."""
    for name in ("hotel", "office", "clinic"):
        for robots in (4, 10):
            yield f"{name}, {robots}", walk(name, robots, "permutation", 0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--time-limit", type=float, default=60.0, help="seconds for each problem")
    parser.add_argument("--only", default="", help="those whose name has this in it")
    parser.add_argument("--peers", action="store_true", help="the program alone and CP-SAT too")
    parser.add_argument("--chart", metavar="FILE", help="also draw the figures of --peers as a PNG")
    options = parser.parse_args()
    more = " program alone | CP-SAT |" if options.peers else ""
    if options.peers and not has_cp_sat():
        print("without CP-SAT: pip install ortools\n")
    print(f"| problem | steps | fewest actions | seconds |{more}")
    print("|---" * (6 if options.peers else 4) + "|")
    bars: list[tuple[str, list[object]]] = []
    for name, problem in (*walks_beside(), *small_service()) if options.peers else problems():
        if options.only not in name:
            continue
        since = time.process_time()
        answer = waiter_cli.plan(problem, time_limit=options.time_limit)
        seconds = time.process_time() - since
        lower, upper = answer.result.bounds
        steps = str(upper) if answer.result.minimal else f"{upper or 'none'}? (≥ {lower})"
        fewest = answer.fewest_actions if problem.layout.agents and answer.plan else ""
        row = f"| {name} | {steps} | {fewest} | {seconds:.2f} |"
        if options.peers:
            proved = upper if answer.result.minimal else None
            own = seconds if answer.result.minimal else f">{options.time_limit:.0f}"
            others = beside(name, problem, proved, options.time_limit)
            bars.append((name, [own, *others]))
            row += "".join(f" {_cell(value)} |" for value in others)
        print(row, flush=True)
    if options.chart:
        peers = ("waiter", "program alone", "CP-SAT")
        draw_bars(peers, bars, options.chart, options.time_limit, left=120)


def _cell(value: object) -> str:
    """Seconds in a table; nothing for None."""
    return f"{value:.2f}" if isinstance(value, float) else str(value or "")


if __name__ == "__main__":
    main()
