"""A user's file is written whole or not at all, and never over what is read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from waiter_cli.errors import InputError
from waiter_cli.file_access.atomic import may_be_written, require_apart, write_whole


def test_text_is_written_as_utf_8_and_bytes_as_they_are(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    write_whole(str(path), "Zoë\n")
    assert path.read_bytes() == b"Zo\xc3\xab\n"
    write_whole(str(path), b"\xff\x00")
    assert path.read_bytes() == b"\xff\x00"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_a_name_that_is_no_text_keeps_its_bytes_or_their_codes(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    write_whole(str(path), "caf\udce9")
    assert path.read_bytes() == b"caf\\xe9"


def test_a_link_is_followed(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old")
    link.symlink_to(target)
    write_whole(str(link), "new")
    assert link.is_symlink() and target.read_text() == "new"


def test_what_is_read_only_stays(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")
    path.chmod(0o444)
    assert not may_be_written(str(path))
    with pytest.raises(InputError, match="read-only"):
        write_whole(str(path), "new")
    assert path.read_text() == "old"


@pytest.mark.parametrize(
    ("name", "told"),
    [("nowhere/a.txt", "no such file"), ("a\0b", "null"), ("", "cannot write")],
)
def test_where_nothing_can_be_written_is_told(tmp_path: Path, name: str, told: str) -> None:
    path = f"{tmp_path}/{name}" if name else ""
    with pytest.raises(InputError, match=told) as raised:
        write_whole(path, "new")
    (fault,) = raised.value.faults
    assert fault.where.name == path
    assert (fault.hint is not None) == name.startswith("nowhere")
    assert os.listdir(tmp_path) == []


def test_no_output_is_what_is_read(tmp_path: Path) -> None:
    store, link = tmp_path / "q.db", tmp_path / "same.db"
    store.write_text("")
    link.symlink_to(store)
    for name in (store, link, tmp_path / "." / "q.db"):
        with pytest.raises(InputError, match="would be lost") as raised:
            require_apart({"--csv": str(name)}, [str(store)])
        assert raised.value.faults[0].where.name == "--csv"
    require_apart({"--csv": str(tmp_path / "q.csv"), "--parquet": None}, [str(store)])


def test_two_outputs_are_two_files_but_for_a_device(tmp_path: Path) -> None:
    path = str(tmp_path / "q.csv")
    with pytest.raises(InputError, match="would be lost") as raised:
        require_apart({"--csv": path, "--parquet": path}, [])
    assert raised.value.faults[0].where.name == "--parquet"
    require_apart({"--csv": "/dev/null", "--parquet": "/dev/null"}, [])
