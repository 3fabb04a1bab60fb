"""The programme with its cuts, solved until no cut is missing: what no plan can fall short of.

Entry point `FlowRelaxation`.  Rounds go: solve, look for cuts, add them.  At first they are looked for
in the middle of all the best solutions (`approach`): what cuts that off cuts off most of them, so few
rounds do.  Then (`solve`) between a corner and the average of the corners before, which cuts deeper
than the corner alone (Ben-Ameur and Neto: in-out separation); where none is missing there, at the
corner.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from waiter_cli.flow_bounds.connectivity import FlowCut, Separator, row_of
from waiter_cli.flow_bounds.exact_bound import UNIT, lean_of, rounded, steps_of
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.modes import FlowRow
from waiter_cli.flow_bounds.programme import CORNER, INSIDE, THROUGH, Programme

if TYPE_CHECKING:
    from waiter_cli.flow_bounds.exact_bound import Whole
    from waiter_cli.flow_bounds.programme import Floats

__all__ = ["FlowRelaxation"]

_IN = 0.8
"""How far from the solution, towards the average, cuts are looked for first."""
_OLD = 0.8
"""What the average keeps of itself at each round."""
_LITTLE = 1e-4
_GAIN = {CORNER: _LITTLE, INSIDE: 0.1}
"""A round that gains less than this has gained nothing."""
_PATIENCE = {CORNER: 15, INSIDE: 3}
"""After so many rounds that gain nothing it is time to look for a plan."""
_NO_PRICE = {CORNER: 1e-9, INSIDE: 1e-5}
"""What is less than this is no price."""
_TIDY = 3
"""After so many rounds, cuts without a price are taken out."""
_WHOLE = 1e-6


class FlowRelaxation:
    """The programme of a graph; ``bound`` is proved, by ``prices`` (in units of `exact_bound`).

    The prices are those of the rows of the graph, then of the cuts in ``proof``.
    """

    def __init__(self, layers: Layers, most: int, *, fixes: bool = False) -> None:
        """``most``: what is proved holds of plans of up to so many steps.

        With ``fixes``, columns that no plan below what is enough uses are left out.
        """
        self.layers, self.most, self.fixes = layers, most, fixes
        self.programme = Programme(layers)
        self.separator = Separator(layers)
        self.cuts: list[FlowCut | FlowRow] = []
        self.refuted = False
        self.case = 0  # what the last solution proves, of the case that was solved
        self.bound = 0
        self.units = 0
        self.prices: list[int] = []
        self.proof: list[FlowCut] = []
        self.best = 0.0
        self.rose = False
        self.average: Floats | None = None
        self.add([FlowCut(visit.inside, visit=k) for k, visit in enumerate(layers.visits)])

    def add(self, cuts: list[FlowCut]) -> None:
        """Adds cuts to the programme."""
        self.cuts += cuts
        self.programme.add([row_of(self.layers, cut) for cut in cuts])

    def known(self) -> list[FlowCut]:
        """Returns the cuts that the programme has."""
        return [cut for cut in self.cuts if isinstance(cut, FlowCut)]

    def divide(
        self, columns: tuple[tuple[int, int], ...], low: int | None, high: int | None
    ) -> None:
        """Has the programme look at those flows alone in which a sum of columns is in a range."""
        if columns not in self.programme.kept:
            self.cuts.append(FlowRow(None, None, columns))  # in its place among the rows
        self.programme.between(columns, low, high)

    def approach(
        self,
        enough: int,
        deadline: float | None = None,
        tell: Callable[[int], None] = lambda bound: None,
        patience: int | None = None,
    ) -> bool:
        """Solves as `solve` does, in the middle of all the best solutions as long as that helps.

        ``patience``: so many rounds that gain nothing end it (None: as many as is usual).  It ends at a corner, where plans are read off, and returns whether no cut is missing there.
        """
        done = self.solve(enough, deadline, tell, way=INSIDE, patience=patience)
        self.average = None
        if not self.refuted:
            self.programme.solve(deadline, THROUGH)
        return done

    def solve(
        self,
        enough: int,
        deadline: float | None = None,
        tell: Callable[[int], None] = lambda bound: None,
        *,
        everywhere: bool = True,
        way: str = CORNER,
        patience: int | None = None,
    ) -> bool:
        """Adds cuts until none is missing, ``enough`` is proved, little comes of it, or the deadline.

        Returns whether none is missing. ``tell`` hears of every better bound. ``refuted`` says
        whether ``enough`` was proved: of all plans, or of those within the rows that `branching`
        added, where not ``everywhere``.  ``way``: see `Programme.solve`.
        """
        programme = self.programme
        patience = _PATIENCE[way] if patience is None else patience
        rounds = idle = 0
        self.refuted = False
        while idle < patience:
            solved = programme.solve(deadline, way)
            if solved is False and self.fixes:
                self.refute(enough, everywhere)
                tell(self.bound)
            if not solved:
                return False
            rounds, idle = rounds + 1, idle + 1
            if programme.value > self.best + _GAIN[way]:
                idle = 0
            if programme.value > self.best + _LITTLE:
                self.best, self.rose = programme.value, True
            rises = programme.value > self.bound - 1 + _WHOLE  # the bound is what can be rounded up
            if rises or not everywhere:
                self.refuted = self.prove(enough, everywhere)
                tell(self.bound)
            if self.refuted:
                return False
            cuts = self.missing()
            if not cuts:
                return True
            if deadline is not None and time.monotonic() > deadline:
                return False
            tidy = self.rose or not everywhere  # or rounds could go in circles
            if tidy and rounds % _TIDY == 0:
                self.tidy(_NO_PRICE[way])
                self.rose = False
            self.add(cuts)
        return False

    def missing(self) -> list[FlowCut]:
        """Returns cuts that the last solution violates, or the average of those before with it."""
        values, average = self.programme.values, self.average
        average = values if average is None else _OLD * average + (1 - _OLD) * values
        self.average = average
        return self.new(_IN * average + (1 - _IN) * values) or self.new(values)

    def new(self, flow: Floats) -> list[FlowCut]:
        """Returns the cuts that a flow violates and that the programme does not have."""
        known = set(self.cuts)
        return [cut for cut in self.separator.cuts(flow.tolist()) if cut not in known]

    def tidy(self, price: float) -> None:
        """Takes out the cuts with less than this price."""
        base = len(self.layers.rows)
        self.cuts = [self.cuts[k - base] for k in self.programme.drop(base, price)]

    def repair(self, flow: list[float]) -> bool:
        """Adds the cuts that a flow violates; returns whether there are any."""
        cuts = self.new(self.programme.np.array(flow))
        self.add(cuts)
        return bool(cuts)

    def whole_flow(self, deadline: float) -> list[float] | None:
        """Returns a flow of whole numbers over arcs that the last solutions used, None without one.

        It may go round in circles apart from the start: it is read for a plan, and proves nothing.
        """
        values = self.programme.values
        if (abs(values - values.round()) < _WHOLE).all():
            return [float(value) for value in values.tolist()]
        both = values if self.average is None else values + self.average
        used = [k for k, value in enumerate(both.tolist()) if value > _WHOLE]
        return self.programme.whole(used, deadline)

    def prove(self, enough: int, everywhere: bool) -> bool:
        """Works out what the prices of the last solution prove; whether that is ``enough``.

        Where plans of fewer than ``enough`` steps are all that is looked for (``fixes``), columns
        that none of them uses are left out from now on.
        """
        programme = self.programme
        prices = rounded(programme.rows, programme.prices.tolist())
        total, lean = lean_of(programme.costs, programme.rows, prices)
        units = self._least(total, lean)
        if everywhere and units > self.units:
            self.units, self.prices, self.proof = units, prices, self.known()
            self.bound = steps_of(units)
        if everywhere and self.fixes:
            programme.close(lean > (enough - 1) * UNIT - units)
        self.case = steps_of(units)
        return self.case >= enough

    def refute(self, enough: int, everywhere: bool) -> None:
        """Works out whether the prices prove that there is no flow at all."""
        programme = self.programme
        for sign in (1, -1):
            prices = rounded(programme.rows, (sign * programme.prices).tolist())
            total, lean = lean_of(0 * programme.costs, programme.rows, prices)
            if self._least(total, lean) > 0:
                self.refuted = True
                if everywhere:
                    self.bound = max(self.bound, enough)

    def _least(self, total: int, lean: Whole) -> int:
        """Returns what a flow costs at least, of whose columns these are the costs beyond ``total``."""
        return total + self.most * sum(map(int, lean[(lean < 0) & ~self.programme.gone]))
