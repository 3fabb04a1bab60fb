"""The limits of a whole command: its time and its memory. Entry points `begin`, `reached`, `settle`, `end`.

A timer looks at the clock and at the memory twenty times a second, whatever the main thread is at:
reading, checking, posing, bounds, translation, waiting for clingo.  Past a limit it raises
`OverLimit` there, again and again until somebody answers for it (`settle`).  What is taken is told
while there is still memory to tell it in; where the system refuses memory first (``ulimit -v``), a
`MemoryError` comes instead, and `starved` knows what else that looks like.

Without timers and ``/proc`` (beyond Linux) only the deadlines of single stages hold.
"""

from __future__ import annotations

import os
import signal
import time
from types import FrameType

__all__ = ["OverLimit", "begin", "default_memory", "end", "hard_limit", "pending",
           "reached", "resume", "settle", "starved", "stay_with"]  # fmt: skip

_PERIOD = 0.05  # seconds between two looks
_LATER = 0.1  # seconds that a stage with a deadline of its own has to answer for it
_AGAIN = 1.0  # seconds after which what was raised is taken to be lost
_RESERVE = 24 << 20  # bytes below the system's own limit that are kept to end in
_LEAST = 256 << 20  # bytes that are allowed however little is free


class OverLimit(BaseException):
    """A limit was reached; ``limit`` is ``time`` or ``memory``.  No `Exception`: none may catch it."""

    def __init__(self, limit: str) -> None:
        super().__init__(limit)
        self.limit = limit


class _Watch:
    """What is watched in this process."""

    deadline: float | None = None
    memory: int | None = None  # bytes that the process may take
    space: int | None = None  # bytes of address space that the system allows
    default = True  # the memory allowed is not known yet
    descriptor = -1  # /proc/self/statm
    running = False
    settled = False
    raised: str | None = None  # the limit that was raised, and nobody has answered for it
    again = 0.0  # no earlier is anything raised
    parent = 0  # without which this process ends, 0: none


_watch = _Watch()


def begin(time_limit: float | None = None, memory: int | None = None) -> None:
    """Has the limits hold from now on: ``time_limit`` in seconds, ``memory`` in bytes.

    None is no limit of time, and of memory `default_memory`.  Only the main thread is interrupted.
    """
    import threading

    if threading.current_thread() is not threading.main_thread():
        return
    watch = _watch
    watch.deadline = None if time_limit is None else time.monotonic() + time_limit + _LATER
    watch.memory, watch.default = memory, memory is None
    watch.space, watch.settled, watch.raised = hard_limit(), False, None
    if watch.running or not hasattr(signal, "setitimer"):
        return
    try:
        watch.descriptor = os.open("/proc/self/statm", os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        watch.descriptor = -1
    signal.signal(signal.SIGALRM, _look)
    watch.running, watch.again = True, 0.0
    signal.setitimer(signal.ITIMER_REAL, _PERIOD, _PERIOD)


def end() -> None:
    """Nothing is watched any more."""
    watch = _watch
    if watch.running:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, signal.SIG_IGN)  # one more may be on its way
        if watch.descriptor >= 0:
            os.close(watch.descriptor)
        watch.running, watch.descriptor = False, -1
    watch.deadline = watch.memory = watch.space = None
    watch.default = watch.settled = False
    watch.raised = None


def settle() -> None:
    """Somebody answers for the limit that was reached: nothing more is raised.

    `reached` goes on telling; a search that begins once it no longer does is watched again.
    """
    _watch.settled, _watch.raised = True, None


def resume() -> None:
    """Has limits raise again, after `settle`."""
    _watch.settled = False


def reached() -> str | None:
    """The limit that is passed now, ``time`` or ``memory``; None where none is."""
    watch = _watch
    if watch.deadline is not None and time.monotonic() >= watch.deadline:
        return "time"
    if watch.descriptor < 0:
        return None
    if watch.default:
        watch.memory, watch.default = default_memory(), False
    taken = os.pread(watch.descriptor, 200, 0).split()
    if watch.memory is not None and int(taken[1]) * _PAGE > watch.memory:
        return "memory"
    if watch.space is not None and int(taken[0]) * _PAGE > watch.space - _RESERVE:
        return "memory"
    return None


_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


def _look(signum: int, frame: FrameType | None) -> None:
    """Raises `OverLimit` in the main thread, wherever it is, unless somebody answers for it."""
    if _watch.parent and os.getppid() != _watch.parent:
        os._exit(128 + signal.SIGTERM)
    if not _watch.settled and time.monotonic() >= _watch.again:
        limit = reached()
        if limit is not None:
            _watch.raised, _watch.again = limit, time.monotonic() + _AGAIN
            raise OverLimit(limit)


def stay_with(parent: int) -> None:
    """Has this process end once ``parent`` is no longer the one that started it."""
    _watch.parent = parent


def pending() -> str | None:
    """The limit that was raised, or is to be, and that nobody has answered for.

    Whatever the exception was made into on its way: libraries, and imports, make others of it.
    """
    return _watch.raised or (None if _watch.settled else reached())


def hard_limit() -> int | None:
    """The bytes of address space that the system lets this process take; None without a limit."""
    try:
        import resource
    except ImportError:
        return None
    soft = resource.getrlimit(resource.RLIMIT_AS)[0]
    return None if soft == resource.RLIM_INFINITY else soft


def default_memory() -> int | None:
    """Half of the memory that is free now, by this machine and by the group of this process."""
    free = [_number("/proc/meminfo", b"MemAvailable:", 1024)]
    group = _group()
    for folder in (f"/sys/fs/cgroup{group}", "/sys/fs/cgroup"):
        most, taken = _number(f"{folder}/memory.max"), _number(f"{folder}/memory.current")
        free.append(None if most is None else most - (taken or 0))
    folder = f"/sys/fs/cgroup/memory{group}"
    most = _number(f"{folder}/memory.limit_in_bytes")
    taken = _number(f"{folder}/memory.usage_in_bytes")
    free.append(None if most is None else most - (taken or 0))
    least = min((bytes_ for bytes_ in free if bytes_ is not None), default=None)
    return None if least is None else max(_LEAST, least // 2)


def _number(path: str, key: bytes = b"", unit: int = 1) -> int | None:
    """The number in a file, or behind ``key`` in it; None where there is none."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
        try:
            words = os.read(descriptor, 4096).split()
        finally:
            os.close(descriptor)
        return int(words[words.index(key) + 1 if key else 0]) * unit
    except (OSError, ValueError, IndexError):
        return None


def _group() -> str:
    """The path of this process's control group, empty where it is the root or there is none."""
    try:
        with open("/proc/self/cgroup", encoding="ascii", errors="replace") as file:
            lines = file.read(65536).split("\n")
    except OSError:
        return ""
    for line in lines:
        number, _, rest = line.partition(":")
        kinds, _, path = rest.partition(":")
        if number == "0" or "memory" in kinds.split(","):
            return "" if path == "/" else path
    return ""


def starved(error: BaseException) -> bool:
    """Whether an error comes of memory that was refused.

    Under a limit of the system much else does: a library that cannot be mapped, a thread that
    cannot be started, and whatever was made of that.
    """
    seen: BaseException | None = error
    for _ in range(20):
        if seen is None:
            break
        if isinstance(seen, MemoryError) or getattr(seen, "errno", None) == 12:
            return True
        seen = seen.__cause__ or seen.__context__
    space = hard_limit()
    if space is None:
        return False
    peak = _number("/proc/self/status", b"VmPeak:", 1024)
    return isinstance(error, ImportError) or peak is None or peak > space - max(space // 4, 1 << 26)
