"""The width of a text as labels reckon with it, and colours that can be told apart."""

from __future__ import annotations

import re
from dataclasses import fields
from itertools import pairwise

from waiter_cli.drawing.canvas import PALETTE, ROBOTS, text_width


def test_more_and_wider_letters_are_wider() -> None:
    widths = [text_width(text, 10) for text in ("", "i", "a", "W", "aa", "WW")]
    assert all(a < b for a, b in pairwise(widths)) and widths[0] == 0.0
    assert text_width("a b", 10) > text_width("ab", 10)


def test_a_width_grows_with_the_letters_and_when_they_are_bold() -> None:
    assert text_width("table", 20) == 2 * text_width("table", 10)
    assert text_width("table", 10, bold=True) > text_width("table", 10)


def test_capitals_and_letters_of_other_scripts_are_wide() -> None:
    assert text_width("T", 10) == text_width("椅", 10) > text_width("t", 10)


def test_colours_are_colours_and_robots_differ() -> None:
    names = getattr(type(PALETTE), "__annotations__", {}) or [f.name for f in fields(PALETTE)]
    colours = [getattr(PALETTE, name) for name in names]
    assert len(colours) > 20 and all(re.fullmatch("#[0-9a-f]{6}", c) for c in (*colours, *ROBOTS))
    assert len(set(ROBOTS)) == len(ROBOTS)
