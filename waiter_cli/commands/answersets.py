"""``waiter answersets``: answer sets in the order of time, of a program or of a restaurant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.command import grouped
from waiter_cli.commands.options import (
    BillOption,
    ConstantOption,
    DomainOption,
    EnterOption,
    GoalOption,
    JsonOption,
    LayoutOption,
    MaxStepsOption,
    MemoryLimitOption,
    ScenarioOption,
    SearchOption,
    SparcJarOption,
    Strategy,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
    VerboseOption,
)

if TYPE_CHECKING:
    from sparc.answer_sets import AnswerSet
    from sparc.source import Source
    from sparc.translation.asp_program import AspProgram
    from waiter_cli.answersets.enumerate import AnswerListing
    from waiter_cli.answersets.timeline import Filter, Order, Timeline
    from waiter_cli.answersets.writers import Writer
    from waiter_cli.planning.results import SearchOptions
    from waiter_cli.translators.base import Translator

__all__ = ["answersets"]

DIFF_SETS = 10  # how many answer sets --diff compares unless told

ProgramArgument = Annotated[
    Optional[str], typer.Argument(metavar="[PROGRAM]", help="A SPARC program; - is standard input.")
]
NumberOption = Annotated[
    Optional[int],
    typer.Option("-n", min=0, metavar="N", help="How many answer sets; 0 is all. [default: 1]"),
]
GrepOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--grep",
        "-e",
        metavar="REGEX",
        help="Keep the literals in which REGEX occurs; given again, in which one of them does.",
    ),
]
StepsOption = Annotated[
    Optional[str],
    typer.Option("--steps", metavar="A..B", help="Keep these steps: 2..5, 2.., ..5 or 2."),
]
OnlyOption = Annotated[
    Optional[list[str]],
    typer.Option("--only", metavar="NAMES", help="Keep these predicates, such as holds,occurs."),
]
ProjectionOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--projection",
        metavar="NAMES",
        help="One answer set for each way these predicates can come out.",
    ),
]
TimeSortOption = Annotated[
    Optional[str],
    typer.Option("--time-sort", metavar="SORT", help="The sort of steps, such as '#day'."),
]
HorizonOption = Annotated[
    Optional[int],
    typer.Option("--horizon", min=0, metavar="H", help="With a layout: H steps, not the fewest."),
]
WhyOption = Annotated[
    Optional[str],
    typer.Option(
        "--why",
        metavar="LITERAL",
        help="Instead: why LITERAL is in the first answer set, or why not.",
    ),
]


@grouped(
    {
        "Options": ("layout", "scenario", "number", "only", "grep", "as_json"),
        "Situation": ("enter", "bill", "goal", "horizon"),
        "What is shown": (
            "steps", "ignore_case", "invert", "negative", "projection", "count", "diff", "as_jsonl", "literal",
        ),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("verbose",),
    }
)  # fmt: skip
def answersets(
    program: ProgramArgument = None,
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    enter: EnterOption = None,
    bill: BillOption = None,
    goal: GoalOption = None,
    horizon: HorizonOption = None,
    constants: ConstantOption = None,
    number: NumberOption = None,
    grep: GrepOption = None,
    ignore_case: Annotated[
        bool, typer.Option("--ignore-case", "-i", help="--grep takes a for A.")
    ] = False,
    invert: Annotated[
        bool, typer.Option("--invert", help="Keep the literals that --grep would drop.")
    ] = False,
    steps: StepsOption = None,
    time_sort: TimeSortOption = None,
    flat: Annotated[
        bool, typer.Option("--flat", help="Order by terms alone, without time.")
    ] = False,
    only: OnlyOption = None,
    negative: Annotated[
        bool, typer.Option("--negative", help="Show negative literals too, such as -p(a).")
    ] = False,
    projection: ProjectionOption = None,
    count: Annotated[
        bool, typer.Option("--count", help="Only say how many answer sets there are.")
    ] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help=f"Show what tells them apart ({DIFF_SETS} unless -n).")
    ] = False,
    as_json: JsonOption = False,
    as_jsonl: Annotated[
        bool,
        typer.Option("--jsonl", help="A JSON object a line: each answer set, then a summary."),
    ] = False,
    literal: WhyOption = None,
    search: SearchOption = Strategy.binary,
    max_steps: MaxStepsOption = None,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
    domain: DomainOption = "restaurant",
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    verbose: VerboseOption = False,
) -> int:
    """Show answer sets in the order of time.

    A literal's step is its last argument where that has the sort of the last
    argument of holds, occurs or obs; in a program without these, where its sort
    is called #step, #time, #timestep, #moment or #t.

    \b
    Examples:
      waiter answersets blocks.sparc -n 0
      waiter answersets --scenario b1 --only occurs
      waiter answersets --layout report --enter 1 --grep isattable --steps 5..
    """
    import time

    from sparc.limits import begin
    from waiter_cli.answersets.timeline import Filter, Order, read_patterns, read_steps
    from waiter_cli.errors import InputError

    begin(time_limit, memory_limit)
    situation = (layout, scenario, enter, bill, goal, horizon, max_steps)
    if (program is None) == (layout is None and scenario is None):
        raise InputError("give either a PROGRAM or a --layout (or --scenario)", "see --help")
    if program is not None and any(given is not None for given in situation):
        raise InputError("a PROGRAM takes no options about a restaurant", "see --help")
    if program is None and constants:
        raise InputError("-c sets a constant of a PROGRAM", "see --help")
    if sum((count, diff, as_jsonl)) > 1 or (as_json and as_jsonl):
        raise InputError("--count, --diff and --jsonl exclude each other, as do --json and --jsonl")
    if literal is not None and (count or diff or as_jsonl or number is not None):
        raise InputError("--why explains one literal: it takes no -n, --count, --diff or --jsonl")
    if flat and (time_sort is not None or steps is not None):
        raise InputError("--flat is without time: it takes no --time-sort and no --steps")
    chosen = Filter(
        read_patterns(grep or (), ignore_case=ignore_case),
        invert,
        None if steps is None else read_steps(steps),
        _names(only),
    )
    limit = number if number is not None else 0 if count else DIFF_SETS if diff else 1
    deadline = None if time_limit is None else time.monotonic() + time_limit

    from waiter_cli.commands.options import load_translator

    backend = load_translator(translator, sparc_jar)
    from waiter_cli.answersets.writers import JsonWriter, TextWriter

    writer: Writer
    if as_json or as_jsonl:
        writer = JsonWriter(lines=as_jsonl)
    else:
        writer = TextWriter(chosen, negative)
    source: Source | None
    if program is not None:
        from waiter_cli.files.sparc_file import read_program

        source = read_program(program, constants)
    else:
        from waiter_cli.planning.results import SearchOptions

        given = (layout, scenario, enter, bill, goal)
        options = SearchOptions(search.value, max_steps, time_limit)
        source = _restaurant(given, domain, horizon, options, backend, writer, verbose)
    if source is None:
        return writer.exit_code
    if literal is not None:
        return _explained(source, literal, deadline, as_json)
    inconsistent = f"{source.name} is inconsistent: it has no answer set"
    if horizon is not None:
        inconsistent = f"there is no plan of at most {horizon} step{'' if horizon == 1 else 's'}"
    start = time.monotonic()
    order = Order(time_sort, flat)
    answers = _answers(source, backend, chosen, _names(projection), limit, deadline, writer, order)
    if answers is None:
        return writer.exit_code
    if verbose:
        lines = len(answers.program.text.splitlines())
        _say_stage("translate", f"{lines} line{'' if lines == 1 else 's'} of ASP", start)
        start = time.monotonic()
    writer.timeline = answers.timeline
    from contextlib import nullcontext

    from waiter_cli.translators.jar import jar_errors

    try:
        with jar_errors() if translator is TranslatorName.jar else nullcontext():
            if count:
                writer.count(answers, sum(1 for _ in answers), inconsistent)
            elif diff:
                writer.differences(answers, _comparable(answers), inconsistent)
            else:
                for answer_set in answers:
                    writer.write(answer_set)
                writer.finish(answers, inconsistent)
    except BrokenPipeError:  # as in "| head": whoever reads has seen enough
        import os

        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 0
    except OSError:  # nothing more can be written
        raise
    except Exception as error:
        if not writer.broken_off():
            raise
        from waiter_cli.boundary import report_error

        return report_error(error, as_json=False)
    except BaseException:  # a signal
        writer.broken_off()
        raise
    if verbose:
        _say_stage("list", "all" if answers.complete else "as far as asked for", start)
    return writer.exit_code


def _explained(source: Source, literal: str, deadline: float | None, as_json: bool) -> int:
    """Prints why a literal is in the first answer set, or not."""
    import time

    import sparc
    from waiter_cli.commands.sparc.why import print_why

    left = None if deadline is None else max(0.0, deadline - time.monotonic())
    return print_why(sparc.why(source, literal, time_limit=left), source.name, as_json=as_json)


def _comparable(answers: AnswerListing) -> list[AnswerSet]:
    """The answer sets, as many as can be held to be compared."""
    from waiter_cli.answersets.writers import COMPARED

    found, held = [], 0
    for answer_set in answers:
        found.append(answer_set)
        held += len(answer_set.literals) + 1
        if held > COMPARED:
            answers.limit_reached = "memory"
            break
    return found


def _say_stage(name: str, outcome: str, start: float) -> None:
    import time

    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.planning.results import SearchStage

    print_stages([SearchStage(name, outcome, time.monotonic() - start)])


def _names(options: list[str] | None) -> frozenset[str] | None:
    """The names of ``--only holds,occurs``, given once or more."""
    if options is None:
        return None
    words = (word.strip() for option in options for word in option.split(","))
    return frozenset(word for word in words if word)


# ------------------------------------------------------------------ what is solved


def _restaurant(
    situation: tuple[Any, ...],
    domain_name: str,
    horizon: int | None,
    options: SearchOptions,
    backend: Translator,
    writer: Writer,
    verbose: bool,
) -> Source | None:
    """The program of the restaurant at ``horizon``, or at the least one that has a plan.

    None when there is no such program; then the writer has said why.
    """
    from waiter_cli.commands.options import load_domain, load_problem
    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.encoding.template import fill_template
    from waiter_cli.planning.results import SearchStatus
    from waiter_cli.planning.strategies import find_minimal_plan

    problem = load_problem(*situation)
    rules = load_domain(domain_name)
    if problem.contradictions:
        writer.nothing("what was observed cannot be", problem.contradictions)
        return None
    if horizon is None:
        from dataclasses import replace

        from waiter_cli.commands.search_report import searching

        with searching() as listener:
            options = replace(options, listener=listener)
            result = find_minimal_plan(problem, backend, rules, options)
        if verbose:
            print_stages(result.stages)
        if result.status is SearchStatus.UNDECIDED and not (result.plan and result.minimal):
            writer.undecided(result.limit or "time", most=result.max_steps)
            return None
        if result.plan is None:
            writer.nothing("there is no plan, whatever its length", result.reasons)
            return None
        horizon = result.plan.horizon
    return fill_template(rules.template, problem, horizon)


def _answers(
    source: Source,
    backend: Translator,
    chosen: Filter,
    projection: frozenset[str] | None,
    limit: int,
    deadline: float | None,
    writer: Writer,
    order: Order,
) -> AnswerListing | None:
    """The answer sets of ``source``; None when a limit came first, and the writer has said so."""
    import time

    from waiter_cli.answersets.enumerate import AnswerListing, prepare

    left = None if deadline is None else max(0.01, deadline - time.monotonic())
    try:
        program, timeline = prepare(source, backend, time_limit=left, order=order)
    except MemoryError:
        writer.undecided("memory")
        return None
    except Exception as error:
        from sparc.solving.jar_translator import TranslationTimeout

        if not isinstance(error, TranslationTimeout):
            raise
        writer.undecided("time")
        return None
    _known(timeline, chosen.only, "--only")
    _known(timeline, projection, "--projection")
    if chosen.steps is not None and not timeline.has_steps:
        writer.note("no literal of this program has a step: --time-sort names the sort of steps.")
    if program.has_display:
        _shown(program, chosen.only, writer)
    return AnswerListing(
        program, timeline, chosen, projection=projection, limit=limit, deadline=deadline
    )


def _shown(program: AspProgram, only: frozenset[str] | None, writer: Writer) -> None:
    """Says which predicates of ``--only`` the display section hides."""
    from waiter_cli.answersets.enumerate import shown_names

    hidden = sorted((only or frozenset()) - shown_names(program))
    if hidden:
        writer.note(f"the display section of this program hides {', '.join(hidden)}.")


def _known(timeline: Timeline, names: frozenset[str] | None, option: str) -> None:
    """Raises `InputError` for a name that is no predicate of the program."""
    from difflib import get_close_matches

    from waiter_cli.errors import Fault, InputError

    faults = []
    for name in sorted(names or ()):
        if name not in timeline.arities and not name.startswith("#") and timeline.arities:
            close = get_close_matches(name, timeline.arities, 1)
            hint = f"did you mean {close[0]}?" if close else None
            faults.append(Fault(None, f"{option}: the program has no predicate {name}", hint))
    if faults:
        raise InputError(faults)
