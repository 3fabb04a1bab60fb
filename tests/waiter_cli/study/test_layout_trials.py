"""Changes of a layout judged by evenings: found where they help, not where only luck does."""

from __future__ import annotations

import itertools
import random
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from sparc.limits import pending
from tests.support.cli import waiter
from tests.support.shapes import differences
from tests.support.tool_documents import IMPROVED_BY_EVENINGS
from waiter_cli.errors import InputError
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.study import layout_trials
from waiter_cli.study.layout_trials import TrialBudget, TrialReport, require_figure, try_changes
from waiter_cli.study.studies import RunResult, Study, StudyRun
from waiter_cli.study.trial_words import trial_sentences

pytest.importorskip("numpy")

# The way to the far table leads round an empty middle; the edge a-d cuts it short.
DETOUR = """\
name: detour
nodes: {a: [0, 0], b: [0, 6], c: [6, 6], d: [6, 0], e: [12, 0]}
edges: [[a, b], [b, c], [c, d], [d, e]]
entrance: a
agent: b
tables: {far: {capacity: 4, nodes: [e], at: [12, -1.2]}, near: {capacity: 4, nodes: [c], at: [6, 7.2]}}
"""
LAYOUT = read_layout(DETOUR, "detour.yaml")
STUDY = Study("invented", "study.yaml", (), (0.8,), "friday.yaml", "", tuple(range(1, 41)), ())
Figure = Callable[[str, int], "float | None"]


class Invented:
    """Plays nothing: a figure is what a function says of the change and the evening."""

    def __init__(self, figure: Figure, name: str = "wait_seat_p95", status: str = "done") -> None:
        self.figure, self.name, self.status = figure, name, status
        self.played: list[tuple[str, int]] = []

    def __call__(self, runs: Iterator[StudyRun], until: float) -> Iterator[RunResult]:
        for run in runs:
            self.played.append((run.layout.label, run.seed))
            value = self.figure(run.layout.label, run.seed)
            figures = {**dict.fromkeys(FIGURES, 0.0), self.name: value}
            yield RunResult(run.key, self.status, None, figures)


@pytest.fixture(autouse=True)
def unplayed(monkeypatch: pytest.MonkeyPatch) -> None:
    """No evening is played to walk it again, unless by the command itself."""
    monkeypatch.setattr(layout_trials, "evening_events", lambda run: [])


def tried(play: Invented, study: Study = STUDY, seconds: float = 600.0) -> TrialReport:
    return try_changes(LAYOUT, study, play.name, play, budget=TrialBudget(seconds, 8))


def luck(label: str, seed: int) -> float:
    """What an evening is like whatever the layout: it cancels in pairs."""
    return 600.0 + 90.0 * (seed % 7)


def test_what_helps_is_found_and_judged_on_other_evenings() -> None:
    chance = random.Random(5)

    def figure(label: str, seed: int) -> float:
        return (
            luck(label, seed) + (-60.0 if label == "swap far and near" else 0.0) + chance.random()
        )

    play = Invented(figure)
    report = tried(play)
    assert report.status == "improved" and report.best is not None and report.judged is not None
    assert report.best.text == "swap far and near"
    found = report.judged.found
    assert found is not None and found.low is not None and found.high is not None
    assert found.low <= -59 and found.high >= -61 and found.high < 0
    assert (report.choosing, report.judging, report.looks) == (12, 8, 3)
    others = {label for label, _ in play.played} - {"", report.best.text}
    assert others and all(seed <= 12 for label, seed in play.played if label in others)
    assert len(set(play.played)) == len(play.played), "no evening is played twice"
    as_it_is = {seed for label, seed in play.played if not label}
    assert {seed for _, seed in play.played} == as_it_is
    head, best, *_ = trial_sentences(report)
    assert (
        head.startswith("As it is, the 95 % wait for a table: 14.") and "over 20 evenings" in head
    )
    assert best == "A better one: swap far and near."


