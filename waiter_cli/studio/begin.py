"""Begins an evening, or goes on with one that a journal holds. Entry point `begin_evening`."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from waiter_cli.diagnosis.diagnose import explain
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.serve.journal import Journal, JournalFull
from waiter_cli.serve.session import Session
from waiter_cli.serve.startup import begin, open_journal
from waiter_cli.studio.live_world import LiveWorld
from waiter_cli.studio.opened import Opened

__all__ = ["begin_evening"]


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
