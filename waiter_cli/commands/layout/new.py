"""``waiter layout new``: a random restaurant, or an evening in one; the same for the same seed."""

from __future__ import annotations

import os
import sys
from enum import Enum
from typing import Annotated, Optional

import typer

from waiter_cli.commands.options import JsonOption, LayoutOption, OutputOption

__all__ = ["new"]

MAX_SEED = 2**31 - 1


class Unsolvable(str, Enum):
    """The reasons for which an evening has no plan; as `waiter_cli.layout_tools.generate.UNSOLVABLE`."""

    too_big = "too_big"
    too_many_parties = "too_many_parties"
    too_few_big_tables = "too_few_big_tables"
    unreachable_table = "unreachable_table"
    blocked_aisle = "blocked_aisle"
    waiter_on_entrance = "waiter_on_entrance"
    bill_nobody = "bill_nobody"
    unwanted_bill = "unwanted_bill"


class Flaw(str, Enum):
    """The flaws that a layout can have on purpose; as `waiter_cli.layout_tools.generate_floor.FLAWS`."""

    unreachable_table = "unreachable_table"
    blocked_aisle = "blocked_aisle"


def new(
    tables: Annotated[
        Optional[int], typer.Option("--tables", "-t", min=1, max=1000, metavar="T", help="Tables.")
    ] = None,
    nodes: Annotated[
        Optional[int],
        typer.Option(
            "--nodes", "-n", min=2, max=3000, metavar="N", help="Places the robot can stand."
        ),
    ] = None,
    seed: Annotated[
        Optional[int],
        typer.Option(
            "--seed", min=0, max=MAX_SEED, metavar="K", help="The same seed makes the same file."
        ),
    ] = None,
    bar: Annotated[
        Optional[bool], typer.Option("--bar/--no-bar", help="With a bar, for orders and refills.")
    ] = None,
    waiters: Annotated[
        Optional[int],
        typer.Option("--waiters", min=0, max=100, metavar="W", help="Other waiters, who stand."),
    ] = None,
    name: Annotated[
        Optional[str], typer.Option("--name", metavar="NAME", help="What it is called.")
    ] = None,
    flaw: Annotated[
        Optional[Flaw], typer.Option("--flaw", help="Make it wrong on purpose, in this way.")
    ] = None,
    scenario: Annotated[
        bool, typer.Option("--scenario", help="Make a scenario for --layout instead of a layout.")
    ] = False,
    layout: LayoutOption = None,
    parties: Annotated[
        Optional[int],
        typer.Option("--parties", min=0, max=200, metavar="P", help="Parties that want seats."),
    ] = None,
    bills: Annotated[
        Optional[int],
        typer.Option("--bills", min=0, max=200, metavar="B", help="Tables that want to pay."),
    ] = None,
    orders: Annotated[
        Optional[int],
        typer.Option("--orders", min=0, max=200, metavar="O", help="Tables that want to order."),
    ] = None,
    refills: Annotated[
        Optional[int],
        typer.Option("--refills", min=0, max=200, metavar="R", help="Tables with an empty jug."),
    ] = None,
    unsolvable: Annotated[
        Optional[Unsolvable],
        typer.Option(
            "--unsolvable",
            metavar="REASON",
            help=f"A scenario without a plan: {', '.join(Unsolvable.__members__)}.",
        ),
    ] = None,
    output: OutputOption = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace FILE where it is there already.")
    ] = False,
    as_json: JsonOption = False,
) -> int:
    """Make a new layout, or with --scenario an evening in one.  It is always valid.

    On a terminal and without options it asks.

    \b
    Examples:
      waiter layout new --tables 6 --nodes 15 --seed 3 -o cafe.yaml
      waiter layout new --tables 12 --nodes 30 --bar --waiters 2
      waiter layout new --scenario --layout cafe.yaml --bills 1 -o evening.yaml
    """
    restaurant: dict[str, object] = {
        "--tables": tables, "--nodes": nodes, "--bar": bar, "--waiters": waiters, "--flaw": flaw,
    }  # fmt: skip
    evening: dict[str, object] = {
        "--layout": layout, "--parties": parties, "--bills": bills, "--orders": orders,
        "--refills": refills, "--unsolvable": unsolvable,
    }  # fmt: skip
    given = (*restaurant.values(), *evening.values(), seed, name)
    if not scenario and all(value is None for value in given):
        if sys.stdin.isatty() and sys.stdout.isatty() and not as_json:
            tables, nodes, waiters, bar, name, seed, output = _ask(output)
    else:
        _check_options(scenario, restaurant, evening)
    if output is not None and os.path.isfile(output) and not force:
        _refuse(f"{output} is there already", "give another name, or --force to replace it")
    from random import SystemRandom

    from waiter_cli.console.output import print_document, print_text

    chance = seed if seed is not None else SystemRandom().randrange(10_000)
    if scenario:
        wish = (parties if parties is not None else 2, bills or 0, orders or 0, refills or 0)
        reason = None if unsolvable is None else unsolvable.value
        text = _scenario(layout or "", output, chance, wish, reason, name)
    else:
        tables = 6 if tables is None else tables
        kind = None if flaw is None else flaw.value
        text = _layout(tables, nodes, chance, bool(bar), waiters, name or _stem(output), kind)
    if output is not None:
        from waiter_cli.file_access.atomic import write_whole

        write_whole(output, text)
        print_text(f"wrote {output}", sys.stderr)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json({"status": "made", "seed": chance, "file": output, "text": text})
    elif output is None:
        print_document(text)
    return 0


