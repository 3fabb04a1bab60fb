"""``layout improve --study``: the change that makes evenings better, judged by evenings in pairs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from waiter_cli.model.layout import Layout
    from waiter_cli.study.comparisons import Comparison, Difference
    from waiter_cli.study.layout_trials import TrialReport
    from waiter_cli.study.studies import Study

__all__ = ["EveningOptions", "find_by_evenings", "print_trials", "trials_document"]

SEEDS = tuple(range(1, 51))


@dataclass(frozen=True)
class EveningOptions:
    """The options of ``--study``: its file, the figure, and how it is played."""

    study: str
    figure: str
    edges: bool
    tables: bool
    tries: int
    seconds: float
    workers: int | None = None
    memory: int | None = None


def find_by_evenings(
    layout: Layout, options: EveningOptions, progress: Callable[[str], object]
) -> TrialReport:
    """Returns what came of trying changes; raises `InputError` for what does not fit."""
    from waiter_cli.study.layout_trials import TrialBudget, require_figure, try_changes
    from waiter_cli.study.local_workers import LocalWorkers, memory_of_each, workers_here
    from waiter_cli.study.studies import RunLimits

    figure = require_figure(options.figure)
    study = _evenings(options.study, layout)
    number = options.workers or workers_here()
    memory = options.memory or memory_of_each(number)
    with LocalWorkers(number, RunLimits(max(1.0, options.seconds), memory)) as workers:
        return try_changes(
            layout, study, figure, workers.play, edges=options.edges, tables=options.tables,
            budget=TrialBudget(options.seconds, options.tries, options.memory), progress=progress,
        )  # fmt: skip


def _evenings(name: str, layout: Layout) -> Study:
    """Returns the evenings of a study's file, or of a scenario with guests by chance."""
    import os

    from waiter_cli.errors import Fault, InputError, Where
    from waiter_cli.file_access.kinds import told_as_it_is
    from waiter_cli.file_access.locate import read_text
    from waiter_cli.files.scenario_reader import read_scenario
    from waiter_cli.study.studies import Study
    from waiter_cli.study.study_file import SPEED, read_study
    from waiter_cli.yaml_reading.yaml_tree import Mapping, compose

    where = Where("--study")
    file = read_text(name, "study", where=where)
    root = compose(file.text, file.shown).root
    keys = {key.text for key, _ in root.entries} if isinstance(root, Mapping) else set()
    if not keys & {"layouts", "vary", "evenings"}:
        stem = os.path.basename(file.shown).rsplit(".", 1)[0]
        study = Study(stem, file.shown, (), (SPEED,), file.shown, file.text, SEEDS, ())
    else:
        folder = None if file.path is None else os.path.dirname(file.path)
        with told_as_it_is(file.text, file.shown, "a study", where):
            study = read_study(file.text, file.shown, folder)
    with told_as_it_is(study.scenario_text, study.scenario, "a scenario", where):
        scenario = read_scenario(study.scenario_text, study.scenario, layout)
    if scenario.guests is None:
        told = f"{study.scenario} has no guests who come by chance"
        raise InputError([Fault(where, told, "give a scenario with guests")])
    return study


def trials_document(report: TrialReport, top: int) -> dict[str, Any]:
    """Returns the JSON form of a report."""
    from waiter_cli.study.layout_trials import BETTER
    from waiter_cli.study.trial_words import trial_sentences

    best, before = report.best, report.before
    document = None
    if best is not None:
        document = {
            "kind": best.kind,
            "change": best.text,
            **_difference(report.beside, report.judged),
        }
    return {
        "status": report.status,
        "layout": report.layout.name,
        "study": report.study.name,
        "for": report.figure,
        "better": BETTER[report.figure],
        "before": None if before is None else round(before.mean, 4),
        "best": document,
        "beside": [
            {"figure": each.figure, **_difference(report.beside, each)}
            for each in (report.beside.differences if report.beside is not None else ())
            if each.figure != report.figure
        ],
        "screened": [
            {
                "kind": one.change.kind,
                "change": one.change.text,
                "mean": round(one.mean, 4),
                "evenings": one.evenings,
            }
            for one in report.screened[:top]
        ],
        "choosing": report.choosing,
        "judging": report.judging,
        "looks": report.looks,
        "tried": len(report.screened),
        "candidates": report.candidates,
        "runs": report.runs,
        "failed": report.failed,
        "stopped": report.stopped or None,
        "sentences": list(trial_sentences(report)),
    }


def _difference(beside: Comparison | None, each: Difference | None) -> dict[str, Any]:
    from waiter_cli.study.study_words import difference_sentence

    difference = None if each is None else each.found
    return {
        "mean": None if difference is None else round(difference.mean, 4),
        "low": None if difference is None or difference.low is None else round(difference.low, 4),
        "high": None
        if difference is None or difference.high is None
        else round(difference.high, 4),
        "verdict": "too_few" if each is None else each.verdict,
        "sentence": (difference_sentence(beside, each) or None) if beside and each else None,
    }


def print_trials(report: TrialReport) -> None:
    """Prints a report for people."""
    from waiter_cli.console.output import print_text, say
    from waiter_cli.console.styling import styled
    from waiter_cli.study.trial_words import trial_sentences

    say(f"{styled(report.layout.name, 'bold')}, on the evenings of {report.study.scenario}:")
    for sentence in trial_sentences(report):
        say(f"- {sentence}")
    played = len(report.screened)
    if played != report.candidates and not report.stopped:
        print_text("")
        say(
            f"{played} of {report.candidates} changes were played, those that save most walking "
            "(--tries)."
        )
    if report.stopped:
        print_text("the time was up", sys.stderr)
