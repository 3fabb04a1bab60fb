"""``waiter validate``: plays a plan file step by step without any ASP and says whether it is legal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Optional

import typer

from waiter_cli.command_line.completion import names_of
from waiter_cli.commands.options import JsonOption, LayoutOption, ScenarioOption, Situation

if TYPE_CHECKING:
    from waiter_cli.files.plan_reader import PlanDocument
    from waiter_cli.model.problem import Problem
    from waiter_cli.rules.rulebook import Rulebook
    from waiter_cli.rules.validator import Verdict

__all__ = ["validate"]

PlanArgument = Annotated[
    str, typer.Argument(metavar="PLAN.json", help="What waiter plan --json printed; - is stdin.")
]

OwnDomainOption = Annotated[
    Optional[str],
    typer.Option(
        "--domain",
        metavar="NAME",
        autocompletion=names_of("domain"),
        help="Play it by this domain's own program; unless told, by that of the plan's own domain.",
    ),
]


def validate(
    plan_file: PlanArgument,
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    domain: OwnDomainOption = None,
    as_json: JsonOption = False,
) -> int:
    """Play a plan by the rules of the restaurant: is every step legal, are the goals reached?

    The plan starts from its own initial state and is held to its own goals, or to those of
    --scenario.  A plan made with a domain of your own is played by that domain.  Exit code 0:
    valid; 3: not.

    \b
    Examples:
      waiter validate --layout report plan.json
      waiter plan --scenario b1 --json | waiter validate -
    """
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.files.plan_reader import read_plan_file
    from waiter_cli.problems.plan_file import judge

    if plan_file == "-" and scenario == "-":
        raise InputError("plan and scenario cannot both come from standard input", "name a file")
    document = read_plan_file(plan_file)
    problem = _problem(document, layout, scenario)
    rules = _rules(document, problem, domain)
    verdict = judge(document, problem, own=scenario is None, rules=rules)
    if as_json:
        from waiter_cli.console.output import print_json
        from waiter_cli.files.documents import verdict_document

        print_json(verdict_document(problem, document.plan, verdict, rules))
    else:
        _print(problem, verdict, _by(rules))
    valid = verdict.valid and not problem.contradictions
    return Exit.OK if valid else Exit.PROVED


def _problem(document: PlanDocument, layout: str | None, scenario: str | None) -> Problem:
    """Returns what the plan is held to: the scenario where one is given, else the file's own words."""
    if scenario is not None:
        return Situation(layout, scenario).load(several=True)
    from waiter_cli.files.layout_reader import read_layout_file
    from waiter_cli.problems.plan_file import problem_of

    return problem_of(document, None if layout is None else read_layout_file(layout, several=True))


def _rules(document: PlanDocument, problem: Problem, domain: str | None) -> Rulebook:
    """Returns what the plan is played by: a domain that was named, or of the user's own that it remembers."""
    from waiter_cli.encoding.domains import find_domain, require_plans
    from waiter_cli.rules.rulebook import HOUSE

    if domain is not None:
        found = require_plans(find_domain(domain))
    elif document.domain is not None and (_is_own(document) or problem.has_own_words):
        from waiter_cli.problems.from_options import domain_of

        found = domain_of(document)
    elif problem.has_own_words:
        from waiter_cli.errors import Fault, InputError, Where

        message = "the plan speaks of fluents, and remembers no domain"
        raise InputError([Fault(Where(document.name), message, "give --domain FILE")])
    else:
        return HOUSE
    from waiter_cli.domain_execution.domain_rules import DomainRules, rules_for

    return DomainRules(found) if domain is not None else rules_for(problem, found)


def _is_own(document: PlanDocument) -> bool:
    """Returns whether a plan was made with a domain of the user's own."""
    from waiter_cli.encoding.domains import KNOWN_IN_PYTHON

    memory = document.domain_file
    return (
        memory is not None and memory.path is not None
    ) or document.domain not in KNOWN_IN_PYTHON


def _by(rules: Rulebook) -> str:
    from waiter_cli.rules.rulebook import HOUSE

    return "" if rules is HOUSE else ", by its domain"


def _print(problem: Problem, verdict: Verdict, by: str) -> None:
    """Prints the verdict for a person."""
    from waiter_cli.console.output import say
    from waiter_cli.console.styling import styled
    from waiter_cli.files.documents import verdict_reasons
    from waiter_cli.model.wording import counted

    steps = len(verdict.states) - 1
    played = counted(steps, "step")
    reasons = verdict_reasons(problem, verdict)
    if not reasons:
        say(f"{styled('valid', 'bold green')}: {played}, and all goals hold at the end{by}")
    else:
        say(f"{styled('invalid', 'bold red')}: {played} played{by}")
        for reason in reasons:
            place = f"{reason['file']}:{reason['line']}: " if reason["line"] else ""
            say(f"  {place}{reason['message']}")
    for note in verdict.notes:
        say(f"  note: {note}")
