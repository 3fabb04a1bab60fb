"""Collects the findings of a report: a store → `Findings`. Entry point `find`."""

from __future__ import annotations

import os
import shlex
from collections.abc import Sequence
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.file_access.locate import built_in
from waiter_cli.study.comparisons import Comparison, compare_rows
from waiter_cli.study.overview import Combination, combinations, common_runs
from waiter_cli.study.store import Row, Store, StoredStudy
from waiter_cli.study.studies import BACKEND, digest_of
from waiter_cli.study.study_words import (
    comparison_sentences,
    difference_sentence,
    level_sentences,
    value_of,
)

__all__ = ["BestLayout", "Findings", "WorstEvening", "find"]

WORST = 10
BEST = 3
MOST_LAYOUTS_TOLD = 5


@dataclass(frozen=True)
class WorstEvening:
    """An evening that went badly, and the line that replays it."""

    row: Row
    replay: str

    def document(self) -> dict[str, Any]:
        """Returns it as JSON has it."""
        names = ("layout", "agents", "speed", "seed", "lost", "wait_seat_p95")
        return {"run": self.row["number"], **{n: self.row[n] for n in names}, "replay": self.replay}


@dataclass(frozen=True)
class BestLayout:
    """A layout with its means over the evenings that all have; ``text`` is YAML as it was played."""

    label: str
    lost: float
    wait_seat_mean: float | None
    text: str

    def document(self) -> dict[str, Any]:
        """Returns it as JSON has it."""
        return {"layout": self.label, "lost": self.lost, "wait_seat_mean": self.wait_seat_mean}


@dataclass(frozen=True)
class Findings:
    """All that a report says; ``sentences`` come first.

    ``best`` are layouts with the fewest parties lost, where layouts vary; ``worst`` the evenings
    with the most.
    """

    study: StoredStudy
    store: str
    rows: tuple[Row, ...]
    sentences: tuple[str, ...]
    comparisons: tuple[Comparison, ...]
    combinations: tuple[Combination, ...]
    best: tuple[BestLayout, ...]
    worst: tuple[WorstEvening, ...]

    @property
    def evenings(self) -> int:
        """Returns the number of evenings of which at least one run is done."""
        return len({row["seed"] for row in self.rows if row["status"] == "done"})

    @property
    def common(self) -> int:
        """Returns the number of evenings that are set side by side (`common_runs`)."""
        return len({row["seed"] for row in common_runs(self.rows)})

    def counts(self) -> dict[str, int]:
        """Returns how many runs there are, and how those that have ended did."""
        statuses = [row["status"] for row in self.rows]
        ended = {status: statuses.count(status) for status in ("done", "failed", "limit")}
        return {"runs": self.study.planned, **ended, "left": self.study.planned - len(self.rows)}

    def document(self) -> dict[str, Any]:
        """Returns them as JSON has them."""
        return {
            "status": "reported",
            "study": self.study.name,
            "file": self.study.file,
            "store": self.store,
            "version": self.study.version,
            "varied": list(self.study.varied),
            **self.counts(),
            "evenings": self.evenings,
            "sentences": list(self.sentences),
            "comparisons": [_comparison_document(each) for each in self.comparisons],
            "combinations": [each.document() for each in self.combinations],
            "best": [each.document() for each in self.best],
            "worst": [each.document() for each in self.worst],
        }


def find(store: Store) -> Findings:
    """Returns what the runs in a store tell; raises `MissingError` without numpy."""
    study, rows = store.study(), store.rows()
    comparisons = compare_rows(rows)
    best = _best(store, rows) if "layout" in study.varied else ()
    sentences = tuple(_sentences(study, rows, comparisons, best))
    return Findings(
        study, store.path, tuple(rows), sentences, tuple(comparisons), tuple(combinations(rows)),
        best[:BEST], tuple(_worst(store, rows)),
    )  # fmt: skip


