"""The text of files: where it is none is named by line and column, a byte-order mark not counted."""

from __future__ import annotations

import pytest

from sparc.reading import NotText, text_of


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
