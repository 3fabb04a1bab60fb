"""ffmpeg: what it refuses is told in its words."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from waiter_cli.errors import InputError, MissingError
from waiter_cli.pictures.ffmpeg import Encoder


def test_a_film_of_what_is_written(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    film = tmp_path / "a.mp4"
    encoder = Encoder(str(film), 32, 32, 4.0)
    for shade in (0, 255):
        encoder.write(bytes([shade]) * 32 * 32 * 3)
    encoder.finish()
    encoder.stop()
    assert b"ftyp" in film.read_bytes()[:16]


def test_what_ffmpeg_says_is_told(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    encoder = Encoder(str(tmp_path / "no" / "a.mp4"), 32, 32, 4.0)
    with pytest.raises(InputError, match="ffmpeg has given up: .*"):
        encoder.finish()
    encoder.stop()


def test_a_missing_ffmpeg_is_said_with_the_mend(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(MissingError, match="films need imageio-ffmpeg"):
        Encoder("a.mp4", 32, 32, 4.0)
