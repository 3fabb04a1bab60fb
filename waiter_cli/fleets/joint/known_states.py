"""Joint states that were looked at already, and those that are no better. Entry point `KnownStates.fresh`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from waiter_cli.fleets.joint.joint_states import JointStates

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Flags, Numbers

__all__ = ["KnownStates"]


class KnownStates:
    """Keys of states, in sorted parts each at least twice as long as the next.

    Once colleagues stand still, whoever is somewhere at a step could have waited there; so a state
    known at an earlier step need not be looked at again.  Before that, states are known a step each.
    """

    def __init__(self, states: JointStates) -> None:
        self.np, self.states = states.np, states
        self._parts: dict[int, list[Numbers]] = {}

    def fresh(self, rows: Numbers, step: int) -> Numbers:
        """Returns the numbers of rows that are new at a step and unlike each other; from now on they are known.

        None of them is left out but for an equal one, or for one of the same step with one job more
        done: such a one of another step may have been come to later.
        """
        first, keys = self.unknown(rows, step)
        if not self.states.fits:
            return first
        parts = self._parts.setdefault(min(step, self.states.last), [])
        behind: Flags = self.np.zeros(len(keys), dtype=bool)
        for open_, better in self.states.with_one_more_done(keys):
            behind[open_] |= self._among([keys], better)
        first, keys = first[~behind], keys[~behind]
        self._add(parts, keys)
        return first

    def unknown(self, rows: Numbers, step: int) -> tuple[Numbers, Numbers]:
        """Returns the numbers of rows that are not known and unlike each other, and their keys in order.

        Where states have no keys, none is known, and the keys are the numbers.
        """
        if not self.states.fits:
            unlike: Numbers = self.np.unique(rows[:, :-1], axis=0, return_index=True)[1]
            return unlike, unlike
        first, keys = self.states.different(rows)
        new = ~self._among(self._parts.get(min(step, self.states.last), []), keys)
        return first[new], keys[new]

    def _among(self, parts: list[Numbers], keys: Numbers) -> Flags:
        np = self.np
        found: Flags = np.zeros(len(keys), dtype=bool)
        for part in parts:
            if len(part):
                at = np.minimum(np.searchsorted(part, keys), len(part) - 1)
                found |= part[at] == keys
        return found

    def _add(self, parts: list[Numbers], keys: Numbers) -> None:
        while parts and len(parts[-1]) < 2 * len(keys):
            keys = self.np.sort(self.np.concatenate([parts.pop(), keys]), kind="stable")
        parts.append(keys)
