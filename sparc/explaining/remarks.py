"""A remark on an inconsistency beside its statements: ``p`` and ``-p`` both follow. Entry point `contraries`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from sparc.answer_sets import Ground, GroundTerm
from sparc.checking.typed_program import TypedProgram
from sparc.explaining.instances import Binding, ground_statement
from sparc.explaining.subsets import SubsetOracle
from sparc.explaining.switches import ON, SwitchedProgram
from sparc.sorts.values import Value
from sparc.syntax.printer import print_statement
from sparc.syntax.tree import (
    Atom,
    Choice,
    Rule,
    Statement,
)

__all__ = ["contraries", "value_of"]

_STRONG = re.compile(r"(?<![\w):])-(?=[a-z_])")


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


def value_of(term: Ground) -> Value:
    """Returns a ground term as the sorts know it."""
    if isinstance(term, GroundTerm):
        return (term.name, *map(value_of, term.arguments)) if term.arguments else term.name
    return term
