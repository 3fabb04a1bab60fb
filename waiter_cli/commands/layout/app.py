"""``waiter layout check|draw|new|schema|convert|improve``: tools for the restaurant's file."""

from __future__ import annotations

import typer

from waiter_cli.commands.layout.check import check
from waiter_cli.commands.layout.convert import convert
from waiter_cli.commands.layout.draw import draw
from waiter_cli.commands.layout.improve import improve
from waiter_cli.commands.layout.new import new
from waiter_cli.commands.layout.schema import schema

__all__ = ["app"]

app = typer.Typer(
    help="""Tools for layouts: check, draw, make, convert, improve.

    \b
    Examples:
      waiter layout check bistro
      waiter layout draw bistro
    """,
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command()(check)
app.command()(draw)
app.command()(new)
app.command()(schema)
app.command()(convert)
app.command()(improve)
