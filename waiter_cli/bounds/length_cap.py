"""Bounds the length of a shortest plan, if there is a plan at all: `Problem` → steps.

Entry point `find_cap`.  The argument: take any plan and drop the deeds that no goal needs.  What
is left is a finite number of deeds, since each uses something up (a waiting party, a wanted bill,
an order, something ready or empty, missing chairs).  Between one deed and the next, where nothing
else changes, a shortest way does.  Being at the bar with something empty, and being at a place that
a goal or an order of goals names, count as deeds that take no step.
"""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.bounds.distances import FAR, Staff, WalkDistances
from waiter_cli.bounds.required_tasks import Needs
from waiter_cli.bounds.service_chains import marks_of
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.problem import Problem

__all__ = ["find_cap"]

# What a table's order with its plate, or its jug, can take at most: deeds, and fillings (no deed).
# An order: 1 take_order, 2 send_order, 3 take_up, 4 bring; a jug: take_up, refill, 3 bring.
_ORDER_DEEDS, _THING_DEEDS, _FILLS = 10, 5, 2


def find_cap(problem: Problem, needs: Needs, staff: Staff) -> int:
    """Returns a number of steps that suffices for a plan of ``problem``, if it has any.

    With a timetable: whatever happens until its last step, from there on waiters stand still.
    """
    deeds, stops = _guests(problem, needs), 0
    concerned = {chain.table for chain in needs.chains}
    for guest in needs.guests:
        concerned |= {name for name, _ in guest.asks}
    hands = False
    for name in concerned:
        for item in ("plate", *REFILLABLES):
            marks = marks_of(needs.now, name, item)
            if marks:
                hands = True
                deeds += _ORDER_DEEDS if item == "plate" else _THING_DEEDS
                stops += _FILLS if item != "plate" else 0
    if hands and needs.now.carrying is not None:
        deeds, stops = deeds + 1, stops + 1
    passed = [goal for pair in problem.before for goal in pair]
    goals = (*problem.goals, *passed)
    deeds += sum(1 for name in concerned if name in needs.now.wants_bill)
    deeds += len({goal for goal in goals if goal.kind == "chairs"})
    for visits in (problem.goals, passed):  # what is passed early may be where the plan ends, too
        stops += len({goal.node for goal in visits if goal.kind == "at"})
    walk = _longest(problem, staff)
    return staff.last + deeds + walk * (deeds + stops)


def _guests(problem: Problem, needs: Needs) -> int:
    """Deeds of leading parties to tables, with chairs for them."""
    forced = len(needs.forced)
    waiting = sum(1 for guest in needs.guests if not guest.led)
    waiting += min(forced, sum(1 for party in needs.spare if party in needs.now.waiting))
    led = bool(needs.now.with_agent) and bool(waiting or forced or needs.guests)
    parties = waiting + led
    lacking = any(count < problem.layout.table(name).capacity for name, count in needs.now.chairs)
    return 2 * waiting + led + (parties if lacking else 0)


def _longest(problem: Problem, staff: Staff) -> int:
    """Returns a bound on the walk between two deeds, in steps.

    A walk leads to a place where something is done: from another one, or from where the robot
    stands at step 0, or from anywhere once a timetable has ended.  So distances are made to those
    places alone, however large the restaurant is.
    """
    floor = WalkDistances(problem, staff.after.values())
    start = floor.number[problem.state.agent]
    row = floor.row(start)
    if any(goal.kind == "at" for pair in problem.before for goal in pair):
        inside = (
            node
            for node, steps in enumerate(row)
            if node not in floor.shut and (staff.last > 0 or steps < FAR)
        )
        # a way that keeps clear of a node may be a long one
        return max(0, sum(1 for _ in inside) - 1)
    reached = staff.last > 0
    places = [node for node in _places(problem, floor) if reached or row[node] < FAR]
    return floor.farthest(places)


def _places(problem: Problem, floor: WalkDistances) -> Iterator[int]:
    """Yields the open nodes where a deed can be done or a goal wants the robot, by
    number, once each.
    """
    layout = problem.layout
    names = [layout.entrance]
    names += [node for table in layout.tables for node in table.nodes]
    names += layout.bar.nodes if layout.bar is not None else ()
    names += [goal.node for goal in problem.goals if goal.kind == "at" and goal.node]
    for name in dict.fromkeys(names):
        if floor.number[name] not in floor.shut:
            yield floor.number[name]
