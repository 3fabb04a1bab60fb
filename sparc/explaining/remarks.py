"""Remarks on an inconsistency beside its statements: contraries, and sorts that are too small.

Entry points `contraries` (``p`` and ``-p`` both follow) and `small_sorts` (an instance is lost because a number
leaves its sort, and with a larger sort there is an answer set).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from sparc.answer_sets import Ground, GroundLiteral, GroundTerm
from sparc.checking.checker import check
from sparc.checking.typed_program import TypedProgram, has_arithmetic
from sparc.errors import LimitError, SourceErrors
from sparc.explaining.instances import Binding, ground_statement
from sparc.explaining.subsets import SubsetOracle
from sparc.explaining.switches import ON, SwitchedProgram, switched
from sparc.lazy_dataclass import dataclass
from sparc.sorts.extents import Extent, Interval
from sparc.sorts.values import Value
from sparc.syntax.printer import print_statement
from sparc.syntax.tree import (
    Atom,
    Choice,
    CrRule,
    Number,
    NumericRange,
    Rule,
    Statement,
)

__all__ = ["SmallSort", "contraries", "small_sorts", "value_of"]

_STRONG = re.compile(r"(?<![\w):])-(?=[a-z_])")
_CONFLICTS = 20_000  # of a search for an answer set with a larger sort


@dataclass(frozen=True)
class SmallSort:
    """A sort that ends too early: the index of its definition, and literals that would hold."""

    index: int
    literals: tuple[str, ...]


def contraries(
    typed: TypedProgram,
    program: SwitchedProgram,
    instances: Mapping[int, Sequence[Binding]],
    deadline: float | None,
) -> list[tuple[str, str]]:
    """Returns the pairs ``p(t)``, ``-p(t)`` that the instances of a cause give,
    where it takes them.

    Taken out of the translation, the law that no answer set has both leaves an answer set.
    """
    heads = {
        print_statement(Rule((atom,), ())).removesuffix(".")
        for index, bindings in instances.items()
        for binding in bindings
        for atom in _heads(ground_statement(typed.program.statements[index], binding))
    }
    pairs = sorted((head, f"-{head}") for head in heads if f"-{head}" in heads)
    if not pairs:
        return []
    plain = program.text()
    text = _STRONG.sub("___neg_", plain.text)
    oracle = SubsetOracle(replace(plain, text=text), ON, deadline=deadline)
    return pairs if oracle.conflict([(index,) for index in instances]) is None else []


def _heads(statement: Statement) -> list[Atom]:
    if isinstance(statement, Rule):
        if isinstance(statement.head, Choice):
            return []
        return [atom for atom in statement.head if isinstance(atom, Atom)]
    return []


# ------------------------------------------------------------------ sorts that are too small


def small_sorts(
    typed: TypedProgram, causes: Sequence[frozenset[int]], deadline: float | None
) -> list[list[SmallSort]]:
    """For each cause the sorts of numbers that arithmetic leaves, and that are too small for it.

    With a larger sort the statements of the cause have an answer set, together with all that is in
    no other cause.
    """
    found: list[list[SmallSort]] = [[] for _ in causes]
    for index, definition in enumerate(typed.program.sorts):
        extent = typed.sorts[definition.name].extent
        if not isinstance(definition.expression, NumericRange) or not isinstance(extent, Interval):
            continue
        if not _calculates(typed, extent):
            continue
        size = extent.high - extent.low + 1
        open_ = list(range(len(causes)))
        for more in dict.fromkeys((1, size, 3 * size)):
            oracle = _with_larger(typed, index, extent, more, deadline) if open_ else None
            if oracle is None:
                break
            for at in open_:
                others = frozenset().union(*causes) - causes[at]
                on = [key for key in oracle.switches if key[0] not in others]
                if oracle.has_answer_set(on, _CONFLICTS):
                    literals = _outside(typed, oracle.last_symbols)
                    if literals:
                        found[at].append(SmallSort(index, literals))
            open_ = [at for at in open_ if not any(sort.index == index for sort in found[at])]
    return found


def _calculates(typed: TypedProgram, extent: Extent) -> bool:
    """Returns whether some head or body has arithmetic where a number of the sort must stand."""
    for statement in typed.program.statements:
        if not isinstance(statement, Rule | CrRule):
            continue
        items: list[object] = list(statement.body)
        head = statement.head
        items += [each.atom for each in head.elements] if isinstance(head, Choice) else list(head)
        for item in items:
            atom = getattr(item, "operand", item)
            if isinstance(atom, Atom) and _leaves(typed, atom, extent):
                return True
    return False


def _leaves(typed: TypedProgram, atom: Atom, extent: Extent) -> bool:
    sorts = typed.predicates[atom.name].sorts
    return any(
        has_arithmetic(term) and (sort.extent is extent or not isinstance(sort.extent, Interval))
        for term, sort in zip(atom.arguments, sorts, strict=True)
    )


def _with_larger(
    typed: TypedProgram, index: int, extent: Interval, more: int, deadline: float | None
) -> SubsetOracle | None:
    """Returns the program, with switches, of a larger sort; None where it is faulty, or too large."""
    wider = NumericRange(Number(max(0, extent.low - more)), Number(extent.high + more))
    sorts = list(typed.program.sorts)
    sorts[index] = replace(sorts[index], expression=wider)
    try:
        larger = switched(check(replace(typed.program, sorts=tuple(sorts))))
        return SubsetOracle(larger.text(), ON, deadline=deadline)
    except (SourceErrors, LimitError):
        return None


def _outside(typed: TypedProgram, symbols: Iterable[Any]) -> tuple[str, ...]:
    """Returns the first three literals that the sorts of the program do not allow,
    positive ones first.
    """
    from sparc.solving.clingo_solver import ground_literal

    literals = map(ground_literal, symbols)
    outside = [
        each for each in literals if each.name in typed.predicates and not _fits(typed, each)
    ]
    return tuple(map(str, sorted(outside, key=lambda each: (each.negated, str(each)))[:3]))


def _fits(typed: TypedProgram, literal: GroundLiteral) -> bool:
    sorts = typed.predicates[literal.name].sorts
    return all(
        value_of(argument) in sort.extent
        for argument, sort in zip(literal.arguments, sorts, strict=True)
    )


def value_of(term: Ground) -> Value:
    """Returns a ground term as the sorts know it."""
    if isinstance(term, GroundTerm):
        return (term.name, *map(value_of, term.arguments)) if term.arguments else term.name
    return term
