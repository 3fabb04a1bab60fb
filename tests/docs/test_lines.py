"""The pages are read in a terminal and in an editor, too."""

from __future__ import annotations

from tests.support.paths import ROOT

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
WIDTH = 100


def wide_lines(text: str) -> list[str]:
    """The lines of prose that are too wide; tables, pictures and code go as far as they must."""
    fenced = False
    wide = []
    for line in text.splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith(("|", "![")) and len(line) > WIDTH:
            wide.append(line)
    return wide


def test_prose_fits_a_hundred_columns() -> None:
    wide = {page.relative_to(ROOT): wide_lines(page.read_text(encoding="utf-8")) for page in PAGES}
    assert not {page: lines for page, lines in wide.items() if lines}


def test_a_wide_line_is_seen() -> None:
    wide = "x" * 101
    assert wide_lines(f"{wide}\n| {wide} |\n```\n{wide}\n```\n") == [wide]