def _refuse(message: str, hint: str) -> None:
    from waiter_cli.errors import InputError

    raise InputError(message, hint)


def _check_options(
    scenario: bool, restaurant: dict[str, object], evening: dict[str, object]
) -> None:
    """Raises `InputError` for options that go with the other of the two files."""
    odd = [
        name for name, value in (restaurant if scenario else evening).items() if value is not None
    ]
    if odd:
        head = ", ".join(odd[:-1])
        named = f"{head} and {odd[-1]}" if head else odd[0]
        verb = "is" if len(odd) == 1 else "are"
        if scenario:
            mend = "make the layout first, then the scenario for it"
            _refuse(f"{named} {verb} for a layout, and --scenario makes a scenario", mend)
        mend = "add --scenario" + ("" if evening["--layout"] else " and --layout LAYOUT")
        _refuse(f"{named} {verb} for a scenario, and this makes a layout", mend)
    if scenario and evening["--layout"] is None:
        _refuse("a scenario for which restaurant?", "give --layout LAYOUT")


def _layout(
    tables: int,
    nodes: int | None,
    seed: int,
    bar: bool,
    waiters: int | None,
    name: str,
    flaw: str | None,
) -> str:
    """Returns the YAML text of a layout, read back to be sure of it."""
    from waiter_cli.errors import InputError
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.layout_tools.generate import generate_layout
    from waiter_cli.layout_tools.generate_floor import least_nodes
    from waiter_cli.yaml_reading.node_reader import NAME_RULE, is_identifier

    if not is_identifier(name):
        raise InputError(f"{name!r} is no name for a layout", NAME_RULE)
    if nodes is None:
        nodes = max(least_nodes(tables) + 1, round(2.4 * tables))
    if waiters is None:
        waiters = 1 if flaw == "blocked_aisle" else 0
    text = generate_layout(seed, nodes, tables, name=name, bar=bar, waiters=waiters, flaw=flaw)
    read_layout(text, f"{name}.yaml")
    return text


def _scenario(
    layout: str,
    output: str | None,
    seed: int,
    wish: tuple[int, int, int, int],
    unsolvable: str | None,
    name: str | None,
) -> str:
    """Returns the YAML text of a scenario, read back; it names its layout as seen from its own file."""
    from waiter_cli.file_access.locate import find
    from waiter_cli.files.layout_reader import one_robot, read_layout_file
    from waiter_cli.files.layout_writer import quoted
    from waiter_cli.files.scenario_reader import read_scenario
    from waiter_cli.layout_tools.generate import generate_scenario

    if layout == "-":
        _refuse("a scenario cannot name a layout from standard input", "name its file")
    read = read_layout_file(layout, several=True)
    if unsolvable is not None:
        one_robot(read, "--unsolvable")
    parties, bills, orders, refills = wish
    text = generate_scenario(
        seed, read, parties, bills, orders=orders, refills=refills, unsolvable=unsolvable
    )
    path = find(layout, "layout")
    named = layout
    if os.path.exists(layout) and not os.path.isdir(layout):
        folder = os.path.dirname(os.path.abspath(output)) if output is not None else os.getcwd()
        named = os.path.relpath(path, folder).replace(os.sep, "/")
    lines = []
    for line in text.split("\n"):
        if line.startswith("layout: "):
            line = f"layout: {quoted(named)}"
        if line.startswith("name: ") and (name or output):
            stem = name or _stem(output)
            line = f"name: {quoted(stem)}"
        lines.append(line)
    made = f"# made with seed {seed}\n" + "\n".join(lines)
    read_scenario(made, output or "scenario.yaml", read)
    return made


def _stem(output: str | None) -> str:
    """Returns a name from that of the file, where it makes one."""
    from waiter_cli.yaml_reading.node_reader import is_identifier

    stem = os.path.basename(output or "").rsplit(".", 1)[0].replace("-", "_").replace(" ", "_")
    return stem if is_identifier(stem) else "generated"


def _ask(
    output: str | None,
) -> tuple[int, int, int, bool, str, int | None, str | None]:
    """Returns the numbers of a restaurant, asked for one by one."""
    from sparc.numerals import whole
    from waiter_cli.layout_tools.generate_floor import least_nodes
    from waiter_cli.yaml_reading.node_reader import NAME_RULE, is_identifier

    def number(question: str, default: int, least: int, most: int) -> int:
        while True:
            answer = whole(str(typer.prompt(question, default=str(default))).strip())
            if answer is not None and least <= answer <= most:
                return answer
            typer.echo(f"  a number from {least} to {most}, please")

    try:
        name = ""
        while not is_identifier(name):
            name = typer.prompt("Name of the restaurant", default=_stem(output)).strip()
            if not is_identifier(name):
                typer.echo(f"  {NAME_RULE}")
        tables = number("Tables", 6, 1, 1000)
        least = least_nodes(tables)
        nodes = number(
            "Places the robot can stand", max(least + 1, round(2.4 * tables)), least, 3000
        )
        waiters = number("Other waiters", 1, 0, max(0, (nodes - tables) // 4))
        bar: bool = typer.confirm("A bar, for orders and refills", default=False)
        seed = number("Seed (the same seed makes the same restaurant)", 1, 0, MAX_SEED)
        if output is None:
            output = typer.prompt("File", default=f"{name}.yaml").strip() or None
    except typer.Abort:
        raise KeyboardInterrupt from None
    return tables, nodes, waiters, bar, name, seed, output
