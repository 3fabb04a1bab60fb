"""Stores the results of a study's runs in one SQLite file. Class `Store`.

Table ``runs`` has a row for each run that has ended, by its key; ``planned`` the runs of the
study in their order, by the same keys; ``layouts`` and ``scenarios`` the texts that were played, by
their digests; ``study`` its name and file.  A row is written in one transaction as soon as the run
has ended (write-ahead log), so that a process killed at any moment leaves what was done.

Any other program may read the file meanwhile.
"""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.study.studies import RunResult, Study, StudyRun, digest_of, runs_of

__all__ = ["COLUMNS", "Row", "Store", "StoredStudy"]

MARK = 0x77616974  # "wait"
FIRST = ("number", "layout", "agents", "speed", "scenario", "seed")
LAST = ("status", "reason", "seconds")
COLUMNS = (*FIRST, *LAST, *FIGURES, "key", "version", "layout_digest", "scenario_digest")
"""The columns of a table of runs, as it is exported."""
MOST = 1e12
"""No figure of an evening comes near it."""
COUNTS = ("parties", "guests", "served", "lost", "lost_unseated", "lost_unserved", "late")


def _declared(figure: str) -> str:
    return f"{figure} {'INTEGER' if figure in COUNTS else 'REAL'}"


_SCHEMA = f"""
CREATE TABLE study (name TEXT NOT NULL, file TEXT NOT NULL, version TEXT NOT NULL,
  varied TEXT NOT NULL);
CREATE TABLE layouts (digest TEXT PRIMARY KEY, label TEXT NOT NULL, text TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE scenarios (digest TEXT PRIMARY KEY, name TEXT NOT NULL, text TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE planned (number INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, layout TEXT NOT NULL,
  agents INTEGER, speed REAL NOT NULL, scenario TEXT NOT NULL, seed INTEGER NOT NULL,
  layout_digest TEXT NOT NULL, scenario_digest TEXT NOT NULL);
CREATE TABLE runs (key TEXT PRIMARY KEY, layout TEXT NOT NULL, agents INTEGER, speed REAL NOT NULL,
  scenario TEXT NOT NULL, seed INTEGER NOT NULL, layout_digest TEXT NOT NULL,
  scenario_digest TEXT NOT NULL, version TEXT NOT NULL,
  status TEXT NOT NULL CHECK (status IN ('done', 'failed', 'limit')), reason TEXT,
  seconds REAL NOT NULL, {", ".join(map(_declared, FIGURES))}) WITHOUT ROWID;
PRAGMA application_id = {MARK};
PRAGMA user_version = 1;
"""

Row = dict[str, Any]


@dataclass(frozen=True)
class StoredStudy:
    """The study that a store is of; ``planned`` counts its runs."""

    name: str
    file: str
    version: str
    varied: tuple[str, ...]
    planned: int


