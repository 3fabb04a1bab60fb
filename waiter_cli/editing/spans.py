"""The stretches of the values of a YAML text, in characters. Entry point `pieces_of`.

>>> root = pieces_of("nodes: {n1: [0, 2.5]}  # metres")
>>> at = root["nodes"]["n1"]
>>> at.start, at.end, [item.text for item in at.items]
(12, 20, ['0', '2.5'])
"""

from __future__ import annotations

from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import InputError

__all__ = ["Piece", "pieces_of"]


@dataclass(frozen=True)
class Piece:
    """A value of a text, from ``start`` to before ``end``.

    ``kind`` is ``scalar``, ``list`` or ``map``; ``text`` a scalar's value; ``items`` what a list
    holds; ``entries`` the keys and values of a map.  ``flow`` tells that it stands in brackets.  A
    block ends where its last value ends.
    """

    kind: str
    start: int
    end: int
    text: str = ""
    flow: bool = False
    items: tuple[Piece, ...] = ()
    entries: tuple[tuple[Piece, Piece], ...] = ()

    def __getitem__(self, key: str) -> Piece:
        """Returns the value of a key; raises `KeyError` where there is none."""
        for name, value in self.entries:
            if name.text == key:
                return value
        raise KeyError(key)

    def get(self, key: str) -> Piece | None:
        """Returns the value of a key, None where there is none."""
        return next((value for name, value in self.entries if name.text == key), None)

    def key(self, key: str) -> Piece:
        """Returns a key itself; raises `KeyError` where there is none."""
        return next(name for name, _ in self.entries if name.text == key)

    @property
    def is_nothing(self) -> bool:
        """Returns whether this is a value that was left out."""
        return self.kind == "scalar" and self.text in ("", "~", "null") and not self.flow


def pieces_of(text: str) -> Piece | None:
    """Returns the tree of a YAML text, None of an empty one.

    Raises `InputError` where the text is no YAML, or has anchors or a second document: then nothing
    of it can be changed in place.
    """
    import yaml

    builder = _Builder()
    try:
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        for event in yaml.parse(text, Loader=loader):
            builder.take(event, yaml)
    except yaml.YAMLError:
        raise InputError("the text is no YAML now", "mend the text first, or undo") from None
    return builder.root


class _Builder:
    """Puts events together; `take` them in their order."""

    def __init__(self) -> None:
        self.root: Piece | None = None
        self._open: list[tuple[Any, list[Piece]]] = []
        self._documents = 0

    def take(self, event: Any, yaml: Any) -> None:
        if isinstance(event, yaml.DocumentStartEvent):
            self._documents += 1
        if isinstance(event, yaml.AliasEvent) or self._documents > 1:
            raise InputError("aliases and further documents cannot be edited", "write values out")
        if isinstance(event, yaml.ScalarEvent):
            quoted = bool(event.style)
            start, end = event.start_mark.index, event.end_mark.index
            self._add(Piece("scalar", start, end, event.value, quoted))
        elif isinstance(event, (yaml.MappingStartEvent, yaml.SequenceStartEvent)):
            self._open.append((event, []))
        elif isinstance(event, (yaml.MappingEndEvent, yaml.SequenceEndEvent)):
            begun, held = self._open.pop()
            flow = bool(begun.flow_style)
            end = event.end_mark.index if flow else max(piece.end for piece in held)
            start = begun.start_mark.index
            if isinstance(event, yaml.SequenceEndEvent):
                self._add(Piece("list", start, end, "", flow, tuple(held)))
            else:
                pairs = tuple(zip(held[::2], held[1::2], strict=True))
                self._add(Piece("map", start, end, "", flow, (), pairs))

    def _add(self, piece: Piece) -> None:
        if self._open:
            self._open[-1][1].append(piece)
        else:
            self.root = piece
