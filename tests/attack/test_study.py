"""Stores that others have written into, and layouts with odd names: told, never trusted."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.studies import QUICK

pytestmark = pytest.mark.attack
pytest.importorskip("numpy")
ODD = r"a$\frac{$<b>.yaml"


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store of ten evenings; one of its layouts has a name that is HTML and broken TeX."""
    folder = tmp_path_factory.mktemp("study")
    layout = waiter("layout", "new", "--tables", "2", "--seed", "3").out
    (folder / ODD).write_text(layout)
    (folder / "_b.yaml").write_text(layout.replace("name: ", "name: other_"))
    (folder / "q.yaml").write_text(QUICK.replace("minutes: 4", "minutes: 2"))
    (folder / "s.yaml").write_text(
        f"layouts: ['{ODD}', _b.yaml]\nevenings: {{scenario: q.yaml, seeds: 1..5}}\n"
    )
    path = folder / "s.db"
    assert waiter("study", "run", str(folder / "s.yaml"), "-o", str(path)).code == 0
    return path


@pytest.mark.wide
def test_odd_names_are_shown_as_they_are(store: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    page = tmp_path / "r.html"
    ran = waiter("study", "report", str(store), "-o", str(page))
    assert ran.code == 0, ran.err
    text = page.read_text()
    assert "<b>" not in text and text.count(r"a$\frac{$&lt;b&gt;.yaml") > 5
    assert text.count("_b.yaml") > 5, "an underscore hides nothing"


def test_no_output_takes_the_place_of_what_is_read(store: Path, tmp_path: Path) -> None:
    shutil.copytree(store.parent, tmp_path / "copy")
    folder = tmp_path / "copy"
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    study, kept = str(folder / "s.yaml"), str(folder / "s.db")
    run = ("study", "run", study, "-o", kept)
    for line, option in (
        ((*run, "--csv", kept), "--csv"),
        ((*run, "--csv", study), "--csv"),
        ((*run, "--parquet", str(folder / "q.yaml")), "--parquet"),
        ((*run, "--csv", str(folder / ODD)), "--csv"),
        ((*run, "--csv", "t", "--parquet", "./t"), "--parquet"),
        (("study", "report", kept, "-o", kept), "--output"),
    ):
        ran = waiter(*line)
        assert ran.code == 2 and f"{option}: error: " in ran.err, ran
        assert "is read or written already, and would be lost" in ran.err
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before
    assert waiter(*run, "--csv", "/dev/null", "--parquet", "/dev/null").code == 0


CHANGES = {
    "UPDATE runs SET lost = 'many'": "lost cannot be that",
    "UPDATE runs SET metres = 9e999": "metres cannot be that",
    "UPDATE runs SET wait_seat_mean = 1e308": "wait_seat_mean cannot be that",
    "UPDATE runs SET status = 'odd'": "status cannot be that",
    "UPDATE runs SET reason = x'00ff'": "reason cannot be that",
    "UPDATE planned SET speed = 'fast'": "speed cannot be that",
    "UPDATE planned SET layout = x'00ff'": "layout cannot be that",
    "UPDATE planned SET seed = 'x'": "seed cannot be that",
    "DROP TABLE runs": "older version",
    "DROP TABLE planned": "no such table: planned",
    "DELETE FROM study": "nothing was run into this store yet",
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_store_that_was_changed_is_told(change: str, store: Path, tmp_path: Path) -> None:
    path = tmp_path / "s.db"
    shutil.copy(store, path)
    base = sqlite3.connect(path)
    base.execute("PRAGMA ignore_check_constraints = 1")
    base.execute(change)
    base.commit()
    base.close()
    for command in ("show", "report"):
        ran = waiter("study", command, str(path))
        assert ran.code == 2 and CHANGES[change] in ran.err and not ran.out


def test_a_layout_that_is_gone_is_told(store: Path, tmp_path: Path) -> None:
    path = tmp_path / "s.db"
    shutil.copy(store, path)
    base = sqlite3.connect(path)
    base.execute("DELETE FROM layouts")
    base.commit()
    base.close()
    for line in (("report", str(path)), ("show", str(path), "--layout-of", "1")):
        ran = waiter("study", *line)
        assert ran.code == 2 and "no longer among its layouts" in ran.err


def test_what_is_written_over_is_told(store: Path, tmp_path: Path) -> None:
    path = tmp_path / "s.db"
    data = bytearray(store.read_bytes())
    data[4096:12288] = bytes(n * 97 % 251 for n in range(8192))
    path.write_bytes(data)
    for command in ("show", "report"):
        ran = waiter("study", command, str(path))
        assert ran.code == 2 and "cannot be used: " in ran.err
