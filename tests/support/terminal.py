"""A command on a terminal of its own: what it writes is read, what a person would type is sent."""

from __future__ import annotations

import fcntl
import os
import pty
import select
import struct
import subprocess
import sys
import termios
import time
from pathlib import Path
from types import TracebackType

from tests.support.paths import ROOT

__all__ = ["Terminal"]


class Terminal:
    """``waiter ARGUMENTS`` on a terminal of some width; ended with the ``with`` block."""

    def __init__(
        self, *arguments: str, cwd: Path | None = None, columns: int = 80, **variables: str
    ) -> None:
        self.seen = ""
        self._main, side = pty.openpty()
        fcntl.ioctl(side, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "TERM": "dumb"}
        environment.pop("COLUMNS", None)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "waiter_cli", *arguments],
            stdin=side, stdout=side, stderr=side, cwd=cwd, env={**environment, **variables},
        )  # fmt: skip
        os.close(side)

    def __enter__(self) -> Terminal:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._main)

    def expect(self, text: str, seconds: float = 30) -> None:
        """Reads on until ``text`` has come since the last answer was typed."""
        end = time.monotonic() + seconds
        while text not in self.seen:
            assert self._read(end), f"{text!r} did not come; seen: {self.seen!r}"

    def type(self, line: str) -> None:
        """Types a line; what was seen before is forgotten."""
        self.seen = ""
        os.write(self._main, f"{line}\n".encode())

    def end(self, seconds: float = 30) -> int:
        """Reads on until the command ends; its exit code."""
        end = time.monotonic() + seconds
        while self._read(end):
            pass
        return self.process.wait(max(0.1, end - time.monotonic()))

    def _read(self, end: float) -> bool:
        while time.monotonic() < end:
            if not select.select([self._main], [], [], 0.1)[0]:
                if self.process.poll() is None:
                    continue
                return False
            try:
                data = os.read(self._main, 65536)
            except OSError:  # the other side is closed
                return False
            self.seen += data.decode(errors="replace")
            return bool(data)
        return False
