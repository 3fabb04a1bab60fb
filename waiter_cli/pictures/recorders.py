"""Pictures → a film, a still, a folder: one recorder for each ending. Entry point `open_recorder`.

Frames are handed to the encoder one by one, so a long film takes no more memory than a short one.
What is written appears under its name only when it is whole.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

from sparc.numerals import whole
from sparc.whole_file import unused_name
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.pictures.ffmpeg import Encoder, to_gif
from waiter_cli.pictures.output_files import Unfinished

__all__ = [
    "ENDINGS",
    "MOST_ON_A_PAGE",
    "Recorder",
    "kind_of",
    "open_recorder",
    "read_size",
    "remarks",
    "require_different",
]

MIN_SIZE, MAX_SIZE = 160, 3840

ENDINGS = (".mp4", ".gif", ".png", ".html")


MOST_ON_A_PAGE = 30.0
"""Frames a second: a page moves from one to the next by itself."""
_WITHOUT = {".html": ("--view", "--size", "--quality"), ".png": ("--fps",)}
"""What has no effect on a recording of a kind."""


class Recorder(Protocol):
    """Takes Pillow images of one size; `keep` at the end, `drop` instead when all is to be undone."""

    def write(self, image: Any) -> None: ...

    def keep(self) -> None: ...

    def drop(self) -> None: ...


def kind_of(out: str) -> str:
    """Returns the ending that says what ``--record`` means, ``/`` for a folder (a
    name without an ending).

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


def require_different(outs: Sequence[str], events: str | None = None) -> None:
    """Raises `InputError` where two recordings, or one and the ``events``, are to be one file."""
    taken: set[str] = set()
    faults = []
    for out in outs:
        path = os.path.realpath(out)
        if path in taken:
            message = f"{out} is to be written twice"
            faults.append(Fault(Where("--record"), message, "give each recording its own name"))
        taken.add(path)
    if events not in (None, "-") and os.path.realpath(events) in taken:
        message = f"{events} is a recording already"
        faults.append(Fault(Where("--events"), message, "give the events another name"))
    if faults:
        raise InputError(faults)


def remarks(outs: Sequence[str], looks: Mapping[str, str]) -> Iterator[str]:
    """Yields remarks on how a run is recorded, a sentence each.

    ``looks`` are the options given for it, such as ``--size``, with their values.  Raises
    `InputError` for an ending or a size that cannot be.
    """

    size = looks.get("--size")
    width, height = read_size(size) if size is not None else (0, 0)
    kinds = {kind_of(out) for out in outs}
    idle = [name for name in looks if all(name in _WITHOUT.get(kind, ()) for kind in kinds)]
    if idle:
        where = {".html": "on a page", ".png": "on a still"}
        why = " or ".join(where[kind] for kind in sorted(kinds)) or "without --record"
        yield f"{', '.join(idle)} {'has' if len(idle) == 1 else 'have'} no effect {why}"
    if size is not None and "--size" not in idle and size.lower() != f"{width}x{height}":
        yield f"--size {size} is rounded to {width}x{height}: films have even sizes"
    if ".html" in kinds and float(looks.get("--fps", 0)) > MOST_ON_A_PAGE:
        yield f"--fps {looks['--fps']} is {MOST_ON_A_PAGE:g} on a page"
    for out in outs:
        if kind_of(out) == "/" and not out.endswith(("/", os.sep)):
            what = "is a folder of numbered frames; for a film give it an ending"
            yield f"--record {out} {what}: {out}.mp4"


def open_recorder(out: str, width: int, height: int, fps: float) -> Recorder:
    """Returns the recorder for ``out``, by its ending.

    Raises `MissingError` where the encoder is missing.
    """
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
        """Adds a frame."""
        self._encoder.write(image.tobytes())

    def keep(self) -> None:
        """The film is whole."""
        self._encoder.finish()
        self._file.keep()

    def drop(self) -> None:
        """Removes what was written."""
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
        """Adds a frame."""
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
        """Removes what was written on the way."""
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
        """Removes what was written."""
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
        self._path = unused_name(above)
        os.mkdir(self._path)
        self._count = 0

    def write(self, image: Any) -> None:
        """Adds a frame."""
        self._count += 1
        image.save(os.path.join(self._path, f"frame_{self._count:06d}.png"), compress_level=3)

    def keep(self) -> None:
        """Puts the folder in its place; the old one goes as a whole."""
        if not os.path.isdir(self._wanted):
            os.rename(self._path, self._wanted)
            return
        old = unused_name(os.path.dirname(self._wanted))
        os.rename(self._wanted, old)
        try:
            os.rename(self._path, self._wanted)
        except OSError:
            os.rename(old, self._wanted)
            raise
        shutil.rmtree(old, ignore_errors=True)

    def drop(self) -> None:
        """Removes what was written."""
        shutil.rmtree(self._path, ignore_errors=True)


def read_size(text: str) -> tuple[int, int]:
    """Returns width and height, both even, from ``WxH``; raises `InputError`.

    >>> read_size("640x360")
    (640, 360)
    """
    wide, cross, high = text.lower().partition("x")
    sides = whole(wide), whole(high)
    if not cross or sides[0] is None or sides[1] is None:
        raise InputError(
            [Fault(Where("--size"), f"{text} is no size", "for example: --size 1260x720")]
        )
    width, height = sides[0] // 2 * 2, sides[1] // 2 * 2
    if not (MIN_SIZE <= width <= MAX_SIZE and MIN_SIZE <= height <= MAX_SIZE):
        message = f"a frame has from {MIN_SIZE} to {MAX_SIZE} pixels each way, found {text}"
        raise InputError([Fault(Where("--size"), message, "for example: --size 1260x720")])
    return width, height
