"""Makes the standard streams usable, be they closed, full or of any encoding. Entry point `prepare`.

A result that cannot be written is a fault, and ends the command.  What is said on stderr is no
result: where nobody can hear it, it is lost quietly.
"""

from __future__ import annotations

import codecs
import io
import os
import sys
from collections.abc import Callable

from sparc.escaping import UNSAFE, decoded

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from typing import Any, TextIO

__all__ = ["drop_stdout", "lost_output", "prepare", "printable_json"]

_CODES = "waiter.codes"
_lost: OSError | None = None


class _Result(io.FileIO):
    """A descriptor that remembers that writing to it failed."""

    def write(self, data: Any, /) -> int:
        """Returns the number of bytes that were written."""
        global _lost
        try:
            return super().write(data)
        except OSError as error:
            _lost = error
            raise


class _Remark(io.FileIO):
    """A descriptor to which writing always succeeds, be it full or without a reader."""

    def write(self, data: Any, /) -> int:
        """Returns the number of bytes that were written, or lost."""
        try:
            return super().write(data)
        except OSError:
            return len(data)


def prepare() -> None:
    """Makes the streams fit to be used: each is there and takes any character.

    A closed stdin is empty.  A closed stdout refuses what is written, as a full disk does.  A
    character that an encoding lacks becomes its code.
    """
    codecs.register_error(_CODES, _codes)
    if None in (sys.stdin, sys.stdout, sys.stderr):
        _stand_in()
    sys.stdout = _wrapped(sys.stdout, _Result)
    sys.stderr = _wrapped(sys.stderr, _Remark)


def _stand_in() -> None:
    """Opens a substitute for each descriptor that was closed when the process began."""
    for number, stream in enumerate((sys.stdin, sys.stdout, sys.stderr)):
        if stream is None:  # what is open for reading only refuses what is written
            nothing = os.open(os.devnull, os.O_WRONLY if number == 2 else os.O_RDONLY)
            if nothing != number:
                os.dup2(nothing, number)
                os.close(nothing)
    sys.stdin = sys.stdin or os.fdopen(0, "r", encoding="utf-8", closefd=False)
    sys.stdout = sys.stdout or os.fdopen(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = sys.stderr or os.fdopen(2, "w", encoding="utf-8", closefd=False)


def _wrapped(stream: TextIO, kind: type[io.FileIO]) -> TextIO:
    """Returns the same stream on a descriptor of that kind, as buffered as it was."""
    if not isinstance(stream, io.TextIOWrapper):
        return stream
    if os.name != "posix":  # a Windows console is no file
        stream.reconfigure(errors=_CODES)
        return stream
    raw = kind(stream.fileno(), "w", closefd=False)
    unbuffered: Any = raw  # as Python does it where PYTHONUNBUFFERED is set
    return io.TextIOWrapper(
        unbuffered if stream.write_through else io.BufferedWriter(raw),
        encoding=stream.encoding,
        errors=_CODES,
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )


def printable_json(text: str) -> str:
    """Returns JSON with unsafe characters, and those that stdout lacks, as JSON escapes.

    Unless stdout is in UTF-8, all beyond ASCII is.
    """
    if text.isascii() and "\x7f" not in text:
        return text
    import json
    import re

    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    takes_all = encoding.lower().replace("_", "-") in ("utf-8", "utf8")
    beyond = UNSAFE if takes_all else r"[^\x00-\x7f]+"
    text = decoded(text) if takes_all else text
    return re.sub(beyond, lambda found: _in_json(decoded(found[0]), json.dumps), text)


def _in_json(text: str, dumps: Callable[[str], str]) -> str:
    return dumps(text)[1:-1].replace("\x7f", "\\u007f")


def _codes(error: UnicodeError) -> tuple[str, int]:
    """Returns characters that an encoding lacks as their codes."""
    assert isinstance(error, UnicodeEncodeError)
    lacking = decoded(error.object[error.start : error.end])
    return lacking.encode("ascii", "backslashreplace").decode("ascii"), error.end


def lost_output() -> OSError | None:
    """Flushes stdout; returns the error that shows that output was lost, else None.

    That the reader has gone is none.  After an error stdout leads nowhere.
    """
    fault = None
    try:
        sys.stdout.flush()
    except OSError as error:
        fault = error
    fault = _lost or fault
    if fault is not None:
        drop_stdout()
    return None if isinstance(fault, BrokenPipeError) else fault


def drop_stdout() -> None:
    """Points stdout at nothing, so that the interpreter's last flush is quiet."""
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.close(nothing)
