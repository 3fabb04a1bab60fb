"""``waiter answersets``: answer sets in the order of time, of a program or of a restaurant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import (
    BillOption,
    DomainOption,
    EnterOption,
    GoalOption,
    JsonOption,
    LayoutOption,
    MaxStepsOption,
    ScenarioOption,
    SparcJarOption,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sparc.answer_sets import AnswerSet, GroundLiteral
    from sparc.source import Source
    from waiter_cli.answers import Answers
    from waiter_cli.search import Translator
    from waiter_cli.timeline import Filter, Timeline

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
HorizonOption = Annotated[
    Optional[int],
    typer.Option("--horizon", min=0, metavar="H", help="With a layout: H steps, not the fewest."),
]


def answersets(
    program: ProgramArgument = None,
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    enter: EnterOption = None,
    bill: BillOption = None,
    goal: GoalOption = None,
    horizon: HorizonOption = None,
    number: NumberOption = None,
    grep: GrepOption = None,
    ignore_case: Annotated[
        bool, typer.Option("--ignore-case", "-i", help="--grep takes a for A.")
    ] = False,
    invert: Annotated[
        bool, typer.Option("--invert", help="Keep the literals that --grep would drop.")
    ] = False,
    steps: StepsOption = None,
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
    max_steps: MaxStepsOption = None,
    time_limit: TimeLimitOption = None,
    domain: DomainOption = "restaurant",
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
) -> int:
    """Show answer sets in the order of time.

    \b
    Examples:
      waiter answersets blocks.sparc -n 0
      waiter answersets --scenario b1 --only occurs
      waiter answersets --layout report --enter 1 --grep isattable --steps 5..
    """
    import time

    from waiter_cli.exits import InputError
    from waiter_cli.timeline import Filter, read_patterns, read_steps

    situation = (layout, scenario, enter, bill, goal, horizon, max_steps)
    if (program is None) == (layout is None and scenario is None):
        raise InputError("give either a PROGRAM or a --layout (or --scenario)", "see --help")
    if program is not None and any(given is not None for given in situation):
        raise InputError("a PROGRAM takes no options about a restaurant", "see --help")
    if sum((count, diff, as_jsonl)) > 1 or (as_json and as_jsonl):
        raise InputError("--count, --diff and --jsonl exclude each other, as do --json and --jsonl")
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
    writer: _Writer
    if as_json or as_jsonl:
        writer = _JsonWriter(lines=as_jsonl)
    else:
        writer = _TextWriter(chosen, negative)
    source: Source | None
    if program is not None:
        from waiter_cli.program_file import read_program

        source = read_program(program)
    else:
        source = _restaurant(
            (layout, scenario, enter, bill, goal),
            domain,
            horizon,
            max_steps,
            deadline,
            backend,
            writer,
        )
    if source is None:
        return writer.exit_code
    inconsistent = f"{source.name} is inconsistent: it has no answer set"
    if horizon is not None:
        inconsistent = f"there is no plan of at most {horizon} step{'' if horizon == 1 else 's'}"
    answers = _answers(source, backend, chosen, _names(projection), limit, deadline, writer)
    if answers is None:
        return writer.exit_code
    writer.timeline = answers.timeline
    from contextlib import nullcontext

    from waiter_cli.jar_store import jar_errors

    try:
        with jar_errors() if translator is TranslatorName.jar else nullcontext():
            if count:
                writer.count(answers, sum(1 for _ in answers), inconsistent)
            elif diff:
                writer.differences(answers, list(answers), inconsistent)
            else:
                for answer_set in answers:
                    writer.write(answer_set)
                writer.finish(answers, inconsistent)
    except BrokenPipeError:  # as in "| head": whoever reads has seen enough
        import os

        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 0
    return writer.exit_code


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
    max_steps: int | None,
    deadline: float | None,
    backend: Translator,
    writer: _Writer,
) -> Source | None:
    """The program of the restaurant at ``horizon``, or at the least one that has a plan.

    None when there is no such program; then the writer has said why.
    """
    import time

    from waiter_cli.commands.options import load_domain, load_problem
    from waiter_cli.search import SearchOptions, SearchStatus, find_minimal_plan
    from waiter_cli.template import fill_template

    problem = load_problem(*situation)
    rules = load_domain(domain_name)
    if problem.contradictions:
        writer.nothing("what was observed cannot be", problem.contradictions)
        return None
    if horizon is None:
        left = None if deadline is None else max(0.01, deadline - time.monotonic())
        options = SearchOptions(max_steps=max_steps, time_limit=left)
        result = find_minimal_plan(problem, backend, rules, options)
        if result.status is SearchStatus.UNDECIDED and not (result.plan and result.minimal):
            writer.undecided(result.limit or "time")
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
    writer: _Writer,
) -> Answers | None:
    """The answer sets of ``source``; None when a limit came first, and the writer has said so."""
    import time

    from waiter_cli.answers import Answers, prepare

    left = None if deadline is None else max(0.01, deadline - time.monotonic())
    try:
        program, timeline = prepare(source, backend, time_limit=left)
    except MemoryError:
        writer.undecided("memory")
        return None
    except Exception as error:
        from sparc.solvers.jar import TranslationTimeout

        if not isinstance(error, TranslationTimeout):
            raise
        writer.undecided("time")
        return None
    _known(timeline, chosen.only, "--only")
    _known(timeline, projection, "--projection")
    return Answers(program, timeline, chosen, projection=projection, limit=limit, deadline=deadline)


def _known(timeline: Timeline, names: frozenset[str] | None, option: str) -> None:
    """Raises `InputError` for a name that is no predicate of the program."""
    from difflib import get_close_matches

    from waiter_cli.exits import Fault, InputError

    faults = []
    for name in sorted(names or ()):
        if name not in timeline.arities and not name.startswith("#") and timeline.arities:
            close = get_close_matches(name, timeline.arities, 1)
            hint = f"did you mean {close[0]}?" if close else None
            faults.append(Fault(None, f"{option}: the program has no predicate {name}", hint))
    if faults:
        raise InputError(faults)


# ------------------------------------------------------------------ output


class _Writer:
    """What a writer does: answer sets as they come, then how the search ended.

    ``exit_code`` is right after `finish`, `count`, `differences`, `nothing` or `undecided`.
    """

    timeline: Timeline
    exit_code = 0

    def write(self, answer_set: AnswerSet) -> None:
        raise NotImplementedError

    def finish(self, answers: Answers, inconsistent: str) -> None:
        raise NotImplementedError

    def count(self, answers: Answers, number: int, inconsistent: str) -> None:
        raise NotImplementedError

    def differences(self, answers: Answers, found: list[AnswerSet], inconsistent: str) -> None:
        raise NotImplementedError

    def nothing(self, message: str, reasons: Sequence[Any] = ()) -> None:
        """There is no answer set, for these reasons."""
        from waiter_cli.exits import Exit

        self.exit_code = Exit.PROVED
        _say(f"{message}.")
        for reason in reasons:
            where = f"{reason.where}: " if reason.where else ""
            _say(f"  {where}{reason.message}", prefix="")

    def undecided(self, limit: str, found: str = "") -> None:
        """A limit came first."""
        from waiter_cli.exits import Exit

        self.exit_code = Exit.UNDECIDED
        words = {
            "time": "the time limit was reached",
            "memory": "the memory ran out",
            "max_steps": "no plan was found up to --max-steps",
        }
        _say(f"{words.get(limit, limit)}{found}.")

    def ended(self, answers: Answers, inconsistent: str, found: str = "") -> None:
        """Sets the exit code, and says what a person should know of it on stderr."""
        if answers.limit_reached is not None:
            _Writer.undecided(self, answers.limit_reached, found)
        elif answers.satisfiable is False:
            _Writer.nothing(self, inconsistent)


def _say(message: str, prefix: str = "waiter: ") -> None:
    import sys

    print(f"{prefix}{message}", file=sys.stderr)


class _JsonWriter(_Writer):
    """One document at the end, or with ``lines`` one object a line."""

    def __init__(self, *, lines: bool) -> None:
        self.lines = lines
        self.found: list[AnswerSet] = []

    def _texts(self, literals: frozenset[GroundLiteral]) -> list[str]:
        return [str(literal) for literal in self.timeline.sort(literals)]

    def _object(self, answer_set: AnswerSet) -> dict[str, Any]:
        return {"literals": self._texts(answer_set.literals), "cost": list(answer_set.cost)}

    def _print(self, document: dict[str, Any]) -> None:
        import json

        print(json.dumps(document, ensure_ascii=False), flush=True)

    def write(self, answer_set: AnswerSet) -> None:
        if self.lines:
            self._print(self._object(answer_set))
        else:
            self.found.append(answer_set)

    def _document(self, answers: Answers, **more: Any) -> None:
        document: dict[str, Any] = {
            "satisfiable": answers.satisfiable,
            "complete": answers.complete,
            **more,
        }
        if answers.limit_reached is not None:
            document["limit"] = answers.limit_reached
        self._print(document)

    def finish(self, answers: Answers, inconsistent: str) -> None:
        if self.lines:
            self._document(answers)
        else:
            self._document(answers, answer_sets=self._sorted(answers))
        self.ended(answers, inconsistent)

    def _sorted(self, answers: Answers) -> list[dict[str, Any]]:
        """The answer sets as found; in an order of their own where all of them are here."""
        if answers.complete:
            key = self.timeline.key
            self.found.sort(key=lambda each: sorted(map(key, each.literals)))
        return [self._object(answer_set) for answer_set in self.found]

    def count(self, answers: Answers, number: int, inconsistent: str) -> None:
        self._document(answers, count=number)
        self.ended(answers, inconsistent)

    def differences(self, answers: Answers, found: list[AnswerSet], inconsistent: str) -> None:
        from sparc.answer_sets import AnswerSet
        from waiter_cli.timeline import differences

        common, own = differences(found)
        self.found = [AnswerSet(each, whole.cost) for each, whole in zip(own, found, strict=True)]
        self._document(answers, common=self._texts(common), answer_sets=self._sorted(answers))
        self.ended(answers, inconsistent)

    def nothing(self, message: str, reasons: Sequence[Any] = ()) -> None:
        super().nothing(message, reasons)
        listed = [
            {
                "message": reason.message,
                "file": reason.where.name if reason.where else None,
                "line": reason.where.line or None if reason.where else None,
                "column": reason.where.column or None if reason.where else None,
            }
            for reason in reasons
        ]
        document = {"satisfiable": False, "complete": True}
        self._print({**document, **({} if self.lines else {"answer_sets": []}), "reasons": listed})

    def undecided(self, limit: str, found: str = "") -> None:
        super().undecided(limit, found)
        document = {"satisfiable": None, "complete": False}
        self._print({**document, **({} if self.lines else {"answer_sets": []}), "limit": limit})


class _TextWriter(_Writer):
    """A heading for each answer set and each step, one literal a line."""

    def __init__(self, chosen: Filter, negative: bool) -> None:
        self.chosen = chosen
        self.negative = negative
        self.number = 0

    def write(self, answer_set: AnswerSet) -> None:
        from waiter_cli.output import styled

        if self.number:
            print()
        self.number += 1
        cost = f" (cost {', '.join(map(str, answer_set.cost))})" if any(answer_set.cost) else ""
        print(styled(f"Answer set {self.number}{cost}", "bold"))
        self._literals(answer_set.literals)

    def _literals(self, literals: frozenset[GroundLiteral]) -> None:
        import sys

        from waiter_cli.output import styled

        visible = [each for each in literals if self.negative or not each.negated]
        lines = []
        for group in self.timeline.groups(visible):
            heading = "without a step" if group.step is None else f"step {group.step}"
            lines.append(f"  {styled(heading, 'cyan')}")
            lines.extend(f"    {self._highlighted(str(literal))}" for literal in group.literals)
        if not visible:
            lines.append("    (no literal matches)" if self.chosen else "    (empty)")
        print("\n".join(lines))
        sys.stdout.flush()

    def _highlighted(self, text: str) -> str:
        from waiter_cli.output import styled

        pieces, at = [], 0
        for start, end in self.chosen.matches(text):
            pieces += [text[at:start], styled(text[start:end], "bold red")]
            at = end
        return "".join([*pieces, text[at:]])

    def finish(self, answers: Answers, inconsistent: str) -> None:
        if self.number:
            print(f"\n{self._more(answers, self.number)}", flush=True)
        self.ended(answers, inconsistent, f" after {_sets(self.number)}")

    def _more(self, answers: Answers, number: int) -> str:
        if answers.complete:
            return f"{_sets(number)}; there are no more."
        if answers.limit_reached or answers.open_end:
            return f"{_sets(number)}; whether there are more is not settled."
        return f"{_sets(number)}; there are more (-n 0 shows all)."

    def count(self, answers: Answers, number: int, inconsistent: str) -> None:
        exact = answers.complete
        print(_sets(number) if exact else f"at least {_sets(number)}")
        self.ended(answers, inconsistent)

    def differences(self, answers: Answers, found: list[AnswerSet], inconsistent: str) -> None:
        from waiter_cli.output import styled
        from waiter_cli.timeline import differences

        common, own = differences(found)
        if found:
            shared = f"{len(common)} literal{'' if len(common) == 1 else 's'}"
            print(f"{shared} in all of them; beyond these:")
        for number, literals in enumerate(own, 1):
            print(f"\n{styled(f'Answer set {number}', 'bold')}")
            if literals:
                self._differing(literals)
            else:
                print("    (nothing more)")
        if found:
            print(f"\n{self._more(answers, len(found))}")
        self.ended(answers, inconsistent)

    def _differing(self, literals: frozenset[GroundLiteral]) -> None:
        """Negative literals are shown where nothing else tells an answer set apart."""
        kept = self.negative
        self.negative = kept or all(literal.negated for literal in literals)
        self._literals(literals)
        self.negative = kept


def _sets(number: int) -> str:
    return f"{number} answer set{'' if number == 1 else 's'}"
