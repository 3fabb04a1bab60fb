"""The rules of the restaurant in plain Python: the preconditions and effects of actions.

Entry points: `apply` performs one action or raises `Illegal` with the reason in the words of the
layout; `legal_actions` lists what could be done; `holds` says whether a goal is met.  Nothing here
knows SPARC, answer sets or a solver: the rules are written out a second time, from their sentences
in the domain's README, so that a plan found by the one can be judged by the other.

A state handed to these functions is the one *at* ``step``; its ``waiters`` stand where the
timetable has them by then (`begin` makes the state at step 0 of a problem).

>>> from waiter_cli.model.layout import Layout, Node, Table
>>> from waiter_cli.model.problem import Problem
>>> hall = Layout(
...     "hall", (Node("a"), Node("b")), (("a", "b"),), "a",
...     (Table("t", 2, ("b",), None, (0.8, 0.8), 2),), "a",
... )
>>> now = State("a", waiting=(("c1",),))
>>> problem = Problem(hall, now, (), now, (Goal("seated", party=("c1",)),))
>>> [action.text for action in legal_actions(problem, now, 0)]
['go_to(agent,b)', 'pick(agent,c1)']
>>> apply(problem, now, Action(0, "seat", ("agent", "c1", "t")), 0)
Traceback (most recent call last):
waiter_cli.rules.actions.Illegal: seat(agent,c1,t): the party of c1 does not follow the agent
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

__all__ = [
    "REFILLABLE",
    "Illegal",
    "apply",
    "apply_alone",
    "begin",
    "holds",
    "idle",
    "imaginable_actions",
    "legal_actions",
]

REFILLABLE = ("jug", "basket")


class Illegal(Exception):
    """An impossible action was tried; ``reason`` is a sentence in the user's terms."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


def begin(problem: Problem) -> State:
    """Returns the state at step 0, with what follows from it at once.

    Raises `Illegal` on a shared node.
    """
    return _settle(problem, problem.state, range(1), "at the start")


def apply(problem: Problem, state: State, action: Action, step: int) -> State:
    """Returns the state at ``step + 1`` when ``action`` is done in ``state`` at
    ``step``, else `Illegal`.

    ``action.step`` is not looked at.  A party may be named by any of its members.
    """
    after = apply_alone(problem, state, action)
    return _settle(problem, after, range(step + 1, step + 2), action.text)


def apply_alone(problem: Problem, state: State, action: Action) -> State:
    """Returns ``state`` with what ``action`` itself changes, before colleagues move; else `Illegal`.

    The robot that acts is ``agent``, or by its name the first of ``state.robots``.
    """
    if action.name not in _RULES:
        raise Illegal(f"{action.text}: there is no action {action.name}")
    form, rule = _RULES[action.name]
    name = state.robots[0].name if state.robots else "agent"
    if len(action.arguments) != 1 + len(form) or action.arguments[0] != name:
        wanted = ",".join((name, *form))
        raise Illegal(f"{action.text}: the form of this action is {action.name}({wanted})")
    try:
        for kind, name in zip(form, action.arguments[1:]):
            _known(problem, state, kind, name)
        after = rule(problem, state, *action.arguments[1:])
    except Illegal as fault:
        raise Illegal(f"{action.text}: {fault.reason}") from None
    return after


def idle(problem: Problem, state: State, step: int) -> State:
    """Returns the state at ``step + 1`` when nothing is done; `Illegal` when a waiter arrives here."""
    return _settle(problem, state, range(step + 1, step + 2), "waiting")


def _settle(problem: Problem, state: State, steps: range, what: str) -> State:
    """``state`` once the waiters due in ``steps`` have moved and carried things have filled."""
    due = {who: to for who, at, to in problem.layout.timetable if at in steps}
    if due:
        state = replace(state, waiters=tuple(sorted((dict(state.waiters) | due).items())))
    for waiter, node in state.waiters:
        if node == state.agent:
            when = steps[-1]
            raise Illegal(
                f"{what}: {waiter} stands on {node} at step {when}, and so would the agent"
            )
    load = state.carrying
    bar = problem.layout.bar
    if load is not None and load[1] in REFILLABLE and bar is not None and state.agent in bar.nodes:
        state = replace(state, empty=state.empty - {load})
    return state


def _known(problem: Problem, state: State, kind: str, name: str) -> None:
    layout = problem.layout
    match kind:
        case "NODE":
            found = any(node.name == name for node in layout.nodes)
        case "TABLE":
            found = any(table.name == name for table in layout.tables)
        case "CUSTOMER":
            found = state.party_of(name) is not None
        case "OBJECT" | "REFILLABLE":
            found = name in layout.objects and (kind == "OBJECT" or name in REFILLABLE)
        case _:
            found = name.isascii() and name.isdigit() and len(name) < 10
    if not found:
        here = "nobody inside is called" if kind == "CUSTOMER" else f"there is no {kind.lower()}"
        raise Illegal(f"{here} {name}")


