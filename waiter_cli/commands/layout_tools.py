"""``waiter layout check|draw|new|schema|convert|improve``: tools for the restaurant's file."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from waiter_cli.commands.options import JsonOption

__all__ = ["app", "check"]

app = typer.Typer(
    help="Tools for layouts: check, draw, make, convert, improve.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

LayoutArgument = Annotated[
    str,
    typer.Argument(
        metavar="LAYOUT", help="A YAML file, or a built-in name such as report; - is stdin."
    ),
]
WatchOption = Annotated[
    bool, typer.Option("--watch", "-w", help="Run again whenever a file changes, until Ctrl-C.")
]


# ------------------------------------------------------------------ check


@app.command()
def check(layout: LayoutArgument, as_json: JsonOption = False, watch: WatchOption = False) -> int:
    """Find faults (exit code 2) and give advice (exit code 0), each with its line and column.

    \b
    Advice is about unreachable tables and nodes, dead ends, bottlenecks, edges through
    furniture, seats that do not fit and unused nodes.
    Examples:
      waiter layout check bistro
      waiter layout check cafe.yaml --watch
    """

    def run() -> int:
        from waiter_cli.layout import read_layout_file

        return _check(read_layout_file(layout), as_json)

    if watch:
        from waiter_cli.watching import watch as watch_files

        return watch_files(_paths(layout), run, as_json=as_json)
    return run()


def _paths(layout: str) -> list[str]:
    """The file to watch; standard input cannot be."""
    from waiter_cli.exits import InputError
    from waiter_cli.resources import find

    if layout == "-":
        raise InputError("standard input cannot be watched", "name a file, or leave out --watch")
    return [find(layout, "layout")]


def _check(layout: Any, as_json: bool) -> int:
    from waiter_cli.layout_advice import advise
    from waiter_cli.output import fault_document, print_faults, print_json, styled

    found = advise(layout)
    if as_json:
        print_json(
            {
                "status": "advice" if found else "ok",
                "layout": layout.name,
                "file": layout.file,
                "nodes": len(layout.nodes),
                "edges": len(layout.edges),
                "tables": len(layout.tables),
                "seats": sum(table.capacity for table in layout.tables),
                "advice": [{"kind": a.kind, **fault_document(a.fault)} for a in found],
            }
        )
        return 0
    print_faults((a.fault for a in found), "advice")
    number = (
        f"{len(found)} piece{'' if len(found) == 1 else 's'} of advice" if found else "in order"
    )
    print(
        f"{layout.file}: {styled(number, 'yellow' if found else 'green')}: "
        f"{_count(len(layout.nodes), 'node')}, {_count(len(layout.edges), 'edge')}, "
        f"{_count(len(layout.tables), 'table')} with "
        f"{_count(sum(table.capacity for table in layout.tables), 'seat')}."
    )
    return 0


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
