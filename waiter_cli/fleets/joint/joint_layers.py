"""Joint plans of several robots for one length, step after step. Entry point `JointLayers.search`.

All that the robots can be and have done after so many steps is a layer.  A joint state stays in it
while some deal of what is left keeps all tours within the length (`Deals`).  No state that can still
reach the goals in time is left out, so a layer without any is a proof that no plan has that length.
Where a layer grows too large only the most promising states go on (beam search, Lowerre, 1976), which
proves nothing.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.joint.known_states import KnownStates
from waiter_cli.fleets.joint.steps_left import StepsLeft
from waiter_cli.model.plan import Plan

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Numbers

__all__ = ["JointLayers", "Outcome"]


@dataclass(frozen=True)
class Outcome:
    """``plan`` is one of that length at most; without one, ``refuted`` says that there is none.

    ``states`` is how many states were looked at.
    """

    plan: Plan | None
    refuted: bool
    states: int


class JointLayers:
    """The layers of one problem."""

    def __init__(self, states: JointStates) -> None:
        self.np, self.states = states.np, states
        self.rng = self.np.random.default_rng(1)

    def search(
        self, length: int, width: int, deadline: float | None = None, beam: bool = True
    ) -> Outcome:
        """Looks for a plan of ``length`` steps at most, with ``width`` states a layer.

        It ends at the first larger layer unless it is a ``beam``.  ``deadline`` is of `time.monotonic`.
        """
        np, states, steps_left = self.np, self.states, StepsLeft(self.states, length)
        whole = steps_left.whole
        if steps_left.none:
            return Outcome(None, whole, 0)
        layer, known = states.start(), KnownStates(states)
        layers, parents, looked = [layer], [np.zeros(1, dtype=int)], 1
        for step in range(length + 1):
            done = np.nonzero(states.done(layer))[0]
            if len(done):
                at = int(done[layer[done, -1].argmin()])
                return Outcome(self._plan(layers, parents, at), False, looked)
            late = deadline is not None and time.monotonic() > deadline
            if step == length or late:
                return Outcome(None, whole and not late, looked)
            layer, parent = states.following(layer, step, length)
            fresh = known.fresh(layer, step + 1)
            layer, parent = layer[fresh], parent[fresh]
            left, total = steps_left.least_and_total(layer)
            keep = np.nonzero(left < length - step)[0]
            looked += len(keep)
            if len(keep) > width:
                if not beam:
                    return Outcome(None, False, looked)
                keep, whole = keep[self._spread(layer[keep], left[keep], total[keep], width)], False
            layer, parent = layer[keep], parent[keep]
            layers.append(layer)
            parents.append(parent)
            if not len(layer):
                break
        return Outcome(None, whole, looked)

    def _spread(self, layer: Numbers, least: Numbers, total: Numbers, width: int) -> Numbers:
        """Returns which states go on: of every number of steps left as many.

        Where only the best went on, all would lie before the same narrow place and none behind it.
        """
        np = self.np
        order = np.lexsort((self.rng.random(len(layer)), layer[:, -1], total, least))
        first = np.unique(least[order], return_index=True)[1]
        rank = np.concatenate([np.arange(len(group)) for group in np.split(order, first[1:])])
        found: Numbers = order[np.argsort(rank, kind="stable")[:width]]
        return found

    def _plan(self, layers: list[Numbers], parents: list[Numbers], at: int) -> Plan:
        """Returns the plan that leads to a state of the last layer."""
        rows = []
        for layer, parent in zip(reversed(layers), reversed(parents)):
            rows.append([int(value) for value in layer[at]])
            at = int(parent[at])
        return self.states.plan(rows[::-1])
