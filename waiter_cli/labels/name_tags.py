"""Names of people on a picture of the room. Entry points `place_tags`, `tag`, `tag_size`.

A tag stands beside whom it names: over the head where that is free, else on another side, or on the
chest.  It covers no face and no other name; where no place is left, there is no tag in that picture.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from waiter_cli.labels.lettering import put, width_of
from waiter_cli.labels.node_labels import Spot, inside
from waiter_cli.room.label_boxes import Box, enclosing, overlap
from waiter_cli.room.room import Room

__all__ = ["Stature", "Tag", "place_tags", "rather_not_over", "tag", "tag_size"]

PAPER, INK = (255, 255, 255, 226), (44, 40, 44, 255)
COVERED = 0.04
"""Part of a tag that may be over a face or another name."""
STAYS = 0.4
"""How much worse a tag's place may be than the best before the tag moves there."""
OTHERS, OWN, DOTS, TOPS = 1.0, 0.5, 0.8, 0.4
"""How bad it is to be over somebody else, over whom it names, over a node and over a table."""


class Stature(NamedTuple):
    """The body of somebody in the picture: ``head`` is not to be covered, ``body`` is all of him."""

    name: str
    head: Box
    body: Box


class Tag(NamedTuple):
    """The place of a tag, and the side of the person that it stands on."""

    box: Box
    side: int


def tag_size(letters: int) -> int:
    """Returns pixels of the letters of a tag where names of nodes have ``letters``."""
    return max(8, round(letters * 0.85))


def place_tags(
    people: Sequence[Stature], named: Sequence[str], size: int, extent: tuple[int, int],
    taken: Sequence[Box], rather_not: Sequence[tuple[Box, float]], before: Mapping[str, Tag],
) -> dict[str, Tag]:  # fmt: skip
    """Returns a tag for each of ``named`` among ``people`` that has a place for it.

    ``taken`` are other names, ``rather_not`` what is better seen, and how much so; ``before`` is the
    picture before this one: a tag keeps its side while that is about as good as any.

    >>> ada = Stature("ada", (40, 40, 60, 60), (35, 40, 65, 120))
    >>> place_tags([ada], ["ada"], 10, (200, 200), [], [], {})["ada"].side
    0
    >>> place_tags([ada], ["ada"], 10, (200, 200), [(0, 0, 200, 35)], [], {})["ada"].side
    1
    """
    shown: dict[str, Tag] = {}
    held = [*taken, *(person.head for person in people)]
    statures = {person.name: person for person in people}
    for name in sorted(named, key=lambda name: name not in before):  # who has one, keeps it
        who = statures[name]
        reach = _reach(who, size)
        near = tuple(box for box in held if overlap(box, reach))
        soft = [(box, weight) for box, weight in rather_not if overlap(box, reach)]
        soft += [
            (other.body, OWN if other is who else OTHERS)
            for other in people
            if overlap(other.body, reach)
        ]
        last = before[name].side if name in before else None
        tag = _best(who, size, extent, near, tuple(soft), last)
        if tag is not None:
            shown[name] = tag
            held.append(tag.box)
    return shown


@lru_cache(maxsize=1024)
def _best(
    who: Stature, size: int, extent: tuple[int, int], near: tuple[Box, ...],
    soft: tuple[tuple[Box, float], ...], last: int | None,
) -> Tag | None:  # fmt: skip
    """Returns the tag where it disturbs least, None where it would cover what is ``near``."""
    places = _places(who, size)
    most = COVERED * (places[0][2] - places[0][0]) * (places[0][3] - places[0][1])
    costs: dict[int, float] = {}
    for side, box in enumerate(places):
        if inside(box, extent) and sum(overlap(box, other) for other in near) <= most:
            under = sum(weight * overlap(box, other) for other, weight in soft)
            costs[side] = 0.04 * side + COVERED * under / most
    if not costs:
        return None
    best = min(costs, key=lambda side: costs[side])
    if last is not None and costs.get(last, 9.0) <= costs[best] + STAYS:
        best = last
    return Tag(places[best], best)


def rather_not_over(room: Room, project: Spot, dots: Sequence[Box]) -> list[tuple[Box, float]]:
    """Returns nodes and tables, which tags leave free where they can."""
    soft = [(dot, DOTS) for dot in dots]
    for box in room.tables.values():
        spots = [project(x, y, 0.76) for x, y in box.corners()]
        soft.append((enclosing([(*spot, *spot) for spot in spots]), TOPS))
    return soft


@lru_cache(maxsize=512)
def tag(name: str, colour: tuple[float, float, float], size: int, scale: int) -> Any:
    """Returns a tag as a picture ``scale`` times finer: a dot in the colour of the
    shirt, and the name.
    """
    from PIL import Image, ImageDraw

    w, h = (round(scale * edge) for edge in _extent(name, size))
    image = Image.new("RGBA", (w, h), (*PAPER[:3], 0))
    draw = ImageDraw.Draw(image)
    draw.rounded_rectangle([0, 0, w - 1, h - 1], h * 0.42, PAPER)
    em = scale * size
    x, r = em * 0.68, em * 0.27
    shirt = tuple(round(255 * v) for v in colour)
    draw.ellipse([x - r, h / 2 - r, x + r, h / 2 + r], (*shirt, 255))
    put(draw, (em * 1.16, h / 2), name, em, INK)
    return image


def _extent(name: str, size: int) -> tuple[float, float]:
    return width_of(name, size) + size * 1.6, size * 1.3


@lru_cache(maxsize=1024)
def _places(who: Stature, size: int) -> tuple[Box, ...]:
    """Returns places over the head, beside it, beside and under the body, and on the chest."""
    w, h = _extent(who.name, size)
    left, top, right, bottom = who.head
    middle, level = (left + right) / 2, (top + bottom) / 2
    gap, (west, _, east, foot) = h * 0.15, who.body
    waist = (bottom + foot) / 2
    corners = [
        (middle - w / 2, top - gap - h),
        (right + gap, level - h / 2), (left - gap - w, level - h / 2),
        (right - w * 0.2, top - gap - h), (left + w * 0.2 - w, top - gap - h),
        (east + gap, waist - h / 2), (west - gap - w, waist - h / 2),
        (middle - w / 2, foot + gap),
        (east + gap, foot - h), (west - gap - w, foot - h),
        (east + gap, top - h), (west - gap - w, top - h),
    ]  # fmt: skip
    if foot - bottom > 1.5 * h:
        corners.append((middle - w / 2, bottom + gap))
    return tuple((x, y, x + w, y + h) for x, y in corners)


@lru_cache(maxsize=1024)
def _reach(who: Stature, size: int) -> Box:
    """Returns the box around all places of a tag."""
    return enclosing(_places(who, size))
