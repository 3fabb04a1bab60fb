"""Workers of this machine: whatever a run does, it has a result and the others go on."""

from __future__ import annotations

import multiprocessing
import time
from pathlib import Path

import pytest

from tests.support.studies import limited, unruly, unstable, write_study
from waiter_cli import __version__
from waiter_cli.study.evening_run import play_evening
from waiter_cli.study.local_workers import LocalWorkers, play_locally
from waiter_cli.study.studies import RunLimits, StudyRun, runs_of
from waiter_cli.study.study_file import read_study_file


def runs(folder: Path, seeds: str, vary: str = "speed: 0.8") -> list[StudyRun]:
    return list(runs_of(read_study_file(str(write_study(folder, seeds, vary))), __version__))


@pytest.mark.wide
def test_a_run_that_dies_hangs_or_eats_memory_is_recorded(tmp_path: Path) -> None:
    todo = runs(tmp_path, "1..7")
    found = {}
    for result in play_locally(iter(todo), 2, RunLimits(3.0, 300 << 20), unruly):
        assert result.key not in found, "one result a run"
        found[result.key] = result
    told = {run.seed: (found[run.key].status, found[run.key].reason) for run in todo}
    assert told == {
        1: ("failed", "its process died 3 times (exit code 7)"),
        2: ("limit", "not done in 3 s"),
        3: ("limit", "the memory was used up"),
        4: ("failed", "RuntimeError: so it goes"),
        5: ("done", None),
        6: ("done", None),
        7: ("done", None),
    }
    assert not multiprocessing.active_children()


def test_a_process_that_dies_once_costs_no_run(tmp_path: Path) -> None:
    todo = runs(tmp_path, "1..2")
    found = list(play_locally(iter(todo), 1, RunLimits(), unstable))
    assert [result.status for result in found] == ["done", "done"]


def test_after_a_limit_the_next_run_has_a_process_of_its_own(tmp_path: Path) -> None:
    """The memory that was used up is not the next run's fault."""
    todo = runs(tmp_path, "1..4")
    found = {result.key: result for result in play_locally(iter(todo), 1, RunLimits(), limited)}
    pids = [(found[run.key].figures or {})["parties"] for run in todo]
    assert pids[0] == pids[1] != pids[2] == pids[3]


def test_whoever_stops_asking_ends_the_processes(tmp_path: Path) -> None:
    results = play_locally(iter(runs(tmp_path, "4..8")), 2, RunLimits(), unruly)
    assert next(results).status in ("done", "failed")
    assert multiprocessing.active_children()
    results.close()
    assert not multiprocessing.active_children()


def test_the_limits_of_time_hold_in_the_run_itself(tmp_path: Path) -> None:
    (run,) = runs(tmp_path, "1")
    result = play_evening(run, RunLimits(0.0))
    assert (result.status, result.reason) == ("limit", "not done in 0 s")
    assert play_evening(run, RunLimits(60.0)).status == "done"


def test_evenings_of_several_robots_are_played(tmp_path: Path) -> None:
    one, two = runs(tmp_path, "1", "agents: [1, 2]")
    assert play_evening(one, RunLimits()).status == "done"
    result = play_evening(two, RunLimits())
    assert (result.status, result.reason) == ("done", None)
    assert result.figures is not None and result.figures["served"] > 0


def test_no_result_is_waited_for_beyond_a_time(tmp_path: Path) -> None:
    hanging = runs(tmp_path, "2")
    with LocalWorkers(1, RunLimits(), unruly) as workers:
        begun = time.monotonic()
        assert not list(workers.play(iter(hanging), begun + 0.3))
        assert time.monotonic() - begun < 10
    assert not multiprocessing.active_children()
