"""Finds layouts, scenarios and domains: a path where such a file exists, else a built-in name.

Built-ins lie in `layouts/` and `domains/`: inside the package where it was installed from a wheel,
beside it in a checkout or an editable install.  Entry points `read_text`, `find`, `built_in`, `is_layout`.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager

from sparc.reading import NotText, read_capped, text_of
from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.model.source_file import File

__all__ = [
    "BuiltIn",
    "MAX_BYTES",
    "built_in",
    "built_ins_first",
    "data_folder",
    "decode",
    "find",
    "is_layout",
    "is_stream",
    "read_text",
]

MAX_BYTES = 1 << 22
_SUFFIX = ".yaml"


class BuiltIn(str):
    """The name of a built-in that nobody typed: a default, or what a plan was made with.

    No file of that name stands for it.
    """

    __slots__ = ()


_first: list[bool] = []


@contextmanager
def built_ins_first() -> Iterator[None]:
    """Has every built-in name stand for the built-in, whatever files lie in the working directory."""
    _first.append(True)
    try:
        yield
    finally:
        _first.pop()


def data_folder(name: str) -> str:
    """Returns the folder of shipped data of that name, such as ``layouts`` or ``domains``.

    >>> os.path.isfile(os.path.join(data_folder("layouts"), "report.yaml"))
    True
    """
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    installed = os.path.join(package, "_data", name)
    if os.path.isdir(installed):
        return installed
    return os.path.join(os.path.dirname(package), name)


def _folder_of(kind: str) -> str:
    if kind == "domain":
        return data_folder("domains")
    if kind == "study":  # none is shipped
        return data_folder("studies")
    layouts = data_folder("layouts")
    return os.path.join(layouts, "scenarios") if kind == "scenario" else layouts


def _path_of(kind: str, name: str) -> str:
    """Returns the path of a built-in: a YAML file, or the template in a domain's folder."""
    inner = os.path.join(name, "domain.sparc") if kind == "domain" else name + _SUFFIX
    return os.path.join(_folder_of(kind), inner)


def built_in(kind: str) -> tuple[str, ...]:
    """Returns the built-in names of a kind (``layout``, ``scenario`` or ``domain``), sorted."""
    try:
        names = os.listdir(_folder_of(kind))
    except OSError:
        return ()
    if kind == "domain":
        return tuple(sorted(name for name in names if os.path.isfile(_path_of(kind, name))))
    return tuple(sorted(n.removesuffix(_SUFFIX) for n in names if n.endswith(_SUFFIX)))


def find(name: str, kind: str, folder: str | None = None, where: Where | None = None) -> str:
    """Returns the path of a layout, scenario or domain (``kind``): a file of that
    name, else a built-in one.

    ``folder`` is where a relative name starts from (the working directory unless told).
    Raises `LayoutError`, at ``where`` or at the option, when there is neither.
    """
    place = where or Where(f"--{kind}")
    if "\0" in name or not name.strip():
        raise LayoutError([Fault(place, f"no {kind} is called {name!r}")])
    if (_first or isinstance(name, BuiltIn)) and name in built_in(kind):
        return _path_of(kind, name)
    path = _encodable(os.path.join(folder, name) if folder else name)
    if os.path.exists(path) and not os.path.isdir(path):
        return path
    names = built_in(kind)
    if name in names:
        return _path_of(kind, name)
    for shipped in names:
        if name == _shown(_path_of(kind, shipped)):  # as messages write it
            return _path_of(kind, shipped)
    if os.path.isdir(path):
        inside = "the folder of a domain holds domain.sparc" if kind == "domain" else None
        raise LayoutError([Fault(place, f"{name} is a folder, not a {kind} file", inside)])
    mend = _elsewhere(name, kind, place) or _mend(name, path, names)
    raise LayoutError([Fault(place, f"there is no {kind} {name}", mend)])


def is_layout(path: str) -> bool:
    """Returns whether a YAML file is a layout, not a scenario, going by its keys alone."""
    try:
        with open(path, "rb") as file:
            return b"\nnodes:" in b"\n" + file.read(MAX_BYTES)
    except OSError:
        return False


