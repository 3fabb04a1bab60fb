"""The least length of a joint plan, best first. Entry point `LeastLength.ask`.

Lengths are asked for one after the other from the shortest on; what is out of reach for one waits for
the next, so nothing is looked at twice (A*, Hart, Nilsson and Raphael, 1968).  A step makes what is left
at most one less, so a state is first come to by a shortest way.  Of states that may still end in time
some go first that are farthest on, as they often come to a plan; then the others go layer by layer.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, TypeAlias

from waiter_cli.fleets.joint.joint_layers import Outcome
from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.joint.known_states import KnownStates
from waiter_cli.fleets.joint.steps_left import StepsLeft
from waiter_cli.fleets.tour_table import NEVER
from waiter_cli.model.plan import Plan

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Numbers

    Part: TypeAlias = tuple[Numbers, Numbers, Numbers]

__all__ = ["LeastLength"]

DIVED, DIVE = 12_000, 2_000
"""So many states are looked at first that are farthest on, and so many at a time."""
BATCH = 100_000
"""So many states are gone on from at a time afterwards."""
AHEAD = 6
"""For so many lengths more the steps that are left are worked out at once."""


class LeastLength:
    """States that were looked at, and those that wait: for each step parts of rows, lengths and parents.

    ``next``, the shortest length that is not refuted, is the one that is asked for.  A parent is the
    number of a row in the order in which they were looked at; -1 is the start's.
    """

    def __init__(self, states: JointStates, first: int) -> None:
        self.np, self.states, self.next = states.np, states, first
        self.known = KnownStates(states)
        self.ready: dict[int, list[Part]] = {}
        self.later: dict[int, list[Part]] = {}
        none = self.np.array([-1])
        self.later[0] = [(states.start(), none, none)]
        self._look_ahead(first)
        self.looked: list[tuple[Numbers, Numbers]] = []
        self.first = [0]  # the number of the first row of each part of those looked at

    def ask(self, most: int, deadline: float | None = None) -> Outcome:
        """Goes on about the length ``next``, which no plan falls short of, with ``most`` more states.

        ``next`` is one more where it is refuted.  ``deadline`` is of `time.monotonic`.
        """
        length, before = self.next, self.first[-1]
        self._make_ready(length)
        while self.left.whole and self.ready:
            late = deadline is not None and time.monotonic() > deadline
            if late or self.first[-1] - before > most:
                return Outcome(None, False, self.first[-1] - before)
            dives = self.first[-1] - before < DIVED
            step = max(self.ready) if dives else min(self.ready)
            plan = self._go_on(step, length, DIVE if dives else BATCH)
            if plan is not None:
                return Outcome(plan, False, self.first[-1] - before)
        self.next += self.left.whole
        return Outcome(None, self.left.whole, self.first[-1] - before)

    def _make_ready(self, length: int) -> None:
        """Moves what may end within ``length`` to what is ready."""
        if length > self.left.length:
            self._look_ahead(length)
        for step, parts in list(self.later.items()):
            self.later[step] = []
            for part in parts:
                self._put(step, *part, length)

    def _look_ahead(self, length: int) -> None:
        """Works out anew when what waits may end, right up to some greater length."""
        self.left = StepsLeft(self.states, length + AHEAD)
        if not self.left.whole:
            self.left = StepsLeft(self.states, length)
        for step, parts in self.later.items():
            self.later[step] = [
                (rows, step + self.left.least(rows), parents) for rows, _, parents in parts
            ]

    def _put(
        self, step: int, rows: Numbers, lengths: Numbers, parents: Numbers, length: int
    ) -> None:
        """Keeps states for now or for a greater length."""
        now = lengths <= length
        for queue, chosen in ((self.ready, now), (self.later, ~now)):
            if chosen.any():
                part = (rows[chosen], lengths[chosen], parents[chosen])
                queue.setdefault(step, []).append(part)

    def _go_on(self, step: int, length: int, most: int) -> Plan | None:
        """Goes on from ``most`` states of one step; returns a plan if one of them reaches the goals."""
        np = self.np
        rows, lengths, parents = (np.concatenate(column) for column in zip(*self.ready.pop(step)))
        if len(rows) > most:
            order = np.argsort(rows[:, -1], kind="stable")
            now, wait = order[:most], order[most:]
            self.ready[step] = [(rows[wait], lengths[wait], parents[wait])]
            rows, parents = rows[now], parents[now]
        fresh = self.known.fresh(rows, step)
        rows, parents = rows[fresh], parents[fresh]
        number = self.first[-1]
        self.looked.append((rows, parents))
        self.first.append(number + len(rows))
        done = np.nonzero(self.states.done(rows))[0]
        if len(done):
            return self._plan(number + int(done[rows[done, -1].argmin()]))
        after, source = self.states.following(rows, step, NEVER + step)
        self._keep(after, source + number, step + 1, length)
        return None

    def _keep(self, rows: Numbers, parents: Numbers, step: int, length: int) -> None:
        """Keeps the states after a step that are not known, each once."""
        new = self.known.unknown(rows, step)[0]
        rows, parents = rows[new], parents[new]
        self._put(step, rows, step + self.left.least(rows), parents, length)

    def _plan(self, number: int) -> Plan:
        """Returns the plan that leads to a state that was looked at."""
        from bisect import bisect_right

        rows = []
        while number >= 0:
            part = bisect_right(self.first, number) - 1
            states, parents = self.looked[part]
            at = number - self.first[part]
            rows.append([int(value) for value in states[at]])
            number = int(parents[at])
        return self.states.plan(rows[::-1])
