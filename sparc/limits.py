"""The limits of a whole command: its time and its memory. Entry points `begin`, `reached`, `settle`, `end`.

A timer looks at the clock and at the memory twenty times a second, whatever the main thread is at:
reading, checking, posing, bounds, translation, waiting for clingo.  Past a limit it raises
`OverLimit` there, again and again until somebody answers for it (`settle`).  What is taken is told
while there is still memory to tell it in; where the system refuses memory first (``ulimit -v``), a
`MemoryError` comes instead, and `starved` knows what else that looks like.

The handler runs between any two instructions, those of the import system among them.  So it imports
nothing, opens nothing and takes no lock (what it needs is made by `begin`), and it raises nothing
within an import, whose locks and half-made modules an exception would leave behind: it looks again
a moment later.

Without timers and ``/proc`` (beyond Linux) only the deadlines of single stages hold.
"""

from __future__ import annotations

import atexit
import gc
import os
import signal
import sys
import time
from collections.abc import Callable
from types import FrameType

from sparc.garbage import nothing_is_frozen
from sparc.import_depth import imports_around

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from typing import Any

__all__ = ["OverLimit", "begin", "default_memory", "end", "hard_limit", "pending",
           "reached", "resume", "settle", "starved", "stay_with"]  # fmt: skip

_PERIOD = 0.05  # seconds between two looks
_LATER = 0.1  # seconds that a stage with a deadline of its own has to answer for it
_SOON = 0.002  # seconds to the next look where this one fell into an import
_AGAIN = 1.0  # seconds after which what was raised is taken to be lost
_RESERVE = 24 << 20  # bytes below the system's own limit that are kept to end in
_LEAST = 256 << 20  # bytes that are allowed however little is free


class OverLimit(BaseException):
    """A limit was reached; ``limit`` is ``time`` or ``memory``.  No `Exception`: none may catch it."""

    def __init__(self, limit: str) -> None:
        super().__init__(limit)
        self.limit = limit


class _Watch:
    """The limits that are watched in this process."""

    deadline: float | None = None
    memory: int | None = None  # bytes that the process may take
    space: int | None = None  # bytes of address space that the system allows
    descriptor = -1  # /proc/self/statm
    running = False
    settled = False
    raised: str | None = None  # the limit that was raised, and nobody has answered for it
    froze = False  # garbage is not looked for in what there was when a limit came
    again = 0.0  # no earlier is anything raised
    imports = 0  # the imports that `begin` was called within
    unraisable: Callable[[Any], object] | None = None  # the hook that was there before
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
    watch.memory = default_memory() if memory is None else memory
    watch.imports = imports_around(sys._getframe())
    watch.space, watch.settled, watch.raised = hard_limit(), False, None
    if watch.running or not hasattr(signal, "setitimer"):
        return
    try:
        watch.descriptor = os.open("/proc/self/statm", os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        watch.descriptor = -1
    watch.unraisable, sys.unraisablehook = sys.unraisablehook, _unraised
    watch.running, watch.again = True, 0.0
    # Python takes its handlers away at its end, and the next alarm would kill it.
    atexit.unregister(end)
    atexit.register(end)
    signal.signal(signal.SIGALRM, _look)
    signal.setitimer(signal.ITIMER_REAL, _PERIOD, _PERIOD)


def end() -> None:
    """Ends the watch."""
    watch = _watch
    if watch.running:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, signal.SIG_IGN)  # one more may be on its way
        if watch.descriptor >= 0:
            os.close(watch.descriptor)
        if sys.unraisablehook is _unraised and watch.unraisable is not None:
            sys.unraisablehook = watch.unraisable
        watch.running, watch.descriptor, watch.unraisable = False, -1, None
    watch.deadline = watch.memory = watch.space = None
    watch.settled, watch.raised = False, None
    _thaw()


def settle() -> None:
    """Marks the limit as handled: nothing more is raised.

    `reached` goes on telling; a search that begins once it no longer does is watched again.
    """
    _watch.settled, _watch.raised = True, None
    _thaw()


def _thaw() -> None:
    """Gives back to the search for garbage what was taken from it when the limit came."""
    if _watch.froze:
        _watch.froze = False
        gc.unfreeze()


