"""``waiter study run``: its words, its tables, and what it refuses."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.studies import table, write_study


def test_a_study_is_run_once(tmp_path: Path) -> None:
    study, store = str(write_study(tmp_path)), str(tmp_path / "s.db")
    ran = waiter("study", "run", study, "-o", store, "--workers", "1")
    assert (ran.code, ran.out, ran.err) == (0, "quick: 6 of 6 runs done, 6 of them now.\n", "")
    again = waiter("study", "run", study, "-o", store, "--json").json()
    assert again.pop("seconds") < 60
    assert again == {
        "status": "complete", "study": "quick", "store": store, "runs": 6, "done": 6, "failed": 0,
        "limit": 0, "played": 0,
    }  # fmt: skip


def test_the_store_is_called_after_the_study(tmp_path: Path) -> None:
    study = str(write_study(tmp_path, "1"))
    assert waiter("study", "run", study).code == 0
    assert len(table(tmp_path / "study.db")) == 2


def test_the_same_evening_as_simulate_plays(tmp_path: Path) -> None:
    study, store = write_study(tmp_path, "5", "speed: 0.6"), tmp_path / "s.db"
    assert waiter("study", "run", str(study), "-o", str(store)).code == 0
    (row,) = table(store)
    played = waiter(
        "simulate", "--layout", "report", "--scenario", str(tmp_path / "quick.yaml"), "--json",
        "--backend", "geometric", "--speed", "0.6", "--seed", "5",
    ).json()  # fmt: skip
    assert {name: row[name] for name in played["figures"]} == played["figures"]


@pytest.mark.wide
def test_the_table_is_the_same_with_any_number_of_workers(tmp_path: Path) -> None:
    study = str(write_study(tmp_path, "1..3", "agents: [1, 2]"))
    for workers in ("1", "2"):
        store = str(tmp_path / f"{workers}.db")
        assert waiter("study", "run", study, "-o", store, "--workers", workers).code == 0
    rows = table(tmp_path / "1.db")
    assert rows == table(tmp_path / "2.db") and {row["status"] for row in rows} == {"done"}


def test_tables_for_others(tmp_path: Path) -> None:
    study, store = str(write_study(tmp_path)), tmp_path / "s.db"
    ran = waiter("study", "run", study, "-o", str(store), "--csv", str(tmp_path / "s.csv"))
    assert (ran.code, ran.err) == (0, f"wrote {tmp_path / 's.csv'}\n")
    with open(tmp_path / "s.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["metres"] for row in rows] == [str(row["metres"]) for row in table(store)]
    assert rows[0]["agents"] == "" and rows[0]["number"] == "1"


@pytest.mark.wide
def test_parquet(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    study, store, path = str(write_study(tmp_path)), tmp_path / "s.db", tmp_path / "s.parquet"
    assert waiter("study", "run", study, "-o", str(store), "--parquet", str(path)).code == 0
    found = parquet.read_table(path).drop_columns(["seconds"]).to_pylist()
    assert found == table(store)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("study run nowhere.yaml -o s.db", "there is no study nowhere.yaml"),
        ("study run study.yaml -o no/s.db", "no/s.db: error: cannot write"),
        ("study run study.yaml -o study.yaml", "study.yaml: error: cannot be used"),
        ("study run study.yaml -o .", ".: error: cannot"),
        ("study run -", "which store?"),
        ("study show study.yaml", "study.yaml: error: cannot be used"),
        ("study show nowhere.db", "nowhere.db: error: there is no such store"),
    ],
)
def test_what_cannot_be(
    line: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    before = write_study(tmp_path).read_text()
    ran = waiter(*line.split(), stdin=before)
    assert ran.code == 2 and said in ran.err and not ran.out
    assert (tmp_path / "study.yaml").read_text() == before
    assert {each.name for each in tmp_path.iterdir()} == {"study.yaml", "quick.yaml"}
