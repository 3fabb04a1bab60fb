"""Sorts that are too small for a cause: an instance is lost, and with a larger sort there is an answer set.

Entry point `small_sorts`.  A sort is tried where elements can be missing in it: numbers that
arithmetic leads to, elements of another sort that a rule carries over, and new elements where a choice or a
disjunction ranges over the whole sort.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

from sparc.answer_sets import GroundLiteral
from sparc.checking.checker import check
from sparc.checking.typed_program import TypedProgram, has_arithmetic
from sparc.errors import LimitError, SourceErrors
from sparc.explaining.remarks import value_of
from sparc.explaining.subsets import SubsetOracle
from sparc.explaining.switches import ON, switched
from sparc.lazy_dataclass import dataclass
from sparc.sorts.extents import Extent, Interval
from sparc.sorts.values import Value, text
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.printer import print_term
from sparc.syntax.tree import (
    Aggregate,
    Atom,
    BodyItem,
    Choice,
    Comparison,
    Concatenation,
    CrRule,
    Identifier,
    IdentifierRange,
    Number,
    NumericRange,
    Record,
    Rule,
    SetExpression,
    SortExpression,
    Term,
    TermSet,
    Variable,
)

__all__ = ["SmallSort", "small_sorts"]

_CONFLICTS = 20_000  # of a search for an answer set with a larger sort
_MOST_ELEMENTS = 1000  # of a sort that is listed to see what is missing
_MOST_MISSING = 50  # elements of other sorts that are added at a time
_MOST_TRIED = 10  # new elements that are tried one by one, and some at a time
_LONGEST = 200  # characters of a definition that is shown


@dataclass(frozen=True)
class SmallSort:
    """A sort that lacks elements: the index of its definition, and literals that would hold.

    ``larger`` is a definition that would do for the cause, empty where it is too long to be read.
    """

    index: int
    literals: tuple[str, ...]
    larger: str


def small_sorts(
    typed: TypedProgram, causes: Sequence[frozenset[int]], deadline: float | None
) -> list[list[SmallSort]]:
    """For each cause the sorts that are too small for it.

    With a larger sort the statements of the cause have an answer set, together with all that is in
    no other cause.
    """
    return _Widener(typed, causes, deadline).run()


class _Widener:
    def __init__(
        self, typed: TypedProgram, causes: Sequence[frozenset[int]], deadline: float | None
    ) -> None:
        self.typed = typed
        self.causes = causes
        self.deadline = deadline

    def run(self) -> list[list[SmallSort]]:
        """Returns, for each cause, the sorts that are too small for it."""
        found: list[list[SmallSort]] = [[] for _ in self.causes]
        for index in range(len(self.typed.program.sorts)):
            open_ = list(range(len(self.causes)))
            for wider in _wider(self.typed, index):
                oracle = self.oracle(index, wider) if open_ else None
                if oracle is None:
                    break
                for at in list(open_):
                    literals = self.literals(oracle, at)
                    if literals:
                        found[at].append(self.least(index, wider, at, literals))
                        open_.remove(at)
        return found

    def oracle(self, index: int, wider: SortExpression) -> SubsetOracle | None:
        """Returns the program, with switches, of a larger sort; None where it is faulty, or too large."""
        sorts = list(self.typed.program.sorts)
        sorts[index] = replace(sorts[index], expression=wider)
        try:
            larger = switched(check(replace(self.typed.program, sorts=tuple(sorts))))
            return SubsetOracle(larger.text(), ON, deadline=self.deadline)
        except (SourceErrors, LimitError):
            return None

    def literals(self, oracle: SubsetOracle, at: int) -> tuple[str, ...]:
        """Returns what would hold with the larger sort; nothing where the cause remains."""
        others = frozenset().union(*self.causes) - self.causes[at]
        on = [key for key in oracle.switches if key[0] not in others]
        consistent = oracle.has_answer_set(on, _CONFLICTS)
        return _outside(self.typed, oracle.last_symbols) if consistent else ()

    def least(
        self, index: int, wider: SortExpression, at: int, literals: tuple[str, ...]
    ) -> SmallSort:
        """Returns the sort with as few new elements as will do for the cause, of those that are tried."""
        definition = self.typed.program.sorts[index]
        extent = self.typed.sorts[definition.name].extent
        for smaller in _smaller(wider, extent):
            oracle = self.oracle(index, smaller)
            held = () if oracle is None else self.literals(oracle, at)
            if held:
                wider, literals = smaller, held
                break
        if isinstance(wider, NumericRange):
            low, high = print_term(wider.low), print_term(wider.high)
            return SmallSort(index, literals, f"#{definition.name} = {low}..{high}.")
        elements = [*map(text, extent), *map(print_term, _added(wider))]
        whole = f"#{definition.name} = {{{', '.join(elements)}}}."
        return SmallSort(index, literals, whole if len(whole) <= _LONGEST else "")


def _smaller(wider: SortExpression, extent: Extent) -> Iterator[SortExpression]:
    """Yields sorts between ``extent`` and ``wider``, those of fewest new elements first."""
    if isinstance(wider, NumericRange) and isinstance(extent, Interval):
        for more in _steps(extent):
            if isinstance(wider.high, Number) and extent.high + more <= wider.high.value:
                yield NumericRange(Number(extent.low), Number(extent.high + more))
    elif isinstance(wider, SetExpression):
        terms = _added(wider)
        for term in terms[:_MOST_TRIED]:
            yield replace(wider, right=TermSet((term,)))
        for number in range(2, min(len(terms), _MOST_TRIED)):
            yield replace(wider, right=TermSet(terms[:number]))


def _added(wider: SortExpression) -> tuple[Term, ...]:
    assert isinstance(wider, SetExpression) and isinstance(wider.right, TermSet)
    return wider.right.terms


# ------------------------------------------------------------------ what may be missing


def _wider(typed: TypedProgram, index: int) -> Iterator[SortExpression]:
    """Yields larger sorts that are worth a try, the smallest first."""
    definition = typed.program.sorts[index]
    expression, extent = definition.expression, typed.sorts[definition.name].extent
    if isinstance(expression, NumericRange) and isinstance(extent, Interval):
        steps = _steps(extent) if _calculates(typed, extent) else ()
        if not steps and _is_set_equal(typed, extent):
            steps = _steps(extent)[-1:]  # a single try: what comes out is seldom outside
        for more in steps:
            low, high = max(0, extent.low - more), min(extent.high + more, MAX_NUMBER)
            if (low, high) != (extent.low, extent.high):
                yield NumericRange(Number(low), Number(high))
        if steps:
            return
    elif not isinstance(expression, TermSet | IdentifierRange | Concatenation):
        return
    if extent.bound() > _MOST_ELEMENTS:
        return
    missing = list(islice(dict.fromkeys(_carried(typed, extent)), _MOST_MISSING))
    numbers = [value for value in extent if isinstance(value, int)]
    if numbers and _calculates(typed, extent):
        low, high, size = min(numbers), max(numbers), len(numbers)
        around = range(max(0, low - size), high + size + 1)
        beyond = sorted(around, key=lambda number: (number < low, number))
        missing += [n for n in beyond if n not in extent and n not in missing]
    if _ranges_over(typed, extent):
        missing.append(_new_element(typed, definition.name, extent))
    missing = [value for value in missing if not isinstance(value, int) or value <= MAX_NUMBER]
    if missing:
        yield SetExpression("+", expression, TermSet(tuple(map(_term, missing))))


def _steps(extent: Interval) -> tuple[int, ...]:
    """Returns by how many numbers a range is made longer, one try after the other."""
    size = extent.high - extent.low + 1
    return tuple(dict.fromkeys((1, size, 3 * size)))


def _rules(typed: TypedProgram) -> Iterator[Rule | CrRule]:
    return (each for each in typed.program.statements if isinstance(each, Rule | CrRule))


def _head_atoms(rule: Rule | CrRule) -> list[Atom]:
    head = rule.head
    atoms = [each.atom for each in head.elements] if isinstance(head, Choice) else list(head)
    return [atom for atom in atoms if isinstance(atom, Atom)]


def _calculates(typed: TypedProgram, extent: Extent) -> bool:
    """Returns whether some head or body has arithmetic where a number of the sort must stand."""
    for rule in _rules(typed):
        atoms = [getattr(item, "operand", item) for item in rule.body]
        if any(
            _leaves(typed, atom, extent)
            for atom in (*_head_atoms(rule), *atoms)
            if isinstance(atom, Atom)
        ):
            return True
    return False


def _is_set_equal(typed: TypedProgram, extent: Extent) -> bool:
    """Returns whether some head gives the sort a variable that is calculated."""
    for rule in _rules(typed):
        given = _calculated(rule.body)
        places = _places(typed, _head_atoms(rule)) if given else ()
        if any(each is extent and name in given for name, each in places):
            return True
    return False


def _calculated(body: Iterable[BodyItem]) -> set[str]:
    """Returns the variables that an aggregate or a sum is set equal to: ``#sum{…} = S``, ``S = X*2``."""
    found: set[str] = set()
    for item in body:
        sides: tuple[Term, ...] = ()
        if isinstance(item, Aggregate):
            guards = [each for each in (item.left, item.right) if each is not None]
            sides = tuple(guard.bound for guard in guards if guard.operator in ("=", "=="))
        elif isinstance(item, Comparison) and item.operator in ("=", "=="):
            sides = (
                (item.left, item.right) if any(map(has_arithmetic, (item.left, item.right))) else ()
            )
        found.update(side.name for side in sides if isinstance(side, Variable))
    return found


