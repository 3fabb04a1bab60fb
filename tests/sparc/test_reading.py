"""The text of files: where it is none is named by line and column, a byte-order mark not counted."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

import pytest

from sparc import reading
from sparc.reading import NotText, read_capped, text_of


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
@pytest.mark.parametrize(
    ("data", "place"),
    [(b"\xff", (1, 1)), (b"ab\xe9d", (1, 3)), ("é\né€".encode() + b"\x80\n", (2, 3))],
)
def test_the_first_byte_that_is_no_text_has_a_place(
    data: bytes, place: tuple[int, int], mark: bytes
) -> None:
    with pytest.raises(NotText) as error:
        text_of(mark + data)
    assert (error.value.line, error.value.column, error.value.utf_16) == (*place, False)


def test_a_mark_is_no_text_and_line_ends_stay() -> None:
    assert text_of(b"\xef\xbb\xbfa\r\nb\r") == "a\r\nb\r"


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_another_encoding_is_named(encoding: str) -> None:
    with pytest.raises(NotText) as error:
        text_of("\ufeffnodes: [a]".encode(encoding))
    assert error.value.utf_16


@pytest.fixture
def pipe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.setattr(reading, "PATIENCE", 0.2)
    os.mkfifo(tmp_path / "pipe")
    return str(tmp_path / "pipe")


def test_a_pipe_without_a_writer_is_not_waited_for(pipe: str) -> None:
    with pytest.raises(OSError, match="nobody has begun to write into it within 0.2 s"):
        read_capped(pipe, 100)


@pytest.mark.parametrize("late", [0.0, 0.5], ids=["at once", "after a while"])
def test_a_pipe_with_a_writer_is_read_to_its_end(
    late: float, pipe: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who holds it open may take a while to write."""
    opened = threading.Event()

    def write() -> None:
        with open(pipe, "wb") as file:
            opened.set()
            time.sleep(late)
            file.write(b"a" * 100_000)

    def waiting(descriptor: int, name: str, found=reading._await_writer) -> bytes:  # type: ignore[no-untyped-def]
        assert opened.wait(20)
        return found(descriptor, name)

    monkeypatch.setattr(reading, "_await_writer", waiting)
    writer = threading.Thread(target=write)
    writer.start()
    assert read_capped(pipe, 1 << 20) == b"a" * 100_000
    writer.join()
