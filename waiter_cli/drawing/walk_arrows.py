"""The walk of a plan in a picture: lines with arrow heads, the numbers of its steps, what is done.

Whoever walks keeps to the right, so the ways there and back lie side by side.  A way that is walked
several times is one line, and the numbers of its steps share one pill.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import atan2, cos, hypot, sin
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.drawing.canvas import PALETTE as C
from waiter_cli.drawing.frame import edge_name, pill_size
from waiter_cli.drawing.label_placement import Area, around, centred, led

if TYPE_CHECKING:
    from waiter_cli.drawing.frame import Drawing, Spot

__all__ = ["Track", "draw_numbers", "draw_tracks"]

FEW_DEEDS = 6
"""As many deeds are written out beside their nodes; of more, only the steps."""
ABREAST = 3
"""Numbers in one row of a pill."""


@dataclass(frozen=True)
class Track:
    """The line of the way from one node to the next, and the steps in which it is walked."""

    way: tuple[str, str]
    start: Spot
    end: Spot
    steps: tuple[int, ...]
    robot: str = "agent"

    def at(self, part: float, aside: float = 0.0) -> Spot:
        """Returns the spot at a part of the way, so many pixels to the right of it."""
        (ax, ay), (bx, by) = self.start, self.end
        long = hypot(bx - ax, by - ay) or 1.0
        ux, uy = (bx - ax) / long, (by - ay) / long
        return (ax + part * (bx - ax) - aside * uy, ay + part * (by - ay) + aside * ux)


def draw_tracks(drawing: Drawing) -> list[Track]:
    """Returns the lines of the walk, each with an arrow head.

    Numbers come later, with `draw_numbers`.
    """
    found: list[Track] = []
    for rank, robot in enumerate(drawing.colours):
        legs = [leg for leg in drawing.subject.legs if leg.robot == robot]
        steps: dict[tuple[str, str], list[int]] = {}
        for leg in legs:
            steps.setdefault((leg.start, leg.end), []).append(leg.step)
        tracks = {
            way: _track(drawing, way, tuple(numbers), robot, rank) for way, numbers in steps.items()
        }
        found += tracks.values()
        walked = [tracks[leg.start, leg.end] for leg in legs]
        points = [spot for track in walked for spot in (track.start, track.end)]
        if points:
            points = [drawing.nodes[legs[0].start], *points]
            drawing.canvas.line(points, C.paper, 5.0)
            drawing.canvas.line(points, walk_colour(drawing, robot), 2.6)
    for track in found:
        (ax, ay), (bx, by) = track.start, track.end
        turn, long = atan2(by - ay, bx - ax), hypot(bx - ax, by - ay)
        tip = track.at(max(0.75, 1 - 22 / long) if long > 30 else 1.0)
        drawing.arrow(tip, turn, 11.0, walk_colour(drawing, track.robot))
        drawing.placer.block_line(track.start, track.end, 5.0, 1.5, f"walk {track.way}")
        head = (tip[0] - 5.5 * cos(turn), tip[1] - 5.5 * sin(turn))
        drawing.block_box(head, (12.0, 12.0), 4.0)
    return found


def walk_colour(drawing: Drawing, robot: str) -> str:
    """Returns the colour of a robot's walk: its own where there are several."""
    return drawing.colours[robot] if drawing.subject.state.robots else C.walk


def _track(
    drawing: Drawing, way: tuple[str, str], steps: tuple[int, ...], robot: str, rank: int
) -> Track:
    (ax, ay), (bx, by) = (drawing.nodes[node] for node in way)
    away = hypot(bx - ax, by - ay) or 1.0
    ux, uy = (bx - ax) / away, (by - ay) / away
    aside = min(0.07 * drawing.scale, 5.5) * (1 + 0.8 * (rank % 3))  # side by side
    back = min(0.1 * drawing.scale, away / 4)
    return Track(
        way,
        (ax - uy * aside + ux * back, ay + ux * aside + uy * back),
        (bx - uy * aside - ux * back, by + ux * aside - uy * back),
        steps,
        robot,
    )