def _leaves(typed: TypedProgram, atom: Atom, extent: Extent) -> bool:
    sorts = typed.predicates[atom.name].sorts
    return any(
        has_arithmetic(term) and (sort.extent is extent or not isinstance(sort.extent, Interval))
        for term, sort in zip(atom.arguments, sorts, strict=True)
    )


def _places(
    typed: TypedProgram, atoms: Iterable[Atom], *, inside: bool = False
) -> Iterator[tuple[str, Extent]]:
    """Yields the variables that are arguments, or ``inside`` of records there too, each with the
    extent of its place.
    """
    for atom in atoms:
        for term, sort in zip(atom.arguments, typed.predicates[atom.name].sorts, strict=True):
            if inside or isinstance(term, Variable):
                yield from _inside(term, sort.extent)


def _inside(term: Term, extent: Extent) -> Iterator[tuple[str, Extent]]:
    if isinstance(term, Variable) and term.name != "_":
        yield term.name, extent
    elif isinstance(term, Record):
        for box in extent.boxes(term.name, len(term.arguments)) or ():
            for part, sort in zip(term.arguments, box.arguments, strict=True):
                yield from _inside(part, sort.extent)


def _carried(typed: TypedProgram, extent: Extent) -> Iterator[Value]:
    """Yields the elements of other sorts that a rule would carry into this one."""
    for rule in _rules(typed):
        body = [item for item in rule.body if isinstance(item, Atom)]
        places = list(_places(typed, (*_head_atoms(rule), *body)))
        here = {name for name, each in places if each is extent}
        for name, other in _places(typed, body):
            if name in here and other is not extent and other.bound() <= _MOST_ELEMENTS:
                yield from (value for value in other if value not in extent)


