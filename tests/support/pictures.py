"""Pictures of a room as tests ask for them."""

from __future__ import annotations

from typing import Any

import pytest

from waiter_cli.pictures.snapshot import Figurine, Snapshot
from waiter_cli.room.room import Room

__all__ = ["VIEWS", "moment", "scene"]

VIEWS = ["2d", pytest.param("3d", marks=pytest.mark.sim)]


def moment(room: Room, robot: str, *guests: str) -> Snapshot:
    """The robot on a node, facing up, and guests on others."""
    figures = tuple(
        Figurine(node, "guest", k, *room.nodes[node], 1.6, "stand", False, 0)
        for k, node in enumerate(guests)
    )
    chairs = tuple((table.name, table.chairs) for table in room.layout.tables)
    x, y = room.nodes[robot]
    return Snapshot("", 0.0, (x, y, 1.6), None, figures, chairs, (), (), "", (), 0)


def scene(view: str, room: Room) -> Any:
    pytest.importorskip("PIL")
    pytest.importorskip("numpy")
    if view == "2d":
        from waiter_cli.pictures.scene2d import Scene2D

        return Scene2D(room, 600, 450, 1)
    pytest.importorskip("pybullet")
    from waiter_cli.pictures.scene3d import Scene3D

    return Scene3D(room, 600, 450, 1)
