"""clingo in this process: `AspProgram` → answer sets.  The one module that imports clingo.

Four traps of clingo are handled here and nowhere else.  Grounding ignores Ctrl-C and cannot be
stopped, so it runs in a thread that is left behind when the time is up (`Abandoned` tells the
caller that only the end of the process frees what it holds).  A blocking solve ignores Ctrl-C
too, so every solve is asynchronous.  And messages about atoms without rules are noise: they are
collected, never printed.  The fourth is a defect: see `Grounding`.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from typing import TYPE_CHECKING

import clingo

from sparc.answer_sets import AnswerSet, Ground, GroundLiteral, GroundTerm
from sparc.errors import NumberError, RefusedProgramError, SolverError
from sparc.lazy_dataclass import dataclass
from sparc.solving.clingo_threads import POLL, Abandoned, held, in_thread
from sparc.syntax.cursor import MAX_NUMBER
from sparc.translation.asp_program import AspProgram

if TYPE_CHECKING:
    from sparc.solving.exact_arithmetic import Overflow
    from sparc.source import Span

__all__ = ["Grounding", "Outcome", "Satisfiability", "ground_literal"]


class Satisfiability(Enum):
    """The result of a search."""

    SATISFIABLE = "sat"
    UNSATISFIABLE = "unsat"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Outcome:
    """The end of a search: what was shown, how many models were seen, and how long it took.

    ``exhausted`` says that there are no more models than those seen.
    """

    satisfiability: Satisfiability
    models: int
    seconds: float
    exhausted: bool


def _out_of_memory(error: RuntimeError) -> None:
    """Raises `MemoryError` where that is what clingo's error says."""
    if "bad_alloc" in str(error):
        raise MemoryError("clingo ran out of memory") from error


