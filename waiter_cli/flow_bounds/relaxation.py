"""The programme with its cuts, solved until no cut is missing: what no plan can fall short of.

Entry point `FlowRelaxation`.  Rounds go: solve, look for cuts, add them.  Cuts are looked for between
the solution and the average of those before, which cuts deeper and in far fewer rounds than the
solution alone (Ben-Ameur and Neto: in-out separation); where none is missing there, at the solution.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from waiter_cli.flow_bounds.connectivity import FlowCut, Separator, row_of
from waiter_cli.flow_bounds.exact import bound_of, rounded, steps_of
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.programme import Programme

__all__ = ["FlowRelaxation"]

_IN = 0.8
"""How far from the solution, towards the average, cuts are looked for first."""
_OLD = 0.8
"""What the average keeps of itself at each round."""
_WHOLE = 1e-6


class FlowRelaxation:
    """The programme of a graph; ``bound`` is proved, ``prices`` prove it (in units of `exact`)."""

    def __init__(self, layers: Layers, most: int) -> None:
        """``most``: what is proved holds of plans of up to so many steps."""
        self.layers, self.most = layers, most
        self.programme = Programme(layers)
        self.separator = Separator(layers)
        self.cuts: list[FlowCut] = []
        self.bound = 0
        self.units = 0
        self.prices: list[int] = []
        self.add([FlowCut(visit.inside, visit=k) for k, visit in enumerate(layers.visits)])

    def add(self, cuts: list[FlowCut]) -> None:
        """Adds cuts to the programme."""
        self.cuts += cuts
        self.programme.add([row_of(self.layers, cut) for cut in cuts])

    def solve(
        self,
        enough: int,
        deadline: float | None = None,
        tell: Callable[[int], None] = lambda bound: None,
    ) -> bool:
        """Adds cuts until none is missing, ``enough`` is proved, or the deadline.

        Returns whether none is missing. ``tell`` hears of every better bound.
        """
        programme, average = self.programme, None
        while True:
            if not programme.solve(deadline):
                return False
            if programme.value > self.bound - 1 + _WHOLE:  # the bound is what can be rounded up
                self.prove()
                tell(self.bound)
            if self.bound >= enough:
                return False
            values = programme.values
            average = values if average is None else _OLD * average + (1 - _OLD) * values
            cuts = self.separator.cuts((_IN * average + (1 - _IN) * values).tolist())
            known = set(self.cuts)
            cuts = [cut for cut in cuts if cut not in known]
            if not cuts:
                cuts = [cut for cut in self.separator.cuts(values.tolist()) if cut not in known]
            if not cuts:
                return True
            if deadline is not None and time.monotonic() > deadline:
                return False
            self.add(cuts)

    def prove(self) -> None:
        """Works out what the prices of the last solution prove."""
        programme = self.programme
        prices = rounded(programme.rows, programme.prices.tolist())
        units = bound_of(programme.costs, programme.rows, prices, self.most)
        if units > self.units:
            self.units, self.prices = units, prices
            self.bound = steps_of(units)

    @property
    def is_whole(self) -> bool:
        """Returns whether the last solution is a walk: no arc is walked a fraction of once."""
        values = self.programme.values
        return bool((abs(values - values.round()) < _WHOLE).all())
