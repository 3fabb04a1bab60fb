"""A case for diagnosis → a SPARC program. Entry point `program_of`.

The facts are those that matter: where everybody stands, which tables were a surprise, and who may
have sat down there.  A program looks back as many moments as the longest walk takes.
"""

from __future__ import annotations

import os
from collections.abc import Collection
from functools import cache
from typing import TYPE_CHECKING

from waiter_cli.diagnosis.case import Surprise
from waiter_cli.file_access.locate import data_folder
from waiter_cli.model.graph import distances

if TYPE_CHECKING:
    from sparc.source import Source

__all__ = ["program_of"]

_SLACK = 2
_MOST_MOMENTS = 40


@cache
def _template() -> Source:
    from sparc.source import Source

    path = os.path.join(data_folder("domains"), "restaurant", "diagnosis.sparc")
    with open(path, encoding="utf-8") as file:
        return Source("domains/restaurant/diagnosis.sparc", file.read())


def _fill(slots: dict[str, list[str]]) -> Source:
    """Returns the program with its slots filled; lines keep the numbers they have in the file."""
    from waiter_cli.encoding.facts import ProgramLine
    from waiter_cli.encoding.template import fill_pieces, read_template

    template = _template()
    pieces = read_template(template, frozenset(slots))
    return fill_pieces(template.name, pieces, lambda name: map(ProgramLine, slots[name]))


def program_of(case: Surprise, walkers: Collection[str], elsewhere: bool) -> tuple[Source, int]:
    """Returns the program, and the number of moments before the observation."""
    moments, walks = _walks(case, walkers)
    slots = _slots(case, walkers, elsewhere, moments)
    slots["facts"] += walks
    return _fill(slots), moments


def _slots(
    case: Surprise, walkers: Collection[str], elsewhere: bool, moments: int
) -> dict[str, list[str]]:
    """Returns the lines for each slot of the program."""
    state, layout = case.state, case.layout
    sitting = dict(state.seated)
    leaving = {table: sitting[table][0] for table in case.free}
    capacity = {table.name: table.capacity for table in layout.tables}
    chairs = dict(state.chairs)
    facts = [f"edge({a}, {b})." for a, b in layout.edges]
    facts += [f"may_walk({who})." for who in sorted(walkers)]
    facts += [f"may_be_elsewhere({who})." for who, _ in case.at if elsewhere or who == "agent"]
    facts += [f"holds(sits({name}, {table}), 0)." for table, name in leaving.items()]
    facts += [f"holds(waits({party[0]}), 0)." for party in state.waiting]
    for table in case.taken:
        room = min(capacity[table], chairs.get(table, capacity[table]))
        fitting = [
            p for p in (*state.waiting, *map(sitting.get, case.free)) if p and len(p) <= room
        ]
        facts += [f"fits({party[0]}, {table})." for party in fitting]
        facts.append(f"seen_taken({table}).")
    for table, name in case.strangers:
        facts += [f"is_stranger({name}).", f"fits({name}, {table})."]
    facts += [f"seen_at({who}, {node})." for who, node in case.at]
    facts += [f"seen_free({table})." for table in case.free]
    facts.append(f"last({moments}).")
    facts += [f"holds(stands({who}, {node}), 0)." for who, node in state.waiters]
    facts += _places_of_agent(case, moments)
    parties = [party[0] for party in state.waiting] + list(leaving.values())
    parties += [name for _, name in case.strangers]
    return {
        "moments": [f"#moment = 0..{moments}."],
        "nodes": [f"#node = {{{', '.join(node.name for node in layout.nodes)}}}."],
        "tables": [f"#table = {{{', '.join(table.name for table in layout.tables)}}}."],
        "employees": [f"#employee = {{{', '.join(case.staff())}}}."],
        "parties": [f"#party = {{{', '.join(parties or ['nobody'])}}}."],
        "facts": facts,
    }


def _walks(case: Surprise, walkers: Collection[str]) -> tuple[int, list[str]]:
    """Returns how far to look back, and facts on where somebody may have walked.

    Somebody who was seen somewhere came there by about the shortest way round those who stand still;
    whoever made way for him is not far.
    """
    believed, seen = case.staff(), dict(case.at)
    still = {node for who, node in believed.items() if who not in walkers and who not in seen}
    slack = _SLACK if len(walkers) > 1 else 0
    moments, ways, graph = 1, [], case.layout.joined()
    for who in sorted(walkers):
        start, end = believed[who], seen.get(who)
        shut = still - {start, end}
        there = distances(graph, start, shut)
        if end is not None and end not in there:
            there, shut = distances(graph, start), set()
        if end is None:
            near = {node: steps for node, steps in there.items() if steps <= _SLACK}
            ways.append((who, near, dict.fromkeys(near, 0)))
            continue
        ways.append((who, there, distances(graph, end, shut)))
        moments = max(moments, min(there.get(end, 0) + slack, _MOST_MOMENTS))
    facts = [
        f"along({who}, {node}, {moment})."
        for who, there, back in ways
        for node, steps in there.items()
        if node in back
        for moment in range(steps, moments - back[node] + 1)
    ]
    return moments, facts


def _places_of_agent(case: Surprise, moments: int) -> list[str]:
    """Returns facts on where the robot was, as far back as the places of the others are known."""
    place = case.state.agent
    if dict(case.at).get("agent", place) != place:
        return [f"holds(stands(agent, {place}), 0)."]
    places = [place]
    trail = dict(case.trail)
    posts = {node for _, node in case.state.waiters}
    for back in range(1, moments + 1):
        earlier = trail.get(case.step - back)
        if earlier is not None and earlier not in posts and place == places[-1]:
            place = earlier
        elif earlier is not None and earlier in posts:
            trail = {}
        places.append(place)
    facts = []
    for moment, node in enumerate(reversed(places)):
        facts.append(f"holds(stands(agent, {node}), {moment}).")
        if moment and (before := places[moments - moment + 1]) != node:
            facts.append(f"-holds(stands(agent, {before}), {moment}).")
    return facts
