"""Asks about the programs between some statements and the whole: class `SubsetOracle`.

Grounded once; each question is a search under assumptions.  `Undecided` is raised at the deadline,
so that nothing unproved is ever taken for an answer.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias

from sparc.answer_sets import Ground
from sparc.solving.clingo_solver import Grounding, Satisfiability, ground_literal
from sparc.solving.clingo_threads import Abandoned
from sparc.translation.asp_program import AspProgram

__all__ = ["SubsetOracle", "SwitchKey", "Undecided"]

SwitchKey: TypeAlias = tuple[Ground, ...]
"""A switch: the arguments of its atom."""


class Undecided(Exception):
    """The time was up before a question was answered."""


class SubsetOracle:
    """A grounded program with switches, the atoms of ``predicate``.

    A switch is on where its atom has the truth ``when_on``.  ``last_on`` are the switches that were
    on in the last answer set, ``last_symbols`` all its atoms.
    """

    def __init__(
        self,
        program: AspProgram,
        predicate: str,
        *,
        when_on: bool = True,
        deadline: float | None = None,
        options: Sequence[str] = (),
    ) -> None:
        self.deadline = deadline
        self.last_on: frozenset[SwitchKey] = frozenset()
        self.last_symbols: tuple[Any, ...] = ()
        self._grounding = Grounding(program, options=options)
        try:
            self._grounding.ground(deadline)
        except Abandoned:
            raise Undecided from None
        atoms = self._grounding.control.symbolic_atoms
        signatures = [
            n for name, n, positive in atoms.signatures if (name, positive) == (predicate, True)
        ]
        found = [atom for arity in signatures for atom in atoms.by_signature(predicate, arity)]
        sign = 1 if when_on else -1
        self._when_on = when_on
        self._symbols = {ground_literal(atom.symbol).arguments: atom.symbol for atom in found}
        self._literals = {
            ground_literal(atom.symbol).arguments: sign * atom.literal for atom in found
        }
        self._keys = {literal: key for key, literal in self._literals.items()}

    @property
    def switches(self) -> tuple[SwitchKey, ...]:
        """Returns all switches."""
        return tuple(self._literals)

    def conflict(self, on: Iterable[SwitchKey]) -> frozenset[SwitchKey] | None:
        """Returns some of these switches that leave no answer set, whatever the others are.

        None where there is an answer set with all of them on.
        """
        assumed = [self._literals[key] for key in on]
        for model in self._grounding.models(
            limit=1, assumptions=assumed, deadline=self.deadline, optimize=False
        ):
            self._keep(model)
        satisfiability = self._grounding.outcome.satisfiability
        if satisfiability is Satisfiability.UNKNOWN:
            raise Undecided
        if satisfiability is Satisfiability.SATISFIABLE:
            return None
        core = self._grounding.core
        return frozenset(self._keys[literal] for literal in core if literal in self._keys)

    def has_answer_set(self, on: Iterable[SwitchKey], conflicts: int) -> bool:
        """Returns whether an answer set with these switches on is found within so many conflicts."""
        assumed = [self._literals[key] for key in on if key in self._literals]
        consistent = False
        for model in self._grounding.models(
            limit=1,
            assumptions=assumed,
            deadline=self.deadline,
            optimize=False,
            conflicts=conflicts,
        ):
            self._keep(model)
            consistent = True
        if not consistent and self.deadline is not None and time.monotonic() >= self.deadline:
            raise Undecided
        return consistent

    def most_on(self) -> frozenset[SwitchKey] | None:
        """As many switches as can be on in an answer set; None where there is none."""
        best: frozenset[SwitchKey] | None = None
        for model in self._grounding.models(deadline=self.deadline, optimize=True):
            self._keep(model)
            best = self.last_on
        outcome = self._grounding.outcome
        if outcome.satisfiability is Satisfiability.UNKNOWN or not outcome.exhausted:
            raise Undecided
        return best

    def add(self, rule: str) -> None:
        """Adds a rule of clingo's for all questions to come."""
        self._grounding.extend(rule, self.deadline)

    def _keep(self, model: Any) -> None:
        self.last_on = frozenset(
            key for key, symbol in self._symbols.items() if model.contains(symbol) is self._when_on
        )
        self.last_symbols = tuple(model.symbols(atoms=True))
