"""The command line as tests see it: arguments in, exit code and both streams out."""

from __future__ import annotations

import gc
import io
import json
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from typing import Any, BinaryIO

from waiter_cli.app import run

__all__ = ["Ran", "Screen", "waiter"]


@dataclass(frozen=True)
class Ran:
    """What one command line did."""

    code: int
    out: str
    err: str

    def json(self) -> Any:
        """The one JSON document that stdout holds."""
        return json.loads(self.out)


class Screen(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        return True


def waiter(*arguments: str, stdin: str | BinaryIO = "", terminal: bool = False) -> Ran:
    """Runs ``waiter ARGUMENTS`` in this process, with ``stdin`` as its input.

    With ``terminal`` both of its outputs are terminals.
    """
    kind = Screen if terminal else io.StringIO
    out, err, before = kind(), kind(), sys.stdin
    thresholds = gc.get_threshold()
    sys.stdin = io.TextIOWrapper(
        io.BytesIO(stdin.encode()) if isinstance(stdin, str) else stdin, encoding="utf-8"
    )
    try:
        with redirect_stdout(out), redirect_stderr(err):
            code = run([str(argument) for argument in arguments])
    finally:
        sys.stdin = before
        gc.set_threshold(*thresholds)  # `serve` is made for days, and collects garbage often
    return Ran(int(code), out.getvalue(), err.getvalue())
