"""Explains how what was seen can have come about: belief, observations → explanations.

Entry points `explain`, for a run, and `explain_observations`, for a problem.  The program
``domains/restaurant/diagnosis.sparc`` says what may happen unseen: waiters walk, parties leave, sit
down by themselves, change tables, strangers come in.  Its consistency-restoring rules make the
explanations those with the fewest events.  Somebody who went off the floor and came back elsewhere
explains anything, so that is asked for last.  The robot knows its own walks: seen elsewhere, it was
brought there.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import count
from typing import TypeAlias

from waiter_cli.diagnosis.case import Surprise
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation, Party, State
from waiter_cli.model.wording import people
from waiter_cli.rules.observations import observe

__all__ = ["explain", "explain_observations"]

MOST = 5
"""So many explanations are given."""
SECONDS = 2.0
"""For each search."""
_OPTIONS = ("--opt-mode=optN",)
_PLAUSIBLE = ("walks", "sits_down", "leaves", "changes_to", "comes_in", "is_elsewhere")

Event: TypeAlias = tuple[int, str, tuple[str, ...]]


def explain_observations(problem: Problem) -> tuple[Diagnosis, ...]:
    """Returns explanations of a problem's observations by what happened before step 0, best first.

    The steps of their events are negative.  Empty where nothing needs or has an explanation.
    """
    return explain(problem.layout, problem.before_observations, problem.observations, 0, ())


def explain(
    layout: Layout,
    state: State,
    seen: Sequence[Observation],
    step: int,
    trail: Sequence[tuple[int, str]],
) -> tuple[Diagnosis, ...]:
    """Returns explanations of what was seen at ``step``, where ``state`` was believed; best first.

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
    best: list[tuple[tuple[Event, ...], int]] = []
    for walkers, elsewhere in case.suspicions():
        if best and (elsewhere or best[0][1] <= case.least()):
            break
        explanations = _solve(case, walkers, elsewhere)
        if explanations and (not best or explanations[0][1] < best[0][1]):
            best = explanations
    return tuple(_explanations(case, best))[:MOST]


def _case(
    layout: Layout,
    state: State,
    seen: Sequence[Observation],
    step: int,
    trail: Sequence[tuple[int, str]],
) -> Surprise | None:
    """Returns what needs an explanation; None when nothing does, or two things were seen of one."""
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
    return Surprise(
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


# -- searching ------------------------------------------------------------------------------


def _solve(
    case: Surprise, walkers: Collection[str], elsewhere: bool
) -> list[tuple[tuple[Event, ...], int]]:
    """Returns the sets of events that explain the case, with their number.

    Empty when there is none.
    """
    from sparc import to_asp
    from sparc.solving.clingo_solver import Grounding, ground_literal
    from sparc.solving.clingo_threads import Abandoned
    from waiter_cli.diagnosis.encode import program_of
    from waiter_cli.encoding.aliases import Aliases

    parties = case.state.parties()
    entering = (o.arguments for o in case.seen if o.kind == "enter")
    customers = (name for party in (*parties, *entering) for name in party)
    aliases = Aliases(customers, case.layout)
    posed = replace(case, state=aliases.state(case.state), seen=aliases.seen(case.seen))
    program, moments = program_of(posed, walkers, elsewhere)
    deadline = time.monotonic() + SECONDS
    grounding = Grounding(to_asp(program), options=_OPTIONS)
    explanations: dict[tuple[Event, ...], int] = {}
    try:
        grounding.ground(deadline)
    except Abandoned:
        return []
    for model in grounding.models(limit=4 * MOST, deadline=deadline):
        if model.cost and not model.optimality_proven:
            continue
        literals = map(ground_literal, model.symbols(shown=True))
        events = []
        for literal in literals:
            if literal.name == "happens" and not literal.negated:
                event, moment = literal.arguments
                step = case.step - moments + int(str(moment))
                events.append((step, event.name, aliases.names(tuple(map(str, event.arguments)))))  # type: ignore[union-attr]
        explanations[tuple(sorted(events))] = len(events)
    return sorted(
        explanations.items(),
        key=lambda item: (item[1], sum(_PLAUSIBLE.index(name) for _, name, _ in item[0]), item[0]),
    )


# -- what is believed then ------------------------------------------------------------------


def _explanations(
    case: Surprise, found: Sequence[tuple[tuple[Event, ...], int]]
) -> Iterator[Diagnosis]:
    """Yields those after which what was seen can be."""
    for events, cost in found:
        state = case.state
        texts = []
        for _, name, arguments in events:
            texts.append(_in_words(name, arguments, state))
            state = _believe(state, name, arguments, case.layout)
        after, objections = observe(state, case.seen, case.layout)
        if not objections:
            yield Diagnosis(events, tuple(texts), cost, after)


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
    """Returns the state after one event."""
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