def resume() -> None:
    """Has limits raise again, after `settle`, and at once."""
    if _watch.settled:
        _watch.settled, _watch.again = False, 0.0


def reached() -> str | None:
    """Returns the limit that is passed now, ``time`` or ``memory``; None where none is."""
    watch = _watch
    if watch.deadline is not None and time.monotonic() >= watch.deadline:
        return "time"
    if watch.descriptor < 0:
        return None
    try:
        taken = os.pread(watch.descriptor, 200, 0).split()
    except OSError:  # nothing is known, which is no reason to end
        return None
    if len(taken) < 2:
        return None
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
        if limit is None:
            return
        if imports_around(frame) > _watch.imports:
            signal.setitimer(signal.ITIMER_REAL, _SOON, _PERIOD)
            return
        _watch.raised, _watch.again = limit, time.monotonic() + _AGAIN
        if nothing_is_frozen():  # no search for garbage in all that was made, on the way out
            gc.freeze()
            _watch.froze = True
        raise OverLimit(limit)


def _unraised(seen: Any) -> None:
    """Has a limit that was raised in a finalizer, where exceptions are lost, raised once more."""
    if seen.exc_type is OverLimit:
        _watch.again = 0.0
    elif _watch.unraisable is not None:
        _watch.unraisable(seen)


def stay_with(parent: int) -> None:
    """Has this process end once ``parent`` is no longer the one that started it."""
    _watch.parent = parent


def pending() -> str | None:
    """Returns the limit that was raised, or is to be, and that nobody has answered for.

    Whatever the exception was made into on its way: libraries, and imports, make others of it.
    """
    return _watch.raised or (None if _watch.settled else reached())


def hard_limit() -> int | None:
    """Returns the bytes of address space that the system lets this process take.

    None without a limit.
    """
    try:
        import resource
    except ImportError:
        return None
    soft = resource.getrlimit(resource.RLIMIT_AS)[0]
    return None if soft == resource.RLIM_INFINITY else soft


def default_memory() -> int | None:
    """Returns half of the memory that is free now, by this machine and by the group
    of this process.
    """
    free = [_number(b"/proc/meminfo", b"MemAvailable:", 1024)]
    group = _group(_read(b"/proc/self/cgroup"))
    for folder in {b"/sys/fs/cgroup" + group, b"/sys/fs/cgroup"}:
        free.append(_left(folder + b"/memory.max", folder + b"/memory.current"))
    folder = b"/sys/fs/cgroup/memory" + group
    free.append(_left(folder + b"/memory.limit_in_bytes", folder + b"/memory.usage_in_bytes"))
    least = min((bytes_ for bytes_ in free if bytes_ is not None), default=None)
    return None if least is None else max(_LEAST, least // 2)


def _left(most: bytes, taken: bytes) -> int | None:
    """Returns the difference of the numbers in two files; None where the first has none."""
    allowed = _number(most)
    return None if allowed is None else allowed - (_number(taken) or 0)


def _read(path: bytes) -> bytes:
    """Returns the first 64 KiB of a file, empty where it cannot be read; no codec is asked for."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return b""
    try:
        return os.read(descriptor, 1 << 16)
    except OSError:
        return b""
    finally:
        os.close(descriptor)


def _number(path: bytes, key: bytes = b"", unit: int = 1) -> int | None:
    """Returns the number in a file, or behind ``key`` in it; None where there is none."""
    words = _read(path).split()
    try:
        return int(words[words.index(key) + 1 if key else 0]) * unit
    except (ValueError, IndexError):
        return None


def _group(table: bytes) -> bytes:
    """Returns the path of a control group in a table of them, empty where it is the
    root or there is none.
    """
    for line in table.split(b"\n"):
        number, _, rest = line.partition(b":")
        kinds, _, path = rest.partition(b":")
        if number == b"0" or b"memory" in kinds.split(b","):
            return b"" if path == b"/" else path
    return b""


def starved(error: BaseException) -> bool:
    """Returns whether an error comes of memory that was refused.

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
    peak = _number(b"/proc/self/status", b"VmPeak:", 1024)
    return isinstance(error, ImportError) or peak is None or peak > space - max(space // 4, 1 << 26)
