"""What the cheap dataclasses save: the classes of SPARC's tree, and whole commands, with and without.

    python benchmarks/bench_start.py [--runs N]

Each command runs with `sparc.lazy_dataclass` and with the standard library's dataclasses in its
place, in turn; the first row defines the classes of `sparc.syntax.tree` alone.  When its difference is
below 5 ms, `sparc/lazy_dataclass.py` can be deleted.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import environment, once, table

SWAP = """
import dataclasses, sys, types
import sparc
swapped = sys.modules["sparc.lazy_dataclass"] = types.ModuleType("sparc.lazy_dataclass")
swapped.dataclass, swapped.field = dataclasses.dataclass, dataclasses.field
"""
RUN = """
import sys
from waiter_cli.app import run
sys.exit(run(sys.argv[1:]))
"""
TREE = """
import time, typing
import sparc.source
start = time.process_time()
import sparc.syntax.tree
print(time.process_time() - start)
"""
COMMANDS = (
    ("--help",),
    ("plan", "--scenario", "b1"),
    ("sparc", "check", "domains/report/domain.sparc"),
)


def tree(swap: str) -> float:
    """Returns the CPU milliseconds that the classes of SPARC's tree take in a fresh interpreter."""
    done = subprocess.run(
        [sys.executable, "-c", swap + TREE],
        capture_output=True, text=True, check=True, env=environment(),
    )  # fmt: skip
    return 1000 * float(done.stdout)


def command(arguments: tuple[str, ...], swap: str) -> float:
    """Returns the CPU milliseconds of one run of ``waiter`` with these arguments."""
    return 1000 * once((sys.executable, "-c", swap + RUN, *arguments)).cpu


def row(name: str, ours: list[float], theirs: list[float]) -> tuple[str, float, float, float]:
    """Returns the medians, and the median of the ratios of the pairs."""
    ratios = [b / a for a, b in zip(ours, theirs, strict=True)]
    return name, statistics.median(ours), statistics.median(theirs), statistics.median(ratios)


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--runs", type=int, default=15)
    runs = range(parser.parse_args().runs)
    pairs = [(tree(""), tree(SWAP)) for _ in runs]
    rows = [row("the tree's classes", [a for a, _ in pairs], [b for _, b in pairs])]
    for arguments in COMMANDS:
        command(arguments, ""), command(arguments, SWAP)  # the byte code is written
        pairs = [(command(arguments, ""), command(arguments, SWAP)) for _ in runs]
        name = "waiter " + " ".join(arguments)
        rows.append(row(name, [a for a, _ in pairs], [b for _, b in pairs]))
    table(("CPU ms", "ours", "dataclasses", "ratio"), rows)


if __name__ == "__main__":
    main()
