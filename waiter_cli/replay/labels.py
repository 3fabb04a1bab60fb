"""Names of nodes and tables on a picture of the room. Entry point `draw_labels`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from waiter_cli.replay.lettering import put, width_of
from waiter_cli.replay.room import Room

__all__ = ["draw_labels", "label_size"]

WHITE = (255, 255, 255, 255)
Spot = Callable[[float, float, float], tuple[float, float]]


def label_size(room: Room, width: int, height: int) -> int:
    """Pixels of the letters: legible in a small picture, smaller where there are many names."""
    names = len(room.nodes) + len(room.tables)
    crowded = 1.0 if names < 40 else 0.85 if names < 80 else 0.7
    return max(8, round(min(width, height * 4 / 3) / 60 * crowded))


def draw_labels(
    draw: Any, room: Room, project: Spot, size: int, scale: int, extent: tuple[int, int]
) -> None:
    """Writes the names, each where it covers no other name and no node; tables first.

    A node's name that would cover another one is left out; entrance, crossings and the nodes of
    tables come first, and keep theirs.  ``project`` takes metres to pixels of the final picture; ``draw`` is ``scale`` times finer.
    """
    taken: list[tuple[float, float, float, float]] = []
    for x, y in room.nodes.values():
        px, py = project(x, y, 0.0)
        r = max(size * 0.3, abs(project(x + 0.12, y, 0.0)[0] - px))
        taken.append((px - r, py - r, px + r, py + r))
    near = all(
        width_of(name, size) < 2.4 * _metre(project, box.x, box.y)
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
            draw,
            (scale * px, scale * py),
            "bar",
            scale * size,
            (255, 240, 214, 255),
            anchor="mm",
            halo=(50, 32, 22, 255),
            halo_width=scale,
        )
        taken.append((px - w, py - size / 2, px + w, py + size / 2))
    crowded = size * size * 0.4
    for name, (x, y) in sorted(room.nodes.items(), key=lambda item: _rank(room, item[0])):
        px, py = project(x, y, 0.0)
        text = f"{name} · entrance" if name == room.layout.entrance else name
        rim = abs(project(x + 0.15, y, 0.0)[0] - px) + abs(project(x + 0.15, y, 0.0)[1] - py)
        w, h, off = width_of(text, size), size * 0.9, max(size * 0.45, rim * 0.8)
        best: tuple[float, tuple[float, float, float, float]] | None = None
        for rank, (left, top) in enumerate(
            (
                (px + off, py - off - h), (px - off - w, py - off - h), (px + off, py + off),
                (px - off - w, py + off), (px - w / 2, py - off - h * 1.2), (px - w / 2, py + off * 1.2),
                (px + off * 1.4, py - h / 2), (px - off * 1.4 - w, py - h / 2),
            )
        ):  # fmt: skip
            box_ = (left, top, left + w, top + h)
            outside = left < 2 or top < 2 or box_[2] > extent[0] - 2 or box_[3] > extent[1] - 2
            cost = sum(_overlap(box_, other) for other in taken) + rank * 0.5 + outside * 1e4
            if best is None or cost < best[0]:
                best = (cost, box_)
        assert best is not None
        if best[0] > crowded and _rank(room, name) > 1:
            continue
        left, top, _, bottom = best[1]
        apart = size * 0.25
        taken.append((left - apart, top, best[1][2] + apart, bottom))
        put(
            draw, (scale * left, scale * (top + bottom) / 2), text, scale * size, (22, 58, 92, 255),
            halo=(255, 255, 255, 225), halo_width=max(1, scale * size // 8),
        )  # fmt: skip


def _metre(project: Spot, x: float, y: float) -> float:
    """Pixels of a metre across the picture at a table top."""
    ends = [project(x + dx, y + dy, 0.78) for dx, dy in ((0, 0), (1, 0), (0, 1))]
    return max(abs(end[0] - ends[0][0]) for end in ends[1:])


def _rank(room: Room, name: str) -> int:
    """How much a node's name matters: the entrance, where something is, and the others."""
    if name == room.layout.entrance:
        return 0
    places = [table.nodes for table in room.layout.tables]
    places += [room.layout.bar.nodes] if room.layout.bar else []
    return 1 if len(room.near[name]) != 2 else 2 if any(name in nodes for nodes in places) else 3


def _overlap(a: tuple[float, float, float, float], b: tuple[float, float, float, float]) -> float:
    wide = min(a[2], b[2]) - max(a[0], b[0])
    high = min(a[3], b[3]) - max(a[1], b[1])
    return wide * high if wide > 0 and high > 0 else 0.0
