"""``waiter plan``: a minimal plan, with the proof that no shorter one exists."""

from __future__ import annotations

import time
from enum import Enum
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
    WatchOption,
    named_file,
    paths_to_watch,
)

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.model.problem import Problem
    from waiter_cli.planning.answer import PlanAnswer

__all__ = ["plan"]


class ShownStage(str, Enum):
    """The stages that ``--show`` prints."""

    sparc = "sparc"
    tokens = "tokens"
    ast = "ast"
    sorts = "sorts"
    asp = "asp"


@grouped(
    {
        "Options": ("layout", "scenario", "enter", "bill", "goal", "as_json"),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("certificate", "show", "horizon", "watch", "verbose"),
    }
)
@folded
def plan(
    situation: Situation,
    options: PlanOptions,
    as_json: JsonOption = False,
    show: Annotated[
        Optional[ShownStage],
        typer.Option("--show", help="Print one stage as text instead of planning."),
    ] = None,
    horizon: Annotated[
        int, typer.Option("--horizon", min=0, metavar="H", help="The horizon of --show.")
    ] = 10,
    certificate: Annotated[
        Optional[str],
        typer.Option(
            "--certificate",
            callback=named_file,
            metavar="FILE",
            help="Write a proof of the lower bound that can be checked without a solver.",
        ),
    ] = None,
    watch: WatchOption = False,
    verbose: VerboseOption = False,
) -> int:
    """Find a minimal plan, with the proof that no shorter one exists.

    \b
    Examples:
      waiter plan --layout report --enter 1
      waiter plan --scenario b2 --json
      waiter plan --layout report --goal 'at: n6' --search linear -v
      waiter plan --layout report --scenario b1 --watch
      waiter plan --layout report --scenario b1 --certificate b1.json
    """

    def once() -> int:
        if show is not None:
            return _show(show, situation, options, horizon, as_json=as_json)
        return _plan(situation, options, certificate, as_json=as_json, verbose=verbose)

    if watch:
        from waiter_cli.commands.watching import watch as run_again

        paths = paths_to_watch((situation.layout, "layout"), (situation.scenario, "scenario"))
        return run_again(paths, once, as_json=as_json)
    return once()


def _plan(
    situation: Situation,
    options: PlanOptions,
    certificate: str | None,
    *,
    as_json: bool,
    verbose: bool,
) -> int:
    """Plans and prints the answer."""
    from sparc.limits import begin
    from waiter_cli.commands.search_report import searching

    begin(options.time_limit, options.memory_limit)
    deadline = None if options.time_limit is None else time.monotonic() + options.time_limit
    problem = situation.load(several=True)
    rules, backend = options.load_domain(), options.load_translator()
    if certificate is not None:
        _require_certifiable(problem, rules)
    with searching() as listener:
        answer = waiter_cli.plan(
            problem, domain=rules, translator=backend, listener=listener, **options.limits()
        )
    if verbose:
        from waiter_cli.commands.search_report import print_stages

        print_stages(answer.result.stages)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json(answer.document())
    else:
        _print(answer)
    if certificate is not None:
        _write_certificate(answer, certificate, deadline)
    return answer.exit_code


def _require_certifiable(problem: Problem, rules: Domain) -> None:
    """Raises `InputError` where no certificate could be made of a plan, whatever it is."""
    from waiter_cli.errors import Fault, InputError, Where

    if not problem.layout.agents and rules.built_in and not problem.has_own_words:
        return
    place, hint = Where("--certificate"), "leave it out here"
    told = "it is about a plan of one robot by the built-in rules"
    raise InputError([Fault(place, told, hint)])


