"""Finds the change of a layout that makes evenings better: `Layout`, `Study` → `TrialReport`.

Entry point `try_changes`.  Changes are proposed by walking an evening of today again on the changed
floor.  Those that promise most are played on a few evenings, all on the same ones; those whose mean
paired difference is best stay in, and get more evenings (sequential halving: Z. Karnin, T. Koren,
O. Somekh, "Almost Optimal Exploration in Multi-Armed Bandits", ICML 2013).

Whoever wins a choice among many was lucky, too.  So the winner is judged on other evenings, which had no
part in the choice, more and more of them until an interval says which way it goes.  Each look at the
interval takes its share of the error (Bonferroni), so that all looks together are wrong one time in
twenty.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import fsum
from time import monotonic
from typing import Any

from sparc.lazy_dataclass import dataclass
from sparc.limits import OverLimit, begin, end
from waiter_cli import __version__
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.layout_tools.advice import physical
from waiter_cli.layout_tools.layout_changes import ChangesEnded, LayoutChange, changes, passed
from waiter_cli.layout_tools.stop_walks import Stop, StopJudge, WalkedTour
from waiter_cli.model.layout import Layout
from waiter_cli.model.wording import counted
from waiter_cli.spelling import did_you_mean
from waiter_cli.study.comparisons import (
    ENOUGH,
    Comparison,
    Difference,
    Interval,
    compare_values,
    difference_of,
    level_of,
    numpy_or_missing,
    paired_differences,
)
from waiter_cli.study.evening_run import evening_events
from waiter_cli.study.fleet_size import with_fleet_size
from waiter_cli.study.store import Row
from waiter_cli.study.studies import RunResult, Study, StudyLayout, StudyRun, runs_of

__all__ = ["BETTER", "Screened", "TrialBudget", "TrialReport", "require_figure", "try_changes"]

BETTER = {
    name: "more" if name == "served" else "less"
    for name in FIGURES
    if name not in ("parties", "guests", "table_use", "idle")
}
"""The figures by which a layout can be better, and which way that is."""
FEWEST = 10
"""So many evenings it takes: some to choose by, others to judge by."""
CHOICE = 12
"""By so many evenings a change is chosen at most."""
KEPT = 3
"""One of so many changes stays in after a round."""
FIRST_LOOK = 8
ERROR = 0.05

Play = Callable[[Iterator[StudyRun], float], Iterator[RunResult]]


@dataclass(frozen=True)
class TrialBudget:
    """``seconds`` for everything, ``tries`` changes that are played at most.

    ``memory`` is the bytes that this process may take, None half of what is free.
    """

    seconds: float = 600.0
    tries: int = 24
    memory: int | None = None


@dataclass(frozen=True)
class Screened:
    """A change that was played in the choice: its mean difference over so many evenings."""

    change: LayoutChange
    mean: float
    evenings: int


@dataclass(frozen=True)
class TrialReport:
    """The best change that was found, and what the evenings say of it.

    ``status`` is ``improved``, ``no_improvement`` or ``undecided``; ``before`` is the figure as it is.
    ``screened`` are the changes that were played, best first, of so many ``candidates``.  ``best`` was
    played on ``judging`` evenings, none of which is among the ``choosing`` ones: ``judged`` has the interval
    on them, one of at most ``looks``, and ``beside`` compares the other figures there.  ``runs`` were
    played, ``failed`` of them are not done, most of them for ``reason``.  ``stopped`` is ``time`` where
    that ended it, else empty.
    """

    layout: Layout
    study: Study
    figure: str
    status: str
    before: Interval | None
    screened: tuple[Screened, ...]
    candidates: int
    best: LayoutChange | None = None
    judged: Difference | None = None
    beside: Comparison | None = None
    choosing: int = 0
    judging: int = 0
    looks: int = 0
    runs: int = 0
    failed: int = 0
    reason: str | None = None
    stopped: str = ""


def require_figure(name: str) -> str:
    """Returns the name of a figure by which layouts can be better; raises `InputError` for others."""
    if name in BETTER:
        return name
    where = Where("--for")
    if name in FIGURES:
        told = f"of {name} neither more nor less is better"
        raise InputError([Fault(where, told, f"choose one of {', '.join(BETTER)}")])
    hint = did_you_mean(name, BETTER, "figure")
    raise InputError([Fault(where, f"there is no figure {name}", hint)])


def try_changes(
    layout: Layout,
    study: Study,
    figure: str,
    play: Play,
    *,
    edges: bool = True,
    tables: bool = True,
    budget: TrialBudget = TrialBudget(),
    progress: Callable[[str], object] = lambda text: None,
) -> TrialReport:
    """Returns what came of looking for the one change that makes a figure better.

    Of ``study`` the evenings are taken, with the speeds and the numbers of robots; the layouts are not.
    ``play`` plays runs and yields their results as they come, until a time of the monotonic clock; it is
    asked several times.  Raises `InputError` for a study with too few evenings, and where the layout
    cannot be played as it is; `MissingError` without numpy; `OverLimit` where the memory is used up.
    """
    numpy_or_missing()
    if len(study.seeds) < FEWEST:
        told = f"it takes {FEWEST} evenings, some to choose by and others to judge by"
        raise InputError([Fault(Where(study.file), told, f"write seeds: 1..{3 * FEWEST}")])
    trials = _Trials(layout, study, figure, play, monotonic() + budget.seconds, progress)
    promising, count = _proposed_in_time(trials, edges, tables, budget)
    trials.take(promising)
    choosing = study.seeds[: min(CHOICE, len(study.seeds) // 3)]
    judging = study.seeds[len(choosing) :]
    looks = _looks(len(judging))
    best, stopped = None, ""
    try:
        best = _chosen(trials, choosing)
        if best is not None:
            _judge(trials, best, judging, looks)
    except _TimeIsUp:
        stopped = "time"
        best = best or next((one.change for one in trials.screened()), None)
    judged, beside = None, None
    if best is not None:
        judged = trials.judged(best, judging, 1 - ERROR / len(looks))
        beside = trials.compared(best, judging)
    failed = [row["reason"] for row in trials.rows if row["status"] != "done"]
    reasons = dict(Counter(failed).most_common())
    return TrialReport(
        layout, study, figure, _status(figure, judged, stopped),
        level_of(trials.rows_of(None), figure), tuple(trials.screened()), count, best, judged,
        beside, len(choosing), 0 if beside is None else beside.evenings, len(looks),
        len(trials.rows), sum(reasons.values()), next(iter(reasons), None), stopped,
    )  # fmt: skip


def _judge(trials: _Trials, best: LayoutChange, seeds: Sequence[int], looks: Sequence[int]) -> None:
    """Plays a change on more and more evenings until an interval says which way it goes."""
    for many in looks:
        trials.play([best], seeds[:many], f"judging: {best.text}")
        if trials.judged(best, seeds, 1 - ERROR / len(looks)).verdict in ("more", "less"):
            return


def _status(figure: str, judged: Difference | None, stopped: str) -> str:
    if judged is None:
        return "undecided" if stopped else "no_improvement"
    if judged.verdict in ("more", "less"):
        return "improved" if judged.verdict == BETTER[figure] else "no_improvement"
    return "undecided"


def _looks(most: int) -> list[int]:
    """Returns after how many evenings the interval is looked at.

    >>> _looks(38), _looks(7)
    ([8, 16, 32, 38], [7])
    """
    looks, size = [], FIRST_LOOK
    while size < most:
        looks.append(size)
        size *= 2
    return [*looks, most]


def _chosen(trials: _Trials, seeds: Sequence[int]) -> LayoutChange | None:
    """Returns the change that stays in longest; None where none looks better than nothing at all."""
    left = list(trials.changes)
    rounds = max(1, math.ceil(math.log(max(1, len(left)), KEPT)))
    for number in range(1, rounds + 1):
        share = number * (number + 1) / (rounds * (rounds + 1))  # later rounds have more evenings
        upto = len(seeds) if number == rounds else max(number, round(len(seeds) * share))
        trials.play(left, seeds[:upto], counted(len(left), "change"))
        ranked = [one for one in trials.screened(left) if trials.is_better(one.mean)]
        left = [one.change for one in ranked[: max(1, math.ceil(len(left) / KEPT))]]
    return left[0] if left else None


# ---------------------------------------------------------------- what is proposed


def _proposed_in_time(
    trials: _Trials, edges: bool, tables: bool, budget: TrialBudget
) -> tuple[list[LayoutChange], int]:
    """Returns what `_proposed` does; nothing where the time is up before an evening of today is walked."""
    begin(max(0.0, trials.end - monotonic()), budget.memory)
    try:
        return _proposed(trials, edges, tables, budget.tries)
    except OverLimit as over:
        if over.limit != "time":
            raise
        return [], 0
    finally:
        end()


def _proposed(
    trials: _Trials, edges: bool, tables: bool, most: int
) -> tuple[list[LayoutChange], int]:
    """Returns at most so many changes that fit on the floor, and how many were looked at.

    Those come first that save most walking.  When the time is up it is those that were found by then.
    """
    layout = trials.layout
    judge = StopJudge(layout, [_tour(layout, evening_events(trials.first_run()))])
    proposals: list[LayoutChange] = []
    promises = []
    try:
        for change in changes(layout, None, edges, tables, trials.end):
            promises.append((judge.promise(change), change.text, len(proposals)))
            proposals.append(change)
    except ChangesEnded:
        pass
    flaws = sum(1 for _ in physical(layout))
    placed = all(node.at is not None for node in layout.nodes)
    fit: list[LayoutChange] = []
    texts = {write_layout(layout)}
    for _, _, n in sorted(promises):
        if len(fit) == most or passed(trials.end):
            break
        text = write_layout(proposals[n].layout)
        if text in texts or (placed and sum(1 for _ in physical(proposals[n].layout)) > flaws):
            continue
        texts.add(text)
        fit.append(proposals[n])
    return fit, len(proposals)


def _tour(layout: Layout, events: Sequence[dict[str, Any]]) -> WalkedTour:
    """Returns the stops of an evening that was played."""
    places: dict[str, Stop] = {"picked": ("entrance", "")}
    places |= dict.fromkeys(("sent", "taken_up"), ("bar", ""))
    tables = ("seated", "bill", "ordered", "brought", "refilled", "chairs")
    stops = [
        ("table", str(event["table"])) if event["type"] in tables else places[event["type"]]
        for event in events
        if event["type"] in places or event["type"] in tables
    ]
    posts = frozenset(node for _, node in layout.waiters)
    return WalkedTour(layout.agent, posts, tuple(stops))


# ---------------------------------------------------------------- what is played


class _TimeIsUp(Exception):
    """The budget is used up."""


class _Trials:
    """The runs that were played: of the layout as it is and of changes, on common evenings."""

    def __init__(
        self, layout: Layout, study: Study, figure: str, play: Play, end: float,
        progress: Callable[[str], object],
    ) -> None:  # fmt: skip
        self.layout, self.study, self.figure = layout, study, figure
        self.rows: list[Row] = []
        self.changes: list[LayoutChange] = []
        self.end = end
        self._play, self._progress = play, progress
        self._fleets = list(dict.fromkeys(each.agents for each in study.layouts)) or [None]
        self._played: set[str] = set()

    def take(self, found: Sequence[LayoutChange]) -> None:
        """Sets the changes that are tried, the most promising ones first."""
        self.changes = list(found)

    def first_run(self) -> StudyRun:
        """Returns the first evening of the layout as it is."""
        return next(self._runs([None], self.study.seeds[:1]))

    def play(self, found: Sequence[LayoutChange], seeds: Sequence[int], doing: str) -> None:
        """Plays the layout as it is and changes of it on evenings, as far as that has not been done."""
        todo = {run.key: run for run in self._runs([None, *found], seeds)}
        todo = {key: run for key, run in todo.items() if key not in self._played}
        if not todo:
            return
        self._progress(f"{doing}, {counted(len(todo), 'evening')}")
        results = self._play(iter(list(todo.values())), self.end)
        try:
            while todo:
                result = None if monotonic() > self.end else next(results, None)
                if result is None:
                    raise _TimeIsUp
                self._note(todo.pop(result.key), result)
        finally:
            close = getattr(results, "close", None)
            if close is not None:
                close()

    def rows_of(self, change: LayoutChange | None) -> list[Row]:
        """Returns the rows of a change, None of the layout as it is."""
        label = "" if change is None else change.text
        return [row for row in self.rows if row["layout"] == label]

    def screened(self, among: Sequence[LayoutChange] | None = None) -> list[Screened]:
        """Returns the changes that were played, the best ones first; of equal ones whoever promised most."""
        found = []
        for change in self.changes if among is None else among:
            values = paired_differences(self.rows, "layout", "", change.text, self.figure)
            if values:
                found.append(Screened(change, fsum(values) / len(values), len(values)))
        sign = -1.0 if BETTER[self.figure] == "more" else 1.0
        # Whoever was played on more evenings was better on the first ones.
        return sorted(found, key=lambda one: (-one.evenings, sign * one.mean))

    def is_better(self, mean: float) -> bool:
        """Returns whether a mean difference goes the right way."""
        return mean > 0 if BETTER[self.figure] == "more" else mean < 0

    def judged(self, change: LayoutChange, seeds: Sequence[int], level: float) -> Difference:
        """Returns what evenings say of the figure, with an interval of a level."""
        rows = self._on(seeds)
        return difference_of(rows, "layout", "", change.text, self.figure, level)

    def compared(self, change: LayoutChange, seeds: Sequence[int]) -> Comparison:
        """Returns what evenings say of all figures."""
        comparison = compare_values(self._on(seeds), "layout", "", change.text)
        return replace(comparison, vary="change", first=self.layout.name)

    def _on(self, seeds: Sequence[int]) -> list[Row]:
        among = set(seeds)
        return [row for row in self.rows if row["seed"] in among]

    def _note(self, run: StudyRun, result: RunResult) -> None:
        self._played.add(run.key)
        figures = result.figures or dict.fromkeys(FIGURES)
        where = {
            "layout": run.layout.label, "agents": run.layout.agents, "speed": run.speed,
            "seed": run.seed, "status": result.status, "reason": result.reason,
        }  # fmt: skip
        self.rows.append({**figures, **where})
        if not run.layout.label and result.status == "failed" and len(self.rows_of(None)) >= ENOUGH:
            if all(row["status"] == "failed" for row in self.rows_of(None)):
                told = f"its evenings cannot be played as it is: {result.reason}"
                hint = "mend the layout, or the scenario of its evenings"
                raise InputError([Fault(Where(run.layout.file), told, hint)])

    def _runs(
        self, found: Sequence[LayoutChange | None], seeds: Sequence[int]
    ) -> Iterator[StudyRun]:
        """Yields runs; the layout as it is has no label."""
        layouts = tuple(
            StudyLayout(
                "" if change is None else change.text,
                write_layout(made if agents is None else with_fleet_size(made, agents)),
                self.layout.file or self.layout.name,
                agents,
            )
            for change in found
            for made in (self.layout if change is None else change.layout,)
            for agents in self._fleets
        )
        yield from runs_of(replace(self.study, layouts=layouts, seeds=tuple(seeds)), __version__)
