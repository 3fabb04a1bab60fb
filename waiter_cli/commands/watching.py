"""Runs something again whenever a file changes, until Ctrl-C. Entry point `watch`.

Files are polled: that works for every editor (most write a new file and rename it) and on every
file system.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from typing import TypeAlias

__all__ = ["watch"]

Stamp: TypeAlias = "tuple[int, int, int] | None"

PERIOD = 0.2
"""Seconds between two looks at the files."""


def watch(
    paths: Sequence[str],
    action: Callable[[], int],
    *,
    as_json: bool = False,
    sleep: Callable[[float], None] = time.sleep,
) -> int:
    """Runs ``action`` now and after each change of a file; exit code 0 when Ctrl-C ends it.

    Whatever ``action`` raises is printed as at the front door, and watching goes on: a file that is
    wrong for the moment is what one watches for.  A change while ``action`` runs counts, too.  A
    file that is gone is waited for.
    """
    from waiter_cli.boundary import report_error
    from waiter_cli.console.output import print_text
    from waiter_cli.console.styling import styled

    names = ", ".join(os.path.basename(path) for path in paths)
    try:
        while True:
            stamps = _stamps(paths)
            try:
                action()
            except (BrokenPipeError, KeyboardInterrupt):
                raise
            except Exception as error:
                report_error(error, as_json=as_json)
            sys.stdout.flush()
            now = time.strftime("%H:%M:%S")
            note = f"{now}: watching {names}; Ctrl-C ends\n"
            print_text(styled(note, "dim", sys.stderr), sys.stderr)
            while _stamps(paths) == stamps or None in _stamps(paths):
                sleep(PERIOD)
    except KeyboardInterrupt:
        return 0


def _stamps(paths: Sequence[str]) -> list[Stamp]:
    """Returns for each file what changes with it: its number, its size and its time in nanoseconds."""
    out: list[Stamp] = []
    for path in paths:
        try:
            status = os.stat(path)
        except OSError:
            out.append(None)
        else:
            out.append((status.st_ino, status.st_size, status.st_mtime_ns))
    return out
