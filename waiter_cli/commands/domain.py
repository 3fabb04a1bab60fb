"""``waiter domain new|test|show``: the rules of a restaurant, begun, tested and read."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import DomainOption, JsonOption, OutputOption

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sparc.source import Source
    from waiter_cli.domain_tests.coverage import Statement
    from waiter_cli.domain_tests.verdicts import CaseVerdict

__all__ = ["app", "new", "run_tests", "show"]

app = typer.Typer(
    help="""The rules of a restaurant, begun, tested and read.

    \b
    Examples:
      waiter domain show --grep seat
      waiter domain test -k seat
      waiter domain new greeting -o greeting.sparc
    """,
    no_args_is_help=True,
    rich_markup_mode=None,
)


# ------------------------------------------------------------------ new


@app.command("new")
def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="What the domain is called.")],
    start: Annotated[
        str,
        typer.Option("--from", metavar="DOMAIN", help="The rules to begin from."),
    ] = "restaurant",
    output: OutputOption = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace FILE where it is there already.")
    ] = False,
    as_json: JsonOption = False,
) -> int:
    """Begin rules of your own: those of another domain, with an action more, to be changed.

    The new domain runs as it stands: the robot can greet the party at a table. What was added is
    marked with NAME.

    \b
    Examples:
      waiter domain new greeting -o greeting.sparc
      waiter domain new greeting --from restaurant -o greeting.sparc --force
    """
    from waiter_cli.console.output import print_document, print_json, print_text
    from waiter_cli.encoding.new_domain import begin_domain
    from waiter_cli.errors import InputError
    from waiter_cli.yaml_reading.node_reader import NAME_RULE, is_identifier

    if not is_identifier(name):
        raise InputError(f"{name[:40]!r} is no name for a domain", NAME_RULE)
    if output is not None and os.path.exists(output) and not force:
        raise InputError(
            f"{output} is there already", "give another name, or --force to replace it"
        )
    template, _ = _find(start)
    text = begin_domain(template, name)
    if output is not None:
        from waiter_cli.file_access.atomic import write_whole

        write_whole(output, text)
        print_text(f"wrote {output}; plan with --domain {output}", sys.stderr)
    if as_json:
        print_json({"status": "made", "domain": name, "file": output, "text": text})
    elif output is None:
        print_document(text)
    return 0


# ------------------------------------------------------------------ test


@app.command("test")
def run_tests(
    domain: DomainOption = "restaurant",
    keyword: Annotated[
        Optional[str],
        typer.Option(
            "-k", metavar="TEXT", help="Only cases whose name or file's name has this text."
        ),
    ] = None,
    coverage: Annotated[
        bool, typer.Option("--coverage", help="List the rules that fired in no case, too.")
    ] = False,
    as_json: JsonOption = False,
) -> int:
    """Check a domain against its cases: what is given, what happens, what must follow.

    The cases are YAML files in the folder cases/ beside the domain. Exit code 0: every case
    passed; 3: some did not; 2: a case or the domain is written wrongly.

    \b
    Examples:
      waiter domain test
      waiter domain test -k seat --coverage
      waiter domain test --domain my/domain.sparc --json
    """
    import time

    from waiter_cli.domain_tests.case_reader import read_case_folder
    from waiter_cli.domain_tests.coverage import find_coverage
    from waiter_cli.domain_tests.programs import make_programs
    from waiter_cli.domain_tests.verdicts import run_programs
    from waiter_cli.errors import Exit, InputError

    start = time.monotonic()
    template, folder = _find(domain)
    cases = read_case_folder(folder)
    if keyword is not None:
        wanted = keyword.casefold()
        files = {case.where.name for case in cases if wanted in _stem(case.where.name).casefold()}
        cases = tuple(
            case for case in cases if case.where.name in files or wanted in case.name.casefold()
        )
        if not cases:
            raise InputError(f"no case has {keyword!r} in its name", "leave -k out to run all")
    programs = make_programs(template, cases)
    verdicts = run_programs(programs)
    statements = find_coverage(template, programs) if coverage else None
    seconds = time.monotonic() - start
    if as_json:
        _print_document(template.name, verdicts, statements, seconds)
    else:
        _print_verdicts(verdicts, seconds)
        if statements is not None:
            _print_coverage(template.name, statements)
    return Exit.OK if all(verdict.passed for verdict in verdicts) else Exit.PROVED


def _find(name: str) -> tuple[Source, str]:
    """Returns a domain's template and the folder of its cases; `InputError` where there is no domain."""
    from sparc.source import Source
    from waiter_cli.encoding.domains import require_program
    from waiter_cli.file_access.locate import built_in, read_text

    inner = os.path.join(name, "domain.sparc")
    in_folder = name not in built_in("domain") and os.path.isfile(inner)
    file = read_text(inner if in_folder else name, "domain")
    folder = os.path.dirname(file.path or "")
    return require_program(Source(file.shown, file.text)), os.path.join(folder, "cases")


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


