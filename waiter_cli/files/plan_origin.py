"""Records in a plan the files it was made from, and finds them again.

A plan file has the digest of each text and, where that was a file of the user's, its path relative
to the working folder (which is the plan's folder for whoever writes the plan there).  A file whose
text has another digest is another file: nothing of it is read or shown.

Entry points `remember`, `read_memory`, `find_again`, `is_same`.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.reading import NotText, text_of
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.file_access.locate import MAX_BYTES, data_folder
from waiter_cli.model.source_file import File

if TYPE_CHECKING:
    from waiter_cli.yaml_reading.node_reader import NodeReader
    from waiter_cli.yaml_reading.yaml_tree import Node

__all__ = ["Memory", "find_again", "has_changed", "is_same", "read_memory", "remember"]

_DIGEST = re.compile(r"sha256:[0-9a-f]{64}")


@dataclass(frozen=True)
class Memory:
    """A text that a plan was made from: its digest, and its path where it was the user's file.

    ``where`` is the place in the plan file.
    """

    digest: str
    path: str | None
    where: Where


def remember(text: str, path: str | None) -> dict[str, str]:
    """Returns a text's record: ``digest``, and ``path`` for a file that does not come with waiter."""
    record = {"digest": _digest(text)}
    if path is None or _comes_with_it(path):
        return record
    try:
        return {"path": os.path.relpath(path), **record}
    except (OSError, ValueError):  # the working folder is gone; another drive
        return {"path": os.path.abspath(path), **record}


def _comes_with_it(path: str) -> bool:
    whole = os.path.realpath(path)
    folders = [os.path.realpath(data_folder(kind)) for kind in ("layouts", "domains")]
    return any(whole.startswith(folder + os.sep) for folder in folders)


def _digest(text: str) -> str:
    """Returns the SHA-256 of a text in UTF-8, without loading OpenSSL (10 ms)."""
    try:
        from _sha2 import sha256  # type: ignore[import-not-found]  # Python 3.12 and later
    except ImportError:
        try:
            from _sha256 import sha256  # type: ignore[import-not-found]
        except ImportError:
            from hashlib import sha256
    return f"sha256:{sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()}"


def read_memory(reader: NodeReader, node: Node | None, key: str) -> Memory | None:
    """Returns a plan file's record under ``key``, None where there is none.

    Faults go to the reader.
    """
    keys = None if node is None else reader.mapping(node, key, ("path", "digest"))
    if node is None or keys is None:
        return None
    digest = reader.text(keys["digest"], "digest") if "digest" in keys else ""
    path = reader.text(keys["path"], "path") if "path" in keys else None
    if digest is None or not _DIGEST.fullmatch(digest):
        where = keys["digest"].where if "digest" in keys else node.where
        hint = "leave it as waiter plan --json printed it, or leave it out"
        reader.fault(where, f"{key} has no digest of the form sha256:…", hint)
        return None
    return Memory(digest, path, node.where)


def is_same(memory: Memory, text: str) -> bool:
    """Returns whether the plan was made from exactly this text."""
    return memory.digest == _digest(text)


def find_again(memory: Memory, kind: str) -> File:
    """Returns the file that the plan was made from, beside the plan or in the working folder.

    ``kind`` is ``layout`` or ``domain``.  Raises `InputError` where it is not there, or has changed.
    """
    texts = _there(memory)
    for path, text in texts.items():
        if is_same(memory, text):
            return File(text, path, path)
    if texts:
        changed = next(iter(texts))
        message = f"the {kind} {changed} has changed since the plan was made"
        hint = f"plan again, or take it as it is now: --{kind} {changed}"
    else:
        message = f"the {kind} that the plan was made for is not there: {memory.path}"
        hint = f"say where it is: --{kind} FILE"
    raise InputError([Fault(memory.where, message, hint)])


def has_changed(memory: Memory) -> bool:
    """Returns whether the file that the plan was made from is there with another text only."""
    texts = _there(memory).values()
    return bool(texts) and not any(is_same(memory, text) for text in texts)


def _there(memory: Memory) -> dict[str, str]:
    """Returns the texts that are now at the remembered path, and beside the plan.

    The path is followed from the plan's folder and from the working one; beside the plan lies a file of
    that name.
    """
    if memory.path is None:
        return {}
    folder = os.path.dirname(memory.where.name)
    places = (os.path.join(folder, memory.path), memory.path,
              os.path.join(folder, os.path.basename(memory.path)))  # fmt: skip
    paths = dict.fromkeys(os.path.normpath(place) for place in places)
    return {path: text for path in paths if (text := _text(path)) is not None}


def _text(path: str) -> str | None:
    """Returns the text of a file, None where there is none; ``""`` for what is no text."""
    try:
        if not os.path.isfile(path):
            return None
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
        return text_of(data)
    except NotText:
        return ""
    except (OSError, ValueError):  # not ours to read; a NUL in the name
        return None