def _ranges_over(typed: TypedProgram, extent: Extent) -> bool:
    """Returns whether a choice, or a disjunction, is among all the elements of the sort."""
    for rule in _rules(typed):
        atoms = _head_atoms(rule)
        if not isinstance(rule.head, Choice) and len(atoms) < 2:
            continue
        conditions = rule.head.elements if isinstance(rule.head, Choice) else ()
        items = (*rule.body, *(one for each in conditions for one in each.condition))
        others = (each for each in items if isinstance(each, Atom))
        bound = {name for name, _ in _places(typed, others, inside=True)}
        chosen = _places(typed, atoms, inside=True)
        if any(e is extent and name not in bound for name, e in chosen):
            return True
    return False


def _new_element(typed: TypedProgram, name: str, extent: Extent) -> Value:
    """Returns an element that no sort has, named as the others of its sort are."""
    values = list(extent)
    if all(isinstance(value, int) for value in values):
        return max(value for value in values if isinstance(value, int)) + 1
    last = values[-1]
    numbered = _NUMBERED.fullmatch(last) if isinstance(last, str) else None
    stem, number = (numbered[1], int(numbered[2]) + 1) if numbered else (f"new_{name}", 1)
    while True:
        word = f"{stem}{number}"
        if not any(word in sort.extent for sort in typed.sorts.values()):
            return word
        number += 1


_NUMBERED = re.compile(r"(.*?[A-Za-z_])(\d{1,6})")


def _term(value: Value) -> Term:
    if isinstance(value, tuple):
        return Record(str(value[0]), tuple(map(_term, value[1:])))
    return Number(value) if isinstance(value, int) else Identifier(value)


# ------------------------------------------------------------------ the program with it


def _ground(typed: TypedProgram, symbols: Iterable[Any]) -> Iterator[GroundLiteral]:
    from sparc.solving.clingo_solver import ground_literal

    return (ground_literal(symbol) for symbol in symbols if symbol.name in typed.predicates)


def _outside(typed: TypedProgram, symbols: Iterable[Any]) -> tuple[str, ...]:
    """Returns the first three literals that the sorts of the program do not allow,
    positive ones first.
    """
    outside = [each for each in _ground(typed, symbols) if not _fits(typed, each)]
    return tuple(map(str, sorted(outside, key=lambda each: (each.negated, str(each)))[:3]))


def _fits(typed: TypedProgram, literal: GroundLiteral) -> bool:
    sorts = typed.predicates[literal.name].sorts
    return all(
        value_of(argument) in sort.extent
        for argument, sort in zip(literal.arguments, sorts, strict=True)
    )
