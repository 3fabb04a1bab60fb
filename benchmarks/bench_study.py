"""Measures what a study costs: an evening alone, the overhead of a run, and what a second worker brings.

    python benchmarks/bench_study.py [EVENINGS]

An evening is one of three hours with some forty parties in the bistro; it is also shown where its time
goes.  Overhead is processor time of one worker and its parent over that of the same evenings played one
after the other in one process.  Gain is told twice: by the clock, the time of one worker over that of
two, which means something on a machine that has nothing else to do; and by processor time, which two
processes take that share nothing and play half of the evenings each, over that of two workers and
their parent.  That is what is lost to the study itself, whatever else the machine is at.
"""

from __future__ import annotations

import gc
import multiprocessing
import resource
import signal
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import FrameType

from waiter_cli import __version__
from waiter_cli.study.evening_run import play_evening
from waiter_cli.study.local_workers import play_locally
from waiter_cli.study.run_study import run_study
from waiter_cli.study.studies import RunLimits, Study, StudyRun, runs_of
from waiter_cli.study.study_file import read_study

WHO = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
PARTS = {
    "planning": ("/execution/", "/planning/", "/bounds/", "/fleets/", "/diagnosis/"),
    "guests": ("/evenings/",),
    "the world": ("/simulation/", "/room/"),
}
EXAMPLES = Path(__file__).resolve().parent.parent / "examples"


@dataclass(frozen=True)
class Cost:
    """Seconds: of the clock, of the parent's processor time, of the workers'."""

    clock: float
    parent: float
    workers: float


def processor_time(who: int) -> float:
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def studied(study: Study, workers: int) -> Cost:
    """What a study takes; workers have ended when it returns."""
    with tempfile.TemporaryDirectory() as folder:
        begun = time.perf_counter()
        parent, children = (processor_time(who) for who in WHO)
        play = partial(play_locally, workers=workers, limits=RunLimits(600.0))
        counts = run_study(study, str(Path(folder) / "s.db"), play)
        assert counts.done == study.size, counts
        return Cost(
            time.perf_counter() - begun,
            processor_time(WHO[0]) - parent,
            processor_time(WHO[1]) - children,
        )


def play_all(runs: Sequence[StudyRun]) -> None:
    """What a process does that shares nothing."""
    gc.set_threshold(100_000, 20, 20)  # as the workers do
    for run in runs:
        assert play_evening(run, RunLimits()).status == "done"


def apart(runs: Sequence[StudyRun]) -> float:
    """Seconds of processor time that two processes take, half of the evenings each."""
    before = processor_time(WHO[1])
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=play_all, args=(runs[n::2],)) for n in range(2)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    return processor_time(WHO[1]) - before


def shares(run: StudyRun) -> dict[str, float]:
    """The shares of an evening's time, by what is at work: by samples, a thousand a second."""
    counts = dict.fromkeys(PARTS, 0)

    def sample(signum: int, frame: FrameType | None) -> None:
        while frame is not None:
            path = frame.f_code.co_filename
            part = next(
                (part for part, words in PARTS.items() if any(w in path for w in words)), ""
            )
            if part:
                counts[part] += 1
                return
            frame = frame.f_back

    before = signal.signal(signal.SIGPROF, sample)
    signal.setitimer(signal.ITIMER_PROF, 0.001, 0.001)
    try:
        play_evening(run, RunLimits())
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    total = max(1, sum(counts.values()))
    return {part: count / total for part, count in counts.items()}


def main() -> None:
    evenings = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    text = f"layouts: [bistro]\nevenings: {{scenario: friday.yaml, seeds: 1..{evenings}}}\n"
    study = read_study(text, "bench.yaml", str(EXAMPLES))
    runs = list(runs_of(study, __version__))
    gc.set_threshold(100_000, 20, 20)  # as the workers do
    play_evening(runs[0], RunLimits())  # loads what has to be loaded
    alone = []
    for run in runs:
        used = processor_time(WHO[0])
        assert play_evening(run, RunLimits()).status == "done"
        alone.append(processor_time(WHO[0]) - used)
    print(f"an evening, bistro, geometric: median {statistics.median(alone):.2f} s of a processor")
    parts = ", ".join(f"{part} {100 * share:.0f} %" for part, share in shares(runs[0]).items())
    print(f"of that: {parts}")
    one, two = studied(study, 1), studied(study, 2)
    used = one.parent + one.workers
    print(f"one worker: {100 * (used / sum(alone) - 1):+.1f} % over {evenings} evenings alone")
    print(f"two workers, by the clock: {one.clock / two.clock:.2f} times as fast as one")
    ideal = apart(runs)
    print(
        f"by processor time: {2 * ideal / (2 * two.parent + two.workers):.2f} of 2 (the parent "
        f"{two.parent:.2f} s, the workers {two.workers:.2f} s; processes apart {ideal:.2f} s)"
    )


if __name__ == "__main__":
    main()
