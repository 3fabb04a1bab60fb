"""``waiter explain``: why there is no plan, what would help, what another action would cost."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Optional

import typer

import waiter_cli
from waiter_cli.command_line.command import grouped
from waiter_cli.command_line.folding import folded
from waiter_cli.commands.options import (
    JsonOption,
    PlanOptions,
    Situation,
    VerboseOption,
)

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.errors import Where
    from waiter_cli.explanation.explain import Explanation, Foil
    from waiter_cli.model.problem import Problem
    from waiter_cli.planning.search_results import SearchResult
    from waiter_cli.translators.base import Translator

__all__ = ["explain"]


@grouped(
    {
        "Options": ("layout", "scenario", "enter", "bill", "goal", "observe", "why_not", "as_json"),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("verbose",),
    }
)
@folded
def explain(
    situation: Situation,
    options: PlanOptions,
    why_not: Annotated[
        Optional[str],
        typer.Option("--why-not", metavar="ACTION", help="An action: what would doing it cost?"),
    ] = None,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> int:
    """Say why there is no plan, why what was observed cannot be, or what another action would cost.

    \b
    Examples:
      waiter explain --scenario blocked_aisle
      waiter explain --scenario b1 --why-not 'seat(agent,c1,table2)'
      waiter explain --layout two.yaml --enter 2 --why-not 'pick(r2,c1)'
    """
    from sparc.limits import begin

    begin(options.time_limit, options.memory_limit)
    problem = situation.load(several=True)
    backend, rules = options.load_translator(), options.load_domain()
    if why_not is not None and not problem.contradictions:
        return _price(problem, why_not, backend, rules, options, as_json, verbose)
    return _explain(problem, backend, rules, options, as_json, verbose)


def _explain(
    problem: Problem, backend: Translator, rules: Domain, options: PlanOptions, as_json: bool, verbose: bool
) -> int:  # fmt: skip
    """Prints why there is no plan, or why it is not shorter."""
    from waiter_cli.commands.search_report import print_stages, searching
    from waiter_cli.console.output import print_json
    from waiter_cli.errors import Exit
    from waiter_cli.planning.search_results import SearchStatus

    with searching() as listener:
        explanation = waiter_cli.explain(
            problem, domain=rules, translator=backend, listener=listener, **options.limits()
        )
    if verbose:
        print_stages(explanation.result.stages)
    if as_json:
        print_json(explanation.document())
    else:
        _print(explanation)
    return Exit.UNDECIDED if explanation.result.status is SearchStatus.UNDECIDED else Exit.OK


def _price(
    problem: Problem, text: str, backend: Translator, rules: Domain, options: PlanOptions,
    as_json: bool, verbose: bool,
) -> int:  # fmt: skip
    """Prints what another action would cost."""
    from waiter_cli.commands.search_report import print_stages, searching
    from waiter_cli.console.output import print_json
    from waiter_cli.errors import Exit
    from waiter_cli.explanation.foil_reader import read_foil

    action = read_foil(text, problem, rules)
    with searching() as listener:
        foil = waiter_cli.why_not(
            problem, action, domain=rules, translator=backend, listener=listener,
            **options.limits(),
        )  # fmt: skip
    if verbose:
        print_stages((*foil.best.stages, *foil.forced.stages))
    if as_json:
        print_json(foil.document())
    else:
        _print_foil(foil, [name for name, _ in problem.layout.agents])
    return Exit.OK if foil.limit is None else Exit.UNDECIDED


def _line(message: str, where: Where | None) -> str:
    return f"  {where}: {message}" if where else f"  {message}"


def _print(found: Explanation) -> None:
    from waiter_cli.commands.search_report import print_diagnoses
    from waiter_cli.console.output import say
    from waiter_cli.console.styling import styled
    from waiter_cli.model.wording import counted
    from waiter_cli.planning.search_results import SearchStatus

    result = found.result
    if result.status is SearchStatus.PLAN:
        assert result.plan is not None
        steps = counted(result.plan.horizon, "step")
        say(f"There is a plan of {steps}; waiter plan shows it.")
        _print_not_sooner(found)
        say("Ask about an action that it does not have with --why-not 'ACTION'.")
        print_diagnoses(found.diagnoses)
        return
    if result.status is SearchStatus.UNDECIDED:
        say(f"Undecided ({_limit(result)}): nothing is proved, so there is nothing to explain.")
        return
    contradiction = result.status is SearchStatus.CONTRADICTION
    head = "What was observed cannot be:" if contradiction else "No plan of any length exists:"
    say(styled(head, "bold"))
    for reason in found.reasons:
        say(_line(reason.message, reason.where))
    print_diagnoses(found.diagnoses)
    several = len(found.conflicts) > 1
    if several:
        say(
            styled("Several things leave no plan, each by itself; one of each must change.", "bold")
        )
    for number, causes in enumerate(found.conflicts, 1):
        one = len(causes) == 1
        lead = "Without this there is a plan:" if one else "All of these together leave no plan:"
        if several:
            lead = f"{number}. " + ("This leaves no plan:" if one else lead)
        say(styled(lead, "bold"))
        for cause in causes:
            say(_line(cause.message, cause.where))
    if found.helped:
        say(styled("Any one of these would help (checked by planning):", "bold"))
        for helped in found.helped:
            steps = f"a plan of {counted(helped.horizon, 'step')}"
            say(_line(f"{helped.change.message}: {steps}", helped.change.where))
    elif not contradiction and not found.diagnoses:
        say("No single change that was tried would help.")


def _print_not_sooner(found: Explanation) -> None:
    """Says what shows that no plan is shorter, and what each wish costs beside the others."""
    from waiter_cli.console.output import say
    from waiter_cli.model.wording import goal_text

    result = found.result
    assert result.plan is not None
    steps = result.plan.horizon
    if result.minimal and steps:
        proof = "a lower bound proves it" if result.proof == "bound" else "solving refuted it"
        say(f"None is done in {steps - 1}: {proof}.")
    for wish in found.wishes:
        costs = steps - wish.without
        said = f"costs {costs} of them" if costs else "costs nothing beside the others"
        say(f"  {goal_text(wish.goal)} {said}: {wish.without} without it")


def _print_foil(foil: Foil, robots: list[str]) -> None:
    from waiter_cli.commands.joint_table import print_joint
    from waiter_cli.console.output import say

    text = foil.action.text
    if foil.limit is not None:
        say(f"Undecided ({_limit(foil.undecided)}): nothing is proved of plans with {text}.")
    elif foil.best.plan is None:
        say("There is no plan at all; waiter explain without --why-not says why.")
    elif foil.price is not None:
        assert foil.forced.plan is not None
        best, forced = foil.best.plan, foil.forced.plan
        there = text in [action.text for action in best.actions]
        if (
            robots and foil.price == 0
        ):  # whether the plan that `waiter plan` shows has it is not known
            say(f"{text} costs nothing: a minimal plan of {best.horizon} steps has it.")
        elif there:
            say(f"{text} is part of a minimal plan of {best.horizon} steps.")
        elif foil.price == 0:
            say(f"{text} costs nothing: another minimal plan of {best.horizon} steps has it.")
        else:
            say(
                f"{text} costs {foil.price} more: {forced.horizon} steps instead of {best.horizon}."
            )
        if robots:
            print_joint(robots, forced.actions)
        elif not there:
            say("  " + " ".join(action.text for action in forced.actions), hang=0)
    elif foil.conflict is not None:
        say(foil.conflict[0].upper() + foil.conflict[1:] + ".")


def _limit(result: SearchResult | None) -> str:
    """Returns the option of the limit that was reached first."""
    assert result is not None
    if result.limit == "max_steps":
        return f"--max-steps {result.max_steps}"
    return "--time-limit" if result.limit == "time" else result.limit or "a limit"
