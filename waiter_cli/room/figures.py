"""Builds the shapes of things and people: meshes of a few smooth solids, in metres. Pure.

Entry points `person`, `robot`, `table`, `chair`, `bar`, `wall`.  A figure is a tuple of `Part`, one a
colour, around the origin of the thing's own frame: x is where it looks, z up, z = 0 the floor.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from math import cos, hypot, lcm, pi, sin
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass

__all__ = [
    "HAIR",
    "LOOKS",
    "SHIRTS",
    "Figure",
    "Part",
    "bar",
    "chair",
    "person",
    "plates",
    "rings_of",
    "robot",
    "shirt_of",
    "slab",
    "table",
    "wall",
]

Vec: TypeAlias = tuple[float, float, float]
Colour: TypeAlias = tuple[float, float, float]

SHIRTS: tuple[Colour, ...] = (
    (0.83, 0.29, 0.26), (0.20, 0.47, 0.74), (0.93, 0.66, 0.19), (0.36, 0.62, 0.36),
    (0.58, 0.38, 0.66), (0.16, 0.60, 0.62), (0.88, 0.47, 0.58), (0.62, 0.44, 0.28),
)  # fmt: skip
HAIR: tuple[Colour, ...] = (
    (0.20, 0.13, 0.09),
    (0.46, 0.29, 0.14),
    (0.12, 0.12, 0.14),
    (0.72, 0.55, 0.28),
)
SKIN: tuple[Colour, ...] = ((0.93, 0.76, 0.63), (0.78, 0.57, 0.42), (0.56, 0.38, 0.28))
LOOKS = lcm(len(SHIRTS), len(HAIR), len(SKIN))
TROUSERS: Colour = (0.20, 0.23, 0.33)
WOOD: Colour = (0.52, 0.34, 0.20)
OAK: Colour = (0.66, 0.46, 0.28)
DARK: Colour = (0.20, 0.18, 0.18)
LINEN: Colour = (0.95, 0.93, 0.87)
WHITE: Colour = (0.96, 0.97, 0.98)
TEAL: Colour = (0.07, 0.58, 0.62)
ROBOT_COLOURS: tuple[Colour, ...] = (
    TEAL, (0.88, 0.42, 0.10), (0.54, 0.33, 0.80), (0.27, 0.61, 0.24), (0.83, 0.25, 0.44)
)  # fmt: skip

ROBOT_RINGS = (
    ((18, 160, 170), (18, 150, 158)), ((226, 112, 32), (206, 96, 20)), ((138, 84, 204), (122, 70, 186)),
    ((70, 156, 62), (56, 138, 50)), ((212, 64, 112), (190, 50, 96)),
)  # fmt: skip
"""The colours of several robots: of the ring around each, and of its rim."""


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh of one colour: ``vertices`` and ``normals`` as triples, ``indices`` three a triangle."""

    colour: Colour
    vertices: tuple[Vec, ...]
    normals: tuple[Vec, ...]
    indices: tuple[int, ...]


Figure: TypeAlias = tuple[Part, ...]
_Mesh: TypeAlias = tuple[list[Vec], list[Vec], list[int]]


def _lathe(
    profile: Sequence[tuple[float, float]], at: Vec = (0, 0, 0), axis: str = "z", n: int = 14
) -> _Mesh:
    """Returns a surface of revolution: ``profile`` holds (radius, height) from below."""
    points: list[Vec] = []
    normals: list[Vec] = []
    indices: list[int] = []
    for i, (radius, height) in enumerate(profile):
        (ra, ha), (rb, hb) = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        dr, dh = rb - ra, hb - ha
        length = hypot(dr, dh) or 1.0
        for k in range(n):
            c, s = cos(2 * pi * k / n), sin(2 * pi * k / n)
            point = (radius * c, radius * s, height)
            normal = (dh / length * c, dh / length * s, -dr / length)
            if axis == "x":
                point, normal = (point[2], point[1], -point[0]), (normal[2], normal[1], -normal[0])
            elif axis == "y":
                point, normal = (point[0], point[2], -point[1]), (normal[0], normal[2], -normal[1])
            points.append((point[0] + at[0], point[1] + at[1], point[2] + at[2]))
            normals.append(normal)
    for i in range(len(profile) - 1):
        for k in range(n):
            a, b = i * n + k, i * n + (k + 1) % n
            indices += [a, b, a + n, b, b + n, a + n]
    return points, normals, indices


