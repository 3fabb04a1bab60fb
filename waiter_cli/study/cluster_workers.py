"""Plays runs on a Dask cluster: `StudyRun`s → `RunResult`s as they come. Entry point `play_on_cluster`.

The scheduler hands out the runs and tries those again whose worker has died; what has ended is kept
here, so that nothing is lost with it.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from sparc.deferred_signals import undisturbed
from waiter_cli import __version__
from waiter_cli.errors import InputError, MissingError
from waiter_cli.optional_packages import extra_line
from waiter_cli.study.evening_run import play_evening
from waiter_cli.study.run_study import StudyHalted
from waiter_cli.study.studies import RunLimits, RunResult, StudyRun

__all__ = ["play_on_cluster", "require_distributed"]

CONNECT = 10.0
"""Seconds in which a scheduler has to answer."""
RETRIES = 2
GRACE = 5.0
LOOK = 0.5
GONE = (OSError, RuntimeError, concurrent.futures.CancelledError, asyncio.CancelledError)
"""What a client raises whose scheduler has gone."""
_alone = threading.Lock()


def require_distributed() -> Any:
    """Returns the package `distributed`; raises `MissingError` where it is not installed."""
    try:
        import distributed
    except ImportError as error:
        raise MissingError("--scheduler needs distributed", extra_line("cluster")) from error
    return distributed


def play_on_cluster(
    runs: Iterator[StudyRun], address: str, limits: RunLimits
) -> Iterator[RunResult]:
    """Yields the results of runs in the order in which they end; one for each run.

    Raises `InputError` where no scheduler answers at ``address`` or its workers have another version of
    `waiter`, `StudyHalted` where it is gone before the end.
    """
    distributed = require_distributed()
    with _unsaid(distributed.__name__, f"{distributed.__name__}.client"):
        yield from _played(distributed, runs, address, limits)


@contextmanager
def _unsaid(*names: str) -> Iterator[None]:
    """Keeps loggers quiet: what they would say is told in one sentence, or mended."""
    loggers = [logging.getLogger(name) for name in names]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, before):
            logger.setLevel(level)


def _played(
    distributed: Any, runs: Iterator[StudyRun], address: str, limits: RunLimits
) -> Iterator[RunResult]:
    try:
        client = distributed.Client(address, timeout=CONNECT, set_as_default=False)
    except (OSError, TimeoutError, ValueError, ImportError) as error:
        message = f"no scheduler answers at {address}"
        raise InputError(message, "start one: dask scheduler, and dask worker ADDRESS") from error
    try:
        _require_same_version(client)
        with client.as_current():  # `distributed.wait` asks for it
            yield from _Cluster(distributed, client, limits).play(runs)
    finally:
        client.close(timeout=1)


def _require_same_version(client: Any) -> None:
    try:
        found = client.run(_version)
    except Exception as error:
        message = f"a worker cannot load waiter: {type(error).__name__}: {error}"
        raise InputError(message, f"install waiter {__version__} where the workers run") from error
    for worker, version in found.items():
        if version != __version__:
            message = f"the worker at {worker} has waiter {version}, this is {__version__}"
            raise InputError(message, "install the same version on both sides")


def _version() -> str:
    return __version__


def _play(run: StudyRun, limits: RunLimits) -> RunResult:
    """Plays in a thread of a worker, one evening at a time in a process."""
    with _alone:
        return play_evening(run, limits)


class _Cluster:
    """The runs that are out, and since when a worker has been at each."""

    def __init__(self, distributed: Any, client: Any, limits: RunLimits) -> None:
        self.distributed, self.client, self.limits = distributed, client, limits
        self.out: dict[Any, StudyRun] = {}
        self.since: dict[str, float] = {}
        self.looked = 0.0

    def play(self, runs: Iterator[StudyRun]) -> Iterator[RunResult]:
        """Yields results; twice as many runs are out as there are threads."""
        with undisturbed():
            self._submit(runs)
        while self.out:
            results: list[RunResult] = []
            try:
                with undisturbed():  # an interrupted client may not be closed any more
                    self._look(runs, results)
            except BaseException:  # what has ended is kept nevertheless
                yield from results
                raise
            yield from results

    def _look(self, runs: Iterator[StudyRun], found: list[RunResult]) -> None:
        """Adds what has ended, at the latest after `LOOK`, and has further runs begin."""
        try:
            ended = self.distributed.wait(
                list(self.out), timeout=LOOK, return_when="FIRST_COMPLETED"
            ).done
        except self.distributed.TimeoutError:
            ended = set()
        except GONE as error:
            raise self._gone() from error
        for future in ended:
            found.append(self._result(self.out.pop(future), future))
        found += self._past_their_limit()
        self._submit(runs)

    def _submit(self, runs: Iterator[StudyRun]) -> None:
        try:
            wanted = 2 * max(1, sum(self.client.nthreads().values()))
        except GONE as error:
            raise self._gone() from error
        while len(self.out) < wanted:
            run = next(runs, None)
            if run is None:
                return
            key = f"waiter-{run.key}"
            future = self.client.submit(
                _play, run, self.limits, key=key, retries=RETRIES, pure=False
            )
            self.out[future] = run

    def _result(self, run: StudyRun, future: Any) -> RunResult:
        if future.status == "finished":
            result: RunResult = future.result()
            return result
        if future.cancelled() or future.status == "lost":
            raise self._gone()
        error = future.exception()
        if isinstance(error, self.distributed.KilledWorker):
            return RunResult(run.key, "failed", "its worker died again and again")
        told = f"{type(error).__name__}: {' '.join(str(error).split())}"
        return RunResult(run.key, "failed", told)

    def _past_their_limit(self) -> Iterator[RunResult]:
        """Yields results for runs that hang, and has their workers begin anew."""
        now = time.monotonic()
        if self.limits.seconds is None or now - self.looked < 2.0:
            return
        self.looked = now
        at: dict[str, str] = {}
        for worker, keys in self.client.processing().items():
            for key in list(keys)[:1]:
                at[key] = worker
        self.since = {key: self.since.get(key, now) for key in at}
        for future, run in list(self.out.items()):
            if now - self.since.get(future.key, now) > self.limits.seconds + GRACE:
                del self.out[future]
                self.client.cancel([future], force=True)
                self.client.restart_workers([at[future.key]], raise_for_error=False)
                yield RunResult(run.key, "limit", f"not done in {self.limits.seconds:g} s")

    def _gone(self) -> StudyHalted:
        return StudyHalted("the scheduler is gone", "start it again")
