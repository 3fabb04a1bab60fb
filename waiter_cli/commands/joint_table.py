"""A plan of several robots on a terminal: a column for each, or a line a step. Entry point `joint_rows`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from waiter_cli.model.plan import Action

__all__ = ["fits", "joint_rows", "print_joint"]


def joint_rows(names: Sequence[str], actions: Iterable[Action]) -> list[tuple[str, ...]]:
    """Returns a row a step in which something is done: its number, then what each robot does, or ""."""
    steps: dict[int, dict[str, str]] = {}
    for action in actions:
        steps.setdefault(action.step, {})[action.arguments[0]] = action.text
    return [(str(k), *(done.get(name, "") for name in names)) for k, done in sorted(steps.items())]


def fits(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> bool:
    """Returns whether such a table fits the terminal of standard output."""
    import sys

    from waiter_cli.console.wrapping import cells, columns

    widths = [max(map(cells, column)) for column in zip(headings, *rows)]
    return sum(widths) + 2 * (len(headings) - 1) <= (columns(sys.stdout) or 80)


def print_joint(names: Sequence[str], actions: Iterable[Action]) -> None:
    """Prints what several robots do: a column for each where they fit, else a line a step."""
    from waiter_cli.console.output import print_table

    headings, rows = ("step", *names), joint_rows(names, actions)
    if fits(headings, rows):
        print_table(headings, rows)
    else:
        print_table(("step", "action"), [(k, "; ".join(filter(None, row))) for k, *row in rows])
