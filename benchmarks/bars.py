"""Bar charts of seconds on a logarithmic axis, drawn with Pillow. Entry point `draw_bars`."""

from __future__ import annotations

from collections.abc import Sequence
from math import log10

__all__ = ["draw_bars"]

COLOURS = ("#1f77b4", "#d62728", "#bbbbbb", "#2ca02c")


def draw_bars(
    peers: Sequence[str],
    rows: Sequence[tuple[str, Sequence[object]]],
    path: str,
    limit: float,
    left: int = 90,
) -> None:
    """Draws a row a problem, a bar a peer: seconds, or an empty bar with a text such as ``>60``; None: no bar."""
    from PIL import Image, ImageDraw, ImageFont

    width, top, step = 810 + left, 70, 10 * len(peers) + 10
    image = Image.new("RGB", (width, top + step * len(rows) + 50), "white")
    pen, font = ImageDraw.Draw(image), ImageFont.load_default(15)
    low, high = -1.5, log10(limit) + 0.1
    scale = (width - left - 60) / (high - low)

    def x(seconds: float) -> float:
        return left + (log10(max(seconds, 0.032)) - low) * scale

    for i, (name, colour) in enumerate(zip(peers, COLOURS)):
        pen.rectangle((left + 200 * i, 18, left + 200 * i + 14, 32), fill=colour)
        pen.text((left + 200 * i + 20, 16), name, fill="black", font=font)
    for seconds in (0.1, 1, 10, 60):
        if seconds <= limit:
            pen.line((x(seconds), 44, x(seconds), image.height - 30), fill="#dddddd")
            pen.text(
                (x(seconds) - 10, image.height - 26), f"{seconds:g} s", fill="#555555", font=font
            )
    for number, (problem, values) in enumerate(rows):
        y = top + step * number
        pen.text((12, y + 4), problem, fill="black", font=font)
        for i, (value, colour) in enumerate(zip(values, COLOURS)):
            bar = y + 10 * i
            if isinstance(value, float):
                pen.rectangle((left, bar, x(value), bar + 8), fill=colour)
            elif isinstance(value, str) and value.startswith(">"):
                pen.rectangle((left, bar, x(limit), bar + 8), outline=colour)
                pen.text((x(limit) + 4, bar - 5), value, fill=colour, font=font)
    image.save(path, optimize=True)
