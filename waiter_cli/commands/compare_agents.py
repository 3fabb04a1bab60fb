"""``waiter compare LAYOUT --agents 1..4``: one restaurant with more and more robots, or fewer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from waiter_cli.layout_tools.measure import Measured, MeasuringPlanner
    from waiter_cli.model.layout import Layout

__all__ = ["compare_agents", "read_numbers"]

MOST = 10


def read_numbers(text: str) -> range:
    """Returns the numbers of robots that ``2`` or ``1..4`` stand for.

    Raises `InputError` for anything else.
    """
    from waiter_cli.errors import Fault, InputError, Where

    first, dots, last = text.partition("..")
    ends = [part.strip() for part in ((first, last) if dots else (first, first))]
    if all(part.isascii() and part.isdigit() and len(part) < 4 for part in ends):
        low, high = map(int, ends)
        if 1 <= low <= high <= MOST:
            return range(low, high + 1)
    message = f"numbers of robots from 1 to {MOST}, found {text[:40] or 'nothing'}"
    raise InputError([Fault(Where("--agents"), message, "for example: --agents 1..4")])


def compare_agents(
    layout: Layout,
    scenarios: Sequence[str],
    numbers: range,
    time_limit: float,
    planner: MeasuringPlanner,
    *,
    as_json: bool,
) -> int:
    """Plans every scenario with each number of robots, prints the figures, and returns the exit code."""
    from waiter_cli.console.progress import alive
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.fleets.enlarge import with_robots
    from waiter_cli.layout_tools.measure import TIES, Measured, measure, pose_all
    from waiter_cli.model.wording import counted

    rows: list[list[Measured]] = []
    with alive("planning") as note:
        for name, problem in zip(scenarios, pose_all(layout, scenarios), strict=True):
            if isinstance(problem, Measured):
                rows.append([problem] * len(numbers))
                continue
            row = []
            for count in numbers:
                note(f"{name}, {counted(count, 'robot')}")
                row.append(measure(with_robots(problem, count), time_limit, TIES, planner))
            rows.append(row)
    if all(row[0].status == "no_fit" for row in rows):
        raise InputError(f"no scenario fits the layout; {rows[0][0].message}", "name another one")
    if as_json:
        from waiter_cli.console.output import print_json

        print_json(_document(layout, numbers, rows))
    else:
        _print(layout, numbers, rows)
    undecided = any(one.status == "undecided" for row in rows for one in row)
    return Exit.UNDECIDED if undecided else Exit.OK


def _document(layout: Layout, numbers: range, rows: list[list[Measured]]) -> dict[str, Any]:
    return {
        "status": "compared",
        "layouts": [{"name": layout.name, "file": layout.file}],
        "agents": list(numbers),
        "scenarios": [
            {
                "scenario": row[0].scenario,
                "file": row[0].file,
                "results": [one.document() for one in row],
            }
            for row in rows
        ],
    }


def _print(layout: Layout, numbers: range, rows: list[list[Measured]]) -> None:
    from waiter_cli.console.output import print_table, say

    say(f"{layout.name} ({layout.file})")
    lines = []
    for row in rows:
        before: int | None = None
        for count, one in zip(numbers, row):
            if one.plan is None:
                lines.append(
                    (row[0].scenario, str(count), one.status.replace("_", " "), "", "", "")
                )
                continue
            steps = f"{one.steps}{'' if one.minimal else '?'}"
            saved = "" if before is None or not before else f"{(one.steps - before) / before:+.0%}"
            waits = sum(one.waits) / len(one.waits) if one.waits else 0.0
            lines.append(
                (row[0].scenario, str(count), steps, saved, f"{one.metres:.2f}", f"{waits:.1f}")
            )
            before = before or one.steps
    headings = ("scenario", "robots", "steps", "change", "metres", "waiting (steps)")
    print_table(headings, lines, right=range(1, 6))
    if any(not one.minimal for row in rows for one in row if one.plan is not None):
        say("\n?: not proved to be the least")
    for row in rows:
        for count, one in zip(numbers, row):
            if one.plan is None:
                say(f"{one.scenario}, {count}: {one.message}")
