"""The layout's file under the studio's hands: written whole, through no link, never over others' work."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.support.paths import ROOT
from waiter_cli.editing.layout_file import digest_of, save, state_of
from waiter_cli.errors import InputError

TEXT = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path.resolve() / "my.yaml"
    path.write_bytes(TEXT.encode())
    path.chmod(0o640)
    return path


def test_what_is_saved_is_there_with_its_permissions(file: Path) -> None:
    found = state_of(str(file))
    assert (found.text, found.kept) == (TEXT, None)
    digest = save(str(file), TEXT + "# é\r\n", found.digest)
    assert (
        digest == digest_of(file.read_bytes()) and file.read_bytes() == (TEXT + "# é\r\n").encode()
    )
    assert file.stat().st_mode & 0o777 == 0o640
    assert os.listdir(file.parent) == ["my.yaml"]


def test_a_change_made_elsewhere_stays_until_the_person_decides(file: Path) -> None:
    digest = state_of(str(file)).digest
    file.write_text("name: theirs\n")
    assert save(str(file), TEXT, digest) is None
    assert file.read_text() == "name: theirs\n"
    assert save(str(file), TEXT, None) is not None
    assert file.read_text() == TEXT
    file.unlink()
    assert save(str(file), TEXT, digest) is None and not file.exists()


def test_a_byte_order_mark_stays(file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbf" + TEXT.encode())
    found = state_of(str(file))
    assert found.text == TEXT
    save(str(file), "a: b\n", found.digest)
    assert file.read_bytes() == b"\xef\xbb\xbfa: b\n"


def test_a_link_is_not_followed(file: Path) -> None:
    digest = state_of(str(file)).digest
    other = file.with_name("other.yaml")
    file.rename(other)
    file.symlink_to(other)
    for known in (digest, None):
        with pytest.raises(InputError, match="it is a link"):
            save(str(file), "stolen", known)
    assert other.read_text() == TEXT


def test_a_folder_that_became_a_link_is_not_followed(file: Path, tmp_path: Path) -> None:
    inside = tmp_path.resolve() / "inside"
    inside.mkdir()
    path = inside / "my.yaml"
    path.write_text(TEXT)
    inside.rename(tmp_path / "elsewhere")
    inside.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="link"):
        save(str(path), "stolen", None)
    assert (tmp_path / "elsewhere" / "my.yaml").read_text() == TEXT


def test_what_is_shipped_stays_as_it_is() -> None:
    path = ROOT / "layouts" / "report.yaml"
    assert state_of(str(path)).kept is not None
    with pytest.raises(InputError, match="comes with waiter"):
        save(str(path), "gone", None)
    assert path.read_text(encoding="utf-8") == TEXT


def test_a_pipe_in_its_place_is_neither_waited_for_nor_written(file: Path) -> None:
    file.unlink()
    os.mkfifo(file)
    with pytest.raises(InputError, match="no regular file"):
        save(str(file), "gone", None)


def test_a_read_only_file_stays(file: Path) -> None:
    file.chmod(0o440)
    with pytest.raises(InputError, match="read-only"):
        save(str(file), "gone", None)
    assert file.read_text() == TEXT