def _ball(radius: float, at: Vec, low: float = 0.0, squash: float = 1.0, n: int = 14) -> _Mesh:
    """Returns a sphere, or the part of it above ``low`` (0 is the bottom, 1 the top)."""
    steps = 9
    profile = []
    for k in range(steps + 1):
        angle = pi * (low + (1 - low) * k / steps)
        profile.append((max(radius * sin(angle), 1e-4), -radius * squash * cos(angle)))
    return _lathe(profile, at, n=n)


def _rod(radius: float, low: float, high: float, at: Vec = (0, 0, 0), axis: str = "z") -> _Mesh:
    """Returns a rounded rod along an axis from ``low`` to ``high``."""
    r = radius
    profile = [
        (1e-4, low),
        (r * 0.7, low + r * 0.3),
        (r, low + r),
        (r, high - r),
        (r * 0.7, high - r * 0.3),
        (1e-4, high),
    ]
    return _lathe(profile, at, axis, n=10)


def _disc(radius: float, low: float, high: float, at: Vec = (0, 0, 0), n: int = 20) -> _Mesh:
    """Returns a flat cylinder with a closed top; its rim is sharp."""
    side = _lathe([(radius, low), (radius, high)], at, n=n)
    top = _lathe([(radius, high), (1e-4, high + 1e-4)], at, n=n)
    return _joined((side, top))


def _block(half: Vec, at: Vec) -> _Mesh:
    """Returns a box with flat sides."""
    points: list[Vec] = []
    normals: list[Vec] = []
    indices: list[int] = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(points)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                point, normal = [0.0] * 3, [0.0] * 3
                point[axis], point[u], point[v] = sign * half[axis], a * half[u], b * sign * half[v]
                normal[axis] = sign
                points.append((point[0] + at[0], point[1] + at[1], point[2] + at[2]))
                normals.append((normal[0], normal[1], normal[2]))
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return points, normals, indices


def _joined(meshes: Iterable[_Mesh]) -> _Mesh:
    points: list[Vec] = []
    normals: list[Vec] = []
    indices: list[int] = []
    for more_points, more_normals, more_indices in meshes:
        first = len(points)
        points += more_points
        normals += more_normals
        indices += [first + k for k in more_indices]
    return points, normals, indices


def _part(colour: Colour, *meshes: _Mesh) -> Part:
    points, normals, indices = _joined(meshes)
    return Part(colour, tuple(points), tuple(normals), tuple(indices))


def _shade(colour: Colour, by: float) -> Colour:
    return (colour[0] * by, colour[1] * by, colour[2] * by)


def rings_of(number: int) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
    """Returns the colours, of 255, of the ring around a robot and of its rim."""
    return ROBOT_RINGS[number % len(ROBOT_RINGS)]


def shirt_of(number: int, role: str) -> Colour:
    """Returns the colour of somebody's shirt, or of a ``robot``."""
    if role == "robot":
        return ROBOT_COLOURS[number % len(ROBOT_COLOURS)]
    uniform = {"waiter": (0.13, 0.14, 0.17), "stranger": (0.95, 0.45, 0.12)}
    return uniform.get(role, SHIRTS[number % len(SHIRTS)])


def person(number: int, role: str, posture: str, hand: bool = False, stride: int = 0) -> Figure:
    """Returns somebody: ``posture`` is stand or sit; ``stride`` -1, 0, 1 puts a leg forward.

    Whoever has a number `LOOKS` higher looks the same.
    """
    return _person(number % LOOKS, role, posture, hand, stride)