def draw_numbers(drawing: Drawing, tracks: Sequence[Track]) -> None:
    """The steps of every line, and tags for what is done at nodes; lines to them lie under all of them."""
    size = max(8.5, drawing.small - 1)
    pills = []
    for middle, rows, robot in _place_steps(drawing, tracks, size):
        colour = walk_colour(drawing, robot)
        pills.append((middle, rows, (C.paper, colour, colour)))
    for middle, rows, robot in _place_deeds(drawing, size):
        pills.append((middle, rows, (walk_colour(drawing, robot), C.paper, C.on_dark)))
    for middle, rows, colours in pills:
        drawing.pill(middle, rows, size, colours)


def _place_steps(
    drawing: Drawing, tracks: Sequence[Track], size: float
) -> Iterator[tuple[Spot, list[str], str]]:
    """Yields the numbers of its steps on every line.

    Beside it, with a line that leads there, where it is full.
    """
    # The longest pills are the hardest to place; of equal ones the first step goes first.
    for track in sorted(tracks, key=lambda track: (-len(track.steps), track.steps)):
        rows = _rows(map(str, track.steps))
        box = pill_size(rows, size)
        (ax, ay), (bx, by) = track.start, track.end
        long = hypot(bx - ax, by - ay) or 1.0
        half = (abs(by - ay) * box[0] + abs(bx - ax) * box[1]) / long / 2
        parts = (0.42, 0.34, 0.5, 0.26, 0.58, 0.18, 0.66, 0.1, 0.8, 0.0, 1.0)
        spots = [track.at(part) for part in parts]
        spots += [track.at(part, half - 3) for part in parts]
        on_track = [centred(spot, box) for spot in spots]
        middle = track.at(0.42)
        beside = around(middle, box, [12.0 + 5 * k for k in range(14)])
        on = (f"walk {track.way}", edge_name(*track.way))
        area = drawing.placer.place([*on_track, *beside], 3.0, (middle, 2.0), on)
        if area not in on_track:
            _lead(drawing, area, middle, 0.0, track.robot)
        yield area.middle, rows, track.robot


def _place_deeds(drawing: Drawing, size: float) -> Iterator[tuple[Spot, list[str], str]]:
    """Yields a tag beside each node with the actions done there, one for each robot."""
    words: dict[tuple[str, str], list[str]] = {}
    for deed in drawing.subject.deeds:
        few = len(drawing.subject.deeds) <= FEW_DEEDS
        words.setdefault((deed.node, deed.robot), []).append(
            f"{deed.step} {deed.text}" if few else str(deed.step)
        )
    for (node, robot), said in words.items():
        rows = said if len(drawing.subject.deeds) <= FEW_DEEDS else _rows(said)
        box, spot, reach = pill_size(rows, size), drawing.nodes[node], drawing.reach(node)
        gaps = [max(0.2 * drawing.scale, reach + 4) + 5 * k for k in range(16)]
        area = drawing.placer.place(around(spot, box, gaps), 0.5, (spot, reach))
        _lead(drawing, area, spot, drawing.dot, robot)
        yield area.middle, rows, robot


def _rows(numbers: Sequence[str] | map[str]) -> list[str]:
    """Returns numbers in rows of a few."""
    all_of_them = list(numbers)
    count = len(all_of_them)
    wide = ABREAST if count != ABREAST + 1 else 2
    return [", ".join(all_of_them[k : k + wide]) for k in range(0, count, wide)]


def _lead(drawing: Drawing, area: Area, spot: Spot, away: float, robot: str) -> None:
    """A thin line from a spot to the label that belongs to it."""
    ends = led(area, spot, away)
    if ends is not None:
        drawing.canvas.line((ends[0], area.middle), walk_colour(drawing, robot), 1.4)
        drawing.placer.block_line(*ends, 4.0, 4.0)
