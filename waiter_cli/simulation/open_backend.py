"""Opens the backend that measures clearances."""

from __future__ import annotations

from waiter_cli.simulation.clearance import Backend, Geometric

__all__ = ["open_backend"]


def open_backend(wanted: str, drive: str = "kinematic") -> Backend:
    """Returns the backend called ``wanted``: ``auto`` takes PyBullet where it is there.

    Raises `MissingError` where PyBullet is asked for, by name or by ``--drive physics``, and missing.
    """
    if wanted == "geometric" and drive == "kinematic":
        return Geometric()
    from importlib.util import find_spec

    there = find_spec("pybullet") is not None and find_spec("numpy") is not None
    if wanted == "auto" and drive == "kinematic" and not there:
        return Geometric()
    from waiter_cli.simulation.bullet import Bullet

    return Bullet(physics=drive == "physics")
