"""``waiter sparc query``: what a program says of literals, asked once or at a prompt."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    MemoryLimitOption,
    SparcJarOption,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
)
from waiter_cli.commands.sparc.program import ProgramArgument, translated

if TYPE_CHECKING:
    from collections.abc import Callable

    from sparc.solving.query import Answer

__all__ = ["query"]

MAX_QUERY = 1 << 20
"""The most characters of a query at the prompt."""


def query(
    program: ProgramArgument,
    queries: Annotated[
        Optional[list[str]],
        typer.Option("--query", "-q", metavar="LITERAL", help="Ask this; may be given again."),
    ] = None,
    constants: ConstantOption = None,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
) -> int:
    """Ask a program about literals: yes, no, unknown, or the bindings of variables.

    A literal is true when all answer sets have it, false when all have its
    contrary; literals joined by commas are asked for together. Without --query
    a prompt asks for literals, until exit or the end of input; there, "why
    p(a)" explains an answer, and "help" tells what can be asked.

    \b
    Examples:
      waiter sparc query family.sparc --query 'parent(X,carla)'
      waiter sparc query family.sparc
    """
    from sparc.limits import begin
    from waiter_cli.console.output import print_json, print_text
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.file_access.sparc_file import read_program

    if program == "-" and not queries:
        raise InputError("standard input cannot be program and prompt at once", "give --query")
    if as_json and not queries:
        raise InputError("--json answers a --query", "give --query LITERAL")
    begin(time_limit if queries else None, memory_limit)
    source = read_program(program, constants)
    ask = _asker(source, translator, sparc_jar, time_limit)
    if not queries:
        return _prompt(ask, _Explainer(source, time_limit))
    answers = [(text, ask(text)) for text in queries]
    if as_json:
        documents = [_answer_document(text, answer) for text, answer in answers]
        print_json(documents[0] if len(documents) == 1 else {"answers": documents})
    code = Exit.OK
    for text, answer in answers:
        verdict = answer.verdict.value
        if verdict == "inconsistent":
            print_text(f"waiter: {program} is inconsistent: it has no answer set.", sys.stderr)
            return Exit.PROVED
        if verdict == "undecided":
            print_text(f"waiter: {text}: the time limit was reached.", sys.stderr)
            code = Exit.UNDECIDED
        elif not as_json:
            print_text(str(answer))
    return code


def _answer_document(text: str, answer: Answer) -> dict[str, Any]:
    bindings = [
        {name: value if isinstance(value, int) else str(value) for name, value in binding.items()}
        for binding in answer.bindings
        if binding
    ]
    verdict = answer.verdict.value
    limit = {"limit": "time"} if verdict == "undecided" else {}
    return {"query": text, "answer": verdict, **limit, "bindings": bindings}


def _asker(
    source: Any, translator: TranslatorName, sparc_jar: str | None, time_limit: float | None
) -> Callable[[str], Answer]:
    """Returns the function that answers queries about ``source``; the program's faults come at once."""
    import sparc

    if translator is TranslatorName.native:
        typed = sparc.check(sparc.parse(source))
        return lambda text: sparc.query(typed, text, time_limit=time_limit)
    from sparc.solving.query import Answer, Verdict

    asp = translated(source, translator, sparc_jar, time_limit)
    if asp is None:
        return lambda text: Answer(Verdict.UNDECIDED)
    from waiter_cli.answersets.query import ask_asp
    from waiter_cli.translators.jar import jar_errors

    typed = sparc.check(sparc.parse(source))
    program = asp

    def ask(text: str) -> Answer:
        with jar_errors():
            return ask_asp(program, typed, text, time_limit=time_limit)

    return ask


HELP = """\
p(a,X).          is it true, and for which X
p(X), -q(X).     of several literals at once
why p(a,X)       why it is in the first answer set, or why not
why              the same of the literal asked last
exit             leave
"""


