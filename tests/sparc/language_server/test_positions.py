"""Offsets and UTF-16 columns."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from sparc.language_server.positions import Positions


def test_a_sign_beyond_the_basic_plane_counts_twice() -> None:
    places = Positions("a\N{GRINNING FACE}b\nc")
    assert [places.of(offset) for offset in range(5)] == [(0, 0), (0, 1), (0, 3), (0, 4), (1, 0)]
    assert places.offset(0, 3) == 2 and places.offset(0, 99) == 3 and places.offset(9, 0) == 5


@given(st.text("aé\N{GRINNING FACE}\n"))
def test_there_and_back(text: str) -> None:
    places = Positions(text)
    for offset in range(len(text) + 1):
        assert places.offset(*places.of(offset)) == offset
