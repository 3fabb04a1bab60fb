"""Names of files and values of options → `Problem`. Entry point `read_problem`."""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.exits import Fault, InputError
from waiter_cli.layout import layout_warnings, read_layout_file
from waiter_cli.problem import Problem, pose_problem

__all__ = ["read_problem"]


def read_problem(
    layout: str | None,
    scenario: str | None,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
) -> tuple[Problem, tuple[Fault, ...]]:
    """The problem that a command line poses, and what looks wrong with its layout.

    ``layout`` and ``scenario`` are paths, built-in names or ``-``; the layout may be left out where
    the scenario names one.  Raises `InputError` with every fault of the files and options.
    """
    from waiter_cli.scenario import read_scenario_file

    if layout is None and scenario is None:
        raise InputError("which restaurant?", "give --layout, or a --scenario that names one")
    if layout == "-" and scenario == "-":
        raise InputError(
            "layout and scenario cannot both come from standard input", "name a file for one"
        )
    given = None if layout is None else read_layout_file(layout)
    found = None
    if scenario is not None:
        given, found = read_scenario_file(scenario, given)
    assert given is not None
    return pose_problem(given, found, enter, bills, goals), layout_warnings(given)
