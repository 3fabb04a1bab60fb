"""``waiter study run|report|show``: many evenings, and which differences they support."""

from __future__ import annotations

import typer

from waiter_cli.commands.study.report import report
from waiter_cli.commands.study.run import run
from waiter_cli.commands.study.show import show

__all__ = ["app"]

app = typer.Typer(
    help="""Run many evenings and compare them.

    \b
    Examples:
      waiter study run friday-study.yaml -o friday.db
      waiter study report friday.db -o report.html
    """,
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command()(run)
app.command()(report)
app.command()(show)
