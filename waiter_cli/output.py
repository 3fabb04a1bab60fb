"""What a person sees: plans, faults and results as text.

Results go to stdout, faults and progress to stderr.  On a terminal lines are broken at words to its
width (`say`); into a pipe or a file they go whole.  Colour appears on a terminal only, and never
with ``NO_COLOR``.
"""

from __future__ import annotations

import errno
import json
import os
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from waiter_cli.exits import Exit, Fault, InputError, MissingError
from waiter_cli.streams import printable_json
from waiter_cli.wrapping import columns, table_lines, wrapped

if TYPE_CHECKING:
    from sparc.errors import SourceError
    from waiter_cli.decision import Explanation
    from waiter_cli.search_types import Stage
    from waiter_cli.situation import Where

__all__ = [
    "print_diagnoses",
    "print_faults",
    "print_json",
    "print_source_faults",
    "print_stages",
    "print_table",
    "report_error",
    "say",
    "styled",
]


def _wants_colour(stream: Any) -> bool:
    return (
        bool(stream.isatty())
        and not os.environ.get("NO_COLOR")
        and os.environ.get("TERM") != "dumb"
    )


_CODES = {
    "red": "31",
    "green": "32",
    "yellow": "33",
    "blue": "34",
    "cyan": "36",
    "bold": "1",
    "dim": "2",
}


def styled(text: str, style: str, stream: Any = None) -> str:
    """``text`` in a style (``red``, ``bold``, …), where ``stream`` (stdout) takes colour."""
    if not _wants_colour(sys.stdout if stream is None else stream):
        return text
    return f"\x1b[{';'.join(_CODES[word] for word in style.split())}m{text}\x1b[0m"


def say(text: str, stream: Any = None, hang: int = 2) -> None:
    """Prints text for people on ``stream`` (stdout): on a terminal no line is broken inside a word.

    What a line carries over is indented by ``hang`` more than the line itself.
    """
    stream = sys.stdout if stream is None else stream
    width = columns(stream)
    print(text if width is None else wrapped(text, width, hang), file=stream)


def print_json(document: Any) -> None:
    """One JSON document on stdout."""
    print(printable_json(json.dumps(document, ensure_ascii=False)))


def print_stages(stages: Iterable[Stage]) -> None:
    """What each stage of a search did and how long it took, on stderr: the answer to ``-v``."""
    for stage in stages:
        head = f"{stage.name:>10}  {stage.seconds * 1000:8.1f} ms  "
        say(f"{head}{stage.outcome}", sys.stderr, len(head.lstrip()))


def print_diagnoses(diagnoses: Sequence[Explanation]) -> None:
    """How what was observed can have come about, where it is a surprise."""
    if diagnoses:
        say(styled("What was observed is a surprise; it may have come about so:", "bold"))
        for diagnosis in diagnoses:
            say(f"  {'; '.join(diagnosis.text)}")


def print_faults(faults: Iterable[Fault], word: str = "error") -> None:
    """``FILE:LINE:COLUMN: error: what`` on stderr, with the line of the file and the mend."""
    room = max(20, min(100, (columns(sys.stderr) or 108) - len("12345 | ")))
    for fault in faults:
        place = f"{fault.where}: " if fault.where else ""
        style = "bold yellow" if word == "warning" else "bold red"
        say(f"{place}{styled(word + ':', style, sys.stderr)} {fault.message}", sys.stderr, 4)
        excerpt = fault.excerpt
        if excerpt is None and word == "error":  # advice goes without, being many lines already
            excerpt = _line_of(fault.where)
        if excerpt is not None and fault.where and fault.where.line:
            line, column = _around(excerpt, fault.where.column, room)
            print(f"{fault.where.line:>5} | {line}", file=sys.stderr)
            pad = "".join("\t" if c == "\t" else " " for c in line[: column - 1])
            print(f"      | {pad}{styled('^', style, sys.stderr)}", file=sys.stderr)
        if fault.hint:
            say(f"  hint: {fault.hint}", sys.stderr, len("hint: "))


