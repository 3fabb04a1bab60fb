"""The layout's file, as the studio found it and as it writes it. Entry points `state_of`, `save`.

Only the file that was opened is written: whole or not at all, through no link, and never over what
somebody else wrote there meanwhile, unless the person at the page says so.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import threading

from sparc.lazy_dataclass import dataclass
from sparc.whole_file import put_in_place, unused_name
from waiter_cli.errors import InputError
from waiter_cli.file_access.atomic import may_be_written
from waiter_cli.file_access.locate import MAX_BYTES, data_folder, decode

__all__ = ["FileState", "digest_of", "save", "state_of"]

_BOM = b"\xef\xbb\xbf"
_saving = threading.Lock()


@dataclass(frozen=True)
class FileState:
    """The file at a path: its text and its digest, and in ``kept`` why it cannot be written."""

    text: str
    digest: str
    kept: str | None


def digest_of(data: bytes) -> str:
    """Returns what tells two contents of a file apart."""
    return hashlib.sha256(data).hexdigest()


def state_of(path: str) -> FileState:
    """Returns the state of the file at ``path``; raises `InputError` where it cannot be read."""
    data = _read(path)
    if data is None:
        raise InputError(f"there is no file {os.path.basename(path)} any more")
    return FileState(decode(data, os.path.basename(path)), digest_of(data), _why_kept(path))


def save(path: str, text: str, known: str | None) -> str | None:
    """Writes the file and returns its new digest; None where it holds something else than ``known``.

    With ``known`` None whatever is there is written over.  Raises `InputError` where it must not be
    written, or cannot be.
    """
    with _saving:
        why = _why_kept(path)
        if why is not None:
            raise InputError(f"not saved: {why}", "keep a copy with Download")
        before = _read(path)
        if known is not None and (before is None or digest_of(before) != known):
            return None
        data = text.encode("utf-8", "surrogatepass")
        if before is not None and before.startswith(_BOM):
            data = _BOM + data
        if len(data) > MAX_BYTES:
            raise InputError("not saved: the text is too long")
        try:
            _write(path, data)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise InputError(f"not saved: {reason}", "keep a copy with Download") from None
        return digest_of(data)


def _read(path: str) -> bytes | None:
    """Returns the bytes of a file that is no link; None where there is none."""
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | _NO_WAIT)
        with open(descriptor, "rb") as file:
            return file.read(MAX_BYTES + 1)
    except OSError:
        return None


_NO_WAIT = getattr(os, "O_NONBLOCK", 0)
"""A pipe that was put in the file's place is not waited for."""


def _why_kept(path: str) -> str | None:
    """Returns why the file at ``path`` is not to be written, None where it may be."""
    folder = os.path.dirname(path)
    if not path:
        return "there is no file"
    if folder.startswith(os.path.realpath(data_folder("layouts"))):
        return "this restaurant comes with waiter and stays as it is"
    if os.path.realpath(folder) != folder:
        return "its folder is a link now"
    try:
        found = os.lstat(path)
    except OSError:
        return None if os.path.isdir(folder) else "its folder is gone"
    if stat.S_ISLNK(found.st_mode):
        return "it is a link"
    if not stat.S_ISREG(found.st_mode):
        return "it is no regular file"
    return None if may_be_written(path) else "it is read-only"


def _write(path: str, data: bytes) -> None:
    """Puts the bytes there in one step; a link in the file's place would be replaced, not followed."""
    part = unused_name(os.path.dirname(path))
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    try:
        with open(os.open(part, flags, 0o600), "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        put_in_place(part, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(part)
        raise
