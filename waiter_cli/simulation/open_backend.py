"""Opens the backend that measures clearances."""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.simulation.clearance import Backend, Geometric

__all__ = ["open_backend"]


def open_backend(wanted: str, drive: str = "kinematic", robots: Sequence[str] = ()) -> Backend:
    """Returns the backend called ``wanted``: ``auto`` takes PyBullet where it is there.

    ``robots`` are the names of several.

    Raises `MissingError` where PyBullet is asked for, by name or by ``--drive physics``, and missing.
    """
    if wanted == "geometric" and drive == "kinematic":
        return Geometric()
    from importlib.util import find_spec

    there = find_spec("pybullet") is not None and find_spec("numpy") is not None
    if wanted == "auto" and drive == "kinematic" and not there:
        return Geometric()
    if robots and drive == "physics":
        from waiter_cli.simulation.fleet.fleet_bullet import FleetBullet

        return FleetBullet(robots)
    from waiter_cli.simulation.bullet import Bullet

    return Bullet(physics=drive == "physics")
