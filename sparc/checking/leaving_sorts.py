"""Warns of arithmetic and sums that can leave their sort: TypedProgram → warnings, with `LeavingSorts`.

    #cost = 0..20.     area(X*X) :- side(X).        total(S) :- #sum{C,I : price(I,C)} = S.

What leaves the sort takes the instance of the rule away without a word.  A step along a sort, such as
``I+1`` where I is of that sort, ends with the sort and is meant to.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice, product
from math import prod
from typing import NamedTuple

from sparc.checking.rule_instances import Demands, Impossible, InstanceSearch, value_of
from sparc.checking.typed_program import subterms, variables
from sparc.errors import SparcWarning
from sparc.sorts.extents import Extent, Interval, Sort
from sparc.sorts.values import Value
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    Comparison,
    Guard,
    Head,
    Naf,
    Number,
    Term,
    Variable,
)

__all__ = ["LeavingSorts"]

_BUDGET = 400  # assignments tried for one argument
_WHOLE_BUDGET = 4_000  # for all arguments of a program; what comes behind is taken for good
_MOST_ELEMENTS = 20_000  # listed of a sort to be counted; of one with more nothing is said


class _Amounts(NamedTuple):
    """The number of elements, the greatest number among them, and the sum of those above 0."""

    size: int
    top: int | None
    total: int

    def least(self, other: _Amounts) -> _Amounts:
        """Returns what an element of both sorts can come to at most."""
        size, total = min(self.size, other.size), min(self.total, other.total)
        if self.top is None or other.top is None:
            return _Amounts(size, None, total)
        return _Amounts(size, min(self.top, other.top), total)


def _amounts(extent: Extent) -> _Amounts | None:
    if isinstance(extent, Interval):
        least = max(1, extent.low)
        many = max(0, extent.high - least + 1)
        return _Amounts(extent.bound(), extent.high, (least + extent.high) * many // 2)
    if extent.bound() > _MOST_ELEMENTS:
        return None
    values = list(extent)
    numbers = [value for value in values if type(value) is int]
    return _Amounts(len(values), max(numbers, default=None), sum(n for n in numbers if n > 0))


class LeavingSorts:
    """Looks through the rules of one program."""

    def __init__(self, search: InstanceSearch) -> None:
        self.search = search
        self.typed = search.typed
        self._sizes: dict[int, _Amounts | None] = {}
        self.refill()
        self._candidates: dict[tuple[int, ...], list[Value] | None] = {}

    def refill(self) -> None:
        """Begins with a program anew: ``left`` is how many assignments may still be tried."""
        self.left = _WHOLE_BUDGET

    def warnings(self, head: Head, body: tuple[BodyItem, ...]) -> Iterator[SparcWarning]:
        """Yields arguments of heads that can have a value outside their sort."""
        if isinstance(head, Choice):
            return
        for atom in head:
            if not isinstance(atom, Atom):
                continue
            signature = self.typed.predicates[atom.name]
            for term, sort in zip(atom.arguments, signature.sorts, strict=True):
                if isinstance(term, Arithmetic):
                    yield from self._arithmetic(atom, term, sort, body)
                elif isinstance(term, Variable):
                    yield from self._given(atom, term, sort, body)

    def _given(
        self, atom: Atom, variable: Variable, sort: Sort, body: tuple[BodyItem, ...]
    ) -> Iterator[SparcWarning]:
        """Yields what a variable of the head is set to: ``V = X*X``, ``#sum{…} = V``."""
        for item in body:
            if isinstance(item, Aggregate):
                given = any(_gives(guard, variable) for guard in (item.left, item.right))
                if given and not _elsewhere(variable, body):
                    yield from self._sum(item, sort)
            elif isinstance(item, Comparison) and item.operator in ("=", "=="):
                for one, other in ((item.left, item.right), (item.right, item.left)):
                    if one == variable and isinstance(other, Arithmetic):
                        rest = tuple(each for each in body if each is not item)
                        if not _elsewhere(variable, rest):
                            yield from self._arithmetic(atom, other, sort, rest)

    # -------------------------------------------------------------- arithmetic

    def _arithmetic(
        self, atom: Atom, term: Arithmetic, sort: Sort, body: tuple[BodyItem, ...]
    ) -> Iterator[SparcWarning]:
        names = {part.name for part in subterms(term) if isinstance(part, Variable)}
        if not names or "_" in names or self.left <= 0:
            return
        demands = Demands()
        own = self.typed.predicates[atom.name].sorts
        try:
            for item in body:
                self.search.demand(item, demands)
            for argument, its in zip(atom.arguments, own, strict=True):
                if not isinstance(argument, Arithmetic):
                    self.search.belongs(argument, its, demands, atom.span)
            if _is_a_step(term, sort, demands):
                return
            outside = self._outside(term, sort, names, demands)
        except Impossible:
            return
        if outside is not None:
            values, result = outside
            where = ", ".join(f"{name} = {values[name]}" for name in sorted(values))
            yield SparcWarning(
                f"this can leave #{sort.name}: with {where} it is {result}, and the rule gives"
                " nothing",
                term.span or atom.span,
                f"make #{sort.name} larger, or say in the body what is left out",
            )

    def _outside(
        self, term: Term, sort: Sort, names: set[str], demands: Demands
    ) -> tuple[dict[str, Value], int] | None:
        """Returns values with which the term is a number outside the sort, and the number.

        Only its own variables are tried, by the tests that these decide, the greatest and least first.
        """
        if any(needed & names and not needed <= names for needed, _ in demands.tests):
            return None  # what other variables allow is not looked at
        nat = self.typed.sorts["nat"]
        choices: dict[str, list[Value]] = {}
        for name in sorted(names):
            domains = demands.domains.get(name) or ([nat] if name in self.search.naturals else [])
            candidates = self._ends_first(name, domains) if domains else None
            if candidates is None:
                return None
            choices[name] = candidates
        tests = [run for needed, run in demands.tests if needed <= names]
        for values in islice(_assignments(choices), min(_BUDGET, self.left)):
            self.left -= 1
            result = value_of(term, values, self.search.constants)
            if type(result) is int and result not in sort.extent:
                if all(run(values) for run in tests):
                    return values, result
        return None

    def _ends_first(self, name: str, domains: list[Sort]) -> list[Value] | None:
        """Returns the values of a variable, the last and the first one in front; None for too many."""
        key = tuple(sorted({id(sort.extent) for sort in domains}))
        if key not in self._candidates:
            values = self.search.candidates(name, domains, True)
            if values is not None:
                values = [*values[1::-1], *values[2:]]
            self._candidates[key] = values
        return self._candidates[key]

    # -------------------------------------------------------------- sums

    def _sum(self, aggregate: Aggregate, sort: Sort) -> Iterator[SparcWarning]:
        """Yields a sum, or a number of elements, that is above the sort where each adds what it can."""
        if aggregate.function not in ("sum", "count"):
            return
        counting = aggregate.function == "count"
        target = self._amounts(sort)
        parts = [self._most(element, counting) for element in aggregate.elements]
        if target is None or target.top is None or any(part is None for part in parts):
            return
        whole = sum(part for part in parts if part is not None)
        if whole > target.top:
            what = "this number of elements" if counting else "this sum"
            yield SparcWarning(
                f"{what} can leave #{sort.name}: it can come to {whole}, and the rule gives"
                f" nothing above {target.top}",
                aggregate.span,
                f"make #{sort.name} larger",
            )

    def _most(self, element: AggregateElement, counting: bool) -> int | None:
        """Returns the sum of an element, with one weight for each value of what it stands beside in an atom."""
        known: dict[str, _Amounts] = {}
        if not element.terms or not all(isinstance(item, Atom) for item in element.condition):
            return None  # comparisons and the like make fewer of them
        for item in element.condition:
            assert isinstance(item, Atom)
            signature = self.typed.predicates[item.name]
            for term, sort in zip(item.arguments, signature.sorts, strict=True):
                if isinstance(term, Variable):
                    amounts = self._amounts(sort)
                    if amounts is None:
                        return None
                    known[term.name] = amounts.least(known.get(term.name, amounts))
        weight, *others = element.terms
        counted = element.terms if counting else others
        names = {term.name for term in counted if isinstance(term, Variable)}
        if not names <= known.keys():
            return None
        number = prod(known[name].size for name in names)
        if counting:
            return number
        if isinstance(weight, Number):
            return weight.value * number
        if not isinstance(weight, Variable) or weight.name not in known or weight.name in names:
            return None
        own = known[weight.name]
        if own.top is None:
            return None
        # Where they are independent, each value of the weight adds to each of the others.
        each = own.total if _is_independent(weight.name, names, element) else max(0, own.top)
        return each * number

    def _amounts(self, sort: Sort) -> _Amounts | None:
        """Returns how many elements a sort has and what they add up to; None when they are too many."""
        key = id(sort.extent)
        if key not in self._sizes:
            self._sizes[key] = _amounts(sort.extent)
        return self._sizes[key]


