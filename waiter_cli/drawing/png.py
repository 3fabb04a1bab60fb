"""A picture as the bytes of a PNG, drawn by Pillow. Entry point `PngCanvas`.

Everything is drawn four times as large as a picture's pixels and made half as large at the end: two
pixels of the file to one of the picture, with smooth edges.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from functools import lru_cache
from math import ceil, cos, dist, pi, radians, sin
from typing import Any

from waiter_cli.errors import MissingError

__all__ = ["PngCanvas"]

_DENSITY = 2
_SMOOTH = 2
_MOST = 60_000_000
"""Pixels drawn at most; a larger picture is drawn less smoothly."""


class PngCanvas:
    """See `waiter_cli.drawing.canvas`; raises `MissingError` where Pillow is not installed."""

    def __init__(self, width: float, height: float, paper: str, title: str) -> None:
        try:
            from PIL import Image, ImageDraw
        except ImportError:
            from waiter_cli.optional_packages import extra_line

            mend = f"{extra_line('record')} (or draw to a file that ends in .svg)"
            raise MissingError("PNG pictures need Pillow, which is missing", mend) from None
        self.smooth = _SMOOTH
        scale = _DENSITY * _SMOOTH
        if width * height * scale * scale > _MOST:
            self.smooth, scale = 1, _DENSITY
        if width * height * scale * scale > _MOST:
            scale = 1
        self.scale = scale
        size = (ceil(width) * scale, ceil(height) * scale)
        self.image = Image.new("RGB", size, paper)
        self.pen = ImageDraw.Draw(self.image)
        self.title = title

    def document(self) -> bytes:
        """Returns the PNG file."""
        from PIL.PngImagePlugin import PngInfo

        info = PngInfo()
        info.add_itxt("Title", self.title)
        image = self.image.reduce(self.smooth) if self.smooth > 1 else self.image
        out = io.BytesIO()
        image.save(out, "PNG", pnginfo=info, optimize=False)
        return out.getvalue()

    def polygon(
        self, points: Sequence[tuple[float, float]], fill: str, rim: str = "", width: float = 0.0
    ) -> None:
        """Implements `Canvas.polygon`."""
        if fill:
            self.pen.polygon([self._at(p) for p in points], fill=fill)
        if rim:
            self.line([*points, points[0]], rim, width)

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
        """Implements `Canvas.box`."""
        outline = _round_box(centre, size, radius, angle)
        if fill:
            self.pen.polygon([self._at(p) for p in outline], fill=fill)
        if rim:
            self.line([*outline, outline[0]], rim, width, (3.0, 3.0) if dashed else None)

    def line(
        self,
        points: Sequence[tuple[float, float]],
        colour: str,
        width: float,
        dash: tuple[float, float] | None = None,
    ) -> None:
        """Implements `Canvas.line`."""
        thick = max(1, round(width * self.scale))
        for part in _dashes(points, dash) if dash else (points,):
            ends = [self._at(p) for p in part]
            self.pen.line(ends, fill=colour, width=thick, joint="curve")
            if thick > 2:
                for x, y in (ends[0], ends[-1]):
                    r = thick / 2
                    self.pen.ellipse((x - r, y - r, x + r, y + r), fill=colour)

    def circle(
        self,
        centre: tuple[float, float],
        radius: float,
        fill: str,
        rim: str = "",
        width: float = 0.0,
    ) -> None:
        """Implements `Canvas.circle`."""
        x, y = self._at(centre)
        r = (radius + (width / 2 if rim else 0)) * self.scale
        thick = max(1, round(width * self.scale)) if rim else 0
        self.pen.ellipse(
            (x - r, y - r, x + r, y + r), fill=fill or None, outline=rim or None, width=thick
        )

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
        """Implements `Canvas.text`."""
        if not text:
            return
        if "→" in text:
            self._text_with_arrows(at, text, size, colour, anchor, bold, halo)
            return
        font = _font(round(size * self.scale), text.isascii())
        x, y = at
        where = self._at((x, y + 0.36 * size))
        place = {"start": "ls", "middle": "ms", "end": "rs"}[anchor]
        heavy = size * self.scale / 45 if bold else 0.0
        if halo:
            wide = size * self.scale / 8 + heavy
            self.pen.text(where, text, halo, font, place, stroke_width=wide, stroke_fill=halo)
        self.pen.text(where, text, colour, font, place, stroke_width=heavy, stroke_fill=colour)

    def _text_with_arrows(
        self,
        at: tuple[float, float],
        text: str,
        size: float,
        colour: str,
        anchor: str,
        bold: bool,
        halo: str,
    ) -> None:
        """Draws a text whose arrows are lines, since Pillow's own font has none."""
        parts = text.split("→")
        wide = [self._width(part, size) for part in parts]
        arrow, gap = 0.8 * size, 0.12 * size
        whole = sum(wide) + (arrow + 2 * gap) * (len(parts) - 1)
        x, y = at[0] - {"start": 0.0, "middle": whole / 2, "end": whole}[anchor], at[1]
        for number, (part, long) in enumerate(zip(parts, wide)):
            if number:
                tip = x + gap + arrow
                self.line(((x + gap, y), (tip, y)), colour, size / 12)
                for side in (-1, 1):
                    barb = (tip - 0.26 * size, y + side * 0.2 * size)
                    self.line((barb, (tip, y)), colour, size / 12)
                x = tip + gap
            self.text((x, y), part, size, colour, anchor="start", bold=bold, halo=halo)
            x += long

    def _width(self, text: str, size: float) -> float:
        """Returns pixels that a text takes, of the picture."""
        font = _font(round(size * self.scale), text.isascii())
        return float(font.getlength(text)) / self.scale

    def _at(self, point: tuple[float, float]) -> tuple[float, float]:
        return (point[0] * self.scale, point[1] * self.scale)