def _go_to(problem: Problem, state: State, node: str) -> State:
    layout = problem.layout
    if not layout.leads(state.agent, node):
        if (node, state.agent) in layout.one_way:
            raise Illegal(f"the path between {node} and {state.agent} leads to {state.agent} only")
        raise Illegal(f"{node} is no neighbour of {state.agent}")
    for waiter, place in state.waiters:
        if place == node:
            raise Illegal(f"{waiter} stands on {node}")
    return replace(state, agent=node)


def _pick(problem: Problem, state: State, customer: str) -> State:
    entrance = problem.layout.entrance
    if state.agent != entrance:
        raise Illegal(f"{_who(state)} is at {state.agent}, not at the entrance {entrance}")
    party = state.party_of(customer)
    if party is None or party not in state.waiting:
        raise Illegal(f"the party of {customer} does not wait at the entrance")
    if state.with_agent:
        raise Illegal(f"the party of {state.with_agent[0]} already follows {_who(state)}")
    if len(state.seated) >= len(problem.layout.tables):
        raise Illegal("no table is free")
    waiting = tuple(other for other in state.waiting if other != party)
    return replace(state, waiting=waiting, with_agent=party)


def _seat(problem: Problem, state: State, customer: str, table: str) -> State:
    party = state.with_agent
    if customer not in party:
        raise Illegal(f"the party of {customer} does not follow {_who(state)}")
    _must_be_at(problem, state, table)
    sitting = dict(state.seated)
    if table in sitting:
        raise Illegal(f"{table} is not free: the party of {sitting[table][0]} sits there")
    capacity, chairs = problem.layout.table(table).capacity, _chairs(problem, state, table)
    if len(party) > capacity:
        raise Illegal(f"{table} is for {capacity}, the party of {customer} has {len(party)}")
    if len(party) > chairs:
        raise Illegal(f"{table} has {chairs} chairs, the party of {customer} has {len(party)}")
    seated = tuple(sorted((sitting | {table: party}).items()))
    return replace(state, with_agent=(), seated=seated)


def _give_bill(problem: Problem, state: State, table: str) -> State:
    if table not in state.wants_bill:
        raise Illegal(f"{table} does not want its bill")
    _must_be_taken(state, table)
    _must_be_at(problem, state, table)
    return replace(state, wants_bill=state.wants_bill - {table}, paid=state.paid | {table})


def _take_order(problem: Problem, state: State, table: str) -> State:
    _must_have_bar(problem)
    _must_be_taken(state, table)
    if table not in state.ready_to_order:
        raise Illegal(f"{table} is not ready to order")
    _must_be_at(problem, state, table)
    return replace(
        state,
        ready_to_order=state.ready_to_order - {table},
        ordered=state.ordered | {table},
        sent=state.sent - {table},
        served=state.served - {table},
    )


def _send_order(problem: Problem, state: State, table: str) -> State:
    if table not in state.ordered:
        raise Illegal(f"{_who(state)} holds no order of {table}")
    _must_be_at_bar(problem, state)
    cooked = problem.instant_kitchen and "plate" in problem.layout.objects
    return replace(
        state,
        ordered=state.ordered - {table},
        sent=state.sent | {table},
        ready=state.ready | {(table, "plate")} if cooked else state.ready,
    )


def _take_up(problem: Problem, state: State, item: str, table: str) -> State:
    _must_be_at_bar(problem, state)
    _must_have_free_hands(state)
    if (table, item) not in state.ready:
        raise Illegal(f"no {item} for {table} is ready")
    return replace(state, ready=state.ready - {(table, item)}, carrying=(table, item))


def _bring(problem: Problem, state: State, item: str, table: str) -> State:
    if state.carrying != (table, item):
        raise Illegal(f"{_who(state)} does not carry the {item} for {table}")
    if (table, item) in state.empty:
        raise Illegal(f"the {item} for {table} is empty")
    _must_be_at(problem, state, table)
    served = state.served | {table} if item == "plate" else state.served
    return replace(state, carrying=None, served=served)


def _refill(problem: Problem, state: State, item: str, table: str) -> State:
    _must_have_bar(problem)
    _must_have_free_hands(state)
    if (table, item) not in state.empty:
        raise Illegal(f"the {item} of {table} is not empty")
    _must_be_at(problem, state, table)
    return replace(state, carrying=(table, item))


def _bring_chairs(problem: Problem, state: State, table: str, number: str) -> State:
    wanted, capacity = int(number), problem.layout.table(table).capacity
    if all(_chairs(problem, problem.state, t.name) >= t.capacity for t in problem.layout.tables):
        raise Illegal("every table has all its chairs from the start")
    chairs = _chairs(problem, state, table)
    if not chairs < wanted <= capacity:
        raise Illegal(f"{table} is for {capacity} and has {chairs} chairs")
    _must_be_at(problem, state, table)
    return replace(state, chairs=tuple(sorted((dict(state.chairs) | {table: wanted}).items())))


