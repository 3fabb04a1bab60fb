"""``waiter study show``: means a combination, why runs failed, and a layout as it was played."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.studies import table, write_study


def test_means_over_the_evenings(tmp_path: Path) -> None:
    study, store = str(write_study(tmp_path)), tmp_path / "s.db"
    waiter("study", "run", study, "-o", str(store))
    rows = [row for row in table(store) if row["speed"] == 0.8]
    ran = waiter("study", "show", str(store))
    assert ran.code == 0 and ran.out.startswith("quick: 6 of 6 runs done.\n\nlayout  m/s  runs")
    shown = waiter("study", "show", str(store), "--json").json()
    assert shown["status"] == "complete" and shown["left"] == 0
    slow, fast = shown["combinations"]
    assert (slow["speed"], fast["speed"], fast["done"]) == (0.6, 0.8, 3)
    mean = sum(row["metres"] for row in rows) / 3
    assert abs(fast["means"]["metres"] - mean) < 1e-3


@pytest.mark.wide
def test_why_runs_failed(tmp_path: Path) -> None:
    study, store = str(write_study(tmp_path)), str(tmp_path / "s.db")
    waiter("study", "run", study, "-o", store, "--time-limit", "0")
    ran = waiter("study", "show", store)
    assert ran.out.startswith("quick: 0 of 6 runs done, 6 at a limit.")
    assert ran.out.endswith("6 runs reached a limit (run 1): not done in 0 s\n")


def test_a_layout_as_it_was_played(tmp_path: Path) -> None:
    study, store = write_study(tmp_path, "1"), str(tmp_path / "s.db")
    text = study.read_text().replace("[report]", "[report, {generate: {tables: 3, seeds: 7}}]")
    study.write_text(text)
    waiter("study", "run", str(study), "-o", store)
    ran = waiter("study", "show", store, "--layout-of", "3")
    assert ran.code == 0 and "name: generated_7\n" in ran.out
    assert waiter("layout", "check", "-", stdin=ran.out).code == 0
    ran = waiter("study", "show", store, "--layout-of", "5")
    assert ran.code == 2 and "runs are numbered from 1 to 4" in ran.err
