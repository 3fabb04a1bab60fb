"""Turns a plan for several robots into an order of precedence: plan → `Precedence`. Entry point `order_of`.

Robots do not march in step.  What matters of a plan is only who must have left a place before who comes
to it, and whose deed at a table, or with a party, comes first.  So each action has a set of *claims*: the nodes
that it leaves and enters, the tables and parties that it deals with.  An action waits for every earlier
one of another robot that shares a claim with it, and for the robot's own one before it.  Whatever keeps to
this order can be put back into steps, so it ends as the plan does; and since nothing waits for a later
step, somebody can always go on.

Source: the action dependency graph of Hönig, Kiesel, Tinka, Durham and Ayanian, "Persistent and Robust
Execution of MAPF Schedules in Warehouses" (2019), with deeds beside walks.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.state import State

__all__ = ["Precedence", "order_of", "robot_of"]

Claim = tuple[str, str]
"""A kind (``node``, ``table``, ``party``) and a name."""


def robot_of(action: Action) -> str:
    """Returns the robot that does an action."""
    return action.arguments[0]


@dataclass(frozen=True)
class Precedence:
    """The actions of several robots in an order of precedence.

    ``actions`` are sorted by step, those that run first.  ``waits`` says for each which others must be over
    before it begins.  Actions of one group begin once none of them has to wait for anything else, and have
    their effect together: deeds at one table in one step, and rings of robots, each of which
    enters the node that the next one leaves.
    """

    actions: tuple[Action, ...]
    waits: Mapping[Action, frozenset[Action]]
    groups: Mapping[Action, tuple[Action, ...]]

    def ready(self, running: Iterable[Action] = ()) -> tuple[Action, ...]:
        """Returns what may begin now; what is ``running`` has begun."""
        begun = set(running)
        return tuple(a for a in self.actions if a not in begun and not self.waits[a])

    def levelled(self) -> Plan:
        """Returns a plan in steps that keeps to this order, as short as that can be; steps from 0."""
        level: dict[Action, int] = {}
        left = list(self.actions)
        while left:
            for action in left:
                group = self.groups[action]
                waits = self.waits[action]  # the same for all of a group
                if all(other in level for other in waits):
                    at = max((level[other] + _apart(other, group) for other in waits), default=0)
                    level.update(dict.fromkeys(group, at))
            left = [action for action in left if action not in level]
        actions = sorted(self.actions, key=lambda a: level[a])
        placed = tuple(replace(action, step=level[action]) for action in actions)
        return Plan(placed, 1 + max(level.values(), default=-1))


def _apart(other: Action, group: Sequence[Action]) -> int:
    """Returns the steps by which a group comes after another action: none to a node just left."""
    if other.name != "go_to" or any(robot_of(each) == robot_of(other) for each in group):
        return 1
    into = other.arguments[1]
    return int(any(each.name != "go_to" or each.arguments[1] == into for each in group))


def order_of(
    actions: Sequence[Action], state: State, layout: Layout, running: Sequence[Action] = ()
) -> Precedence:
    """Returns the order of a plan's actions, sorted by step, which are all still to be done.

    In ``state`` each robot stands where it begins what is ``running`` or its first action.
    """
    rest = [action for action in actions if action not in running]
    ordered = [*running, *sorted(rest, key=lambda action: action.step)]
    claims, left = _claims(ordered, state, layout)
    waits: dict[Action, set[Action]] = {action: set() for action in ordered}
    mates: dict[Action, set[Action]] = {action: {action} for action in ordered}
    for k, later in enumerate(ordered):
        for earlier in ordered[:k]:
            if robot_of(earlier) == robot_of(later):
                waits[later].add(earlier)
            elif not claims[earlier] & claims[later]:
                continue
            elif earlier.step != later.step:
                waits[later].add(earlier)
            elif earlier.name != "go_to":
                _join(mates, earlier, later)
            elif _follows(later, earlier, left):  # into the node that the earlier one leaves
                waits[later].add(earlier)
            else:
                waits[earlier].add(later)
    _close_rings(ordered, waits, mates)
    groups = {a: tuple(b for b in ordered if b in mates[a]) for a in ordered}
    outside = {a: frozenset(waits[a] - mates[a]) for a in ordered}
    whole = {a: frozenset().union(*(outside[b] for b in groups[a])) for a in ordered}
    return Precedence(tuple(ordered), whole, groups)


def _claims(
    actions: Sequence[Action], state: State, layout: Layout
) -> tuple[dict[Action, set[Claim]], dict[Action, str]]:
    """Returns the claims of each action, and the node that each walk leaves."""
    stations = state.stations()
    tables = {table.name for table in layout.tables}
    claims: dict[Action, set[Claim]] = {}
    left: dict[Action, str] = {}
    for action in actions:
        robot, *about = action.arguments
        if action.name == "go_to":
            left[action] = stations[robot]
            stations[robot] = about[0]
            claims[action] = {("node", left[action]), ("node", about[0])}
            continue
        found: set[Claim] = set()
        for name in about:
            if name in tables:
                found.add(("table", name))
            elif (party := state.party_of(name)) is not None:
                found.add(("party", party[0]))
        claims[action] = found
    return claims, left


def _follows(later: Action, earlier: Action, left: Mapping[Action, str]) -> bool:
    """Returns whether one walk enters the node that another one leaves."""
    return later.name == earlier.name == "go_to" and later.arguments[1] == left[earlier]


def _join(mates: dict[Action, set[Action]], one: Action, other: Action) -> None:
    both = mates[one] | mates[other]
    for each in both:
        mates[each] = both


def _close_rings(
    actions: Sequence[Action],
    waits: Mapping[Action, set[Action]],
    mates: dict[Action, set[Action]],
) -> None:
    """Makes a group of walks of one step each of which waits for the next, round a ring."""
    for action in actions:
        if action.name != "go_to":
            continue
        ring, ahead = [action], _one_ahead(action, waits)
        while ahead is not None and ahead not in ring:
            ring.append(ahead)
            ahead = _one_ahead(ahead, waits)
        if ahead is action:
            for each in ring:
                _join(mates, action, each)


def _one_ahead(action: Action, waits: Mapping[Action, set[Action]]) -> Action | None:
    """Returns the walk of the same step for which a walk waits."""
    same = (a for a in waits[action] if a.step == action.step and robot_of(a) != robot_of(action))
    return next(same, None)