class Grounding:
    """One program in clingo: grounded once, solved as often as wanted.

    ``extra`` is clingo text added to the program; ``show`` replaces the program's own ``#show``
    directives; ``options`` are clingo's command-line options.
    """

    def __init__(
        self,
        program: AspProgram,
        *,
        extra: str = "",
        show: str | None = None,
        options: Sequence[str] = (),
    ) -> None:
        self.messages: list[tuple[str, str]] = []
        # clasp's equivalence preprocessing loses answer sets of disjunctive programs:
        # "a;na. b;nb. na. ok:-not not a. ok:-not not b. :-not ok." has {na,b,ok}, and was
        # unsatisfiable for it (clingo 5.6.2 to 5.8.3).
        safe = ("--eq=0",) if "|" in program.text else ()
        # Core-guided search: supports of cr-rules are small, and to prove from above that none is
        # smaller can take a hundred times as long.
        better = ("--opt-strategy=usc",) if program.has_preferences else ()
        self._control = clingo.Control(
            ["--warn=no-atom-undefined", *safe, *better, *options],
            logger=_writer(self.messages),
            message_limit=50,
        )
        self._text = "\n".join((program.text, program.show if show is None else show, extra))
        self._places = program.places
        self.overflow: Overflow | None = None
        self._outcome: Outcome | None = None
        self._lost = False
        self.core: tuple[int, ...] = ()
        self._parts = 0

    @property
    def control(self) -> clingo.Control:
        """Returns clingo's own handle, for externals and for atoms."""
        return self._control

    def ground(self, deadline: float | None = None) -> None:
        """Loads and grounds the program.

        Raises `SolverError` when clingo refuses the text or runs out of memory, `NumberError` when a
        sum may leave 32 bits, `Abandoned` when ``deadline`` (`time.monotonic`) passes first.
        Afterwards ``overflow`` is the first operation whose result left them, None without one.
        """
        self._ground("base", self._text, deadline)

    def _ground(self, part: str, text: str, deadline: float | None) -> None:
        exact = None
        if "@" in text:
            from sparc.solving.exact_arithmetic import ExactArithmetic

            exact = ExactArithmetic()

        def work() -> None:
            self._control.add(part, [], text)
            self._control.ground([(part, [])], context=exact)

        try:
            in_thread(work, deadline)
        except RuntimeError as error:
            _out_of_memory(error)
            details = "; ".join(message for _, message in self.messages) or str(error)
            raise RefusedProgramError(details) from error
        except BaseException:
            if exact is not None:
                exact.abandoned = True
            raise
        if exact is not None:
            self.overflow = exact.overflow
            if exact.exceeded is not None:
                raise self._too_much(exact.exceeded)

    def extend(self, text: str, deadline: float | None = None) -> None:
        """Adds more rules, and grounds them; raises what `ground` raises."""
        self._parts += 1
        self._ground(f"more{self._parts}", text, deadline)

    def _too_much(self, sum_: Overflow) -> NumberError:
        """Returns the error that a sum may leave 32 bits."""
        return NumberError(
            f"this can add up to {sum_.value} and more, and clingo counts to {MAX_NUMBER}",
            self.place(sum_),
            "use smaller numbers, such as thousands for units, or fewer tuples",
        )

    def place(self, overflow: Overflow) -> Span | None:
        """Returns the place in the SPARC program of a result that did not fit; None when not known."""
        places = self._places
        return places[overflow.place] if overflow.place < len(places) else None

    def models(
        self,
        *,
        limit: int = 0,
        assumptions: Sequence[tuple[clingo.Symbol, bool] | int] = (),
        deadline: float | None = None,
        optimize: bool | None = None,
        conflicts: int | None = None,
    ) -> Iterator[clingo.Model]:
        """Yields each model as it is found, at most ``limit`` (0: all).

        `outcome` tells how it ended.

        ``optimize`` False leaves the program's preferences aside; True gives each better model
        up to an optimal one; None keeps what the options say. ``conflicts`` ends the search after
        so many, wherever it is.  ``assumptions`` are atoms with their truth, or literals of clingo's;
        where they leave no model, ``core`` has those literals among them that do so already.

        The search is stopped when the iterator is closed, at the ``deadline`` and by Ctrl-C.
        """
        start = time.monotonic()
        self._outcome = Outcome(Satisfiability.UNKNOWN, 0, 0.0, False)
        if self._lost:
            return
        self._limit_search(limit, conflicts, optimize)
        self._outcome = None
        count = 0
        in_time = True
        try:
            begun = self._begin(list(assumptions), deadline)
            if begun is None:
                seconds = time.monotonic() - start
                self._outcome = Outcome(Satisfiability.UNKNOWN, 0, seconds, False)
                return
            with held(begun) as handle:
                while True:
                    handle.resume()
                    in_time = _wait(handle, deadline)
                    if not in_time:
                        handle.cancel()
                        break
                    model = handle.model()
                    if model is None:
                        break
                    count += 1
                    yield model
                result = handle.get()
                if result.unsatisfiable:
                    self.core = tuple(handle.core())
        except RuntimeError as error:
            _out_of_memory(error)
            raise
        satisfiability = Satisfiability.UNKNOWN
        if count or result.satisfiable:
            satisfiability = Satisfiability.SATISFIABLE
        elif result.unsatisfiable:
            satisfiability = Satisfiability.UNSATISFIABLE
        self._outcome = Outcome(
            satisfiability, count, time.monotonic() - start, bool(result.exhausted) and in_time
        )

    def _limit_search(self, models: int, conflicts: int | None, optimize: bool | None) -> None:
        """Sets how many models and conflicts the next search may have, and its preferences."""
        settings = self._control.configuration.solve
        settings.models = models  # type: ignore[union-attr]
        limits = "umax,umax" if conflicts is None else f"{conflicts},umax"
        settings.solve_limit = limits  # type: ignore[union-attr]
        if optimize is not None:
            settings.opt_mode = "opt" if optimize else "ignore"  # type: ignore[union-attr]

    def _begin(
        self, assumptions: list[tuple[clingo.Symbol, bool] | int], deadline: float | None
    ) -> clingo.SolveHandle | None:
        """Begins a search; returns None where the deadline passed first, and none can follow it.

        clingo prepares the search before it returns, which can take longer than grounding.
        """
        begun: list[clingo.SolveHandle] = []
        abandoned = threading.Event()
        deciding = threading.Lock()

        def begin() -> None:
            handle = self._control.solve(assumptions=assumptions, yield_=True, async_=True)
            with deciding:
                if not abandoned.is_set():
                    begun.append(handle)
                    return
            with handle:  # closed here: nobody else will, and clingo does not survive it left open
                handle.cancel()

        try:
            in_thread(begin, deadline)
        except Abandoned:
            with deciding:
                abandoned.set()
            for handle in begun:
                with handle:
                    handle.cancel()
            self._lost = True
            return None
        return begun[0]

    @property
    def outcome(self) -> Outcome:
        """Returns how the last search ended; ask after its models were read to the end."""
        if self._outcome is None:
            raise SolverError("no search has ended yet")
        return self._outcome

    def answer_sets(self, *, limit: int = 0, deadline: float | None = None) -> Iterator[AnswerSet]:
        """Yields the shown literals of each model, as values."""
        for model in self.models(limit=limit, deadline=deadline):
            yield AnswerSet(
                frozenset(ground_literal(symbol) for symbol in model.symbols(shown=True)),
                tuple(model.cost),
            )


def _wait(handle: clingo.SolveHandle, deadline: float | None) -> bool:
    """Waits for the next model, or the end of the search; returns whether it came by the deadline."""
    while True:
        left = POLL if deadline is None else max(0.0, min(POLL, deadline - time.monotonic()))
        if handle.wait(left):
            return True
        if deadline is not None and time.monotonic() >= deadline:
            return False


def ground_literal(symbol: clingo.Symbol) -> GroundLiteral:
    """Returns the literal that a clingo symbol stands for."""
    return GroundLiteral(
        symbol.name, tuple(_ground(argument) for argument in symbol.arguments), symbol.negative
    )


def _writer(messages: list[tuple[str, str]]) -> Callable[[clingo.MessageCode, str], None]:
    """Returns a logger that keeps what clingo says.

    It knows nothing of the `Grounding`: that goes as soon as nobody needs it, with clingo's memory.
    """

    def write(code: clingo.MessageCode, message: str) -> None:
        messages.append((code.name, message))

    return write


def _ground(symbol: clingo.Symbol) -> Ground:
    if symbol.type is clingo.SymbolType.Number:
        return symbol.number
    return GroundTerm(symbol.name, tuple(_ground(argument) for argument in symbol.arguments))
