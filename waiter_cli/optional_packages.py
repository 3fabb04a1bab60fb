"""The line that installs what is missing into the Python that runs. Entry points `extra_line`, `pip_line`.

>>> extra_line("record").startswith(pip_line())
True
"""

from __future__ import annotations

import os
import platform
import shlex
import shutil
import sys

__all__ = [
    "DISTRIBUTION",
    "EXTRAS",
    "PYBULLET_BEFORE",
    "extra_line",
    "has_pybullet_wheels",
    "pip_line",
    "pybullet_line",
]

DISTRIBUTION = "waiter-planner"
EXTRAS = {
    "sim": ("pybullet", "numpy"),
    "record": ("numpy", "pillow", "imageio-ffmpeg"),
    "lsp": ("pygls",),
    "cluster": ("distributed",),
    "study": ("numpy", "matplotlib", "pyarrow"),
    "studio": ("starlette", "uvicorn", "websockets"),
}
"""The packages of each extra of `pyproject.toml` that users need."""
PYBULLET_BEFORE = (3, 12)


def pip_line(*packages: str) -> str:
    """Returns the line that installs packages for this interpreter, whichever `pip`
    the shell would find.

    An environment that uv made has no pip of its own; uv is called then.
    """
    from importlib.util import find_spec

    python = _interpreter()
    if find_spec("pip") is None and shutil.which("uv") is not None:
        return shlex.join(["uv", "pip", "install", "--python", python, *packages])
    return shlex.join([python, "-m", "pip", "install", *packages])


def extra_line(extra: str) -> str:
    """Returns the line that gets an extra of `waiter`, or its packages where
    `waiter` is not installed.
    """
    from importlib import metadata

    try:
        metadata.version(DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return pip_line(*EXTRAS[extra])
    return pip_line(f"{DISTRIBUTION}[{extra}]")


def has_pybullet_wheels() -> bool:
    """Returns whether pybullet can be installed here without a compiler."""
    return (
        sys.platform == "linux"
        and platform.machine() in ("x86_64", "AMD64")
        and sys.version_info[:2] < PYBULLET_BEFORE
    )


def pybullet_line() -> str | None:
    """Returns the line that gets PyBullet; None where it has no wheels."""
    return extra_line("sim") if has_pybullet_wheels() else None


def _interpreter() -> str:
    """This Python, by the short name under which the shell finds it, else by its path."""
    for name in ("python", "python3"):
        found = shutil.which(name)
        if found is not None and os.path.abspath(found) == os.path.abspath(sys.executable):
            return name
    return sys.executable or "python3"
