"""A canvas that remembers what is drawn on it, and a drawing on one."""

from __future__ import annotations

from typing import Any, NamedTuple

from waiter_cli.drawing.frame import Drawing, Frame
from waiter_cli.drawing.subject import Subject

__all__ = ["Drawn", "Noted", "drawing_of"]


class Drawn(NamedTuple):
    """A shape, what it was drawn with in order, and by name."""

    shape: str
    given: tuple[Any, ...]
    named: dict[str, Any]


class Noted:
    """Notes every shape in place of drawing it."""

    def __init__(self) -> None:
        self.drawn: list[Drawn] = []

    def __getattr__(self, shape: str) -> Any:
        if shape not in ("polygon", "box", "line", "circle", "text"):
            raise AttributeError(shape)
        return lambda *given, **named: self.drawn.append(Drawn(shape, given, named))

    def of(self, shape: str) -> list[Drawn]:
        return [each for each in self.drawn if each.shape == shape]

    def texts(self) -> list[str]:
        return [each.given[1] for each in self.of("text")]


def drawing_of(subject: Subject) -> tuple[Drawing, Noted]:
    """A drawing of a subject, and the canvas that it is drawn on."""
    canvas = Noted()
    return Drawing(subject, Frame(subject, 0.0), canvas), canvas
