"""Begins an evening, or goes on with one that a journal holds. Entry points `begin_evening`, `CurrentEvening`."""

from __future__ import annotations

import os
import shutil
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import replace

from waiter_cli.diagnosis.diagnose import explain
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.serve.journal import Journal, JournalFull
from waiter_cli.serve.session import Session
from waiter_cli.serve.startup import begin, open_journal
from waiter_cli.studio.live.live_world import LiveWorld
from waiter_cli.studio.opened import Opened, open_files
from waiter_cli.studio.page_requests import BadRequest

__all__ = ["CurrentEvening", "begin_evening"]


def begin_evening(
    opened: Opened, journal: str | None, seed: int, speed: float, warn: Callable[[str], None]
) -> AbstractContextManager[LiveWorld]:
    """Returns the evening, which lets go of its journal in the end.

    Without a ``journal`` of the user's there is one in a folder of its own, so that it can be kept.
    Raises `InputError` where the journal cannot be had, `Refused` where the scenario contradicts itself.
    """
    executive = begin(opened.layout, opened.scenario, opened.planner, explain)
    folder = None
    if journal is None:
        folder = tempfile.mkdtemp(prefix="waiter-studio-")
    path = journal if folder is None else os.path.join(folder, "evening.journal")
    assert path is not None
    try:
        with opened.planner.decision():
            found, resumed = open_journal(path, executive, opened.text, warn)
    except JournalFull as fault:
        raise InputError([Fault(Where(path), fault.why)]) from None
    if resumed:
        left_out = opened.scenario is not None and (
            opened.scenario.events or opened.scenario.guests
        )
        also = "; what the scenario has come later is left out" if left_out else ""
        warn(f"{path}: going on at step {executive.step}{also}")
    session = Session(executive, opened.planner, found)
    live = LiveWorld(opened, session, seed=seed, speed=speed, resumed=resumed)
    return _closing(live, found, folder)


@contextmanager
def _closing(live: LiveWorld, journal: Journal, folder: str | None) -> Iterator[LiveWorld]:
    try:
        yield live
    finally:
        journal.close()
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)


class CurrentEvening:
    """The evening that is on, and the one that begins anew in the layout as it was saved.

    ``opened`` is what the page works on.  ``changed`` is called with the evening that takes the place of
    another, once that one has ended; ``broken`` once a fault of ours has ended one; that is raised in the end.
    """

    def __init__(
        self,
        opened: Opened,
        live: LiveWorld,
        changed: Callable[[LiveWorld], None],
        broken: Callable[[], None],
    ) -> None:
        self.opened = replace(opened, live=live)
        self._live = live
        self._changed, self._broken = changed, broken
        self._lock = threading.Lock()
        self._later = ExitStack()  # the journals of evenings that began here

    def __enter__(self) -> CurrentEvening:
        self._start()
        return self

    def _start(self) -> None:
        self._live.broken = self._broken
        self._live.start()

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._live.stop()
            self._later.close()
        if self._live.fault is not None:
            raise self._live.fault

    def begin_anew(self) -> None:
        """Ends the evening and begins one in the file as it is now, with the same scenario and speed.

        Raises `InputError` where the layout has faults or the scenario does not fit, `BadRequest` where
        nothing can begin; then the evening goes on.
        """
        if self.opened.journal is not None:
            message = f"{self.opened.journal} holds the evening in the layout as it was"
            raise BadRequest(message, "start the studio again, with another journal")
        with self._lock:
            old, live = self.opened, self._live
            fresh = open_files(old.asked, old.scenario_name, old.planner)
            evening = begin_evening(fresh, None, live.seed, live.pace.speed, lambda told: None)
            live.stop()
            self._later.close()
            self._live = self._later.enter_context(evening)
            self.opened = replace(fresh, live=self._live)
            self._changed(self._live)
            self._start()