def _line_of(where: Where | None) -> str | None:
    """The line of a file, for a fault that was found when its text was no longer at hand."""
    if where is None or where.line < 1:
        return None
    from itertools import islice

    from sparc.reading import MAX_PROGRAM, read_capped

    try:
        if not os.path.isfile(where.name):  # a device or a pipe is not read again
            return None
        text = read_capped(where.name, MAX_PROGRAM).decode("utf-8-sig")
    except (OSError, ValueError):
        return None
    line = next(islice(text.split("\n"), where.line - 1, None), None)
    return None if line is None else line.rstrip("\r")


def _meant(message: str, context: Any) -> str:
    """The choice nearest to a wrong one, or the options left out before names of layouts and scenarios."""
    import re

    from waiter_cli.resources import built_in, is_layout

    wrong = re.search(r"'([^']+)' is not one of (.*)\.$", message)
    if wrong is not None:
        import difflib

        near = difflib.get_close_matches(wrong[1], re.findall(r"'([^']+)'", wrong[2]), 1)
        return near[0] if near else ""
    extra = re.fullmatch(r"Got unexpected extra argument\S* \((.*)\)", message)
    if extra is None or context is None:
        return ""
    options = {name for each in context.command.params for name in each.opts}
    meant: dict[str, str] = {}
    for word in extra[1].split():
        kinds = [kind for kind in ("scenario", "layout") if word in built_in(kind)]
        if word.endswith((".yaml", ".yml")) and os.path.isfile(word):
            kinds = ["layout" if is_layout(word) else "scenario"]
        for kind in kinds:
            if f"--{kind}" in options:
                meant.setdefault(kind, f"--{kind} {word}")
    return " ".join(meant.values())


def print_source_faults(faults: Iterable[SourceError]) -> None:
    """Faults and warnings of a SPARC program on stderr, each with the line of the program."""
    from sparc.diagnostics import render_all

    room = max(20, min(160, (columns(sys.stderr) or 170) - len("12345 | ……")))
    for line in render_all(faults, room).split("\n"):
        if line[5:8] == " | ":
            print(line, file=sys.stderr)
        else:
            say(line, sys.stderr, len("hint: ") if line.startswith(" ") else 4)


