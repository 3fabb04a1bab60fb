"""Answer sets one by one: `AspProgram` → distinct answer sets as they are found.

Entry points: `prepare` (SPARC text → what is solved, and its timeline) and `AnswerListing`, an iterable
that tells at its end how the search went.  Answer sets that differ in nothing that is kept are
one: clingo is asked to tell them apart by the kept atoms only, so merging costs no memory where
the display section has no patterns.
"""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from sparc.answer_sets import AnswerSet, GroundLiteral
from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from sparc.translation.asp_program import AspProgram
from waiter_cli.answersets.timeline import Filter, Order, Timeline

if TYPE_CHECKING:
    from sparc.solving.clingo_solver import Grounding
    from sparc.syntax.tree import Program
    from waiter_cli.translators.base import Translator

__all__ = ["AnswerListing", "prepare", "shown_names", "timeline_of"]

MORE_SECONDS = 10.0
"""Seconds spent on looking for one more answer set once enough were found."""

_SHOWN_NAME = re.compile(r"#show -?([a-z_]\w*)")
_SHOWN_PREDICATE = re.compile(r"#show (-?)([a-z_]\w*)/(\d+)\.")
_Shown: TypeAlias = tuple[str, int, bool]  # a predicate that is shown whole: positive or not


def timeline_of(program: Program, order: Order | None = None) -> Timeline:
    """Returns the order of literals in a program, by its declarations and the options about time.

    Raises `InputError` where the program has no sort of the name that ``order`` gives.
    """
    from sparc.syntax.tree import SortName

    signatures = {
        declared.name: tuple(sort.name for sort in declared.sorts)
        for declared in program.predicates
    }
    aliases = {
        sort.name: sort.expression.name
        for sort in program.sorts
        if isinstance(sort.expression, SortName)
    }
    if order is not None and order.time_sort is not None:
        order = Order(_known_sort(order.time_sort.strip().removeprefix("#"), program))
    return Timeline(signatures, aliases, _sorts_of_numbers(program), order)


def _known_sort(name: str, program: Program) -> str:
    """Returns the name, which is that of a sort."""
    from sparc.spelling import near
    from waiter_cli.errors import Fault, InputError

    sorts = ["nat", *(sort.name for sort in program.sorts)]
    if name not in sorts:
        close = near(name, sorts, 3)
        hint = "its sorts are " + ", ".join(f"#{sort}" for sort in sorts[1:11])
        if close:
            hint = f"did you mean {' or '.join(f'#{sort}' for sort in close)}?"
        raise InputError([Fault(None, f"--time-sort: the program has no sort #{name}", hint)])
    return name


def _sorts_of_numbers(program: Program) -> frozenset[str]:
    """Returns the sorts of a program that may have numbers, by what their definitions are made of."""
    from sparc.syntax.tree import (
        Concatenation,
        Identifier,
        IdentifierList,
        IdentifierRange,
        RecordSort,
        SetExpression,
        SortName,
        TermSet,
    )

    constants = {directive.name for directive in program.directives if hasattr(directive, "name")}
    sorts = {"nat"}

    def may(expression: object) -> bool:
        match expression:
            case SortName(name):
                return name in sorts
            case SetExpression(_, left, right):
                return may(left) or may(right)
            case Concatenation(parts):
                return any(map(may, parts))
            case TermSet(terms):
                return not all(
                    isinstance(term, Identifier) and term.name not in constants for term in terms
                )
        return not isinstance(expression, (IdentifierList, IdentifierRange, RecordSort))

    todo = list(program.sorts)
    while more := [sort for sort in todo if may(sort.expression)]:
        sorts.update(sort.name for sort in more)
        todo = [sort for sort in todo if sort.name not in sorts]
    return frozenset(sorts)


def prepare(
    source: Source,
    translator: Translator,
    *,
    time_limit: float | None = None,
    order: Order | None = None,
) -> tuple[AspProgram, Timeline]:
    """Returns the translation of ``source`` by ``translator``, and the order of its literals.

    Raises what the translator raises, and what `timeline_of` raises.  The jar is asked first, since it is the one that decides
    which programs it takes.
    """
    from sparc.syntax.parser import parse

    program = translator.translate(source, time_limit=time_limit)
    try:
        tree = parse(source)
    except (SourceError, SourceErrors):
        return program, Timeline({})
    return program, timeline_of(tree, order)


