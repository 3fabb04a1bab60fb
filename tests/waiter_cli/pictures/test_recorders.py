"""Recorders: what an ending means, and what is left where a recording breaks off."""

from __future__ import annotations

from pathlib import Path

import pytest

from waiter_cli.errors import InputError
from waiter_cli.pictures.recorders import kind_of, open_recorder, read_size, require_different


@pytest.mark.parametrize(
    ("out", "kind"), [("a.gif", ".gif"), ("a/b.PNG", ".png"), ("frames", "/"), ("a.html", ".html")]
)
def test_an_ending_says_what_is_recorded(out: str, kind: str) -> None:
    assert kind_of(out) == kind


@pytest.mark.parametrize(
    ("text", "message"),
    [("big", "is no size"), ("640", "is no size"), ("10x10", "from 160 to 3840"), ("-5x400", "from 160 to 3840")],
)  # fmt: skip
def test_sizes_that_cannot_be(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_size(text)


def test_an_odd_size_is_rounded_down() -> None:
    assert read_size("641X361") == (640, 360)


def test_one_file_is_not_written_twice(tmp_path: Path) -> None:
    one = str(tmp_path / "a.png")
    with pytest.raises(InputError, match="is to be written twice"):
        require_different([one, str(tmp_path / "." / "a.png")])
    with pytest.raises(InputError, match="is a recording already"):
        require_different([one], one)


@pytest.mark.parametrize("name", ["a.png", "frames/"])
def test_a_recording_is_kept_or_leaves_nothing(tmp_path: Path, name: str) -> None:
    image_module = pytest.importorskip("PIL.Image")
    image = image_module.new("RGB", (16, 16), (200, 10, 10))
    for kept in (False, True):
        recorder = open_recorder(f"{tmp_path}/{name}", 16, 16, 4.0)
        recorder.write(image)
        recorder.write(image)
        (recorder.keep if kept else recorder.drop)()
        assert len([*tmp_path.iterdir()]) == kept
    made = sorted(path.name for path in tmp_path.rglob("*.png"))
    assert made == (["a.png"] if name == "a.png" else ["frame_000001.png", "frame_000002.png"])
