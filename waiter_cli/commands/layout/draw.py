"""``waiter layout draw``: the floor plan as text or as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Optional

import typer

from waiter_cli.command_line.completion import names_of
from waiter_cli.commands.layout.watched_files import watched_files
from waiter_cli.commands.options import (
    A_LAYOUT,
    JsonOption,
    ScenarioOption,
    WatchOption,
    named_file,
)

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.rules.rulebook import Rulebook
    from waiter_cli.simulation.run_request import RunRequest

__all__ = ["draw"]


SUFFIXES = (".svg", ".png", ".txt")


def draw(
    layout: Annotated[
        Optional[str],
        typer.Argument(
            metavar="LAYOUT",
            autocompletion=names_of("layout"),
            help=f"{A_LAYOUT} May be left out with a plan.",
        ),
    ] = None,
    plan: Annotated[
        Optional[str],
        typer.Option(
            "--plan", metavar="P.json", help="Draw the walk of a plan (waiter plan --json)."
        ),
    ] = None,
    scenario: ScenarioOption = None,
    highlight: Annotated[
        Optional[list[str]],
        typer.Option(
            "--highlight",
            metavar="NAME",
            help="Point out a node, table, waiter or edge (n1-n2); may be given again.",
        ),
    ] = None,
    output: Annotated[
        Optional[list[str]],
        typer.Option(
            "--output",
            "-o",
            callback=named_file,
            metavar="FILE",
            help="Write FILE.svg, .png or .txt.",
        ),
    ] = None,
    svg: Annotated[
        Optional[str],
        typer.Option("--svg", callback=named_file, metavar="FILE", help="Write an SVG picture."),
    ] = None,
    png: Annotated[
        Optional[str],
        typer.Option("--png", callback=named_file, metavar="FILE", help="Write a PNG picture."),
    ] = None,
    width: Annotated[
        Optional[int],
        typer.Option("--width", min=40, max=400, metavar="N", help="Columns of the text drawing."),
    ] = None,
    as_json: JsonOption = False,
    watch: WatchOption = False,
) -> int:
    """Draw the floor plan: in the terminal, or as a picture.

    Without a file to write, the drawing is text, 80 columns wide or as wide as
    the terminal.

    \b
    Examples:
      waiter layout draw bistro
      waiter layout draw report --svg report.svg --highlight table2
      waiter plan --scenario b1 --json | waiter layout draw --plan - -o walk.png
    """
    named = [(svg, ".svg"), (png, ".png")]
    targets = [(name, kind) for name, kind in named if name is not None]
    targets += [(name, _suffix(name)) for name in output or ()]

    def run() -> int:
        return _draw(_subject(layout, scenario, plan, highlight or []), targets, width, as_json)

    if watch:
        from waiter_cli.commands.watching import watch as watch_files

        return watch_files(watched_files(layout, scenario, plan), run, as_json=as_json)
    return run()


def _suffix(name: str) -> str:
    """Returns the ending of a file's name; raises `InputError` where it is none of a drawing's."""
    import os

    from waiter_cli.errors import Fault, InputError, Where
    from waiter_cli.model.wording import in_words

    kind = os.path.splitext(name)[1].lower()
    if kind not in SUFFIXES:
        message = f"{name}: what kind of drawing?"
        hint = f"use a name that ends in {in_words(SUFFIXES, 'or')}"
        raise InputError([Fault(Where("--output"), message, hint)])
    return kind


def _rules(cue: RunRequest) -> tuple[Rulebook, Domain | None]:
    """Returns what plays the plan that is drawn, and the domain that it remembers, where it has one."""
    from waiter_cli.domain_execution.domain_rules import rules_for
    from waiter_cli.problems.from_options import domain_of
    from waiter_cli.rules.rulebook import HOUSE

    if cue.made is None or cue.made.domain is None:
        return HOUSE, None
    domain = domain_of(cue.made)
    return rules_for(cue.problem, domain), domain


def _subject(
    layout: str | None, scenario: str | None, plan: str | None, highlights: list[str]
) -> Subject:
    """Returns the subject of the drawing."""
    from dataclasses import replace

    from waiter_cli.drawing.subject import make_subject
    from waiter_cli.errors import InputError, Where
    from waiter_cli.file_access.locate import find
    from waiter_cli.simulation.run_request import read_run_request

    if layout not in (None, "-"):
        find(layout, "layout", where=Where("LAYOUT"))
    if layout is None and scenario is None and plan is None:
        raise InputError("which restaurant?", "give a layout: waiter layout draw report")
    cue = read_run_request(layout, scenario, plan)
    played = None if cue.plan is None else (cue.problem, cue.plan)
    subject = make_subject(cue.problem.layout, cue.problem.state, played, highlights, *_rules(cue))
    notes = [subject.note, *cue.changed] if subject.note else cue.changed
    return replace(subject, note="; ".join(notes))


def _draw(
    subject: Subject, targets: list[tuple[str, str]], width: int | None, as_json: bool
) -> int:
    import sys

    from waiter_cli.console.output import print_text
    from waiter_cli.file_access.atomic import write_whole

    if subject.note:
        from waiter_cli.console.output import say

        say(f"waiter: {subject.note}", sys.stderr)
    for name, kind in targets:
        content: str | bytes
        if kind == ".txt":
            from waiter_cli.drawing.text import draw_text

            content = draw_text(subject, width or 80) + "\n"
        else:
            from waiter_cli.drawing import picture

            content = picture.draw_svg(subject) if kind == ".svg" else picture.draw_png(subject)
        write_whole(name, content)
        print_text(f"wrote {name}", sys.stderr)
    if as_json:
        from waiter_cli.console.output import print_json
        from waiter_cli.drawing.text import draw_text
        from waiter_cli.files.documents import drawing_document

        text = None if targets else draw_text(subject, width or 80)
        print_json(
            drawing_document(subject.layout, [name for name, _ in targets], text, subject.note)
        )
    elif not targets:
        _print_drawing(subject, width)
    return 0


def _print_drawing(subject: Subject, width: int | None) -> None:
    """Prints the drawing in characters that the terminal has."""
    import shutil
    import sys

    from waiter_cli.console.output import print_text
    from waiter_cli.console.styling import styled
    from waiter_cli.drawing.characters import fits_encoding
    from waiter_cli.drawing.text import draw_text

    encoding = sys.stdout.encoding
    if width is None:
        columns = shutil.get_terminal_size((80, 24)).columns if sys.stdout.isatty() else 80
        width = max(40, min(columns, 160))
    text = draw_text(subject, width, fits_encoding(encoding), styled)
    print_text(text.encode(encoding or "utf-8", "replace").decode(encoding or "utf-8"))
