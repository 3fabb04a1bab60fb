"""Orders of goals that cannot be met: the pairs of ``before``, looked at one by one.

Entry point `order_reasons`.  Pairs are first completed (A before B, B before C: A before C).
"""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.bounds.distances import FAR, WalkDistances
from waiter_cli.bounds.reasons import place_of_goal
from waiter_cli.bounds.required_tasks import Needs
from waiter_cli.bounds.service_chains import BAR_LINKS
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Party
from waiter_cli.model.wording import goal_text
from waiter_cli.rules.actions import holds

__all__ = ["order_reasons"]


def order_reasons(problem: Problem, needs: Needs, floor: WalkDistances) -> Iterator[Reason]:
    """Yields why the order of goals cannot be kept; nothing when no reason was found."""
    pairs = _closed(problem.before)
    circle = [early for early, late in pairs if early == late]
    if circle:
        texts = ", ".join(goal_text(goal) for goal in dict.fromkeys(circle))
        yield Reason(f"the order goes in a circle: {texts}", place_of_goal(problem, circle[0]))
        return
    for early, late in pairs:
        if holds(late, needs.now, problem):
            place = place_of_goal(problem, late)
            yield Reason(f"{goal_text(late)} holds already, so nothing can come before it", place)
        elif not holds(early, needs.now, problem):
            why = _entails(needs, early, late) or _on_the_way(problem, needs, floor, early, late)
            if why:
                first, second = goal_text(early), goal_text(late)
                place = place_of_goal(problem, early)
                yield Reason(f"{first} cannot come before {second}: {why}", place)


def _closed(pairs: tuple[tuple[Goal, Goal], ...]) -> list[tuple[Goal, Goal]]:
    """Returns the pairs and all that follow from them."""
    closure = dict.fromkeys(pairs)
    while True:
        more = [(a, d) for a, b in closure for c, d in closure if b == c and (a, d) not in closure]
        if not more:
            return list(closure)
        closure.update(dict.fromkeys(more))


def _entails(needs: Needs, early: Goal, late: Goal) -> str:
    """Returns why the early goal cannot hold without the late one; empty when it may."""
    both = "the first includes the second"
    same_party = bool(set(early.party) & set(late.party))
    sits = early.kind in ("seated", "serve") or (early.kind == "paid" and bool(early.party))
    if same_party and late.kind == "seated":
        if early.kind == "seated":
            return "a party sits down once"
        if sits and late.table is None:
            return both
    if late.kind == "serve" and _only_wish(needs, early, late):
        return "they come about together"
    if early.kind == "paid" == late.kind:
        here, there = (goal.table or needs.now.table_of(goal.party[0]) for goal in (early, late))
        if here is not None and here == there:
            return "they come about together"
    sits_at = needs.now.table_of(early.party[0]) if early.party else None
    if early.kind == "serve" and sits_at is not None and late.table == sits_at:
        if late.kind in ("paid", "filled") or (late.kind == "served" and late.item in REFILLABLES):
            return both
    if early.table is not None and early.table == late.table:
        if early.kind == "chairs" == late.kind and (early.number or 0) >= (late.number or 0):
            return both
        if early.kind == "sent" and late.kind == "ordered":
            return both
    return ""


def _on_the_way(
    problem: Problem, needs: Needs, floor: WalkDistances, early: Goal, late: Goal
) -> str:
    """Returns why the late goal comes about on every way to the early one; empty when it need not."""
    if late.kind == "at":
        beyond = WalkDistances(
            problem, [floor.names[node] for node in floor.shut] + [late.node or ""]
        )
        if not _can_reach(needs, beyond, early):
            return f"every way there leads over {late.node}"
    led = needs.now.with_agent
    if late.kind == "seated" and led and set(late.party) & set(led):
        if _needs_pick(needs, early):
            return f"the party of {led[0]} follows the agent and must be seated first"
    if early.kind == "paid" and early.table is not None and late.party:
        return _sits_there(problem, needs, early.table, late)
    if late.kind == "paid" and late.table is not None and early.kind == "paid":
        return _sits_there(problem, needs, late.table, early)
    return ""


def _sits_there(problem: Problem, needs: Needs, table: str, goal: Goal) -> str:
    """Returns why a free table has paid only when the goal of a party holds too.

    Empty when it may not.
    """
    if table in dict(needs.now.seated) or goal.kind not in ("seated", "paid"):
        return ""
    mine = set(goal.party)
    if all(mine & set(party) for party in _could_sit(problem, needs, table)):
        return f"nobody else can sit at {table}"
    if any(mine & set(guest.party) and guest.tables == (table,) for guest in needs.guests):
        return f"the party of {goal.party[0]} can sit nowhere but at {table}"
    return ""


def _only_wish(needs: Needs, early: Goal, late: Goal) -> bool:
    """Returns whether serving the late goal's party takes nothing but what makes the
    early one hold.
    """
    for guest in needs.guests:
        if late in guest.ends:
            sits = early.kind in ("seated", "paid") and bool(set(early.party) & set(late.party))
            bills = all(
                link.name == "give_bill" for _, c in guest.asks for k in c for link in k.links
            )
            return sits and bills if early.kind == "paid" else sits and not guest.asks
    chains = [chain for chain in needs.chains if late in chain.ends]
    if len(chains) != 1 or early.table != needs.now.table_of(late.party[0]):
        return early.kind == "paid" and early.table is None and _same_bill(needs, early, late)
    refills = early.kind in ("filled", "served") and early.item in REFILLABLES
    return (early.kind == "paid" or refills) and early in chains[0].ends


def _same_bill(needs: Needs, early: Goal, late: Goal) -> bool:
    chains = [chain for chain in needs.chains if late in chain.ends]
    bill = len(chains) == 1 and chains[0].links[0].name == "give_bill"
    return bill and early in chains[0].ends


def _could_sit(problem: Problem, needs: Needs, table: str) -> list[Party]:
    """Returns the parties for which a free table would do."""
    capacity = problem.layout.table(table).capacity
    parties = [guest.party for guest in needs.guests if table in guest.tables]
    return parties + [party for party in needs.spare if len(party) <= capacity]


def _needs_pick(needs: Needs, goal: Goal) -> bool:
    """Returns whether some waiting party must be picked up for the goal, or the led
    one seated before.
    """
    party = needs.now.party_of(goal.party[0]) if goal.party else None
    if party is not None and party in needs.now.waiting:
        return True
    return (
        goal.kind == "paid" and goal.table is not None and goal.table not in dict(needs.now.seated)
    )


def _can_reach(needs: Needs, floor: WalkDistances, goal: Goal) -> bool:
    """Returns whether the places that a goal takes can be reached (not: whether it can be met)."""
    row = floor.row(floor.number[needs.now.agent])
    if goal.kind == "at":
        return row[floor.number[goal.node or ""]] < FAR
    for guest in needs.guests:
        if goal in guest.ends:
            door = guest.led or row[floor.door] < FAR
            return door and any(_near(floor, row, name) for name in guest.tables)
    for chain in needs.chains:
        if goal in chain.ends:
            names = {link.name for link in chain.sure}
            at_bar = bool(names & BAR_LINKS) and goal.kind != "ordered"
            at_table = "take_order" in names if goal.kind == "sent" else bool(names - BAR_LINKS)
            bar = not at_bar or any(row[node] < FAR for node in floor.bar)
            return bar and (not at_table or _near(floor, row, chain.table))
    return True


def _near(floor: WalkDistances, row: list[int], table: str) -> bool:
    return any(row[node] < FAR for node in floor.nodes_of[table])
