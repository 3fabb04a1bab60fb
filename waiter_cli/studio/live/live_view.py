"""An executive's decision in words, as the page lists it. Entry points `planned_words`, `view_of`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from waiter_cli.domain_execution.vocabulary import Vocabulary
from waiter_cli.encoding.declarations import words_for
from waiter_cli.encoding.domains import Domain
from waiter_cli.execution.agenda import Pending
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.documents import state_document
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.state import Goal, State
from waiter_cli.model.wording import counted, goal_text, in_words, people
from waiter_cli.rules.validator import run

__all__ = [
    "PlannedAction",
    "own_words",
    "planned_words",
    "proof_of",
    "stories",
    "view_of",
    "wish_words",
]


MOST_REASONS = 2
"""So many reasons stand in the line about the proof."""


class PlannedAction(NamedTuple):
    """An action that remains: its step, its robot, and what it means, in words."""

    step: int
    robot: str
    words: str


def planned_words(executive: Executive, domain: Domain) -> list[PlannedAction]:
    """Returns each action that remains, those that run first."""
    found = [_worded(action, executive.state, domain) for action in _running(executive)]
    outlook = executive.outlook()
    if outlook is None:
        return found
    problem, plan, start = outlook
    states = run(problem, plan, executive.belief.rules).states
    steps = _steps(executive, start)
    for action in plan.actions:
        step = next(steps[action.arguments[0]]) if steps else start + action.step
        state = states[min(action.step, len(states) - 1)]
        found.append(_worded(replace(action, step=step), state, domain))
    return found


def _running(executive: Executive) -> tuple[Action, ...]:
    if isinstance(executive, FleetExecutive):
        return executive.moving
    return () if executive.running is None else (executive.running,)


def _steps(executive: Executive, start: int) -> dict[str, Iterator[int]]:
    """Returns for each of several robots the steps of what it has not begun, in order."""
    begun = _running(executive)
    left = [action for action in executive.decision.plan if action not in begun]
    names = [name for name, _ in executive.layout.agents]
    return {n: iter([a.step for a in left if a.arguments[0] == n]) for n in names}


def _worded(action: Action, state: State, domain: Domain) -> PlannedAction:
    words = words_for(domain, action, state)
    return PlannedAction(action.step, action.arguments[0] if action.arguments else "", words)


def proof_of(executive: Executive, planner: OnlinePlanner) -> str:
    """Returns how many steps remain, and why there are not fewer.

    >>> counted(7, "step")
    '7 steps'
    """
    decision = executive.decision
    steps = f"{counted(decision.horizon, 'step')}."
    if decision.status == "no_plan":
        why = _some([reason.message for reason in decision.reasons])
        why = why or "nothing that is wanted can be done"
        if decision.horizon:  # what is under way is finished
            return f"{steps} Then there is no plan: {why}"
        return f"{steps} There is no plan: {why}"
    if decision.status == "undecided" and not _is_done(executive):
        limit = {"time": "the time limit", "memory": "the memory there is"}
        why = limit.get(decision.limit or "", "the limit of steps")
        return f"{steps} Not proved minimal: {why} came first."
    if decision.horizon == 0:
        waits = " All that is wanted must wait." if decision.pending else " Nothing is to be done."
        return steps + waits
    if not decision.minimal:
        return f"{steps} Not proved minimal."
    problem, fewer = executive.planned, decision.horizon - 1
    few = f"{fewer} {'is' if fewer == 1 else 'are'} too few."
    if executive.layout.agents:
        return f"{steps} Minimal: it is proved that {few}"
    least = planner.least(problem) if problem is not None else 0
    ahead = executive.step + decision.horizon - executive.belief.ahead()[0]
    how = "a lower bound proves" if least >= ahead else "solving proved"
    return f"{steps} Minimal: {how} that {few}"


def _some(reasons: Sequence[str]) -> str:
    """Returns the first reasons, and how many more there are: each stands with the wish that waits.

    >>> _some(["a", "b", "a", "c", "d"])
    'a; b; and 2 more'
    """
    told = list(dict.fromkeys(reasons))
    more = [f"and {len(told) - MOST_REASONS} more"] if len(told) > MOST_REASONS else []
    return "; ".join([*told[:MOST_REASONS], *more])


def _is_done(executive: Executive) -> bool:
    """Returns whether nothing is left of a plan, proved minimal or not: what it was for is so."""
    problem, now = executive.planned, executive.state
    if problem is None or executive.decision.horizon:
        return False
    here = replace(problem, before_observations=now, observations=(), state=now)
    return run(here, Plan((), 0), executive.belief.rules).valid


def wish_words(goal: Goal) -> str:
    """Returns a wish in words.

    >>> wish_words(Goal("paid", table="table1")), wish_words(Goal("seated", party=("c1", "c2")))
    ('table1 gets its bill', 'the party of c1 (2) is seated')
    """
    who = people(goal.party) if goal.party else ""
    match goal.kind:
        case "seated":
            return f"{who} is seated" + (f" at {goal.table}" if goal.table else "")
        case "paid":
            return f"{goal.table or who} gets {'its' if goal.table else 'the'} bill"
        case "ordered":
            return f"the order of {goal.table} is taken"
        case "sent":
            return f"the order of {goal.table} is sent to the kitchen"
        case "served":
            return f"{goal.table} has its {goal.item or 'plate'}"
        case "filled":
            return f"the {goal.item} of {goal.table} is filled"
        case "at":
            return f"{goal.robot or 'the robot'} is at {goal.node}"
        case "serve":
            return f"{who} is served"
        case "holds" | "holds_not":
            return f"{goal.fluent} {'holds' if goal.kind == 'holds' else 'does not hold'}"
    return goal_text(goal, in_sentence=True)


def view_of(executive: Executive, planner: OnlinePlanner) -> dict[str, Any]:
    """Returns what the page lists: proof, wishes that wait, goals, the last diagnosis, the state."""
    state = executive.state
    return {
        "proof": proof_of(executive, planner),
        "horizon": executive.decision.horizon,
        "revision": executive.decision.revision,
        "step": executive.step,
        "pending": [_pending(each) for each in executive.decision.pending],
        "goals": [{"goal": goal.as_dict(), "words": wish_words(goal)} for goal in executive.goals],
        "parties": [list(party) for party in state.parties()],
        "state": state_document(state, executive.layout),
        "robots": [
            {"name": name, "at": node, "out": name in (executive.decision.out or ())}
            for name, node in state.stations().items()
        ],
        "blocked": [list(edge) for edge in executive.shut],
    }


def own_words(vocabulary: Vocabulary, state: State) -> dict[str, list[dict[str, Any]]]:
    """Returns the ``observables`` and ``fluents`` of a domain's own: each ``term``, what it is ``about``.

    Of fluents also whether each ``holds``.
    """
    guests = [name for party in state.parties() for name in party]
    seen, kept = (
        [phrase for form in forms for phrase in form.phrases(guests)]
        for forms in (vocabulary.observables, vocabulary.fluents)
    )
    return {
        "observables": [{"term": each.term, "about": list(each.about)} for each in seen],
        "fluents": [
            {"term": each.term, "about": list(each.about), "holds": each.term in state.fluents}
            for each in kept
        ],
    }


def stories(texts: Sequence[Sequence[str]]) -> list[str]:
    """Returns each explanation as one sentence, the likeliest first."""
    return [in_words(list(text)) for text in texts]


def _pending(wish: Pending) -> dict[str, Any]:
    words = wish_words(wish.goal)
    if wish.then is not None:
        words = f"{words} before {wish_words(wish.then)}"
    reasons = list(dict.fromkeys(reason.message for reason in wish.reasons))
    return {"words": words, "reasons": reasons}
