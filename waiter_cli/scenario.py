"""YAML text → `Scenario`: the situation, what is observed, what is wanted. Entry point `read_scenario`."""

from __future__ import annotations

from dataclasses import dataclass, field

from waiter_cli.situation import Goal, Observation, State, Where

__all__ = ["Scenario", "TimedEvent"]


@dataclass(frozen=True, slots=True)
class TimedEvent:
    """Something that happens while a simulation runs; ``time`` in simulated seconds."""

    time: float
    observations: tuple[Observation, ...]
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Scenario:
    """A situation read against a layout: names are known, the state is possible in itself.

    ``state`` is what holds before the observations, completed from the layout.  ``goals`` is None
    where they are left out (serve everybody).  ``before`` holds pairs of goals.
    """

    name: str
    state: State
    observe: tuple[Observation, ...] = ()
    goals: tuple[Goal, ...] | None = None
    before: tuple[tuple[Goal, Goal], ...] = ()
    prefer: tuple[str, ...] = ()
    events: tuple[TimedEvent, ...] = ()
    instant_kitchen: bool = False
    layout: str | None = None
    file: str = ""
    state_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)
