"""``waiter sparc check|translate|query|explain|why|format|lsp|fetch-jar``: the SPARC tools."""

from __future__ import annotations

import typer

from waiter_cli.commands.sparc.check import check
from waiter_cli.commands.sparc.explain import explain
from waiter_cli.commands.sparc.fetch_jar import fetch_jar
from waiter_cli.commands.sparc.format import format_file
from waiter_cli.commands.sparc.lsp import lsp
from waiter_cli.commands.sparc.query import query
from waiter_cli.commands.sparc.translate import translate
from waiter_cli.commands.sparc.why import why

__all__ = ["app"]

app = typer.Typer(
    help="""The SPARC tool chain by itself.

    \b
    Examples:
      waiter sparc check family.sparc
      waiter sparc query family.sparc --query 'parent(anna,X)'
    """,
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command()(check)
app.command()(translate)
app.command()(query)
app.command()(explain)
app.command()(why)
app.command("format")(format_file)
app.command()(lsp)
app.command("fetch-jar")(fetch_jar)
