"""Pictures of a study as SVG: rows and comparisons → text. Entry points `Chart`, `draw_charts`."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import MissingError
from waiter_cli.optional_packages import extra_line
from waiter_cli.study.comparisons import Comparison, bootstrap
from waiter_cli.study.overview import common_runs
from waiter_cli.study.store import Row
from waiter_cli.study.study_words import TOLD, subject, value_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Chart", "draw_charts", "require_matplotlib"]

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#888888")
"""Told apart by nearly everybody: Okabe and Ito's."""
MOST_LINES = 7
MOST_COMPARISONS = 8
GROUPS = (
    ("parties an evening", 1.0, ("lost_unseated", "lost_unserved", "served")),
    ("minutes", 60.0, ("wait_seat_mean", "wait_order_mean", "wait_plate_mean", "wait_bill_mean")),
)
INK, LINE = "#111213", "#e1e2e3"
"""They stand for the colours of the page, light or dark, which matplotlib cannot name."""
STYLE: Any = {
    "svg.fonttype": "none",
    "text.parse_math": False,  # a layout may have a $ in its name
    "svg.hashsalt": "waiter",
    "font.family": "sans-serif",
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    **dict.fromkeys(
        ("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), INK
    ),
    "grid.color": LINE,
}


@dataclass(frozen=True)
class Chart:
    """A picture: SVG without a prolog, and what is to be seen on it."""

    title: str
    caption: str
    svg: str


def require_matplotlib() -> None:
    """Raises `MissingError` where pictures cannot be drawn."""
    try:
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise MissingError(
            "the pictures of a report need matplotlib", extra_line("study")
        ) from error


def draw_charts(rows: Sequence[Row], comparisons: Sequence[Comparison]) -> list[Chart]:
    """Returns the pictures of a study, of the evenings that all combinations have.

    Raises `MissingError` without matplotlib.
    """
    require_matplotlib()
    import matplotlib

    done = common_runs(rows)
    with matplotlib.rc_context(STYLE):
        return list(_charts(done, comparisons)) if done else []


def _charts(done: Sequence[Row], comparisons: Sequence[Comparison]) -> Iterator[Chart]:
    told = [one for one in comparisons if one.evenings][:MOST_COMPARISONS]
    if told:
        yield _differences(told)
    yield _parties_lost(done)
    yield _waits(done)
    for vary in ("agents", "speed"):
        if len({row[vary] for row in done}) > 1:
            yield _curve(done, vary)


def _differences(comparisons: Sequence[Comparison]) -> Chart:
    """Points with intervals about 0, the parties on the left and the minutes on the right."""
    lines = sum(len(figures) for _, _, figures in GROUPS[:1]) * len(comparisons)
    figure = _figure(8.6, 1.2 + 0.34 * max(lines, 4 * len(comparisons)))
    for place, (unit, size, figures) in enumerate(GROUPS, start=1):
        axes = figure.add_subplot(1, 2, place)
        labels = []
        for k, name in enumerate(figures):
            for m, comparison in enumerate(comparisons):
                found = {each.figure: each.found for each in comparison.differences}[name]
                if found is None or found.low is None or found.high is None:
                    continue
                at = -(k + 0.8 * m / len(comparisons))
                colour = COLOURS[m % len(COLOURS)]
                axes.plot([found.low / size, found.high / size], [at, at], color=colour, lw=2)
                axes.plot([found.mean / size], [at], "o", color=colour, ms=5)
            labels.append(_short(name))
        middle = 0.4 * (len(comparisons) - 1) / len(comparisons)
        axes.set_yticks([-(k + middle) for k in range(len(figures))], labels)
        axes.set_ylim(-(len(figures) - 1 + 2 * middle) - 0.4, 0.4)
        axes.axvline(0.0, color=INK, lw=1)
        axes.set_xlabel(f"difference, {unit}")
        axes.grid(axis="y", visible=False)
    handles = [
        figure.axes[0].plot([], [], "o-", color=COLOURS[m % len(COLOURS)])[0]
        for m in range(len(comparisons))
    ]
    figure.legend(
        handles, [subject(one) for one in comparisons], loc="outside upper center",
        ncols=min(2, len(comparisons)),
    )  # fmt: skip
    caption = (
        "Differences on the same evenings, with 95 % intervals: where a line crosses 0, the data do "
        "not say which way it goes."
    )
    return Chart("What differs", caption, _svg(figure, "differences"))


def _parties_lost(done: Sequence[Row]) -> Chart:
    """Boxes of the parties lost an evening, with each evening as a dot."""
    groups = _groups(done)
    figure = _figure(8.6, 1.1 + 0.45 * len(groups))
    axes = figure.add_subplot()
    values = [[row["lost"] for row in rows] for rows in groups.values()]
    places = [-k for k in range(len(values))]
    axes.boxplot(
        values, positions=places, orientation="horizontal", widths=0.5, showfliers=False,
        medianprops={"color": COLOURS[1]}, boxprops={"color": INK}, whiskerprops={"color": INK},
        capprops={"color": INK},
    )  # fmt: skip
    for place, several in zip(places, values):
        spread = [place + 0.3 * ((37 * k % 17) / 16 - 0.5) for k in range(len(several))]
        axes.plot(several, spread, "o", color=COLOURS[0], alpha=0.35, ms=4)
    axes.set_yticks(places, list(groups))
    axes.set_xlabel("parties lost an evening")
    axes.grid(axis="y", visible=False)
    caption = "Each dot is an evening; a box has half of them, its line is the median."
    return Chart("Parties that leave", caption, _svg(figure, "lost"))


def _waits(done: Sequence[Row]) -> Chart:
    """The share of evenings whose long waits are at most so long."""
    figure = _figure(8.6, 3.4)
    axes = figure.add_subplot()
    labels = []
    for k, (label, rows) in enumerate(list(_groups(done).items())[:MOST_LINES]):
        waits = sorted(
            row["wait_seat_p95"] / 60 for row in rows if row["wait_seat_p95"] is not None
        )
        if waits:
            shares = [(n + 1) / len(waits) for n in range(len(waits))]
            colour = COLOURS[k % len(COLOURS)]
            axes.step([waits[0], *waits], [0.0, *shares], where="post", color=colour)
            labels.append(label)
    axes.set_xlabel("minutes until 95 of 100 parties that sat had their table")
    axes.set_ylabel("share of evenings")
    axes.set_ylim(0, 1.02)
    if labels:
        axes.legend(list(axes.lines), labels)
    caption = (
        "Further left is better: of so many evenings the waits for a table were at most so long."
    )
    return Chart("Waits for a table", caption, _svg(figure, "waits"))


def _curve(done: Sequence[Row], vary: str) -> Chart:
    """Means with intervals of the parties lost, against a number that varies."""
    figure = _figure(8.6, 3.2)
    axes = figure.add_subplot()
    layouts = list(dict.fromkeys(row["layout"] for row in done))[:MOST_LINES]
    values = sorted({row[vary] for row in done})
    step = min(b - a for a, b in zip(values, values[1:]))
    handles: list[Any] = []
    for k, layout in enumerate(layouts):
        colour = COLOURS[k % len(COLOURS)]
        points = []
        for value in values:
            here = [r["lost"] for r in done if r["layout"] == layout and r[vary] == value]
            found = bootstrap(here)
            if found is not None:
                at = value + 0.03 * step * (k - (len(layouts) - 1) / 2)
                points.append((at, found.mean))
                if found.low is not None and found.high is not None:
                    axes.plot([at, at], [found.low, found.high], color=colour, lw=1.5)
        handles += axes.plot(*zip(*points), "o-", color=colour)
    axes.set_xticks(values, [value_of(vary, value) for value in values])
    axes.set_ylabel("parties lost an evening")
    axes.set_ylim(bottom=0)
    axes.legend(handles, layouts)
    what = "robots" if vary == "agents" else "speed"
    caption = "Means over the evenings with their 95 % intervals, which have the luck of the evenings in them."
    return Chart(f"Parties lost by {what}", caption, _svg(figure, vary))


# ---------------------------------------------------------------- small things


def _groups(done: Sequence[Row]) -> dict[str, list[Row]]:
    """Returns the runs by their combination, in words that say what varies."""
    several = [name for name in ("layout", "agents", "speed") if len({r[name] for r in done}) > 1]
    groups: dict[str, list[Row]] = {}
    for row in done:
        words = [value_of(name, row[name]) for name in several]
        groups.setdefault(", ".join(words) or row["layout"], []).append(row)
    return groups


def _short(figure: str) -> str:
    """Returns a figure's name as an axis has it."""
    what = TOLD[figure].what
    return {
        "lost_unseated": "leave unseated",
        "lost_unserved": "leave unserved",
        "served": "served",
        "wait_seat_mean": "wait for a table",
        "wait_order_mean": "wait to order",
        "wait_plate_mean": "wait for the plate",
        "wait_bill_mean": "wait for the bill",
    }.get(figure, what)


def _figure(width: float, height: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def _svg(figure: Figure, salt: str) -> str:
    """Returns a figure as SVG; its ids are its own among several on a page."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": salt}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    whole = text.getvalue()
    inside = whole[whole.index("<svg") :]
    inside = inside.replace(INK, "currentColor").replace(LINE, "var(--line)")
    return re.sub(r'id="([A-Za-z][\w.]*_\d+)"', rf'id="{salt}-\1"', inside)