def _sentences(
    study: StoredStudy, rows: Sequence[Row], comparisons: Sequence[Comparison],
    best: Sequence[BestLayout],
) -> list[str]:  # fmt: skip
    sentences: list[str] = []
    layouts = [one for one in comparisons if one.vary == "layout"]
    best_labels = [one.label for one in best[:BEST]]
    for one in comparisons:
        if one.vary != "layout" or len(layouts) <= MOST_LAYOUTS_TOLD or one.other in best_labels:
            sentences += comparison_sentences(one)
    if len(layouts) > MOST_LAYOUTS_TOLD:
        verdicts = [_verdict(one, "lost") for one in layouts]
        less, more = verdicts.count("less"), verdicts.count("more")
        sentences.append(
            f"Of {len(layouts)} layouts beside {layouts[0].first}, {less} lose fewer parties, {more} "
            f"lose more, and of {len(layouts) - less - more} the data do not say."
        )
    if len(comparisons) >= 20:
        sentences.append(
            "Each interval stands by itself: of twenty of them one misses by chance, so that the "
            "best of many looks better than it is."
        )
    sentences += _first_levels(study, rows)
    bad = sum(row["status"] != "done" for row in rows)
    if bad:
        verb = "is" if bad == 1 else "are"
        sentences.append(f"{_runs(bad)} {verb} not done and left out; waiter study show says why.")
    if any(row["status"] == "limit" for row in rows):
        sentences.append(
            "What takes too long is often what is busiest: the evenings that are left out need not "
            "be like the others."
        )
    left = study.planned - len(rows)
    if left:
        sentences.append(f"{_runs(left)} of {study.planned} had not ended when this was written.")
    return sentences


def _first_levels(study: StoredStudy, rows: Sequence[Row]) -> list[str]:
    """Returns what an evening is like in the first combination of which one is done."""
    first = next((row for row in rows if row["status"] == "done"), None)
    if first is None:
        return ["No run is done."]
    names = ("layout", "agents", "speed")
    here = [row for row in rows if all(row[name] == first[name] for name in names)]
    sentences = list(level_sentences(here))
    words = [value_of(name, first[name]) for name in names if name in study.varied]
    if sentences and words:
        sentences[0] = (
            f"For comparison, {', '.join(words)}: {sentences[0][0].lower()}{sentences[0][1:]}"
        )
    return sentences


def _verdict(comparison: Comparison, figure: str) -> str:
    return next(each.verdict for each in comparison.differences if each.figure == figure)


def _runs(number: int) -> str:
    return "1 run" if number == 1 else f"{number} runs"


def _best(store: Store, rows: Sequence[Row]) -> tuple[BestLayout, ...]:
    """Returns the layouts by the parties that they lose, and then by how long parties wait."""
    found = []
    common = common_runs(rows)
    for label in dict.fromkeys(row["layout"] for row in common):
        done = [row for row in common if row["layout"] == label]
        waits = [row["wait_seat_mean"] for row in done if row["wait_seat_mean"] is not None]
        lost = round(sum(row["lost"] for row in done) / len(done), 4)
        wait = round(sum(waits) / len(waits), 4) if waits else None
        found.append(BestLayout(label, lost, wait, store.layout_text(done[0]["layout_digest"])))
    return tuple(sorted(found, key=lambda one: (one.lost, one.wait_seat_mean or 0.0)))


def _worst(store: Store, rows: Sequence[Row]) -> list[WorstEvening]:
    done = [row for row in rows if row["status"] == "done"]
    done.sort(key=lambda row: (-row["lost"], -(row["wait_seat_p95"] or 0.0), row["number"]))
    return [WorstEvening(row, _replay(store, row)) for row in done[:WORST]]


def _replay(store: Store, row: Row) -> str:
    """Returns the line that plays an evening again, from the store where files do not suffice."""
    number = str(row["number"])
    line = ["waiter", "simulate", "--layout", row["layout"], "--scenario", row["scenario"]]
    before = ""
    shown = shlex.join(["waiter", "study", "show", store.path])
    if not _unchanged(row["scenario"], row["scenario_digest"]):
        before = f"{shown} --scenario-of {number} > evening-{number}.yaml; "
        line[5] = f"evening-{number}.yaml"
    if row["agents"] is not None or row["layout"] not in built_in("layout"):
        before += f"{shown} --layout-of {number} | "
        line[3] = "-"
    line += ["--seed", str(row["seed"]), "--speed", f"{row['speed']:g}", "--backend", BACKEND]
    return before + shlex.join(line)


def _unchanged(path: str, digest: str) -> bool:
    """Returns whether a file is there as it was played."""
    if not os.path.isfile(path):
        return False
    try:
        with open(path, encoding="utf-8") as file:
            return digest_of(file.read()) == digest
    except (OSError, ValueError):
        return False


def _comparison_document(comparison: Comparison) -> dict[str, Any]:
    return {
        "vary": comparison.vary,
        "first": comparison.first,
        "other": comparison.other,
        "evenings": comparison.evenings,
        "left_out": comparison.left_out,
        "differences": [
            {
                "figure": each.figure,
                "mean": None if each.found is None else round(each.found.mean, 4),
                "low": _rounded(None if each.found is None else each.found.low),
                "high": _rounded(None if each.found is None else each.found.high),
                "verdict": each.verdict,
                "sentence": difference_sentence(comparison, each) or None,
            }
            for each in comparison.differences
        ],
    }


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 4)
