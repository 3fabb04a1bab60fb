"""Reads a file or standard input as a whole, up to a cap.

Entry points `read_capped`, and `program` and `program_text` for the bytes of a program: the same
whichever way they come in.  A device such as ``/dev/zero`` has no end, and a file can be larger than the memory.
"""

from __future__ import annotations

import errno
import os
import stat
import sys
from typing import IO, TYPE_CHECKING, Any, AnyStr

if TYPE_CHECKING:
    from sparc.source import Source

__all__ = ["MAX_PROGRAM", "NotText", "program", "program_text", "read_capped", "read_line_capped",
           "text_of"]  # fmt: skip

MAX_PROGRAM = 1 << 26
"""The most bytes of a SPARC program."""

PATIENCE = 3.0
"""Seconds for which a named pipe may be without a writer."""
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


class NotText(ValueError):
    """Bytes that are no UTF-8: ``line`` and ``column`` of the first, and whether they are UTF-16."""

    def __init__(self, line: int, column: int, utf_16: bool) -> None:
        super().__init__(f"no UTF-8 text at {line}:{column}")
        self.line, self.column, self.utf_16 = line, column, utf_16


def text_of(data: bytes) -> str:
    """Returns the text in the bytes of a file, without its byte-order mark; raises `NotText`.

    >>> text_of(b"\\xef\\xbb\\xbfcaf\\xc3\\xa9")
    'café'
    >>> text_of(b"a\\nb\\xff")
    Traceback (most recent call last):
        ...
    sparc.reading.NotText: no UTF-8 text at 2:2
    """
    if data[:2] in _UTF_16:
        raise NotText(1, 1, True)
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        rest = before[before.rfind(b"\n") + 1 :]
        line, column = before.count(b"\n") + 1, len(rest.decode("utf-8", "replace")) + 1
        raise NotText(line, column, False) from None


def read_capped(name: str, most: int) -> bytes:
    """Returns the bytes of the file ``name``, ``-`` for standard input.

    Raises `OSError` where it cannot be read, where there are more than ``most`` bytes, and for a named
    pipe that nobody opens to write into it.
    """
    if name == "-":
        data = _standard_input(most + 1)
    else:
        first: list[bytes] = []
        with open(name, "rb", opener=lambda path, flags: _opened(path, flags, first)) as file:
            data = b"".join(first) + file.read(most + 1)
    if len(data) > most:
        raise OSError(errno.EFBIG, f"larger than {_in_words(most)}", name)
    return data


def _opened(name: str, flags: int, first: list[bytes]) -> int:
    """Returns the descriptor of a file; raises `OSError` for a named pipe without a writer.

    To open one waits for a writer, for ever if need be; here `PATIENCE` seconds.  What was read
    meanwhile is added to ``first``.
    """
    descriptor = os.open(name, flags | getattr(os, "O_NONBLOCK", 0))
    try:
        if stat.S_ISFIFO(os.fstat(descriptor).st_mode):
            first.append(_await_writer(descriptor, name))
        if hasattr(os, "set_blocking"):
            os.set_blocking(descriptor, True)
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor


def _await_writer(descriptor: int, name: str) -> bytes:
    """Waits for somebody to write into a pipe, or to hold it open; raises `OSError` where nobody does.

    Returns the byte that had to be read to find out, if there was one.
    """
    import select

    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    if poll.poll(1000 * PATIENCE):
        return b""
    try:
        first = os.read(descriptor, 1)
    except BlockingIOError:  # there is one, who has written nothing yet
        return b""
    if not first:
        message = f"a named pipe, and nobody has begun to write into it within {PATIENCE:g} s"
        raise OSError(errno.ENXIO, message, name)
    return first


def program(data: bytes, name: str) -> Source:
    """Returns the program in ``data``, under the name of its file.

    Raises `SparcSyntaxError` for a file in UTF-16.
    """
    from sparc.source import Origin, Source, Span

    if data[:2] in _UTF_16 or b"\0\0" in (data[:4:2], data[1:4:2]):
        from sparc.errors import SparcSyntaxError

        beginning = Span(Source(name, "", origins=(Origin(name, 1),)), 0, 0)
        raise SparcSyntaxError("the file is in UTF-16", beginning, "save it as UTF-8")
    return Source(name, program_text(data))


def program_text(data: bytes) -> str:
    """Returns the characters of a program, or of a line of it.

    Takes a byte-order mark away; ``\\r\\n`` and a lone ``\\r`` end a line as ``\\n`` does.
    Bytes that are no UTF-8 become U+FFFD: inside a comment they do no harm, and elsewhere the
    lexer names their place.

    >>> program_text(b"\\xef\\xbb\\xbf% caf\\xe9\\r\\nsorts\\r")
    '% caf\ufffd\\nsorts\\n'
    """
    text = data.decode("utf-8", "replace").removeprefix("\ufeff")
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def read_line_capped(stream: IO[AnyStr], most: int) -> AnyStr:
    """Returns the next line of ``stream``, empty at its end.

    Raises `OSError` where it is longer than ``most``.
    """
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
