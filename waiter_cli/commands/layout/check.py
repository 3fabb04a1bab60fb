"""``waiter layout check``: faults and advice, each with its place."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from waiter_cli.commands.layout.watched_files import watched_files
from waiter_cli.commands.options import JsonOption, LayoutArgument, WatchOption

__all__ = ["check"]


def check(
    layout: LayoutArgument,
    as_json: JsonOption = False,
    watch: WatchOption = False,
    verbose: Annotated[
        bool, typer.Option("--verbose", "-v", help="Give every piece of advice, however many.")
    ] = False,
) -> int:
    """Find faults (exit code 2) and give advice (exit code 0), each with its line and column.

    Advice is about unreachable tables and nodes, bottlenecks, dead ends and other
    nodes that nothing uses, edges through furniture, seats that do not fit, and
    timetables that lead through somebody. Many of a kind are counted, the first
    three by name; -v and --json give all.

    \b
    Examples:
      waiter layout check bistro
      waiter layout check cafe.yaml --watch
    """

    def run() -> int:
        from waiter_cli.files.layout_reader import read_layout_file

        return _check(read_layout_file(layout, "LAYOUT", several=True), as_json, verbose)

    if watch:
        from waiter_cli.commands.watching import watch as watch_files

        return watch_files(watched_files(layout), run, as_json=as_json)
    return run()


def _check(layout: Any, as_json: bool, everything: bool) -> int:
    import sys

    from waiter_cli.console.output import print_faults, print_json, say
    from waiter_cli.console.styling import styled
    from waiter_cli.files.documents import advice_document
    from waiter_cli.layout_tools.advice import advise
    from waiter_cli.model.wording import counted

    found = advise(layout)
    if as_json:
        print_json(advice_document(layout, [(each.kind, each.fault) for each in found]))
        return 0
    from waiter_cli.layout_tools.advice_text import told

    remarks = told(found, everything=True)
    shown = remarks if everything else told(found)
    print_faults(shown, "advice")
    if shown != remarks:
        say("Many of a kind are summed up; -v gives them all.", sys.stderr)
    number = f"{counted(len(remarks), 'piece')} of advice" if found else "in order"
    say(
        f"{layout.file}: {styled(number, 'yellow' if found else 'green')}: "
        f"{counted(len(layout.nodes), 'node')}, {counted(len(layout.edges), 'edge')}, "
        f"{counted(len(layout.tables), 'table')} with "
        f"{counted(sum(table.capacity for table in layout.tables), 'seat')}."
    )
    return 0
