"""Describes the results of trying changes of a layout in sentences. Entry point `trial_sentences`."""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.model.wording import counted
from waiter_cli.study.comparisons import ENOUGH
from waiter_cli.study.layout_trials import TrialReport
from waiter_cli.study.study_words import WORDS, amount_of, difference_sentence

__all__ = ["trial_sentences"]

BESIDE = ("lost_unseated", "lost_unserved", "served", "wait_seat_mean", "wait_plate_mean")
"""The figures that nobody would want to lose by a change."""


def trial_sentences(report: TrialReport) -> Iterator[str]:
    """Yields what was found: how it is, what is best, what that does, and how far it can be believed."""
    wording = WORDS[report.figure]
    if report.before is None:
        yield f"As it is, no evening tells of {wording.what}."
    else:
        many = counted(report.before.evenings, "evening")
        size = amount_of(report.figure, report.before.mean)
        yield f"As it is, {wording.what}: {size} on average over {many}."
    if report.best is None:
        yield from _nothing(report)
    else:
        yield from _best(report)
    if report.failed:
        verb = "is" if report.failed == 1 else "are"
        why = f": {report.reason}" if report.reason else ""
        yield f"{report.failed} of {report.runs} runs {verb} not done and left out{why}."


def _nothing(report: TrialReport) -> Iterator[str]:
    played = len(report.screened)
    if report.stopped:
        yield "The time was up before any change had been played (--time-limit)."
    elif not played:
        yield "There is no change to try."
    else:
        told = f"None of the {played} changes that were played looks"
        if played == 1:
            told = "The one change that was played does not look"
        yield f"{told} better on {counted(report.choosing, 'evening')}."


def _best(report: TrialReport) -> Iterator[str]:
    best, judged, beside = report.best, report.judged, report.beside
    assert best is not None
    heads = {
        "improved": f"A better one: {best.text}.",
        "no_improvement": f"No better one was found; what looked best was to {best.text}.",
        "undecided": f"Not shown to be better, but what looked best: {best.text}.",
    }
    yield heads[report.status]
    if judged is not None and beside is not None and beside.evenings >= ENOUGH:
        told = difference_sentence(beside, judged)
        if told:
            yield told
        for each in beside.differences:
            if each.figure in BESIDE and each.figure != report.figure:
                if each.verdict in ("more", "less") or each.figure == "lost_unseated":
                    yield difference_sentence(beside, each)
    elif report.stopped:
        yield "It was played on too few evenings for an interval when the time was up."
    played, choosing = counted(len(report.screened), "change"), counted(report.choosing, "evening")
    other = "the same one" if report.judging == 1 else "the same ones"
    yield (
        f"It was chosen among {played} on {choosing} and judged on {report.judging} others, "
        f"{other} with and without it: luck helps whoever is chosen among many. {_looked(report)}"
    )
    if report.status == "undecided":
        yield (
            "The time was up (--time-limit); more of it may tell."
            if report.stopped
            else "More evenings may tell: add seeds."
        )


def _looked(report: TrialReport) -> str:
    if report.looks == 1:
        return "Its interval is of 95 %."
    return f"Its interval allows for {report.looks} looks, which together miss one time in twenty."
