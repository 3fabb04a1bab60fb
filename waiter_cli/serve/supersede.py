"""Ends a search when a newer line makes it pointless. Entry point `Watch`.

The search runs in the main thread; beside it a thread looks at the next line.  When that one
supersedes the search, the main thread is interrupted as by Ctrl-C, with an exception of its own.
A search that takes little computing is never superseded, so that answers to small problems do not
depend on the clock.
"""

from __future__ import annotations

import signal
import threading
import time
from _thread import interrupt_main
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from sparc.import_depth import imports_around
from waiter_cli.serve.inbox import Inbox, ReceivedLine

__all__ = ["GRACE", "PATIENCE", "Superseded", "Watch"]

GRACE = 0.1
"""Seconds of computing that every search may take, however busy the machine is ..."""
PATIENCE = 1.0
"""... and seconds by the clock after which it may not."""
_LOOK = 0.05


class Superseded(BaseException):
    """A newer line has come; ``line`` is its number.  No `Exception`: a search must not catch it."""

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


class Watch:
    """Watches one search at a time, in the main thread; elsewhere searches are left alone."""

    def __init__(self) -> None:
        self._signal = getattr(signal, "SIGUSR1", None)
        self._round = 0  # the search that runs, 0: none
        self._count = 0
        self._hit: tuple[int, int] | None = None  # the search to end, the line that ends it
        self._installed = False

    @contextmanager
    def over(self, inbox: Inbox, supersedes: Callable[[ReceivedLine], bool]) -> Iterator[None]:
        """Raises `Superseded` in its body once the head of ``inbox`` supersedes it."""
        if self._signal is None or threading.current_thread() is not threading.main_thread():
            yield
            return
        if not self._installed:
            signal.signal(self._signal, self._interrupted)
            self._installed = True
        self._count += 1
        mine = self._count
        over = threading.Event()
        watcher = threading.Thread(
            target=self._look, args=(mine, over, inbox, supersedes), daemon=True
        )
        watcher.start()
        try:
            self._round = mine
            yield
        finally:
            self._round = 0
            over.set()

    def _look(
        self,
        mine: int,
        over: threading.Event,
        inbox: Inbox,
        supersedes: Callable[[ReceivedLine], bool],
    ) -> None:
        work, clock = time.process_time() + GRACE, time.monotonic() + PATIENCE
        while time.process_time() < work and time.monotonic() < clock:
            if over.wait(_LOOK):
                return
        while not over.is_set():
            line = inbox.peek(_LOOK)
            if line is None:
                over.wait(_LOOK)
            elif not supersedes(line):
                return
            elif not over.is_set():
                self._hit = (mine, line.number)
                while self._round == mine and not over.is_set():
                    self._interrupt()
                    over.wait(_LOOK)
                return

    def _interrupt(self) -> None:
        """Interrupts the main thread, out of a system call too where that is possible."""
        assert self._signal is not None
        main = threading.main_thread().ident
        if main is not None and hasattr(signal, "pthread_kill"):
            signal.pthread_kill(main, self._signal)
        else:
            interrupt_main(self._signal)

    def _interrupted(self, signum: int, frame: FrameType | None) -> None:
        """Ends the search; within an import, which must be whole for the next, not yet."""
        if self._hit is not None and self._hit[0] == self._round and not imports_around(frame):
            self._round = 0
            raise Superseded(self._hit[1])