def is_stream(path: str) -> bool:
    """Returns whether a path is a pipe, a device or a folder: nothing that a listing is read for."""
    return os.path.exists(path) and not os.path.isfile(path)


def _encodable(path: str) -> str:
    """Returns a path as this system takes it: by its bytes in UTF-8, where its
    locale knows ASCII only.
    """
    try:
        os.fsencode(path)
    except UnicodeEncodeError:
        return os.fsdecode(path.encode("utf-8", "surrogateescape"))
    return path


def _elsewhere(name: str, kind: str, place: Where) -> str | None:
    """Returns a hint for a scenario's name given where a layout stands, or the other way round."""
    other = {"layout": "scenario", "scenario": "layout"}.get(kind)
    if other is None or name not in built_in(other):
        return None
    if place.name.startswith("--"):
        return f"did you mean --{other} {name}?"
    return f"{name} is a {other}; built-in {kind}s are {', '.join(built_in(kind))}"


def _mend(name: str, path: str, names: tuple[str, ...]) -> str:
    from waiter_cli.spelling import suggest

    for suffix in (_SUFFIX, ".yml"):
        if os.path.isfile(path + suffix):
            return f"did you mean {name}{suffix}?"
    stem = os.path.basename(name).removesuffix(_SUFFIX)
    if stem in names:
        return f"no file has that name; did you mean the built-in {stem}?"
    close = suggest(stem, names)
    if not names:
        return "give the path of a file"
    listed = f"give the path of a file, or a built-in: {', '.join(names)}"
    return listed if close is None else f"did you mean {close}? {listed}"


def read_text(name: str, kind: str, folder: str | None = None, where: Where | None = None) -> File:
    """Returns the text of a layout, scenario or domain; ``-`` is standard input.

    Raises `LayoutError` where nothing of that name exists or it cannot be read as UTF-8.
    """
    if name == "-":
        return File(decode(_whole("-", "<stdin>"), "<stdin>"), "<stdin>", None)
    path = find(name, kind, folder, where)
    shown = _shown(path)
    try:
        data = _whole(path, shown)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise LayoutError([Fault(where or Where(f"--{kind}"), f"{shown}: {reason}")]) from None
    return File(decode(data, shown), shown, path)


def _whole(path: str, shown: str) -> bytes:
    """Returns the bytes of a file, ``-`` for standard input.

    Raises `OSError`, `LayoutError` where it is large.
    """
    try:
        return read_capped(path, MAX_BYTES)
    except OSError as error:
        if error.errno != errno.EFBIG:
            raise
        fault = Fault(Where(shown, 1, 1), error.strerror or "too large", "is it the right file?")
        raise LayoutError([fault]) from None


def _shown(path: str) -> str:
    """Returns a path as a person would write it.

    It is relative where it lies below the working directory, and ``layouts/report.yaml`` for what is
    shipped.
    """
    try:
        here = os.getcwd()
    except OSError:
        return path
    whole = os.path.abspath(path)
    if whole.startswith(here + os.sep):
        return os.path.relpath(whole, here)
    for kind in ("layouts", "domains"):
        folder = data_folder(kind)
        if whole.startswith(folder + os.sep):  # shipped: wherever it was installed
            return os.path.join(kind, os.path.relpath(whole, folder))
    return path


def decode(data: bytes, shown: str) -> str:
    """Returns the text in the bytes of a file; raises `LayoutError` at the first that is none."""
    try:
        return text_of(data)
    except NotText as error:
        place = Where(shown, error.line, error.column)
        if error.utf_16:
            raise LayoutError([Fault(place, "the file is in UTF-16", "save it as UTF-8")]) from None
        from waiter_cli.file_access.kinds import kind_of_bytes

        what = kind_of_bytes(data)
        if what is not None:
            raise LayoutError([Fault(Where(shown), f"this is {what}, no text")]) from None
        raise LayoutError([Fault(place, "no UTF-8 text", "save it as UTF-8")]) from None
