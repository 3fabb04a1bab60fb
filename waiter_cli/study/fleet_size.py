"""Gives a layout another number of robots. Entry point `with_fleet_size`."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout

__all__ = ["with_fleet_size"]


def with_fleet_size(layout: Layout, number: int) -> Layout:
    """Returns the layout with so many robots.

    Those that it has stay where they are, as far as they are wanted; further ones stand as near to the
    first as they can: where nobody works or comes in, and where a robot can get to.  Raises
    `InputError` where there are too few such places.
    """
    robots = layout.agents or (("agent", layout.agent),)
    if number == 1:
        return replace(layout, agents=()) if layout.agents else layout
    kept = list(robots[:number])
    if not layout.agents:
        kept = [("r1", layout.agent)]
    taken = {place for _, place in kept}
    free = [node for node in _places(layout) if node not in taken]
    names = {name for name, _ in kept}
    fresh = (name for k in range(1, 2 * number + 1) if (name := f"r{k}") not in names)
    if len(kept) + len(free) < number:
        where = Where(layout.file or layout.name)
        told = f"there are places for {len(kept) + len(free)} robots, not for {number}"
        raise InputError([Fault(where, told, "ask for fewer robots, or list agents yourself")])
    kept += list(zip(fresh, free[: number - len(kept)]))
    return replace(layout, agents=tuple(kept), agent=kept[0][1])


def _places(layout: Layout) -> list[str]:
    """Returns the nodes at which a robot may begin, the best ones first."""
    posts = {node for _, node in layout.waiters} | {node for _, _, node in layout.timetable}
    busy = {node for table in layout.tables for node in table.nodes} | {layout.entrance}
    busy |= set(layout.bar.nodes) if layout.bar else set()
    near = layout.neighbours()
    seen, todo = {layout.agent}, deque([layout.agent])
    while todo:
        for node in near[todo.popleft()]:
            if node not in seen and node not in posts:
                seen.add(node)
                todo.append(node)
    order = [node for node in _by_distance(layout) if node in seen and node != layout.entrance]
    return sorted(order, key=lambda node: node in busy)


def _by_distance(layout: Layout) -> list[str]:
    """Returns all nodes by their distance from the first robot's, in steps."""
    near = layout.neighbours()
    order, todo = [layout.agent], deque([layout.agent])
    seen = {layout.agent}
    while todo:
        for node in near[todo.popleft()]:
            if node not in seen:
                seen.add(node)
                order.append(node)
                todo.append(node)
    return order
