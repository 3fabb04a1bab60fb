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
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from hashlib import blake2b
from typing import Any, Generic, TypeVar

from sparc.answer_sets import AnswerSet, GroundLiteral
from sparc.solving.clingo_solver import Grounding, Satisfiability, ground_literal
from sparc.solving.clingo_threads import Abandoned
from sparc.translation.asp_program import AspProgram

__all__ = ["Answers", "LiteralMemo", "SeenAnswers", "shown_literal"]

Kept = TypeVar("Kept")

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
        self._seen = SeenAnswers() if program.has_preferences or program.has_display else None
        self.satisfiable: bool | None = None
        self.complete = False
        self._left = models or -1
        self._taken = 0
        self._literals = LiteralMemo(lambda literal: literal)
        self._grounding = Grounding(program, options=options)
        self._found: Iterator[AnswerSet]
        try:
            self._grounding.ground(deadline)
        except Abandoned:
            self._found = iter(())
            return
        self._found = self._search(deadline)

    def __next__(self) -> AnswerSet:
        answer_set = next(self._found)
        self._taken += 1
        return answer_set

    def __str__(self) -> str:
        """Returns how many answer sets came until now; none is taken for it."""
        if self.satisfiable is False:
            return "no answer set"
        sets = f"{self._taken} answer set{'s' * (self._taken != 1)}"
        return sets if self.complete else f"{sets} taken, perhaps not all"

    def __repr__(self) -> str:
        return f"<Answers: {self}>"

    def _search(self, deadline: float | None) -> Iterator[AnswerSet]:
        models = self._grounding.models(deadline=deadline)
        for model in models:
            self.satisfiable = True
            # Without a ground preference there is no cost, and every model is optimal.
            if self._optimal_only and model.cost and not model.optimality_proven:
                continue
            answer = AnswerSet(
                frozenset(map(self._literals.of, model.symbols(shown=True))),
                tuple(model.cost),
            )
            if self._seen is None or self._seen.is_new(answer.literals):
                if self._left == 0:  # one more than wanted: the listing is not complete
                    models.close()  # type: ignore[attr-defined]
                    return
                self._left -= 1
                yield answer
        outcome = self._grounding.outcome
        if outcome.satisfiability is Satisfiability.UNSATISFIABLE:
            self.satisfiable = False
        self.complete = outcome.exhausted


class LiteralMemo(Generic[Kept]):
    """The literals of clingo's symbols as ``keep`` gives them, made once while there is room.

    Most symbols of an answer set come again in the next one.
    """

    def __init__(self, keep: Callable[[GroundLiteral], Kept]) -> None:
        self._keep = keep
        self._known: dict[Any, Kept] = {}

    def of(self, symbol: Any) -> Kept:
        """Returns what is kept of a symbol's literal."""
        known = self._known
        try:
            return known[symbol]
        except KeyError:
            pass
        if len(known) >= _REMEMBERED:
            known.clear()
        kept = known[symbol] = self._keep(_literal(symbol))
        return kept

    def literals(self) -> Iterator[GroundLiteral]:
        """Yields the literals of the symbols at hand, whatever is kept of them."""
        return map(_literal, self._known)

    def clear(self) -> None:
        """Forgets all of them."""
        self._known.clear()


def _literal(symbol: Any) -> GroundLiteral:
    return shown_literal(ground_literal(symbol))


class SeenAnswers:
    """The answer sets that were seen, by 16 bytes each."""

    def __init__(self) -> None:
        self._digests: set[bytes] = set()

    def is_new(self, literals: Iterable[GroundLiteral]) -> bool:
        """Returns whether no earlier answer set had the same literals, and remembers this one."""
        text = "\n".join(sorted(map(str, literals)))
        digest = blake2b(text.encode(), digest_size=16).digest()
        before = len(self._digests)
        self._digests.add(digest)
        return len(self._digests) > before


def shown_literal(literal: GroundLiteral) -> GroundLiteral:
    """Returns the literal as SPARC shows it: an element of a sort as ``#s(a)``."""
    if literal.name.startswith("__"):
        return replace(literal, name="#" + literal.name[2:])
    return literal
