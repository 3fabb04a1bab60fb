"""``waiter layout check|draw|new|schema|convert|improve``: tools for the restaurant's file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.completion import names_of
from waiter_cli.commands.layout.improve import improve
from waiter_cli.commands.layout.new import new
from waiter_cli.commands.options import (
    A_LAYOUT,
    JsonOption,
    LayoutArgument,
    ScenarioOption,
    WatchOption,
)

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject

__all__ = ["app", "check", "convert", "draw", "schema"]

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


# ------------------------------------------------------------------ check


@app.command()
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

        return _check(read_layout_file(layout, "LAYOUT"), as_json, verbose)

    if watch:
        from waiter_cli.commands.watching import watch as watch_files

        return watch_files(_paths(layout), run, as_json=as_json)
    return run()


def _paths(layout: str | None, scenario: str | None = None, plan: str | None = None) -> list[str]:
    """The files to watch; standard input cannot be."""
    from waiter_cli.errors import InputError, Where
    from waiter_cli.files.locate import find

    if "-" in (layout, scenario, plan):
        raise InputError("standard input cannot be watched", "name a file, or leave out --watch")
    paths = [find(layout, "layout", where=Where("LAYOUT"))] if layout is not None else []
    paths += [find(scenario, "scenario")] if scenario is not None else []
    return paths + ([plan] if plan is not None else [])


def _check(layout: Any, as_json: bool, everything: bool) -> int:
    import sys

    from waiter_cli.console.output import print_faults, print_json, say
    from waiter_cli.console.styling import styled
    from waiter_cli.files.documents import fault_document
    from waiter_cli.layout_tools.advice import advise

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
    from waiter_cli.layout_tools.advice_text import told

    remarks = told(found, everything=True)
    shown = remarks if everything else told(found)
    print_faults(shown, "advice")
    if shown != remarks:
        say("Many of a kind are summed up; -v gives them all.", sys.stderr)
    number = (
        f"{len(remarks)} piece{'' if len(remarks) == 1 else 's'} of advice" if found else "in order"
    )
    say(
        f"{layout.file}: {styled(number, 'yellow' if found else 'green')}: "
        f"{_count(len(layout.nodes), 'node')}, {_count(len(layout.edges), 'edge')}, "
        f"{_count(len(layout.tables), 'table')} with "
        f"{_count(sum(table.capacity for table in layout.tables), 'seat')}."
    )
    return 0


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


# ------------------------------------------------------------------ draw

SUFFIXES = (".svg", ".png", ".txt")


@app.command()
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
        typer.Option("--output", "-o", metavar="FILE", help="Write FILE.svg, .png or .txt."),
    ] = None,
    svg: Annotated[
        Optional[str], typer.Option("--svg", metavar="FILE", help="Write an SVG picture.")
    ] = None,
    png: Annotated[
        Optional[str], typer.Option("--png", metavar="FILE", help="Write a PNG picture.")
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

        return watch_files(_paths(layout, scenario, plan), run, as_json=as_json)
    return run()


def _suffix(name: str) -> str:
    """What to write into a file of that name; raises `InputError` where it does not tell."""
    import os

    from waiter_cli.errors import Fault, InputError, Where

    kind = os.path.splitext(name)[1].lower()
    if kind not in SUFFIXES:
        message = f"{name}: what kind of drawing?"
        hint = f"use a name that ends in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}"
        raise InputError([Fault(Where("--output"), message, hint)])
    return kind


def _subject(
    layout: str | None, scenario: str | None, plan: str | None, highlights: list[str]
) -> Subject:
    """What is to be drawn."""
    from dataclasses import replace

    from waiter_cli.drawing.subject import make_subject
    from waiter_cli.errors import InputError, Where
    from waiter_cli.files.locate import find
    from waiter_cli.simulation.cue import read_cue

    if layout not in (None, "-"):
        find(layout, "layout", where=Where("LAYOUT"))
    if layout is None and scenario is None and plan is None:
        raise InputError("which restaurant?", "give a layout: waiter layout draw report")
    cue = read_cue(layout, scenario, plan)
    played = None if cue.plan is None else (cue.problem, cue.plan)
    subject = make_subject(cue.problem.layout, cue.problem.state, played, highlights)
    notes = [subject.note, *cue.changed] if subject.note else cue.changed
    return replace(subject, note="; ".join(notes))


def _draw(
    subject: Subject, targets: list[tuple[str, str]], width: int | None, as_json: bool
) -> int:
    import sys

    from waiter_cli.console.output import print_text
    from waiter_cli.files.atomic import write_whole

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

        print_json(
            {
                "status": "drawn",
                "layout": subject.layout.name,
                "files": [name for name, _ in targets],
                "text": None if targets else draw_text(subject, width or 80),
                "note": subject.note or None,
            }
        )
    elif not targets:
        _print_drawing(subject, width)
    return 0


def _print_drawing(subject: Subject, width: int | None) -> None:
    """The drawing in characters that the terminal has."""
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


# ------------------------------------------------------------------ new, schema

app.command("new")(new)


@app.command()
def schema(
    scenario: Annotated[
        bool, typer.Option("--scenario", help="The schema of scenarios instead of layouts.")
    ] = False,
    output: Annotated[
        Optional[str],
        typer.Option("--output", "-o", metavar="FILE", help="Write FILE instead of printing."),
    ] = None,
    as_json: JsonOption = False,
) -> int:
    """Print the JSON Schema of layouts, with which editors check and complete them.

    \b
    A YAML file whose first line is
      # yaml-language-server: $schema=layout.schema.json
    is checked while you type, in every editor with the YAML language server.

    \b
    Examples:
      waiter layout schema -o layout.schema.json
      waiter layout schema --scenario -o scenario.schema.json
    """
    import json
    import os
    import sys

    from waiter_cli.console.output import print_text
    from waiter_cli.console.streams import printable_json
    from waiter_cli.files.atomic import write_whole
    from waiter_cli.files.json_schema import MODELINE, layout_schema, scenario_schema

    made = scenario_schema() if scenario else layout_schema()
    text = json.dumps(made, indent=2, ensure_ascii=False) + "\n"
    if output is None:
        print_text(printable_json(text), end="")
        name = "scenario.schema.json" if scenario else "layout.schema.json"
    else:
        write_whole(output, text)
        print_text(f"wrote {output}", sys.stderr)
        if as_json:
            print_text(printable_json(text), end="")
        name = os.path.basename(output)
    kind = "scenarios" if scenario else "layouts"
    print_text(f"begin your {kind} with the line:\n{MODELINE}{name}", sys.stderr)
    return 0


# ------------------------------------------------------------------ convert


@app.command()
def convert(
    program: Annotated[
        str,
        typer.Argument(
            metavar="PROGRAM",
            help="A SPARC program (- is standard input), or with --place a layout.",
        ),
    ],
    name: Annotated[
        Optional[str], typer.Option("--name", metavar="NAME", help="What it is called.")
    ] = None,
    place: Annotated[
        bool, typer.Option("--place", help="Give the nodes places in metres that fit the edges.")
    ] = False,
    output: Annotated[
        Optional[str],
        typer.Option("--output", "-o", metavar="FILE", help="Write FILE instead of printing."),
    ] = None,
    as_json: JsonOption = False,
) -> int:
    """Read the nodes, edges and tables of a SPARC program and write them as a layout.

    Facts are read in the words of the report (edge, areassociated, hascapacity,
    entrance, currentlocation at step 0); what was not found is said on stderr
    and in the file. With --place a layout in YAML may be given, too: its nodes
    get places, and the rest of its text stays as it is.

    \b
    Examples:
      waiter layout convert restaurant.sparc -o restaurant.yaml
      waiter plan --scenario b1 --show sparc | waiter layout convert -
    """
    import os
    import sys

    from waiter_cli.console.output import print_document, print_faults, print_json, print_text
    from waiter_cli.errors import InputError
    from waiter_cli.files.atomic import write_whole
    from waiter_cli.files.documents import fault_document
    from waiter_cli.files.node_reader import NAME_RULE, is_identifier
    from waiter_cli.files.sparc_file import read_program
    from waiter_cli.layout_tools.convert import convert as convert_program
    from waiter_cli.layout_tools.convert import place_nodes

    if name is not None and not is_identifier(name):
        raise InputError(f"{name!r} is no name for a layout", NAME_RULE)
    stem = os.path.basename(output or program).rsplit(".", 1)[0].replace("-", "_")
    called = name or (stem if is_identifier(stem) else "converted")
    if program.endswith((".yaml", ".yml")):
        from waiter_cli.errors import Where
        from waiter_cli.files.kinds import kind_of
        from waiter_cli.files.layout_reader import read_layout
        from waiter_cli.files.locate import read_text

        file = read_text(program, "layout", where=Where("PROGRAM"))
        what = kind_of(file.text)
        if what != "a layout" or not place:
            hint = "give a SPARC program, or a layout with --place to find places for its nodes"
            said = "is a layout already" if what == "a layout" else f"is {what}, not a layout"
            raise InputError(f"{file.shown} {said}", hint)
        made = place_nodes(file.text, read_layout(file.text, file.shown), name)
        called = made.layout.name
    else:
        made = convert_program(read_program(program), called, place)
    if output is not None:
        write_whole(output, made.text)
        print_text(f"wrote {output}", sys.stderr)
    if as_json:
        remarks = [fault_document(each) for each in made.remarks]
        document = {"status": "converted", "layout": called, "file": output, "text": made.text}
        print_json({**document, "remarks": remarks})
        return 0
    print_faults(made.remarks, "note")
    if output is None:
        print_document(made.text)
    return 0


app.command("improve")(improve)
