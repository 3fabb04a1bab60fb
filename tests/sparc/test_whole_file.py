"""Whole files: what stood there stays until the new one is complete, and nothing is left over."""

from __future__ import annotations

import ast
import os
from pathlib import Path

import pytest

from sparc.whole_file import UnfinishedFile, put_in_place, unused_name, write_bytes
from tests.support.paths import ROOT


def test_the_old_file_stays_until_the_new_one_is_whole(tmp_path: Path) -> None:
    target = tmp_path / "a"
    target.write_text("old")
    with UnfinishedFile(target) as unfinished:
        with open(unfinished.descriptor, "w") as file:
            file.write("new")
        assert target.read_text() == "old"
        unfinished.keep()
    assert target.read_text() == "new" and os.listdir(tmp_path) == ["a"]


def test_what_is_not_kept_is_deleted(tmp_path: Path) -> None:
    with pytest.raises(KeyError), UnfinishedFile(tmp_path / "a", ".x") as unfinished:
        os.close(unfinished.descriptor)
        assert [name[-2:] for name in os.listdir(tmp_path)] == [".x"]
        raise KeyError
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("mode", [0o640, 0o600, 0o755])
def test_a_file_that_is_replaced_keeps_its_permissions(tmp_path: Path, mode: int) -> None:
    target = tmp_path / "a"
    target.write_text("old")
    target.chmod(mode)
    write_bytes(target, b"new")
    assert target.stat().st_mode & 0o777 == mode
    other = unused_name(str(tmp_path))
    Path(other).write_text("newer")
    put_in_place(other, str(target))
    assert (target.stat().st_mode & 0o777, target.read_text()) == (mode, "newer")


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_bytes(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "real").read_text() == "new"


def test_there_is_one_way_to_write_a_whole_file() -> None:
    """Nothing else moves a file onto another, or makes one under a name that nobody has."""
    moving = {"os.replace", "tempfile.mkstemp", "tempfile.NamedTemporaryFile", "shutil.move"}
    users = {
        path.relative_to(ROOT).as_posix()
        for package in ("sparc", "waiter_cli")
        for path in (ROOT / package).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in moving
    }
    assert users == {"sparc/whole_file.py"}
