"""Names cut to the room that a drawing in characters has, and the line that says what they stand for."""

from __future__ import annotations

from collections.abc import Collection

__all__ = ["cut", "shorten", "told"]

FEW = 3
"""As many short names are told one by one; more of a kind by the first two."""


def cut(name: str, room: int) -> str:
    """Returns a name cut to so many characters; a number at its end stays.

    >>> cut("table12", 5), cut("terrace", 5)
    ('t12', 'terra')
    """
    if len(name) <= room:
        return name
    digits = name[len(_stem(name)) :]
    if digits and len(digits) <= room:
        return (name[0] + digits)[-room:]
    return name[:room]


def shorten(name: str, room: int, taken: Collection[str]) -> str:
    """Returns a name cut to so many characters, unlike those that are taken where that is possible.

    >>> shorten("terrace_left", 5, ["terra"])
    'terr2'
    """
    short = cut(name, room)
    for number in range(2, 1000):
        if short not in taken:
            return short
        digits = str(number)
        if len(digits) >= room:
            break
        short = name[: room - len(digits)] + digits
    return cut(name, room)


def told(short: dict[str, str]) -> str:
    """Returns the meaning of the short names in one line; empty where there are none.

    >>> told({"t3": "table3", "terra": "terrace"})
    'short names: t3 is table3, terra is terrace'
    >>> told({f"t{k}": f"table{k}" for k in range(1, 9)})
    'short names: t1 is table1, t2 is table2 and so on'
    """
    kinds: dict[tuple[str, str], list[str]] = {}
    for cut_name, name in short.items():
        kind = (_stem(cut_name), _stem(name))
        if cut_name[len(kind[0]) :] != name[len(kind[1]) :]:
            kind = (cut_name, name)  # another number: no kind of which one could go on
        kinds.setdefault(kind, []).append(f"{cut_name} is {name}")
    said = [
        ", ".join(names) if len(names) <= FEW else f"{', '.join(names[:2])} and so on"
        for names in kinds.values()
    ]
    return f"short names: {', '.join(said)}" if said else ""


def _stem(name: str) -> str:
    return name.rstrip("0123456789")
