"""The tool chain by itself: ``python -m sparc FILE`` prints the answer sets of a program.

One answer set is one line ``{l1, l2, …}``, parted by empty lines; ``--show`` prints a stage
instead, ``--query`` asks about one literal.  Exit status: 0 consistent, 2 the input is wrong,
3 inconsistent, 4 undecided: the time or the memory was up, or the program is too large.
"""

from __future__ import annotations

import os
import signal
import sys

try:
    from argparse import Action, ArgumentParser, ArgumentTypeError, Namespace
    from typing import Any, NoReturn

    from sparc import limits
    from sparc.checking.typed_program import TypedProgram
    from sparc.errors import LimitError, SourceError, SourceErrors, too_large
    from sparc.numerals import MOST, decimal, whole
    from sparc.reading import MAX_PROGRAM, program, read_capped
    from sparc.source import Source
    from sparc.stages import STAGES, show_stage
except MemoryError:  # under a limit in which little more than Python itself has room
    os.write(2, b"the memory ran out\n")
    os._exit(4)

__all__ = ["main"]

_NO_MEMORY, _NO_TIME = "the memory ran out\n", "the time was up\n"
OK, WRONG, INCONSISTENT, UNDECIDED, INTERRUPTED = 0, 2, 3, 4, 130


class _Once(Action):
    """An option with a value that is given once at most: of two, one would be lost."""

    def __call__(
        self, parser: ArgumentParser, options: Namespace, value: Any, name: str | None = None
    ) -> None:
        given: set[str] = options.__dict__.setdefault("_given", set())
        if self.dest in given:
            parser.error(f"{name} is given again; give it once")
        given.add(self.dest)
        setattr(options, self.dest, value)


