"""Explains why there is no plan and what would help, or what a foil costs. `Problem`
→ `Explanation`.

Every word is checked, by planning or by a plan that the rules judge: each cause of a set is necessary, and each set suffices, all other
causes taken away; each change that is proposed does help.  Entry points
`explain` and `explain_foil`.
"""

from __future__ import annotations

import time
from dataclasses import replace
from itertools import islice
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds import Bounds, find_bounds
from waiter_cli.encoding.domains import Domain
from waiter_cli.explanation.causes_and_changes import Cause, Relaxation, changes_for
from waiter_cli.explanation.conflicts import find_conflicts
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal
from waiter_cli.model.wording import goal_text
from waiter_cli.planning.search_results import SearchOptions, SearchResult, SearchStatus
from waiter_cli.translators.base import Translator

__all__ = ["Explanation", "Foil", "Helped", "WishPrice", "explain", "explain_foil"]

_CHANGES_TRIED = 60
_MOST_WISHES = 12


@dataclass(frozen=True)
class Helped:
    """A change that was verified: with it, there is a plan of that many steps."""

    change: Relaxation
    horizon: int


@dataclass(frozen=True)
class WishPrice:
    """A wish, and the least number of steps of a plan for all the others."""

    goal: Goal
    without: int


@dataclass(frozen=True)
class Explanation:
    """An explanation of ``result``.

    ``reasons`` says it in words; ``conflicts`` are minimal sets of things in the user's files, each
    of which leaves no plan by itself, all else taken away.  Where there is one set, there is a plan
    without any one of its causes; where there are several, one of each set must go.  ``helped`` lists changes after which there is a plan, the smallest first.
    ``diagnoses`` says how what was observed can have come about, where it is a surprise.
    ``wishes`` says of a plan why it is not shorter: what each wish costs beside the others.
    """

    result: SearchResult
    reasons: tuple[Reason, ...]
    conflicts: tuple[tuple[Cause, ...], ...] = ()
    helped: tuple[Helped, ...] = ()
    diagnoses: tuple[Diagnosis, ...] = ()
    wishes: tuple[WishPrice, ...] = ()

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Returns the causes of all conflicts, each once."""
        return tuple(dict.fromkeys(cause for causes in self.conflicts for cause in causes))

    def document(self) -> dict[str, Any]:
        """Returns the JSON of ``waiter explain``."""
        from waiter_cli.files.documents import message_document

        undecided = self.result.status is SearchStatus.UNDECIDED
        return {
            "status": self.result.status.value,
            **({"limit": self.result.limit} if undecided else {}),
            "bounds": list(self.result.bounds),
            "reasons": [message_document(reason.message, reason.where) for reason in self.reasons],
            "causes": [message_document(cause.message, cause.where) for cause in self.causes],
            "conflicts": [
                [message_document(cause.message, cause.where) for cause in causes]
                for causes in self.conflicts
            ],
            "changes": [
                {**message_document(h.change.message, h.change.where), "horizon": h.horizon}
                for h in self.helped
            ],
            "not_sooner": [{"goal": goal_text(w.goal), "without": w.without} for w in self.wishes],
            "diagnosis": [{"cost": d.cost, "events": list(d.text)} for d in self.diagnoses],
        }


@dataclass(frozen=True)
class Foil:
    """The cost of doing ``action``: the best plan, and the best one in which it occurs.

    ``conflict`` says why it never can be, when no plan has it.
    """

    action: Action
    best: SearchResult
    forced: SearchResult
    conflict: str | None = None

    @property
    def price(self) -> int | None:
        """Returns steps more than the best plan.

        None when the foil, or any plan, is impossible or not known.
        """
        if self.limit is not None or self.best.plan is None or self.forced.plan is None:
            return None
        return self.forced.plan.horizon - self.best.plan.horizon

    @property
    def undecided(self) -> SearchResult | None:
        """Returns the search that a limit ended; None where both were settled."""
        undecided = SearchStatus.UNDECIDED
        return next((r for r in (self.best, self.forced) if r.status is undecided), None)

    @property
    def limit(self) -> str | None:
        """Returns the limit that was reached before both searches had ended; None when they have."""
        return self.undecided.limit if self.undecided is not None else None

    def document(self) -> dict[str, Any]:
        """Returns the JSON of ``waiter explain --why-not``."""
        forced = self.forced.plan
        limit = self.limit
        return {
            "status": self.forced.status.value if limit is None else "undecided",
            **({"limit": limit} if limit is not None else {}),
            "foil": self.action.text,
            "horizon": self.best.plan.horizon if self.best.plan else None,
            "foil_horizon": forced.horizon if forced else None,
            "price": self.price,
            "conflict": self.conflict,
            "actions": [action.text for action in forced.actions] if forced else [],
        }


class _Planner:
    """Plans, again and again, until the time is up that all of it may take.

    ``undecided`` tells whether some search was cut short: then nothing follows from its result.
    """

    def __init__(self, translator: Translator, domain: Domain, options: SearchOptions) -> None:
        self._translator = translator
        self._domain = domain
        self._options = options
        self._start = time.monotonic()
        self.undecided = False

    def __call__(
        self, problem: Problem, required: Action | None = None, domain: Domain | None = None
    ) -> SearchResult:
        """Returns the minimal plan of ``problem``, of those in which ``required`` occurs.

        ``domain`` takes the place of the planner's own.
        """
        from waiter_cli.planning.strategies import find_minimal_plan

        options = self._options
        if options.time_limit is not None:
            left = max(0.0, self._start + options.time_limit - time.monotonic())
            options = replace(options, time_limit=left)
        if problem.layout.agents and required is None:
            options = replace(options, choose=False)  # its length is all that is told of it
        rules = self._domain if domain is None else domain
        result = find_minimal_plan(problem, self._translator, rules, options, required=required)
        self.undecided = self.undecided or result.status is SearchStatus.UNDECIDED
        return result

    def bounds(self, problem: Problem) -> Bounds | None:
        """Returns the bounds of ``problem``; None where they are not asked for or have no plan."""
        if (
            problem.has_own_words
            or problem.layout.agents
            or not self._domain.built_in
            or not self._options.use_bounds
            or problem.contradictions
        ):
            return None
        bounds, most = find_bounds(problem), self._options.max_steps
        if bounds.plan is None or (most is not None and bounds.plan.horizon > most):
            return None
        return bounds

    def solvable(self, problem: Problem, domain: Domain) -> bool:
        """Returns whether a plan by a domain exists, as far as that was settled.

        A plan that was put together and judged by the rules is enough: no program need accept it.
        """
        if self.bounds(problem) is not None:
            return True
        return self(problem, domain=domain).status is SearchStatus.PLAN

    def length(self, problem: Problem) -> int | None:
        """Returns the length of the plan that `__call__` returns, None where it returns none."""
        bounds = self.bounds(problem)
        if bounds is not None and bounds.plan is not None:
            if bounds.plan.horizon == bounds.lower:
                return bounds.lower
        result = self(problem)
        return result.plan.horizon if result.plan and result.status is SearchStatus.PLAN else None


def explain(
    problem: Problem, translator: Translator, domain: Domain, options: SearchOptions
) -> Explanation:
    """Returns why there is no plan, or that there is one; raises what planning raises."""
    plan = _Planner(translator, domain, options)
    result = plan(problem)
    if result.status is not SearchStatus.NO_PLAN:
        from waiter_cli.diagnosis.diagnose import explain_observations

        one = not problem.layout.agents  # what several robots may have seen is not explained
        diagnoses = explain_observations(problem) if one and problem.observations else ()
        wishes = _prices(problem, plan) if result.status is SearchStatus.PLAN else ()
        return Explanation(result, result.reasons, diagnoses=diagnoses, wishes=wishes)
    conflicts = find_conflicts(problem, domain, plan)
    if plan.undecided:  # what could not be settled in time may have a plan
        conflicts = ()
    return Explanation(result, result.reasons, conflicts, _helpful_changes(problem, plan))


def _prices(problem: Problem, plan: _Planner) -> tuple[WishPrice, ...]:
    """Returns the cost of each of several wishes: the length of a shortest plan without it."""
    if not 1 < len(problem.goals) <= _MOST_WISHES:
        return ()
    prices = []
    for goal in problem.goals:
        goals = tuple(other for other in problem.goals if other != goal)
        before = tuple(pair for pair in problem.before if goal not in pair)
        result = plan(replace(problem, goals=goals, before=before))
        if result.status is not SearchStatus.PLAN or result.plan is None or not result.minimal:
            return ()
        prices.append(WishPrice(goal, result.plan.horizon))
    return tuple(prices)


def _helpful_changes(problem: Problem, plan: _Planner) -> tuple[Helped, ...]:
    """Returns the first change of each kind that helps, verified; all tried are single changes."""
    helped: list[Helped] = []
    kinds: set[str] = set()
    for change in islice(changes_for(problem), _CHANGES_TRIED):
        if change.kind in kinds:
            continue
        length = plan.length(change.problem)
        if length is not None:
            kinds.add(change.kind)
            helped.append(Helped(change, length))
    return tuple(helped)


# ---------------------------------------------------------------- foils


def explain_foil(
    problem: Problem,
    foil: Action,
    translator: Translator,
    domain: Domain,
    options: SearchOptions,
) -> Foil:
    """Returns the cost of doing ``foil`` at some step; raises what planning raises."""
    plan = _Planner(translator, domain, options)
    best = plan(problem)
    forced = plan(problem, foil)
    conflict = None
    if forced.status is SearchStatus.NO_PLAN and best.plan is not None:
        if problem.layout.agents and domain.built_in:
            reason = forced.reasons[0].message
        elif domain.built_in and not problem.has_own_words:
            from waiter_cli.explanation.foil_conflict import find_conflict

            reason = find_conflict(problem, foil, best.plan)
        else:
            reason = _forbidden_at_once(problem, foil, domain)
        conflict = f"no plan that reaches the goals has {foil.text}: {reason}"
    return Foil(foil, best, forced, conflict)


def _forbidden_at_once(problem: Problem, foil: Action, domain: Domain) -> str:
    """Returns why an action that never can be done cannot be done now, by the domain's statements."""
    from waiter_cli.domain_execution.domain_rules import kept_rules
    from waiter_cli.errors import InputError
    from waiter_cli.rules.actions import Illegal

    never = "nothing that can come about from here lets it happen"
    rules = kept_rules(domain)
    try:
        rules.after(problem, rules.begin(problem), (foil,), 0)
    except Illegal as refusal:
        return f"{never}; at once, {refusal.reason}"
    except InputError:
        pass
    return never
