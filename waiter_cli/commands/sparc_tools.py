"""``waiter sparc check|translate|query|fetch-jar``: the SPARC tool chain by itself."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import (
    JsonOption,
    SparcJarOption,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from sparc.asp import AspProgram
    from sparc.query import Answer
    from waiter_cli.jar_store import JarRelease

__all__ = ["annotated", "app", "check", "fetch_jar", "query", "translate"]

app = typer.Typer(
    help="""The SPARC tool chain by itself.

    \b
    Examples:
      waiter sparc check family.sparc
      waiter sparc query family.sparc --query 'parent(anna,X)'
    """,
    no_args_is_help=True,
    rich_markup_mode=None,
)

ProgramArgument = Annotated[
    str, typer.Argument(metavar="PROGRAM", help="A SPARC program; - is standard input.")
]


# ------------------------------------------------------------------ check


@app.command()
def check(
    program: ProgramArgument,
    warnings: Annotated[
        bool, typer.Option("--warnings", help="Report what is legal but probably a mistake, too.")
    ] = False,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
) -> int:
    """Find every fault of a program: syntax, sorts, predicates, rules.

    \b
    Examples:
      waiter sparc check family.sparc --warnings
      waiter sparc check - --json < family.sparc
    """
    import sparc
    from sparc.diagnostics import as_dict
    from waiter_cli.output import print_json, print_source_faults, say, styled
    from waiter_cli.program_file import read_program

    source = read_program(program)
    if translator is TranslatorName.jar:
        if _translated(source, translator, sparc_jar, time_limit) is None:
            return _out_of_time(as_json)
        if not warnings:
            if as_json:
                print_json({"status": "ok", "warnings": []})
            else:
                say(f"{source.name}: {styled('no fault', 'green')}.")
            return 0
    typed = sparc.check(sparc.parse(source))
    sparc.translate(typed)
    found = sparc.find_warnings(typed) if warnings else ()
    numbers = {
        "sorts": len(typed.program.sorts),
        "predicates": len(typed.program.predicates),
        "rules": len(typed.program.statements),
    }
    if as_json:
        print_json({"status": "ok", **numbers, "warnings": [as_dict(each) for each in found]})
        return 0
    if found:
        print_source_faults(found)
    sizes = ", ".join(
        f"{number} {name if number != 1 else name[:-1]}" for name, number in numbers.items()
    )
    say(f"{source.name}: {styled('no fault', 'green')} in {sizes}.")
    return 0


def _translated(
    source: Any, translator: TranslatorName, sparc_jar: str | None, time_limit: float | None
) -> AspProgram | None:
    """The translation, None when the time was up."""
    from sparc.solvers.jar import TranslationTimeout
    from waiter_cli.commands.options import load_translator

    try:
        return load_translator(translator, sparc_jar).translate(source, time_limit=time_limit)
    except TranslationTimeout:
        return None


def _out_of_time(as_json: bool) -> int:
    from waiter_cli.exits import Exit
    from waiter_cli.output import print_json

    if as_json:
        print_json({"status": "undecided", "limit": "time"})
    print("waiter: the time limit was reached.", file=sys.stderr)
    return Exit.UNDECIDED


# ------------------------------------------------------------------ translate


@app.command()
def translate(
    program: ProgramArgument,
    output: Annotated[
        Optional[str],
        typer.Option("--output", "-o", metavar="FILE", help="Write FILE instead of printing."),
    ] = None,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
) -> int:
    """Translate a program for clingo; above each rule stands the SPARC it comes from.

    \b
    Examples:
      waiter sparc translate family.sparc
      waiter sparc translate family.sparc -o family.lp
    """
    from waiter_cli.program_file import read_program

    asp = _translated(read_program(program), translator, sparc_jar, time_limit)
    if asp is None:
        return _out_of_time(as_json)
    text = annotated(asp)
    file = None if output == "-" else output
    if file is not None:
        from waiter_cli.writing import write_whole

        write_whole(file, text)
    if as_json:
        from waiter_cli.output import print_json

        print_json({"status": "ok", "file": file, "text": text})
    elif file is None:
        sys.stdout.write(text)
    return 0


def annotated(program: AspProgram) -> str:
    """The clingo program with a comment above what each SPARC statement became.

    The comment has the place of the statement and its lines.
    """
    from itertools import zip_longest

    lines: list[str] = []
    before: Any = None
    texts = program.text.rstrip("\n").split("\n")
    spans = program.line_spans[: len(texts)]
    for text, span in zip_longest(texts, spans):
        if span is not None and span is not before:
            lines += ["", f"% {_on_one_line(span.location.name)}:{span.location.line}"]
            lines += [f"%   {line.rstrip()}" for line in span.text.split("\n")]
        elif span is None and (before is not None or not lines):
            lines += ["", "% what the rules need to know of sorts and constants"]
        lines.append(text)
        before = span
    shown = program.show.rstrip("\n")
    return "\n".join([*lines, "", "% what is shown", shown, ""]).lstrip("\n")


def _on_one_line(name: str) -> str:
    """The name of a file as a comment can hold it."""
    return "".join(c if c >= " " else ascii(c)[1:-1] for c in name)


# ------------------------------------------------------------------ query


@app.command()
def query(
    program: ProgramArgument,
    queries: Annotated[
        Optional[list[str]],
        typer.Option("--query", "-q", metavar="LITERAL", help="Ask this; may be given again."),
    ] = None,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
) -> int:
    """Ask a program about literals: yes, no, unknown, or the bindings of variables.

    A literal is true when all answer sets have it, false when all have its
    contrary. Without --query a prompt asks for literals, until exit or the end
    of input.

    \b
    Examples:
      waiter sparc query family.sparc --query 'parent(X,carla)'
      waiter sparc query family.sparc
    """
    from waiter_cli.exits import Exit, InputError
    from waiter_cli.output import print_json
    from waiter_cli.program_file import read_program

    if program == "-" and not queries:
        raise InputError("standard input cannot be program and prompt at once", "give --query")
    if as_json and not queries:
        raise InputError("--json answers a --query", "give --query LITERAL")
    ask = _asker(read_program(program), translator, sparc_jar, time_limit)
    if not queries:
        return _prompt(ask)
    answers = [(text, ask(text)) for text in queries]
    if as_json:
        documents = [_answer_document(text, answer) for text, answer in answers]
        print_json(documents[0] if len(documents) == 1 else {"answers": documents})
    code = Exit.OK
    for text, answer in answers:
        verdict = answer.verdict.value
        if verdict == "inconsistent":
            print(f"waiter: {program} is inconsistent: it has no answer set.", file=sys.stderr)
            return Exit.PROVED
        if verdict == "undecided":
            print(f"waiter: {text}: the time limit was reached.", file=sys.stderr)
            code = Exit.UNDECIDED
        elif not as_json:
            print(answer)
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
    """The function that answers queries about ``source``; the program's faults come at once."""
    import sparc

    if translator is TranslatorName.native:
        typed = sparc.check(sparc.parse(source))
        return lambda text: sparc.query(typed, text, time_limit=time_limit)
    from sparc.query import Answer, Verdict

    asp = _translated(source, translator, sparc_jar, time_limit)
    if asp is None:
        return lambda text: Answer(Verdict.UNDECIDED)
    from waiter_cli.asp_query import ask_asp
    from waiter_cli.jar_store import jar_errors

    typed = sparc.check(sparc.parse(source))
    program = asp

    def ask(text: str) -> Answer:
        with jar_errors():
            return ask_asp(program, typed, text, time_limit=time_limit)

    return ask


