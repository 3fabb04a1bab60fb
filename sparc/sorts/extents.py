"""The extent of a sort: an `Extent`, an ordered finite set of ground terms.

`sparc.sorts.definitions` makes them from sort expressions; a named extent is a `Sort`.  An extent answers
membership without listing anything, bounds its size by arithmetic, and lists its elements
only on request: a record sort of a hundred thousand million elements costs nothing until then.

>>> numbers = Interval(1, 3)
>>> pairs = Records("f", (Sort("s", numbers), Sort("s", numbers)), None, ())
>>> pairs.bound(), ("f", 1, 3) in pairs, ("f", 1, 4) in pairs
(9, True, False)

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), "Sort definitions".
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import product

from sparc.errors import LimitError
from sparc.sorts.lazy_values import COUNTED, kept, lazy_product, size_product
from sparc.sorts.record_conditions import Test, condition_test, condition_variables
from sparc.sorts.values import Value, as_value, spells_value
from sparc.source import Span
from sparc.syntax.tree import Condition

__all__ = [
    "COUNTED",
    "EVERY",
    "Extent",
    "IdentifierInterval",
    "Interval",
    "Listed",
    "MAX_DEPTH",
    "MAX_LISTED",
    "Records",
    "Sort",
    "Strings",
    "every",
    "listing",
    "require_listable",
]  # fmt: skip

MAX_LISTED = 5_000_000
"""A sort with more elements is not listed: it would fill the memory before clingo starts."""

MAX_DEPTH = 200
"""How deep sorts may be built on one another (membership recurses so deep)."""

EVERY = "#"
"""What is noted where all sorts were looked at, and which there are."""


class Extent:
    """An ordered finite set of ground terms."""

    __slots__ = ("basic", "depth")
    basic: bool  # no record anywhere
    depth: int

    def __contains__(self, value: Value) -> bool:
        raise NotImplementedError

    def __iter__(self) -> Iterator[Value]:
        """Yields the elements, each once, in a fixed order."""
        raise NotImplementedError

    def bound(self) -> int:
        """Returns the number of elements, or an upper bound of it, without listing any."""
        raise NotImplementedError

    def is_empty(self) -> bool:
        """Returns whether there is no element; raises `LimitError` when that takes too long to see."""
        return self.bound() == 0 or not any(True for _ in self)

    def has_number(self) -> bool:
        """Returns whether some element is a number."""
        return any(type(value) is int for value in self)

    def signatures(self) -> set[tuple[str, int]]:
        """Returns name and number of arguments of every record in it, nested ones
        too (or a few more).
        """
        return set()

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        """Returns the `Records` that together are exactly the part of records ``name/arity``.

        None when that part is no union of such.
        """
        return ()


class Interval(Extent):
    """``low..high``."""

    __slots__ = ("high", "low")

    def __init__(self, low: int, high: int) -> None:
        self.low = low
        self.high = high
        self.basic = True
        self.depth = 0

    def __contains__(self, value: Value) -> bool:
        return type(value) is int and self.low <= value <= self.high

    def __iter__(self) -> Iterator[Value]:
        return iter(range(self.low, self.high + 1))

    def bound(self) -> int:
        return max(0, self.high - self.low + 1)

    def has_number(self) -> bool:
        return self.low <= self.high


class IdentifierInterval(Extent):
    """``first..last`` over identifiers of lower-case letters of one length (never ``not``)."""

    __slots__ = ("first", "last")

    def __init__(self, first: str, last: str) -> None:
        self.first = first
        self.last = last
        self.basic = True
        self.depth = 0

    def __contains__(self, value: Value) -> bool:
        return (
            type(value) is str
            and len(value) == len(self.first)
            and self.first <= value <= self.last
            and value.isalpha()
            and value.islower()
            and value != "not"
        )

    def __iter__(self) -> Iterator[Value]:
        word = self.first
        while True:
            if word != "not":
                yield word
            if word == self.last:
                return
            kept = word.rstrip("z")
            word = kept[:-1] + chr(ord(kept[-1]) + 1) + "a" * (len(word) - len(kept))

    def bound(self) -> int:
        return _rank(self.last) - _rank(self.first) + 1

    def has_number(self) -> bool:
        return False


def _rank(word: str) -> int:
    rank = 0
    for letter in word:
        rank = rank * 26 + ord(letter) - 97
    return rank


class Listed(Extent):
    """``{t1,...,tn}``: elements one by one, in the order given."""

    __slots__ = ("_members", "values")

    def __init__(self, values: Iterable[Value]) -> None:
        self.values: tuple[Value, ...] = tuple(dict.fromkeys(values))
        self._members = frozenset(self.values)
        self.basic = not any(type(value) is tuple for value in self.values)
        self.depth = 0

    def __contains__(self, value: Value) -> bool:
        return value in self._members

    def __iter__(self) -> Iterator[Value]:
        return iter(self.values)

    def bound(self) -> int:
        return len(self.values)

    def signatures(self) -> set[tuple[str, int]]:
        signatures: set[tuple[str, int]] = set()
        if self.basic:
            return signatures
        stack = list(self.values)
        while stack:
            value = stack.pop()
            if type(value) is tuple:
                signatures.add((str(value[0]), len(value) - 1))
                stack.extend(value[1:])
        return signatures

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        if self.basic:
            return ()
        for value in self.values:
            if type(value) is tuple and value[0] == name and len(value) == arity + 1:
                return None
        return ()


class Strings(Extent):
    """``[part]...[part]``: the strings put together from one element of each part."""

    __slots__ = ("parts",)

    def __init__(self, parts: tuple[Extent, ...]) -> None:
        self.parts = parts
        self.basic = True
        self.depth = 1 + max(part.depth for part in parts)

    def __contains__(self, value: Value) -> bool:
        if type(value) is tuple:
            return False
        word = str(value)
        ends = {0}
        for part in self.parts:
            ends = {
                end
                for start in ends
                for end in range(start + 1, len(word) + 1)
                if spells_value(word[start:end]) and as_value(word[start:end]) in part
            }
        return len(word) in ends and as_value(word) == value

    def __iter__(self) -> Iterator[Value]:
        words: set[str] = set()
        for pieces in product(*([str(value) for value in part] for part in self.parts)):
            word = "".join(pieces)
            if word not in words:
                words.add(word)
                yield as_value(word)

    def bound(self) -> int:
        return size_product(part.bound() for part in self.parts)

    def has_number(self) -> bool:
        return all(part.has_number() for part in self.parts)


class Records(Extent):
    """``name(s1,...,sn) : condition``; ``places`` gives the argument index of each variable."""

    __slots__ = ("arguments", "condition", "name", "places", "test")

    def __init__(
        self,
        name: str,
        arguments: tuple[Sort, ...],
        condition: Condition | None,
        places: tuple[tuple[str, int], ...],
    ) -> None:
        self.name = name
        self.arguments = arguments
        self.condition = condition
        self.places = dict(places)
        self.test: Test | None = (
            None if condition is None else condition_test(condition, self.places)
        )
        self.basic = False
        self.depth = 1 + max(sort.extent.depth for sort in arguments)

    def __contains__(self, value: Value) -> bool:
        if type(value) is not tuple or value[0] != self.name:
            return False
        given = value[1:]
        if len(given) != len(self.arguments):
            return False
        for sort, part in zip(self.arguments, given, strict=True):
            if part not in sort._extent:
                return False
        return self.test is None or self.test(given)

    def __iter__(self) -> Iterator[Value]:
        name = self.name
        extents = [sort.extent for sort in self.arguments]
        if self.test is None or self.condition is None:
            for given in lazy_product(extents):
                yield (name, *given)
            return
        # The arguments that the condition names come first: they alone decide it.
        named = sorted({self.places[variable] for variable in condition_variables(self.condition)})
        others = [index for index in range(len(extents)) if index not in named]
        chosen_first = [*named, *others]
        order = [chosen_first.index(place) for place in range(len(extents))]
        padding = (0,) * len(others)
        test = self.test

        def holds(chosen: tuple[Value, ...]) -> bool:
            given = (*chosen, *padding)
            return test(tuple([given[place] for place in order]))

        for chosen in kept(lazy_product([extents[index] for index in named]), holds):
            for rest in lazy_product([extents[index] for index in others]):
                given = (*chosen, *rest)
                yield (name, *[given[place] for place in order])

    def bound(self) -> int:
        return size_product(sort.bound() for sort in self.arguments)

    def is_empty(self) -> bool:
        if any(sort.is_empty() for sort in self.arguments):
            return True
        if self.condition is None or self.test is None:
            return False
        return not any(True for _ in self)

    def has_number(self) -> bool:
        return False

    def signatures(self) -> set[tuple[str, int]]:
        found = {(self.name, len(self.arguments))}
        for sort in self.arguments:
            found |= sort.signatures()
        return found

    def boxes(self, name: str, arity: int) -> tuple[Records, ...] | None:
        return (self,) if name == self.name and arity == len(self.arguments) else ()


class Sort:
    """A named extent; ``span`` is the place of its definition (None: built in).

    Records refer to sorts by many paths, so what is worked out about one is remembered.  Whoever
    looks into one leaves its name in ``asked``, which the sorts of a program share.
    """

    __slots__ = ("_bound", "_empty", "_extent", "_signatures", "asked", "name", "span")

    def __init__(
        self, name: str, extent: Extent, span: Span | None = None, asked: set[str] | None = None
    ) -> None:
        self.name = name
        self.span = span
        self.asked: set[str] = set() if asked is None else asked
        self._extent = extent
        self._bound: int | None = None
        self._empty: bool | None = None
        self._signatures: set[tuple[str, int]] | None = None

    @property
    def extent(self) -> Extent:
        """Returns the set of the elements."""
        self.asked.add(self.name)
        return self._extent

    def bound(self) -> int:
        """`Extent.bound`."""
        self.asked.add(self.name)
        if self._bound is None:
            self._bound = self._extent.bound()
        return self._bound

    def is_empty(self) -> bool:
        """`Extent.is_empty`."""
        self.asked.add(self.name)
        if self._empty is None:
            self._empty = self._extent.is_empty()
        return self._empty

    def signatures(self) -> set[tuple[str, int]]:
        """`Extent.signatures`."""
        self.asked.add(self.name)
        if self._signatures is None:
            self._signatures = self._extent.signatures()
        return self._signatures

    def __repr__(self) -> str:
        return f"Sort(#{self.name})"


def every(sorts: Mapping[str, Sort]) -> Collection[Sort]:
    """Returns all sorts of a program, and notes that they were looked at."""
    for sort in sorts.values():
        sort.asked.add(EVERY)
        break  # they share what is noted
    return sorts.values()


def listing(sort: Extent, name: str, span: Span | None) -> Iterator[Value]:
    """Yields the elements of a sort that must be listed.

    Raises `LimitError` when they are too many.
    """
    require_listable(sort, name, span)
    return iter(sort)


def require_listable(sort: Extent, name: str, span: Span | None) -> None:
    """Raises `LimitError` when a sort has more elements than can be listed."""
    size = sort.bound()
    if size > MAX_LISTED:
        parts: tuple[Extent, ...] = (sort,)
        if isinstance(sort, Records) and sort.condition is None:
            parts = tuple(part.extent for part in sort.arguments)
        exact = size < COUNTED and all(isinstance(part, Interval | Listed) for part in parts)
        shown = f"{size:,}" if exact else f"up to {size:,}" if size < COUNTED else "countless"
        raise LimitError(
            f"sort #{name} has {shown} elements and a rule needs them listed;"
            f" at most {MAX_LISTED:,} can be",
            span,
            "use smaller argument sorts, or bind the variable by an atom of the body",
        )