class _Explainer:
    """The words ``help`` and ``why`` of the prompt, unless the program has predicates of these names."""

    def __init__(self, source: Any, time_limit: float | None) -> None:
        self.source = source
        self.time_limit = time_limit
        self.typed: Any = None
        self.last = ""

    def answers(self, text: str) -> bool:
        """Returns whether the line was one of these, and is answered."""
        word, _, rest = text.removesuffix(".").strip().partition(" ")
        rest = rest.strip()
        if word not in ("why", "help") or rest.startswith("(") or (word == "help" and rest):
            self.last = text
            return False
        import sparc
        from waiter_cli.console.output import print_text

        if not rest and any(each.name == word for each in sparc.parse(self.source).predicates):
            self.last = text
            return False
        if word == "help":
            print_text(HELP.rstrip("\n"))
        elif rest or self.last:
            self.last = rest or self.last
            self.explain(self.last)
        else:
            print_text("ask about a literal first, or: why p(a)")
        sys.stdout.flush()
        return True

    def explain(self, text: str) -> None:
        """Prints why a query is true in the first answer set, or not."""
        import sparc
        from sparc.explaining.why import why_query
        from waiter_cli.commands.sparc.why import print_why

        if self.typed is None:
            self.typed = sparc.check(sparc.parse(self.source))
        answers = why_query(self.typed, text, time_limit=self.time_limit)
        print_why(answers, self.source.name, as_json=False)


def _prompt(ask: Callable[[str], Answer], explainer: _Explainer) -> int:
    """Answers line by line; on a terminal with a prompt and a history."""
    from sparc.errors import SourceError, SourceErrors
    from waiter_cli.console.output import print_source_faults, print_text

    interactive = sys.stdin.isatty() and sys.stdout.isatty()
    read = _reader() if interactive else _piped_lines()
    while line := read():
        text = line.strip()
        if text.removesuffix(".") in ("exit", "quit"):
            break
        if not text or text.startswith("%"):
            continue
        try:
            if explainer.answers(text):
                continue
            answer = ask(text)
        except (SourceError, SourceErrors) as error:
            print_source_faults(error.errors if isinstance(error, SourceErrors) else (error,))
            sys.stderr.flush()
            continue
        verdict = answer.verdict.value
        if verdict == "inconsistent":
            from waiter_cli.errors import Exit

            print_text("waiter: the program is inconsistent.", sys.stderr)
            return Exit.PROVED
        print_text("the time limit was reached" if verdict == "undecided" else str(answer))
        sys.stdout.flush()
    return 0


def _piped_lines() -> Callable[[], str]:
    """Reads a line of standard input, decoded as programs are; "" at the end of input."""
    from sparc.reading import program_text, read_line_capped

    stream = getattr(sys.stdin, "buffer", None)  # a stand-in for stdin may have none
    if stream is None:
        return lambda: read_line_capped(sys.stdin, MAX_QUERY)
    pieces = iter(lambda: read_line_capped(stream, MAX_QUERY), b"")
    lines = (f"{line}\n" for data in pieces for line in program_text(data).split("\n"))
    return lambda: next(lines, "")


def _reader() -> Callable[[], str]:
    """Reads a line at the prompt; "" at the end of input.  The history lasts between runs."""
    import contextlib

    from waiter_cli.errors import MissingError
    from waiter_cli.translators.jar_store import store_path

    try:
        import readline

        history = store_path().parent / "query-history"
    except (ImportError, MissingError):  # no line editing on this system, or nobody's home
        return _read_line
    readline.set_history_length(1000)
    with contextlib.suppress(OSError):
        readline.read_history_file(history)

    def read() -> str:
        line = _read_line()
        if line:
            with contextlib.suppress(OSError):  # at once: the process may be ended at any time
                history.parent.mkdir(parents=True, exist_ok=True)
                readline.write_history_file(history)
        return line

    return read


def _read_line() -> str:
    """Returns the line typed at the prompt, "" at the end of input."""
    from waiter_cli.console.output import print_text

    try:
        return input("?- ") + "\n"
    except EOFError:
        print_text("")
        return ""
