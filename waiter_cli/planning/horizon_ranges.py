"""Asks for plans of a range of horizons at once, in one grounding; cores say which are excluded.

Of a domain that need not be monotone, each horizon is a program of its own.  In the program with an open
horizon, "the last step is at least this one" and "at most that one" are two assumptions.  Where they
leave no answer set, the core says which of the two was needed: without the second, no longer horizon
of the grounding has a plan either.  Entry point `HorizonRanges`.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from waiter_cli.model.plan import Action, Plan
from waiter_cli.planning.open_horizon import OpenHorizon, with_open_horizon
from waiter_cli.planning.prober import LimitReached, Prober
from waiter_cli.planning.search_results import Probe

if TYPE_CHECKING:
    from collections.abc import Sequence

    import clingo

__all__ = ["HorizonRanges"]

# The goals hold at some step of the plan, whichever is the last.
_REACHED = """
#defined goal/1.
__by(D) :- goal(I), D = I..{horizon}.
:- not __by({horizon}).
"""
_SHOW = "#show occurs/2. #show {step}/1."


class HorizonRanges(Prober):
    """A prober that asks for a range of horizons."""

    opened: OpenHorizon | None = None

    def ground_open(self, horizon: int) -> bool:
        """Grounds for every horizon up to ``horizon``; returns whether the program is of the form."""
        from sparc.solving.clingo_solver import Grounding
        from sparc.solving.clingo_threads import Abandoned

        longer = self.translate(horizon + 1)
        self.opened = with_open_horizon(self.translate(horizon), longer, horizon)
        if self.opened is None:
            return False
        since = time.monotonic()
        grounding = Grounding(
            self.opened.program,
            show=_SHOW.format(step=self.opened.step),
            extra=_REACHED.format(horizon=horizon) + self.demand,
        )
        try:
            grounding.ground(self.deadline)
        except Abandoned:
            raise LimitReached("time") from None
        self.grounding, self.horizon = grounding, horizon
        self.stage("ground", f"horizons 0 to {horizon}", since)
        return True

    def ask_range(self, first: int, last: int) -> bool:
        """Returns whether there is a plan of ``first`` to ``last`` steps; all shorter ones are refuted.

        What is refuted raises the lower bound: by all of the grounding's horizons, if ``last`` was not
        needed for it.
        """
        from sparc.solving.clingo_solver import Satisfiability

        assert self.grounding is not None and self.opened is not None
        since = time.monotonic()
        wanted = [(self.opened.reached(first), True)]
        if last < self.horizon:
            wanted.append((self.opened.reached(last + 1), False))
        for model in self.grounding.models(
            limit=1, assumptions=wanted, deadline=self.deadline, optimize=False
        ):
            self.best = self.all_of(model.symbols(shown=True))
        result = self.grounding.outcome.satisfiability
        if result is Satisfiability.UNKNOWN:
            self.stage("solve", f"horizons {first} to {last}: unknown", since)
            self.probes.append(Probe(last, result.value, round(time.monotonic() - since, 6)))
            raise LimitReached("time")
        has_plan = result is Satisfiability.SATISFIABLE
        if not has_plan and last < self.horizon and self.needs_no_end(wanted[1]):
            last = self.horizon
        self.stage("solve", f"horizons {first} to {last}: {result.value}", since)
        seconds = round(time.monotonic() - since, 6)
        if has_plan:
            assert self.best is not None
            self.probes.append(Probe(self.best.horizon, result.value, seconds))
        else:
            self.probes.append(Probe(last, result.value, seconds))
            self.lower, self.bound_proof = last + 1, False
        return has_plan

    def needs_no_end(self, end: tuple[clingo.Symbol, bool]) -> bool:
        """Returns whether the last core does without the assumption on the last step."""
        assert self.grounding is not None
        atom = self.grounding.control.symbolic_atoms[end[0]]
        return atom is not None and -atom.literal not in self.grounding.core

    def all_of(self, symbols: Sequence[clingo.Symbol]) -> Plan:
        """Returns the plan of a model, up to its last step: what happens then may have to."""
        assert self.opened is not None
        horizon = max(
            (s.arguments[0].number for s in symbols if s.name == self.opened.step), default=0
        )
        actions = []
        for symbol in symbols:
            if symbol.name == "occurs" and symbol.positive and symbol.arguments[1].number < horizon:
                term, step = symbol.arguments
                actions.append(Action(step.number, term.name, tuple(map(str, term.arguments))))
        return Plan(tuple(sorted(actions, key=lambda action: action.step)), horizon)
