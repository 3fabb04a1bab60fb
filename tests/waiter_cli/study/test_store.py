"""The store: a row a run, there for good, and nothing in a file of something else."""

from __future__ import annotations

import sqlite3
from pathlib import Path

import pytest

from tests.support.studies import write_study
from waiter_cli.errors import InputError
from waiter_cli.study.run_study import store_lock
from waiter_cli.study.store import Store
from waiter_cli.study.studies import RunResult, runs_of
from waiter_cli.study.study_file import read_study_file


def test_rows_come_back_as_they_were_written(tmp_path: Path) -> None:
    study = read_study_file(str(write_study(tmp_path)))
    path = tmp_path / "s.db"
    runs = list(runs_of(study, "1"))
    with Store(str(path), writing=True) as store:
        store.plan(study, "1")
        store.record(runs[2], RunResult(runs[2].key, "failed", "so it goes"))
        store.record(runs[0], RunResult(runs[0].key, "done", None, {"lost": 2, "metres": 4.0}, 0.5))
    assert sorted(each.name for each in tmp_path.glob("s.db*")) == ["s.db"]
    with Store(str(path)) as store:
        first, second = store.rows()
        assert (first["number"], first["lost"], first["metres"], first["idle"]) == (1, 2, 4.0, None)
        assert (first["speed"], first["seed"], first["agents"]) == (0.6, 1, None)
        assert (second["number"], second["status"], second["reason"]) == (3, "failed", "so it goes")
        assert store.ended() == {runs[0].key, runs[2].key}
        assert store.counts() == {"done": 1, "failed": 1, "limit": 0}
        assert store.study().planned == 6
        assert store.layout_text(first["layout_digest"]) == study.layouts[0].text
        assert store.scenario_text(first["scenario_digest"]) == study.scenario_text
    base = sqlite3.connect(path)  # as any other program would
    assert base.execute("SELECT lost FROM runs WHERE status = 'done'").fetchall() == [(2,)]
    base.close()


def test_a_run_has_one_row(tmp_path: Path) -> None:
    study = read_study_file(str(write_study(tmp_path)))
    run = next(runs_of(study, "1"))
    with Store(str(tmp_path / "s.db"), writing=True) as store:
        store.record(run, RunResult(run.key, "done"))
        with pytest.raises(sqlite3.IntegrityError):
            store.record(run, RunResult(run.key, "done"))


def test_a_store_of_older_figures_is_given_the_others(tmp_path: Path) -> None:
    path = tmp_path / "s.db"
    with Store(str(path), writing=True):
        pass
    base = sqlite3.connect(path)
    base.execute("ALTER TABLE runs DROP COLUMN late")
    base.commit()
    base.close()
    with pytest.raises(InputError, match="this store is of an older version"):
        Store(str(path))
    with Store(str(path), writing=True) as store:
        store.rows()


def test_another_file_is_left_alone(tmp_path: Path) -> None:
    text, base = tmp_path / "text.db", tmp_path / "base.db"
    text.write_text("nothing of the kind\n" * 100)
    other = sqlite3.connect(base)
    other.execute("CREATE TABLE mine (x)")
    other.close()
    for path in (text, base):
        before = path.read_bytes()
        for writing in (False, True):
            with pytest.raises(InputError, match=str(path)):
                Store(str(path), writing=writing)
        assert path.read_bytes() == before
    with pytest.raises(InputError, match="there is no such store"):
        Store(str(tmp_path / "none.db"))
    with pytest.raises(InputError, match="make the folder"):
        with store_lock(str(tmp_path / "no" / "s.db")):
            pass


def test_one_process_at_a_time(tmp_path: Path) -> None:
    path = str(tmp_path / "s.db")
    with store_lock(path):
        with pytest.raises(InputError, match="another process is running a study"):
            with store_lock(path):
                pass
    with store_lock(path):
        pass
    assert not list(tmp_path.iterdir())