@cache
def _person(number: int, role: str, posture: str, hand: bool, stride: int) -> Figure:
    shirt = shirt_of(number, role)
    hair, skin = HAIR[(number * 7 + 1) % len(HAIR)], SKIN[(number * 5) % len(SKIN)]
    sitting = posture == "sit"
    drop = 0.33 if sitting else 0.0
    if sitting:
        legs = [_rod(0.075, -0.05, 0.42, (0.0, s * 0.095, 0.53), "x") for s in (1, -1)]
        legs += [_rod(0.06, 0.02, 0.52, (0.36, s * 0.095, 0.0)) for s in (1, -1)]
        shoes = [_block((0.10, 0.045, 0.035), (0.41, s * 0.095, 0.035)) for s in (1, -1)]
    else:
        legs = [_rod(0.072, 0.04, 0.88, (s * stride * 0.10, s * 0.095, 0.0)) for s in (1, -1)]
        shoes = [
            _block((0.11, 0.05, 0.04), (0.03 + s * stride * 0.10, s * 0.095, 0.04)) for s in (1, -1)
        ]
    body = [
        (0.02, 0.76),
        (0.15, 0.78),
        (0.155, 0.88),
        (0.145, 1.0),
        (0.175, 1.18),
        (0.17, 1.30),
        (0.12, 1.40),
        (0.055, 1.44),
    ]
    torso = _lathe([(r, z - drop) for r, z in body])
    right = _rod(0.05, 0.88 - drop, 1.38 - drop, (0.02, -0.205, 0.0))
    left = (
        _rod(0.05, 1.26 - drop, 1.82 - drop, (0.02, 0.215, 0.0))
        if hand
        else _rod(0.05, 0.88 - drop, 1.38 - drop, (0.02, 0.205, 0.0))
    )
    hands = [
        _ball(0.05, (0.02, -0.205, 0.86 - drop)),
        _ball(0.055, (0.02, 0.215, 1.85 - drop) if hand else (0.02, 0.205, 0.86 - drop)),
    ]
    head = _ball(0.115, (0.015, 0.0, 1.555 - drop), squash=1.12)
    parts = [
        _part(TROUSERS, *legs), _part(DARK, *shoes), _part(shirt, torso, right, left),
        _part(skin, head, *hands, _rod(0.05, 1.38 - drop, 1.50 - drop)),
        _part(hair, _ball(0.128, (-0.022, 0.0, 1.585 - drop), low=0.38, squash=1.1)),
    ]  # fmt: skip
    if role == "waiter":
        parts.append(_part(WHITE, _block((0.012, 0.05, 0.13), (0.168, 0.0, 1.2 - drop))))
        parts.append(
            _part((0.75, 0.12, 0.16), _block((0.02, 0.05, 0.02), (0.15, 0.0, 1.37 - drop)))
        )
    if role == "stranger":
        parts.append(_part(OAK, _block((0.16, 0.22, 0.15), (0.30, 0.0, 1.0))))
    return tuple(parts)


@cache
def robot(load: str | None = None, number: int = 0) -> Figure:
    """Returns the robot of that number, with a plate, a jug or a basket on its tray."""
    colour = ROBOT_COLOURS[number % len(ROBOT_COLOURS)]
    parts = [
        _part((0.14, 0.15, 0.18), _lathe([(0.23, 0.0), (0.25, 0.03), (0.25, 0.10), (0.21, 0.14)], n=24)),
        _part(WHITE, _lathe([(0.20, 0.13), (0.185, 0.25), (0.145, 0.50), (0.125, 0.62), (0.15, 0.70), (0.18, 0.80), (0.17, 0.90), (0.06, 0.97), (0.05, 1.0)], n=24)),
        _part(colour, _lathe([(0.148, 0.48), (0.158, 0.50), (0.152, 0.55), (0.138, 0.57)], n=24), _rod(0.02, 0.95, 1.0)),
        _part(WHITE, _ball(0.155, (0.0, 0.0, 1.11), squash=0.86, n=20)),
        _part((0.06, 0.08, 0.11), _ball(0.12, (0.062, 0.0, 1.115), squash=0.62, n=18)),
        _part((0.35, 0.95, 1.0), *(_ball(0.024, (0.172, s * 0.05, 1.13)) for s in (1, -1))),
        _part((0.80, 0.13, 0.18), *(_block((0.015, 0.035, 0.025), (0.165, s * 0.045, 0.90)) for s in (1, -1)), _ball(0.022, (0.175, 0.0, 0.90))),
        _part((0.86, 0.87, 0.90), *(_rod(0.026, 0.05, 0.27, (0.0, s * 0.13, 0.78), "x") for s in (1, -1))),
        _part((0.70, 0.73, 0.77), _disc(0.155, 0.80, 0.82, (0.32, 0.0, 0.0))),
    ]  # fmt: skip
    if load is not None:
        parts += _load(load, (0.32, 0.0, 0.82))
    return tuple(parts)


def _load(item: str, at: Vec) -> list[Part]:
    if item == "jug":
        return [
            _part(
                (0.55, 0.78, 0.92),
                _lathe(
                    [(0.06, 0.0), (0.075, 0.08), (0.055, 0.18), (0.065, 0.24), (0.001, 0.241)], at
                ),
            )
        ]
    if item == "basket":
        return [
            _part((0.70, 0.50, 0.26), _lathe([(0.09, 0.0), (0.13, 0.09), (0.001, 0.091)], at)),
            _part((0.87, 0.66, 0.35), *(_ball(0.045, (at[0] + dx, at[1] + dy, at[2] + 0.11)) for dx, dy in ((0.04, 0.03), (-0.04, 0.03), (0.0, -0.05)))),
        ]  # fmt: skip
    return [
        _part(WHITE, _disc(0.12, 0.0, 0.02, at)),
        _part((0.80, 0.42, 0.20), _ball(0.055, (at[0], at[1] + 0.02, at[2] + 0.03), squash=0.6)),
        _part(
            (0.35, 0.62, 0.25), _ball(0.04, (at[0] + 0.03, at[1] - 0.05, at[2] + 0.03), squash=0.6)
        ),
    ]


