"""``waiter layout improve``: which change of a layout saves most walking, or makes evenings better."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.compare import ScenariosOption, SeveralScenariosOption
from waiter_cli.commands.options import (
    JsonOption,
    LayoutArgument,
    MemoryLimitOption,
    VerboseOption,
    WorkersOption,
    named_file,
)

if TYPE_CHECKING:
    from waiter_cli.commands.layout.improve_by_evenings import EveningOptions
    from waiter_cli.layout_tools.improve import Report
    from waiter_cli.layout_tools.layout_changes import LayoutChange
    from waiter_cli.layout_tools.measure import Totals
    from waiter_cli.model.layout import Layout

__all__ = ["improve"]

Showing = AbstractContextManager[Callable[[str], object]]


class Kind(str, Enum):
    """The kinds of changes to a layout."""

    edges = "edges"
    tables = "tables"


def improve(
    layout: LayoutArgument,
    scenarios: ScenariosOption = None,
    scenario: SeveralScenariosOption = None,
    study: Annotated[
        Optional[str],
        typer.Option(
            "--study",
            metavar="FILE",
            help="Judge by evenings instead: of a study, or of a scenario with guests by chance.",
        ),
    ] = None,
    figure: Annotated[
        Optional[str],
        typer.Option(
            "--for",
            metavar="FIGURE",
            help="With --study, what is to be better: wait_seat_p95 or served; lost unless told.",
        ),
    ] = None,
    workers: WorkersOption = None,
    only: Annotated[
        Optional[Kind], typer.Option("--only", help="Look at edges only, or at tables only.")
    ] = None,
    top: Annotated[
        int, typer.Option("--top", min=1, max=100, metavar="N", help="How many to list.")
    ] = 5,
    tries: Annotated[
        int,
        typer.Option(
            "--tries", min=1, max=10000, metavar="N", help="How many to plan or play with."
        ),
    ] = 24,
    time_limit: Annotated[
        Optional[float],
        typer.Option(
            "--time-limit",
            min=0.0,
            metavar="SECONDS",
            help="Give up after so many seconds, for all of it: 30 unless told, 600 with --study.",
        ),
    ] = None,
    memory_limit: MemoryLimitOption = None,
    output: Annotated[
        Optional[str],
        typer.Option(
            "--output",
            "-o",
            callback=named_file,
            metavar="FILE",
            help="Write the best layout to FILE.",
        ),
    ] = None,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> int:
    """Find the change that saves most walking: an edge more, a table elsewhere, two tables swapped.

    Every figure listed comes from minimal plans of all the scenarios, before and after.
    With --study changes are played instead, on the same evenings as the layout as it is: the
    best one is judged on evenings by which it was not chosen, until an interval says so.

    \b
    Examples:
      waiter layout improve report --scenario b1 --scenario b2
      waiter layout improve cafe.yaml --scenarios evenings -o better.yaml
      waiter layout improve cafe.yaml --study friday.yaml --for wait_seat_p95
    """
    from sparc.limits import begin
    from waiter_cli.console.output import print_json, print_text
    from waiter_cli.console.progress import alive
    from waiter_cli.errors import Where
    from waiter_cli.file_access.locate import read_text
    from waiter_cli.files.layout_reader import one_robot, read_layout
    from waiter_cli.layout_tools.improve import Budget
    from waiter_cli.layout_tools.improve import improve as search
    from waiter_cli.layout_tools.measure import find_scenarios

    _fit_together([*(scenarios or []), *(scenario or [])], study, figure, workers)
    file = read_text(layout, "layout", where=Where("LAYOUT"))
    read = read_layout(file.text, file.shown)

    def say(text: str) -> None:
        print_text(f"  trying {text}", sys.stderr)

    showing: Showing = nullcontext(say) if verbose else alive("trying changes")
    edges, tables = only is not Kind.tables, only is not Kind.edges
    if study is not None:
        from waiter_cli.commands.layout.improve_by_evenings import EveningOptions

        seconds = 600.0 if time_limit is None else time_limit
        options = EveningOptions(
            study, figure or "lost", edges, tables, tries, seconds, workers, memory_limit
        )
        best = _by_evenings(read, options, showing, top, as_json)
    else:
        one_robot(read, "layout improve")
        begin(None, memory_limit)
        budget = Budget(30.0 if time_limit is None else time_limit, tries)
        with showing as progress:
            report = search(
                read, find_scenarios(scenarios or [], scenario or []), edges=edges, tables=tables,
                budget=budget, progress=progress,
            )  # fmt: skip
        if as_json:
            print_json(_document(read, report, top))
        else:
            _print(read, report, top)
        best = report.found[0].change if report.found else None
    if output is not None and best is not None:
        from waiter_cli.file_access.atomic import write_whole

        write_whole(output, _yaml(file.text, read, best))
        print_text(f"wrote {output}", sys.stderr)
    elif output is not None:
        print_text(f"nothing to write to {output}", sys.stderr)
    return 0


def _by_evenings(
    read: Layout, options: EveningOptions, showing: Showing, top: int, as_json: bool
) -> LayoutChange | None:
    """Tells what came of playing evenings; returns the change that they support."""
    from waiter_cli.commands.layout.improve_by_evenings import (
        find_by_evenings,
        print_trials,
        trials_document,
    )
    from waiter_cli.console.output import print_json

    with showing as progress:
        report = find_by_evenings(read, options, progress)
    if as_json:
        print_json(trials_document(report, top))
    else:
        print_trials(report)
    return report.best if report.status == "improved" else None


def _fit_together(
    scenarios: list[str], study: str | None, figure: str | None, workers: int | None
) -> None:
    """Raises `InputError` for options that say two things."""
    from waiter_cli.errors import InputError

    if study is None:
        for name, value in (("--for", figure), ("--workers", workers)):
            if value is not None:
                raise InputError(f"{name} {value} is about evenings", "give --study, too")
    elif scenarios:
        message = "--scenario is about plans, --study about evenings"
        raise InputError(message, "leave one of them out")
    elif study == "-":
        raise InputError("a study is not read from standard input here", "give a file")


def _yaml(text: str, before: Layout, best: LayoutChange) -> str:
    """Returns the changed layout as a file of its own, with the comments of the one it came from."""
    from waiter_cli.files.layout_editor import edited
    from waiter_cli.files.layout_writer import write_layout

    layout = best.layout
    kept = edited(text, before, layout)
    if kept is not None:
        return kept if kept.lstrip().startswith("{") else f"{_title(before, best)}{kept}"
    whole = write_layout(layout)
    if layout.customers and "customers:" not in whole:
        whole += f"customers: {layout.customers}\n"
    return f"{_title(before, best)}{whole}"


def _title(before: Layout, best: LayoutChange) -> str:
    return f"# {before.name}, changed: {best.text}\n"


def _document(layout: Layout, report: Report, top: int) -> dict[str, Any]:
    return {
        "status": "improved" if report.found else "no_improvement",
        "layout": layout.name,
        "before": report.before.document(),
        "scenarios": [
            {"scenario": row.scenario, "file": row.file, **row.document()}
            for row in (*report.rows, *report.unfit)
        ],
        "improvements": [
            {
                "kind": one.change.kind,
                "change": one.change.text,
                "after": one.after.document(),
                "saved": {
                    "steps": report.before.steps - one.after.steps,
                    "metres": round(report.before.metres - one.after.metres, 3),
                    "waiting": round(report.before.waiting - one.after.waiting, 3),
                },
                "solved": one.solved,
            }
            for one in report.found[:top]
        ],
        "tried": report.tried,
        "candidates": report.candidates,
        "stopped": report.stopped or None,
    }


def _print(layout: Layout, report: Report, top: int) -> None:
    from waiter_cli.console.output import print_table, print_text, say
    from waiter_cli.console.styling import styled
    from waiter_cli.model.wording import counted

    before = report.before
    many = counted(before.scenarios, "scenario")
    figures = f"over {many}: {_figures(before)}" if before.scenarios else "no scenario has a plan"
    say(f"{styled(layout.name, 'bold')} as it is, {figures}.")
    for row in (*report.rows, *report.unfit):
        if row.plan is None:
            say(f"  {row.scenario}: {row.message}")
    if report.found:
        print_text("")
        solved = any(one.solved > before.scenarios for one in report.found)
        rows = []
        for one in report.found[:top]:
            after = one.after
            cells = [
                one.change.text,
                f"{before.steps} -> {after.steps}",
                f"{before.metres:.2f} -> {after.metres:.2f}",
                f"{before.metres - after.metres:.2f}",
                f"{before.waiting:.1f} -> {after.waiting:.1f}",
            ]
            rows.append(cells + ([f"{before.scenarios} -> {one.solved}"] if solved else []))
        headings = ["change", "steps", "metres", "saved", f"waiting ({before.unit})"]
        print_table(headings + (["plans"] if solved else []), rows, right=range(1, 6), prose=0)
    else:
        say("No change that was tried saves any walking.")
    if report.tried != report.candidates or report.stopped:
        if report.found:
            print_text("")
        why = {
            "time": ", then the time was up (--time-limit)",
            "memory": ", then the memory was used up (--memory-limit)",
            "tries": ", those that promise most (--tries)",
        }.get(report.stopped, "; there is no room on the floor for the others")
        say(f"{report.tried} of {report.candidates} changes were planned{why}.")


def _figures(totals: Totals) -> str:
    return (
        f"{totals.steps} steps, {totals.metres:.2f} metres, "
        f"a mean wait of {totals.waiting:.1f} {totals.unit}"
    )
