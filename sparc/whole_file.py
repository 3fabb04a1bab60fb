"""Files that appear whole or not at all: written beside their place, then put there in one step.

Entry points `write_bytes`, `UnfinishedFile` for what is written bit by bit, and `unused_name` and
`put_in_place` for what another program writes.

>>> from tempfile import TemporaryDirectory
>>> with TemporaryDirectory() as folder:
...     write_bytes(f"{folder}/a.txt", b"all of it")
...     os.listdir(folder)
['a.txt']
"""

from __future__ import annotations

import contextlib
import os
from types import TracebackType

from sparc.deferred_signals import undisturbed

__all__ = ["PREFIX", "UnfinishedFile", "put_in_place", "unused_name", "write_bytes"]

PREFIX = ".waiter-"
"""What the names of unfinished files begin with; one that is left behind may be deleted."""
_NEW = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)


class UnfinishedFile:
    """A new file in the folder of ``target``; `keep` puts it in the place of what stood there.

    ``path`` is where it is, under a name that nobody has, with ``suffix``; ``descriptor`` is open
    for reading and writing and belongs to the caller.  A link is followed.  As a context manager
    it is deleted at the end unless it was kept.  Raises `OSError` where it cannot be made.
    """

    def __init__(self, target: str | os.PathLike[str], suffix: str = "") -> None:
        self.target = os.path.realpath(target)
        self.path = ""
        path = unused_name(os.path.dirname(self.target), suffix)
        with undisturbed():  # what is made is known, and deleted
            self.descriptor = os.open(path, _NEW, 0o600)
            self.path = path

    def keep(self, mode: int | None = None) -> None:
        """Puts the file in its place, with ``mode`` or the permissions of what it replaces.

        Raises `OSError`.
        """
        put_in_place(self.path, self.target, mode)
        self.path = ""

    def drop(self) -> None:
        """Deletes the file unless it was kept."""
        if self.path:
            with contextlib.suppress(OSError):
                os.unlink(self.path)
            self.path = ""

    def __enter__(self) -> UnfinishedFile:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.drop()


def write_bytes(target: str | os.PathLike[str], data: bytes, suffix: str = "") -> None:
    """Puts ``data`` at ``target``; what stood there stays until all is written.

    Raises `OSError`.
    """
    with UnfinishedFile(target, suffix) as unfinished:
        with open(unfinished.descriptor, "wb") as file:
            file.write(data)
        unfinished.keep()


def unused_name(folder: str, suffix: str = "") -> str:
    """Returns a path in ``folder`` that nothing has, for what is not finished."""
    return os.path.join(folder, f"{PREFIX}{os.urandom(6).hex()}{suffix}")


def put_in_place(path: str, target: str, mode: int | None = None) -> None:
    """Moves a finished file onto ``target``, with ``mode`` or the permissions that it replaces.

    Raises `OSError`.
    """
    os.chmod(path, _permissions(target) if mode is None else mode)
    os.replace(path, target)


def _permissions(target: str) -> int:
    """Returns the permissions of a file that is replaced, or those of a new one."""
    if os.path.exists(target):
        return os.stat(target).st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
