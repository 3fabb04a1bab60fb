"""``waiter study show``: how a study stands, in a table; or a layout of it as it was played."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import JsonOption

if TYPE_CHECKING:
    from waiter_cli.study.overview import Combination
    from waiter_cli.study.store import Row, Store, StoredStudy

__all__ = ["StoreArgument", "show"]

StoreArgument = Annotated[
    str, typer.Argument(metavar="FILE", help="The store that waiter study run made.")
]
SHOWN = (
    ("lost", "lost", 1, 1.0),
    ("served", "served", 1, 1.0),
    ("wait_seat_mean", "seat min", 1, 60.0),
    ("wait_seat_p95", "p95", 1, 60.0),
    ("wait_plate_mean", "plate min", 1, 60.0),
    ("metres", "metres", 0, 1.0),
)
REASONS = 5


def show(
    store: StoreArgument,
    layout_of: Annotated[
        Optional[int],
        typer.Option(
            "--layout-of", min=1, metavar="RUN", help="Print the layout of a run, by its number."
        ),
    ] = None,
    scenario_of: Annotated[
        Optional[int],
        typer.Option(
            "--scenario-of",
            min=1,
            metavar="RUN",
            help="Print the scenario of a run, by its number.",
        ),
    ] = None,
    as_json: JsonOption = False,
) -> int:
    """Show how a study stands: what was played, and means over its evenings.

    \b
    Examples:
      waiter study show friday.db
      waiter study show friday.db --layout-of 3 > layout.yaml
    """
    from waiter_cli.study.overview import combinations
    from waiter_cli.study.store import Store

    with Store(store) as opened:
        study = opened.study()
        rows = opened.rows()
        for kind, number in (("layout", layout_of), ("scenario", scenario_of)):
            if number is not None:
                return _text(opened, kind, number, rows, as_json)
    found = combinations(rows)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json(_document(study, store, found, rows))
    else:
        _print(study, found, rows)
    return 0


def _text(store: Store, kind: str, number: int, rows: list[Row], as_json: bool) -> int:
    """Prints the ``layout`` or ``scenario`` of the run of that number."""
    from waiter_cli.console.output import print_document, print_json
    from waiter_cli.errors import InputError

    row = next((row for row in rows if row["number"] == number), None)
    if row is None:
        known = (
            f"runs are numbered from {rows[0]['number']} to {rows[-1]['number']}" if rows else ""
        )
        raise InputError(f"--{kind}-of {number}: no such run has ended", known or None)
    read = store.layout_text if kind == "layout" else store.scenario_text
    text = read(row[f"{kind}_digest"])
    if as_json:
        print_json({"status": kind, "run": number, "name": row[kind], "text": text})
    else:
        print_document(text)
    return 0


def _counts(study: StoredStudy, rows: list[Row]) -> dict[str, int]:
    statuses = [row["status"] for row in rows]
    counts = {status: statuses.count(status) for status in ("done", "failed", "limit")}
    return {"runs": study.planned, **counts, "left": study.planned - len(rows)}


def _reasons(rows: list[Row]) -> list[dict[str, Any]]:
    """Returns why runs have failed or reached a limit, the most frequent reasons first."""
    reasons: dict[tuple[str, str], list[int]] = {}
    for row in rows:
        if row["status"] != "done":
            reasons.setdefault((row["status"], row["reason"] or ""), []).append(row["number"])
    ordered = sorted(reasons.items(), key=lambda item: -len(item[1]))
    return [
        {"status": status, "reason": reason, "runs": len(numbers), "first": numbers[0]}
        for (status, reason), numbers in ordered
    ]


def _document(
    study: StoredStudy, path: str, found: list[Combination], rows: list[Row]
) -> dict[str, Any]:
    counts = _counts(study, rows)
    return {
        "status": "incomplete" if counts["left"] else "complete",
        "study": study.name,
        "file": study.file,
        "store": path,
        "version": study.version,
        "varied": list(study.varied),
        **counts,
        "combinations": [each.document() for each in found],
        "reasons": _reasons(rows),
    }


def _print(study: StoredStudy, found: list[Combination], rows: list[Row]) -> None:
    from waiter_cli.console.output import print_table, print_text, say
    from waiter_cli.model.wording import counted

    counts = _counts(study, rows)
    told = [f"{counts['done']} of {counted(study.planned, 'run')} done"]
    told += [f"{counts['failed']} failed"] if counts["failed"] else []
    told += [f"{counts['limit']} at a limit"] if counts["limit"] else []
    told += [f"{counts['left']} left"] if counts["left"] else []
    say(f"{study.name}: {', '.join(told)}.")
    if found:
        print_text("")
        named = [("layout", True), ("robots", any(one.agents is not None for one in found))]
        head = [word for word, there in named if there] + ["m/s", "runs"]
        table = []
        for one in found:
            cells = [one.layout, *([str(one.agents)] if named[1][1] else []), f"{one.speed:g}"]
            table.append(
                [
                    *cells,
                    str(one.done),
                    *(_cell(one, figure, digits, unit) for figure, _, digits, unit in SHOWN),
                ]
            )
        head += [heading for _, heading, _, _ in SHOWN]
        print_table(head, table, right=range(1, len(head)))
    for reason in _reasons(rows)[:REASONS]:
        word = "reached a limit" if reason["status"] == "limit" else "failed"
        say(f"{counted(reason['runs'], 'run')} {word} (run {reason['first']}): {reason['reason']}")


def _cell(one: Combination, figure: str, digits: int, unit: float) -> str:
    value = one.means[figure]
    return "-" if value is None else f"{value / unit:.{digits}f}"
