"""A picture as SVG text. Entry point `SvgCanvas`."""

from __future__ import annotations

from collections.abc import Sequence

from sparc.escaping import escaped

__all__ = ["SvgCanvas"]

_FONTS = "'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif"


class SvgCanvas:
    """Collects elements; ``text()`` of the whole is `document`.  See `waiter_cli.drawing.canvas`."""

    def __init__(self, width: float, height: float, paper: str, title: str) -> None:
        self.size = (width, height)
        self.title = title
        self.elements: list[str] = []
        self.box((width / 2, height / 2), (width, height), paper)

    def document(self) -> str:
        """Returns the SVG file."""
        width, height = (_number(side) for side in self.size)
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="{_FONTS}" '
            f'stroke-linejoin="round" stroke-linecap="round" role="img">'
        )
        return "\n".join(
            [head, f"<title>{_escaped(self.title)}</title>", *self.elements, "</svg>", ""]
        )

    def polygon(
        self, points: Sequence[tuple[float, float]], fill: str, rim: str = "", width: float = 0.0
    ) -> None:
        """Implements `Canvas.polygon`."""
        self.elements.append(f'<polygon points="{_points(points)}"{_paint(fill, rim, width)}/>')

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
        (x, y), (w, h) = centre, size
        more = f' rx="{_number(radius)}"' if radius else ""
        if dashed:
            more += ' stroke-dasharray="3 3"'
        if angle % 180:
            more += f' transform="rotate({_number(angle)} {_number(x)} {_number(y)})"'
        self.elements.append(
            f'<rect x="{_number(x - w / 2)}" y="{_number(y - h / 2)}" width="{_number(w)}" '
            f'height="{_number(h)}"{more}{_paint(fill, rim, width)}/>'
        )

    def line(
        self,
        points: Sequence[tuple[float, float]],
        colour: str,
        width: float,
        dash: tuple[float, float] | None = None,
    ) -> None:
        """Implements `Canvas.line`."""
        more = f' stroke-dasharray="{_number(dash[0])} {_number(dash[1])}"' if dash else ""
        self.elements.append(
            f'<polyline points="{_points(points)}" fill="none" stroke="{colour}" '
            f'stroke-width="{_number(width)}"{more}/>'
        )

    def circle(
        self,
        centre: tuple[float, float],
        radius: float,
        fill: str,
        rim: str = "",
        width: float = 0.0,
    ) -> None:
        """Implements `Canvas.circle`."""
        x, y = centre
        self.elements.append(
            f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(radius)}"'
            f"{_paint(fill, rim, width)}/>"
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
        x, y = at
        more = ' font-weight="600"' if bold else ""
        if anchor != "start":
            more += f' text-anchor="{anchor}"'
        if halo:
            more += f' stroke="{halo}" stroke-width="{_number(size / 4)}" paint-order="stroke"'
        # 0.36 em below the middle: a baseline that looks centred in every common font.
        self.elements.append(
            f'<text x="{_number(x)}" y="{_number(y + 0.36 * size)}" font-size="{_number(size)}" '
            f'fill="{colour}"{more}>{_escaped(text)}</text>'
        )


def _paint(fill: str, rim: str, width: float) -> str:
    line = f' stroke="{rim}" stroke-width="{_number(width)}"' if rim else ""
    return f' fill="{fill or "none"}"{line}'


def _points(points: Sequence[tuple[float, float]]) -> str:
    return " ".join(f"{_number(x)},{_number(y)}" for x, y in points)


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")


def _escaped(text: str) -> str:
    """Returns text for XML; what XML cannot hold, or a reader cannot see, as codes."""
    legal = escaped(text)
    return legal.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
