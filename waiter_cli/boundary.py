"""The error boundary: exceptions → text or a JSON document, and an exit code."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from waiter_cli.console.output import print_faults, print_json, print_source_faults, print_text, say
from waiter_cli.errors import Exit, Fault, InputError, MissingError
from waiter_cli.files.documents import fault_document

if TYPE_CHECKING:
    pass

__all__ = ["report_error"]


def _meant(message: str, context: Any) -> str:
    """The choice nearest to a wrong one, or the options left out before names of layouts and scenarios."""
    import re

    from waiter_cli.files.locate import built_in, is_layout

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


_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS)


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
        print_text(message)
        return Exit.INPUT
    help_line = f"see {context.command_path} --help" if context is not None else "see waiter --help"
    meant = _meant(message, context)
    if meant:
        help_line = f"did you mean {meant}? {help_line}"
    if as_json:
        print_json(_error_document([fault_document(Fault(None, message, help_line))]))
    else:
        if context is not None:
            print_text(context.get_usage(), sys.stderr)
        say(f"waiter: {message}", sys.stderr)
        say(f"  hint: {help_line}", sys.stderr, len("hint: "))
    return Exit.INPUT
