"""The options that several commands share, each defined once, and the values behind them."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

import waiter_cli
from sparc.lazy_dataclass import dataclass
from waiter_cli.command_line.completion import names_of

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.problem import Problem
    from waiter_cli.translators.base import Translator

__all__ = [
    "A_LAYOUT",
    "BillOption",
    "ConstantOption",
    "DomainOption",
    "EnterOption",
    "GoalOption",
    "JsonOption",
    "LayoutArgument",
    "LayoutOption",
    "MaxStepsOption",
    "MemoryLimitOption",
    "ObserveOption",
    "OutputOption",
    "PlanOptions",
    "ScenarioOption",
    "SearchOption",
    "Situation",
    "SparcJarOption",
    "Strategy",
    "TimeLimitOption",
    "TranslatorName",
    "TranslatorOption",
    "VerboseOption",
    "WatchOption",
    "WorkersOption",
    "named_file",
    "paths_to_watch",
    "print_warnings",
]


class TranslatorName(str, Enum):
    """The translators from SPARC to clingo."""

    native = "native"
    jar = "jar"


class Strategy(str, Enum):
    """The strategies of the search for the least horizon."""

    binary = "binary"
    linear = "linear"
    gallop = "gallop"
    minimize = "minimize"


# Optional[...] rather than "| None": Typer reads these annotations at run time on Python 3.10.
A_LAYOUT = "A layout: a YAML file, or a built-in name such as report; - is stdin."
LayoutArgument = Annotated[
    str, typer.Argument(metavar="LAYOUT", autocompletion=names_of("layout"), help=A_LAYOUT)
]
LayoutOption = Annotated[
    Optional[str],
    typer.Option(
        "--layout",
        "-l",
        metavar="LAYOUT",
        autocompletion=names_of("layout"),
        help="A layout: a YAML file, or a built-in name such as report.",
    ),
]
ScenarioOption = Annotated[
    Optional[str],
    typer.Option(
        "--scenario",
        "-s",
        metavar="SCENARIO",
        autocompletion=names_of("scenario"),
        help="A scenario: a YAML file, or a built-in name such as b1.",
    ),
]
EnterOption = Annotated[
    Optional[list[str]],
    typer.Option("--enter", metavar="N", help="A party of N guests comes in; may be given again."),
]
BillOption = Annotated[
    Optional[list[str]],
    typer.Option("--bill", metavar="TABLE", help="A table waves for its bill; may be given again."),
]
GoalOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--goal",
        metavar="GOAL",
        help="A goal in YAML, such as 'seated: [c1]', beside those of the scenario; where it has "
        "none, nothing else is wanted. May be given again.",
    ),
]
ObserveOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--observe",
        metavar="SEEN",
        help="Something seen, in YAML, such as 'order: table1'; may be given again.",
    ),
]
JsonOption = Annotated[
    bool, typer.Option("--json", help="Print one JSON document and nothing else.")
]
WorkersOption = Annotated[
    Optional[int],
    typer.Option(
        "--workers",
        min=1,
        max=1000,
        metavar="N",
        help="Processes that play evenings; one a processor unless told.",
    ),
]
TranslatorOption = Annotated[
    TranslatorName,
    typer.Option(
        "--translator",
        envvar="WAITER_TRANSLATOR",
        help="Who translates SPARC: our own code, or upstream's jar.",
    ),
]
SparcJarOption = Annotated[
    Optional[str],
    typer.Option(
        "--sparc-jar",
        metavar="PATH",
        envvar="WAITER_SPARC_JAR",
        help="Where sparc.jar is, for --translator jar.",
    ),
]
SearchOption = Annotated[
    Strategy, typer.Option("--search", help="How to search for the least number of steps.")
]
MaxStepsOption = Annotated[
    Optional[int],
    typer.Option("--max-steps", min=0, metavar="N", help="Give up beyond plans of N steps."),
]
TimeLimitOption = Annotated[
    Optional[float],
    typer.Option("--time-limit", min=0.0, metavar="SECONDS", help="Give up after so many seconds."),
]


def _read_size(text: str) -> int:
    """Returns the bytes of a size such as 500M; raises what Typer tells as a usage error."""
    from sparc.numerals import decimal

    digits = text.strip().upper().removesuffix("B").removesuffix("I")
    unit = digits[-1:] if digits[-1:] in _UNITS else ""
    value = decimal(digits.removesuffix(unit))
    size = 0 if value is None else int(value * _UNITS[unit or "M"])
    if not 0 < size < 1 << 60:
        raise typer.BadParameter(f"{text[:40]!r} is no size; write 500M or 2G.")
    return size


_UNITS = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30, "T": 1 << 40}
MemoryLimitOption = Annotated[
    Optional[int],
    typer.Option(
        "--memory-limit",
        metavar="SIZE",
        parser=_read_size,
        help="Give up when the process takes more memory than SIZE, such as 500M or 2G "
        "(MB unless told; half of what is free by default).",
    ),
]


def named_file(option: typer.CallbackParam, value: Any) -> Any:
    """Returns the name of a file to write, or several; raises `InputError` for ``-``, which is none."""
    if value == "-" or (isinstance(value, (list, tuple)) and "-" in value):
        from waiter_cli.errors import Fault, InputError, Where

        hint = "give it a name; ./- would be a file that is called -"
        raise InputError([Fault(Where(option.opts[0]), "- is no name for a file", hint)])
    return value


def _printed_for_dash(value: Optional[str]) -> Optional[str]:
    """Returns the name of a file to write, or None for ``-``: what has no file is printed."""
    return None if value == "-" else value


OutputOption = Annotated[
    Optional[str],
    typer.Option(
        "--output",
        "-o",
        callback=_printed_for_dash,
        metavar="FILE",
        help="Write FILE instead of printing.",
    ),
]


def _as_typed(context: typer.Context, value: str) -> str:
    """Returns the domain's name; where nobody typed it, as one that no file of the folder stands for."""
    from waiter_cli.file_access.locate import BuiltIn

    source = context.get_parameter_source("domain")
    return BuiltIn(value) if source is not None and source.name == "DEFAULT" else value


