"""``waiter layout convert``: a SPARC program as a layout, or places for its nodes."""

from __future__ import annotations

from typing import Annotated, Optional

import typer

from waiter_cli.commands.options import JsonOption, OutputOption

__all__ = ["convert"]


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
    output: OutputOption = None,
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
    from waiter_cli.file_access.atomic import write_whole
    from waiter_cli.file_access.sparc_file import read_program
    from waiter_cli.files.documents import converted_document
    from waiter_cli.layout_tools.convert import convert as convert_program
    from waiter_cli.layout_tools.convert import place_nodes
    from waiter_cli.yaml_reading.node_reader import NAME_RULE, is_identifier

    if name is not None and not is_identifier(name):
        raise InputError(f"{name!r} is no name for a layout", NAME_RULE)
    stem = os.path.basename(output or program).rsplit(".", 1)[0].replace("-", "_")
    called = name or (stem if is_identifier(stem) else "converted")
    if program.endswith((".yaml", ".yml")):
        from waiter_cli.errors import Where
        from waiter_cli.file_access.kinds import kind_of
        from waiter_cli.file_access.locate import read_text
        from waiter_cli.files.layout_reader import read_layout

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
        print_json(converted_document(called, output, made.text, made.remarks))
        return 0
    print_faults(made.remarks, "note")
    if output is None:
        print_document(made.text)
    return 0
