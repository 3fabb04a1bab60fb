"""The words of the graph: its modes, the deeds that change them, rows over its arcs.

A mode is what matters for what comes next:

* *phase*: no plate can be taken up yet, since nothing was ordered (`ASKING`); something may still
  have to be sent (`SENDING`); the last visit of the bar for that is behind (`SENT`);
* *taken*: which of a few tracked orders were taken (the others are not told apart);
* *lead*: nobody follows (`ALONE`), a party fetched at the entrance (`FETCHED`), the one of step 0 (`LED`);
* *hands*: free, or carrying something empty or full to certain nodes.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.flow_bounds.ordered_jobs import Nodes

__all__ = [
    "ALONE",
    "ASKING",
    "Deed",
    "FETCHED",
    "FREE",
    "FlowRow",
    "Key",
    "LED",
    "Mode",
    "SENDING",
    "SENT",
    "TakeUp",
    "VisitSet",
]

ASKING, SENDING, SENT = range(3)
ALONE, FETCHED, LED = range(3)
FREE: tuple[str, Nodes] = ("free", ())

Key = tuple[object, ...]
"""The name of a deed: its kind and what it is about."""
TakeUp = tuple[str, Nodes, bool, int]
"""The key of taking something up: where it goes, whether it was ordered here, by which tracked order."""


@dataclass(frozen=True)
class Mode:
    """All that matters for what comes next; ``hands`` is ``free``, ``empty`` or ``full`` and where it goes."""

    phase: int
    taken: frozenset[int]
    lead: int
    hands: tuple[str, Nodes]

    def but(self, **changed: object) -> Mode:
        """Returns the mode with something changed."""
        fields = {"phase": self.phase, "taken": self.taken, "lead": self.lead, "hands": self.hands}
        return Mode(**{**fields, **changed})  # type: ignore[arg-type]


@dataclass(frozen=True)
class Deed:
    """A change of mode that is possible at ``nodes``."""

    key: Key
    nodes: Nodes
    mode: Mode


@dataclass(frozen=True)
class FlowRow:
    """The sum of coefficient times column lies between ``low`` and ``high`` (None: no bound)."""

    low: int | None
    high: int | None
    columns: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class VisitSet:
    """A set of nodes of the graph, one of which every plan is at."""

    inside: frozenset[int]
