"""Reads a SPARC program from a file or from standard input: a name → `Source`."""

from __future__ import annotations

import errno
import os
from collections.abc import Sequence

from sparc.reading import MAX_PROGRAM, program, read_capped
from sparc.source import Source
from waiter_cli.errors import Fault, InputError, Where

__all__ = ["read_program", "read_program_bytes", "require_no_other_kind"]

_TAKEN_BY = {
    "a layout": "a layout is given as --layout, or to `waiter layout check`",
    "a scenario": "a scenario is given as --scenario, such as to `waiter plan`",
    "a plan": "a plan is given to `waiter validate`",
    "a file of cases": "cases stand in the folder cases/ beside a domain: `waiter domain test`",
}


def read_program(name: str, constants: Sequence[str] | None = None) -> Source:
    """Returns the program in the file ``name``; ``-`` is standard input.

    Raises `InputError` when there is no such file, or it is far too large for a program, and
    `SparcSyntaxError` when it is in UTF-16. ``constants`` are settings such as ``n=7``;
    `SourceError` is raised for one that is wrong.
    """
    from sparc.syntax.constants import set_constants

    return set_constants(_read(name), constants or ())


def _read(name: str) -> Source:
    source = program(read_program_bytes(name), "<stdin>" if name == "-" else name)
    require_no_other_kind(source)
    return source


def require_no_other_kind(source: Source) -> None:
    """Raises `InputError` for a layout, a scenario, a plan or cases, with what takes such a file."""
    from waiter_cli.file_access.kinds import kind_of

    kind = kind_of(source.text)
    if kind in _TAKEN_BY:
        what = f"this is {kind}, not a SPARC program"
        raise InputError([Fault(Where(source.name), what, _TAKEN_BY[kind])])


def read_program_bytes(name: str) -> bytes:
    """Returns the bytes of the program in the file ``name``; raises `InputError` as `read_program`."""
    shown = "<stdin>" if name == "-" else name
    try:
        if name != "-" and os.path.isdir(name):
            raise InputError([Fault(Where(name), "this is a folder, not a SPARC program")])
        return read_capped(name, MAX_PROGRAM)
    except (OSError, ValueError) as error:
        if getattr(error, "errno", None) == errno.EFBIG:
            what, mend = str(getattr(error, "strerror", "")), "is this a SPARC program?"
            raise InputError([Fault(Where(shown), what, mend)]) from error
        reason = error.strerror if isinstance(error, OSError) else str(error)
        hint = None if os.path.exists(name.partition("\0")[0]) else _mend(name)
        message = f"cannot read the program: {(reason or str(error)).lower()}"
        raise InputError([Fault(Where(name), message, hint)]) from error


def _mend(name: str) -> str:
    from waiter_cli.file_access.locate import built_in

    for kind in ("scenario", "layout"):
        if name in built_in(kind):
            return f"give the path of a SPARC program, or waiter answersets --{kind} {name}"
    return "give the path of a SPARC program"
