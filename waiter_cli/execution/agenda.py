"""Keeps the agenda of a run: goals, wishes and their order → the problem of this moment.

Entry point `choose`.  A *wish* is a goal that may wait: serving everybody is made of wishes, and
``serve`` is one.  Where all of them together are impossible the oldest come first; a wish that the
older ones leave no room for is *pending*, with the reasons, until something changes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, State
from waiter_cli.model.wording import goal_text
from waiter_cli.problems.everybody import serve_everybody

__all__ = [
    "Agenda",
    "Selection",
    "Impossible",
    "Pending",
    "Planner",
    "PlannerAnswer",
    "Wanted",
    "choose",
    "still_pending",
    "whole_party",
]


@dataclass(frozen=True)
class PlannerAnswer:
    """A planner's answer to one problem.

    ``status`` is ``plan``, ``no_plan`` or ``undecided``; an undecided answer may still hold the
    best plan found, and says in ``limit`` what came first: ``time``, ``memory`` or ``max_steps``.
    The plan's steps count from 0.
    """

    status: str
    plan: Plan | None = None
    minimal: bool = False
    reasons: tuple[Reason, ...] = ()
    limit: str | None = None
    bounds: tuple[int, int | None] = (0, None)


Planner: TypeAlias = Callable[[Problem], PlannerAnswer]
Impossible: TypeAlias = Callable[[Problem], tuple[Reason, ...]]


@dataclass(frozen=True)
class Pending:
    """A wish that cannot be fulfilled for now, and why."""

    goal: Goal
    reasons: tuple[Reason, ...]
    then: Goal | None = None
    """For a pair of ``before``: the goal that was to come second."""


@dataclass(frozen=True)
class Wanted:
    """The wishes in one state: ``must`` always, ``wishes`` (oldest first) where possible."""

    must: tuple[Goal, ...] = ()
    wishes: tuple[Goal, ...] = ()
    before: tuple[tuple[Goal, Goal], ...] = ()
    waiting: tuple[Pending, ...] = ()
    everybody: bool = False


@dataclass(frozen=True)
class Agenda:
    """The goals that were given, their order, and how long each wish has been there.

    ``goals`` empty means to serve everybody.  ``first_held`` says for the goals of ``before`` at
    which moment (a count of states) they first held.  ``ages`` gives older wishes smaller numbers.
    """

    goals: tuple[Goal, ...] = ()
    before: tuple[tuple[Goal, Goal], ...] = ()
    instant_kitchen: bool = False
    first_held: tuple[tuple[Goal, int], ...] = ()
    moment: int = 0
    ages: tuple[tuple[Goal, int], ...] = field(default=(), compare=False)

    def noticed(self, holds: Callable[[Goal], bool]) -> Agenda:
        """Returns the agenda after one more state was lived through, of which ``holds`` tells."""
        held = dict(self.first_held)
        for goal in {goal: None for pair in self.before for goal in pair}:
            if goal not in held and holds(goal):
                held[goal] = self.moment
        return replace(self, first_held=tuple(held.items()), moment=self.moment + 1)

    def wanted(self, state: State, layout: Layout) -> Wanted:
        """Returns the wishes in ``state``: parties whole, wishes by age."""
        waiting: list[Pending] = []
        pairs, owed = self._open_pairs(state, waiting)
        if not self.goals:
            wishes = serve_everybody(state, layout, self.instant_kitchen, {})
            return Wanted(owed, self._by_age(wishes), pairs, tuple(waiting), everybody=True)
        must, wishes_ = list(owed), []
        for goal in self.goals:
            whole = whole_party(goal, state)
            if whole is None:
                reason = Reason(f"{goal.party[0]} is not inside yet", goal.where)
                waiting.append(Pending(goal, (reason,)))
            elif goal.kind == "serve":
                wishes_.append(whole)
            else:
                must.append(whole)
        return Wanted(tuple(dict.fromkeys(must)), self._by_age(wishes_), pairs, tuple(waiting))

    def aged(self, wanted: Wanted) -> Agenda:
        """Returns the agenda that remembers since when each of these wishes has been there."""
        known = dict(self.ages)
        fresh = max(known.values(), default=0) + 1
        ages = tuple(
            (goal, known.get(goal, fresh + index)) for index, goal in enumerate(wanted.wishes)
        )
        return self if ages == self.ages else replace(self, ages=ages)

    def without_guests(self, gone: Sequence[str]) -> tuple[Agenda, tuple[Goal, ...]]:
        """Returns the agenda once these customers have left, and the goals that ended with them."""
        left = set(gone)

        def ends(goal: Goal) -> bool:
            return bool(left.intersection(goal.party))

        closed = tuple(goal for goal in self.goals if ends(goal))
        pairs = tuple(pair for pair in self.before if not any(map(ends, pair)))
        goals = tuple(goal for goal in self.goals if not ends(goal))
        return replace(self, goals=goals, before=pairs), closed

    def _by_age(self, wishes: Sequence[Goal]) -> tuple[Goal, ...]:
        known = dict(self.ages)
        youngest = max(known.values(), default=0) + 1
        return tuple(sorted(wishes, key=lambda goal: known.get(goal, youngest)))

    def _open_pairs(
        self, state: State, waiting: list[Pending]
    ) -> tuple[tuple[tuple[Goal, Goal], ...], tuple[Goal, ...]]:
        """Returns the pairs still to be reached in order, and second goals whose first was reached."""
        held = dict(self.first_held)
        pairs: list[tuple[Goal, Goal]] = []
        owed: list[Goal] = []
        for first, then in self.before:
            if then in held:
                if held.get(first, self.moment) >= held[then]:
                    reason = Reason(
                        f"{goal_text(then)} was reached before {goal_text(first)}", then.where
                    )
                    waiting.append(Pending(first, (reason,), then))
                continue
            whole = whole_party(first, state), whole_party(then, state)
            if whole[0] is None or whole[1] is None:
                reason = Reason("not everybody of whom it speaks is inside", first.where)
                waiting.append(Pending(first, (reason,), then))
            elif first in held:
                owed.append(whole[1])
            else:
                pairs.append((whole[0], whole[1]))
        return tuple(pairs), tuple(owed)


def whole_party(goal: Goal, state: State) -> Goal | None:
    """Returns the goal with the whole party of the customers it names.

    None when that is not inside.
    """
    if not goal.party:
        return goal
    party = state.party_of(goal.party[0])
    return None if party is None else replace(goal, party=party)


def still_pending(wanted: Wanted, pending: Sequence[Pending]) -> tuple[Wanted, tuple[Pending, ...]]:
    """Returns the wishes less those that had to wait already, and those."""
    waiting = [p for p in pending if p.then is None and p.goal in wanted.wishes]
    waiting += [p for p in pending if p.then is not None and (p.goal, p.then) in wanted.before]
    goals = {p.goal for p in waiting if p.then is None}
    pairs = {(p.goal, p.then) for p in waiting if p.then is not None}
    kept = replace(
        wanted,
        wishes=tuple(goal for goal in wanted.wishes if goal not in goals),
        before=tuple(pair for pair in wanted.before if pair not in pairs),
    )
    return kept, (*wanted.waiting, *waiting)


@dataclass(frozen=True)
class Selection:
    """A selection of wishes: the problem, the planner's answer to it, and what must wait."""

    problem: Problem
    answer: PlannerAnswer
    pending: tuple[Pending, ...]


