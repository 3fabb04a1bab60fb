"""The files of the page, held in memory by the names a browser asks for. Entry point `page_files`.

What draws a floor lies in ``pictures/page`` and serves the replay page, too; the rest in
``studio/page``.  Nothing else can be asked for: a name is a key here, never a path.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from waiter_cli import pictures, studio

__all__ = ["page_files"]

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}


@cache
def page_files() -> dict[str, tuple[bytes, str]]:
    """Returns the bytes and the media type of each file of the page, by its name."""
    found = {}
    for package in (pictures, studio):
        for folder in package.__path__:
            for path in sorted((Path(folder) / "page").iterdir()):
                if path.suffix in _TYPES:
                    found[path.name] = (path.read_bytes(), _TYPES[path.suffix])
    return found
