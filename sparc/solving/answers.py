"""Answer sets of a translated program, one at a time: AspProgram → `Answers`.

>>> from sparc.translation.asp_program import AspProgram
>>> answers = Answers(AspProgram("1{p(1..3)}1.", "#show p/1."), models=2)
>>> len([str(literal) for answer_set in answers for literal in answer_set.literals])
2
>>> answers.satisfiable, answers.complete
(True, False)

With preferences only the optimal answer sets come, all of them.  Answer sets that show the same
literals come once; only a digest of each one is kept.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from hashlib import blake2b
from typing import Any

from sparc.answer_sets import AnswerSet, GroundLiteral
from sparc.solving.clingo_solver import Abandoned, Grounding, Satisfiability, ground_literal
from sparc.translation.asp_program import AspProgram

__all__ = ["Answers", "shown_literal"]

_REMEMBERED = 200_000  # literals; some 500 bytes each


class Answers(Iterator[AnswerSet]):
    """An iterator over the answer sets of ``program``, at most ``models`` of them (0: all).

    Grounding happens at once, so that its errors (`SolverError`) come at once; each answer set is
    handed over as soon as it is found.  ``time_limit`` is in seconds and counts from the start.

    ``satisfiable`` is None until it is known, and stays None when the time was up before;
    ``complete`` says that there are no more answer sets than those seen.
    """

    def __init__(
        self, program: AspProgram, *, models: int = 0, time_limit: float | None = None
    ) -> None:
        deadline = None if time_limit is None else time.monotonic() + time_limit
        options = []
        self._optimal_only = program.has_preferences
        if program.has_preferences:
            options.append("--opt-mode=optN")
        elif program.has_display:
            # Without preferences clingo itself can skip sets that differ in hidden literals.
            options.append("--project=show")
        self._digests: set[bytes] | None = (
            set() if program.has_preferences or program.has_display else None
        )
        self.satisfiable: bool | None = None
        self.complete = False
        self._left = models or -1
        self._known: dict[object, GroundLiteral] = {}
        self._grounding = Grounding(program, options=options)
        self._found: Iterator[AnswerSet]
        try:
            self._grounding.ground(deadline)
        except Abandoned:
            self._found = iter(())
            return
        self._found = self._search(deadline)

    def __next__(self) -> AnswerSet:
        return next(self._found)

    def _search(self, deadline: float | None) -> Iterator[AnswerSet]:
        models = self._grounding.models(deadline=deadline)
        for model in models:
            self.satisfiable = True
            # Without a ground preference there is no cost, and every model is optimal.
            if self._optimal_only and model.cost and not model.optimality_proven:
                continue
            answer = AnswerSet(
                frozenset(map(self._literal, model.symbols(shown=True))),
                tuple(model.cost),
            )
            if self._is_new(answer):
                if self._left == 0:  # one more than wanted: the listing is not complete
                    models.close()  # type: ignore[attr-defined]
                    return
                self._left -= 1
                yield answer
        outcome = self._grounding.outcome
        if outcome.satisfiability is Satisfiability.UNSATISFIABLE:
            self.satisfiable = False
        self.complete = outcome.exhausted

    def _literal(self, symbol: Any) -> GroundLiteral:
        """Returns the literal of a clingo symbol; most of them come again in the next answer set."""
        known = self._known.get(symbol)
        if known is None:
            if len(self._known) >= _REMEMBERED:
                self._known.clear()
            known = self._known[symbol] = shown_literal(ground_literal(symbol))
        return known

    def _is_new(self, answer: AnswerSet) -> bool:
        """Returns whether no earlier answer set has shown the same literals."""
        if self._digests is None:
            return True
        shown = "\n".join(sorted(map(str, answer.literals)))
        digest = blake2b(shown.encode(), digest_size=16).digest()
        if digest in self._digests:
            return False
        self._digests.add(digest)
        return True


def shown_literal(literal: GroundLiteral) -> GroundLiteral:
    """Returns the literal as SPARC shows it: an element of a sort as ``#s(a)``."""
    if literal.name.startswith("__"):
        return replace(literal, name="#" + literal.name[2:])
    return literal