def test_more_is_better_of_what_is_served() -> None:
    report = tried(
        Invented(lambda label, seed: 30 + seed % 3 + (label == "move far to b"), "served")
    )
    assert report.status == "improved" and report.best is not None
    assert report.best.text == "move far to b"


def test_luck_is_not_taken_for_a_help() -> None:
    """Whoever is best of eight by luck alone is called better once in forty, as the interval says."""
    told = by_luck_alone(12)
    assert told.count("improved") <= 1
    assert told.count("undecided") > 6


@pytest.mark.slow
def test_luck_is_hardly_ever_taken_for_a_help() -> None:
    told = by_luck_alone(30)
    assert told.count("improved") <= 3
    assert told.count("undecided") > 20


def by_luck_alone(number: int) -> list[str]:
    """What is said of layouts between which nothing but chance makes a difference."""
    told = []
    for chance in map(random.Random, range(number)):
        told.append(tried(Invented(lambda label, seed, c=chance: c.gauss(600, 60))).status)
    return told


def test_nothing_better_is_said() -> None:
    report = tried(Invented(lambda label, seed: luck(label, seed) + bool(label)))
    assert (report.status, report.best, report.judging) == ("no_improvement", None, 0)
    told = list(trial_sentences(report))
    assert told[1] == "None of the 8 changes that were played looks better on 12 evenings."


def test_what_turns_out_worse_is_said() -> None:
    report = tried(Invented(lambda label, seed: luck(label, seed) + (seed - 12.5) * bool(label)))
    assert report.status == "no_improvement" and report.judged is not None
    assert report.judged.verdict == "more"
    assert list(trial_sentences(report))[1].startswith("No better one was found; what looked best")


def test_runs_that_fail_are_left_out_and_their_reason_told() -> None:
    class Partly(Invented):
        def __call__(self, runs: Iterator[StudyRun], until: float) -> Iterator[RunResult]:
            for result, run in zip(super().__call__(iter(todo := list(runs)), until), todo):
                bad = run.layout.label == "swap far and near" and run.seed % 4 == 0
                yield RunResult(run.key, "failed", "it gave up") if bad else result

    def figure(label: str, seed: int) -> float:
        return luck(label, seed) - 60.0 * (label == "swap far and near")

    report = tried(Partly(figure))
    assert report.status == "improved" and report.best is not None and report.failed
    assert report.best.text == "swap far and near"
    *_, last = trial_sentences(report)
    assert last.endswith(" runs are not done and left out: it gave up.")


def test_the_time_may_be_up() -> None:
    report = tried(Invented(luck), seconds=0.0)
    assert (report.status, report.stopped, report.runs) == ("undecided", "time", 0)
    assert "The time was up before any change had been played (--time-limit)." in trial_sentences(
        report
    )


def test_few_evenings_are_refused() -> None:
    with pytest.raises(InputError, match="it takes 10 evenings"):
        tried(Invented(luck), replace(STUDY, seeds=tuple(range(9))))
    assert tried(Invented(luck), replace(STUDY, seeds=tuple(range(10)))).status == "no_improvement"


def test_a_layout_that_cannot_be_played_is_refused() -> None:
    with pytest.raises(InputError, match="cannot be played as it is"):
        tried(Invented(luck, status="failed"))


@pytest.mark.parametrize(
    ("name", "told", "hint"),
    [
        ("wait_seat_p59", "there is no figure wait_seat_p59", "did you mean wait_seat_p95?"),
        ("lots", "there is no figure lots", "did you mean lost?"),
        ("idle", "of idle neither more nor less is better", "choose one of served, lost"),
    ],
)
def test_figures_are_known(name: str, told: str, hint: str) -> None:
    with pytest.raises(InputError) as raised:
        require_figure(name)
    fault = raised.value.faults[0]
    assert fault.message == told and fault.hint is not None and fault.hint.startswith(hint)


