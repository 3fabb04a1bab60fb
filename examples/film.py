"""Makes the film and the still that the documentation shows: ``python examples/film.py FOLDER``.

Scene 1 of the report is followed by a lunch in the bistro, faster than life; the GIF stays under
1.5 MB.  Needs the extras ``sim`` and ``record``.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile

import imageio_ffmpeg

HERE = os.path.dirname(os.path.abspath(__file__))
SIZE, FPS = "640x360", 10
# name, seconds of the recording to take from, to, how many times faster
PARTS = (("b1", 0.0, 24.0, 3.0), (os.path.join(HERE, "lunch.yaml"), 0.0, 136.0, 7.0))
STILL = 84.0
LIMIT = 1_500_000


def record(scenario: str, out: str, size: str = SIZE, fps: int = FPS) -> None:
    """Plays a scenario and records it."""
    command = [sys.executable, "-m", "waiter_cli", "simulate", "--scenario", scenario]
    environment = {**os.environ, "PYTHONPATH": os.path.dirname(HERE)}
    subprocess.run(
        [*command, "--record", out, "--size", size, "--fps", str(fps)], check=True, env=environment
    )


def main(folder: str) -> None:
    """Writes replay.gif and replay.png into a folder."""
    os.makedirs(folder, exist_ok=True)
    ffmpeg = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-y"]
    with tempfile.TemporaryDirectory() as between:
        inputs, chain = [], []
        for k, (scenario, start, end, faster) in enumerate(PARTS):
            film = os.path.join(between, f"{k}.mp4")
            record(scenario, film)
            inputs += ["-i", film]
            chain.append(f"[{k}]trim={start}:{end},setpts=(PTS-STARTPTS)/{faster},fps=6[v{k}]")
        joined = "".join(f"[v{k}]" for k in range(len(PARTS))) + f"concat=n={len(PARTS)}"
        for colours in (128, 96, 64, 48, 32):
            palette = f"split[a][b];[a]palettegen=max_colors={colours}:stats_mode=diff[p];[b][p]paletteuse=dither=none:diff_mode=rectangle"
            gif = os.path.join(between, "replay.gif")
            graph = ";".join([*chain, f"{joined},{palette}"])
            subprocess.run(
                [*ffmpeg, *inputs, "-filter_complex", graph, "-loop", "0", gif], check=True
            )
            if os.path.getsize(gif) < LIMIT:
                break
        shutil.move(gif, os.path.join(folder, "replay.gif"))
        large = os.path.join(between, "large")
        record(PARTS[1][0], large, "1260x720", 1)
        frame = os.path.join(large, f"frame_{int(STILL) + 1:06d}.png")
        shutil.move(frame, os.path.join(folder, "replay.png"))
    print(f"{os.path.getsize(os.path.join(folder, 'replay.gif')) / 1e6:.2f} MB")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "docs/images")
