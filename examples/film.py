"""Makes the films and the still that the documentation shows: ``python examples/film.py [FOLDER]``.

In ``replay`` scene 1 of the report is followed by a lunch in the bistro, in ``two-robots`` two robots
change places in an aisle with a bay, then serve the same lunch; all faster than life.  Each GIF stays under
1.5 MB.  Needs the extra ``record``, and ``sim`` for the view in perspective.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
SIZE, FPS = "640x360", 10
LUNCH, PAIR = os.path.join(HERE, "lunch.yaml"), os.path.join(HERE, "two-robots")
# of each film: scenario, seconds of the recording to take from, to, how many times faster
FILMS = {
    "replay": (("b1", 0.0, 24.0, 3.0), (LUNCH, 0.0, 136.0, 7.0)),
    "two-robots": (
        (os.path.join(PAIR, "swap.yaml"), 0.0, 40.0, 3.0),
        (os.path.join(PAIR, "lunch.yaml"), 0.0, 100.0, 7.0),
    ),
}
STILL = 84.0
LIMIT = 1_500_000


def record(scenario: str, out: str, size: str = SIZE, fps: int = FPS) -> None:
    """Plays a scenario and records it."""
    command = [sys.executable, "-m", "waiter_cli", "simulate", "--scenario", scenario]
    environment = {**os.environ, "PYTHONPATH": ROOT}
    done = subprocess.run(
        [*command, "--record", out, "--size", size, "--fps", str(fps)],
        stdout=subprocess.DEVNULL, env=environment, check=False,
    )  # fmt: skip
    if done.returncode:  # it has said why
        sys.exit(done.returncode)


def find_ffmpeg() -> str:
    """The path of ffmpeg; ends with the line that gets what is missing."""
    try:
        import imageio_ffmpeg
        import numpy  # noqa: F401
        import PIL  # noqa: F401
    except ImportError as error:
        sys.path.insert(0, ROOT)
        from waiter_cli.optional_packages import extra_line

        sys.exit(f"the film needs {error.name}, which is missing\n  hint: {extra_line('record')}")
    return str(imageio_ffmpeg.get_ffmpeg_exe())


def make_film(name: str, ffmpeg: list[str], between: str) -> str:
    """Makes a film as a GIF in a folder, in as many colours as stay under the limit; returns its path."""
    inputs, chain = [], []
    for k, (scenario, start, end, faster) in enumerate(FILMS[name]):
        film = os.path.join(between, f"{name}-{k}.mp4")
        record(scenario, film)
        inputs += ["-i", film]
        chain.append(f"[{k}]trim={start}:{end},setpts=(PTS-STARTPTS)/{faster},fps=6[v{k}]")
    joined = "".join(f"[v{k}]" for k in range(len(chain))) + f"concat=n={len(chain)}"
    gif = os.path.join(between, f"{name}.gif")
    for colours in (128, 96, 64, 48, 32):
        palette = f"split[a][b];[a]palettegen=max_colors={colours}:stats_mode=diff[p];[b][p]paletteuse=dither=none:diff_mode=rectangle"
        graph = ";".join([*chain, f"{joined},{palette}"])
        subprocess.run([*ffmpeg, *inputs, "-filter_complex", graph, "-loop", "0", gif], check=True)
        if os.path.getsize(gif) < LIMIT:
            break
    return gif


def main(folder: str) -> None:
    """Writes the films and replay.png into a folder."""
    ffmpeg = [find_ffmpeg(), "-v", "error", "-y"]
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory() as between:
        made = {f"{name}.gif": make_film(name, ffmpeg, between) for name in FILMS}
        large = os.path.join(between, "large")
        record(LUNCH, large + os.sep, "1260x720", 1)
        made["replay.png"] = os.path.join(large, f"frame_{int(STILL) + 1:06d}.png")
        for name, path in made.items():
            target = os.path.join(folder, name)
            shutil.move(path, target)
            print(f"{target}: {os.path.getsize(target) / 1e6:.2f} MB")


if __name__ == "__main__":
    options = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[2])
    options.add_argument(
        "folder", nargs="?", default=os.path.relpath(os.path.join(ROOT, "docs", "images")),
        help="where replay.gif and replay.png are written (%(default)s)",
    )  # fmt: skip
    main(options.parse_args().folder)