@lru_cache(maxsize=64)
def _font(size: int, plain: bool) -> Any:
    """Returns Pillow's own font, or for letters beyond ASCII one that has them, if there is one."""
    from PIL import ImageFont

    if not plain:
        for name in ("DejaVuSans.ttf", "NotoSans-Regular.ttf", "Arial.ttf"):
            try:
                return ImageFont.truetype(name, size)
            except OSError:
                continue
    return ImageFont.load_default(size)


def _round_box(
    centre: tuple[float, float], size: tuple[float, float], radius: float, angle: float
) -> list[tuple[float, float]]:
    """Returns the outline of a box with round corners, turned about its centre."""
    half_w, half_h = size[0] / 2, size[1] / 2
    radius = min(radius, half_w, half_h)
    points = []
    for quarter, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        cx, cy = sx * (half_w - radius), sy * (half_h - radius)
        steps = 6 if radius else 0
        for k in range(steps + 1):
            turn = pi / 2 * (quarter + (k / steps if steps else 0.5))
            points.append((cx + radius * cos(turn), cy + radius * sin(turn)))
    c, s = cos(radians(angle)), sin(radians(angle))
    return [(centre[0] + c * x - s * y, centre[1] + s * x + c * y) for x, y in points]


def _dashes(
    points: Sequence[tuple[float, float]], dash: tuple[float, float]
) -> list[list[tuple[float, float]]]:
    """Returns the pieces of a line that a dash pattern leaves."""
    out: list[list[tuple[float, float]]] = []
    on, left = True, dash[0]
    piece = [points[0]]
    for a, b in zip(points, points[1:]):
        length = dist(a, b)
        done = 0.0
        while length - done > left:
            done += left
            part = done / length
            point = (a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]))
            if on:
                out.append([*piece, point])
            on, left, piece = not on, dash[1] if on else dash[0], [point]
        left -= length - done
        piece.append(b)
    if on and len(piece) > 1:
        out.append(piece)
    return out
