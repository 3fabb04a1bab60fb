"""``waiter layout schema``: the JSON Schema with which editors check layouts."""

from __future__ import annotations

from typing import Annotated

import typer

from waiter_cli.commands.options import JsonOption, OutputOption

__all__ = ["schema"]


def schema(
    scenario: Annotated[
        bool, typer.Option("--scenario", help="The schema of scenarios instead of layouts.")
    ] = False,
    output: OutputOption = None,
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
    from waiter_cli.file_access.atomic import write_whole
    from waiter_cli.layout_tools.layout_schema import layout_schema
    from waiter_cli.layout_tools.scenario_schema import scenario_schema
    from waiter_cli.layout_tools.schema_parts import MODELINE

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
