"""A situation, `Scenario`: what holds, what is observed, what is wanted, what happens later."""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import Where
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.state import Fact, Goal, Observation, State

__all__ = ["Scenario", "TimedEvent"]


@dataclass(frozen=True)
class TimedEvent:
    """Something that happens while a simulation runs; ``time`` in simulated seconds."""

    time: float
    observations: tuple[Observation, ...]
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Scenario:
    """A situation read against a layout: names are known, the state is possible in itself.

    ``state`` is what holds before the observations, completed from the layout.  ``goals`` is None
    where they are left out (serve everybody).  ``before`` holds pairs of goals.  ``guests`` come by
    chance while a simulation runs.  ``facts`` are literals of SPARC, for a domain of one's own.
    """

    name: str
    state: State
    observe: tuple[Observation, ...] = ()
    goals: tuple[Goal, ...] | None = None
    before: tuple[tuple[Goal, Goal], ...] = ()
    prefer: tuple[str, ...] = ()
    events: tuple[TimedEvent, ...] = ()
    instant_kitchen: bool = False
    guests: GuestModel | None = None
    facts: tuple[Fact, ...] = ()
    layout: str | None = None
    file: str = ""
    state_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)
