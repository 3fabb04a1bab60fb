"""Exchanges the tables and the order of parties in a plan: `Draft` → slots of the same length.

Entry points `smaller_tables`, `exchanges`, `wider_exchanges`: they yield slots, and whether these are
sure to be legal.  Where nobody moves by a timetable the robot may walk another way for it: the deeds in their
new order are joined by shortest walks, and what comes out longer is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import FAR, WalkDistances, standing
from waiter_cli.model.layout import Table
from waiter_cli.model.plan import Action
from waiter_cli.planning.draft_plan import Draft, Slots, is_deed

__all__ = ["exchanges", "smaller_tables", "wider_exchanges"]


@dataclass(frozen=True)
class _Stop:
    """A deed, or None for a place that must be passed; and the nodes where that can be."""

    deed: Action | None
    nodes: tuple[int, ...]


# -- smaller tables ---------------------------------------------------------------------------


def smaller_tables(draft: Draft) -> Iterator[tuple[Slots, bool]]:
    """Yields the slots with a party at a smaller table that nobody has, where the plan passes or near."""
    if draft.best and not _seats_matter(draft):
        return
    taken = {table for table, _ in draft.problem.state.seated}
    taken |= {a.arguments[2] for a in draft.slots if a is not None and a.name == "seat"}
    free = [table for table in draft.problem.layout.tables if table.name not in taken]
    for j, seat in enumerate(draft.slots):
        if seat is None or seat.name != "seat":
            continue
        party, mine = draft.parties[seat.arguments[1]], draft.tables[seat.arguments[2]]
        smaller = [t for t in free if len(party) <= t.capacity < mine.capacity]
        smaller.sort(key=lambda table: table.capacity)
        for table in smaller:
            if draft.where[j] in table.nodes:
                yield _at_table(draft, j, table.name)
        if smaller and not draft.timed:
            yield from _elsewhere(draft, j, smaller)


def _at_table(draft: Draft, j: int, table: str) -> tuple[Slots, bool]:
    """Returns the slots with another table in the seat at ``j``."""
    seat = draft.slots[j]
    assert seat is not None
    who, mine = seat.arguments[1:]
    sure = draft.may_sit(who, mine) and draft.may_sit(who, table)
    return _renamed(draft.slots, {}, {mine: table}, (j,)), sure


def _elsewhere(draft: Draft, j: int, tables: list[Table]) -> Iterator[tuple[Slots, bool]]:
    """Yields the slots with the seat at ``j`` at another table, at every place in the order it could have."""
    route, deeds = _route(draft), [slot for slot in draft.slots if is_deed(slot)]
    at = sum(map(is_deed, draft.slots[:j]))
    rest = [deed for k, deed in enumerate(deeds) if k != at and deed is not None]
    low = next((k + 1 for k in range(at - 1, -1, -1) if rest[k].name == "pick"), 0)
    high = next((k for k in range(at, len(rest)) if rest[k].name == "pick"), len(rest))
    for table, k in route.detours(rest, low, high, tables):
        slots, sure = _at_table(draft, j, table)
        moved = [slot for slot in slots if is_deed(slot)]
        seat = moved.pop(at)
        moved.insert(k, seat)
        yield from route.walked(moved, sure)


def _seats_matter(draft: Draft) -> bool:
    """Returns whether some party sits at a table with seats to spare."""
    return any(
        len(draft.parties[a.arguments[1]]) < draft.tables[a.arguments[2]].capacity
        for a in draft.slots
        if a is not None and a.name == "seat"
    )


# -- who came first ---------------------------------------------------------------------------


def exchanges(draft: Draft) -> Iterator[tuple[Slots, bool]]:
    """Yields the slots with two parties exchanged of which the later one was picked up before."""
    for _, one, two in _against_arrival(draft):
        names = {one: two, two: one}
        tables = _tables_of(draft.slots, one, two)
        sure = len(tables) == 2 and all(draft.may_sit(n, t) for n in names for t in tables)
        if sure or _room(draft, names, tables):
            yield _renamed(draft.slots, names, {}), sure


def wider_exchanges(draft: Draft) -> Iterator[tuple[Slots, bool]]:
    """Yields the same, where each party keeps its table, or the later one is led to it before."""
    for early, one, two in _against_arrival(draft):
        names = {one: two, two: one}
        tables = _tables_of(draft.slots, one, two)
        if len(tables) < 2:
            continue
        sure = all(map(draft.may_sit, names, tables))
        whole = _renamed(draft.slots, names, dict(zip(tables, reversed(tables))))
        if all(
            a is None or a.name != "seat" or node in draft.tables[a.arguments[2]].nodes
            for a, node in zip(whole, draft.where)
        ):
            yield whole, sure
        if not draft.timed:
            route = _route(draft)
            yield from route.walked([slot for slot in whole if is_deed(slot)], sure)
            yield from route.walked(_before(draft.slots, two, early), sure)


def _against_arrival(draft: Draft) -> Iterator[tuple[int, str, str]]:
    """Yields the step at which a party is picked up, its leader, and one who came before and waits on."""
    picks = [(k, a.arguments[1]) for k, a in enumerate(draft.slots) if a and a.name == "pick"]
    for n, (early, one) in enumerate(picks):
        for _, two in picks[n + 1 :]:
            if draft.rank[two] < draft.rank[one]:
                yield early, one, two


def _tables_of(slots: Slots, *names: str) -> list[str]:
    """Returns the tables to which the slots bring these parties, in their order; less where they do not."""
    tables = {a.arguments[1]: a.arguments[2] for a in slots if a and a.name == "seat"}
    return [tables[name] for name in names if name in tables]


def _room(draft: Draft, names: Iterable[str], tables: list[str]) -> bool:
    """Returns whether every one of the parties has room at every table."""
    most = max(len(draft.parties[name]) for name in names)
    return all(most <= draft.tables[table].capacity for table in tables)


def _before(slots: Slots, name: str, early: int) -> list[Action]:
    """Returns the deeds with a party picked up and seated before the one that is picked up at ``early``."""
    first = slots[early]
    mine = [a for a in slots if a is not None and a.name in ("pick", "seat")]
    mine = [a for a in mine if a.arguments[1] == name]
    table = mine[-1].arguments[2] if mine[-1].name == "seat" else ""
    mine[1:1] = [
        a for a in slots if a is not None and a.name == "bring_chairs" and a.arguments[1] == table
    ]
    deeds = [slot for slot in slots if is_deed(slot) and slot not in mine]
    at = deeds.index(first)
    return [a for a in [*deeds[:at], *mine, *deeds[at:]] if a is not None]


def _renamed(
    slots: Slots, names: dict[str, str], tables: dict[str, str], only: tuple[int, ...] = ()
) -> Slots:
    """Returns the slots with other customers and tables in what leads to a seat."""
    out: Slots = []
    for k, action in enumerate(slots):
        match action.name if action is not None else "":
            case "pick" if names:
                agent, who = action.arguments  # type: ignore[union-attr]
                action = Action(k, "pick", (agent, names.get(who, who)))
            case "seat" if not only or k in only:
                agent, who, table = action.arguments  # type: ignore[union-attr]
                if who in names or only:
                    given = (agent, names.get(who, who), tables.get(table, table))
                    action = Action(k, "seat", given)
            case "bring_chairs" if only:
                agent, table, number = action.arguments  # type: ignore[union-attr]
                action = Action(k, "bring_chairs", (agent, tables.get(table, table), number))
        out.append(action)
    return out


# -- another walk -----------------------------------------------------------------------------


def _route(draft: Draft) -> _Route:
    """Returns the walks of a draft's restaurant, made when they are first asked for."""
    if draft.route is None:
        draft.route = _Route(draft)
    assert isinstance(draft.route, _Route)
    return draft.route


