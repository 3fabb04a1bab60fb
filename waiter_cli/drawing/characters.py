"""The characters that a drawing in text is made of: box characters, or plain ASCII."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["ASCII", "BOXES", "Characters", "fits_encoding"]


class Characters(NamedTuple):
    """The characters of a drawing; ``lines`` by directions (1 east, 2 west, 4 north, 8 south).

    ``heads`` are those of one-way paths, east, west, north and south.
    """

    lines: str
    slope: str
    frame: str
    node: str
    entrance: str
    chair: str
    place: str
    guest: str
    wall: str
    bar: str
    arrow: str
    heads: str


BOXES = Characters(
    " ╶╴─╵└┘┴╷┌┐┬│├┤┼", "·", "╔╗╚╝═║", "●", "◉", "▪", "▫", "☺", "█", "▒", "→", "▸◂▴▾"
)
ASCII = Characters(
    " ---|+++|+++|+++", ".", "++++=|", "o", "@", "#", "_", "g", "%", "/", "->", "><^v"
)
assert len(BOXES.lines) == len(ASCII.lines) == 16


def fits_encoding(encoding: str | None) -> Characters:
    """Returns box characters where an encoding has them, else plain ASCII."""
    try:
        "".join(BOXES).encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return BOXES
