"""Films: how many frames they have, and what cannot be filmed."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.playing import layout_of, play, scene
from waiter_cli.errors import InputError
from waiter_cli.pictures.film import open_film
from waiter_cli.room.room import build_room


def test_a_window_is_not_recorded() -> None:
    room = build_room(layout_of("report"))
    with pytest.raises(InputError, match="a window is not recorded"):
        open_film(room, ["a.png"], None, "auto", 4.0, "160x160", "full", gui=True)


@pytest.mark.parametrize("fps", [2.0, 7.5])
def test_a_film_has_a_frame_for_every_moment_and_a_second_more(tmp_path: Path, fps: float) -> None:
    pytest.importorskip("PIL")
    pytest.importorskip("numpy")
    problem, out = scene("b3"), f"{tmp_path}/frames/"
    film = open_film(
        build_room(problem.layout), [out], "2d", "geometric", fps, "160x160", "draft", gui=False
    )
    seen = []

    def watch(run: object) -> None:
        film.watch(run)
        seen[:] = [run]

    with film:
        played = play(problem, watch=watch)
        assert film.finish(seen[0], played.outcome) == (out,)
    frames = len([*(tmp_path / "frames").iterdir()])
    assert frames == int(played.outcome.seconds * fps) + 1 + round(fps)


def test_a_film_that_breaks_off_leaves_nothing(tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    pytest.importorskip("numpy")
    room = build_room(layout_of("report"))
    outs = [f"{tmp_path}/a.png", f"{tmp_path}/b/"]
    with open_film(room, outs, "2d", "geometric", 4.0, "160x160", "draft", gui=False):
        pass
    assert [*tmp_path.iterdir()] == []
