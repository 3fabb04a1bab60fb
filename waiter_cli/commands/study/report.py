"""``waiter study report``: which differences the evenings support, in words and on a page."""

from __future__ import annotations

import sys
from typing import Annotated, Optional

import typer

from waiter_cli.commands.options import JsonOption, named_file
from waiter_cli.commands.study.show import StoreArgument

__all__ = ["report"]


def report(
    store: StoreArgument,
    output: Annotated[
        Optional[str],
        typer.Option(
            "--output",
            "-o",
            callback=named_file,
            metavar="FILE.html",
            help="Write a page, with pictures.",
        ),
    ] = None,
    as_json: JsonOption = False,
) -> int:
    """Say which differences a study supports, with 95 % intervals, and which it does not.

    What varies is compared with its first value on the same evenings.

    \b
    Examples:
      waiter study report friday.db
      waiter study report friday.db -o report.html
    """
    from waiter_cli.console.output import print_json, print_text, say
    from waiter_cli.file_access.atomic import require_apart
    from waiter_cli.study.charts import draw_charts, require_matplotlib
    from waiter_cli.study.findings import find
    from waiter_cli.study.store import Store

    if output is not None:
        require_apart({"--output": output}, [store])
        require_matplotlib()
    with Store(store) as opened:
        findings = find(opened)
    if output is not None:
        from waiter_cli.file_access.atomic import write_whole
        from waiter_cli.study.report_page import report_page

        charts = draw_charts(findings.rows, findings.comparisons)
        write_whole(output, report_page(findings, charts))
        print_text(f"wrote {output}", sys.stderr)
    if as_json:
        print_json({**findings.document(), "report": output})
        return 0
    counts = findings.counts()
    say(
        f"{findings.study.name}: {counts['done']} of {counts['runs']} runs "
        f"on {findings.evenings} evenings."
    )
    for sentence in findings.sentences:
        say(f"- {sentence}")
    if findings.worst:
        say("The worst evening:")
        print_text(f"  {findings.worst[0].replay}")
    return 0