def _prompt(ask: Callable[[str], Answer]) -> int:
    """Answers line by line; on a terminal with a prompt and a history."""
    from sparc.errors import SourceError, SourceErrors
    from waiter_cli.output import print_source_faults

    interactive = sys.stdin.isatty() and sys.stdout.isatty()
    read = _reader() if interactive else sys.stdin.readline
    while line := read():
        text = line.strip()
        if text.removesuffix(".") in ("exit", "quit"):
            break
        if not text or text.startswith("%"):
            continue
        try:
            answer = ask(text)
        except (SourceError, SourceErrors) as error:
            print_source_faults(error.errors if isinstance(error, SourceErrors) else (error,))
            sys.stderr.flush()
            continue
        verdict = answer.verdict.value
        if verdict == "inconsistent":
            from waiter_cli.exits import Exit

            print("waiter: the program is inconsistent.", file=sys.stderr)
            return Exit.PROVED
        print("the time limit was reached" if verdict == "undecided" else answer, flush=True)
    return 0


def _reader() -> Callable[[], str]:
    """Reads a line at the prompt; "" at the end of input.  The history lasts between runs."""
    import contextlib

    from waiter_cli.exits import MissingError
    from waiter_cli.jar_store import store_path

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
    """The line typed at the prompt, "" at the end of input."""
    try:
        return input("?- ") + "\n"
    except EOFError:
        print()
        return ""


