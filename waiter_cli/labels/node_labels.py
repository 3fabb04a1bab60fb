"""Names on a picture of the room. Entry points `draw_signs`, `lay_out` and `give_way`.

Names of tables and of the bar are drawn once, with the room.  Names of nodes are laid out once,
and stand over whoever moves; where somebody would be under a name, it gives way: it moves to
another side of its node, beside whoever stands there, or is left out for that picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from waiter_cli.labels.lettering import put, width_of
from waiter_cli.room.label_boxes import Box, overlap, touching
from waiter_cli.room.room import Room

__all__ = [
    "Label", "Spot", "dots_of", "draw_signs", "give_way", "inside", "label_size", "lay_out",
    "lettered",
]  # fmt: skip

WHITE = (255, 255, 255, 255)
HIDDEN = 0.08
"""Part of a name that may be over somebody; more, and it gives way."""
NEAR = 0.6
"""How far people must be from a place that a name moves to, in heights of it."""
CLOSE = 8
"""How many of the places round a node touch it; a name's own place is one of them."""
HARD = 10.0
"""How much worse it is to cover another name or a node than to lie on furniture."""
BESIDE = 0.46
"""Metres from a node to a name that stands beside the robot or a person there."""

Spot = Callable[[float, float, float], tuple[float, float]]


class Label(NamedTuple):
    """The name of a node and where it may stand: first its own place, then others."""

    text: str
    spots: tuple[Box, ...]


def label_size(room: Room, width: int, height: int) -> int:
    """Returns pixels of the letters: legible in a small picture, smaller where there
    are many names.
    """
    names = len(room.nodes) + len(room.tables)
    crowded = 1.0 if names < 40 else 0.85 if names < 80 else 0.7
    return max(8, round(min(width, height * 4 / 3) / 60 * crowded))


def dots_of(room: Room, project: Spot, size: int) -> list[Box]:
    """Returns the dots of nodes in the picture."""
    dots: list[Box] = []
    for x, y in room.nodes.values():
        px, py = project(x, y, 0.0)
        r = max(size * 0.3, abs(project(x + 0.12, y, 0.0)[0] - px))
        dots.append((px - r, py - r, px + r, py + r))
    return dots


