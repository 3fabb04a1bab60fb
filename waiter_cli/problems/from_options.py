"""Names of files and values of options → `Problem`, `Layout`. Entry points `read_problem`, `read_layout_of`, `domain_of`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.files.layout_reader import layout_in, read_layout_file
from waiter_cli.model.graph import layout_warnings
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.files.plan_reader import PlanDocument

__all__ = ["domain_of", "read_layout_of", "read_problem", "what_changed"]


def read_problem(
    layout: str | None,
    scenario: str | None,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
    seen: Sequence[str] = (),
    *,
    several: bool = False,
) -> tuple[Problem, tuple[Fault, ...]]:
    """Returns the problem that a command line poses, and what looks wrong with its layout.

    ``layout`` and ``scenario`` are paths, built-in names or ``-``; the layout may be left out where
    the scenario names one; unless ``several`` is true, it has one robot.  Raises `InputError` with every fault of the files and options.
    """
    from waiter_cli.files.scenario_reader import read_scenario_file

    if layout is None and scenario is None:
        raise InputError("which restaurant?", "give --layout, or a --scenario that names one")
    if layout == "-" and scenario == "-":
        raise InputError(
            "layout and scenario cannot both come from standard input", "name a file for one"
        )
    given = None if layout is None else read_layout_file(layout, several=several)
    found = None
    if scenario is not None:
        given, found = read_scenario_file(scenario, given, several=several)
    assert given is not None
    return pose_problem(given, found, enter, bills, goals, seen), layout_warnings(given)


def read_layout_of(document: PlanDocument) -> Layout:
    """Returns the layout that a plan file remembers: the file, or a built-in, or a file of exactly its name.

    Raises `InputError` where there is none, and where its text is not the one the plan was made for.
    """
    from waiter_cli.file_access.locate import BuiltIn, built_in, read_text
    from waiter_cli.files.plan_origin import find_again

    name, memory = document.layout, document.layout_file
    if memory is not None and memory.path is not None:
        return layout_in(find_again(memory, "layout"), several=True)
    if name is None:
        raise InputError("which restaurant is this plan for?", "give --layout")
    if name in built_in("layout") or os.path.isfile(name):
        shipped = memory is not None and name in built_in("layout")  # a file has a path in the plan
        place = Where(document.name)
        file = read_text(BuiltIn(name) if shipped else name, "layout", where=place)
        layout = layout_in(file, place, several=True)
        if not _is_remembered(document, layout):
            message = f"the plan was made for another layout called {name}, or an older one"
            hint = f"give the file, or --layout {name} to take it as it is now"
            raise InputError([Fault(Where(document.name), message, hint)])
        return layout
    folders = ("", os.path.dirname(document.name))
    guesses = [os.path.join(folder, f"{name}.yaml") for folder in folders]
    guess = next((path for path in guesses if os.path.isfile(path)), "FILE.yaml")
    message = f"the plan is for the layout {name}, which is not built in"
    raise InputError(
        [Fault(Where(document.name), message, f"say which file it is: --layout {guess}")]
    )


def domain_of(document: PlanDocument) -> Domain:
    """Returns the domain that a plan was made with: the file it remembers, or the built-in of its name.

    Raises `InputError` where it is not there, or has changed.
    """
    from waiter_cli.encoding.domains import domain_in, find_domain, require_plans
    from waiter_cli.file_access.locate import BuiltIn
    from waiter_cli.files.plan_origin import find_again

    assert document.domain is not None
    memory = document.domain_file
    if memory is not None and memory.path is not None:
        return require_plans(domain_in(find_again(memory, "domain"), document.domain))
    return require_plans(find_domain(BuiltIn(document.domain)))


def what_changed(document: PlanDocument, layout: Layout) -> tuple[str, ...]:
    """Returns a sentence for each of layout and domain that has changed since the plan was made."""
    changes = []
    if document.layout not in (None, layout.name):
        changes.append(f"the plan was made for the layout {document.layout}, not {layout.name}")
    elif not _is_remembered(document, layout):
        changes.append(f"the layout {layout.file} has changed since the plan was made")
    memory = document.domain_file
    if memory is not None:
        from waiter_cli.files.plan_origin import has_changed

        if has_changed(memory):
            changes.append(f"the domain {memory.path} has changed since the plan was made")
    return tuple(changes)


def _is_remembered(document: PlanDocument, layout: Layout) -> bool:
    """Returns whether the layout is the one the plan was made for, as far as the plan remembers it."""
    if document.layout_file is None or layout.origin is None:
        return True
    from waiter_cli.files.plan_origin import is_same

    return is_same(document.layout_file, layout.origin.text)