@cache
def table(half_x: float, half_y: float) -> Figure:
    """Returns a table: top at 0.76 m, a cloth, pedestals, and a flower."""
    upright = half_y >= half_x
    long = max(half_x, half_y)
    feet = [0.0] if long < 0.6 else [-(long - 0.4), long - 0.4]
    spots = [(0.0, f) if upright else (f, 0.0) for f in feet]
    foot = min(half_x, half_y) * 0.55
    return (
        _part(WOOD, _block((half_x, half_y, 0.022), (0.0, 0.0, 0.732))),
        _part(LINEN, _block((max(half_x - 0.07, 0.05), max(half_y - 0.07, 0.05), 0.006), (0.0, 0.0, 0.758))),
        _part(_shade(WOOD, 0.75), *(_rod(0.045, 0.0, 0.72, (x, y, 0.0)) for x, y in spots), *(_disc(foot, 0.0, 0.03, (x, y, 0.0)) for x, y in spots)),
        _part((0.82, 0.86, 0.90), _lathe([(0.03, 0.764), (0.04, 0.80), (0.02, 0.86)])),
        _part((0.86, 0.30, 0.38), _ball(0.035, (0.0, 0.0, 0.90))),
    )  # fmt: skip


@cache
def chair() -> Figure:
    """Returns a chair that looks along x."""
    legs = [
        _block((0.018, 0.018, 0.22), (sx * 0.17, sy * 0.17, 0.22))
        for sx in (1, -1)
        for sy in (1, -1)
    ]
    posts = [_block((0.016, 0.018, 0.25), (-0.185, sy * 0.17, 0.68)) for sy in (1, -1)]
    slats = [_block((0.012, 0.17, 0.045), (-0.185, 0.0, z)) for z in (0.66, 0.84)]
    return (
        _part(OAK, _block((0.20, 0.20, 0.02), (0.0, 0.0, 0.45)), *slats),
        _part(_shade(OAK, 0.7), *legs, *posts),
        _part((0.63, 0.22, 0.22), _block((0.165, 0.165, 0.012), (0.005, 0.0, 0.478))),
    )


@cache
def plates(spots: tuple[tuple[float, float], ...]) -> Figure:
    """Plates with food on a table, at these places of the table's frame."""
    return (
        _part(WHITE, *(_disc(0.11, 0.764, 0.778, (x, y, 0.0), 14) for x, y in spots)),
        _part((0.80, 0.42, 0.20), *(_ball(0.05, (x, y, 0.785), squash=0.6) for x, y in spots)),
    )


@cache
def bar(half_x: float, half_y: float) -> Figure:
    """Returns a counter with bottles on it."""
    upright = half_y >= half_x
    long, count = max(half_x, half_y), max(2, min(8, int(max(half_x, half_y) / 0.18)))
    bottles: dict[int, list[_Mesh]] = {0: [], 1: [], 2: []}
    for k in range(count):
        along = (k + 0.5) / count * 1.4 * long - 0.7 * long
        x, y = (-half_x * 0.4, along) if upright else (along, half_y * 0.4)
        bottles[k % 3].append(
            _lathe(
                [(0.035, 1.08), (0.038, 1.24), (0.014, 1.31), (0.014, 1.37), (0.001, 1.371)],
                (x, y, 0.0),
            )
        )
    colours = ((0.25, 0.45, 0.25), (0.62, 0.28, 0.12), (0.65, 0.75, 0.82))
    return (
        _part((0.36, 0.23, 0.15), _block((half_x * 0.92, half_y * 0.95, 0.515), (0.0, 0.0, 0.515))),
        _part((0.16, 0.14, 0.14), _block((half_x, half_y, 0.025), (0.0, 0.0, 1.055))),
        *(_part(colour, *bottles[k]) for k, colour in enumerate(colours) if bottles[k]),
    )  # fmt: skip


@cache
def wall(half_x: float, half_y: float, height: float) -> Figure:
    """Returns a plain wall with a darker top."""
    return (
        _part((0.87, 0.85, 0.81), _block((half_x, half_y, height / 2), (0.0, 0.0, height / 2))),
        _part((0.72, 0.69, 0.64), _block((half_x, half_y, 0.015), (0.0, 0.0, height + 0.015))),
    )


@cache
def slab(half_x: float, half_y: float, colour: Colour = (1.0, 1.0, 1.0)) -> Figure:
    """Returns a floor; its top is at z = 0."""
    return (_part(colour, _block((half_x, half_y, 0.05), (0.0, 0.0, -0.05))),)
