"""Warns of arithmetic and sums that can leave their sort: TypedProgram → warnings, with `leaving_sorts`.

    #cost = 0..20.     area(X*X) :- side(X).        total(S) :- #sum{C,I : price(I,C)} = S.

What leaves the sort takes the instance of the rule away without a word.  A step along a sort, such as
``I+1`` where I is of that sort, ends with the sort and is meant to.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from math import prod

from sparc.checking.number_ranges import Ranges
from sparc.checking.rule_instances import Demands, Impossible, InstanceSearch, value_of
from sparc.checking.typed_program import TypedProgram, subterms
from sparc.errors import SparcWarning
from sparc.sorts.extents import Sort
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
    Statement,
    Term,
    Variable,
)

__all__ = ["leaving_sorts"]

_BUDGET = 2_000  # assignments tried for one argument


def leaving_sorts(
    typed: TypedProgram,
    search: InstanceSearch,
    statement: Statement,
    head: Head,
    body: tuple[BodyItem, ...],
) -> Iterator[SparcWarning]:
    """Yields arguments of heads that can have a value outside their sort."""
    if isinstance(head, Choice) or not head:
        return
    for atom in head:
        if not isinstance(atom, Atom):
            continue
        for term, sort in zip(atom.arguments, typed.predicates[atom.name].sorts, strict=True):
            if isinstance(term, Arithmetic):
                yield from _arithmetic(search, atom, term, sort, body)
            elif isinstance(term, Variable):
                yield from _given(typed, search, atom, term, sort, body)


def _given(
    typed: TypedProgram,
    search: InstanceSearch,
    atom: Atom,
    variable: Variable,
    sort: Sort,
    body: tuple[BodyItem, ...],
) -> Iterator[SparcWarning]:
    """Yields what a variable of the head is set to: ``V = X*X``, ``#sum{…} = V``."""
    for item in body:
        if isinstance(item, Aggregate):
            guards = (item.left, item.right)
            if any(_gives(guard, variable) for guard in guards) and not _elsewhere(variable, body):
                yield from _sum(typed, item, sort)
        elif isinstance(item, Comparison) and item.operator in ("=", "=="):
            for one, other in ((item.left, item.right), (item.right, item.left)):
                if one == variable and isinstance(other, Arithmetic):
                    rest = tuple(each for each in body if each is not item)
                    if not _elsewhere(variable, rest):
                        yield from _arithmetic(search, atom, other, sort, rest)


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


# ------------------------------------------------------------------ arithmetic


def _arithmetic(
    search: InstanceSearch, atom: Atom, term: Arithmetic, sort: Sort, body: tuple[BodyItem, ...]
) -> Iterator[SparcWarning]:
    names = {part.name for part in subterms(term) if isinstance(part, Variable)}
    if not names or "_" in names:
        return
    demands = Demands()
    try:
        for item in body:
            search.demand(item, demands)
        for argument, own in zip(
            atom.arguments, search.typed.predicates[atom.name].sorts, strict=True
        ):
            if not isinstance(argument, Arithmetic):
                search.belongs(argument, own, demands, atom.span)
        if _is_a_step(term, sort, demands):
            return
        found = _outside(search, term, sort, names, demands)
    except Impossible:
        return
    if found is not None:
        values, result = found
        where = ", ".join(f"{name} = {values[name]}" for name in sorted(values))
        yield SparcWarning(
            f"this can leave #{sort.name}: with {where} it is {result}, and the rule gives nothing",
            term.span or atom.span,
            f"make #{sort.name} larger, or say in the body what is left out",
        )


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
        and any(own.extent is sort.extent for own in demands.domains.get(left.name, ()))
    )


def _outside(
    search: InstanceSearch, term: Term, sort: Sort, names: set[str], demands: Demands
) -> tuple[dict[str, Value], int] | None:
    """Returns values with which the term is a number outside the sort, and the number.

    Only its own variables are tried, by the tests that these decide, the greatest and least first.
    """
    if any(needed & names and not needed <= names for needed, _ in demands.tests):
        return None  # what other variables allow is not looked at
    nat = search.typed.sorts["nat"]
    choices: dict[str, list[Value]] = {}
    for name in sorted(names):
        domains = demands.domains.get(name) or ([nat] if name in search.naturals else [])
        candidates = search.candidates(name, domains, True) if domains else None
        if candidates is None:
            return None
        choices[name] = _ends_first(candidates)
    tests = [run for needed, run in demands.tests if needed <= names]
    for values in islice(_assignments(choices), _BUDGET):
        result = value_of(term, values, search.constants)
        if type(result) is int and result not in sort.extent and all(run(values) for run in tests):
            return values, result
    return None


def _ends_first(candidates: list[Value]) -> list[Value]:
    return list(dict.fromkeys([*candidates[-1:], *candidates[:1], *candidates]))


def _assignments(choices: Mapping[str, list[Value]]) -> Iterator[dict[str, Value]]:
    names = list(choices)

    def extend(values: dict[str, Value], depth: int) -> Iterator[dict[str, Value]]:
        if depth == len(names):
            yield dict(values)
            return
        for value in choices[names[depth]]:
            yield from extend({**values, names[depth]: value}, depth + 1)

    return extend({}, 0)


# ------------------------------------------------------------------ sums


def _sum(typed: TypedProgram, aggregate: Aggregate, sort: Sort) -> Iterator[SparcWarning]:
    """Yields a sum, or a number of elements, that is above the sort where each adds what it can."""
    if aggregate.function not in ("sum", "count"):
        return
    counting = aggregate.function == "count"
    ranges = Ranges(())
    limit = ranges.of(sort.extent)
    parts = [_most(typed, element, counting, ranges) for element in aggregate.elements]
    if limit is None or any(part is None for part in parts):
        return
    whole = sum(part for part in parts if part is not None)
    if whole > limit[1]:
        what = "this number of elements" if counting else "this sum"
        yield SparcWarning(
            f"{what} can leave #{sort.name}: it can come to {whole}, and the rule gives nothing"
            f" above {limit[1]}",
            aggregate.span,
            f"make #{sort.name} larger",
        )


def _most(
    typed: TypedProgram, element: AggregateElement, counting: bool, ranges: Ranges
) -> int | None:
    """Returns the sum of an element with one weight for each value of its other variables."""
    sizes: dict[str, int] = {}
    tops: dict[str, int] = {}
    for item in element.condition:
        if not isinstance(item, Atom):
            continue
        for term, sort in zip(item.arguments, typed.predicates[item.name].sorts, strict=True):
            if isinstance(term, Variable) and sort.extent.bound() < 10**6:
                size = sort.extent.bound()
                sizes[term.name] = min(size, sizes.get(term.name, size))
                numbers = ranges.of(sort.extent)
                if numbers is not None:
                    tops[term.name] = min(numbers[1], tops.get(term.name, numbers[1]))
    if not element.terms:
        return None
    weight, *others = element.terms
    names = {
        term.name
        for term in (others if not counting else element.terms)
        if isinstance(term, Variable)
    }
    if not names <= sizes.keys() or any(not isinstance(item, Atom) for item in element.condition):
        return None  # comparisons and the like make fewer of them
    if counting:
        return prod(sizes[name] for name in names)
    if isinstance(weight, Number):
        return weight.value * prod(sizes[name] for name in names)
    if not isinstance(weight, Variable) or weight.name not in tops or weight.name in names:
        return None
    return max(0, tops[weight.name]) * prod(sizes[name] for name in names)
