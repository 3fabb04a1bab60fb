"""The sorts in clingo's words: an `Extent` that a guard needs → facts and rules that list it.

A range is one fact ``__s(1..9).``, a set a pool ``__s((a;b)).``, a record sort a rule
``__s(f(A,B)):-__a(A),__b(B).``, and so on: clingo does the listing.  Only sorts that some guard
names are written, and one that is too large to be listed is refused here.
"""

from __future__ import annotations

from sparc.checking.typed_program import TypedProgram
from sparc.sorts.extents import (
    Extent,
    IdentifierInterval,
    Interval,
    Listed,
    Records,
    Sort,
    Strings,
    listing,
    require_listable,
)
from sparc.sorts.set_operations import Difference, Intersection, Union
from sparc.sorts.values import Value, text
from sparc.source import Span
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import And, Condition, ConditionTest, Not

__all__ = ["SortFacts", "conjunction", "interval"]

_NEGATED = {"=": "!=", "!=": "=", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_LISTED_HERE = 20_000  # smaller differences and intersections are worked out before clingo starts
_MOST_RULES = 8  # a record's condition with more alternatives is worked out here, too

Tests = list[tuple[int, str, int]]


def interval(low: int, high: int) -> str:
    """Returns the numbers from ``low`` to ``high`` as an argument in clingo's language.

    clingo never ends to count where ``high`` is the greatest number that it has.

    >>> interval(1, 3), interval(2147483645, 2147483647)
    ('1..3', '2147483645..2147483646;2147483647')
    """
    if high < MAX_NUMBER:
        return f"{low}..{high}"
    return f"{low}..{high - 1};{high}"


class SortFacts:
    """Names for the sorts that guards need, and the text that defines them."""

    def __init__(self, typed: TypedProgram) -> None:
        self._owners: dict[int, Sort] = {}
        for sort in typed.sorts.values():
            self._owners.setdefault(id(sort.extent), sort)
        self._pending: list[tuple[Extent, str]] = []
        self._names: dict[int, str] = {}
        self._aliases: dict[str, str] = {}
        self._auxiliary = 0
        self._kept: list[Extent] = []  # extents whose identity is in use stay alive

    def key(self, extent: Extent) -> str:
        """Returns the predicate that lists ``extent``; from now on it will be defined."""
        name = self._names.get(id(extent))
        if name is None:
            owner = self._owners.get(id(extent))
            if owner is None:
                self._auxiliary += 1
                name = f"___{self._auxiliary}"
            else:
                name = f"__{owner.name}"
            self._names[id(extent)] = name
            self._pending.append((extent, name))
            self._kept.append(extent)
        return name

    def named_key(self, sort: Sort) -> str:
        """Returns the predicate that lists ``sort`` under its own name, though it may be an alias."""
        name = self.key(sort.extent)
        own = f"__{sort.name}"
        if name != own:
            self._aliases[own] = name
        return own

    def definitions(self) -> list[str]:
        """Returns the lines that define every sort asked for."""
        lines: list[str] = []
        while self._pending:
            extent, name = self._pending.pop()
            self._define(extent, name, extent, lines)
        lines += [f"{own}(X):-{name}(X)." for own, name in self._aliases.items()]
        return lines

    def _define(self, extent: Extent, name: str, whole: Extent, lines: list[str]) -> None:
        """Adds the lines that make ``name`` hold for the elements of ``extent``."""
        if isinstance(extent, Interval):
            require_listable(extent, *self._owner(whole))
            lines.append(f"{name}({interval(extent.low, extent.high)}).")
        elif isinstance(extent, Records):
            self._define_records(extent, name, whole, lines)
        elif isinstance(extent, Union):
            for part in extent.parts:
                if id(part) in self._names:
                    lines.append(f"{name}(X):-{self.key(part)}(X).")
                else:
                    self._define(part, name, whole, lines)
        elif isinstance(extent, Difference | Intersection):
            if extent.bound() <= _LISTED_HERE:
                self._list(extent, name, whole, lines)
                return
            left, right = self.key(extent.left), self.key(extent.right)
            negation = "not " if isinstance(extent, Difference) else ""
            lines.append(f"{name}(X):-{left}(X),{negation}{right}(X).")
        else:
            assert isinstance(extent, Listed | Strings | IdentifierInterval)
            self._list(extent, name, whole, lines)

    def _define_records(self, extent: Records, name: str, whole: Extent, lines: list[str]) -> None:
        owner, span = self._owner(whole)
        listing(extent, owner, span)  # refuses what is too large
        alternatives = [[]] if extent.condition is None else _alternatives(extent)
        if alternatives is None:
            self._list(extent, name, whole, lines)
            return
        variables = [f"X{number}" for number in range(1, len(extent.arguments) + 1)]
        body = ",".join(
            f"{self.key(sort.extent)}({variable})"
            for sort, variable in zip(extent.arguments, variables, strict=True)
        )
        head = f"{name}({extent.name}({','.join(variables)}))"
        for tests in alternatives:
            shown = "".join(f",{variables[a]}{operator}{variables[b]}" for a, operator, b in tests)
            lines.append(f"{head}:-{body}{shown}.")

    def _list(self, extent: Extent, name: str, whole: Extent, lines: list[str]) -> None:
        values = list(map(text, listing(extent, *self._owner(whole))))
        if not values:  # a part of a sort may be empty
            return
        if len(values) == 1:
            lines.append(f"{name}({values[0]}).")
        elif len(values) <= 500:
            lines.append(f"{name}({';'.join(values)}).")
        else:
            lines.append("".join([f"{name}({value})." for value in values]))

    def _owner(self, extent: Extent) -> tuple[str, Span | None]:
        owner = self._owners.get(id(extent))
        return (owner.name, owner.span) if owner else ("(unnamed)", None)


def conjunction(box: Records) -> Tests | None:
    """Returns the condition of a record sort as comparisons that clingo decides
    alike, joined by ``and``.

    None when it is no such conjunction.
    """
    if box.condition is None:
        return []
    alternatives = _alternatives(box)
    return alternatives[0] if alternatives is not None and len(alternatives) == 1 else None


def _alternatives(box: Records) -> list[Tests] | None:
    """Returns the condition in disjunctive normal form; None when clingo would decide it otherwise."""
    assert box.condition is not None
    return _normal_form(box.condition, False, box)


def _normal_form(condition: Condition, negated: bool, box: Records) -> list[Tests] | None:
    if isinstance(condition, Not):
        return _normal_form(condition.operand, not negated, box)
    if isinstance(condition, ConditionTest):
        left, right = box.places[condition.left.name], box.places[condition.right.name]
        if condition.operator not in ("=", "!="):
            kinds = {_kind(box.arguments[index].extent) for index in (left, right)}
            if len(kinds) > 1 or None in kinds:
                return None
        operator = _NEGATED[condition.operator] if negated else condition.operator
        return [[(left, operator, right)]]
    parts = [_normal_form(operand, negated, box) for operand in condition.operands]
    result: list[Tests] = []
    if isinstance(condition, And) == negated:
        for part in parts:
            if part is None:
                return None
            result += part
        return result if len(result) <= _MOST_RULES else None
    result = [[]]
    for part in parts:
        if part is None:
            return None
        result = [[*tests, *more] for tests in result for more in part]
        if len(result) > _MOST_RULES:
            return None
    return result


def _kind(extent: Extent) -> type[Value] | None:
    """`int` or `str` when all elements are of this kind, None when not or when unknown."""
    if isinstance(extent, Interval):
        return int
    if isinstance(extent, IdentifierInterval):
        return str
    kinds: set[type[Value] | None] = set()
    if isinstance(extent, Listed):
        kinds = {type(value) for value in extent.values}
    elif isinstance(extent, Union):
        kinds = {_kind(part) for part in extent.parts}
    elif isinstance(extent, Difference | Intersection):
        kinds = {_kind(extent.left)}
    elif isinstance(extent, Strings):
        first = _kind(extent.parts[0])
        kinds = {first}
        if first is int:
            kinds |= {_kind(part) for part in extent.parts[1:]}
    if len(kinds) != 1:
        return None
    (kind,) = kinds
    return kind if kind in (int, str) else None