def _is_independent(weight: str, others: set[str], element: AggregateElement) -> bool:
    """Returns whether no atom of an element has the weight and another variable of the tuple."""
    for item in element.condition:
        if isinstance(item, Atom):
            names = {each.name for each in variables(item.arguments)}
            if weight in names and names & others:
                return False
    return True


def _gives(guard: Guard | None, variable: Variable) -> bool:
    return guard is not None and guard.operator in ("=", "==") and guard.bound == variable


def _elsewhere(variable: Variable, body: tuple[BodyItem, ...]) -> bool:
    """Returns whether a literal or a comparison of the body says something of the variable."""
    for item in body:
        if isinstance(item, Aggregate):
            continue
        operand = item.operand if isinstance(item, Naf) else item
        terms: tuple[Term, ...] = (
            (operand.left, operand.right) if isinstance(operand, Comparison) else operand.arguments
        )
        if any(part == variable for term in terms for part in subterms(term)):
            return True
    return False


def _is_a_step(term: Arithmetic, sort: Sort, demands: Demands) -> bool:
    """Returns whether the term is ``X+n`` or ``X-n``, X being of the sort itself."""
    left, right = term.left, term.right
    if term.operator == "+" and isinstance(left, Number):
        left, right = right, left
    return (
        term.operator in ("+", "-")
        and isinstance(left, Variable)
        and not isinstance(right, Arithmetic)
        and (not isinstance(right, Variable))
        and any(
            own is sort or own.extent is sort.extent for own in demands.domains.get(left.name, ())
        )
    )


def _assignments(choices: Mapping[str, list[Value]]) -> Iterator[dict[str, Value]]:
    for values in product(*choices.values()):
        yield dict(zip(choices, values, strict=True))
