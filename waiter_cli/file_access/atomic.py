"""Writes a user's file whole or not at all: text or bytes → a path. Entry point `write_whole`."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

from sparc.whole_file import write_bytes
from waiter_cli.errors import Fault, InputError, Where

__all__ = ["may_be_written", "require_apart", "write_whole"]


def write_whole(path: str, content: str | bytes) -> None:
    """Puts ``content`` at ``path``; what stood there stays until the new file is complete.

    A pipe or a device is written as it is, a link is followed.  Text is written as UTF-8.  Raises
    `InputError` where the path cannot be written.
    """
    try:
        data = _encoded(content) if isinstance(content, str) else content
        if os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb") as device:
                device.write(data)
            return
        target = os.path.realpath(path)
        if os.path.exists(target) and not may_be_written(target):
            mend = "give another name, or make it writable"
            raise InputError([Fault(Where(path), "cannot write: it is read-only", mend)])
        write_bytes(target, data)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        reason = error.strerror if isinstance(error, OSError) else str(error)
        folder = os.path.dirname(path)
        hint = f"make the folder {folder} first" if folder and not os.path.exists(folder) else None
        fault = Fault(Where(path), f"cannot write: {(reason or str(error)).lower()}", hint)
        raise InputError([fault]) from error


def require_apart(outputs: Mapping[str, str | None], inputs: Sequence[str]) -> None:
    """Raises `InputError` where an output is one of the ``inputs``, or two outputs are one file.

    ``outputs`` are paths by their option, None where it is not given; a pipe or a device may be several.
    """
    taken = {os.path.realpath(path) for path in inputs}
    for option, path in outputs.items():
        if path is None or (os.path.exists(path) and not os.path.isfile(path)):
            continue
        real = os.path.realpath(path)
        if real in taken:
            told = f"{path} is read or written already, and would be lost"
            raise InputError([Fault(Where(option), told, "give another name")])
        taken.add(real)


def _encoded(text: str) -> bytes:
    """Returns text as UTF-8, the name of a file in it as the bytes that it has, or their codes."""
    try:
        return text.encode("utf-8")
    except UnicodeEncodeError:
        raw = text.encode("utf-8", "surrogateescape")
        return raw.decode("utf-8", "backslashreplace").encode("utf-8")


def may_be_written(target: str) -> bool:
    """Returns whether a file lets itself be replaced: read-only ones stay, for
    whoever runs this as well.
    """
    return bool(os.stat(target).st_mode & 0o222) and os.access(target, os.W_OK)
