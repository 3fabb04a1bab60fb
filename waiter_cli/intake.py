"""Names of files and values of options → `Problem`, `Layout`. Entry points `read_problem`, `read_layout_of`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.exits import Fault, InputError
from waiter_cli.layout import Layout, layout_warnings, read_layout_file
from waiter_cli.problem import Problem, pose_problem
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from waiter_cli.plan_reader import PlanDocument

__all__ = ["read_layout_of", "read_problem"]


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


def read_layout_of(document: PlanDocument) -> Layout:
    """The layout that a plan file names: a built-in, or a file of exactly that name.

    Raises `InputError` where there is none; a plan of a layout of one's own knows its name, not its file.
    """
    from waiter_cli.resources import built_in

    name = document.layout
    if name is None:
        raise InputError("which restaurant is this plan for?", "give --layout")
    if name in built_in("layout") or os.path.isfile(name):
        return read_layout_file(name, document.name)
    folders = ("", os.path.dirname(document.name))
    guesses = [os.path.join(folder, f"{name}.yaml") for folder in folders]
    guess = next((path for path in guesses if os.path.isfile(path)), "FILE.yaml")
    message = f"the plan is for the layout {name}, which is not built in"
    raise InputError(
        [Fault(Where(document.name), message, f"say which file it is: --layout {guess}")]
    )
