"""The keys of a shape of `tests.support.shapes`, as the page about documents names them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from tests.support.shapes import ANY, Either

__all__ = ["key_paths"]


def key_paths(shape: Any, known: Sequence[Any] = (), at: str = "") -> Iterator[str]:
    """Every key of a shape: ``a``, ``a.b`` inside of ``a``, ``a[].b`` in a list.

    What a ``known`` shape has is left out, since that has a section of its own; a dictionary may
    have more keys than it.
    """
    if any(shape is each for each in known):
        return
    match shape:
        case Either(shapes):
            for each in shapes:
                yield from key_paths(each, known, at)
        case [item]:
            yield from key_paths(item, known, f"{at}[]")
        case dict():
            for part in known:
                if isinstance(part, dict) and all(shape.get(k) is v for k, v in part.items()):
                    shape = {k: v for k, v in shape.items() if k not in part}
            for key, inner in shape.items():
                if key != ANY:
                    name = f"{at}.{key.removesuffix('?')}".removeprefix(".")
                    yield name
                    yield from key_paths(inner, known, name)