def _print_verdicts(verdicts: Sequence[CaseVerdict], seconds: float) -> None:
    from waiter_cli.console.output import print_text, say
    from waiter_cli.console.styling import styled

    files: dict[str, list[CaseVerdict]] = {}
    for verdict in verdicts:
        files.setdefault(verdict.case.where.name, []).append(verdict)
    width = max(map(len, files))
    for name, found in files.items():
        red = sum(not verdict.passed for verdict in found)
        said = styled(f"{red} failed", "bold red") if red else styled("passed", "green")
        print_text(
            f"{name:<{width}}  {len(found):>3} {'case ' if len(found) == 1 else 'cases'}  {said}"
        )
    failed = [verdict for verdict in verdicts if not verdict.passed]
    for verdict in failed:
        case = verdict.case
        say(f"\n{styled('FAILED', 'bold red')} {case.where}: {case.name}")
        for failure in verdict.failures:
            say(f"  {failure.where.line}:{failure.where.column}: {failure.message}")
            if failure.instead:
                say(f"      {failure.instead}")
    passed = len(verdicts) - len(failed)
    total = f"{passed} of {len(verdicts)} cases passed, in {seconds:.1f} s."
    say(f"\n{styled(total, 'bold red' if failed else 'bold green')}")


def _print_coverage(name: str, statements: Sequence[Statement]) -> None:
    from textwrap import wrap

    from waiter_cli.console.output import print_text, say
    from waiter_cli.console.styling import styled

    idle = [statement for statement in statements if not statement.fired]
    fired = len(statements) - len(idle)
    say(f"\n{fired} of {len(statements)} statements of {name} fired in some case.")
    for statement in idle:
        say(f"\n{styled(f'{name}:{statement.place[0]}', 'yellow')}: never fired")
        for text, indent in ((statement.sentence, "  "), (statement.text, "    ")):
            for line in wrap(text, 79, initial_indent=indent, subsequent_indent=indent):
                print_text(line)


def _print_document(
    name: str,
    verdicts: Sequence[CaseVerdict],
    statements: Sequence[Statement] | None,
    seconds: float,
) -> None:
    from waiter_cli.console.output import print_json
    from waiter_cli.errors import Where
    from waiter_cli.files.documents import place_document

    document: dict[str, Any] = {
        "status": "passed" if all(verdict.passed for verdict in verdicts) else "failed",
        "domain": name,
        "passed": sum(verdict.passed for verdict in verdicts),
        "failed": sum(not verdict.passed for verdict in verdicts),
        "cases": [
            {
                "name": verdict.case.name,
                "file": verdict.case.where.name,
                "line": verdict.case.where.line,
                "passed": verdict.passed,
                "failures": [
                    {
                        "message": failure.message,
                        "instead": failure.instead,
                        **place_document(failure.where),
                    }
                    for failure in verdict.failures
                ],
            }
            for verdict in verdicts
        ],
        "seconds": round(seconds, 3),
    }
    if statements is not None:
        document["coverage"] = [
            {
                **place_document(Where(name, *statement.place)),
                "statement": statement.text,
                "sentence": statement.sentence,
                "fired": statement.fired,
            }
            for statement in statements
        ]
    print_json(document)


# ------------------------------------------------------------------ show


@app.command()
def show(
    domain: DomainOption = "restaurant",
    grep: Annotated[
        Optional[str],
        typer.Option("--grep", metavar="TEXT", help="Only what has this text in words or rules."),
    ] = None,
    markdown: Annotated[
        bool, typer.Option("--markdown", help="Write a page in Markdown, for print or the web.")
    ] = False,
    source: Annotated[
        bool, typer.Option("--source", help="Print the file as it is, to copy and change it.")
    ] = False,
    as_json: JsonOption = False,
) -> int:
    """Print the sections and rules of a domain, each with the sentence that explains it.

    \b
    Examples:
      waiter domain show
      waiter domain show --grep seat
      waiter domain show --markdown > domain.md
      waiter domain show --source > own.sparc
    """
    from waiter_cli.console.output import print_document, print_json, print_text
    from waiter_cli.console.styling import styled
    from waiter_cli.domain_tests.sentences import page, read_blocks, shown_lines

    template, _ = _find(domain)
    if source:
        _print_source(template, markdown, grep, as_json)
        return 0
    blocks = [block for block in read_blocks(template.text) if grep is None or block.mentions(grep)]
    if as_json:
        print_json(
            {
                "domain": template.name,
                "blocks": [
                    {
                        "section": block.section,
                        "parts": list(block.parts),
                        "sentence": block.sentence,
                        "line": block.line,
                        "lines": [{"line": n, "text": text} for n, text in block.lines],
                    }
                    for block in blocks
                ],
            }
        )
        return 0
    if not blocks:
        print_text(f"{template.name}: nothing mentions {grep!r}.", sys.stderr)
        return 0
    if markdown:
        print_document(page(blocks))
        return 0
    styles = {"section": "bold", "sentence": "green"}
    for style, line in shown_lines(blocks):
        print_text(styled(line, styles[style]) if style in styles else line)
    return 0


def _print_source(template: Source, markdown: bool, grep: str | None, as_json: bool) -> None:
    """Prints the whole text of a domain; raises `InputError` where only a part or a page is asked for."""
    from waiter_cli.console.output import print_document, print_json
    from waiter_cli.errors import InputError

    if markdown or grep is not None:
        other = "--markdown" if markdown else "--grep"
        raise InputError(
            f"--source and {other} exclude each other",
            "--source prints the file as it is, all of it: leave one out",
        )
    if as_json:
        print_json({"domain": template.name, "source": template.text})
        return
    print_document(template.text)
