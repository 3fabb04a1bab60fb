"""Files that are there whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from waiter_cli.errors import InputError
from waiter_cli.pictures.output_files import Unfinished, opened


def test_a_file_takes_its_place_when_it_is_whole(tmp_path: Path) -> None:
    wanted = tmp_path / "a.png"
    wanted.write_text("old")
    file = Unfinished(str(wanted), "--record")
    Path(file.path).write_text("new")
    assert file.path.endswith(".png") and wanted.read_text() == "old"
    file.keep()
    assert wanted.read_text() == "new" and [*tmp_path.iterdir()] == [wanted]


def test_a_file_that_is_dropped_leaves_nothing(tmp_path: Path) -> None:
    file = Unfinished(str(tmp_path / "a.png"), "--record")
    Path(file.path).write_text("half")
    file.drop()
    assert [*tmp_path.iterdir()] == []


def test_events_that_break_off_leave_the_old_file(tmp_path: Path) -> None:
    wanted = tmp_path / "events"
    wanted.write_text("old")
    with pytest.raises(KeyError), opened(str(wanted)) as write:
        assert write is not None
        write("half\n")
        raise KeyError
    assert wanted.read_text() == "old" and [*tmp_path.iterdir()] == [wanted]


@pytest.mark.parametrize(
    ("name", "message"), [("no/a.png", "there is no folder"), (".", "is a folder")]
)
def test_what_cannot_be_written_is_said(tmp_path: Path, name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Unfinished(str(tmp_path / name), "--record")