def _write_certificate(answer: PlanAnswer, path: str, deadline: float | None) -> None:
    """Writes the proof that no plan is shorter, and says on the error stream how far it goes."""
    import json
    import sys

    from waiter_cli.console.output import say
    from waiter_cli.file_access.atomic import write_whole
    from waiter_cli.flow_bounds.certificate import make_certificate

    if answer.plan is None:
        say(f"{path} was not written: there is no plan of which it could be a proof.", sys.stderr)
        return
    document = make_certificate(answer.problem, answer.plan, deadline)
    if document is None:
        say(f"{path} was not written: the programme proved nothing.", sys.stderr)
        return
    write_whole(path, json.dumps(document) + "\n")
    say(f"{path} proves that no plan has fewer than {document['bound']} steps.", sys.stderr)


def _show(
    stage: ShownStage, situation: Situation, options: PlanOptions, horizon: int, *, as_json: bool
) -> int:
    """Prints one stage of the problem's program as text."""
    from sparc.limits import begin
    from waiter_cli.console.output import print_document
    from waiter_cli.domain_execution.domain_rules import believed
    from waiter_cli.encoding.domains import domain_for
    from waiter_cli.encoding.template import fill_template

    begin(options.time_limit, options.memory_limit)
    if as_json:
        from waiter_cli.errors import InputError

        raise InputError("--show prints text, --json a document", "leave one of them out")
    problem = situation.load(several=True)
    rules, backend = options.load_domain(), options.load_translator()
    source = fill_template(domain_for(problem, rules).template, believed(problem, rules), horizon)
    if stage is ShownStage.sparc:
        print_document(source.text + "\n")
    elif stage is ShownStage.asp:
        program = backend.translate(source)
        print_document(f"{program.text}\n{program.show}\n")
    else:
        from sparc.stages import show_stage

        print_document(show_stage(stage.value, source) + "\n")
    return 0


def _print_together(answer: PlanAnswer) -> None:
    """Prints what several robots do; in words where it does not fit the terminal as a table of robots."""
    from waiter_cli.commands.joint_table import fits, joint_rows, print_joint
    from waiter_cli.console.output import print_table

    names = [name for name, _ in answer.problem.layout.agents]
    steps = answer.steps()
    actions = [action for action, _, _ in steps]
    if answer.states and not fits(("step", *names), joint_rows(names, actions)):
        lines = [(str(a.step), a.text, words, place) for a, words, place in steps]
        print_table(("step", "action", "in words", "at"), lines, prose=2)
    else:
        print_joint(names, actions)


def _print(answer: PlanAnswer) -> None:
    from waiter_cli.commands.search_report import print_diagnoses
    from waiter_cli.console.output import print_table, say
    from waiter_cli.console.styling import styled
    from waiter_cli.model.wording import counted
    from waiter_cli.planning.search_results import SearchStatus

    result, layout = answer.result, answer.problem.layout
    found = answer.plan
    if result.status in (SearchStatus.PLAN, SearchStatus.UNDECIDED) and found is not None:
        rows = [
            (str(action.step), action.text, words, place) for action, words, place in answer.steps()
        ]
        if rows and layout.agents:
            _print_together(answer)
        elif rows and answer.states:
            print_table(("step", "action", "in words", "at"), rows, prose=2)
        elif rows:  # of rules that say nothing of words and places
            print_table(("step", "action"), [row[:2] for row in rows], prose=1)
        steps = counted(found.horizon, "step")
        if not rows and found.horizon == 0:
            say(f"Nothing to do on {layout.name}: the goals hold already.")
        else:
            say(f"\n{styled(steps, 'bold')} on {layout.name}. {answer.proof_line()}")
        if line := answer.ties_line():
            say(line)
        if answer.refusal:
            say(f"It was not executed: {answer.refusal[0]}.")
        print_diagnoses(answer.diagnosis)
        return
    say(styled(answer.headline(), "bold"))
    for line in answer.reason_lines():
        say(f"  {line}")
    if result.status is SearchStatus.NO_PLAN and not any(r.where for r in result.reasons):
        say(
            "waiter explain, with the same options, says what it takes together and what would help."
        )
    print_diagnoses(answer.diagnosis)
