"""``waiter studio``: the restaurant as a local page."""

from __future__ import annotations

import sys
from typing import Annotated, Optional

import typer

from waiter_cli.command_line.command import grouped
from waiter_cli.commands.options import (
    DomainOption,
    JsonOption,
    LayoutOption,
    ScenarioOption,
    named_file,
)

__all__ = ["studio"]

OWN_SECONDS = 5.0
"""The time of a search by a domain of one's own, which has no bounds to help it."""

JournalOption = Annotated[
    Optional[str],
    typer.Option(
        "--journal",
        callback=named_file,
        metavar="FILE",
        help="Make all that happens durable; go on from there.",
    ),
]
SeedOption = Annotated[
    int,
    typer.Option(
        "--seed",
        min=0,
        metavar="N",
        help="The evening's chance; the same number, the same evening.",
    ),
]
PortOption = Annotated[
    int,
    typer.Option(
        "--port", min=0, max=65535, metavar="N", help="The port of 127.0.0.1; 0 takes a free one."
    ),
]
NoOpenOption = Annotated[bool, typer.Option("--no-open", help="Open no browser.")]
SpeedOption = Annotated[
    float,
    typer.Option(
        "--speed", min=0.5, max=60.0, metavar="X", help="How fast the evening plays at first."
    ),
]


@grouped(
    {
        "Options": ("layout", "scenario", "journal", "seed", "speed", "as_json"),
        "The page": ("port", "no_open"),
        "Rules": ("domain",),
    }
)
def studio(
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    journal: JournalOption = None,
    seed: SeedOption = 0,
    port: PortOption = 0,
    no_open: NoOpenOption = False,
    speed: SpeedOption = 1.0,
    domain: DomainOption = "restaurant",
    as_json: JsonOption = False,
) -> int:
    """Live in a restaurant, lay it out and ask it why, on a page in your browser.

    \b
    Examples:
      waiter studio
      waiter studio --layout my.yaml --journal evening.journal
      waiter studio --domain housekeeping
    """
    from dataclasses import replace

    import waiter_cli
    from waiter_cli.execution.online_planner import TIME_LIMIT, OnlinePlanner

    _require_packages()
    rules = waiter_cli.find_domain(domain)
    seconds = TIME_LIMIT if rules.built_in else OWN_SECONDS
    planner = OnlinePlanner(waiter_cli.find_translator("native", None), rules, seconds)
    from waiter_cli.errors import Exit
    from waiter_cli.execution.decision import Refused
    from waiter_cli.studio.begin import begin_evening
    from waiter_cli.studio.opened import open_files
    from waiter_cli.studio.server import bind_port, serve_studio

    opened = replace(open_files(layout, scenario, planner), journal=journal)
    listening = bind_port(port)

    def announce(address: str) -> None:
        _announce(address, as_json)
        if not no_open:
            _open(address)

    try:
        evening = begin_evening(opened, journal, seed, speed, _warn)
    except Refused as refused:
        for reason in refused.reasons:
            _warn(f"{reason.where}: {reason.message}" if reason.where else reason.message)
        return Exit.PROVED
    with evening as live:
        serve_studio(opened, live, listening, announce)
    return 0


def _warn(text: str) -> None:
    from waiter_cli.console.output import print_text

    print_text(f"waiter studio: {text}", sys.stderr)


def _require_packages() -> None:
    """Raises `MissingError` where what the page needs is not installed."""
    from importlib.util import find_spec

    from waiter_cli.errors import MissingError
    from waiter_cli.optional_packages import EXTRAS, extra_line

    missing = [name for name in EXTRAS["studio"] if find_spec(name) is None]
    if missing:
        raise MissingError(f"the studio needs {', '.join(missing)}", extra_line("studio"))


def _announce(address: str, as_json: bool) -> None:
    """Prints the address at once: whoever started this may wait for it."""
    from waiter_cli.console.output import print_json, print_text

    if as_json:
        print_json({"studio": "waiter.studio/1", "url": address})
    else:
        print_text(f"studio: {address}")
    sys.stdout.flush()


def _open(address: str) -> None:
    """Opens a browser with windows, where there is one; one in the terminal would hold it."""
    import os
    import threading
    import webbrowser

    if sys.platform.startswith("linux"):
        if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            return
    threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
