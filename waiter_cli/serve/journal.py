"""Writes accepted lines to disk before they are answered: one JSON object a line, a header first.

Entry points: `Journal.open` to write; `read_journal` and `stream_journal` to read.  Every record is
forced to the disk before `Journal.append` returns.  A last line without its end (the power went, the
process was killed) was never answered: it is dropped.  Anything else that is wrong is an error, never
guessed at.  A lock keeps a second writer out for as long as the file is open.

Every `SNAPSHOT_EVERY` records one holds a snapshot of all that is known after it, too, and a checksum
(CRC-32) of the file before it.  So whoever opens a journal reads the last of them and what follows;
of the past only the checksum is taken.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Callable, Iterator
from typing import Any, BinaryIO
from zlib import crc32

from sparc.lazy_dataclass import dataclass
from sparc.whole_file import UnfinishedFile
from waiter_cli.errors import Fault, InputError, Where

__all__ = [
    "FORMAT",
    "SNAPSHOT_EVERY",
    "Journal",
    "JournalFull",
    "Recorded",
    "read_journal",
    "stream_journal",
]

FORMAT = "waiter.journal/1"
SNAPSHOT_EVERY = 100
"""So many records at most are lived through again at a start."""
MAX_RECORD = 64 << 20
"""The longest line of a journal, in bytes."""
_NO_WAITING = getattr(os, "O_NONBLOCK", 0)  # for a writer, where the file is a pipe
_MEND = "restore the file from a copy"


class JournalFull(Exception):
    """A record cannot be made durable; the journal is as it was before.  ``why`` says the reason."""

    def __init__(self, path: str, why: str) -> None:
        super().__init__(f"{path}: {why}")
        self.why = why


@dataclass(frozen=True)
class Recorded:
    """A journal that was read: its first object, its records, and the length of the sound part.

    ``torn`` is the number of bytes of an unfinished last line.  Where ``base`` is a record with a
    snapshot, ``records`` are those that follow it.  ``count`` is the number of sound lines,
    ``checksum`` the CRC-32 of them all.
    """

    header: dict[str, Any]
    records: tuple[dict[str, Any], ...]
    length: int
    torn: int = 0
    base: dict[str, Any] | None = None
    count: int = 1
    checksum: int = 0


def read_journal(path: str) -> Recorded | None:
    """Returns all that a journal holds; None for an empty one.

    Raises `InputError` where the file cannot be read, is no journal or of another format, or where
    a line that was finished is damaged.
    """
    with _opened(path) as file:
        found = _read(path, file, whole=True)
    return found if isinstance(found, Recorded) else None


def stream_journal(path: str, warn: Callable[[str], None]) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yields the objects of a journal with the numbers of their lines, one after the other.

    ``warn`` is told of an unfinished last line.  Raises `InputError` as `read_journal` does.
    """
    with _opened(path) as file:
        for number, line in _lines(path, file):
            if line.endswith(b"\n"):
                yield number, _record(path, number, line)
            else:
                _must_begin_so(path, number, line)
                warn(f"{path}: the last line was not finished; {len(line)} bytes left out")


def _opened(path: str) -> BinaryIO:
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            raise _wrong(path, "this is no regular file", "name another file")
        return open(path, "rb")
    except (OSError, ValueError) as error:
        raise _wrong(path, f"cannot be read: {_reason(error)}") from None


def _lines(path: str, file: BinaryIO) -> Iterator[tuple[int, bytes]]:
    number = 0
    while True:
        try:
            line = file.readline(MAX_RECORD)
        except OSError as error:
            raise _wrong(path, f"cannot be read: {_reason(error)}") from None
        if not line:
            return
        number += 1
        if len(line) >= MAX_RECORD:
            raise _wrong(path, "this line is too long for a journal", "name another file", number)
        yield number, line


def _read(path: str, file: BinaryIO, whole: bool = False) -> Recorded | int:
    """Returns the content of a journal, from its last snapshot on unless ``whole``.

    Of one without a whole line: the number of bytes of the beginning that there is.
    """
    header: dict[str, Any] | None = None
    base: dict[str, Any] | None = None
    kept: list[tuple[int, bytes]] = []
    length = checksum = count = torn = 0
    for number, line in _lines(path, file):
        if not line.endswith(b"\n"):
            _must_begin_so(path, number, line)
            torn = len(line)
            break
        if header is None:
            header = _record(path, number, line)
        elif not whole and _has_snapshot(number, line):
            base = _record(path, number, line)
            if base.get("crc") != checksum:
                file.seek(0)
                raise _changed(path, file, number)
            kept = []
        else:
            kept.append((number, line))
        count = number
        length += len(line)
        checksum = crc32(line, checksum)
    if header is None:
        return torn
    records = tuple(_record(path, number, line) for number, line in kept)
    return Recorded(header, records, length, torn, base, count, checksum)


