"""Evenings with orders, refills and bills: how many are proved, how fast, and in how much memory.

    python benchmarks/bench_orders.py [--families gen,brief,plates] [--sizes M,L,XL] [--seeds 10]
                                      [--limit 30] [--before] [--alone]

Whole processes (`waiter plan --json --time-limit LIMIT`), one thread each; seconds are of the
processor. ``gen`` is `generate_instance(..., bar=True)`, ``brief`` is ``layout new --bar`` with an
evening of parties, bills, orders and refills, ``plates`` is ``gen`` with an instant kitchen.
``--before`` adds, in the same run, what the bounds prove that do without a linear programme,
``--alone`` what clingo proves of the SPARC program without any bounds.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from typing import Any

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import WAITER, environment, table

BRIEF = {"M": (20, 8, 2, 1, 2, 2), "L": (50, 20, 3, 2, 4, 3), "XL": (120, 50, 6, 4, 8, 6)}


def main() -> None:
    """One row for each family and size."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--families", default="gen,brief,plates")
    parser.add_argument("--sizes", default="M,L,XL")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--limit", type=float, default=30)
    parser.add_argument("--before", action="store_true")
    parser.add_argument("--alone", action="store_true")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for family in options.families.split(","):
            for size in options.sizes.split(","):
                found = [one(family, size, k, folder, options) for k in range(options.seeds)]
                rows.append(summary(f"{family} {size}", found))
                print(*rows[-1], flush=True)
    headings = (
        "family",
        "evenings",
        "proved",
        "gap %",
        "median s",
        "p95 s",
        "MB",
        "before",
        "alone",
    )
    table(headings, rows)


def texts(family: str, size: str, seed: int) -> tuple[str, str]:
    """The layout and the evening as YAML."""
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.layout_tools.generate import (
        generate_instance,
        generate_layout,
        generate_scenario,
    )

    if family != "brief":
        layout, evening = generate_instance(seed, size, bar=True)
        return layout, evening + "instant_kitchen: true\n" * (family == "plates")
    nodes, tables, parties, bills, orders, refills = BRIEF[size]
    layout = generate_layout(seed, nodes, tables, bar=True)
    room = read_layout(layout, "layout.yaml")
    return layout, generate_scenario(seed, room, parties, bills, orders=orders, refills=refills)


Found = tuple[bool, float, float, float, "bool | None", "bool | None"]


def one(family: str, size: str, seed: int, folder: str, options: argparse.Namespace) -> Found:
    """Whether it was proved, the gap in parts, CPU seconds, megabytes; whether before, and alone."""
    paths = []
    for name, text in zip(("layout.yaml", "evening.yaml"), texts(family, size, seed)):
        paths.append(os.path.join(folder, name))
        with open(paths[-1], "w") as file:
            file.write(text)
    answer = os.path.join(folder, "answer.json")
    document, usage = planned(paths, answer, options.limit)
    lower, upper = document["bounds"]
    gap = 1.0 if upper is None else (upper - lower) / max(upper, 1)
    seconds = usage.ru_utime + usage.ru_stime
    before = closed_before(*paths) if options.before else None
    alone = None
    if options.alone:
        alone = bool(planned(paths, answer, options.limit, "--search", "gallop")[0]["minimal"])
    return bool(document["minimal"]), gap, seconds, usage.ru_maxrss / 1024, before, alone


def planned(
    paths: list[str], answer: str, limit: float, *more: str
) -> tuple[dict[str, Any], resource.struct_rusage]:
    """The answer of one process that plans, and what it used."""
    command = [*WAITER, "plan", "-l", paths[0], "-s", paths[1], "--json", *more]
    command += ["--time-limit", str(limit)]
    with open(answer, "w") as file:
        process = subprocess.Popen(
            command, stdout=file, stderr=subprocess.DEVNULL, env=environment()
        )
        _, _, usage = os.wait4(process.pid, 0)
        process.returncode = 0
    with open(answer) as file:
        return json.load(file), usage


def closed_before(layout: str, evening: str) -> bool:
    """Whether the bounds without a linear programme meet, with all the effort there is."""
    from waiter_cli.bounds import find_bounds
    from waiter_cli.problems.from_options import read_problem

    problem, _ = read_problem(layout, evening)
    bounds = find_bounds(problem, deadline=time.monotonic() + 30, effort=10)
    return bounds.plan is not None and bounds.lower == bounds.plan.horizon


def summary(name: str, found: list[Found]) -> tuple[object, ...]:
    """One row of the table."""
    proved, gaps, seconds, memory, *others = zip(*found)
    order = sorted(seconds)
    late = order[min(len(order) - 1, round(0.95 * (len(order) - 1)))]
    known = ["" if other[0] is None else sum(map(bool, other)) for other in others]
    return (
        name,
        len(found),
        sum(proved),
        100 * statistics.median(gaps),
        statistics.median(order),
        late,
        round(max(memory)),
        *known,
    )


if __name__ == "__main__":
    main()
