"""``waiter tour``: a guided minute, offline."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import typer

__all__ = ["STOPS", "tour"]

# What is said, and the command line that shows it.
STOPS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (
        "A restaurant is a few lines of YAML: places to stand, paths, tables. This is the one of "
        "the report.",
        ("layout", "draw", "report"),
    ),
    (
        "One guest comes in. The plan is the shortest there is; the last line says why nobody can "
        "do it in fewer steps.",
        ("plan", "--layout", "report", "--enter", "1"),
    ),
    (
        "Another waiter stands in the only aisle. No plan exists, at any length, and that is "
        "proved. Why, and what would help?",
        ("explain", "--scenario", "blocked_aisle"),
    ),
    (
        "What would it cost to look at n0 on the way?",
        ("explain", "--scenario", "b1", "--why-not", "go_to(agent,n0)"),
    ),
    (
        "Behind the plan stands a logic program. What it holds true, step by step:",
        ("answersets", "--scenario", "b2", "--only", "occurs,holds", "--grep", "isattable|occurs"),
    ),
    (
        "And the plan can be played: every action is checked against a simulated room.",
        ("simulate", "--scenario", "b1", "--headless"),
    ),
)


def tour(
    context: typer.Context,
    no_pause: Annotated[
        bool, typer.Option("--no-pause", help="Go on without waiting for Enter.")
    ] = False,
) -> int:
    """Take a guided minute: plan, explain, draw and replay; nothing is written.

    \b
    Examples:
      waiter tour
      waiter tour --no-pause
    """
    import shlex
    import sys

    from waiter_cli.console.output import print_text, say
    from waiter_cli.console.styling import printable, styled
    from waiter_cli.file_access.locate import built_ins_first

    run: Callable[[list[str]], int] = context.obj  # the front door itself
    pausing = not no_pause and sys.stdin.isatty() and sys.stdout.isatty()
    for number, (words, command) in enumerate(STOPS, 1):
        say(f"{'' if number == 1 else chr(10)}{styled(f'{number}. {words}', 'bold')}", hang=3)
        print_text(styled(f"$ waiter {shlex.join(command)}", "cyan"))
        sys.stdout.flush()
        with built_ins_first():
            code = run(list(command))
        if code:
            return code
        if pausing and number < len(STOPS):
            try:
                input(printable(styled("[Enter]", "dim")))
            except EOFError:  # Ctrl-D
                raise typer.Abort from None
    say("\nNext: waiter --help, or docs/tutorial.md for a restaurant of your own.")
    return 0
