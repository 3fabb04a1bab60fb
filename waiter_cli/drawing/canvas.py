"""Draws on SVG and PNG alike: the protocol `Canvas`, and the colours.

Coordinates are pixels, x to the right and y down; angles are degrees, clockwise as seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from sparc.lazy_dataclass import dataclass

__all__ = ["PALETTE", "Canvas", "Palette", "text_width", "ROBOTS"]


@dataclass(frozen=True)
class Palette:
    """The colours of a picture, as #rrggbb."""

    paper: str = "#fdfbf7"
    floor: str = "#f4ecdf"
    rim: str = "#d9cbb4"
    wall: str = "#51493f"
    lane: str = "#e7dac4"
    path: str = "#b9a585"
    node: str = "#ffffff"
    node_rim: str = "#7d6c54"
    table: str = "#c9935f"
    table_rim: str = "#8d5f37"
    on_table: str = "#3b2412"
    chair: str = "#e8c8a0"
    chair_rim: str = "#b68a5b"
    guest: str = "#3f7fb5"
    guest_rim: str = "#2b5c86"
    bar: str = "#5e4a3a"
    bar_rim: str = "#3d2f24"
    on_dark: str = "#ffffff"
    robot: str = "#0f766e"
    waiter: str = "#8b3f7f"
    door: str = "#3d8b57"
    walk: str = "#d1432f"
    mark: str = "#f2b01e"
    glow: str = "#fde9b0"
    ink: str = "#2f2a24"
    faint: str = "#8a7d6b"


PALETTE = Palette()
ROBOTS = ("#0f766e", "#b4531f", "#6d4fb3", "#2f6fb0", "#a3386b", "#6b7a1e")
"""The colours of several robots and their walks, by turns."""


class Canvas(Protocol):
    """Shapes and text, later ones on top of earlier ones."""

    def polygon(
        self, points: Sequence[tuple[float, float]], fill: str, rim: str = "", width: float = 0.0
    ) -> None:
        """A filled polygon; no line round it where ``rim`` is empty."""

    def box(
        self,
        centre: tuple[float, float],
        size: tuple[float, float],
        fill: str,
        rim: str = "",
        width: float = 0.0,
        *,
        radius: float = 0.0,
        angle: float = 0.0,
        dashed: bool = False,
    ) -> None:
        """A rectangle with round corners, turned about its centre; ``fill`` empty: a frame."""

    def line(
        self,
        points: Sequence[tuple[float, float]],
        colour: str,
        width: float,
        dash: tuple[float, float] | None = None,
    ) -> None:
        """A line through points, with round ends; ``dash``: lengths of dash and gap."""

    def circle(
        self,
        centre: tuple[float, float],
        radius: float,
        fill: str,
        rim: str = "",
        width: float = 0.0,
    ) -> None:
        """A disc, or a ring where ``fill`` is empty."""

    def text(
        self,
        at: tuple[float, float],
        text: str,
        size: float,
        colour: str,
        *,
        anchor: str = "middle",
        bold: bool = False,
        halo: str = "",
    ) -> None:
        """Draws a text whose middle (in height) is at ``at``; ``anchor`` is start, middle or end."""


_NARROW = frozenset("iljtfr.,:;'|!()[] ")
_WIDE = frozenset("mwMW@%")


def text_width(text: str, size: float, bold: bool = False) -> float:
    """Returns the approximate width of a text in pixels, near enough to keep labels apart.

    >>> round(text_width("table1", 10), 1)
    29.8
    """
    units = 0.0
    for letter in text:
        if letter in _NARROW:
            units += 0.33
        elif letter in _WIDE:
            units += 0.88
        else:
            units += 0.66 if letter.isupper() or ord(letter) > 0x2000 else 0.58
    return units * size * (1.05 if bold else 1.0)
