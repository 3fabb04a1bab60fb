"""Measures what a study costs: an evening alone, the overhead of a run, and what a second worker brings.

    python benchmarks/bench_study.py [EVENINGS]

Overhead is processor time of one worker and its parent over that of the same evenings played one
after the other in one process; gain is the time of one worker over that of two.  Both are meaningful on a
machine that has nothing else to do.
"""

from __future__ import annotations

import resource
import statistics
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

from waiter_cli import __version__
from waiter_cli.study.conduct import run_study
from waiter_cli.study.evening_run import play_evening
from waiter_cli.study.local_workers import play_locally
from waiter_cli.study.studies import RunLimits, Study, runs_of
from waiter_cli.study.study_file import read_study

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"


def processor_time() -> float:
    """Seconds of this process and of its children that have ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def studied(study: Study, workers: int) -> tuple[float, float]:
    """Seconds of the clock and of processors that a study takes."""
    with tempfile.TemporaryDirectory() as folder:
        begun, used = time.perf_counter(), processor_time()
        play = partial(play_locally, workers=workers, limits=RunLimits(600.0))
        counts = run_study(study, str(Path(folder) / "s.db"), play)
        assert counts.done == study.size, counts
        return time.perf_counter() - begun, processor_time() - used


def main() -> None:
    evenings = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    text = f"layouts: [bistro]\nevenings: {{scenario: friday.yaml, seeds: 1..{evenings}}}\n"
    study = read_study(text, "bench.yaml", str(EXAMPLES))
    runs = list(runs_of(study, __version__))
    play_evening(runs[0], RunLimits())  # loads what has to be loaded
    alone = []
    for run in runs:
        used = processor_time()
        assert play_evening(run, RunLimits()).status == "done"
        alone.append(processor_time() - used)
    print(f"an evening, bistro, geometric: median {statistics.median(alone):.2f} s of a processor")
    one, used = studied(study, 1)
    print(f"one worker: {100 * (used / sum(alone) - 1):+.1f} % over {evenings} evenings alone")
    two, _ = studied(study, 2)
    print(f"two workers: {one / two:.2f} times as fast as one")


if __name__ == "__main__":
    main()