def _has_snapshot(number: int, line: bytes) -> bool:
    return line.startswith(b'{"seq": %d, "crc": ' % (number - 1))


def _changed(path: str, file: BinaryIO, number: int) -> InputError:
    """Returns the fault of a line before the one of this number: its place, if that can be told."""
    last = 1
    checksum = 0
    for other, line in _lines(path, file):
        if other == number:
            break
        value = _record(path, other, line)  # raises where it is no record
        if "crc" in value and value["crc"] == checksum:
            last = other
        checksum = crc32(line, checksum)
    message = f"a line from here to line {number - 1} has been changed"
    return _wrong(path, message, _MEND, last)


def _record(path: str, number: int, line: bytes) -> dict[str, Any]:
    """Returns the object of a finished line; raises `InputError` where it is not what is due there."""
    value = _object(line)
    if value is None:
        if number == 1:
            _must_begin_so(path, number, line)
        lose = "" if number == 1 else "; or cut the file before this line: what follows is lost"
        raise _wrong(path, "this line is damaged", _MEND + lose, number)
    if number == 1 and value.get("journal") != FORMAT:
        other = value.get("journal")
        what = f"a journal of format {other}" if isinstance(other, str) else "no journal"
        raise _wrong(path, f"this is {what}, {FORMAT} is expected", "name another file", 1)
    if number > 1 and value.get("seq") != number - 1:
        raise _wrong(path, f"record {number - 1} is missing", "restore the file", number)
    return value


def _must_begin_so(path: str, number: int, line: bytes) -> None:
    """Raises `InputError` where a first line is not even the beginning of one."""
    due = b'{"journal": "'
    if number == 1 and not due.startswith(line[: len(due)]):
        raise _wrong(path, "this is no journal", "name another file", 1)