class Store:
    """An open store.  Raises `InputError` for a file that is none, or that cannot be written."""

    def __init__(self, path: str, *, writing: bool = False) -> None:
        self.path = path
        with self._told():
            if not writing and not os.path.isfile(path):
                mend = "waiter study run STUDY.yaml -o FILE makes one"
                raise InputError([Fault(Where(path), "there is no such store", mend)])
            uri = Path(os.path.abspath(path)).as_uri() + ("" if writing else _for_reading(path))
            self._base = sqlite3.connect(uri, uri=True, isolation_level=None, timeout=30.0)
            self._base.row_factory = sqlite3.Row
            try:
                self._check(writing)
            except BaseException:
                self._base.close()
                raise

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self._base.close()

    # ------------------------------------------------------------ writing

    def plan(self, study: Study, version: str) -> None:
        """Notes the runs of a study, in place of those of another or an older one."""
        layouts = {each.text: digest_of(each.text) for each in study.layouts}
        scenario = digest_of(study.scenario_text)
        with self._told(), self._transaction():
            base = self._base
            base.execute("DELETE FROM study")
            base.execute(
                "INSERT INTO study VALUES (?, ?, ?, ?)",
                (study.name, study.file, version, " ".join(study.varied)),
            )
            base.executemany(
                "INSERT OR IGNORE INTO layouts VALUES (?, ?, ?)",
                ((layouts[each.text], each.label, each.text) for each in study.layouts),
            )
            base.execute(
                "INSERT OR IGNORE INTO scenarios VALUES (?, ?, ?)",
                (scenario, study.scenario, study.scenario_text),
            )
            base.execute("DELETE FROM planned")
            base.executemany(
                "INSERT INTO planned VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (
                    (run.number, run.key, run.layout.label, run.layout.agents, run.speed,
                     run.scenario, run.seed, layouts[run.layout.text], scenario)
                    for run in runs_of(study, version)
                ),
            )  # fmt: skip

    def record(self, run: StudyRun, result: RunResult) -> None:
        """Writes the row of a run that has ended; it is there for good when this returns."""
        figures = result.figures or {}
        columns = (
            "key", *FIRST[1:], "layout_digest", "scenario_digest", "version", *LAST, *FIGURES
        )  # fmt: skip
        values = (
            run.key, run.layout.label, run.layout.agents, run.speed, run.scenario, run.seed,
            digest_of(run.layout.text), digest_of(run.scenario_text), run.version,
            result.status, result.reason, round(result.seconds, 4),
            *(_plain(figures.get(name)) for name in FIGURES),
        )  # fmt: skip
        marks = ", ".join("?" * len(values))
        with self._told():
            self._base.execute(f"INSERT INTO runs ({', '.join(columns)}) VALUES ({marks})", values)

    def forget_failures(self) -> int:
        """Removes the planned runs that failed or reached a limit; returns how many."""
        with self._told(), self._transaction():
            return self._base.execute(
                "DELETE FROM runs WHERE status != 'done' AND key IN (SELECT key FROM planned)"
            ).rowcount

    # ------------------------------------------------------------ reading

    def study(self) -> StoredStudy:
        """Returns the study that the store is of."""
        with self._told():
            found = self._base.execute("SELECT * FROM study").fetchone()
            planned = self._base.execute("SELECT count(*) FROM planned").fetchone()[0]
        if found is None:
            mend = "waiter study run STUDY.yaml -o FILE"
            raise InputError([Fault(Where(self.path), "nothing was run into this store yet", mend)])
        varied = tuple(found["varied"].split())
        return StoredStudy(found["name"], found["file"], found["version"], varied, planned)

    def ended(self) -> set[str]:
        """Returns the keys of all runs that have ended."""
        with self._told():
            return {key for (key,) in self._base.execute("SELECT key FROM runs")}

    def counts(self) -> dict[str, int]:
        """Returns the numbers of planned runs that are ``done``, ``failed``, at a ``limit``."""
        with self._told():
            found = dict(
                self._base.execute(
                    "SELECT status, count(*) FROM runs JOIN planned USING (key) GROUP BY status"
                ).fetchall()
            )
        return {status: found.get(status, 0) for status in ("done", "failed", "limit")}

    def rows(self) -> list[Row]:
        """Returns the planned runs that have ended, in the order of the study, by `COLUMNS`."""
        wanted = ", ".join(
            f"planned.{name}" if name in FIRST or name.endswith("_digest") else f"runs.{name}"
            for name in COLUMNS
        )
        with self._told():
            found = self._base.execute(
                f"SELECT {wanted} FROM planned JOIN runs USING (key) ORDER BY number"
            ).fetchall()
        for row in found:
            for name in COLUMNS:
                if not _fits(name, row[name]):
                    told = f"the row of run {row['number']} has been changed: {name} cannot be that"
                    raise InputError([Fault(Where(self.path), told, "run the study into another")])
        return [dict(row) for row in found]

    def layout_text(self, digest: str) -> str:
        """Returns the YAML of a layout that was played; raises `InputError` when there is none."""
        return self._text("layouts", digest)

    def scenario_text(self, digest: str) -> str:
        """Returns the YAML of a scenario that was played; raises `InputError` when there is none."""
        return self._text("scenarios", digest)

    # ------------------------------------------------------------ within

    def _text(self, table: str, digest: str) -> str:
        with self._told():
            found = self._base.execute(f"SELECT text FROM {table} WHERE digest = ?", (digest,))
            row = found.fetchone()
        if row is None:
            told = f"a text that was played is no longer among its {table}"
            raise InputError([Fault(Where(self.path), told, "run the study into another")])
        return str(row[0])

    def _check(self, writing: bool) -> None:
        """Makes the tables in a new file; raises `InputError` for a file of something else."""
        base = self._base
        mark = base.execute("PRAGMA application_id").fetchone()[0]
        empty = base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0] == 0
        if mark != MARK and not (writing and empty):
            told = "this is a database of something else, no store of a study"
            raise InputError([Fault(Where(self.path), told, "name another file")])
        if writing:
            base.execute("PRAGMA journal_mode = WAL")
            base.execute("PRAGMA synchronous = FULL")
        if empty:
            base.executescript(f"BEGIN IMMEDIATE; {_SCHEMA} COMMIT;")
        there = {row["name"] for row in base.execute("PRAGMA table_info(runs)")}
        missing = [name for name in FIGURES if name not in there]
        if missing and not writing:
            told = "this store is of an older version"
            mend = "run the study into it again, or into another"
            raise InputError([Fault(Where(self.path), told, mend)])
        for name in missing:
            base.execute(f"ALTER TABLE runs ADD COLUMN {_declared(name)}")

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._base.execute("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            self._base.execute("ROLLBACK")
            raise
        self._base.execute("COMMIT")

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Turns what SQLite says into a fault at the file."""
        try:
            yield
        except sqlite3.IntegrityError:
            raise  # a run would be there twice: a defect
        except sqlite3.Error as error:
            raise InputError([Fault(Where(self.path), f"cannot be used: {error}")]) from error


def _for_reading(path: str) -> str:
    """Returns the mode in which a store is read.

    Whoever may write takes the log of writes away on leaving.
    """
    folder = os.path.dirname(os.path.abspath(path))
    writable = os.access(path, os.W_OK) and os.access(folder, os.W_OK)
    return "?mode=rw" if writable else "?mode=ro"


def _fits(name: str, value: Any) -> bool:
    """Returns whether a column can hold a value; anybody may have written into the file."""
    if name in FIGURES or name == "seconds":
        return value is None or (isinstance(value, (int, float)) and abs(value) < MOST)
    if name in ("number", "agents", "seed"):
        return isinstance(value, int) or (value is None and name == "agents")
    if name == "speed":
        return isinstance(value, float) and 0 < value < MOST
    if name == "status":
        return value in ("done", "failed", "limit")
    return isinstance(value, str) or (value is None and name == "reason")


def _plain(value: Any) -> Any:
    """Returns a figure as SQLite keeps it."""
    return value if value is None or isinstance(value, (int, float)) else json.dumps(value)
