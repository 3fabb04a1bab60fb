"""Writes findings as one self-contained HTML page. Entry point `report_page`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import Any

from waiter_cli.drawing.picture import draw_svg
from waiter_cli.drawing.subject import make_subject
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.study.charts import Chart
from waiter_cli.study.findings import BestLayout, Findings, WorstEvening
from waiter_cli.study.overview import Combination, combinations, common_runs
from waiter_cli.study.study_words import value_of

__all__ = ["report_page"]

STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --soft: #555; --line: #e1e1e1; --back: #fff; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e6ea; --soft: #a6acb6; --line: #3a3f47; --back: #16181c; }
}
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--back);
  margin: 2rem auto; max-width: 54rem; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin-top: 2.2rem; }
.about { color: var(--soft); margin-top: .2rem; overflow-wrap: anywhere; }
.found { font-size: 1.08rem; padding-left: 1.2rem; } .found li { margin: .35rem 0; }
figure { margin: 1.2rem 0; } figure svg { max-width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: .92rem; }
.plans { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(16rem, 1fr)); }
.plans svg { background: #fff; border-radius: .3rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .92rem; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid var(--line); text-align: right; }
th:first-child, td:first-child { text-align: left; }
.line { text-align: left; min-width: 24rem; }  code { font-size: .85em; }
@media (max-width: 40rem) { .chart { overflow-x: auto; } .chart svg { min-width: 34rem; } }
"""
COLUMNS = (
    ("lost", "parties lost", 1, 1.0),
    ("served", "served", 1, 1.0),
    ("wait_seat_mean", "wait for a table, min", 1, 60.0),
    ("wait_seat_p95", "95 %", 1, 60.0),
    ("wait_plate_mean", "for the plate", 1, 60.0),
    ("table_use", "tables taken, %", 0, 0.01),
    ("idle", "idle, %", 0, 0.01),
    ("metres", "metres", 0, 1.0),
)


def report_page(findings: Findings, charts: Sequence[Chart]) -> str:
    """Returns the page; it loads nothing from anywhere."""
    title = escape(findings.study.name)
    body = "\n".join(_parts(findings, charts))
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n"
    )


def _parts(findings: Findings, charts: Sequence[Chart]) -> Iterator[str]:
    study, counts = findings.study, findings.counts()
    yield f"<h1>{escape(study.name)}</h1>"
    yield (
        f'<p class="about">{counts["done"]} of {counts["runs"]} runs on {findings.evenings} evenings, '
        f"from {escape(study.file)}, by waiter {escape(study.version)}.</p>"
    )
    yield "<h2>What was found</h2>"
    yield f'<ul class="found">{"".join(f"<li>{escape(s)}</li>" for s in findings.sentences)}</ul>'
    if findings.common < findings.evenings:
        yield (
            f'<p class="about">Pictures and means are of the {findings.common} evenings of which '
            "all combinations have a run that is done.</p>"
        )
    for chart in charts:
        yield (
            f'<figure role="group" aria-label="{escape(chart.title)}"><h2>{escape(chart.title)}</h2>'
            f'<div class="chart">{chart.svg}</div>'
            f"<figcaption>{escape(chart.caption)}</figcaption></figure>"
        )
    yield "<h2>Means over the evenings</h2>"
    yield _table(combinations(common_runs(findings.rows)))
    if findings.best:
        yield "<h2>The layouts that lose fewest parties</h2>"
        yield f'<div class="plans">{"".join(map(_plan, findings.best))}</div>'
    if findings.worst:
        yield f"<h2>The {_counted(len(findings.worst))} and how to see them</h2>"
        yield _worst_table(findings.worst)
    yield "<h2>How this was done</h2>"
    yield (
        "<p>Guests come by chance, and what chance decides belongs to them: every combination had "
        "the same evenings, and differences are those of pairs of runs on one evening. Intervals "
        "are of the mean over evenings such as these, by the bootstrap (10,000 draws of evenings, "
        "percentiles widened for small numbers); where an interval holds 0, the data do not say "
        "which way it goes. They speak of the restaurants that were played, not of others.</p>"
    )


def _counted(number: int) -> str:
    words = {1: "worst evening", 10: "ten worst evenings"}
    return words.get(number, f"{number} worst evenings")


def _table(found: Sequence[Combination]) -> str:
    robots = any(one.agents is not None for one in found)
    head = ["layout", *(["robots"] if robots else []), "m/s", "evenings"]
    head += [heading for _, heading, _, _ in COLUMNS]
    lines = []
    for one in found:
        cells = [
            one.layout,
            *([str(one.agents)] if robots else []),
            f"{one.speed:g}",
            str(one.done),
        ]
        for figure, _, digits, unit in COLUMNS:
            value = one.means[figure]
            cells.append("–" if value is None else f"{value / unit:.{digits}f}")
        lines.append(cells)
    return _rows(head, lines)


def _rows(head: Sequence[str], lines: Sequence[Sequence[Any]]) -> str:
    top = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    below = "".join(
        f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in line)}</tr>" for line in lines
    )
    return f'<div class="wide"><table><thead><tr>{top}</tr></thead><tbody>{below}</tbody></table></div>'


def _plan(one: BestLayout) -> str:
    """Returns a layout as it is drawn; in words where it has no places."""
    try:
        drawn = draw_svg(make_subject(read_layout(one.text, one.label)))
        drawn = drawn[drawn.index("<svg") :]
    except InputError:
        drawn = "<p>It has no coordinates to be drawn by.</p>"
    wait = (
        "" if one.wait_seat_mean is None else f", {one.wait_seat_mean / 60:.1f} minutes for a table"
    )
    told = f"{escape(one.label)}: {one.lost:.1f} parties lost an evening{wait}"
    return f"<figure>{drawn}<figcaption>{told}</figcaption></figure>"


def _worst_table(worst: Sequence[WorstEvening]) -> str:
    lines = []
    for one in worst:
        row = one.row
        wait = "–" if row["wait_seat_p95"] is None else f"{row['wait_seat_p95'] / 60:.1f}"
        robots = "" if row["agents"] is None else f", {value_of('agents', row['agents'])}"
        where = f"{row['layout']}{robots}"
        lines.append(
            f"<tr><td>{row['seed']}</td><td>{escape(where)}</td><td>{row['speed']:g}</td>"
            f'<td>{row["lost"]}</td><td>{wait}</td><td class="line"><code>{escape(one.replay)}</code>'
            "</td></tr>"
        )
    head = "<th>seed</th><th>layout</th><th>m/s</th><th>lost</th><th>95 %, min</th>"
    head += '<th class="line">again</th>'
    return (
        f'<div class="wide"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>{''.join(lines)}</tbody></table></div>"
    )
