"""What a JSON document looks like: its keys, all of them, and what stands under each.

A shape is a type (`object` is anything), a value, a set of values, a list with the shape of its items, a dictionary of
shapes, or an `Either` of several.  A key that ends in ``?`` may be missing, `ANY` stands for keys of
any name.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["ANY", "Either", "differences", "optional"]

ANY = "*"


@dataclass(frozen=True)
class Either:
    """One of several shapes."""

    shapes: tuple[Any, ...]


def optional(shape: Any) -> Either:
    """The shape, or null."""
    return Either((shape, None))


def differences(found: Any, shape: Any, at: str = "$") -> list[str]:
    """Where a document differs from a shape, one sentence each; empty where it does not."""
    match shape:
        case Either(shapes):
            tries = [differences(found, each, at) for each in shapes]
            return [] if [] in tries else min(tries, key=len)
        case type() if shape is object:
            return []
        case type():
            fits = isinstance(found, (int, float) if shape is float else shape)
            fits = fits and isinstance(found, bool) == (shape is bool)
            return [] if fits else [f"{at} is {found!r}, no {shape.__name__}"]
        case set() | frozenset():
            return [] if found in shape else [f"{at} is {found!r}, none of {sorted(shape)}"]
        case [item]:
            if not isinstance(found, list):
                return [f"{at} is {found!r}, no list"]
            return [d for n, one in enumerate(found) for d in differences(one, item, f"{at}[{n}]")]
        case dict():
            if not isinstance(found, dict):
                return [f"{at} is {found!r}, no object"]
            return _of_keys(found, shape, at)
    return [] if found == shape and type(found) is type(shape) else [f"{at} is {found!r}"]


def _of_keys(found: dict[str, Any], shape: dict[str, Any], at: str) -> list[str]:
    named = {key.removesuffix("?"): inner for key, inner in shape.items() if key != ANY}
    out = [
        f"{at} has no {key}"
        for key in shape
        if key != ANY and not key.endswith("?") and key not in found
    ]
    for key, value in found.items():
        if key in named:
            out += differences(value, named[key], f"{at}.{key}")
        elif ANY in shape:
            out += differences(value, shape[ANY], f"{at}.{key}")
        else:
            out.append(f"{at} has a {key}")
    return out