class _Route:
    """Walks through the deeds of a draft in another order, where nobody else moves."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        problem = draft.problem
        self.floor = WalkDistances(problem, standing(problem).fixed.values())
        end = [goal.node for goal in problem.goals if goal.kind == "at"]
        self.end = [_Stop(None, (self.floor.number[node],)) for node in end if node is not None]
        self.nodes: dict[frozenset[str], tuple[int, ...]] = {}
        first = next((g for pair in problem.before for g in pair if g.kind == "at"), None)
        self.closed = first is not None  # places that are passed on the way are not known of

    def walked(self, deeds: Iterable[Action | None], sure: bool) -> Iterator[tuple[Slots, bool]]:
        """Yields the slots that do ``deeds`` in this order, if they are as few as the draft's."""
        if self.closed:
            return
        stops = [*self._stops([deed for deed in deeds if deed is not None]), *self.end]
        self.draft.left -= 1 + len(stops) // 4
        way = self._way(stops, len(self.draft.slots) - sum(s.deed is not None for s in stops))
        if way is None:
            return
        here, names = self.floor.number[self.draft.start], self.floor.names
        slots: Slots = []
        for stop, node in zip(stops, way):
            for k in self.floor.path(here, node):
                slots.append(Action(0, "go_to", ("agent", names[k])))
            if stop.deed is not None:
                slots.append(stop.deed)
            here = node
        yield slots, sure

    def detours(
        self, deeds: list[Action], low: int, high: int, tables: list[Table]
    ) -> Iterator[tuple[str, int]]:
        """Yields tables, and before which of ``deeds`` each can be passed in as many steps.

        Exact, by the least walks up to each deed and from it on.
        """
        stops = [*self._stops(deeds), *self.end]
        at = [k for k, stop in enumerate(stops) if stop.deed is not None] + [
            len(stops) - len(self.end)
        ]
        most = len(self.draft.slots) - len(deeds) - 1
        row = self.floor.row
        ahead: list[dict[int, int]] = [{self.floor.number[self.draft.start]: 0}]
        for stop in stops:
            ahead.append({n: min(c + row(k)[n] for k, c in ahead[-1].items()) for n in stop.nodes})
        after: list[dict[int, int]] = [{}]
        for stop in reversed(stops):
            later = after[-1]
            after.append(
                {n: min((row(n)[k] + c for k, c in later.items()), default=0) for n in stop.nodes}
            )
        after.reverse()
        self.draft.left -= len(stops)
        for table in tables:
            nodes = self._numbers(frozenset(table.nodes))
            for k in sorted(range(low, high + 1), key=lambda k: (k != high, k)):
                i = at[k]
                for n in nodes:
                    there = min(c + row(m)[n] for m, c in ahead[i].items())
                    back = min((row(m)[n] + c for m, c in after[i].items()), default=0)
                    if there + back <= most:
                        yield table.name, k
                        break

    def _stops(self, deeds: list[Action]) -> Iterator[_Stop]:
        """Yields the nodes of each deed, and those of the bar where something is filled on the way."""
        state, bar = self.draft.problem.state, self.draft.bar
        load = state.carrying
        empty = load in state.empty if load is not None else False
        for deed in deeds:
            if deed.name == "bring" and empty:
                yield _Stop(None, self._numbers(bar))
            if deed.name in ("take_up", "refill", "bring"):
                empty = deed.name == "refill"
            yield _Stop(deed, self._numbers(self.draft.places(deed)))

    def _numbers(self, names: frozenset[str]) -> tuple[int, ...]:
        numbers = self.nodes.get(names)
        if numbers is None:
            floor = self.floor
            inside = (floor.number[name] for name in names)
            numbers = self.nodes[names] = tuple(sorted(n for n in inside if n not in floor.shut))
        return numbers

    def _way(self, stops: list[_Stop], most: int) -> list[int] | None:
        """Returns a node for each stop, on a walk of at most so many steps; None: it is longer."""
        layer = {self.floor.number[self.draft.start]: 0}
        came: list[dict[int, int]] = []
        for stop in stops:
            back: dict[int, int] = {}
            following: dict[int, int] = {}
            for node in stop.nodes:
                least, at = min((cost + self.floor.row(k)[node], k) for k, cost in layer.items())
                if least <= most and least < FAR:
                    following[node], back[node] = least, at
            if not following:
                return None
            layer = following
            came.append(back)
        cost, node = min((cost, node) for node, cost in layer.items())
        if cost != most:
            return None
        way = []
        for back in reversed(came):
            way.append(node)
            node = back[node]
        return way[::-1]
