"""Names the kind of file that was given in place of another: ``a plan``, ``a SPARC program``, …

Entry points `kind_of`, `kind_of_bytes` and `told_as_it_is`.  A guess by a look at its beginning and
its keys, for messages only: nothing is read or refused by it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from waiter_cli.errors import Fault, LayoutError, Where

__all__ = ["CERTAIN", "kind_of", "kind_of_bytes", "told_as_it_is"]

_KEYS = {
    "a plan": ("actions", "horizon"),
    "a layout": ("nodes", "edges", "tables", "entrance"),
    "a scenario": (
        "state",
        "observe",
        "goals",
        "events",
        "before",
        "prefer",
        "layout",
        "guests",
        "minutes",
    ),
    "a file of cases": ("cases",),
    "a study": ("layouts", "vary", "evenings"),
}
# Patterns as text: few runs need them, and each would take a while to compile at every start.
_KEY = r"""(?m)^(?:[{\s]*)["']?([a-z_]+)["']?[ \t]*:(?=\s|$)"""
_INNER = r"""["']?\b([a-z_]+)["']?[ \t]*:(?=[\s\[{])"""
_SECTION = r"(?m)^[ \t]*(?:sorts|predicates|rules)\b(?!\s*:)"
_MAGIC = (
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a ZIP archive (an .xlsx, .docx or .jar is one)"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"\x7fELF", "a program for this machine"),
)
_MOST = 1 << 16

CERTAIN = frozenset({*_KEYS, "a SPARC program", "an SVG picture", "a page of HTML or XML"})
"""What nothing else is taken for."""


def kind_of(text: str, likely: str | None = None) -> str:
    """Returns the kind of a text, with its article; ``likely`` where it could as well be another.

    >>> kind_of("nodes: {a: [0, 0]}\\nedges: []\\ntables: {}\\n")
    'a layout'
    >>> kind_of("sorts\\n#p = {a}.\\npredicates\\nq(#p).\\nrules\\nq(a).\\n")
    'a SPARC program'
    """
    text = text[:_MOST]
    start = text.lstrip("\ufeff \t\r\n")
    if not start:
        return "an empty file"
    if start.startswith(("<svg", "<?xml", "<!DOCTYPE", "<html", "<HTML")):
        return "an SVG picture" if "<svg" in start[:2000] else "a page of HTML or XML"
    if re.search(_SECTION, text) and not re.match(_KEY, start):
        return "a SPARC program"
    is_json = start[0] in "{["
    found = re.findall(_INNER if is_json else _KEY, text)
    keys = set(found)
    if "cases" in keys:  # beside a layout, which scenarios have, too
        return "a file of cases"
    best = max(_KEYS, key=lambda kind: (len(keys.intersection(_KEYS[kind])), kind == likely))
    shared = keys.intersection(_KEYS[best])
    if {"actions", "horizon"} <= keys:
        return "a plan"
    if shared and (best != "a layout" or len(shared) > 1):
        return best
    if is_json:
        return "JSON of another kind"
    return "YAML of another kind" if keys else "a text of another kind"


def kind_of_bytes(data: bytes) -> str | None:
    """Returns the kind of a file that is no text, None where its beginning does not tell."""
    return next((what for magic, what in _MAGIC if data.startswith(magic)), None)


@contextmanager
def told_as_it_is(text: str, shown: str, wanted: str, named: Where | None = None) -> Iterator[None]:
    """Turns the faults of a file that is something else altogether into one that says what it is.

    ``named`` is the place of another file that names this one: then no line of it is shown, and
    nothing of what it says, unless it is ``wanted``.  Raises `LayoutError`.
    """
    try:
        yield
    except LayoutError:
        kind = kind_of(text, wanted)
        if kind == wanted or (kind not in CERTAIN and named is None):
            raise
        if named is not None:
            raise LayoutError([Fault(named, f"{shown} is {kind}, not {wanted}")]) from None
        raise LayoutError([Fault(Where(shown), f"this is {kind}, not {wanted}")]) from None