class AnswerListing:
    """The answer sets of ``program``, restricted to what ``chosen`` keeps, each once.

    Iterating yields at most ``limit`` of them (0: all), each as soon as it is found.  With
    ``projection`` two answer sets are also one when they agree on these predicates.  Afterwards
    ``satisfiable`` says whether there is any (None: not known), ``complete`` whether all were
    yielded, ``limit_reached`` is ``time`` or ``memory`` where one came first, and ``open_end``
    is True where it was not settled whether there are more than ``limit``.
    """

    def __init__(
        self,
        program: AspProgram,
        timeline: Timeline,
        chosen: Filter,
        *,
        projection: frozenset[str] | None = None,
        limit: int = 0,
        deadline: float | None = None,
    ) -> None:
        from sparc.solving.answers import LiteralMemo

        self.program = program
        self.timeline = timeline
        self.chosen = chosen
        self.projection = projection
        self.limit = limit
        self.deadline = deadline
        self.satisfiable: bool | None = None
        self.complete = False
        self.limit_reached: str | None = None
        self.open_end = False
        self._literals = LiteralMemo(self._filtered)
        self._kept = False

    def overlooked(self) -> bool:
        """Returns whether no pattern matched anything, and one would if ``a`` stood for ``A`` too."""
        if self._kept or not self.chosen.patterns or self.chosen.invert:
            return False
        loose = self.chosen.ignoring_case()
        literals = self._literals.literals()
        return any(loose.keeps(each, self.timeline.step(each)) for each in literals)

    def __iter__(self) -> Iterator[AnswerSet]:
        from sparc.limits import OverLimit, settle
        from sparc.solving.clingo_threads import Abandoned

        try:
            yield from self._search()
        except Abandoned:
            self.limit_reached = "time"
        except OverLimit as over:
            settle()
            self._literals.clear()
            self.limit_reached = over.limit
        except MemoryError:
            self._literals.clear()
            self.limit_reached = "memory"

    # ------------------------------------------------------------ search

    def _search(self) -> Iterator[AnswerSet]:
        from sparc.solving.answers import SeenAnswers
        from sparc.solving.clingo_solver import Grounding, Satisfiability

        grounding = Grounding(self.program)
        grounding.ground(self.deadline)
        solve: Any = grounding.control.configuration.solve
        if self.program.has_preferences:
            solve.opt_mode = "optN"
        shown = _shown_predicates(self.program.show)
        once = SeenAnswers() if shown is None and self.projection is None else None
        if self.projection is not None:
            solve.project = "project"
            self._project(grounding, self._projected(grounding))
        elif shown is None:
            solve.project = "show"
        elif self._may_coincide(grounding, shown):
            solve.project = "project" if self.chosen else "show"
            if self.chosen:
                self._project(grounding, shown)
        count = 0
        timer: threading.Timer | None = None
        try:
            for model in grounding.models(deadline=self.deadline):
                if model.cost and not model.optimality_proven:
                    continue
                self.satisfiable = True
                symbols = model.symbols(shown=True)
                literals = frozenset(
                    literal for literal in map(self._literals.of, symbols) if literal is not None
                )
                if once is not None and not once.is_new(literals):
                    continue
                if self.limit and count == self.limit:
                    return  # there is one more
                count += 1
                yield AnswerSet(literals, tuple(model.cost))
                if self.limit and count == self.limit:
                    timer = threading.Timer(MORE_SECONDS, grounding.control.interrupt)
                    timer.daemon = True
                    timer.start()
        finally:
            if timer is not None:
                timer.cancel()
                timer.join()
        outcome = grounding.outcome
        if outcome.satisfiability is Satisfiability.UNSATISFIABLE:
            self.satisfiable = False
        if outcome.exhausted:
            self.complete = True
        elif self.limit and count == self.limit:
            self.open_end = True
        else:
            self.limit_reached = "time"

    def _may_coincide(self, grounding: Grounding, shown: frozenset[_Shown]) -> bool:
        """Returns whether two answer sets of the program may agree in everything that is kept."""
        if self.chosen or self.program.has_preferences:
            return True
        declared = self.timeline.arities
        return not declared or any(
            declared.get(name) == arity and (name, arity, positive) not in shown
            for name, arity, positive in grounding.control.symbolic_atoms.signatures
        )

    def _projected(self, grounding: Grounding) -> frozenset[_Shown]:
        """Returns the predicates of the projection, whether they are shown or not."""
        assert self.projection is not None
        return frozenset(
            signature
            for signature in grounding.control.symbolic_atoms.signatures
            if signature[0] in self.projection
        )

    def _project(self, grounding: Grounding, wanted: frozenset[_Shown]) -> None:
        """Makes clingo tell answer sets apart by what is kept."""
        from sparc.solving.clingo_threads import Abandoned

        atoms = []
        for number, atom in enumerate(
            atom
            for signature in sorted(wanted)
            for atom in grounding.control.symbolic_atoms.by_signature(*signature)
        ):
            if number % 10_000 == 0 and self.deadline is not None:
                if time.monotonic() >= self.deadline:
                    raise Abandoned
            if self.projection is not None or self._literals.of(atom.symbol) is not None:
                atoms.append(atom.literal)
        with grounding.control.backend() as backend:
            backend.add_project(atoms)

    def _filtered(self, literal: GroundLiteral) -> GroundLiteral | None:
        """Returns the literal, None where it is filtered out."""
        if self.chosen and not self.chosen.keeps(literal, self.timeline.step(literal)):
            return None
        self._kept = True
        return literal


def shown_names(program: AspProgram) -> frozenset[str]:
    """Returns the names of the predicates and sorts of which ``program`` shows something."""
    names = (match[1] for match in map(_SHOWN_NAME.match, program.show.split("\n")) if match)
    return frozenset(f"#{name[2:]}" if name.startswith("__") else name for name in names)


def _shown_predicates(show: str) -> frozenset[_Shown] | None:
    """Returns the predicates that are shown whole (name, arity, positive).

    None where terms are shown.
    """
    shown = set()
    for line in show.split("\n"):
        if not line or line == "#show.":
            continue
        match = _SHOWN_PREDICATE.fullmatch(line)
        if match is None:
            return None
        shown.add((match[2], int(match[3]), match[1] == ""))
    return frozenset(shown)
