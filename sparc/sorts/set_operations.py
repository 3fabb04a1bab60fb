"""Sorts made of sorts: union, difference and intersection, and a test for subsets.

>>> from sparc.sorts.extents import Interval, Listed
>>> list(Difference(Interval(1, 4), Listed([2])))
[1, 3, 4]
>>> is_subset(Interval(2, 3), Union((Interval(0, 2), Interval(0, 5))))
True
"""

from __future__ import annotations

from collections.abc import Iterator

from sparc.sorts.extents import Extent, Interval, Listed, Records
from sparc.sorts.lazy_values import COUNTED, kept, limited
from sparc.sorts.values import Value

__all__ = ["Difference", "Intersection", "Union", "is_subset"]

_COMPARED = 5_000  # elements compared one by one to prove that one sort is part of another


class Union(Extent):
    """``p1 + ... + pn``."""

    __slots__ = ("parts",)

    def __init__(self, parts: tuple[Extent, ...]) -> None:
        self.parts = parts
        self.basic = all(part.basic for part in parts)
        self.depth = 1 + max(part.depth for part in parts)

    def __contains__(self, value: Value) -> bool:
        for part in self.parts:  # noqa: SIM110 (the hot path of the type check)
            if value in part:
                return True
        return False

    def __iter__(self) -> Iterator[Value]:
        for index, part in enumerate(self.parts):
            earlier = self.parts[:index]
            for value in part:
                if not any(value in other for other in earlier):
                    yield value

    def bound(self) -> int:
        return min(COUNTED, sum(part.bound() for part in self.parts))

    def is_empty(self) -> bool:
        return all(part.is_empty() for part in self.parts)

    def has_number(self) -> bool:
        return any(part.has_number() for part in self.parts)

    def signatures(self) -> set[tuple[str, int]]:
        return set().union(*(part.signatures() for part in self.parts))

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        records: dict[Records, None] = {}
        for part in self.parts:
            boxes = part.boxes(name, arity)
            if boxes is None:
                return None
            records.update(dict.fromkeys(boxes))
        return tuple(records)


class Difference(Extent):
    """``left - right``."""

    __slots__ = ("left", "right")

    def __init__(self, left: Extent, right: Extent) -> None:
        self.left = left
        self.right = right
        self.basic = left.basic and right.basic
        self.depth = 1 + max(left.depth, right.depth)

    def __contains__(self, value: Value) -> bool:
        return value in self.left and value not in self.right

    def __iter__(self) -> Iterator[Value]:
        right = self.right
        return kept(iter(self.left), lambda value: value not in right)

    def bound(self) -> int:
        return self.left.bound()

    def is_empty(self) -> bool:
        if is_subset(self.left, self.right):
            return True
        # Of these kinds the bound is exact: what has more elements is not taken away whole.
        if isinstance(self.left, Interval | Listed) and self.left.bound() > self.right.bound():
            return False
        return not any(True for _ in self)

    def has_number(self) -> bool:
        if not self.left.has_number():
            return False
        return any(type(value) is int for value in limited(iter(self)))

    def signatures(self) -> set[tuple[str, int]]:
        return self.left.signatures()

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        left = self.left.boxes(name, arity)
        if left == () or self.right.boxes(name, arity) == ():
            return left
        return None


class Intersection(Extent):
    """``left * right``."""

    __slots__ = ("left", "right")

    def __init__(self, left: Extent, right: Extent) -> None:
        self.left = left
        self.right = right
        self.basic = left.basic and right.basic
        self.depth = 1 + max(left.depth, right.depth)

    def __contains__(self, value: Value) -> bool:
        return value in self.left and value in self.right

    def __iter__(self) -> Iterator[Value]:
        small, large = self._by_size()
        return kept(iter(small), lambda value: value in large)

    def _by_size(self) -> tuple[Extent, Extent]:
        if self.right.bound() < self.left.bound():
            return self.right, self.left
        return self.left, self.right

    def bound(self) -> int:
        return min(self.left.bound(), self.right.bound())

    def is_empty(self) -> bool:
        if is_subset(self.left, self.right):
            return self.left.is_empty()
        if is_subset(self.right, self.left):
            return self.right.is_empty()
        if not self.left.basic and not self.right.basic:
            shared = self.left.signatures() & self.right.signatures()
            if not shared and (isinstance(self.left, Records) or isinstance(self.right, Records)):
                return True
        return not any(True for _ in self)

    def has_number(self) -> bool:
        if not (self.left.has_number() and self.right.has_number()):
            return False
        return any(type(value) is int for value in limited(iter(self)))

    def signatures(self) -> set[tuple[str, int]]:
        return self.left.signatures() & self.right.signatures()

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        if self.left.boxes(name, arity) == () or self.right.boxes(name, arity) == ():
            return ()
        return None


def is_subset(
    small: Extent, large: Extent, known: dict[tuple[int, int], bool] | None = None
) -> bool:
    """Returns true when every element of ``small`` is provably in ``large``.

    False: unknown or not so.

    ``known`` has the answers found on the way, by the identities of the extents.
    """
    if small is large:
        return True
    known = {} if known is None else known
    key = (id(small), id(large))
    answer = known.get(key)
    if answer is None:
        answer = known[key] = _is_subset(small, large, known)
    return answer


def _is_subset(small: Extent, large: Extent, known: dict[tuple[int, int], bool]) -> bool:
    if isinstance(small, Interval):
        if isinstance(large, Interval):
            return large.low <= small.low and small.high <= large.high
        if isinstance(large, Records):
            return False
        if small.bound() <= _COMPARED:
            return all(value in large for value in small)
    if isinstance(small, Listed):
        return len(small.values) <= _COMPARED and all(value in large for value in small.values)
    if isinstance(large, Union) and any(is_subset(small, part, known) for part in large.parts):
        return True
    if isinstance(small, Union):
        return all(is_subset(part, large, known) for part in small.parts)
    if isinstance(small, Records):
        return (
            isinstance(large, Records)
            and large.name == small.name
            and len(large.arguments) == len(small.arguments)
            and large.condition is None
            and all(
                is_subset(left.extent, right.extent, known)
                for left, right in zip(small.arguments, large.arguments, strict=True)
            )
        )
    if isinstance(small, Difference):
        return is_subset(small.left, large, known)
    if isinstance(small, Intersection):
        return is_subset(small.left, large, known) or is_subset(small.right, large, known)
    return False
