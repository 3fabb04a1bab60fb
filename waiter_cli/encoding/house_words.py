"""Tells what every scenario can say and a domain has no words for: guests, bills, orders of goals.

Entry point `require_house_words`.  A template has a word where it uses its name; so ``waiting: [[ada]]`` asks for
``iswaiting``, and ``enter: [ada]`` for ``has_entered``.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import NamedTuple

from sparc.source import Source
from waiter_cli.encoding.own_words import KEY_OF_FLUENT
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.problem import Problem

__all__ = ["require_house_words"]

_OF_GOAL = {
    "seated": "isattable",
    "paid": "haspaid",
    "ordered": "hasorder",
    "sent": "issent",
    "served": "isserved",
    "filled": "isempty",
}
_OF_OBSERVATION = {
    "enter": ("has_entered", "#observable"),
    "bill": ("bill_wave", "#observable"),
    "order": ("readytoorder", "#fluent"),
    "ready": ("isready", "#fluent"),
    "empty": ("isempty", "#fluent"),
}
_PLACES = {"agent", "chairs", "waiters"}  # of which a layout says enough, whatever the domain


def require_house_words(template: Source, slots: Collection[str], problem: Problem) -> None:
    """Raises `InputError` with every part of the situation, observations or goals that a domain lacks.

    ``slots`` are those of its template: what has no slot is not said to it.
    """
    bare = re.sub(r"%[^\n]*", "", template.text)
    faults = [
        Fault(each.where, f"this domain has no word for {each.said}", each.hint)
        for each in _asked(problem, slots)
        if not re.search(rf"(?<![\w#]){each.word}\s*\(", bare)
    ]
    if faults:
        raise InputError(sorted(dict.fromkeys(faults)))


class _Asked(NamedTuple):
    """Something said in a scenario, the word that a program needs for it, and the mend."""

    said: str
    word: str
    hint: str
    where: Where | None


def _asked(problem: Problem, slots: Collection[str]) -> Iterator[_Asked]:
    """Yields what a problem says to a template with these slots."""
    state, places = problem.before_observations, dict(problem.state_where)
    if {"state", "guest_state"} & {*slots}:
        for word, key in KEY_OF_FLUENT.items():
            if key not in _PLACES and word != "aretogether" and getattr(state, key):
                where = next(
                    (w for name, w in places.items() if name.partition(".")[0] == key), None
                )
                yield _Asked(f"{key} in a state", word, _hint(word, "#fluent", key), where)
    for seen in problem.observations if "observations" in slots else ():
        if seen.kind in _OF_OBSERVATION:
            word, sort = _OF_OBSERVATION[seen.kind]
            hint = _hint(word, sort, seen.kind)
            yield _Asked(f"{seen.kind} in observe", word, hint, seen.where)
    if problem.everybody or not {"goals", "guest_goals"} & {*slots}:
        return
    for goal in problem.all_goals():
        if goal.kind in _OF_GOAL:
            word = _OF_GOAL[goal.kind]
            hint = _hint(word, "#fluent", goal.kind)
            yield _Asked(f"the goal {goal.kind}", word, hint, goal.where)
    for _, then in problem.before:
        hint = "give its template the part order of domains/restaurant, or leave before out"
        yield _Asked("before, an order of goals", "before", hint, then.where)


def _hint(word: str, sort: str, key: str) -> str:
    return f"add {word} to {sort}, or leave {key} out"
