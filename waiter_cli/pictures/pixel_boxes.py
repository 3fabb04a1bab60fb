"""Rectangles of pixels: overlaps, intersections, and the parts to draw anew.

A `Window` is (left, top, right, bottom) in pixels, the last two not within it.
"""

from __future__ import annotations

from typing import TypeAlias

__all__ = ["Window", "common", "cut", "meet", "merged"]

Window: TypeAlias = tuple[int, int, int, int]
Part: TypeAlias = tuple[slice, slice]
"""Rows and columns of a picture."""


def meet(a: Window, b: Window) -> bool:
    """Returns whether two windows have a pixel in common."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def cut(a: Window, b: Window) -> Window:
    """Returns the intersection of two windows."""
    return max(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3])


def common(theirs: Window, window: Window, k: int) -> tuple[Part, Part]:
    """Returns the intersection of two windows as slices of the fine picture of
    ``window`` and of ``theirs``.
    """
    left, top = max(theirs[0], window[0]), max(theirs[1], window[1])
    right, bottom = min(theirs[2], window[2]), min(theirs[3], window[3])

    def part(of: Window) -> Part:
        return (
            slice((top - of[1]) * k, (bottom - of[1]) * k),
            slice((left - of[0]) * k, (right - of[0]) * k),
        )

    return part(window), part(theirs)


def merged(windows: list[Window]) -> list[Window]:
    """Windows that cover the same pixels, none of which overlap."""
    left = list(dict.fromkeys(windows))
    changed = True
    while changed:
        changed = False
        for i in range(len(left)):
            for j in range(i + 1, len(left)):
                if meet(left[i], left[j]):
                    a, b = left[i], left.pop(j)
                    left[i] = (min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3]))
                    changed = True
                    break
            if changed:
                break
    return left
