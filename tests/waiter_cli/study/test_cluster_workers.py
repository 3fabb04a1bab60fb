"""A study on a Dask cluster of processes on loopback, one of which is killed: the same table."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.processes import started
from tests.support.studies import QUICK, table, write_study

pytestmark = pytest.mark.cluster
distributed = pytest.importorskip("distributed", reason="Dask distributed is not installed")


@contextmanager
def process(*arguments: str, log: Path) -> Iterator[subprocess.Popen[bytes]]:
    """A process of Dask's in a session of its own, ended with all that it began."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with open(log, "wb") as out:
        begun = subprocess.Popen(
            [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]],
            env=environment, stdout=out, stderr=out, cwd=log.parent, start_new_session=True,
        )  # fmt: skip
    try:
        yield begun
    finally:
        kill(begun)


def kill(begun: subprocess.Popen[bytes]) -> None:
    with suppress(ProcessLookupError):
        os.killpg(begun.pid, signal.SIGKILL)
    begun.wait()


@contextmanager
def scheduler(folder: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    log = folder / "scheduler.log"
    options = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    with process("scheduler", *options, log=log) as begun:
        address = ""
        while not address:
            assert begun.poll() is None, log.read_text()
            time.sleep(0.05)
            at = log.read_text().partition("Scheduler at:")[2].split()
            address = at[0] if at and at[0].startswith("tcp://") else ""
        yield address, begun


def worker(folder: Path, name: str, address: str) -> object:
    options = ("--nthreads", "1", "--no-dashboard", "--host", "127.0.0.1", "--no-nanny")
    where = ("--local-directory", str(folder))
    return process("worker", address, "--name", name, *options, *where, log=folder / f"{name}.log")


@pytest.mark.slow
def test_one_of_two_workers_is_killed_in_the_middle(tmp_path: Path) -> None:
    study = write_study(tmp_path, "1..15", "agents: [1, 2]")
    for workers in ("1", "2"):
        local = tmp_path / f"{workers}.db"
        run = ("study", "run", str(study), "-o", str(local), "--workers", workers)
        assert waiter(*run).code == 0
    store = tmp_path / "cluster.db"
    with (
        scheduler(tmp_path) as (address, _),
        worker(tmp_path, "one", address) as one,  # type: ignore[attr-defined]
        worker(tmp_path, "two", address),  # type: ignore[attr-defined]
        distributed.Client(address, set_as_default=False) as client,
    ):
        client.wait_for_workers(2, timeout=60)
        with started("study", "run", study, "-o", store, "--scheduler", address) as running:
            while not store.exists() or len(rows(store)) < 4:
                assert running.poll() is None, running.stderr and running.stderr.read()
                time.sleep(0.01)
            kill(one)
            out, err = running.communicate(timeout=120)
        assert (running.returncode, err) == (0, b"")
        assert out == b"quick: 30 of 30 runs done, 30 of them now.\n"
    assert table(store) == table(tmp_path / "1.db") == table(tmp_path / "2.db")


def rows(store: Path) -> list[object]:
    try:
        return list(table(store))
    except Exception:  # not made yet
        return []


@pytest.mark.slow
def test_without_the_scheduler_nothing_is_lost(tmp_path: Path) -> None:
    study, store = write_study(tmp_path, "1..60"), tmp_path / "s.db"
    with (
        scheduler(tmp_path) as (address, begun),
        worker(tmp_path, "one", address),  # type: ignore[attr-defined]
        started("study", "run", study, "-o", store, "--scheduler", address) as running,
    ):
        while not store.exists() or len(rows(store)) < 2:
            assert running.poll() is None
            time.sleep(0.01)
        kill(begun)
        _, err = running.communicate(timeout=60)
    assert running.returncode == 5
    assert b"the scheduler is gone; " in err and b"start it again, then: waiter study run" in err
    assert b"Traceback" not in err
    assert waiter("study", "run", str(study), "-o", str(store)).code == 0
    assert len(table(store)) == 120


@pytest.mark.slow
def test_a_run_that_does_not_end_is_noted_and_the_others_are_played(tmp_path: Path) -> None:
    """One evening of two lasts for ever; its worker begins anew, and plays the other."""
    study, store = write_study(tmp_path, "1", "speed: 0.8"), tmp_path / "s.db"
    (tmp_path / "long.yaml").write_text(
        QUICK.replace("40", "1000").replace("minutes: 4", "minutes: 1440")
    )
    long = study.read_text().replace("quick.yaml", "long.yaml")
    (tmp_path / "long-study.yaml").write_text(long)
    with (
        scheduler(tmp_path) as (address, _),
        process(
            "worker", address, "--nthreads", "1", "--no-dashboard", "--host", "127.0.0.1",
            "--local-directory", str(tmp_path), log=tmp_path / "one.log",
        ),
    ):  # fmt: skip
        for name in ("long-study.yaml", "study.yaml"):
            with started(
                "study", "run", tmp_path / name, "-o", store, "--scheduler", address,
                "--time-limit", "2",
            ) as running:  # fmt: skip
                _, err = running.communicate(timeout=90)
            assert running.returncode == 0 and not err, err.decode()
            (row,) = table(store)
            if name == "long-study.yaml":
                assert (row["status"], row["reason"]) == ("limit", "not done in 2 s")
    assert row["status"] == "done"


def test_what_cannot_be(tmp_path: Path) -> None:
    study = str(write_study(tmp_path))
    ran = waiter("study", "run", study, "--scheduler", "tcp://127.0.0.1:1", "--workers", "2")
    assert ran.code == 2 and "leave one of them out" in ran.err


def test_what_is_missing_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    ran = waiter("study", "run", str(write_study(tmp_path)), "--scheduler", "tcp://127.0.0.1:1")
    assert ran.code == 5 and "--scheduler needs distributed\n  hint: " in ran.err
