"""How the cost of a plan grows with tables, nodes and parties, one at a time.

    python benchmarks/bench_scale.py [--seeds 3]

Whole processes; each row is the median over the seeds. The base is a restaurant of 50 nodes, 20
tables and 6 parties with 3 bills.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import WAITER, environment, measure, table

BASE = {"nodes": 50, "tables": 20, "parties": 6}
GROWTH = {
    "tables": (10, 20, 40, 80),
    "nodes": (30, 60, 120, 240),
    "parties": (2, 4, 8, 16),
}


def main() -> None:
    """One table for each thing that grows."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=3)
    seeds = range(parser.parse_args().seeds)
    with tempfile.TemporaryDirectory() as folder:
        for what, sizes in GROWTH.items():
            rows = []
            for size in sizes:
                shape = {**BASE, what: size}
                shape["tables"] = max(shape["tables"], shape["parties"] + 6)
                found = [one(shape, seed, folder) for seed in seeds]
                rows.append((size, *(statistics.median(column) for column in zip(*found))))
            print(f"growing {what}; otherwise {BASE}")
            table((what, "steps", "wall s", "CPU s", "MB"), rows)


def one(shape: dict[str, int], seed: int, folder: str) -> tuple[int, float, float, float]:
    """Steps, wall and CPU seconds and megabytes of one instance."""
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.layout_tools.generate import generate_layout, generate_scenario
    from waiter_cli.layout_tools.generate_floor import least_nodes

    layout_text = generate_layout(
        seed, max(shape["nodes"], least_nodes(shape["tables"])), shape["tables"]
    )
    scenario_text = generate_scenario(
        seed, read_layout(layout_text, "layout"), parties=shape["parties"], bills=3
    )
    paths = []
    for name, text in (("layout.yaml", layout_text), ("evening.yaml", scenario_text)):
        paths.append(os.path.join(folder, name))
        with open(paths[-1], "w") as file:
            file.write(text)
    command = [*WAITER, "plan", "-l", paths[0], "-s", paths[1], "--json", "--time-limit", "60"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment(), check=False)
    answer = json.loads(done.stdout)
    if answer["status"] != "plan" or not answer["minimal"]:
        raise SystemExit(f"no proved plan for {shape}, seed {seed}: {answer['status']}")
    figures = measure(command, 1)
    return answer["horizon"], figures.wall, figures.cpu, figures.memory


if __name__ == "__main__":
    main()
