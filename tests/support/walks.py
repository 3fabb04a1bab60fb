"""Restaurants full of people with a long walk through them, made by chance: what drawings find hard."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from waiter_cli.drawing.subject import DrawnAction, Leg, Subject, make_subject
from waiter_cli.layout_tools.generate_floor import build_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import State

__all__ = ["busy"]


def busy(
    seed: int,
    *,
    nodes: int = 16,
    tables: int = 6,
    walk: int = 20,
    guests: int = 6,
    layout: Layout | None = None,
) -> Subject:
    """A layout in which guests wait and sit, and a walk of so many steps with a deed now and then."""
    rng = Random(seed)
    layout = layout or build_layout(
        seed, nodes, tables, bar=bool(seed % 2), waiters=seed % 3, handsome=bool(seed % 5)
    )
    first = layout.tables[0]
    state = State(
        layout.agent,
        layout.waiters,
        seated=((first.name, tuple(f"c{k}" for k in range(21, 21 + first.capacity))),),
        waiting=tuple((f"c{k}",) for k in range(1, guests + 1)),
        wants_bill=frozenset([first.name]),
        chairs=tuple((table.name, table.chairs) for table in layout.tables),
    )
    near, here = layout.neighbours(), layout.agent
    legs, deeds = [], []
    for step in range(walk):
        if step % 5 == 4:
            deeds.append(DrawnAction(step, here, f"seat c{step}"))
            continue
        there = rng.choice(sorted(near[here]))
        legs.append(Leg(step, here, there))
        here = there
    listing = ((f"0-{walk}", f"walk {' → '.join([layout.agent, *(leg.end for leg in legs)])}"),)
    subject = make_subject(layout, state)
    return replace(subject, legs=tuple(legs), deeds=tuple(deeds), listing=listing if legs else ())
