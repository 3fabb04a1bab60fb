"""Writes recordings whole or not at all. Entry points `opened`, `Unfinished`."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from sparc.whole_file import put_in_place, unused_name
from waiter_cli.console.streams import printable_json
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.file_access.atomic import may_be_written

__all__ = ["Unfinished", "opened"]


class Unfinished:
    """A path to write to, beside the one that is wanted; `keep` puts it in its place.

    The suffix stays, since encoders look at it, and nothing else of the name, since they read
    patterns into it.  A link is followed.  Raises `InputError` where the folder is missing.
    """

    def __init__(self, wanted: str, option: str) -> None:
        folder, name = os.path.split(os.path.realpath(wanted))
        place = Where(option)
        if not os.path.isdir(folder):
            raise InputError(
                [Fault(place, f"{wanted}: there is no folder {folder}", "make it first")]
            )
        if os.path.isdir(wanted):
            raise InputError([Fault(place, f"{wanted} is a folder", "give the name of a file")])
        if not os.access(folder, os.W_OK):
            raise InputError([Fault(place, f"{folder}: permission denied", "write elsewhere")])
        if os.path.exists(wanted) and not may_be_written(os.path.realpath(wanted)):
            mend = "give another name, or make it writable"
            raise InputError([Fault(place, f"{wanted} is read-only", mend)])
        self.named = wanted
        self._wanted = os.path.join(folder, name)
        self.path = unused_name(folder, os.path.splitext(name)[1])

    def keep(self) -> None:
        """The file is whole."""
        put_in_place(self.path, self._wanted)

    def drop(self) -> None:
        """The file is not wanted any more."""
        if os.path.exists(self.path):
            os.unlink(self.path)


@contextmanager
def opened(events: str | None) -> Iterator[Callable[[str], None] | None]:
    """Yields a function that takes lines of events, or None; a file is whole at the end or absent."""
    if events is None:
        yield None
        return
    if events == "-":
        yield _to_stdout
        return
    if not _regular(events):
        with open(events, "w", encoding="utf-8") as device:
            yield lambda line: void(device.write(line))
        return
    unfinished = Unfinished(events, "--events")
    try:
        with open(unfinished.path, "w", encoding="utf-8") as file:
            yield lambda line: void(file.write(line))
        unfinished.keep()
    finally:
        unfinished.drop()


def _regular(path: str) -> bool:
    return not os.path.exists(path) or os.path.isfile(path) or os.path.isdir(path)


def _to_stdout(line: str) -> None:
    sys.stdout.write(printable_json(line))
    sys.stdout.flush()


def void(result: object) -> None:
    """Ignores what is written."""
