"""``waiter validate``: plays a plan file step by step without any ASP and says whether it is legal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from waiter_cli.commands.options import JsonOption, LayoutOption, ScenarioOption, Situation

if TYPE_CHECKING:
    from waiter_cli.files.plan_reader import PlanDocument
    from waiter_cli.model.problem import Problem
    from waiter_cli.rules.validator import Verdict

__all__ = ["validate"]

PlanArgument = Annotated[
    str, typer.Argument(metavar="PLAN.json", help="What waiter plan --json printed; - is stdin.")
]


def validate(
    plan_file: PlanArgument,
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    as_json: JsonOption = False,
) -> int:
    """Play a plan by the rules of the restaurant: is every step legal, are the goals reached?

    The plan starts from its own initial state and is held to its own goals, or to those of
    --scenario.  Exit code 0: valid; 3: not.

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
    verdict = judge(document, problem, own=scenario is None)
    if as_json:
        from waiter_cli.console.output import print_json
        from waiter_cli.files.documents import verdict_document

        print_json(verdict_document(problem, document.plan, verdict))
    else:
        _print(problem, verdict)
    valid = verdict.valid and not problem.contradictions
    return Exit.OK if valid else Exit.PROVED


def _problem(document: PlanDocument, layout: str | None, scenario: str | None) -> Problem:
    """Returns what the plan is held to: the scenario where one is given, else the file's own words."""
    if scenario is not None:
        return Situation(layout, scenario).load(several=True)
    from waiter_cli.files.layout_reader import read_layout_file
    from waiter_cli.problems.plan_file import problem_of

    return problem_of(document, None if layout is None else read_layout_file(layout, several=True))


def _print(problem: Problem, verdict: Verdict) -> None:
    """Prints the verdict for a person."""
    from waiter_cli.console.output import say
    from waiter_cli.console.styling import styled
    from waiter_cli.files.documents import verdict_reasons
    from waiter_cli.model.wording import counted

    steps = len(verdict.states) - 1
    played = counted(steps, "step")
    reasons = verdict_reasons(problem, verdict)
    if not reasons:
        say(f"{styled('valid', 'bold green')}: {played}, and all goals hold at the end")
    else:
        say(f"{styled('invalid', 'bold red')}: {played} played")
        for reason in reasons:
            place = f"{reason['file']}:{reason['line']}: " if reason["line"] else ""
            say(f"  {place}{reason['message']}")
    for note in verdict.notes:
        say(f"  note: {note}")
