"""The command line as tests see it: arguments in, exit code and both streams out."""

from __future__ import annotations

import io
import json
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from typing import Any, BinaryIO

from waiter_cli.app import run

__all__ = ["Ran", "waiter"]


@dataclass(frozen=True)
class Ran:
    """What one command line did."""

    code: int
    out: str
    err: str

    def json(self) -> Any:
        """The one JSON document that stdout holds."""
        return json.loads(self.out)


def waiter(*arguments: str, stdin: str | BinaryIO = "") -> Ran:
    """Runs ``waiter ARGUMENTS`` in this process, with ``stdin`` as its input."""
    out, err, before = io.StringIO(), io.StringIO(), sys.stdin
    sys.stdin = io.TextIOWrapper(
        io.BytesIO(stdin.encode()) if isinstance(stdin, str) else stdin, encoding="utf-8"
    )
    try:
        with redirect_stdout(out), redirect_stderr(err):
            code = run([str(argument) for argument in arguments])
    finally:
        sys.stdin = before
    return Ran(int(code), out.getvalue(), err.getvalue())
