"""Pictures → a film, a still, a folder: one recorder for each ending. Entry point `open_recorder`.

Frames are handed to the encoder one by one, so a long film takes no more memory than a short one.
What is written appears under its name only when it is whole.
"""

from __future__ import annotations

import os
import re
import shutil
from typing import TYPE_CHECKING, Any, Protocol

from waiter_cli.exits import Fault, InputError, MissingError
from waiter_cli.replay.output import Unfinished
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from collections.abc import Generator

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


def _encoder() -> Any:
    try:
        import imageio_ffmpeg
    except ImportError:
        import sys

        mend = f"{os.path.basename(sys.executable)} -m pip install 'waiter-planner[record]'"
        raise MissingError("films need imageio-ffmpeg, which is missing", mend) from None
    return imageio_ffmpeg


class _Mp4:
    """H.264, streamed to ffmpeg."""

    def __init__(
        self, file: Unfinished, width: int, height: int, fps: float, crf: int = 23
    ) -> None:
        self._file = file
        self._pipe: Generator[None, bytes | None, None] | None = _encoder().write_frames(
            file.path, (width, height), fps=fps, codec="libx264", quality=None, macro_block_size=2,
            pix_fmt_out="yuv420p", ffmpeg_log_level="error",
            output_params=["-crf", str(crf), "-preset", "superfast", "-movflags", "+faststart",
                           "-threads", "2", "-bf", "0", "-rc-lookahead", "10", "-map_metadata", "-1"],
        )  # fmt: skip
        self._pipe.send(None)

    def write(self, image: Any) -> None:
        """One frame more."""
        assert self._pipe is not None
        self._pipe.send(image.tobytes())

    def keep(self) -> None:
        """The film is whole."""
        self._close()
        self._file.keep()

    def drop(self) -> None:
        """Nothing of it stays."""
        self._close()
        self._file.drop()

    def _close(self) -> None:
        if self._pipe is not None:
            self._pipe.close()
            self._pipe = None


class _Gif:
    """A GIF of 96 colours, chosen for what moves: an intermediate film first, then its palette, then the GIF."""

    def __init__(self, file: Unfinished, width: int, height: int, fps: float) -> None:
        self._file = file
        self._between = Unfinished(file.wanted + ".mp4", "--record")
        self._palette = file.path + ".palette.png"
        self._film = _Mp4(self._between, width, height, fps, crf=12)

    def write(self, image: Any) -> None:
        """One frame more."""
        self._film.write(image)

    def keep(self) -> None:
        """Turns the film into a GIF."""
        import subprocess

        self._film._close()
        program = _encoder().get_ffmpeg_exe()
        quiet = [program, "-v", "error", "-y", "-i", self._between.path]
        colours = "palettegen=max_colors=96:stats_mode=diff"
        use = "paletteuse=dither=none:diff_mode=rectangle"
        try:
            subprocess.run(
                [*quiet, "-vf", colours, self._palette], check=True, stdin=subprocess.DEVNULL
            )
            subprocess.run(
                [*quiet, "-i", self._palette, "-lavfi", use, "-loop", "0", self._file.path],
                check=True, stdin=subprocess.DEVNULL,
            )  # fmt: skip
            self._file.keep()
        finally:
            self.drop()

    def drop(self) -> None:
        """Nothing in between stays."""
        self._film.drop()
        if os.path.exists(self._palette):
            os.unlink(self._palette)
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
        self._wanted = os.path.abspath(out)
        above, name = os.path.split(self._wanted)
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
        self._path = os.path.join(above, f".{os.getpid()}.{name}")
        os.mkdir(self._path)
        self._count = 0

    def write(self, image: Any) -> None:
        """One frame more."""
        self._count += 1
        image.save(os.path.join(self._path, f"frame_{self._count:06d}.png"), compress_level=3)

    def keep(self) -> None:
        """Puts the folder in its place."""
        if os.path.isdir(self._wanted):
            shutil.rmtree(self._wanted)
        os.replace(self._path, self._wanted)

    def drop(self) -> None:
        """Nothing stays."""
        shutil.rmtree(self._path, ignore_errors=True)
