"""Pictures → a film, a still, a folder: one recorder for each ending. Entry point `open_recorder`.

Frames are handed to the encoder one by one, so a long film takes no more memory than a short one.
What is written appears under its name only when it is whole.
"""

from __future__ import annotations

import os
import re
import shutil
from typing import Any, Protocol

from waiter_cli.exits import Fault, InputError
from waiter_cli.replay.encoder import Encoder, to_gif
from waiter_cli.replay.output import Unfinished, beside
from waiter_cli.situation import Where

__all__ = ["ENDINGS", "Recorder", "kind_of", "open_recorder"]

ENDINGS = (".mp4", ".gif", ".png", ".html")


class Recorder(Protocol):
    """Takes Pillow images of one size; `keep` at the end, `drop` instead when all is to be undone."""

    def write(self, image: Any) -> None: ...

    def keep(self) -> None: ...

    def drop(self) -> None: ...


def kind_of(out: str) -> str:
    """The ending that says what ``--record`` means, ``/`` for a folder (a name without an ending).

    >>> kind_of("a/film.MP4"), kind_of("frames/")
    ('.mp4', '/')
    """
    ending = os.path.splitext(out)[1].lower()
    if not ending or out.endswith(("/", os.sep)) or os.path.isdir(out):
        return "/"
    if ending not in ENDINGS:
        mend = f"end it in one of {', '.join(ENDINGS)}, or in / for a folder of frames"
        raise InputError(
            [Fault(Where("--record"), f"{out}: what kind of recording is that?", mend)]
        )
    return ending


def open_recorder(out: str, width: int, height: int, fps: float) -> Recorder:
    """The recorder for ``out``, by its ending; raises `MissingError` where the encoder is missing."""
    match kind_of(out):
        case ".mp4":
            return _Mp4(Unfinished(out, "--record"), width, height, fps)
        case ".gif":
            return _Gif(Unfinished(out, "--record"), width, height, fps)
        case ".png":
            return _Still(Unfinished(out, "--record"))
    return _Folder(out)


class _Mp4:
    """H.264, streamed to ffmpeg."""

    def __init__(self, file: Unfinished, width: int, height: int, fps: float) -> None:
        self._file = file
        self._encoder = Encoder(file.path, width, height, fps)

    def write(self, image: Any) -> None:
        """One frame more."""
        self._encoder.write(image.tobytes())

    def keep(self) -> None:
        """The film is whole."""
        self._encoder.finish()
        self._file.keep()

    def drop(self) -> None:
        """Nothing of it stays."""
        self._encoder.stop()
        self._file.drop()


class _Gif:
    """A GIF: an intermediate film of little loss first, then its palette, then the GIF."""

    def __init__(self, file: Unfinished, width: int, height: int, fps: float) -> None:
        self._file = file
        self._film = file.path + ".mp4"
        self._palette = file.path + ".png"
        self._encoder = Encoder(self._film, width, height, fps, crf=12)

    def write(self, image: Any) -> None:
        """One frame more."""
        self._encoder.write(image.tobytes())

    def keep(self) -> None:
        """Turns the film into a GIF."""
        try:
            self._encoder.finish()
            to_gif(self._film, self._palette, self._file.path)
            self._file.keep()
        finally:
            self.drop()

    def drop(self) -> None:
        """Nothing in between stays."""
        self._encoder.stop()
        for path in (self._film, self._palette):
            if os.path.exists(path):
                os.unlink(path)
        self._file.drop()


class _Still:
    """The last frame."""

    def __init__(self, file: Unfinished) -> None:
        self._file = file
        self._last: Any = None

    def write(self, image: Any) -> None:
        """Remembers it."""
        self._last = image

    def keep(self) -> None:
        """Writes the last one."""
        if self._last is not None:
            self._last.save(self._file.path, format="PNG", optimize=False)
            self._file.keep()

    def drop(self) -> None:
        """Nothing stays."""
        self._file.drop()


class _Folder:
    """Numbered PNGs in a folder of their own."""

    def __init__(self, out: str) -> None:
        self._wanted = os.path.realpath(out)
        above = os.path.dirname(self._wanted)
        place = Where("--record")
        if os.path.isdir(self._wanted):
            others = [
                n for n in os.listdir(self._wanted) if not re.fullmatch(r"frame_\d{6}\.png", n)
            ]
            if others:
                message = f"{out} has other files in it, such as {sorted(others)[0]}"
                raise InputError([Fault(place, message, "name a folder for frames alone")])
        elif os.path.exists(self._wanted):
            raise InputError([Fault(place, f"{out} is a file", "name a folder")])
        if not os.path.isdir(above):
            raise InputError([Fault(place, f"{out}: there is no folder {above}", "make it first")])
        self._path = beside(above)
        os.mkdir(self._path)
        self._count = 0

    def write(self, image: Any) -> None:
        """One frame more."""
        self._count += 1
        image.save(os.path.join(self._path, f"frame_{self._count:06d}.png"), compress_level=3)

    def keep(self) -> None:
        """Puts the folder in its place; the old one goes as a whole."""
        if not os.path.isdir(self._wanted):
            os.rename(self._path, self._wanted)
            return
        old = beside(os.path.dirname(self._wanted))
        os.rename(self._wanted, old)
        try:
            os.rename(self._path, self._wanted)
        except OSError:
            os.rename(old, self._wanted)
            raise
        shutil.rmtree(old, ignore_errors=True)

    def drop(self) -> None:
        """Nothing stays."""
        shutil.rmtree(self._path, ignore_errors=True)