def draw_signs(draw: Any, room: Room, project: Spot, size: int, scale: int) -> list[Box]:
    """Writes the names of tables and of the bar; where other names must not stand.

    ``project`` takes metres to pixels of the final picture; ``draw`` is ``scale`` times finer.
    """
    taken: list[Box] = []
    near = all(
        width_of(name, size) < 2.4 * _metre(project, box.x, box.y, 0.78)
        for name, box in room.tables.items()
    )
    for name, box in room.tables.items():
        px, py = project(box.x, box.y, 0.78)
        w = width_of(name, size) / 2 + size * 0.45
        h = size * 0.72
        if near:
            draw.rounded_rectangle(
                [scale * (px - w), scale * (py - h), scale * (px + w), scale * (py + h)],
                scale * h * 0.8, fill=(44, 40, 44, 215),
            )  # fmt: skip
            put(draw, (scale * px, scale * py), name, scale * size, WHITE, anchor="mm")
        else:  # from so far away the guests would disappear behind it
            put(
                draw, (scale * px, scale * py), name, scale * size, WHITE, anchor="mm",
                halo=(44, 40, 44, 235), halo_width=max(1, scale * size // 8),
            )  # fmt: skip
        taken.append((px - w, py - h, px + w, py + h))
    if room.bar is not None:
        px, py = project(room.bar.x, room.bar.y, 1.1)
        w = width_of("bar", size) / 2
        put(
            draw, (scale * px, scale * py), "bar", scale * size, (255, 240, 214, 255), anchor="mm",
            halo=(50, 32, 22, 255), halo_width=scale,
        )  # fmt: skip
        taken.append((px - w, py - size / 2, px + w, py + size / 2))
    return taken


def lay_out(
    room: Room, project: Spot, size: int, extent: tuple[int, int], taken: Sequence[Box],
    cost: Callable[[Box], float] = lambda box: 0.0,
) -> tuple[Label, ...]:  # fmt: skip
    """Returns the names of nodes, each where it covers no other name and no node; ``taken`` is not.

    Among such places it is the one with the least ``cost``, in pixels of what it covers.  A name that
    would cover another one is left out; entrance, crossings and the nodes of tables come first,
    and keep theirs.
    """
    held = list(taken)
    crowded = size * size * 0.4
    homes: dict[str, tuple[Box, list[Box]]] = {}
    for name in sorted(room.nodes, key=lambda name: _rank(room, name)):
        boxes = _around(project, *room.nodes[name], width_of(_text(room, name), size), size)
        near = touching(boxes, held)
        within = [inside(box, extent) for box in boxes]
        hidden = [
            sum(overlap(box, other) for other in near) + (not fits) * 1e4
            for box, fits in zip(boxes, within)
        ]
        costs = [
            cost(box) + 0.5 * rank + (rank >= CLOSE) * 0.5 * size * size
            for rank, box in enumerate(boxes)
        ]
        best = min(range(CLOSE), key=lambda k: HARD * hidden[k] + costs[k])
        if hidden[best] > crowded and _rank(room, name) > 1:
            continue
        rest = [k for k in range(len(boxes)) if k != best and within[k]]
        homes[name] = boxes[best], [boxes[k] for k in sorted(rest, key=lambda k: costs[k])]
        held.append(_apart(boxes[best], size))
    labels = []
    for name, (home, others) in homes.items():
        held = [*taken, *(_apart(box, size) for each, (box, _) in homes.items() if each != name)]
        held = touching([home, *others], held)
        clear = [box for box in others if not any(overlap(box, other) for other in held)]
        labels.append(Label(_text(room, name), (home, *clear)))
    return tuple(labels)


def give_way(
    labels: Iterable[Label],
    covered: Callable[[Box], float],
    before: Mapping[Label, Box] | None = None,
    passing: Callable[[Box], float] | None = None,
) -> dict[Label, Box]:
    """Returns the names that are shown and where, as people stand.

    ``covered`` is how many pixels they fill.

    Names that need not give way keep their places; the others take the first that is free.
    ``before`` is where names stood in the picture before this one, so that none of them trembles
    while somebody walks past: it stays where it went until nobody is near its own place.
    ``passing`` is how many pixels those fill who are on the move; who sits near it does not matter.

    >>> name = Label("n1", ((0, 0, 20, 10), (30, 0, 50, 10)))
    >>> give_way([name], lambda box: 50.0 if box[0] < 10 else 0.0)[name]
    (30, 0, 50, 10)
    >>> give_way([name], lambda box: 50.0)
    {}
    """
    every = tuple(labels)

    def free(box: Box) -> bool:
        return covered(box) <= HIDDEN * (box[2] - box[0]) * (box[3] - box[1])

    def roomy(box: Box) -> bool:
        if not before:
            return free(box)
        left, top, right, bottom = box
        around = NEAR * (bottom - top)
        wider = (left - around, top - around, right + around, bottom + around)
        moving = (passing or covered)(wider)
        return free(box) and moving <= HIDDEN * (right - left) * (bottom - top)

    def clear(box: Box) -> bool:
        return not any(overlap(box, other) for other in shown.values())

    shown: dict[Label, Box] = {}
    for label in every:
        home = label.spots[0]
        stands = before is None or before.get(label) == home
        if free(home) if stands else roomy(home):
            shown[label] = home
    for label in every:
        last = before.get(label) if before else None
        if label not in shown and last is not None and clear(last) and free(last):
            shown[label] = last
    for label in every:
        if label not in shown:
            free_box = next((box for box in label.spots if clear(box) and roomy(box)), None)
            if free_box is not None:
                shown[label] = free_box
    return shown


@lru_cache(maxsize=512)
def lettered(text: str, size: int, scale: int) -> tuple[Any, int]:
    """Returns a name of a node as a picture ``scale`` times finer, and its rim:
    pixels of it round the text.
    """
    from PIL import Image, ImageDraw

    halo = max(1, scale * size // 8)
    rim = halo + scale
    wide, high = round(scale * width_of(text, size)), round(scale * size * 0.9)
    image = Image.new("RGBA", (wide + 2 * rim, high + 2 * rim), (255, 255, 255, 0))
    put(
        ImageDraw.Draw(image), (rim, rim + high / 2), text, scale * size, (22, 58, 92, 255),
        halo=(255, 255, 255, 225), halo_width=halo,
    )  # fmt: skip
    return image, rim


def _around(project: Spot, x: float, y: float, w: float, size: int) -> list[Box]:
    """Returns places for the name of a node: eight close to it, then some farther away."""
    px, py = project(x, y, 0.0)
    rim = abs(project(x + 0.15, y, 0.0)[0] - px) + abs(project(x + 0.15, y, 0.0)[1] - py)
    h, off = size * 0.9, max(size * 0.45, rim * 0.8)
    far = max(2 * off, BESIDE * _metre(project, x, y, 0.0))
    corners = (
        (px + off, py - off - h), (px - off - w, py - off - h), (px + off, py + off),
        (px - off - w, py + off), (px - w / 2, py - off - h * 1.2), (px - w / 2, py + off * 1.2),
        (px + off * 1.4, py - h / 2), (px - off * 1.4 - w, py - h / 2),
        (px + far, py - h / 2), (px - far - w, py - h / 2),
        (px + far, py - off - h), (px - far - w, py - off - h),
        (px + far, py + off), (px - far - w, py + off), (px - w / 2, py + far),
    )  # fmt: skip
    return [(left, top, left + w, top + h) for left, top in corners]


def _text(room: Room, name: str) -> str:
    return f"{name} · entrance" if name == room.layout.entrance else name


def _apart(box: Box, size: int) -> Box:
    """Returns a name with the space that parts it from its neighbours."""
    return box[0] - size * 0.25, box[1], box[2] + size * 0.25, box[3]


def inside(box: Box, extent: tuple[int, int]) -> bool:
    """Returns whether a name is in the picture, clear of its rim."""
    return min(box[:2]) >= 2 and box[2] <= extent[0] - 2 and box[3] <= extent[1] - 2


def _metre(project: Spot, x: float, y: float, z: float) -> float:
    """Returns pixels of a metre across the picture at a place."""
    ends = [project(x + dx, y + dy, z) for dx, dy in ((0, 0), (1, 0), (0, 1))]
    return max(abs(end[0] - ends[0][0]) for end in ends[1:])


def _rank(room: Room, name: str) -> int:
    """Returns the rank of a node's name: the entrance, where something is, and the others."""
    if name == room.layout.entrance:
        return 0
    places = [table.nodes for table in room.layout.tables]
    places += [room.layout.bar.nodes] if room.layout.bar else []
    return 1 if len(room.near[name]) != 2 else 2 if any(name in nodes for nodes in places) else 3