def choose(
    wanted: Wanted, pose: Callable[[Wanted], Problem], planner: Planner, impossible: Impossible
) -> Selection:
    """Returns everything that is wanted, or what room there is for, oldest wishes first.

    ``pose`` makes the problem of what is wanted; ``impossible`` is a quick test that gives reasons
    only where no plan of any length exists.  What it does not see, the planner's verdict decides.
    """
    asked = _Asked(pose, planner)
    why = impossible(asked.problem(wanted))
    if why:
        asked.note(wanted, PlannerAnswer("no_plan", reasons=why))
    answer = asked.answer(wanted)
    selection = Selection(asked.problem(wanted), answer, wanted.waiting)
    if answer.status != "no_plan" or not wanted.wishes:
        return selection

    def barred(trial: Wanted) -> tuple[Reason, ...]:
        return impossible(asked.problem(trial))

    for verdict in (barred, asked.verdict):
        kept, pending = _make_room(wanted, verdict)
        if kept is None:
            return replace(selection, pending=wanted.waiting)
        answer = asked.answer(kept)
        selection = Selection(asked.problem(kept), answer, (*wanted.waiting, *pending))
        if answer.status != "no_plan":
            return selection
    return replace(selection, pending=wanted.waiting)


class _Asked:
    """Problems and answers of one decision, each asked for once: nothing is searched for twice."""

    def __init__(self, pose: Callable[[Wanted], Problem], planner: Planner) -> None:
        self._pose, self._planner = pose, planner
        self._problems: dict[Wanted, Problem] = {}
        self._answers: dict[Wanted, PlannerAnswer] = {}

    def problem(self, wanted: Wanted) -> Problem:
        """Returns the problem of what is wanted."""
        if wanted not in self._problems:
            self._problems[wanted] = self._pose(wanted)
        return self._problems[wanted]

    def note(self, wanted: Wanted, answer: PlannerAnswer) -> None:
        """Keeps an answer that took no search."""
        self._answers[wanted] = answer

    def answer(self, wanted: Wanted) -> PlannerAnswer:
        """Returns the planner's answer to what is wanted."""
        if wanted not in self._answers:
            self._answers[wanted] = self._planner(self.problem(wanted))
        return self._answers[wanted]

    def verdict(self, wanted: Wanted) -> tuple[Reason, ...]:
        """Returns why there is no plan for what is wanted, or none that was found in time."""
        answer = self.answer(wanted)
        if answer.plan is not None:
            return ()
        if answer.status == "undecided":
            return (Reason("no plan that does this, too, was found in time"),)
        return answer.reasons or (Reason("no plan of any length exists"),)


def _make_room(
    wanted: Wanted, verdict: Callable[[Wanted], tuple[Reason, ...]]
) -> tuple[Wanted | None, list[Pending]]:
    """Returns the oldest wishes that are possible together, and the others.

    None when not even none is.
    """
    kept = replace(wanted, wishes=(), before=() if wanted.everybody else wanted.before)
    pending: list[Pending] = []
    if (kept.must or kept.before) and verdict(kept):
        return None, pending
    for goal in wanted.wishes:
        trial = replace(kept, wishes=(*kept.wishes, goal))
        if found := verdict(trial):
            pending.append(Pending(goal, found))
        else:
            kept = trial
    for pair in wanted.before if wanted.everybody else ():
        trial = replace(kept, before=(*kept.before, pair))
        if found := verdict(trial):
            pending.append(Pending(pair[0], found, pair[1]))
        else:
            kept = trial
    return kept, pending
