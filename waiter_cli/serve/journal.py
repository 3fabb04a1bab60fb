"""What was accepted, on disk before it is answered: one JSON object a line, the first says what it is.

Entry points: `Journal.open` to write, `read_journal` to read.  Every record is forced to the disk
before `Journal.append` returns.  A last line that was not written to its end (the power went, the
process was killed) was never answered: it is dropped.  Anything else that is wrong is an error,
never guessed at.  A lock keeps a second writer out for as long as the file is open.
"""

from __future__ import annotations

import errno
import json
import os
import stat
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sparc.reading import read_capped
from waiter_cli.exits import Fault, InputError
from waiter_cli.situation import Where

__all__ = ["FORMAT", "Journal", "JournalFull", "Recorded", "read_journal"]

FORMAT = "waiter.journal/1"
MAX_JOURNAL = 1 << 28
"""The most bytes of a journal that are read; beyond, ``--compact`` has been forgotten for long."""


class JournalFull(Exception):
    """A record cannot be made durable; the journal is as it was before."""


@dataclass(frozen=True)
class Recorded:
    """A journal that was read: its first object, its records, and the length of the sound part.

    ``torn`` is the number of bytes of an unfinished last line.
    """

    header: dict[str, Any]
    records: tuple[dict[str, Any], ...]
    length: int
    torn: int = 0


def read_journal(path: str) -> Recorded | None:
    """What a journal holds; None for an empty one.

    Raises `InputError` where the file cannot be read, is no journal or of another format, or where
    a line other than the last is damaged.
    """
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            raise _wrong(path, "this is no regular file", "name another file")
        data = read_capped(path, MAX_JOURNAL)
    except OSError as error:
        raise _wrong(path, f"cannot be read: {_reason(error)}") from None
    return _read(path, data)


def _read(path: str, data: bytes) -> Recorded | None:
    found: list[dict[str, Any]] = []
    length = 0
    lines = data.split(b"\n")
    for number, line in enumerate(lines, 1):
        whole = number < len(lines)
        if not whole and not line:
            break
        value = _object(line) if whole else None
        if value is None:
            if number >= len(lines) - (not lines[-1]):  # the last line: never answered
                break
            raise _wrong(path, "this line is damaged", "restore the file from a copy", number)
        if number == 1 and value.get("journal") != FORMAT:
            other = value.get("journal")
            what = f"a journal of format {other}" if isinstance(other, str) else "no journal"
            raise _wrong(path, f"this is {what}, {FORMAT} is expected", "name another file", 1)
        if number > 1 and value.get("seq") != number - 1:
            raise _wrong(path, f"record {number - 1} is missing", "restore the file", number)
        found.append(value)
        length += len(line) + 1
    if not found:
        # What is torn may only be the beginning of a journal's first line.
        if data and not (b'{"journal": "'.startswith(data[:13]) or data[:13] == b'{"journal": "'):
            raise _wrong(path, "this is no journal", "name another file", 1)
        return None
    return Recorded(found[0], tuple(found[1:]), length, len(data) - length)


def _object(line: bytes) -> dict[str, Any] | None:
    try:
        value = json.loads(line, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def _no_constant(name: str) -> None:
    """JSON has no ``NaN`` and no ``Infinity``, whatever Python reads as such."""
    raise ValueError(name)


class Journal:
    """A journal that is open for writing, and locked."""

    def __init__(self, path: str, descriptor: int, length: int, count: int) -> None:
        self.path = path
        self._descriptor = descriptor
        self._length = length
        self._count = count

    @classmethod
    def open(cls, path: str, warn: Callable[[str], None]) -> tuple[Journal, Recorded | None]:
        """The journal at ``path``, made where there is none, and what it holds so far.

        An unfinished last line is cut off, and ``warn`` is told.  Raises `InputError` where
        somebody else writes it, where it cannot be written, and as `read_journal` does.
        """
        descriptor = _locked(path)
        try:
            size = os.fstat(descriptor).st_size
            if size > MAX_JOURNAL:
                raise OSError(errno.EFBIG, f"larger than {MAX_JOURNAL >> 20} MB")
            found = _read(path, os.pread(descriptor, size, 0) if size else b"")
            if found is None:
                torn, length, count = size, 0, 0
            else:
                torn, length, count = found.torn, found.length, 1 + len(found.records)
            if torn:
                os.ftruncate(descriptor, length)
                os.fsync(descriptor)
                warn(f"{path}: the last line was not finished; {torn} bytes dropped")
        except OSError as error:
            os.close(descriptor)
            raise _wrong(path, f"cannot be mended: {_reason(error)}") from None
        except InputError:
            os.close(descriptor)
            raise
        return cls(path, descriptor, length, count), found

    def begin(self, header: dict[str, Any]) -> None:
        """Writes the first line; raises `JournalFull`."""
        self._write({"journal": FORMAT, **header})
        _sync_folder(self.path)

    def append(self, record: dict[str, Any]) -> None:
        """Makes a record durable; raises `JournalFull`, and nothing was recorded then."""
        self._write({"seq": self._count, **record})

    def _write(self, value: dict[str, Any]) -> None:
        data = (json.dumps(value) + "\n").encode()
        try:
            written = 0
            while written < len(data):
                at = self._length + written
                written += os.pwrite(self._descriptor, data[written:], at)
            os.fsync(self._descriptor)
        except OSError as error:
            try:
                os.ftruncate(self._descriptor, self._length)
                os.fsync(self._descriptor)
            except OSError:
                pass  # what is left over is an unfinished last line, or is written over
            raise JournalFull(f"{self.path}: cannot be written: {_reason(error)}") from None
        self._length += len(data)
        self._count += 1

    def compact(self, header: dict[str, Any]) -> None:
        """Puts a new beginning in place of everything so far, at once or not at all.

        Raises `JournalFull`, and the journal is as it was then.
        """
        beside = f"{self.path}.new"
        data = (json.dumps({"journal": FORMAT, **header}) + "\n").encode()
        try:
            fresh = os.open(beside, os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC, 0o600)
            try:
                _lock(fresh)
                os.fchmod(fresh, os.fstat(self._descriptor).st_mode & 0o777)
                if os.pwrite(fresh, data, 0) != len(data):
                    raise OSError(28, "No space left on device")
                os.fsync(fresh)
                os.replace(beside, self.path)
            except OSError:
                os.close(fresh)
                os.unlink(beside)
                raise
        except OSError as error:
            raise JournalFull(f"{self.path}: cannot be made smaller: {_reason(error)}") from None
        _sync_folder(self.path)
        os.close(self._descriptor)
        self._descriptor, self._length, self._count = fresh, len(data), 1

    def close(self) -> None:
        """Lets go of the file and its lock."""
        os.close(self._descriptor)


def _locked(path: str) -> int:
    """A descriptor of the file, made where there is none, that nobody else holds."""
    while True:
        try:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
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
            if os.path.samestat(os.fstat(descriptor), os.stat(path)):
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
