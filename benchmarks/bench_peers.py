"""`waiter plan` beside Fast Downward (A* with lmcut) and pyperplan, on the same problems.

    python benchmarks/bench_peers.py [--seeds 3] [--time-limit 60] [--sizes S M L XL] [--chart FILE]

Needs ``pip install up-fast-downward pyperplan``; a peer that is missing is left out with a word.
Every length is compared: a difference ends the benchmark.  Whole processes, one run on one machine.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from importlib.util import find_spec

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.bars import draw_bars
from benchmarks.measure import WAITER, Figures, environment, measure, table
from benchmarks.pddl import DOMAIN, problem_text


def fast_downward() -> list[str] | None:
    """The command of Fast Downward's A* with lmcut, None where it is not installed."""
    found = find_spec("up_fast_downward")
    if found is None or not found.submodule_search_locations:
        return None
    driver = os.path.join(found.submodule_search_locations[0], "downward", "fast-downward.py")
    return [sys.executable, driver] if os.path.exists(driver) else None


def lines_of(path: str) -> int | None:
    """The number of actions in a plan file, None where there is none."""
    if not os.path.exists(path):
        return None
    with open(path) as file:
        return sum(1 for line in file if line.startswith("("))


class Instance:
    """One generated restaurant with its evening, as YAML and as PDDL."""

    def __init__(self, size: str, seed: int, folder: str) -> None:
        from waiter_cli.files.layout_reader import read_layout
        from waiter_cli.files.scenario_reader import read_scenario
        from waiter_cli.layout_tools.generate import generate_instance
        from waiter_cli.problems.pose import pose_problem

        layout_text, scenario_text = generate_instance(seed, size)
        self.size, self.seed, self.folder = size, seed, folder
        stem = os.path.join(folder, f"{size}{seed}")
        layout = read_layout(layout_text, "layout")
        problem = pose_problem(layout, read_scenario(scenario_text, "scenario", layout))
        self.layout, self.scenario = (
            self.keep(stem + ".yaml", layout_text),
            self.keep(stem + "-evening.yaml", scenario_text),
        )
        self.domain = self.keep(stem + "-domain.pddl", DOMAIN)
        self.problem = self.keep(stem + "-problem.pddl", problem_text(problem))

    @staticmethod
    def keep(path: str, text: str) -> str:
        with open(path, "w") as file:
            file.write(text)
        return path

    def ours(self, runs: int, limit: float) -> tuple[Figures, int | None]:
        """Our figures, and the length that we prove minimal."""
        command = [*WAITER, "plan", "-l", self.layout, "-s", self.scenario, "--json"]
        command += ["--time-limit", str(limit)]
        done = subprocess.run(
            command, capture_output=True, text=True, env=environment(), check=False
        )
        answer = json.loads(done.stdout)
        length = answer["horizon"] if answer["status"] == "plan" else None
        return measure(command, runs, limit + 10), length

    def downward(self, command: list[str], runs: int, limit: float) -> tuple[Figures, int | None]:
        """Fast Downward's figures and length."""
        plan = self.problem + ".plan"
        sas = self.problem + ".sas"
        full = [*command, "--plan-file", plan, "--sas-file", sas, self.domain, self.problem]
        full += ["--search", "astar(lmcut())"]
        figures = measure(full, runs, limit)
        return figures, lines_of(plan) if figures.code != -1 else None

    def pyperplan(self, runs: int, limit: float) -> tuple[Figures, int | None]:
        """pyperplan's figures (blind A*) and length."""
        command = [sys.executable, "-m", "pyperplan", "-s", "astar", "-H", "blind"]
        figures = measure([*command, self.domain, self.problem], runs, limit)
        return figures, lines_of(self.problem + ".soln") if figures.code != -1 else None


def main() -> None:
    """Runs every instance through every planner that is here."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--time-limit", type=float, default=60)
    parser.add_argument("--sizes", nargs="+", default=["S", "M", "L", "XL"])
    parser.add_argument("--chart", metavar="FILE", help="also draw the figures as a PNG")
    options = parser.parse_args()
    downward = fast_downward()
    blind = find_spec("pyperplan") is not None
    for name, here in (("up-fast-downward", downward), ("pyperplan", blind)):
        if not here:
            print(f"without {name}: pip install {name}")
    rows: list[tuple[object, ...]] = []
    with tempfile.TemporaryDirectory() as folder:
        for size in options.sizes:
            for seed in range(options.seeds):
                one = Instance(size, seed, folder)
                ours, length = one.ours(options.runs, options.time_limit)
                found = {"waiter": length}
                peers: list[Figures | None] = [None, None]
                if downward:
                    peers[0], found["Fast Downward"] = one.downward(
                        downward, options.runs, options.time_limit
                    )
                if blind and size in ("S", "M"):
                    peers[1], found["pyperplan"] = one.pyperplan(1, options.time_limit)
                if len({n for n in found.values() if n is not None}) > 1:
                    raise SystemExit(f"{size}{seed}: the lengths differ: {found}")
                seconds = [None if p is None else (p.wall if p.code != -1 else None) for p in peers]
                over = f">{options.time_limit:.0f}"
                rows.append((
                    f"{size}{seed}", length if length is not None else "-", ours.wall, ours.memory,
                    *(s if s is not None else (over if p else "-") for s, p in zip(seconds, peers)),
                    seconds[0] / ours.wall if seconds[0] else "-",
                ))  # fmt: skip
                print(f"{size}{seed} done", file=sys.stderr)
    print("whole processes, wall seconds (MB at the peak); ratio: Fast Downward to waiter")
    table(("problem", "steps", "waiter", "MB", "Fast Downward", "pyperplan", "ratio"), rows)
    if options.chart:
        bars = [(str(row[0]), (row[2], row[4], row[5])) for row in rows]
        peers = ("waiter", "Fast Downward", "pyperplan")
        draw_bars(peers, bars, options.chart, options.time_limit)


if __name__ == "__main__":
    main()
