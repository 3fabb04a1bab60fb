"""How long `waiter serve` takes from an observation to a plan, cold and warm.

    python benchmarks/bench_serve.py [--events N] [--seeds N] [--time-limit SECONDS] [--processor]

Cold: a new process, from its start to the first plan.  Warm: lunches by chance in one process, as
in the tests; only observations, goals and the like are counted, not reports of steps.  The targets
are p50 <= 50 ms and p95 <= 150 ms on the report's layout, and p95 <= 500 ms at 50 nodes, 20 tables;
with a bar p95 <= 250 ms, and at most 2 % of searches late (cut at the time limit).  On a machine that others keep busy,
``--processor`` counts seconds of the processor, the time limit's too, and leaves out cold; HiGHS
alone keeps to the clock, so that what it closes is still too little then.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from dataclasses import replace
from typing import Any

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import WAITER, environment, table
from tests.support.lunch import Lunch
from tests.support.serving import Live
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import SIZES, generate_instance, generate_layout
from waiter_cli.model.layout import Layout


def cold(layout: str, runs: int) -> list[float]:
    """Milliseconds from the start of a process to its first plan."""
    found = []
    for _ in range(runs):
        start = time.perf_counter()
        loop = subprocess.Popen(
            [*WAITER, "serve", "--layout", layout],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment(),
        )
        assert loop.stdin is not None and loop.stdout is not None
        loop.stdin.write(b'{"observe": {"enter": ["c1"]}}\n')
        loop.stdin.flush()
        loop.stdout.readline()
        assert json.loads(loop.stdout.readline())["plan"]
        found.append((time.perf_counter() - start) * 1000)
        loop.stdin.close()
        loop.wait()
    return found


def lunches(layouts: list[Layout], events: int, time_limit: float) -> dict[str, Any]:
    """Figures of a lunch in each layout, together."""
    times: list[float] = []
    late = searches = 0
    for seed, layout in enumerate(layouts):
        live, lunch = Live(layout, time_limit=time_limit), Lunch(layout, seed)
        plan: list[dict[str, Any]] = []
        live.session.thinker.warm_up(layout, live.session.executive.state)
        for _ in range(events):
            line = lunch.next_line(plan)
            answer = live.tell(line)
            plan = answer["plan"]
            if "observe" in line:
                times.append(answer["latency_ms"])
        late += live.session.thinker.late
        searches += live.session.thinker.searches
    return _figures(times, late, searches)


def evenings(seeds: int, time_limit: float) -> dict[str, Any]:
    """Figures of evenings of size L: everybody who comes in, one party after the other."""
    times: list[float] = []
    late = searches = 0
    for seed in range(seeds):
        layout_text, text = generate_instance(seed, "L", bar=False)
        layout = read_layout(layout_text, "l.yaml")
        scenario = read_scenario(text, "evening.yaml", layout)
        quiet = replace(scenario, observe=(), goals=None)
        live = Live(layout, quiet, time_limit=time_limit)
        for seen in scenario.observe:
            what: Any = list(seen.arguments) if seen.kind == "enter" else seen.arguments[0]
            times.append(live.seen({seen.kind: what})["latency_ms"])
        late += live.session.thinker.late
        searches += live.session.thinker.searches
    return _figures(times, late, searches)


def _figures(times: list[float], late: int, searches: int) -> dict[str, Any]:
    cuts = statistics.quantiles(times, n=100, method="inclusive")
    return {"n": len(times), "p50": cuts[49], "p95": cuts[94], "p99": cuts[98],
            "searches": searches, "late": late}  # fmt: skip


def main() -> None:
    """Prints one table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--events", type=int, default=150)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--time-limit", type=float, default=0.4)
    parser.add_argument("--processor", action="store_true")
    given = parser.parse_args()
    if given.processor:
        time.monotonic = time.perf_counter = time.process_time
    size = SIZES["L"]
    seeds = range(given.seeds)

    def generated(bar: bool) -> list[Layout]:
        texts = [generate_layout(s, size.nodes, size.tables, bar=bar, waiters=2) for s in seeds]
        return [read_layout(text, "l.yaml") for text in texts]

    print(f"a search may take {given.time_limit} s")
    report, large, bistro = map(read_layout_file, ("report", "report_large", "bistro"))
    rows = []
    for name, target, layouts in (
        ("report", "p50 50, p95 150", [report] * given.seeds),
        ("report_large", "", [large] * given.seeds),
        ("bistro, with a bar", "p95 250, late 2 %", [bistro] * given.seeds),
        ("50 nodes, 20 tables", "p95 500", generated(False)),
        ("the same with a bar", "p95 250, late 2 %", generated(True)),
    ):
        found = lunches(layouts, given.events, given.time_limit)
        rows.append((name, *_cells(found), target))
    rows.append(("evenings of size L", *_cells(evenings(given.seeds, given.time_limit)), "p95 500"))
    table(("warm", "n", "p50 ms", "p95 ms", "p99 ms", "searches", "late", "target"), rows)
    if not given.processor:
        first = cold("report", 5)
        print(f"cold, report: {statistics.median(first):.0f} ms from process start to plan")


def _cells(found: dict[str, Any]) -> tuple[str, ...]:
    times = (f"{found[key]:.1f}" for key in ("p50", "p95", "p99"))
    return (str(found["n"]), *times, str(found["searches"]), _share(found))


def _share(found: dict[str, Any]) -> str:
    """Late searches, and their share of all."""
    return f"{found['late']} ({100 * found['late'] / max(found['searches'], 1):.1f} %)"


if __name__ == "__main__":
    main()
