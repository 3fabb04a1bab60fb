"""Plays the missing runs of a study and stores them: `Study`, path → `StudyCounts`.

Entry point `run_study`.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from sparc.lazy_dataclass import dataclass
from waiter_cli import __version__
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.study.store import Store
from waiter_cli.study.studies import RunResult, Study, StudyRun, runs_of

__all__ = ["StudyCounts", "StudyHalted", "progress_line", "run_study", "store_lock"]

Play = Callable[[Iterator[StudyRun]], Iterator[RunResult]]


@dataclass(frozen=True)
class StudyCounts:
    """The state of a study: ``planned`` runs, those ``done``, ``failed`` and at a ``limit``.

    ``now`` counts the runs that ended in this process, in so many ``seconds``.
    """

    planned: int
    done: int
    failed: int
    limit: int
    now: int = 0
    seconds: float = 0.0

    @property
    def left(self) -> int:
        """Returns the number of runs that have not ended."""
        return self.planned - self.done - self.failed - self.limit


class StudyHalted(Exception):
    """The workers are gone before all runs have ended; ``why`` says how, ``mend`` what may help."""

    def __init__(self, why: str, mend: str) -> None:
        super().__init__(why)
        self.why = why
        self.mend = mend


def run_study(
    study: Study,
    path: str,
    play: Play,
    *,
    retry: bool = False,
    progress: Callable[[StudyCounts], None] = lambda counts: None,
) -> StudyCounts:
    """Returns how a study stands after all its runs have ended.

    ``play`` plays runs and yields their results as they come.  Runs whose rows are in the store at
    ``path`` are not played again; with ``retry`` those that failed or reached a limit are.  ``progress`` is told
    after each run.  Raises `InputError` for a store that cannot be used; what has ended stays in the
    store whatever is raised.
    """
    with store_lock(path), Store(path, writing=True) as store:
        store.plan(study, __version__)
        if retry:
            store.forget_failures()
        ended = store.ended()
        todo = {run.key: run for run in runs_of(study, __version__) if run.key not in ended}
        tally = store.counts()
        begun, now = time.monotonic(), 0

        def counts() -> StudyCounts:
            return StudyCounts(study.size, **tally, now=now, seconds=time.monotonic() - begun)

        progress(counts())
        results = play(iter(list(todo.values())))
        try:
            for result in results:
                store.record(todo.pop(result.key), result)
                tally[result.status] += 1
                now += 1
                progress(counts())
        finally:
            close = getattr(results, "close", None)
            if close is not None:
                close()
        return counts()


@contextmanager
def store_lock(path: str) -> Iterator[None]:
    """Keeps a second process from running a study into the same store; raises `InputError` in it."""
    try:
        import fcntl
    except ImportError:  # beyond POSIX
        yield
        return
    name = os.path.realpath(path) + "-lock"
    lock = _opened(name, path)
    held = False
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            held = os.path.exists(name) and os.path.samestat(os.stat(name), os.fstat(lock))
        except OSError:
            pass
        if not held:
            told = "another process is running a study into this store"
            raise InputError([Fault(Where(path), told, "wait for it, or name another")])
        yield
    finally:
        if held:
            os.unlink(name)
        os.close(lock)


def _opened(name: str, path: str) -> int:
    """Returns the descriptor of the file that is locked."""
    try:
        return os.open(name, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        folder = os.path.dirname(path)
        hint = f"make the folder {folder} first" if folder and not os.path.isdir(folder) else None
        raise InputError([Fault(Where(path), f"cannot write: {reason}", hint)]) from error


def progress_line(counts: StudyCounts) -> str:
    """Returns how far a study is, how fast it goes, and how long it will take.

    The time to go is what the runs that ended here have taken, times what is left; a study goes
    evening by evening through its combinations, so that these are a fair sample.
    """
    parts = [f"{counts.done} of {counts.planned} done"]
    if counts.failed:
        parts.append(f"{counts.failed} failed")
    if counts.limit:
        parts.append(f"{counts.limit} at a limit")
    if counts.now and counts.seconds > 0:
        a_minute = 60 * counts.now / counts.seconds
        parts.append(f"{a_minute:.3g} a minute")
        parts.append(f"about {_span(counts.left * counts.seconds / counts.now)} to go")
    return ", ".join(parts)


def _span(seconds: float) -> str:
    """Returns a duration in words.

    >>> [_span(s) for s in (4, 89, 150, 8000, 200000)]
    ['4 s', '89 s', '2.5 min', '2.2 h', '2.3 days']
    """
    for unit, size, most in (("s", 1, 90), ("min", 60, 5400), ("h", 3600, 129600)):
        if seconds < most:
            number = seconds / size
            return f"{number:.0f} {unit}" if unit == "s" or number >= 10 else f"{number:.1f} {unit}"
    return f"{seconds / 86400:.1f} days"
