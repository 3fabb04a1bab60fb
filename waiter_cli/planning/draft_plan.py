"""A plan that is being changed: its slots, the robot's node at each, and its worth.

Entry points: `Draft`, and `clash`, which says of two deeds whether their order matters.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from functools import cache
from math import dist
from typing import TypeAlias

from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Party, State
from waiter_cli.rules.actions import holds
from waiter_cli.rules.validator import run

__all__ = ["Draft", "Slots", "clash", "is_deed"]

Slots: TypeAlias = list[Action | None]
"""One entry a step, None for an idle one; the steps that the actions name count for nothing."""


_AT_SEATED = ("give_bill", "take_order", "bring_chairs")


def is_deed(action: Action | None) -> bool:
    """Returns whether something is done that is no walking."""
    return action is not None and action.name != "go_to"


def _plan(slots: Slots) -> Plan:
    actions = (Action(k, a.name, a.arguments) for k, a in enumerate(slots) if a is not None)
    return Plan(tuple(actions), len(slots))


@cache
def _touches(
    name: str, arguments: tuple[str, ...], instant: bool
) -> tuple[frozenset[Hashable], frozenset[Hashable]]:
    """Returns what a deed changes, and what it depends on without changing it."""
    last = arguments[-1]
    changed: tuple[Hashable, ...]
    needed: tuple[Hashable, ...] = ()
    match name:
        case "pick":
            changed = ("lead", ("party", last))
        case "seat":
            changed = ("lead", ("party", arguments[1]), ("sit", last))
            needed = (("chairs", last),)
        case "give_bill":
            changed, needed = (("bill", last),), (("sit", last),)
        case "take_order":
            changed, needed = (("order", last), ("served", last)), (("sit", last),)
        case "send_order":
            changed = (("order", last), *((("thing", "plate", last),) if instant else ()))
        case "bring_chairs":
            changed = (("chairs", arguments[1]),)
        case _:
            changed = ("hands", ("thing", *arguments[1:]))
            if name == "bring" and arguments[1] == "plate":
                changed = (*changed, ("served", last))
    return frozenset(changed), frozenset(needed)


def clash(deed: Action, other: Action, instant: bool, leaving_out: str = "") -> bool:
    """Returns whether the order of two deeds matters for what they change and depend on.

    ``leaving_out`` is ``hands`` or ``lead`` where these are looked after otherwise.
    """
    mine, asked = _touches(deed.name, deed.arguments, instant)
    theirs, wanted = _touches(other.name, other.arguments, instant)
    shared = (mine & theirs) | (mine & wanted) | (asked & theirs)
    return bool(shared - {leaving_out})


class Draft:
    """A plan in the making, which is only ever exchanged for a better one.

    ``careful`` has every change executed before it is taken; else only those that are not sure.
    """

    def __init__(
        self,
        problem: Problem,
        plan: Plan,
        prefer: tuple[str, ...],
        work: int,
        *,
        careful: bool = False,
    ) -> None:
        self.problem, self.prefer, self.left = problem, prefer, work
        layout, self.start = problem.layout, problem.state.agent
        self.instant = problem.instant_kitchen
        self.tables = {table.name: table for table in layout.tables}
        self.bar = frozenset(layout.bar.nodes if layout.bar is not None else ())
        self.entrance = frozenset((layout.entrance,))
        self.rank = {name: k for k, p in enumerate(problem.state.waiting) for name in p}
        self.parties: dict[str, Party] = {
            name: party for party in problem.state.parties() for name in party
        }
        self.original = plan
        self.slots: Slots = [None] * plan.horizon
        for action in plan.actions:
            self.slots[action.step] = action
        self.timed = bool(layout.timetable) or None in self.slots
        self.careful = (
            careful
            or self.timed
            or bool(problem.before)
            or not {"earliest", "longest_waiting"}.isdisjoint(prefer)
        )
        self.route: object = None  # kept for `exchanging`
        self.bound = self._bound_tables()
        self.chairs = dict(problem.state.chairs)
        self.checked = True  # the slots were executed, or are those of the plan given
        self.where = self.walk(self.slots)
        states = run(problem, plan).states if "earliest" in prefer else ()
        self.best = self.worth(self.slots, states)

    def plan(self) -> Plan:
        """Returns the slots as a plan."""
        made = _plan(self.slots)
        return self.original if made == self.original else made

    # -- changes ------------------------------------------------------------------------------

    def take(self, slots: Slots, sure: bool) -> bool:
        """Takes ``slots`` if they are better and legal, which ``sure`` says beforehand."""
        self.left -= 2
        states: Sequence[State] = ()
        if "earliest" not in self.prefer and self.worth(slots) >= self.best:
            return False
        if self.careful or not sure:
            self.left -= len(slots)
            verdict = self.judged(slots)
            if verdict is None:
                return False
            states = verdict
        worth = self.worth(slots, states)
        if worth >= self.best:
            return False
        self.slots, self.best, self.where = slots, worth, self.walk(slots)
        self.checked = self.careful
        return True

    def valid(self, slots: Slots) -> bool:
        """Returns whether the slots are legal and as good as the plan: by executing them."""
        return self.judged(slots) is not None

    def judged(self, slots: Slots) -> tuple[State, ...] | None:
        """Returns the states that the slots pass through, None when they are not legal."""
        verdict = run(self.problem, _plan(slots))
        if not verdict.valid or verdict.makespan != len(slots):
            return None
        return verdict.states

    def may_sit(self, name: str, table: str) -> bool:
        """Returns whether it surely makes no difference to the rest if a party sits at a certain table.

        That is so where it fits, is wanted at no table in particular, and nothing else in the plan
        or in the goals depends on who sits there.
        """
        party, place = self.parties[name], self.tables[table]
        if table in self.bound or len(party) > min(
            place.capacity, self.chairs.get(table, place.chairs)
        ):
            return False
        return not any(
            (goal.kind != "seated" or goal.table is not None) and set(goal.party) & set(party)
            for goal in self.problem.goals
        )

    def _bound_tables(self) -> set[str]:
        """Returns the tables at which something depends on who sits there, or on somebody sitting."""
        deeds = [a for a in self.slots if a is not None and a.name in _AT_SEATED]
        bound = {a.arguments[1] if a.name == "bring_chairs" else a.arguments[-1] for a in deeds}
        pairs = (goal for pair in self.problem.before for goal in pair)
        return bound | {goal.table for goal in (*self.problem.goals, *pairs) if goal.table}

    # -- what a plan is worth -----------------------------------------------------------------

    def worth(self, slots: Slots, states: Sequence[State] = ()) -> tuple[tuple[int, ...], ...]:
        """Returns what is minimized: the preferences, then seats, order of arrival, steps of deeds."""
        seats, ranks, deeds = 0, [], 0
        for step, action in enumerate(slots):
            if action is None or action.name == "go_to":
                continue
            deeds += step
            if action.name == "seat":
                seats += self.tables[action.arguments[2]].capacity
            elif action.name == "pick":
                ranks.append(self.rank[action.arguments[1]])
        usual = ((seats,), tuple(ranks), (deeds,))
        return (*(self._asked(name, slots, seats, states) for name in self.prefer), *usual)

    def _asked(
        self, name: str, slots: Slots, seats: int, states: Sequence[State]
    ) -> tuple[int, ...]:
        """Returns the cost of one preference, as `preferences` has it."""
        match name:
            case "smallest_table":
                return (seats,)
            case "shortest_walk":
                return (sum(map(self._length, [self.start, *self._nodes(slots)],
                                self._nodes(slots))),)  # fmt: skip
            case "longest_waiting":
                picked = {
                    self.rank[a.arguments[1]]: step
                    for step, a in enumerate(slots)
                    if a is not None and a.name == "pick"
                }
                return tuple(picked.get(k, 0) for k in range(len(self.problem.state.waiting)))
        return (sum(not holds(g, s, self.problem) for s in states for g in self.problem.goals),)

    def _nodes(self, slots: Slots) -> list[str]:
        return [a.arguments[1] for a in slots if a is not None and a.name == "go_to"]

    def _length(self, a: str, b: str) -> int:
        start, end = self.problem.layout.node(a).at, self.problem.layout.node(b).at
        return 1000 if start is None or end is None else round(1000 * dist(start, end))

    # -- places and hands ---------------------------------------------------------------------

    def walk(self, slots: Slots) -> list[str]:
        """Returns the robot's node at each step, the last one included."""
        where = [self.start]
        for action in slots:
            walks = action is not None and action.name == "go_to"
            where.append(action.arguments[1] if walks and action is not None else where[-1])
        return where

    def places(self, deed: Action) -> frozenset[str]:
        """Returns the nodes at which a deed can be done."""
        match deed.name:
            case "pick":
                return self.entrance
            case "send_order" | "take_up":
                return self.bar
            case "bring_chairs":
                return frozenset(self.tables[deed.arguments[1]].nodes)
        return frozenset(self.tables[deed.arguments[-1]].nodes)

    def filled_from(self, slots: Slots, where: list[str], j: int) -> int:
        """Returns the first step at which what is brought at step ``j`` can be full."""
        deed = slots[j]
        assert deed is not None
        if deed.name != "bring":
            return 0
        item, table = deed.arguments[1:]
        for k in range(j - 1, -1, -1):
            begun = slots[k]
            if begun is not None and begun.arguments[1:] == (item, table):
                if begun.name == "take_up":
                    return k + 1
                if begun.name == "refill":
                    return next(i for i in range(k + 1, j + 1) if where[i] in self.bar)
        if (table, item) in self.problem.state.empty:
            return next((i for i in range(j + 1) if where[i] in self.bar), 0)
        return 0

    def free_spells(self, slots: Slots, kind: str) -> list[tuple[int, int]]:
        """Returns the stretches in which hands are free (``hands``), or nobody follows (``lead``)."""
        begins, ends = (("pick",), "seat") if kind == "lead" else (("take_up", "refill"), "bring")
        state = self.problem.state
        busy = bool(state.with_agent) if kind == "lead" else state.carrying is not None
        spells = []
        start: int | None = None if busy else 0
        for k, slot in enumerate(slots):
            if slot is not None and slot.name in begins and start is not None:
                spells.append((start, k))
                start = None
            elif slot is not None and slot.name == ends:
                start = k + 1
        if start is not None:
            spells.append((start, len(slots)))
        return spells
