"""Prints answer sets as they are found: a program, what is wanted of it → text or JSON.

Entry point `print_answer_sets`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from sparc.answer_sets import AnswerSet
    from sparc.source import Source
    from sparc.translation.asp_program import AspProgram
    from waiter_cli.answersets.enumerate import AnswerListing
    from waiter_cli.answersets.timeline import Filter, Order, Timeline
    from waiter_cli.answersets.writers import Writer
    from waiter_cli.translators.base import Translator

__all__ = ["DIFF_SETS", "OutputForm", "ListingChoice", "print_answer_sets"]

DIFF_SETS = 10  # how many answer sets --diff compares unless told


@dataclass(frozen=True)
class OutputForm:
    """The options of a command line for how answer sets are printed."""

    count: bool = False
    diff: bool = False
    as_json: bool = False
    as_jsonl: bool = False
    negative: bool = False
    verbose: bool = False

    def limit(self, number: int | None) -> int:
        """Returns how many answer sets are to be found; 0 is all."""
        if number is not None:
            return number
        return 0 if self.count else DIFF_SETS if self.diff else 1

    def writer(self, chosen: Filter) -> Writer:
        """Returns what prints the answer sets."""
        from waiter_cli.answersets.writers import JsonWriter, TextWriter

        if self.as_json or self.as_jsonl:
            return JsonWriter(lines=self.as_jsonl)
        return TextWriter(chosen, self.negative)


@dataclass(frozen=True)
class ListingChoice:
    """The answer sets to list: ``limit`` of them (0: all), until ``deadline`` (monotonic seconds)."""

    chosen: Filter
    projection: frozenset[str] | None
    limit: int
    order: Order
    deadline: float | None


def print_answer_sets(
    source: Source, backend: Translator, wanted: ListingChoice, form: OutputForm, writer: Writer,
    inconsistent: str,
) -> int:  # fmt: skip
    """Finds the answer sets and prints each as it is found."""
    import time

    from waiter_cli.model.wording import counted

    start = time.monotonic()
    answers = _answers(source, backend, wanted, writer)
    if answers is None:
        return writer.exit_code
    if form.verbose:
        lines = len(answers.program.text.splitlines())
        _say_stage("translate", f"{counted(lines, 'line')} of ASP", start)
        start = time.monotonic()
    writer.timeline = answers.timeline
    from contextlib import nullcontext

    from waiter_cli.translators.jar import jar_errors

    try:
        with jar_errors() if backend.name == "jar" else nullcontext():
            _write(answers, form, writer, inconsistent)
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
    if form.verbose:
        _say_stage("list", "all" if answers.complete else "as far as asked for", start)
    return writer.exit_code


def _write(answers: AnswerListing, form: OutputForm, writer: Writer, inconsistent: str) -> None:
    """Prints the answer sets, their number, or what tells them apart."""
    if form.count:
        writer.count(answers, sum(1 for _ in answers), inconsistent)
    elif form.diff:
        writer.differences(answers, _comparable(answers), inconsistent)
    else:
        for answer_set in answers:
            writer.write(answer_set)
        writer.finish(answers, inconsistent)


def _comparable(answers: AnswerListing) -> list[AnswerSet]:
    """Returns the answer sets, as many as can be held to be compared."""
    from waiter_cli.answersets.writers import COMPARED

    answer_sets, held = [], 0
    for answer_set in answers:
        answer_sets.append(answer_set)
        held += len(answer_set.literals) + 1
        if held > COMPARED:
            answers.limit_reached = "memory"
            break
    return answer_sets


def _say_stage(name: str, outcome: str, start: float) -> None:
    import time

    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.planning.search_results import SearchStage

    print_stages([SearchStage(name, outcome, time.monotonic() - start)])


def _answers(
    source: Source, backend: Translator, wanted: ListingChoice, writer: Writer
) -> AnswerListing | None:
    """Returns the answer sets of ``source``; None when a limit came first, and the writer has said so."""
    import time

    from waiter_cli.answersets.enumerate import AnswerListing, prepare

    chosen, deadline = wanted.chosen, wanted.deadline
    left = None if deadline is None else max(0.01, deadline - time.monotonic())
    try:
        program, timeline = prepare(source, backend, time_limit=left, order=wanted.order)
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
    _known(timeline, wanted.projection, "--projection")
    if chosen.steps is not None and not timeline.has_steps:
        writer.note("no literal of this program has a step: --time-sort names the sort of steps.")
    if program.has_display:
        _shown(program, chosen.only, writer)
    return AnswerListing(
        program,
        timeline,
        chosen,
        projection=wanted.projection,
        limit=wanted.limit,
        deadline=deadline,
    )


def _shown(program: AspProgram, only: frozenset[str] | None, writer: Writer) -> None:
    """Says which predicates of ``--only`` the display section hides."""
    from waiter_cli.answersets.enumerate import shown_names

    hidden = sorted((only or frozenset()) - shown_names(program))
    if hidden:
        writer.note(f"the display section of this program hides {', '.join(hidden)}.")


def _known(timeline: Timeline, names: frozenset[str] | None, option: str) -> None:
    """Raises `InputError` for a name that is no predicate of the program."""
    from sparc.spelling import nearest
    from waiter_cli.errors import Fault, InputError

    faults = []
    for name in sorted(names or ()):
        if name not in timeline.arities and not name.startswith("#") and timeline.arities:
            close = nearest(name, timeline.arities)
            hint = f"did you mean {close}?" if close else None
            faults.append(Fault(None, f"{option}: the program has no predicate {name}", hint))
    if faults:
        raise InputError(faults)