# ------------------------------------------------------------------ fetch-jar


@app.command("fetch-jar")
def fetch_jar(
    version: Annotated[
        str, typer.Option("--version", metavar="VERSION", help="Which version: 2.57 or 2.56.")
    ] = "2.57",
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Do not ask.")] = False,
    url: Annotated[
        Optional[str], typer.Option("--url", metavar="URL", help="Download it from here instead.")
    ] = None,
    timeout: Annotated[
        float,
        typer.Option("--timeout", min=0.1, metavar="SECONDS", help="Longest wait for the network."),
    ] = 30.0,
    as_json: JsonOption = False,
) -> int:
    """Download the original sparc.jar, verify it, and install it for this user.

    \b
    Examples:
      waiter sparc fetch-jar
      waiter sparc fetch-jar --yes --version 2.56
    """
    from waiter_cli.exits import Exit, InputError
    from waiter_cli.jar_store import RELEASES, FoundJar, fetch, store_path

    release = RELEASES.get(version.lower().removeprefix("v"))
    if release is None:
        raise InputError(f"--version {version}: not known", f"known are {', '.join(RELEASES)}")
    target = store_path()
    if os.path.isfile(target) and FoundJar(target, "store").sha256() == release.sha256:
        if as_json:
            _print_installed(release, str(target), fetched=False)
        else:
            print(f"sparc.jar V{release.version} is installed already: {target}")
        return 0
    address = url or release.url
    if not yes and not _agreed(
        f"Download sparc.jar V{release.version} ({release.size // 1024} kB, BSD licence)\n"
        f"  from {address}\n  to   {target}?"
    ):
        print("waiter: nothing was downloaded.", file=sys.stderr)
        return Exit.INTERRUPTED
    with _Progress(f"sparc.jar V{release.version}") as progress:
        fetch(release, target, url=url, timeout=timeout, progress=progress.update)
    if as_json:
        _print_installed(release, str(target), fetched=True)
    else:
        print(f"sparc.jar V{release.version} is installed, its sha256 verified: {target}")
    return 0


def _print_installed(release: JarRelease, path: str, *, fetched: bool) -> None:
    from waiter_cli.output import print_json

    print_json(
        {
            "status": "installed",
            "version": release.version,
            "path": path,
            "sha256": release.sha256,
            "fetched": fetched,
        }
    )


def _agreed(question: str) -> bool:
    """Whether the person at the terminal says yes."""
    from waiter_cli.exits import InputError

    if not sys.stdin.isatty():
        raise InputError("nobody can be asked here before the download", "give --yes")
    print(f"{question} [y/N] ", end="", file=sys.stderr, flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")


class _Progress:
    """A bar on stderr once something arrives, where that is a terminal that can take it away again."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._bar: Any = None
        self._task: Any = None
        self._shown = False

    def __enter__(self) -> _Progress:
        self._shown = sys.stderr.isatty() and os.environ.get("TERM") not in ("dumb", "unknown")
        return self

    def update(self, done: int, total: int | None) -> None:
        """Shows ``done`` of ``total`` bytes."""
        if self._shown and self._bar is None and done:
            from rich.console import Console
            from rich.progress import BarColumn, DownloadColumn, Progress, TextColumn

            columns = (TextColumn("{task.description}"), BarColumn(), DownloadColumn())
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            self._bar.start()
            self._task = self._bar.add_task(self._label, completed=done, total=total)
        if self._bar is not None:
            self._bar.update(self._task, completed=done, total=total)

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.stop()
