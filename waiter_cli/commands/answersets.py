"""``waiter answersets``: answer sets in the order of time, of a program or of a restaurant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Optional

import typer

from waiter_cli.command_line.command import grouped
from waiter_cli.command_line.folding import folded
from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    PlanOptions,
    Situation,
    VerboseOption,
)
from waiter_cli.commands.print_answer_sets import (
    DIFF_SETS,
    ListingChoice,
    OutputForm,
    print_answer_sets,
)

if TYPE_CHECKING:
    from sparc.source import Source
    from waiter_cli.answersets.timeline import Filter
    from waiter_cli.answersets.writers import Writer
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.model.problem import Problem
    from waiter_cli.translators.base import Translator

__all__ = ["answersets"]

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
        help="Instead: why LITERAL is in an answer set, or why not; 'p(X), q(X)' too.",
    ),
]
SetOption = Annotated[
    int,
    typer.Option("--set", min=1, metavar="K", help="Ask about the K-th answer set."),
]


@grouped(
    {
        "Options": ("layout", "scenario", "number", "only", "grep", "as_json"),
        "Situation": ("enter", "bill", "goal", "horizon"),
        "What is shown": (
            "steps", "ignore_case", "invert", "negative", "projection", "count", "diff", "as_jsonl", "literal",
            "set_number",
        ),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("verbose",),
    }
)  # fmt: skip
@folded
def answersets(
    situation: Situation,
    options: PlanOptions,
    program: ProgramArgument = None,
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
    set_number: SetOption = 1,
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
    from sparc.limits import begin

    form = OutputForm(count, diff, as_json, as_jsonl, negative, verbose)
    begin(options.time_limit, options.memory_limit)
    from waiter_cli.answersets.timeline import Order

    _require_program_or_restaurant(program, situation, options, horizon, constants)
    _require_one_form(
        form, literal, number, set_number, flat and (time_sort is not None or steps is not None)
    )
    choice = _choose(grep, ignore_case, invert, steps, only)
    wanted = ListingChoice(
        choice,
        _names(projection),
        form.limit(number),
        Order(time_sort, flat),
        _deadline(options.time_limit),
    )
    backend = options.load_translator()
    writer = form.writer(choice)
    source: Source | None
    if program is not None:
        from waiter_cli.file_access.sparc_file import read_program

        source = read_program(program, constants)
    else:
        source = _restaurant(situation, options, horizon, backend, writer, verbose)
    if source is None:
        return writer.exit_code
    if literal is not None:
        return _explained(source, literal, set_number, wanted.deadline, as_json)
    return print_answer_sets(source, backend, wanted, form, writer, _no_answer_set(source, horizon))


def _require_program_or_restaurant(
    program: str | None, situation: Situation, options: PlanOptions, horizon: int | None,
    constants: list[str] | None,
) -> None:  # fmt: skip
    """Raises `InputError` unless there is one thing to solve, and options that fit it."""
    from waiter_cli.errors import InputError

    if (program is None) == (situation.layout is None and situation.scenario is None):
        raise InputError("give either a PROGRAM or a --layout (or --scenario)", "see --help")
    if program is not None and (
        situation.is_given or horizon is not None or options.max_steps is not None
    ):
        raise InputError("a PROGRAM takes no options about a restaurant", "see --help")
    if program is None and constants:
        raise InputError("-c sets a constant of a PROGRAM", "see --help")


def _require_one_form(
    form: OutputForm,
    literal: str | None,
    number: int | None,
    set_number: int,
    timed_and_flat: bool,
) -> None:
    """Raises `InputError` for options of output that exclude each other."""
    from waiter_cli.errors import InputError

    if sum((form.count, form.diff, form.as_jsonl)) > 1 or (form.as_json and form.as_jsonl):
        raise InputError("--count, --diff and --jsonl exclude each other, as do --json and --jsonl")
    several = form.count or form.diff or form.as_jsonl or number is not None
    if literal is not None and several:
        raise InputError(
            "--why is about one answer set: it takes no -n, --count, --diff or --jsonl"
        )
    if literal is None and set_number > 1:
        raise InputError("--set chooses the answer set that --why is about", "give --why, too")
    if timed_and_flat:
        raise InputError("--flat is without time: it takes no --time-sort and no --steps")


def _choose(
    grep: list[str] | None, ignore_case: bool, invert: bool, steps: str | None,
    only: list[str] | None,
) -> Filter:  # fmt: skip
    """Returns the filter of literals; raises `InputError` for patterns and steps that are none."""
    from waiter_cli.answersets.timeline import Filter, read_patterns, read_steps

    return Filter(
        read_patterns(grep or (), ignore_case=ignore_case),
        invert,
        None if steps is None else read_steps(steps),
        _names(only),
    )


def _deadline(time_limit: float | None) -> float | None:
    import time

    return None if time_limit is None else time.monotonic() + time_limit


def _no_answer_set(source: Source, horizon: int | None) -> str:
    """Returns what is said where there is no answer set."""
    from waiter_cli.model.wording import counted

    if horizon is None:
        return f"{source.name} is inconsistent: it has no answer set"
    return f"there is no plan of at most {counted(horizon, 'step')}"


def _explained(
    source: Source, literal: str, number: int, deadline: float | None, as_json: bool
) -> int:
    """Prints why a literal is in the ``number``-th answer set, or not."""
    import time

    from waiter_cli.commands.sparc.why import explain_query

    left = None if deadline is None else max(0.0, deadline - time.monotonic())
    return explain_query(source, literal, number=number, time_limit=left, as_json=as_json)


def _names(options: list[str] | None) -> frozenset[str] | None:
    """Returns the names of ``--only holds,occurs``, given once or more."""
    if options is None:
        return None
    words = (word.strip() for option in options for word in option.split(","))
    return frozenset(word for word in words if word)


def _restaurant(
    situation: Situation, options: PlanOptions, horizon: int | None, backend: Translator,
    writer: Writer, verbose: bool,
) -> Source | None:  # fmt: skip
    """Returns the program of the restaurant at ``horizon``, or at the least one that has a plan.

    None when there is no such program; then the writer has said why.
    """
    from waiter_cli.domain_execution.domain_rules import believed
    from waiter_cli.encoding.domains import domain_for
    from waiter_cli.encoding.template import fill_template

    problem = situation.load(several=True)
    rules = options.load_domain()
    if problem.contradictions:
        writer.nothing("what was observed cannot be", problem.contradictions)
        return None
    if horizon is None:
        horizon = _least_horizon(problem, rules, options, backend, writer, verbose)
    return (
        None
        if horizon is None
        else fill_template(domain_for(problem, rules).template, believed(problem, rules), horizon)
    )


def _least_horizon(
    problem: Problem, rules: Domain, options: PlanOptions, backend: Translator, writer: Writer,
    verbose: bool,
) -> int | None:  # fmt: skip
    """Returns the least number of steps of a plan; None where the writer has said why there is none."""
    from waiter_cli.commands.search_report import print_stages, searching
    from waiter_cli.planning.search_results import NoPlanError, SearchOptions, SearchStatus
    from waiter_cli.planning.strategies import find_minimal_plan

    with searching() as listener:
        search = SearchOptions(
            options.search.value, options.max_steps, options.time_limit, listener=listener
        )
        result = find_minimal_plan(problem, backend, rules, search)
    if verbose:
        print_stages(result.stages)
    try:
        return result.least_horizon()
    except NoPlanError:
        if result.status is SearchStatus.UNDECIDED:
            writer.undecided(result.limit or "time", most=result.max_steps)
        else:
            writer.nothing("there is no plan, whatever its length", result.reasons)
        return None