ConstantOption = Annotated[
    Optional[list[str]],
    typer.Option("-c", metavar="NAME=NUMBER", help="Set a constant of the program."),
]
DomainOption = Annotated[
    str,
    typer.Option(
        "--domain",
        callback=_as_typed,
        metavar="NAME",
        autocompletion=names_of("domain"),
        help="The rules: restaurant, report, or a SPARC template of your own.",
    ),
]
WatchOption = Annotated[
    bool, typer.Option("--watch", "-w", help="Run again whenever a file changes, until Ctrl-C.")
]
VerboseOption = Annotated[
    bool,
    typer.Option("--verbose", "-v", help="Say on stderr what each stage did and how long it took."),
]


@dataclass(frozen=True)
class Situation:
    """The options of a command line that pose a problem: names of files, and what comes on top."""

    layout: LayoutOption = None
    scenario: ScenarioOption = None
    enter: EnterOption = None
    bill: BillOption = None
    goal: GoalOption = None
    observe: ObserveOption = None

    @property
    def is_given(self) -> bool:
        """Returns whether any of these options was given."""
        options = (self.layout, self.scenario, self.enter, self.bill, self.goal, self.observe)
        return any(option is not None for option in options)

    def load(self, *, several: bool = False) -> Problem:
        """Returns the problem, which has one robot unless ``several`` is true; warnings go to stderr.

        Raises `InputError` with every fault of the files and options.
        """
        from waiter_cli.problems.from_options import read_problem

        problem, warnings = read_problem(
            self.layout,
            self.scenario,
            self.enter or (),
            self.bill or (),
            self.goal or (),
            self.observe or (),
            several=several,
        )
        if warnings:
            print_warnings(problem.layout)
        _remark_on_the_unwanted(problem, len(self.enter or ()), self.bill or ())
        return problem


@dataclass(frozen=True)
class PlanOptions:
    """The options of a command line for planning; ``time_limit`` in seconds, ``memory_limit`` in bytes."""

    search: SearchOption = Strategy.binary
    max_steps: MaxStepsOption = None
    time_limit: TimeLimitOption = None
    memory_limit: MemoryLimitOption = None
    domain: DomainOption = "restaurant"
    translator: TranslatorOption = TranslatorName.native
    sparc_jar: SparcJarOption = None

    def load_domain(self) -> Domain:
        """Returns the rules; raises `InputError` where there are none of that name."""
        return waiter_cli.find_domain(self.domain)

    def load_translator(self) -> Translator:
        """Returns the translator; raises `MissingError` where Java or the jar is missing."""
        return waiter_cli.find_translator(self.translator.value, self.sparc_jar)

    def limits(self) -> dict[str, Any]:
        """Returns the strategy and the limits, as the front door takes them."""
        return {
            "strategy": self.search.value,
            "max_steps": self.max_steps,
            "time_limit": self.time_limit,
        }


def print_warnings(layout: Layout) -> None:
    """Prints on stderr what looks wrong with a layout."""
    from waiter_cli.console.output import print_faults
    from waiter_cli.layout_tools.advice_text import told_warnings

    print_faults(told_warnings(layout), "warning")


def paths_to_watch(*named: tuple[str | None, str]) -> list[str]:
    """Returns the paths of (name, kind) pairs, kinds being ``layout`` and ``scenario``; stdin has none."""
    from waiter_cli.file_access.locate import find

    return [find(name, kind) for name, kind in named if name and name != "-"]


def _remark_on_the_unwanted(problem: Problem, entered: int, bills: Sequence[str]) -> None:
    """Says on stderr what --enter and --bill bring in vain, since goals are given."""
    if problem.everybody:
        return
    import sys

    from waiter_cli.console.output import say

    goals = [*problem.goals, *(goal for pair in problem.before for goal in pair)]
    paid = {goal.table for goal in goals if goal.kind == "paid"}
    guests = {name for goal in goals for name in goal.party}
    came = [
        observation.arguments for observation in problem.observations if observation.kind == "enter"
    ]
    idle = [f"the bill of {table}" for table in bills if table not in paid]
    idle += [f"the party of {party[0]}" for party in came[len(came) - entered :]
             if not guests.intersection(party)]  # fmt: skip
    if idle:
        what = " and ".join(idle)
        say(f"note: goals are given, and {what} is none of them; add a --goal", sys.stderr)
