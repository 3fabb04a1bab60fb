"""``waiter compare``: two layouts side by side over a set of scenarios."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.command_line.completion import names_of
from waiter_cli.commands.options import (
    A_LAYOUT,
    DomainOption,
    JsonOption,
    MaxStepsOption,
    MemoryLimitOption,
    PlanOptions,
    SearchOption,
    SparcJarOption,
    Strategy,
    TranslatorName,
    TranslatorOption,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from waiter_cli.layout_tools.measure import Measured, Totals
    from waiter_cli.model.layout import Layout

__all__ = ["ScenariosOption", "SeveralScenariosOption", "compare"]

ScenariosOption = Annotated[
    Optional[list[str]],
    typer.Option("--scenarios", metavar="DIR", help="A folder of scenarios; may be given again."),
]
SeveralScenariosOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--scenario",
        "-s",
        metavar="SCENARIO",
        autocompletion=names_of("scenario"),
        help="One more scenario; may be given again.",
    ),
]


def compare(
    first: Annotated[
        str, typer.Argument(metavar="A", autocompletion=names_of("layout"), help=A_LAYOUT)
    ],
    second: Annotated[
        Optional[str],
        typer.Argument(
            metavar="B", autocompletion=names_of("layout"), help="Another layout, given likewise."
        ),
    ] = None,
    scenarios: ScenariosOption = None,
    scenario: SeveralScenariosOption = None,
    agents: Annotated[
        Optional[str],
        typer.Option(
            "--agents", metavar="N..M", help="One layout, with so many robots: does another pay?"
        ),
    ] = None,
    time_limit: Annotated[
        float,
        typer.Option(
            "--time-limit",
            min=0.0,
            metavar="SECONDS",
            help="Give up after so many seconds, for each plan.",
        ),
    ] = 20.0,
    memory_limit: MemoryLimitOption = None,
    as_json: JsonOption = False,
    search: SearchOption = Strategy.binary,
    max_steps: MaxStepsOption = None,
    domain: DomainOption = "restaurant",
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
) -> int:
    """Compare two layouts: steps, metres and waiting time over a set of scenarios.

    Waiting is the mean time until a wish is fulfilled: a party sits, a table has
    paid.

    \b
    Examples:
      waiter compare report report_large --scenario b1
      waiter compare bistro.yaml bistro-new.yaml --scenarios evenings --json
      waiter compare report_large --agents 1..3 --scenario evening.yaml
    """
    from sparc.limits import begin
    from waiter_cli.commands.compare_agents import compare_agents, read_numbers
    from waiter_cli.console.progress import alive
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.files.layout_reader import read_layout_file
    from waiter_cli.layout_tools.measure import (
        TIES,
        Measured,
        MeasuringPlanner,
        find_scenarios,
        measure,
        pose_all,
    )

    begin(None, memory_limit)
    if (second is None) == (agents is None):
        given = "B or --agents" if second is None else "not both B and --agents"
        raise InputError(f"one layout is compared with what? {given}", "see --help")
    if first == second == "-":
        raise InputError("both layouts cannot come from standard input", "name a file for one")
    found = find_scenarios(scenarios or [], scenario or [])
    numbers = None if agents is None else read_numbers(agents)
    one_layout = read_layout_file(first, "A", several=True)
    options = PlanOptions(
        search, max_steps, time_limit, memory_limit, domain, translator, sparc_jar
    )
    rules = options.load_domain()
    if not rules.built_in:
        fault = f"--domain {domain}: when a wish is fulfilled is told by built-in rules only"
        raise InputError(fault, "compare with restaurant or report")
    planner = MeasuringPlanner(
        rules, options.load_translator(), options.search.value, options.max_steps
    )
    if numbers is not None:
        return compare_agents(one_layout, found, numbers, time_limit, planner, as_json=as_json)
    layouts = (one_layout, read_layout_file(second or "", "B", several=True))
    posed = [pose_all(layout, found) for layout in layouts]
    rows: list[tuple[Measured, Measured]] = []
    with alive("planning") as note:
        for name, *pair in zip(found, *posed, strict=True):
            note(name)
            one, other = (
                p if isinstance(p, Measured) else measure(p, time_limit, TIES, planner)
                for p in pair
            )
            rows.append((one, other))
    if all("no_fit" in (one.status, other.status) for one, other in rows):
        unfit = [m for row in rows for m in row if m.status == "no_fit"]
        hint = "scenarios name tables, nodes and waiters: both layouts must have them"
        raise InputError(f"no scenario fits both layouts; {unfit[0].message}", hint)
    document = _document(layouts, rows)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json(document)
    else:
        _print(layouts, rows)
    undecided = any(m.status == "undecided" for row in rows for m in row)
    return Exit.UNDECIDED if undecided else Exit.OK


def _totals(
    layouts: Sequence[Layout], rows: list[tuple[Measured, Measured]]
) -> tuple[Totals, Totals]:
    """Returns the sums over the scenarios that have plans in both."""
    from waiter_cli.layout_tools.measure import total

    both = [row for row in rows if row[0].plan is not None and row[1].plan is not None]
    timed = all(node.at is not None for layout in layouts for node in layout.nodes)
    timed = timed and not any(layout.agents for layout in layouts)
    return total([one for one, _ in both], timed), total([other for _, other in both], timed)


def _document(
    layouts: tuple[Layout, Layout], rows: list[tuple[Measured, Measured]]
) -> dict[str, Any]:
    """Returns the document of ``--json``; differences are B less A."""
    totals = _totals(layouts, rows)
    return {
        "status": "compared",
        "layouts": [{"name": layout.name, "file": layout.file} for layout in layouts],
        "scenarios": [
            {
                "scenario": one.scenario,
                "file": one.file,
                "results": [one.document(), other.document()],
            }
            for one, other in rows
        ],
        "totals": [each.document() for each in totals],
        "difference": {
            "steps": totals[1].steps - totals[0].steps,
            "metres": round(totals[1].metres - totals[0].metres, 3),
            "waiting": round(totals[1].waiting - totals[0].waiting, 3),
        },
    }


def _print(layouts: tuple[Layout, Layout], rows: list[tuple[Measured, Measured]]) -> None:
    from waiter_cli.console.output import print_table, print_text, say
    from waiter_cli.console.styling import styled

    totals = _totals(layouts, rows)
    unit = totals[0].unit
    for sign, layout in zip("AB", layouts):
        say(f"{styled(sign, 'bold')}  {layout.name} ({layout.file})")
    print_text("")
    lines = [_row(one, other, unit) for one, other in rows]
    if totals[0].scenarios > 1:
        cells = [_cells(t.steps, t.metres, t.waiting) for t in totals]
        lines.append(_interleaved("all", *cells))
    headings = ("scenario", "steps A", "B", "metres A", "B", f"waiting A ({unit})", "B")
    print_table(headings, lines, right=range(1, 7))
    for row in rows:
        for sign, one in zip("AB", row):
            if one.plan is None:
                say(f"{one.scenario}, {sign}: {one.message}")
    if totals[0].scenarios:
        say(f"\n{_verdict(totals, unit)}", hang=0)


def _row(one: Measured, other: Measured, unit: str) -> tuple[str, ...]:
    cells = []
    for each in (one, other):
        if each.plan is None:
            word = {"no_fit": "no fit", "no_plan": "no plan"}.get(each.status, each.status)
            cells.append((word, "", ""))
            continue
        waits = each.wait_seconds if unit == "s" else each.waits
        steps, metres, waiting = _cells(
            each.steps, each.metres, sum(waits) / len(waits) if waits else 0.0
        )
        cells.append((steps + ("" if each.minimal else "?"), metres, waiting))
    return _interleaved(one.scenario, *cells)


def _cells(steps: int, metres: float, waiting: float) -> tuple[str, str, str]:
    return str(steps), f"{metres:.2f}", f"{waiting:.1f}"


def _interleaved(
    name: str, one: tuple[str, str, str], other: tuple[str, str, str]
) -> tuple[str, ...]:
    return (name, one[0], other[0], one[1], other[1], one[2], other[2])


def _verdict(totals: tuple[Totals, Totals], unit: str) -> str:
    """Returns one sentence on which layout is better in what."""
    one, other = totals
    parts = [
        _difference(one.steps, other.steps, "step", 0) or "as many steps",
        _difference(one.metres, other.metres, "metre", 2) or "as far",
    ]
    word = "second" if unit == "s" else "step"
    waits = _difference(one.waiting, other.waiting, word, 1) or "as long"
    many = "1 scenario" if one.scenarios == 1 else f"{one.scenarios} scenarios"
    return f"Over {many}, B takes {parts[0]}, walks {parts[1]}, and lets guests wait {waits}."


def _difference(before: float, after: float, unit: str, digits: int) -> str:
    """Returns the difference in numbers and per cent; empty where there is none."""
    from waiter_cli.model.wording import counted

    change = round(after - before, digits)
    if change == 0:
        return ""
    size = f"{abs(change):.{digits}f}"
    share = f" ({change / before:+.0%})" if before else ""
    return f"{counted(size, unit)} {'more' if change > 0 else 'less'}{share}"