class _Parser(ArgumentParser):
    """A parser that repeats no argument as it came: a terminal would obey it."""

    def error(self, message: str) -> NoReturn:
        from sparc.escaping import escaped

        super().error(escaped(message))


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line; returns the exit status."""
    parser = _Parser(prog="python -m sparc", description="Answer sets of a SPARC program.")
    parser.add_argument("file", help="the program; - reads standard input")
    parser.add_argument(
        "-n", action=_Once, type=_whole, default=0, metavar="N", help="at most N answer sets"
    )
    parser.add_argument("--query", action=_Once, metavar="LITERAL", help="ask about p(t) or -p(t)")
    parser.add_argument("--show", action=_Once, choices=STAGES)
    parser.add_argument("--time-limit", action=_Once, type=_seconds, metavar="SECONDS")
    parser.add_argument("-c", action="append", default=[], metavar="NAME=NUMBER", dest="constants",
                        help="set a constant")  # fmt: skip
    parser.add_argument("--warnings", action="store_true", help="report probable mistakes, too")
    parser.add_argument("--memory-limit", action=_Once, type=_size, metavar="MB")
    options = parser.parse_args(arguments)
    limits.begin(options.time_limit, options.memory_limit)
    if sys.stdout is None:
        parser.error("standard output is closed")
    try:
        from sparc.syntax.constants import set_constants

        source = set_constants(_read(options.file), options.constants)
        status = _run(source, options.show, options.query, options.n, options.time_limit,
                      options.warnings)  # fmt: skip
        sys.stdout.flush()
        return status
    except SourceErrors as error:
        faults: tuple[SourceError, ...] = error.errors
    except SourceError as error:
        faults = (error,)
    except OSError as error:
        if limits.starved(error):
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            return OK
        print(f"cannot write the output: {(error.strerror or '').lower()}", file=sys.stderr)
        return WRONG
    from sparc.diagnostics import render_all

    print(render_all(faults), file=sys.stderr)
    return UNDECIDED if too_large(faults) else WRONG


def _whole(text: str) -> int:
    """Returns a number of an option, from 0 up."""
    value = whole(text)
    if value is None or value < 0:
        raise ArgumentTypeError(f"{text!r} is not a whole number from 0 to {MOST}")
    return value


def _seconds(text: str) -> float:
    """Returns seconds of an option, from 0 up."""
    value = decimal(text)
    if value is None or value < 0:
        raise ArgumentTypeError(f"{text!r} is not a number from 0 to {MOST}")
    return value


def _read(name: str) -> Source:
    """Returns the program file as a `Source`; raises `SourceError` when it cannot be read."""
    try:
        data = read_capped(name, MAX_PROGRAM)
        return program(data, "<stdin>" if name == "-" else name)
    except OSError as error:
        raise SourceError(f"{name}: {error.strerror}") from None


def _run(
    source: Source,
    show: str | None,
    literal: str | None,
    models: int,
    time_limit: float | None,
    warnings: bool,
) -> int:
    """Prints what was asked for; returns the exit status."""
    import sparc

    if show is not None:
        if warnings and show in ("sorts", "asp"):
            _print_warnings(sparc.check(sparc.parse(source)))
        _print(show_stage(show, source))
        return OK
    typed = sparc.check(sparc.parse(source))
    if warnings:
        _print_warnings(typed)
    if literal is not None:
        answer = sparc.query(typed, literal, time_limit=time_limit)
        _print(str(answer))
        return {"inconsistent": INCONSISTENT, "undecided": UNDECIDED}.get(answer.verdict.value, OK)
    answers = sparc.solve(typed, models=models, time_limit=time_limit)
    for number, answer_set in enumerate(answers):
        _print("\n" * (number > 0) + "{" + ", ".join(sorted(map(str, answer_set.literals))) + "}")
    if answers.satisfiable is None or (not answers.complete and not models):
        print("the time was up before all answer sets were found", file=sys.stderr)
        return UNDECIDED
    if not answers.satisfiable:
        print("the program is inconsistent: it has no answer set", file=sys.stderr)
        return INCONSISTENT
    return OK


def _print(text: str) -> None:
    """A result; to a terminal without what it would obey."""
    from sparc.escaping import escaped

    print(escaped(text) if sys.stdout.isatty() else text)


def _print_warnings(typed: TypedProgram) -> None:
    """Writes the probable mistakes of a program without faults to standard error."""
    import sparc
    from sparc.diagnostics import render_all

    warnings = sparc.find_warnings(typed)
    if warnings:
        print(render_all(warnings), file=sys.stderr)


def _size(text: str) -> int:
    """Bytes of an option, given in MB."""
    value = whole(text)
    if value is None or value <= 0:
        raise ArgumentTypeError(f"{text!r} is not a whole number from 1 to {MOST}")
    return value << 20


def run() -> int:
    """Runs `main` as a process of its own: every limit and signal has its exit status."""
    came: list[int] = []
    if sys.stderr is None:  # closed: what is said there must not go to the output
        sys.stderr = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w", encoding="utf-8")

    def interrupt(number: int, frame: object) -> None:
        came.append(number)
        raise KeyboardInterrupt

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)
    try:
        if limits.hard_limit() is not None and hasattr(os, "fork"):
            from sparc.memory_guard import guarded

            guarded(b"", _NO_MEMORY.encode(), UNDECIDED)
        return main()
    except KeyboardInterrupt:
        return INTERRUPTED
    except limits.OverLimit as over:
        limits.end()
        sys.stdout.flush()
        print(
            _NO_MEMORY if over.limit == "memory" else _NO_TIME, end="", file=sys.stderr, flush=True
        )
        os._exit(UNDECIDED)  # to free what was under way would take as long as making it
    except RecursionError:
        print(LimitError("the program is too large for this machine"), file=sys.stderr)
        return UNDECIDED
    except Exception as error:
        if came:  # an import that a signal ended makes another error of it
            return INTERRUPTED
        if not limits.starved(error):
            raise
        print(_NO_MEMORY, end="", file=sys.stderr)
        return UNDECIDED


if __name__ == "__main__":
    status = run()
    sys.stderr.flush()
    os._exit(
        status
    )  # a thread of clingo's, left by a search that was cut short, aborts any other end