def _object(line: bytes) -> dict[str, Any] | None:
    try:
        value = json.loads(line, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def _no_constant(name: str) -> None:
    raise ValueError(name)


class Journal:
    """A journal that is open for writing, and locked."""

    def __init__(self, path: str, file: str, descriptor: int, found: Recorded | None) -> None:
        self.path = path
        self._file = file
        self._descriptor = descriptor
        self._length = found.length if found else 0
        self._count = found.count if found else 0
        self._checksum = found.checksum if found else 0
        self._since = len(found.records) if found else 0

    @classmethod
    def open(cls, path: str, warn: Callable[[str], None]) -> tuple[Journal, Recorded | None]:
        """Returns the journal at ``path``, made where there is none, and what it holds so far.

        An unfinished last line is cut off, and ``warn`` is told.  Where ``path`` is a link, the
        file that it leads to is the journal.  Raises `InputError` where somebody else writes it,
        where it cannot be written, and as `read_journal` does.
        """
        try:
            file = os.path.realpath(path)
        except ValueError as error:
            raise _wrong(path, f"cannot be opened: {_reason(error)}", "name another file") from None
        descriptor = _locked(path, file)
        try:
            with os.fdopen(os.dup(descriptor), "rb") as reading:
                reading.seek(0)
                found = _read(path, reading)
            if isinstance(found, Recorded):
                torn, length, read = found.torn, found.length, found
            else:
                torn, length, read = found, 0, None
            if torn:
                os.ftruncate(descriptor, length)
                os.fsync(descriptor)
                warn(f"{path}: the last line was not finished; {torn} bytes dropped")
        except OSError as error:
            os.close(descriptor)
            raise _wrong(path, f"cannot be mended: {_reason(error)}") from None
        except BaseException:
            os.close(descriptor)
            raise
        return cls(path, file, descriptor, read), read

    @property
    def due(self) -> bool:
        """Returns whether the next record is to hold a snapshot."""
        return self._since >= SNAPSHOT_EVERY - 1

    def begin(self, header: dict[str, Any]) -> None:
        """Writes the first line; raises `JournalFull`."""
        self._write({"journal": FORMAT, **header})
        _sync_folder(self._file)

    def append(self, record: dict[str, Any], snapshot: dict[str, Any] | None = None) -> None:
        """Makes a record durable; raises `JournalFull`, and nothing was recorded then.

        ``snapshot`` is all that is known after it.
        """
        if snapshot is None:
            self._write({"seq": self._count, **record})
            self._since += 1
        else:
            head = {"seq": self._count, "crc": self._checksum}
            self._write({**head, **record, "snapshot": snapshot})
            self._since = 0

    def _write(self, value: dict[str, Any]) -> None:
        data = (json.dumps(value, allow_nan=False) + "\n").encode()
        try:
            _write_all(self._descriptor, data, self._length)
        except OSError as error:
            try:
                os.ftruncate(self._descriptor, self._length)
                os.fsync(self._descriptor)
            except OSError:
                pass  # what is left over is an unfinished last line, or is written over
            raise JournalFull(self.path, f"cannot be written: {_reason(error)}") from None
        self._length += len(data)
        self._count += 1
        self._checksum = crc32(data, self._checksum)

    def compact(self, header: dict[str, Any]) -> None:
        """Puts a new beginning in place of everything so far, at once or not at all.

        Raises `JournalFull`, and the journal is as it was then.
        """
        data = (json.dumps({"journal": FORMAT, **header}, allow_nan=False) + "\n").encode()
        try:
            if os.fstat(self._descriptor).st_nlink > 1:
                message = "cannot be made smaller: the file has other names (hard links)"
                raise JournalFull(self.path, f"{message}; remove them, or copy the file")
            with UnfinishedFile(self._file) as unfinished:
                fresh = unfinished.descriptor
                try:
                    _lock(fresh)
                    _write_all(fresh, data, 0)
                    unfinished.keep(os.fstat(self._descriptor).st_mode & 0o777)
                except BaseException:
                    os.close(fresh)
                    raise
        except OSError as error:
            raise JournalFull(self.path, f"cannot be made smaller: {_reason(error)}") from None
        _sync_folder(self._file)
        os.close(self._descriptor)
        self._descriptor, self._length, self._count = fresh, len(data), 1
        self._checksum, self._since = crc32(data), 0

    def close(self) -> None:
        """Lets go of the file and its lock."""
        os.close(self._descriptor)


def _write_all(descriptor: int, data: bytes, at: int) -> None:
    """Writes and forces to the disk; raises `OSError`."""
    written = 0
    while written < len(data):
        written += os.pwrite(descriptor, data[written:], at + written)
    os.fsync(descriptor)


def _locked(path: str, file: str) -> int:
    """Returns a descriptor of the file, made where there is none, that nobody else holds."""
    while True:
        try:
            descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | _NO_WAITING, 0o600)
        except (OSError, ValueError) as error:
            hint = "name a file in a folder that can be written"
            raise _wrong(path, f"cannot be opened for writing: {_reason(error)}", hint) from None
        try:
            mode = os.fstat(descriptor).st_mode
            if not stat.S_ISREG(mode):
                raise _wrong(path, "this is no regular file", "name another file")
            if not mode & 0o222:  # root could write it, but nobody is meant to
                raise _wrong(path, "is read-only", f"chmod u+w {path}, or name another file")
            _lock(descriptor)
            # Compaction puts another file in place: one that is gone must not be written.
            if os.path.samestat(os.fstat(descriptor), os.stat(file)):
                return descriptor
        except BlockingIOError:
            os.close(descriptor)
            hint = "end the other waiter serve, or name another file"
            raise _wrong(path, "somebody else writes this journal", hint) from None
        except FileNotFoundError:
            pass
        except OSError as error:
            os.close(descriptor)
            raise _wrong(path, f"cannot be locked: {_reason(error)}") from None
        except InputError:
            os.close(descriptor)
            raise
        os.close(descriptor)


def _lock(descriptor: int) -> None:
    """Raises `BlockingIOError` where another process holds the lock."""
    try:
        import fcntl
    except ImportError:  # no such locks on this system
        return
    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _sync_folder(path: str) -> None:
    """Makes the name of a new file durable."""
    try:
        folder = os.open(os.path.dirname(path) or ".", os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(folder)
    except OSError:
        pass  # some file systems cannot; the file itself is synced
    finally:
        os.close(folder)


def _wrong(path: str, message: str, hint: str | None = None, line: int = 0) -> InputError:
    return InputError([Fault(Where(path, line, 1 if line else 0), message, hint)])


def _reason(error: Exception) -> str:
    return (getattr(error, "strerror", None) or str(error)).lower()
