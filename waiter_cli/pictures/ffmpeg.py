"""Runs ffmpeg: pictures → a film, a film → a GIF. Entry points `Encoder`, `to_gif`.

It runs in a process group of its own, so that Ctrl-C reaches it by way of this process, which then
takes away what was not finished.  What it says is kept for the message if it fails.
"""

from __future__ import annotations

import contextlib
import subprocess
import tempfile
from fractions import Fraction

from sparc.deferred_signals import undisturbed
from waiter_cli.errors import Fault, InputError, MissingError, Where
from waiter_cli.optional_packages import extra_line

__all__ = ["Encoder", "to_gif"]


def _program() -> str:
    """Returns the path of ffmpeg; raises `MissingError` where it is missing."""
    try:
        import imageio_ffmpeg
    except ImportError:
        mend = extra_line("record")
        raise MissingError("films need imageio-ffmpeg, which is missing", mend) from None
    with undisturbed():  # it tries the program out
        return str(imageio_ffmpeg.get_ffmpeg_exe())


class Encoder:
    """ffmpeg at work on an H.264 film at ``path``; ``crf`` is its loss, 0 to 51."""

    def __init__(self, path: str, width: int, height: int, fps: float, crf: int = 23) -> None:
        rate = str(Fraction(fps).limit_denominator())
        self._process = _Ffmpeg(
            ["-f", "rawvideo", "-vcodec", "rawvideo", "-s", f"{width}x{height}",
             "-pix_fmt", "rgb24", "-r", rate, "-i", "-", "-an",
             "-vcodec", "libx264", "-pix_fmt", "yuv420p", "-crf", str(crf),
             "-preset", "superfast", "-movflags", "+faststart", "-threads", "2", "-bf", "0",
             "-rc-lookahead", "10", "-map_metadata", "-1", path],
        )  # fmt: skip

    def write(self, frame: bytes) -> None:
        """Adds a frame, 24 bits a pixel; raises `InputError` where ffmpeg has given up."""
        self._process.write(frame)

    def finish(self) -> None:
        """Writes the film to its end; raises `InputError` where that fails."""
        self._process.finish()

    def stop(self) -> None:
        """Ends ffmpeg at once, if it still runs."""
        self._process.stop()


def to_gif(film: str, palette: str, path: str) -> None:
    """Turns a film into a GIF of 96 colours, chosen for what moves; ``palette`` is a path to use.

    Raises `InputError` where that fails.
    """
    colours = "palettegen=max_colors=96:stats_mode=diff"
    use = "paletteuse=dither=none:diff_mode=rectangle"
    one = ["-f", "image2", "-pattern_type", "none", "-i", palette]  # no pattern for many files
    for arguments in (
        ["-i", film, "-vf", colours, "-update", "1", palette],
        ["-i", film, *one, "-lavfi", use, "-loop", "0", path],
    ):
        process = _Ffmpeg(arguments)
        try:
            process.finish()
        finally:
            process.stop()


class _Ffmpeg:
    """A run of ffmpeg that reads what is written to it."""

    def __init__(self, arguments: list[str]) -> None:
        command = [_program(), "-y", "-v", "error", *arguments]
        process = None
        try:
            with undisturbed():
                self._said = tempfile.TemporaryFile()  # noqa: SIM115 (a pipe could fill up)
                process = subprocess.Popen(
                    command,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=self._said,
                    start_new_session=True,
                )
        except BaseException:
            if process is not None:
                process.kill()
                process.wait()
            raise
        self._process = process

    def write(self, data: bytes) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(data)
        except OSError:
            self._process.wait()
            self._refuse()

    def finish(self) -> None:
        """Waits for its end; raises `InputError` where it failed."""
        assert self._process.stdin is not None
        with contextlib.suppress(OSError):  # it has ended already; its exit status says how
            self._process.stdin.close()
        if self._process.wait():
            self._refuse()

    def stop(self) -> None:
        """Ends it at once, if it still runs."""
        assert self._process.stdin is not None
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        with contextlib.suppress(OSError):  # what it has not read is lost
            self._process.stdin.close()
        self._said.close()

    def _refuse(self) -> None:
        """Raises `InputError` with what it said last."""
        self._said.seek(0)
        lines = self._said.read().decode("utf-8", "replace").split("\n")
        last = next(
            (line.strip() for line in reversed(lines) if line.strip()), "it did not say why"
        )
        hint = "is there room for the film?"
        raise InputError([Fault(Where("--record"), f"ffmpeg has given up: {last}", hint)])
