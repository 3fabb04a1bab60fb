"""What a person sees: plans, faults and results as text; rich is loaded for a terminal only.

Results go to stdout, faults and progress to stderr.  Colour appears on a terminal only, and never
with ``NO_COLOR``.
"""

from __future__ import annotations

import errno
import json
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from waiter_cli.exits import Exit, Fault, InputError, MissingError
from waiter_cli.streams import printable_json

if TYPE_CHECKING:
    from waiter_cli.decision import Explanation
    from waiter_cli.search_types import Stage

__all__ = [
    "print_diagnoses",
    "print_faults",
    "print_json",
    "print_stages",
    "print_table",
    "report_error",
    "styled",
    "table_lines",
]


def _wants_colour(stream: Any) -> bool:
    import os

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


def print_json(document: Any) -> None:
    """One JSON document on stdout."""
    print(printable_json(json.dumps(document, ensure_ascii=False)))


def print_stages(stages: Iterable[Stage]) -> None:
    """What each stage of a search did and how long it took, on stderr: the answer to ``-v``."""
    for stage in stages:
        print(f"{stage.name:>10}  {stage.seconds * 1000:8.1f} ms  {stage.outcome}", file=sys.stderr)


def print_diagnoses(diagnoses: Sequence[Explanation]) -> None:
    """How what was observed can have come about, where it is a surprise."""
    if diagnoses:
        print(styled("What was observed is a surprise; it may have come about so:", "bold"))
        for diagnosis in diagnoses:
            print(f"  {'; '.join(diagnosis.text)}")


def print_faults(faults: Iterable[Fault], word: str = "error") -> None:
    """``FILE:LINE:COLUMN: error: what`` on stderr, with the line of the file and the mend."""
    for fault in faults:
        place = f"{fault.where}: " if fault.where else ""
        style = "bold yellow" if word == "warning" else "bold red"
        print(f"{place}{styled(word + ':', style, sys.stderr)} {fault.message}", file=sys.stderr)
        if fault.excerpt is not None and fault.where and fault.where.line:
            line, column = _around(fault.excerpt, fault.where.column)
            print(f"{fault.where.line:>5} | {line}", file=sys.stderr)
            pad = "".join("\t" if c == "\t" else " " for c in line[: column - 1])
            print(f"      | {pad}{styled('^', style, sys.stderr)}", file=sys.stderr)
        if fault.hint:
            print(f"  hint: {fault.hint}", file=sys.stderr)


def _around(line: str, column: int, width: int = 100) -> tuple[str, int]:
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
            print(f"waiter: {error.message}\n  mend: {error.mend}", file=sys.stderr)
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
            print(f"waiter: {message}", file=sys.stderr)
        return Exit.INPUT
    message = f"internal fault: {type(error).__name__}: {' '.join(str(error).split())}"
    if as_json:
        print_json(
            _error_document(
                [fault_document(Fault(None, message, "run again with --debug for the traceback"))]
            )
        )
    else:
        print(f"waiter: {message}; run again with --debug for the traceback", file=sys.stderr)
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
    from sparc.diagnostics import as_dict, render_all

    if as_json:
        print_json(_error_document([as_dict(one) for one in errors]))
    else:
        print(render_all(errors), file=sys.stderr)
    if any(isinstance(one, SolverError) for one in errors):
        return Exit.INTERNAL
    if any(isinstance(one, LimitError) for one in errors):
        return Exit.UNDECIDED
    return Exit.INPUT


def _report_usage(error: Any, as_json: bool) -> int:
    message = error.format_message()
    context = getattr(error, "ctx", None)
    if type(error).__name__ == "NoArgsIsHelpError":
        print(message)
        return Exit.INPUT
    help_line = f"see {context.command_path} --help" if context is not None else "see waiter --help"
    if as_json:
        print_json(_error_document([fault_document(Fault(None, message, help_line))]))
    else:
        if context is not None:
            print(context.get_usage(), file=sys.stderr)
        print(f"waiter: {message}\n  hint: {help_line}", file=sys.stderr)
    return Exit.INPUT


def table_lines(
    headings: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int] = (0,)
) -> list[str]:
    """Rows as aligned plain text, two spaces apart; columns in ``right`` end at the same place."""
    widths = [max(len(row[i]) for row in [headings, *rows]) for i in range(len(headings))]
    lines = []
    for row in [headings, *rows]:
        cells = [
            text.rjust(width) if i in right else text.ljust(width)
            for i, (text, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(cells).rstrip())
    return lines


def print_table(
    headings: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int] = (0,)
) -> None:
    """A table on stdout: rich's on a terminal, plain aligned text elsewhere."""
    if not _wants_colour(sys.stdout):
        print("\n".join(table_lines(headings, rows, right)))
        return
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, header_style="bold", pad_edge=False)
    for i, heading in enumerate(headings):
        table.add_column(heading, justify="right" if i in right else "left", overflow="fold")
    for row in rows:
        table.add_row(*(cell.replace("[", r"\[") for cell in row))
    Console().print(table)
