"""Bounds from a programme over a graph of modes and places: the last resort where others do not meet.

Entry point `tighten`: `Problem`, `Bounds` → `Bounds`.  `ordered_jobs` says what every plan must do,
`layer_builder` makes the graph that plans are walks through (on a floor that `contraction` made smaller),
`programme` asks HiGHS for the cheapest flow through it, `connectivity` (by `least_cuts`) finds what that flow cheats
with, `branching` divides what is left open, `exact_bound` works out in whole numbers what is proved, and
`walk_reading` reads a plan off it.  A plan is a walk through the graph, and a walk is a flow: so the bound is too low or right, never
too high.  docs/planning.md explains it with a picture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from waiter_cli.bounds import Bounds
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.flow_bounds.closing import Closing

__all__ = ["is_available", "load", "make_closing", "tighten"]


def is_available() -> bool:
    """Returns whether HiGHS is installed; does not import it."""
    from importlib.util import find_spec

    return find_spec("highspy") is not None


def load() -> None:
    """Loads HiGHS, where it is installed, so that what comes next need not wait for it."""
    if is_available():
        from waiter_cli.flow_bounds.programme import load_highs

        load_highs()


def make_closing(problem: Problem, bounds: Bounds) -> Closing | None:
    """Returns the programme of a problem, None where there is nothing to gain or HiGHS is missing."""
    plan = bounds.plan
    met = plan is not None and bounds.lower >= plan.horizon
    several = bool(problem.layout.agents)
    if bounds.impossible or plan is None or met or several or not is_available():
        return None
    from waiter_cli.flow_bounds.closing import Closing

    return Closing(problem, bounds)


def tighten(
    problem: Problem,
    bounds: Bounds,
    *,
    deadline: float | None = None,
    tell: Callable[[int, int], None] = lambda lower, upper: None,
) -> Bounds:
    """Returns better bounds where the programme finds any; the same where it does not.

    ``deadline`` (of `time.monotonic`) ends it; ``tell`` hears of every better pair of bounds.
    """
    closing = make_closing(problem, bounds)
    if closing is None:
        return bounds
    closing.run(deadline, tell)
    return replace(bounds, lower=closing.lower, plan=closing.plan)
