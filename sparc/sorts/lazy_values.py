"""Elements of sorts one at a time: products, and searches that are given up. Entry points `lazy_product`, `kept`.

>>> list(lazy_product([]))
[()]
>>> size_product([3, 10**18])
1000000000000000000
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Protocol, TypeVar

from sparc.errors import LimitError
from sparc.sorts.values import Value

__all__ = ["COUNTED", "Sized", "kept", "lazy_product", "limited", "size_product"]

COUNTED = 10**18
"""Sizes are counted up to here; more is as good as infinite."""

_SEARCHED = 300_000  # candidates looked at in a row before a search is given up
_HELD = 100_000  # combinations of the later factors that are kept in memory

Item = TypeVar("Item")


class Sized(Protocol):
    """A factor of a product: values in a fixed order, and a bound of how many they are."""

    def __iter__(self) -> Iterator[Value]: ...

    def bound(self) -> int:
        """Returns the number of values, or more."""
        ...


def size_product(sizes: Iterable[int]) -> int:
    """Returns the product of some sizes, at most `COUNTED`."""
    result = 1
    for size in sizes:
        result = min(COUNTED, result * size)
    return result


def lazy_product(extents: Sequence[Sized]) -> Iterator[tuple[Value, ...]]:
    """Yields the cartesian product without holding any of the factors in memory."""
    if not extents:
        yield ()
        return
    if len(extents) == 1:
        for value in extents[0]:
            yield (value,)
        return
    rest = extents[1:]
    if size_product(extent.bound() for extent in rest) < _HELD:
        tails = list(lazy_product(rest))
        for value in extents[0]:
            for tail in tails:
                yield (value, *tail)
        return
    for value in extents[0]:
        for tail in lazy_product(rest):
            yield (value, *tail)


def kept(values: Iterator[Item], keep: Callable[[Item], bool]) -> Iterator[Item]:
    """Yields the values that pass; raises `LimitError` when too many in a row do not."""
    rejected = 0
    for value in values:
        if keep(value):
            rejected = 0
            yield value
        else:
            rejected += 1
            if rejected > _SEARCHED:
                raise LimitError(
                    f"of {_SEARCHED:,} candidates in a row none belongs to this sort,"
                    " and the rest was not searched"
                )


def limited(values: Iterator[Item]) -> Iterator[Item]:
    """Yields the values up to a limit; raises `LimitError` behind it."""
    for count, value in enumerate(values):
        if count >= _SEARCHED:
            raise LimitError(f"this sort has more than {_SEARCHED:,} elements to look through")
        yield value
