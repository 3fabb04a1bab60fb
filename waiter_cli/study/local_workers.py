"""Plays runs in processes of this machine: `StudyRun`s → `RunResult`s as they come.

Entry points `play_locally`, and `LocalWorkers` where further runs follow from results.  Each worker is
a pool of its own with one process (`concurrent.futures.ProcessPoolExecutor`): where a process dies it is
known whose run it was, and the others go on.  The parent ends a process that hangs past the limit of
its run or takes too much memory.  A process whose parent is gone ends itself.

Signals are handled between two looks at the workers: in the middle of one they could leave a lock of
a future locked, for which the pool's threads would wait for ever.
"""

from __future__ import annotations

import gc
import math
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import resource_tracker
from multiprocessing.process import BaseProcess

from sparc.deferred_signals import undisturbed
from sparc.limits import default_memory
from waiter_cli.study.evening_run import play_evening
from waiter_cli.study.studies import RunLimits, RunResult, StudyRun

__all__ = ["TRIES", "LocalWorkers", "memory_of_each", "play_locally", "workers_here"]

TRIES = 3
"""So often is a run tried whose process died; then it has failed."""
GRACE = 3.0
"""Seconds past its limit for which a worker may still answer by itself."""
LOOK = 0.2
"""Seconds between two looks at the workers."""

Player = Callable[[StudyRun, RunLimits], RunResult]


def workers_here() -> int:
    """Returns the number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def memory_of_each(workers: int) -> int | None:
    """Returns the bytes that a worker may use unless told, None where that is not known.

    They share all that is free: half of it is what one process alone may use.
    """
    free = default_memory()
    return None if free is None else free // max(1, workers // 2)


def play_locally(
    runs: Iterator[StudyRun], workers: int, limits: RunLimits, player: Player = play_evening
) -> Iterator[RunResult]:
    """Yields the results of runs in the order in which they end; one for each run.

    Whoever stops asking ends the processes.
    """
    with LocalWorkers(workers, limits, player) as opened:
        yield from opened.play(runs)


class LocalWorkers:
    """So many workers, whose processes are there until the ``with`` block ends."""

    def __init__(self, workers: int, limits: RunLimits, player: Player = play_evening) -> None:
        self._slots = [_Slot(limits, player) for _ in range(workers)]

    def __enter__(self) -> LocalWorkers:
        return self

    def __exit__(self, *_: object) -> None:
        with undisturbed():
            for slot in self._slots:
                slot.close()

    def play(self, runs: Iterator[StudyRun], until: float = math.inf) -> Iterator[RunResult]:
        """Yields the results of runs in the order in which they end; one for each run.

        ``until`` is a time of the monotonic clock after which no result is waited for.  Where the
        results end before the runs do, or are asked for no more, the workers are to end, too.
        """
        with undisturbed():
            for slot in self._slots:
                slot.start(next(runs, None))
        while any(slot.run for slot in self._slots) and time.monotonic() < until:
            results: list[RunResult] = []
            try:
                with undisturbed():
                    self._look(runs, results)
            except BaseException:  # what has ended is kept nevertheless
                yield from results
                raise
            yield from results

    def _look(self, runs: Iterator[StudyRun], found: list[RunResult]) -> None:
        """Adds what has ended, at the latest after `LOOK`, and begins further runs in its place."""
        busy = {slot.future: slot for slot in self._slots if slot.future is not None}
        ended, _ = wait(busy, LOOK, FIRST_COMPLETED)
        for future in ended:
            slot = busy[future]
            result = slot.result()
            if result is not None:
                found.append(result)
                slot.start(next(runs, None))
        for slot in self._slots:
            slot.watch()


@dataclass
class _Slot:
    """A worker and the run that it is at."""

    limits: RunLimits
    player: Player
    pool: ProcessPoolExecutor | None = None
    process: BaseProcess | None = None
    run: StudyRun | None = None
    future: Future[RunResult] | None = None
    ready: Future[int] | None = None
    begun: float = 0.0
    tries: int = 0
    ended_for: str | None = None

    def start(self, run: StudyRun | None) -> None:
        """Begins a run; None: there is none left."""
        self.run, self.tries = run, 0
        if run is None:
            self.future = None
        else:
            self._submit(run)

    def result(self) -> RunResult | None:
        """Returns the result of the run that has ended; None where it is tried again."""
        assert self.run is not None and self.future is not None
        try:
            run_result = self.future.result()
            if run_result.status == "limit":
                self.close()  # what the run has taken would count against the next one
            return run_result
        except BrokenProcessPool:
            pass
        except Exception as error:  # what came back cannot be read
            told = f"{type(error).__name__}: {' '.join(str(error).split())}"
            return RunResult(self.run.key, "failed", told)
        code = self._exit_code()
        self.close()
        if self.ended_for is not None:
            return RunResult(self.run.key, "limit", self.ended_for)
        if self.tries < TRIES:
            self._submit(self.run)
            return None
        return RunResult(self.run.key, "failed", f"its process died {TRIES} times{code}")

    def watch(self) -> None:
        """Ends the process where it is past its limits."""
        if self.process is None or self.future is None or self.ended_for is not None:
            return
        if self.ready is not None:
            self.begun = time.monotonic()  # what a process takes to begin is not the run's
            if self.ready.done():
                self.ready = None
        seconds, memory = self.limits.seconds, self.limits.memory
        if seconds is not None and time.monotonic() - self.begun > seconds + GRACE:
            self.ended_for = f"not done in {seconds:g} s"
        elif memory is not None and _resident(self.process.pid) > memory * 1.1:
            self.ended_for = "the memory was used up"
        if self.ended_for is not None:
            self.process.kill()

    def close(self) -> None:
        """Ends the process, at once."""
        if self.process is not None:
            self.process.kill()
        if self.pool is not None:
            self.pool.shutdown(wait=True, cancel_futures=True)
        self.pool = self.process = None

    def _submit(self, run: StudyRun) -> None:
        self.tries += 1
        self.ended_for = None
        with _unsignalled():
            if self.pool is None:
                self.pool = ProcessPoolExecutor(
                    1, multiprocessing.get_context("spawn"), _prepare, (os.getpid(),)
                )
                before = set(multiprocessing.active_children())
                self.ready = self.pool.submit(os.getpid)
                self.future = self.pool.submit(self.player, run, self.limits)
                new = set(multiprocessing.active_children()) - before
                self.process = next(iter(new), None)
            else:
                self.future = self.pool.submit(self.player, run, self.limits)
        self.begun = time.monotonic()

    def _exit_code(self) -> str:
        if self.process is None:
            return ""
        end = time.monotonic() + 2.0
        while (code := self.process.exitcode) is None:  # the pool's thread may be asking, too
            if time.monotonic() > end:
                return ""
            time.sleep(0.01)
        return f" (signal {-code})" if code < 0 else f" (exit code {code})"


@contextmanager
def _unsignalled() -> Iterator[None]:
    """Has processes that are started meanwhile take no notice of Ctrl-C and SIGTERM.

    A terminal sends them to the workers, too, and those are ended by their parent.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # which lets signals in again where it starts a process
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _prepare(parent: int) -> None:
    """Makes a worker end with its parent, and collect garbage as seldom as the command line does."""
    gc.set_threshold(100_000, 20, 20)
    threading.Thread(target=_stay_with, args=(parent,), daemon=True).start()


def _stay_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(0.5)
    os._exit(1)


def _resident(pid: int | None) -> int:
    """Returns the bytes of memory that a process has; 0 where nothing tells."""
    try:
        with open(f"/proc/{pid}/statm", "rb") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0