def _around(line: str, column: int, width: int) -> tuple[str, int]:
    """A line cut to ``width`` about a column (from 1), and that column of what is left.

    >>> _around("abcdefghij", 9, 6)
    ('…ghij', 4)
    """
    if len(line) <= width:
        return line, column
    first = max(0, min(column - 1 - width // 3, len(line) - width + 2))
    cut = line[first : first + width - 2]
    before, after = "…" if first else "", "…" if first + width - 2 < len(line) else ""
    return before + cut + after, column - first + len(before)


_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS)


def fault_document(fault: Fault) -> dict[str, Any]:
    """A fault in the shape of the contract's JSON errors."""
    where = fault.where
    return {
        "message": fault.message,
        "file": where.name if where else None,
        "line": where.line or None if where else None,
        "column": where.column or None if where else None,
        "hint": fault.hint,
    }


def _error_document(errors: Sequence[dict[str, Any]]) -> dict[str, Any]:
    return {"status": "error", "errors": list(errors)}


def report_error(error: Exception, *, as_json: bool) -> int:
    """Prints an exception that reached the front door, and returns its exit code."""
    if isinstance(error, InputError):
        if as_json:
            print_json(_error_document([fault_document(fault) for fault in error.faults]))
        else:
            print_faults(error.faults)
        return Exit.INPUT
    if isinstance(error, MissingError):
        if as_json:
            hint = {
                "message": error.message,
                "file": None,
                "line": None,
                "column": None,
                "hint": error.mend,
            }
            print_json(_error_document([hint]))
        else:
            say(f"waiter: {error.message}", sys.stderr)
            say(f"  hint: {error.mend}", sys.stderr, len("hint: "))
        return Exit.MISSING
    sparc_code = _report_sparc(error, as_json)
    if sparc_code is not None:
        return sparc_code
    if hasattr(error, "format_message"):  # a usage error of the command line's
        return _report_usage(error, as_json)
    if isinstance(error, OSError) and (error.filename is not None or error.errno in _NO_ROOM):
        message = f"{error.filename or 'cannot write'}: {error.strerror}"
        if as_json:
            print_json(_error_document([fault_document(Fault(None, message))]))
        else:
            say(f"waiter: {message}", sys.stderr)
        return Exit.INPUT
    message = f"internal fault: {type(error).__name__}: {' '.join(str(error).split())}"
    if as_json:
        print_json(
            _error_document(
                [fault_document(Fault(None, message, "run again with --debug for the traceback"))]
            )
        )
    else:
        say(f"waiter: {message}; run again with --debug for the traceback", sys.stderr)
    return Exit.INTERNAL


def _report_sparc(error: Exception, as_json: bool) -> int | None:
    """The exit code of an error of `sparc`, printed; None for any other."""
    from sparc.errors import LimitError, SolverError, SourceError, SourceErrors

    if isinstance(error, SourceErrors):
        errors = error.errors
    elif isinstance(error, SourceError):
        errors = (error,)
    else:
        return None
    from sparc.diagnostics import as_dict

    if as_json:
        print_json(_error_document([as_dict(one) for one in errors]))
    else:
        print_source_faults(errors)
    if any(isinstance(one, SolverError) for one in errors):
        return Exit.INTERNAL
    if any(isinstance(one, LimitError) for one in errors):
        return Exit.UNDECIDED
    return Exit.INPUT


def _nearest(message: str, context: Any) -> str:
    """A message about an unknown option or command, with the names that it may be short for, or the
    nearest that was found."""
    import difflib
    import re

    found = re.match(r"No such option: (\S+)|No such command '(.*?)'", message)
    if found is None or context is None:
        return message
    typed, command = found[1] or found[2], context.command
    known = {name for each in command.params for name in each.opts} if found[1] else ()
    if found[2]:
        known = command.list_commands(context)
    names = sorted(name for name in known if len(typed) > len("--") and name.startswith(typed))
    if not names:
        near = difflib.get_close_matches(typed, known, 2)
        ratios = [difflib.SequenceMatcher(None, typed, name).ratio() for name in near]
        names = [name for name, ratio in zip(near, ratios) if ratio > ratios[0] - 0.1]
    if not names:
        return found[0]
    return f"{found[0]}. Did you mean {' or '.join(names)}?"


def _report_usage(error: Any, as_json: bool) -> int:
    context = getattr(error, "ctx", None)
    message = _nearest(error.format_message(), context)
    if type(error).__name__ == "NoArgsIsHelpError":
        print(message)
        return Exit.INPUT
    help_line = f"see {context.command_path} --help" if context is not None else "see waiter --help"
    meant = _meant(message, context)
    if meant:
        help_line = f"did you mean {meant}? {help_line}"
    if as_json:
        print_json(_error_document([fault_document(Fault(None, message, help_line))]))
    else:
        if context is not None:
            print(context.get_usage(), file=sys.stderr)
        say(f"waiter: {message}", sys.stderr)
        say(f"  hint: {help_line}", sys.stderr, len("hint: "))
    return Exit.INPUT


def print_table(
    headings: Sequence[str],
    rows: Sequence[Sequence[str]],
    right: Sequence[int] = (0,),
    prose: int | None = None,
) -> None:
    """A table on stdout; on a terminal that is too narrow the column ``prose`` gives way."""
    head, *body = table_lines(headings, rows, right, prose, columns(sys.stdout))
    print("\n".join([styled(head, "bold"), *body]))
