"""`Problem` → `PlanAnswer`: search, check by the independent validator, and the JSON of the contract.

Entry point `find_plan`.  Used by ``plan`` and by whatever else needs a plan that may be shown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sparc import limits
from waiter_cli.encoding.domains import Domain, domain_of_words
from waiter_cli.model.problem import Problem
from waiter_cli.planning.answer import PlanAnswer
from waiter_cli.planning.search_results import InvalidPlanError, SearchOptions, SearchStatus
from waiter_cli.planning.strategies import find_minimal_plan

if TYPE_CHECKING:
    from waiter_cli.translators.base import Translator

__all__ = ["explained", "find_plan"]


def find_plan(
    problem: Problem, translator: Translator, domain: Domain, options: SearchOptions
) -> PlanAnswer:
    """Searches for a plan, and checks it by executing it.

    Raises `InvalidPlanError` when the validator refuses the plan of a built-in domain, and what
    `find_minimal_plan` raises.
    """
    from waiter_cli.domain_execution.domain_rules import believed

    domain = domain_of_words(problem, domain)
    problem = believed(problem, domain)
    result = find_minimal_plan(problem, translator, domain, options)
    if result.plan is None:
        return PlanAnswer(problem, result, translator.name, domain)
    from waiter_cli.rules.validator import run

    if not domain.built_in:
        return _by_domain(PlanAnswer(problem, result, translator.name, domain))
    verdict = run(problem, result.plan)
    if not verdict.valid:
        raise InvalidPlanError(
            f"the plan {[action.text for action in result.plan.actions]} is refused by the "
            f"validator: {'; '.join(verdict.reasons)}"
        )
    return PlanAnswer(problem, result, translator.name, domain, verdict.states)


def _by_domain(answer: PlanAnswer) -> PlanAnswer:
    """Returns the answer, its plan executed by the domain itself; or why that could not be."""
    from dataclasses import replace

    from waiter_cli.domain_execution.domain_rules import kept_rules
    from waiter_cli.errors import InputError
    from waiter_cli.rules.validator import run

    assert answer.plan is not None
    try:
        verdict = run(answer.problem, answer.plan, kept_rules(answer.domain))
    except InputError as error:
        reasons = tuple(fault.message for fault in error.faults)
        return replace(answer, validated=False, refusal=reasons)
    if not verdict.valid:
        start = verdict.states[0]
        return replace(answer, validated=False, refusal=verdict.reasons, start=start)
    return replace(answer, states=verdict.states, start=verdict.states[0])


def explained(answer: PlanAnswer) -> PlanAnswer:
    """Returns the same answer, saying how what was observed can have come about, where that was settled."""
    if not answer.domain.built_in or answer.result.status is SearchStatus.UNDECIDED:
        return answer
    if (
        answer.problem.layout.agents
        or not answer.problem.observations
        or limits.reached() is not None
    ):
        return answer
    from dataclasses import replace

    from waiter_cli.diagnosis.diagnose import explain_observations

    return replace(answer, diagnosis=explain_observations(answer.problem))