# ---------------------------------------------------------------- the command


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.undo()  # evenings are played here
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cafe.yaml").write_text(f"# mine\n{DETOUR}")
    (tmp_path / "q.yaml").write_text(
        "guests: {arrivals: {per_hour: 60}, eat: 1, bill_after: 0, patience: 2}\nminutes: 5\n"
    )
    study = "layouts: [cafe.yaml]\nevenings: {scenario: q.yaml, seeds: 1..12}\n"
    (tmp_path / "study.yaml").write_text(study)
    return tmp_path


@pytest.mark.wide
def test_the_command(folder: Path) -> None:
    line = "layout improve cafe.yaml --study study.yaml --for wait_seat_mean --workers 1"
    ran = waiter(*line.split(), "--only", "edges", "-o", "better.yaml", "--json")
    found = ran.json()
    assert not differences(found, IMPROVED_BY_EVENINGS)
    assert (ran.code, found["status"], found["for"]) == (0, "improved", "wait_seat_mean")
    assert found["best"]["change"] in ("add the edge a-d", "add the edge a-c")
    assert found["best"]["high"] < 0 and found["judging"] == 8
    assert found["runs"] < 80 and found["failed"] == 0
    text = (folder / "better.yaml").read_text()
    assert text.startswith(f"# detour, changed: {found['best']['change']}\n# mine\n")


def test_a_scenario_has_fifty_evenings(folder: Path) -> None:
    ran = waiter(
        "layout", "improve", "cafe.yaml", "--study", "q.yaml", "--workers", "1", "--only", "tables",
        "--tries", "1", "--time-limit", "0.2", "-o", "better.yaml",
    )  # fmt: skip
    assert ran.code == 0 and ran.out.startswith("detour, on the evenings of q.yaml:\n")
    assert not (folder / "better.yaml").exists() and "nothing to write" in ran.err


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ("--for lost", "--for lost is about evenings"),
        ("--workers 2 --scenario q.yaml", "--workers 2 is about evenings"),
        ("--study q.yaml --scenario q.yaml", "--scenario is about plans, --study about evenings"),
        ("--study q.yaml --for wait_seats_p95", "--for: error: there is no figure wait_seats_p95"),
        ("--study nowhere.yaml", "--study: error: there is no study nowhere.yaml"),
        ("--study cafe.yaml", "cafe.yaml is a layout, not a scenario"),
        ("--study -", "a study is not read from standard input here"),
        ("--study plain.yaml", "plain.yaml has no guests who come by chance"),
    ],
)
def test_what_cannot_be(options: str, told: str, folder: Path) -> None:
    (folder / "plain.yaml").write_text("observe: [{enter: [c1]}]\n")
    ran = waiter("layout", "improve", "cafe.yaml", *options.split())
    assert ran.code == 2 and told in ran.err and not ran.out


def test_changes_are_not_looked_for_beyond_the_time() -> None:
    play = Invented(luck)
    report = tried(play, seconds=0.0)
    assert (report.status, report.stopped, report.candidates) == ("undecided", "time", 0)
    assert not play.played


def test_the_first_evening_keeps_to_the_time(monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(run: StudyRun) -> list[object]:
        begun = time.monotonic()
        while time.monotonic() - begun < 20:
            pass
        return []

    monkeypatch.setattr(layout_trials, "evening_events", endless)
    play, begun = Invented(luck), time.monotonic()
    report = tried(play, seconds=0.3)
    assert time.monotonic() - begun < 5
    assert (report.status, report.stopped, report.candidates) == ("undecided", "time", 0)
    assert not play.played and pending() is None


def test_no_evening_is_waited_for_beyond_the_time() -> None:
    """Whoever plays has no result by then: those that there are count."""

    class Slow(Invented):
        def __call__(self, runs: Iterator[StudyRun], until: float) -> Iterator[RunResult]:
            yield from itertools.islice(super().__call__(runs, until), 30)

    report = tried(Slow(luck))
    assert (report.stopped, report.runs) == ("time", 30)
    assert report.status == "undecided"
