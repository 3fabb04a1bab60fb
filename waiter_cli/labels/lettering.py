"""Text in pictures, the same on every machine: Pillow's own typeface. Entry points `font`, `put`."""

from __future__ import annotations

from functools import cache, lru_cache
from typing import Any

from waiter_cli.errors import MissingError

__all__ = ["font", "put", "require", "width_of"]


def require() -> None:
    """Raises `MissingError` where pictures cannot be made: numpy or Pillow is missing."""
    try:
        import numpy  # noqa: F401
        import PIL.ImageDraw
        import PIL.ImageFont  # noqa: F401
    except ImportError as error:
        from waiter_cli.optional_packages import extra_line

        mend = extra_line("record")
        raise MissingError(f"pictures need {error.name or error}, which is missing", mend) from None


@cache
def font(size: int) -> Any:
    """Returns the typeface at a size in pixels."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


@lru_cache(maxsize=4096)
def width_of(text: str, size: int) -> float:
    """Returns pixels that a text takes."""
    return float(font(size).getlength(_spaced(text)))


def put(
    draw: Any, at: tuple[float, float], text: str, size: int, fill: Any, *, anchor: str = "lm",
    bold: bool = False, halo: Any = None, halo_width: int = 2,
) -> None:  # fmt: skip
    """Writes a text; ``halo`` is the colour of a rim round the letters."""
    text = _spaced(text)
    weight = max(1, round(size / 22)) if bold else 0
    if halo is not None:
        draw.text(at, text, fill=halo, font=font(size), anchor=anchor,
                  stroke_width=weight + halo_width, stroke_fill=halo)  # fmt: skip
    draw.text(
        at,
        text,
        fill=fill,
        font=font(size),
        anchor=anchor,
        stroke_width=weight // 2 if size < 30 else weight,
        stroke_fill=fill,
    )


def _spaced(text: str) -> str:
    """Returns the text with wider gaps between words: those of the typeface are narrow."""
    return text.replace(" ", "  ")
