"""The one way a file or standard input is read whole: never more of it than a cap. Entry point `read_capped`.

A device such as ``/dev/zero`` has no end, and a file can be larger than the memory.
"""

from __future__ import annotations

import errno
import sys
from typing import IO, Any

__all__ = ["MAX_PROGRAM", "read_capped", "read_line_capped"]

MAX_PROGRAM = 1 << 26
"""The most bytes of a SPARC program."""


def read_capped(name: str, most: int) -> bytes:
    """The bytes of the file ``name``, ``-`` for standard input.

    Raises `OSError` where it cannot be read, and where there are more than ``most`` bytes.
    """
    if name == "-":
        data = _standard_input(most + 1)
    else:
        with open(name, "rb") as file:
            data = file.read(most + 1)
    if len(data) > most:
        raise OSError(errno.EFBIG, f"larger than {_in_words(most)}", name)
    return data


def read_line_capped(stream: IO[str], most: int) -> str:
    """The next line of ``stream``, empty at its end; raises `OSError` where it is longer than ``most``."""
    line = stream.readline(most + 1)
    if len(line) > most:
        raise OSError(errno.EFBIG, f"a line longer than {most} characters", "<stdin>")
    return line


def _standard_input(most: int) -> bytes:
    stream: Any = getattr(sys.stdin, "buffer", None)  # a stand-in for stdin may have none
    data: bytes = stream.read(most) if stream else sys.stdin.read(most).encode()
    return data


def _in_words(most: int) -> str:
    return f"{most >> 20} MB" if most >= 1 << 20 else f"{most} bytes"
