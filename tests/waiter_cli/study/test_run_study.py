"""A study that is killed at any moment and run again ends as one that was left alone."""

from __future__ import annotations

import os
import random
import signal
import sqlite3
import time
from pathlib import Path

import pytest

from tests.support.processes import started
from tests.support.sampling import mostly_slow
from tests.support.studies import table, write_study
from waiter_cli.study.run_study import StudyCounts, progress_line
from waiter_cli.study.store import Store


def run_to_its_end(study: Path, store: Path, *more: str) -> None:
    with started("study", "run", study, "-o", store, "--workers", "2", *more) as process:
        out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    assert out and not err


def rows_now(store: Path) -> int:
    """The rows that another process has written so far."""
    try:
        base = sqlite3.connect(store, timeout=10)
        try:
            return int(base.execute("SELECT count(*) FROM runs").fetchone()[0])
        finally:
            base.close()
    except sqlite3.OperationalError:
        return 0


def with_witness(store: Path) -> None:
    """Has every row that is written noted in a table of its own, which would show a second one."""
    base = sqlite3.connect(store)
    base.executescript(
        "CREATE TABLE IF NOT EXISTS written (key TEXT);"
        "CREATE TRIGGER IF NOT EXISTS witness AFTER INSERT ON runs"
        " BEGIN INSERT INTO written VALUES (new.key); END;"
    )
    base.close()


def killed_and_resumed(folder: Path, seeds: str, kills: int) -> None:
    study = write_study(folder, seeds)
    left_alone, killed = folder / "alone.db", folder / "killed.db"
    run_to_its_end(study, left_alone)
    with Store(str(killed), writing=True):
        pass
    with_witness(killed)
    chance = random.Random(20)
    planned = len(table(left_alone))
    seen = 0
    for kill in range(kills):
        until = min(planned - 1, seen + chance.randint(0, max(1, 2 * planned // (kills + 2))))
        with started("study", "run", study, "-o", killed, "--workers", "2") as process:
            while rows_now(killed) < until and process.poll() is None:
                time.sleep(0.001)
            time.sleep(chance.random() * 0.05)
            if kill % 2:
                os.killpg(process.pid, signal.SIGKILL)  # its workers, too
            else:
                process.kill()
        now = rows_now(killed)
        assert now >= seen, "what was done is still there"
        seen = now
    run_to_its_end(study, killed)
    assert table(killed) == table(left_alone)
    base = sqlite3.connect(killed)
    written = [key for (key,) in base.execute("SELECT key FROM written")]
    base.close()
    assert len(written) == len(set(written)) == planned
    assert sorted(each.name for each in folder.glob("killed.db*")) == ["killed.db"]


@pytest.mark.wide
def test_killed_and_resumed(tmp_path: Path) -> None:
    killed_and_resumed(tmp_path, "1..8", 2)


@pytest.mark.slow
def test_a_thousand_runs_killed_twenty_times(tmp_path: Path) -> None:
    killed_and_resumed(tmp_path, "1..500", 20)


@pytest.mark.wide
def test_workers_end_with_their_parent(tmp_path: Path) -> None:
    study = write_study(tmp_path, "1..400")
    with started("study", "run", study, "-o", tmp_path / "s.db", "--workers", "2") as process:
        while not rows_now(tmp_path / "s.db"):
            time.sleep(0.01)
        process.kill()
    deadline = time.monotonic() + 20
    while session(process.pid) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not session(process.pid)


def session(leader: int) -> list[int]:
    """The processes of a session that are still there."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == leader and fields[0] != "Z":
            found.append(int(entry.name))
    return found


@pytest.mark.parametrize("to", mostly_slow(["process", "terminal"], "terminal"))
def test_ctrl_c_ends_soon_and_says_how_to_go_on(to: str, tmp_path: Path) -> None:
    study, store = write_study(tmp_path, "1..400"), tmp_path / "a store.db"
    with started("study", "run", study, "-o", store, "--workers", "2") as process:
        while rows_now(store) < 2:
            time.sleep(0.01)
        begun = time.monotonic()
        (os.killpg if to == "terminal" else os.kill)(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=60)
        took = time.monotonic() - begun
    assert process.returncode == 130 and not out
    assert took < 2
    lines = err.decode().split("\n")
    assert lines[1].endswith(f"of 800 runs are in {store}; go on with")
    assert lines[2] == f"  waiter study run {study} -o '{store}' --workers 2"
    assert lines[3:] == ["waiter: interrupted", ""]
    while session(process.pid):  # the last helper ends when it sees that its parent has gone
        assert time.monotonic() < begun + 10
        time.sleep(0.01)
    assert all(row["status"] == "done" for row in table(store))


def test_workers_take_no_notice_of_the_terminal(tmp_path: Path) -> None:
    """Each of them holds Ctrl-C and SIGTERM back, whoever was started first."""
    study, store = write_study(tmp_path, "1..400"), tmp_path / "s.db"
    with started("study", "run", study, "-o", store, "--workers", "2") as process:
        while rows_now(store) < 2:
            time.sleep(0.01)
        told = []
        for pid in session(process.pid):
            if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes():
                status = Path(f"/proc/{pid}/status").read_text()
                blocked = int(status.partition("SigBlk:")[2].split()[0], 16)
                told.append([bool(blocked >> n - 1 & 1) for n in (signal.SIGINT, signal.SIGTERM)])
        process.kill()
    assert told == [[True, True]] * 2


@pytest.mark.slow
def test_ctrl_c_at_any_moment(tmp_path: Path) -> None:
    chance = random.Random(3)
    study = write_study(tmp_path, "1..400")
    for number in range(60):
        store = tmp_path / f"{number}.db"
        with started("study", "run", study, "-o", store, "--workers", "2") as process:
            while not rows_now(store):
                time.sleep(0.001)
            time.sleep(chance.random() * 0.05)
            os.killpg(process.pid, signal.SIGINT)
            _, err = process.communicate(timeout=20)
        assert process.returncode == 130 and b"Traceback" not in err


@pytest.mark.slow
def test_failures_are_played_again_when_asked_for(tmp_path: Path) -> None:
    study, store = write_study(tmp_path), tmp_path / "s.db"
    run_to_its_end(study, store, "--time-limit", "0")
    assert {row["status"] for row in table(store)} == {"limit"}
    run_to_its_end(study, store)
    assert {row["status"] for row in table(store)} == {"limit"}
    run_to_its_end(study, store, "--retry")
    assert {row["status"] for row in table(store)} == {"done"}


@pytest.mark.slow
def test_a_study_that_grows_keeps_what_it_has(tmp_path: Path) -> None:
    store = tmp_path / "s.db"
    run_to_its_end(write_study(tmp_path, "1..2"), store)
    with_witness(store)
    run_to_its_end(write_study(tmp_path, "1..4"), store)
    assert len(table(store)) == 8
    base = sqlite3.connect(store)
    assert base.execute("SELECT count(*) FROM written").fetchone() == (4,)
    base.close()


def test_progress_is_told_in_a_line() -> None:
    assert progress_line(StudyCounts(100, 0, 0, 0)) == "0 of 100 done"
    line = progress_line(StudyCounts(100, 18, 1, 1, now=10, seconds=30.0))
    assert line == "18 of 100 done, 1 failed, 1 at a limit, 20 a minute, about 4.0 min to go"
