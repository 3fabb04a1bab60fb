"""Explains why a program is inconsistent: TypedProgram → `Inconsistency`, with `explain`.

>>> from sparc import check, parse
>>> program = check(parse("predicates p(). q(). rules q. :- p. p :- q. :- q, not p. "))
>>> found = explain(program)
>>> [[member.place.text for member in cause.members] for cause in found.causes]
[[':- p.', ':- q, not p.', 'q.']]

A cause is a minimal set of statements such that no program between them and the whole one has an
answer set.  A mend is a least set of statements without which there is one.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import islice
from typing import TypeVar

from sparc import limits
from sparc.checking.typed_program import TypedProgram
from sparc.errors import RefusedProgramError
from sparc.explaining.active_instances import active_instances, shown_instances
from sparc.explaining.causes import all_causes, independent_causes, mends
from sparc.explaining.places import StatementPlace, place_of
from sparc.explaining.remarks import contraries
from sparc.explaining.small_sorts import SmallSort, small_sorts
from sparc.explaining.subsets import SubsetOracle, SwitchKey, Undecided
from sparc.explaining.switches import ON, SwitchedProgram, switched
from sparc.lazy_dataclass import dataclass
from sparc.solving.clingo_solver import Grounding
from sparc.solving.clingo_threads import Abandoned
from sparc.translation.translator import translate

__all__ = ["Cause", "CauseMember", "Inconsistency", "Mend", "explain"]

MOST_CAUSES = 100
MOST_MENDS = 5
MOST_MENDS_OF_ALL = 20

Value = TypeVar("Value")


@dataclass(frozen=True)
class CauseMember:
    """A statement of a cause, or a sort that is too small for it, with instances that take part.

    Of a sort the instances are literals that would hold with a larger one, and ``larger`` is a definition
    that would do for this cause, empty where it is too long to be read.
    """

    place: StatementPlace
    instances: tuple[str, ...]
    is_sort: bool = False
    larger: str = ""

    def __str__(self) -> str:
        note = f"  (too small: {', '.join(self.instances)})" if self.is_sort else ""
        return f"{self.place}: {self.place.text}{note}"


@dataclass(frozen=True)
class Cause:
    """A minimal set of statements, in the order of the text; ``contraries`` are pairs p, -p."""

    members: tuple[CauseMember, ...]
    contraries: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return "\n".join(self.lines())

    def lines(self) -> list[str]:
        """Returns the statements, one a line, and what contradicts each other."""
        clashes = (f"{one} and {other} contradict each other" for one, other in self.contraries)
        return [*map(str, self.members), *clashes]


@dataclass(frozen=True)
class Mend:
    """A least set of statements without which there is an answer set."""

    without: tuple[StatementPlace, ...]

    def __str__(self) -> str:
        return "without " + " and ".join(f"{place}: {place.text}" for place in self.without)


@dataclass(frozen=True)
class Inconsistency:
    """The causes of an inconsistency: ``consistent`` is None where a limit came first.

    ``limit`` is ``time`` or ``memory`` where something was left open; ``cut`` says that there are
    more causes, or mends, than were asked for.  Each cause and each mend that is here is proved.
    """

    consistent: bool | None
    causes: tuple[Cause, ...] = ()
    mends: tuple[Mend, ...] = ()
    limit: str | None = None
    cut: bool = False

    @property
    def complete(self) -> bool:
        """Returns whether all that was asked for is here."""
        return self.limit is None and not self.cut

    def __str__(self) -> str:
        """Returns what was found, a statement or a mend a line."""
        said = {True: "consistent", False: "inconsistent", None: "undecided"}[self.consistent]
        lines = [said if self.limit is None else f"{said}: the {self.limit} limit was reached"]
        for cause in self.causes:
            lines += ["these leave no answer set:", *(f"  {line}" for line in cause.lines())]
        if self.mends:
            lines += ["there is an answer set:", *(f"  {mend}" for mend in self.mends)]
        return "\n".join(lines)


def explain(
    typed: TypedProgram,
    *,
    every: bool = False,
    time_limit: float | None = None,
    most: int = MOST_CAUSES,
) -> Inconsistency:
    """Returns the causes and mends of the inconsistency of ``typed``, or that it is consistent.

    Causes that share no statement are told apart; ``every`` adds those that do, ``most`` in all.
    ``time_limit`` is in seconds.  Raises what the translation raises.
    """
    return _Explainer(typed, every, time_limit, most).run()


class _Explainer:
    def __init__(
        self, typed: TypedProgram, every: bool, time_limit: float | None, most: int
    ) -> None:
        self.typed = typed
        self.every = every
        self.most = most
        self.deadline = None if time_limit is None else time.monotonic() + time_limit
        self.limit: str | None = None
        self.cut = False
        self.causes: list[frozenset[SwitchKey]] = []
        self.mends: list[frozenset[SwitchKey]] = []

    def run(self) -> Inconsistency:
        """Returns all stages, each as far as the limits let it."""
        program = self.guarded(lambda: switched(self.typed))
        if program is None:
            return Inconsistency(None, limit=self.limit)
        oracle = self.guarded(lambda: self.oracle(program))
        verdict = oracle and self.guarded(lambda: (oracle.conflict(oracle.switches) is None,))
        if not oracle or not verdict:
            return Inconsistency(None, limit=self.limit)
        if verdict[0]:
            return Inconsistency(True)
        self.guarded(lambda: self.find_causes(oracle))
        if self.limit is None:
            self.guarded(lambda: self.find_mends(oracle))
        causes, mends_ = self.shown(program)
        return Inconsistency(False, causes, mends_, self.limit, self.cut)

    def guarded(self, stage: Callable[[], Value]) -> Value | None:
        """Returns the value of a stage, None where a limit ended it."""
        try:
            return stage()
        except Undecided:
            self.limit = "time"
        except limits.OverLimit as over:
            limits.settle()
            self.limit = over.limit
        except MemoryError:
            self.limit = "memory"
        return None

    def oracle(self, program: SwitchedProgram) -> SubsetOracle:
        """Returns the switched program with a preference for statements."""
        asp = program.text()
        terms = ";".join(f"1,{index}: {ON}({index})" for index in program.switches)
        lines = [asp.text, f"#maximize{{{terms}}}."]
        try:
            return SubsetOracle(
                program.asp(lines), ON, deadline=self.deadline, options=("--opt-strategy=usc",)
            )
        except RefusedProgramError:
            # With switches a sum that is too large is refused without its place; the program
            # as it is has one.
            try:
                Grounding(translate(self.typed)).ground(self.deadline)
            except Abandoned:
                raise Undecided from None
            raise

    def find_causes(self, oracle: SubsetOracle) -> None:
        """Causes that share nothing, then, where every one is wanted, all the others."""
        for cause in independent_causes(oracle):
            self.causes.append(cause)
        if self.every:
            rest = all_causes(oracle, self.causes)
            self.causes.extend(self.some(rest, self.most - len(self.causes)))

    def find_mends(self, oracle: SubsetOracle) -> None:
        """Mends, those of fewest statements first."""
        self.mends.extend(self.some(mends(oracle), MOST_MENDS_OF_ALL if self.every else MOST_MENDS))

    def some(
        self, found: Iterator[frozenset[SwitchKey]], most: int
    ) -> Iterator[frozenset[SwitchKey]]:
        """At most so many; says where there are more, if every one is wanted."""
        yield from islice(found, max(0, most))
        if self.every and next(found, None) is not None:
            self.cut = True

    # ------------------------------------------------------------ what is told of them

    def shown(self, program: SwitchedProgram) -> tuple[tuple[Cause, ...], tuple[Mend, ...]]:
        """Returns causes and mends with places, instances and remarks."""
        indices = [frozenset(_indices(cause)) for cause in self.causes]
        small = None
        if self.limit is None:
            small = self.guarded(lambda: small_sorts(self.typed, indices, self.deadline))
        causes = []
        for members, sorts in zip(indices, small or [[] for _ in indices], strict=True):
            told = None
            if self.limit is None:
                told = self.guarded(partial(self.cause, program, members, sorts))
            causes.append(told or Cause(tuple(self.members(members, {}))))
        mends_ = [Mend(tuple(self.place(index) for index in _indices(mend))) for mend in self.mends]
        return tuple(causes), tuple(mends_)

    def cause(
        self, program: SwitchedProgram, indices: frozenset[int], sorts: list[SmallSort]
    ) -> Cause:
        """Returns a cause with all that can be told of it."""
        found = active_instances(self.typed, program, indices, self.deadline)
        texts = {
            index: shown_instances(self.typed, index, bindings) for index, bindings in found.items()
        }
        pairs = contraries(self.typed, program, found, self.deadline)
        small = [
            CauseMember(
                place_of(self.typed.program.sorts[sort.index].span),
                sort.literals,
                True,
                sort.larger,
            )
            for sort in sorts
        ]
        return Cause((*self.members(indices, texts), *small), tuple(pairs))

    def members(self, indices: Iterable[int], texts: dict[int, list[str]]) -> Iterator[CauseMember]:
        for index in sorted(indices):
            yield CauseMember(self.place(index), tuple(texts.get(index, ())))

    def place(self, index: int) -> StatementPlace:
        return place_of(self.typed.program.statements[index].span)


def _indices(keys: Iterable[SwitchKey]) -> list[int]:
    return sorted(key[0] for key in keys if isinstance(key[0], int))