_RULES: dict[str, tuple[tuple[str, ...], Callable[..., State]]] = {
    "go_to": (("NODE",), _go_to),
    "pick": (("CUSTOMER",), _pick),
    "seat": (("CUSTOMER", "TABLE"), _seat),
    "give_bill": (("TABLE",), _give_bill),
    "take_order": (("TABLE",), _take_order),
    "send_order": (("TABLE",), _send_order),
    "take_up": (("OBJECT", "TABLE"), _take_up),
    "bring": (("OBJECT", "TABLE"), _bring),
    "refill": (("REFILLABLE", "TABLE"), _refill),
    "bring_chairs": (("TABLE", "NUMBER"), _bring_chairs),
}


def _who(state: State) -> str:
    """Returns the name of the robot that acts, for messages: its own where it is one of several."""
    return state.robots[0].name if state.robots else "the agent"


def _chairs(problem: Problem, state: State, table: str) -> int:
    return dict(state.chairs).get(table, problem.layout.table(table).chairs)


def _must_be_at(problem: Problem, state: State, table: str) -> None:
    nodes = problem.layout.table(table).nodes
    if state.agent not in nodes:
        raise Illegal(
            f"{table} is reached from {' or '.join(nodes)}, {_who(state)} is at {state.agent}"
        )


def _must_be_taken(state: State, table: str) -> None:
    if table not in dict(state.seated):
        raise Illegal(f"nobody sits at {table}")


def _must_have_bar(problem: Problem) -> None:
    if problem.layout.bar is None:
        raise Illegal("this layout has no bar")


def _must_be_at_bar(problem: Problem, state: State) -> None:
    _must_have_bar(problem)
    assert problem.layout.bar is not None
    nodes = problem.layout.bar.nodes
    if state.agent not in nodes:
        raise Illegal(f"the bar is at {' and '.join(nodes)}, {_who(state)} is at {state.agent}")


def _must_have_free_hands(state: State) -> None:
    if state.carrying is not None:
        table, item = state.carrying
        raise Illegal(f"{_who(state)} carries the {item} for {table}")


def legal_actions(problem: Problem, state: State, step: int) -> list[Action]:
    """Returns every action that is possible in ``state`` at ``step``, each party by
    its first member.
    """
    actions = []
    for action in imaginable_actions(problem, state, step):
        try:
            apply(problem, state, action, step)
        except Illegal:
            continue
        actions.append(action)
    return actions


def imaginable_actions(problem: Problem, state: State, step: int) -> Iterator[Action]:
    """Yields a superset of the possible actions, small enough to be tried one by one."""
    layout = problem.layout
    ends = [edge for edge in layout.edges if state.agent in edge]
    for node in dict.fromkeys(b if a == state.agent else a for a, b in ends):
        yield Action(step, "go_to", ("agent", node))
    for party in state.waiting:
        yield Action(step, "pick", ("agent", party[0]))
    for table in layout.tables:
        if state.with_agent:
            yield Action(step, "seat", ("agent", state.with_agent[0], table.name))
        for name in ("give_bill", "take_order", "send_order"):
            yield Action(step, name, ("agent", table.name))
        for item in layout.objects:
            for name in ("take_up", "bring", "refill"):
                yield Action(step, name, ("agent", item, table.name))
        for number in range(1, table.capacity + 1):
            yield Action(step, "bring_chairs", ("agent", table.name, str(number)))


def holds(goal: Goal, state: State, problem: Problem) -> bool:
    """Returns whether ``goal`` holds in ``state``; parties are known by any common member."""
    table = goal.table or ""
    match goal.kind:
        case "seated" | "serve":
            place = state.table_of(goal.party[0])
            if goal.kind == "seated" or place is None:
                return place is not None and goal.table in (None, place)
            open_wishes = state.wants_bill | state.ready_to_order | state.held_orders()
            things = {thing for thing, _ in (*state.ready, *state.empty, *state.carried())}
            return place not in open_wishes and place not in things
        case "paid":
            at = goal.table if goal.table is not None else state.table_of(goal.party[0])
            occupied = any(taken == at for taken, _ in state.seated)
            return occupied and at in state.paid and at not in state.wants_bill
        case "at":
            if goal.robot is not None:
                return state.stations().get(goal.robot) == goal.node
            return goal.node in state.stations().values()
        case "ordered":
            return table in state.held_orders() or table in state.sent
        case "sent":
            return table in state.sent
        case "served":
            thing = (table, goal.item or "plate")
            if thing in state.ready or thing in state.carried():
                return False
            if thing[1] == "plate":
                return table in state.served and (
                    goal.item is not None or table not in state.held_orders()
                )
            return thing not in state.empty
        case "filled":
            thing = (table, goal.item or "")
            return thing not in state.empty and thing not in state.carried()
        case "chairs":
            return _chairs(problem, state, table) >= (goal.number or 0)
        case "holds" | "holds_not":
            return (goal.fluent in state.fluents) == (goal.kind == "holds")
    raise ValueError(f"no such goal: {goal.kind}")
