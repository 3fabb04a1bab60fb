"""The modules that draw a floor, as one script and one style for a page without a server.

Entry points `bundled_script`, `bundled_style`.  A browser loads no modules from a file's folder; so their
imports, which are a line each, are left out, and what they export stands side by side.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

__all__ = ["PAGE", "bundled_script", "bundled_style"]

PAGE = Path(__file__).parent / "page"
_ORDER = ("shapes.js", "figures.js", "floor.js", "moments.js")
"""Each after those whose values it needs at its start."""
_IMPORT = re.compile(r"^import [^;\n]*;\n", re.MULTILINE)
_EXPORT = re.compile(r"^export ", re.MULTILINE)
_COMMENT = re.compile(r"^\s*(//.*|/\*\*.*\*/|/\*\*(?:.|\n)*?\*/)\n", re.MULTILINE)


@cache
def bundled_script() -> str:
    """Returns the modules without what only a loader or a reader needs."""
    parts = [(PAGE / name).read_text(encoding="utf-8") for name in _ORDER]
    return "".join(_COMMENT.sub("", _EXPORT.sub("", _IMPORT.sub("", part))) for part in parts)


@cache
def bundled_style() -> str:
    """Returns the style of a floor."""
    return (PAGE / "floor.css").read_text(encoding="utf-8")
