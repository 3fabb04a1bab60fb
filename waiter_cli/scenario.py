"""YAML text → `Scenario`: the situation, what is observed, what is wanted.

Entry points `read_scenario`, and `read_scenario_file`, which finds the layout too.
"""

from __future__ import annotations

from sparc.values import dataclass, field
from waiter_cli.layout import Layout
from waiter_cli.situation import Goal, Observation, State, Where

__all__ = ["Scenario", "TimedEvent", "read_scenario", "read_scenario_file"]


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


def read_scenario(text: str, name: str, layout: Layout) -> Scenario:
    """The scenario that a YAML text describes, read against a layout.

    Its own ``layout`` key is kept and not followed.  Raises `LayoutError` with every fault that
    was found, each with its line and column.
    """
    from waiter_cli.scenario_reader import read

    return read(text, name, layout)


def read_scenario_file(name: str, layout: Layout | None = None) -> tuple[Layout, Scenario]:
    """The scenario of a file, a built-in name such as ``b1`` or standard input (``-``), and its layout.

    A layout that is given wins over the one that the scenario names (a path from the scenario's
    own file, or a built-in).  Raises `LayoutError` as `read_scenario` and `read_layout` do, and
    where there is no such file or no layout at all.
    """
    from waiter_cli.scenario_reader import read_file

    return read_file(name, layout)
