"""Watches a run and records what it sees. Entry point `open_film`.

Nothing of the pictures is imported before a recording or a window is asked for.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import ExitStack
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.pictures.recorders import read_size

if TYPE_CHECKING:
    from waiter_cli.pictures.snapshot import Snapshot
    from waiter_cli.room.room import Room
    from waiter_cli.simulation.outcome import RunOutcome
    from waiter_cli.simulation.run import Run

__all__ = ["Film", "Watcher", "open_film"]


class Watcher(Protocol):
    """Sees the run after every tick and every event as it is written."""

    def watch(self, run: Any) -> None: ...

    def event(self, line: str) -> None: ...

    def finish(self, run: Any, outcome: Any) -> tuple[str, ...]: ...

    def __enter__(self) -> Watcher: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None: ...


def open_film(
    room: Room, records: Sequence[str], view: str | None, backend: str, fps: float, size: str,
    quality: str, *, gui: bool,
) -> Watcher:  # fmt: skip
    """Returns the watcher of a run: a window, or whatever makes the recordings.

    Each picture is drawn once for all the films, stills and folders.  ``view`` None is 3d where
    PyBullet is there and not ruled out.  Raises `InputError` for an option that cannot be,
    `MissingError` where a part is missing.
    """
    width, height = read_size(size)
    if gui:
        if records:
            raise InputError(
                [Fault(Where("--gui"), "a window is not recorded", "leave --record or --gui out")]
            )
        from waiter_cli.pictures.live_window import Window

        return Window(room)
    from waiter_cli.pictures.recorders import kind_of

    pictures = [out for out in records if kind_of(out) != ".html"]
    with ExitStack() as undone:
        watchers: list[Watcher] = []
        for out in records:
            if out not in pictures:
                watchers.append(undone.enter_context(_page(room, out, fps)))
        if pictures:
            scene_kind = view or ("2d" if backend == "geometric" else _best_view())
            watchers.append(_pictures(room, pictures, scene_kind, fps, (width, height), quality))
        undone.pop_all()
        return watchers[0] if len(watchers) == 1 else Watchers(watchers, tuple(records))


def _page(room: Room, out: str, fps: float) -> Watcher:
    """Returns the watcher that makes a page."""
    from waiter_cli.pictures.html_page import PageFilm
    from waiter_cli.pictures.output_files import Unfinished
    from waiter_cli.pictures.recorders import MOST_ON_A_PAGE

    return PageFilm(room, Unfinished(out, "--record"), min(fps, MOST_ON_A_PAGE))


def _pictures(
    room: Room, outs: Sequence[str], view: str, fps: float, size: tuple[int, int], quality: str
) -> Film:
    """Returns the film that draws pictures and hands each to the recorder of every one of ``outs``."""
    from waiter_cli.labels.lettering import require
    from waiter_cli.pictures.recorders import open_recorder

    require()
    width, height = size
    with ExitStack() as undone:
        recorders = []
        for out in outs:
            recorders.append(open_recorder(out, width, height, fps))
            undone.callback(recorders[-1].drop)
        from waiter_cli.pictures.panel import Panel, panel_width

        stage = width - panel_width(width)
        scene: Any
        if view == "3d":
            from waiter_cli.pictures.scene3d import Scene3D

            scene = Scene3D(room, stage, height, 2 if quality == "full" else 1)
        else:
            from waiter_cli.pictures.scene2d import Scene2D

            scene = Scene2D(room, stage, height)
        film = Film(scene, Panel(width, height, scene.project, scene.heads), recorders, fps, outs)
        undone.pop_all()
        return film


def _best_view() -> str:
    from importlib.util import find_spec

    from waiter_cli.console.output import print_text

    if find_spec("pybullet") is not None:
        return "3d"
    print_text("waiter: PyBullet is not there; the film shows the room from above", sys.stderr)
    return "2d"


class Watchers:
    """Several that watch one run; ``outs`` are the recordings in the order that they were asked for."""

    def __init__(self, watchers: Sequence[Watcher], outs: tuple[str, ...]) -> None:
        self._watchers, self._outs = watchers, outs
        self._opened = ExitStack()

    def watch(self, run: Run) -> None:
        """Passes it on to all of them."""
        for watcher in self._watchers:
            watcher.watch(run)

    def event(self, line: str) -> None:
        """Passes it on to all of them."""
        for watcher in self._watchers:
            watcher.event(line)

    def finish(self, run: Run, outcome: RunOutcome) -> tuple[str, ...]:
        """Lets each of them keep what it made; returns the names of the recordings."""
        for watcher in self._watchers:
            watcher.finish(run, outcome)
        return self._outs

    def __enter__(self) -> Watchers:
        for watcher in self._watchers:
            self._opened.enter_context(watcher)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        self._opened.__exit__(kind, error, where)


class Film:
    """Draws a frame whenever one is due and hands it to the recorders."""

    def __init__(
        self, scene: Any, panel: Any, recorders: Sequence[Any], fps: float, outs: Sequence[str]
    ) -> None:
        self._scene, self._panel, self._recorders = scene, panel, recorders
        self._fps, self._outs = fps, tuple(outs)
        self._moves = not all(out.lower().endswith(".png") for out in outs)
        self._frames = 0
        self._bar = Progress()
        self._kept = False

    def event(self, line: str) -> None:
        """A film shows no events."""

    def watch(self, run: Run) -> None:
        """Draws a frame if one is due; a still needs the last one only."""
        if self._moves and run.clock.time * self._fps >= self._frames:
            self._frame(run)

    def _frame(self, run: Run) -> None:
        from waiter_cli.pictures.snapshot import take

        moment = take(run)
        picture = self._picture(moment)
        while self._frames <= run.clock.time * self._fps:
            self._write(picture)
            self._frames += 1
        self._bar.show(
            run.clock.time, self._frames, len(run.shown.deeds), moment.current + 1, len(moment.rows)
        )

    def _write(self, picture: Any) -> None:
        for recorder in self._recorders:
            recorder.write(picture)

    def _picture(self, moment: Snapshot) -> Any:
        scene = self._scene.draw(moment, self._panel.covered(moment))
        return self._panel.draw(scene, moment)

    def finish(self, run: Run, outcome: RunOutcome) -> tuple[str, ...]:
        """Returns the last frame once more for a second, and the recordings are kept."""
        from waiter_cli.pictures.snapshot import take

        moment = take(run)
        picture = self._picture(moment)
        for _ in range(max(1, round(self._fps))):
            self._write(picture)
        self._bar.done()
        for recorder in self._recorders:
            recorder.keep()
        self._kept = True
        return self._outs

    def __enter__(self) -> Film:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        if not self._kept:
            self._bar.done()
            for recorder in self._recorders:  # one that is kept already stays
                recorder.drop()
        self._scene.close()


class Progress:
    """A bar on stderr, where that is a terminal."""

    def __init__(self) -> None:
        self._shown = sys.stderr.isatty()
        self._last = -1
        self._width = 0
        utf = "utf" in (getattr(sys.stderr, "encoding", None) or "").lower()
        self._full, self._empty = ("█", "░") if utf else ("#", ".")

    def show(self, time: float, frames: int, deeds: int, step: int, steps: int) -> None:
        """Shows the progress of the recording."""
        if not self._shown or int(time * 4) == self._last:
            return
        self._last = int(time * 4)
        part = min(step, steps) / max(1, steps)
        done = round(24 * part)
        bar = self._full * done + self._empty * (24 - done)
        line = f"recording {bar} step {step}/{steps}  {time:6.1f} s  {frames} frames"
        self._width = max(self._width, len(line))
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()

    def done(self) -> None:
        """Takes the bar away."""
        if self._shown and self._last >= 0:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()
