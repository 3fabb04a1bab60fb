"""How what was seen can have come about: belief, observations → explanations.

Entry points `explain`, for a run, and `explain_observations`, for a problem.  The program
``domains/restaurant/diagnosis.sparc`` says what may happen unseen: waiters walk, parties leave, sit
down by themselves, change tables, strangers come in.  Its consistency-restoring rules make the
explanations those with the fewest events.  Somebody who went off the floor and came back elsewhere
explains anything, so that is asked for last.  The robot knows its own walks: seen elsewhere, it was
brought there.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import count
from typing import TYPE_CHECKING, TypeAlias

from waiter_cli.executive import Explanation
from waiter_cli.layout import Layout
from waiter_cli.observing import observe
from waiter_cli.problem import Problem
from waiter_cli.resources import data_folder
from waiter_cli.situation import Observation, Party, State
from waiter_cli.words import people

if TYPE_CHECKING:
    from sparc.source import Source

__all__ = ["explain", "explain_observations"]

MOST = 5
"""So many explanations are given."""
SECONDS = 0.5
"""For each search."""
_SLACK = 2
_MOST_MOMENTS = 40
_PLAUSIBLE = ("walks", "sits_down", "leaves", "changes_to", "comes_in", "is_elsewhere")

Event: TypeAlias = tuple[int, str, tuple[str, ...]]


def explain_observations(problem: Problem) -> tuple[Explanation, ...]:
    """Explanations of a problem's observations by what happened before step 0, best first.

    The steps of their events are negative.  Empty where nothing needs or has an explanation.
    """
    return explain(problem.layout, problem.before_observations, problem.observations, 0, ())


def explain(
    layout: Layout,
    state: State,
    seen: Sequence[Observation],
    step: int,
    trail: Sequence[tuple[int, str]],
) -> tuple[Explanation, ...]:
    """Explanations of what was seen at ``step``, where ``state`` was believed; best first.

    ``trail`` has the agent's places at earlier steps.  Empty where what was seen fits anyway, or
    cannot be explained: somebody enters who is inside, somebody stands where the robot is.
    """
    leaving = [o for o in seen if o.kind == "leave"]
    state, objections = observe(state, leaving, layout)
    if objections:
        return ()
    case = _case(layout, state, [o for o in seen if o.kind != "leave"], step, trail)
    if case is None:
        return ()
    for walkers, elsewhere in case.suspicions():
        found = _solve(case, walkers, elsewhere)
        if found:
            return tuple(_explanations(case, found))[:MOST]
    return ()


@dataclass(frozen=True)
class _Case:
    """What is to be explained: who was seen where, and which tables were seen free or taken."""

    layout: Layout
    state: State
    seen: tuple[Observation, ...]
    step: int
    trail: tuple[tuple[int, str], ...]
    at: tuple[tuple[str, str], ...]
    free: tuple[str, ...]
    taken: tuple[str, ...]
    strangers: tuple[tuple[str, str], ...]
    """For each taken table the name of somebody who may have come in."""

    def staff(self) -> dict[str, str]:
        """Where everybody is believed to stand."""
        return {"agent": self.state.agent, **dict(self.state.waiters)}

    def suspicions(self) -> Iterator[tuple[frozenset[str], bool]]:
        """Who may have walked, and whether people may have been off the floor; likeliest first."""
        believed, seen = self.staff(), dict(self.at)
        shut = set(seen.values())
        concerned = {who for who, node in believed.items() if seen.get(who, node) != node}
        concerned |= {who for who, node in believed.items() if node in shut and who not in seen}
        concerned.discard("agent")
        everybody = set(believed) - {"agent"}
        yield frozenset(concerned), False
        if concerned < everybody:
            yield frozenset(everybody), False
        if seen:
            yield frozenset(everybody), True


def _case(
    layout: Layout,
    state: State,
    seen: Sequence[Observation],
    step: int,
    trail: Sequence[tuple[int, str]],
) -> _Case | None:
    """What needs an explanation; None when nothing does, or two things were seen of one."""
    believed = {"agent": state.agent, **dict(state.waiters)}
    at: dict[str, str] = {}
    for o in seen:
        if o.kind == "at" and at.setdefault(o.arguments[0], o.arguments[1]) != o.arguments[1]:
            return None
    if any(who not in believed for who in at):
        return None
    sitting = dict(state.seated)
    free = dict.fromkeys(o.arguments[0] for o in seen if o.kind == "free")
    taken = dict.fromkeys(o.arguments[0] for o in seen if o.kind == "order")
    surprises = [who for who, node in at.items() if believed[who] != node]
    surprises += [table for table in free if table in sitting]
    surprises += [table for table in taken if table not in sitting]
    if not surprises:
        return None
    names = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    names |= {name for party in state.parties() for name in party} | set(believed)
    names |= {name for o in seen if o.kind == "enter" for name in o.arguments} | {*layout.objects}
    fresh = (name for n in count(1) if (name := f"stranger{n}") not in names)
    unknown = tuple((table, next(fresh)) for table in taken if table not in sitting)
    return _Case(
        layout,
        state,
        tuple(seen),
        step,
        tuple(trail),
        tuple(at.items()),
        tuple(table for table in free if table in sitting),
        tuple(table for table, _ in unknown),
        unknown,
    )


# -- the program ----------------------------------------------------------------------------


@cache
def _template() -> Source:
    from sparc.source import Source

    path = os.path.join(data_folder("domains"), "restaurant", "diagnosis.sparc")
    with open(path, encoding="utf-8") as file:
        return Source("domains/restaurant/diagnosis.sparc", file.read())


def _program(slots: dict[str, list[str]]) -> Source:
    """The program with its slots filled; lines keep the numbers they have in the file."""
    from sparc.source import Origin, Source

    template = _template()
    lines: list[str] = []
    origins: list[Origin | None] = []
    slot = False
    for number, text in enumerate(template.text.split("\n"), 1):
        mark = text.strip()
        if mark.startswith("%{"):
            slot = True
            lines += slots[mark[2:].strip()]
            origins += [Origin(template.name, number)] * (len(lines) - len(origins))
        elif mark == "%}":
            slot = False
        elif not slot:
            lines.append(text)
            origins.append(Origin(template.name, number))
    return Source(template.name, "\n".join(lines), 1, tuple(origins))


def _slots(case: _Case, walkers: Collection[str], elsewhere: bool) -> dict[str, list[str]]:
    state, layout = case.state, case.layout
    moments = _moments(case, walkers)
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


def _moments(case: _Case, walkers: Collection[str]) -> int:
    """How far to look back: as long as the longest walk, and a little for making way."""
    near = case.layout.neighbours()
    believed = case.staff()
    longest = 0
    for who, node in case.at:
        if who == "agent":
            continue
        distance = {believed[who]: 0}
        queue = deque(distance)
        while queue and node not in distance:
            here = queue.popleft()
            for there in near[here]:
                if there not in distance:
                    distance[there] = distance[here] + 1
                    queue.append(there)
        longest = max(longest, distance.get(node, 0))
    return min(longest + _SLACK if len(walkers) > 1 else max(longest, 1), _MOST_MOMENTS)


def _places_of_agent(case: _Case, moments: int) -> list[str]:
    """Where the robot was, as far back as the places of the others are known."""
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


def _solve(
    case: _Case, walkers: Collection[str], elsewhere: bool
) -> list[tuple[tuple[Event, ...], int]]:
    """The sets of events that explain the case, with their number; empty when there is none."""
    from sparc import solve

    slots = _slots(case, walkers, elsewhere)
    moments = int(slots["moments"][0].rsplit(".", 2)[1])
    found: dict[tuple[Event, ...], int] = {}
    for answer_set in solve(_program(slots), models=4 * MOST, time_limit=SECONDS):
        events = []
        for literal in answer_set.literals:
            if literal.name == "happens" and not literal.negated:
                event, moment = literal.arguments
                step = case.step - moments + int(str(moment))
                events.append((step, event.name, tuple(map(str, event.arguments))))  # type: ignore[union-attr]
        found[tuple(sorted(events))] = len(events)
    return sorted(
        found.items(),
        key=lambda item: (item[1], sum(_PLAUSIBLE.index(name) for _, name, _ in item[0]), item[0]),
    )


# -- what is believed then ------------------------------------------------------------------


def _explanations(
    case: _Case, found: Sequence[tuple[tuple[Event, ...], int]]
) -> Iterator[Explanation]:
    """Those after which what was seen can be."""
    for events, cost in found:
        state = case.state
        texts = []
        for _, name, arguments in events:
            texts.append(_in_words(name, arguments, state))
            state = _believe(state, name, arguments, case.layout)
        after, objections = observe(state, case.seen, case.layout)
        if not objections:
            yield Explanation(events, tuple(texts), cost, after)


def _in_words(name: str, arguments: tuple[str, ...], state: State) -> str:
    who, *where = arguments
    party = people(state.party_of(who) or (who,))
    match name:
        case "walks":
            staff = {"agent": state.agent, **dict(state.waiters)}
            return f"{who} walked from {staff[who]} to {where[0]}"
        case "is_elsewhere" if who == "agent":
            return f"the robot was brought from {state.agent} to {where[0]}"
        case "is_elsewhere":
            return f"{who} went off the floor and came back at {where[0]}"
        case "leaves":
            return f"{party} left {state.table_of(who)}"
        case "sits_down":
            return f"{party} sat down at {where[0]} without being led there"
        case "changes_to":
            return f"{party} changed from {state.table_of(who)} to {where[0]}"
    return f"somebody came in and sat down at {where[0]}, called {who} here"


def _believe(state: State, name: str, arguments: tuple[str, ...], layout: Layout) -> State:
    """The state after one event."""
    who = arguments[0]
    if name in ("walks", "is_elsewhere"):
        if who == "agent":
            return replace(state, agent=arguments[1])
        moved = tuple(sorted((dict(state.waiters) | {who: arguments[1]}).items()))
        return replace(state, waiters=moved)
    party: Party = state.party_of(who) or (who,)
    paid = state.table_of(who) in state.paid
    if name in ("leaves", "changes_to"):
        state, _ = observe(state, [Observation("leave", (who,))], layout)
    if name == "leaves":
        return state
    table = arguments[1]
    return replace(
        state,
        waiting=tuple(other for other in state.waiting if other != party),
        seated=tuple(sorted((*state.seated, (table, party)))),
        paid=state.paid | {table} if paid else state.paid - {table},
    )
