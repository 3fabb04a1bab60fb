"""Turns exceptions that reach the front door into text or JSON, and an exit code.

Usage errors say what they are about in attributes that `command_line.command` and `command_line.numbers` set:
``unknown_command``, ``extra_words``, ``wrong_choice``.  No message of theirs is taken apart.
"""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Collection, Sequence
from typing import Any

from waiter_cli.console.output import print_faults, print_json, print_source_faults, print_text, say
from waiter_cli.errors import Exit, Fault, InputError, MissingError
from waiter_cli.files.documents import fault_document
from waiter_cli.spelling import suggest

__all__ = ["report_error"]


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
            missing = Fault(None, error.message, error.mend)
            print_json(_error_document([fault_document(missing)]))
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
    """Prints an error of `sparc` and returns its exit code; None for any other error."""
    from sparc.errors import SolverError, SourceError, SourceErrors, too_large

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
    if too_large(errors):
        return Exit.UNDECIDED
    return Exit.INPUT


# ------------------------------------------------------------------ usage


def _report_usage(error: Any, as_json: bool) -> int:
    """Prints an error of the command line's own, with the mend that its kind allows."""
    if type(error).__name__ == "NoArgsIsHelpError":
        print_text(error.format_message())
        return Exit.INPUT
    context = getattr(error, "ctx", None)
    message = _usage_message(error, context)
    help_line = f"see {context.command_path} --help" if context is not None else "see waiter --help"
    meant = _meant(error, context)
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


def _usage_message(error: Any, context: Any) -> str:
    """Returns what is wrong; for an unknown option or command with the names that are near."""
    unknown = getattr(error, "unknown_command", None)
    if unknown is not None and context is not None:
        known = context.command.list_commands(context)
        return f"No such command {unknown!r}{_or_near(unknown, known)}"
    if type(error).__name__ == "NoSuchOption" and context is not None:
        known = {name for each in context.command.params for name in each.opts}
        return f"No such option: {error.option_name}{_or_near(error.option_name, known)}"
    return str(error.format_message())


def _or_near(typed: str, known: Collection[str]) -> str:
    """Returns the names that ``typed`` is short for, or else the nearest, as a question."""
    names = sorted(name for name in known if len(typed) > len("--") and name.startswith(typed))
    if not names:
        from sparc.spelling import likeness, near

        close = near(typed, known, 2)
        names = [n for n in close if likeness(typed, n) > likeness(typed, close[0]) - 0.1]
    return f". Did you mean {' or '.join(names)}?" if names else ""


def _meant(error: Any, context: Any) -> str:
    """Returns the choice nearest to a wrong one, or the options left out before file names."""
    given, choices = getattr(error, "wrong_choice", ("", ()))
    if choices:
        return suggest(given, choices) or ""
    words = getattr(error, "extra_words", ())
    if not words or context is None:
        return ""
    from waiter_cli.file_access.locate import built_in, is_layout

    options = {name for each in context.command.params for name in each.opts}
    meant: dict[str, str] = {}
    for word in words:
        kinds = [kind for kind in ("scenario", "layout") if word in built_in(kind)]
        if word.endswith((".yaml", ".yml")) and os.path.isfile(word):
            kinds = ["layout" if is_layout(word) else "scenario"]
        for kind in kinds:
            if f"--{kind}" in options:
                meant.setdefault(kind, f"--{kind} {word}")
    return " ".join(meant.values())
