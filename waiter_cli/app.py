"""The front door: the commands of `waiter`, and the one place where exceptions become text.

``waiter --version`` is answered before Typer is imported, and only the module of the command
that was asked for is imported at all.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from typing import TYPE_CHECKING, NoReturn

from waiter_cli import __version__

if TYPE_CHECKING:
    import typer

__all__ = ["COMMANDS", "main", "make_app"]

# name -> module with a function of that name (dashes as underscores), or with a Typer app.
COMMANDS = {
    "plan": "waiter_cli.commands.plan",
    "explain": "waiter_cli.commands.explain",
    "answersets": "waiter_cli.commands.answersets",
    "serve": "waiter_cli.commands.serve",
    "simulate": "waiter_cli.commands.simulate",
    "validate": "waiter_cli.commands.validate",
    "domain": "waiter_cli.commands.domain",
    "sparc": "waiter_cli.commands.sparc_tools",
    "layout": "waiter_cli.commands.layout_tools",
    "compare": "waiter_cli.commands.compare",
    "doctor": "waiter_cli.commands.doctor",
    "tour": "waiter_cli.commands.tour",
}


def make_app(only: str | None = None) -> typer.Typer:
    """The Typer application with every command, or with one."""
    import typer

    app = typer.Typer(
        name="waiter",
        help="Plans for a robot waiter, proved minimal, from a restaurant in YAML.",
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
        epilog="Start with: waiter plan --layout report --enter 1",
    )

    @app.callback()
    def waiter(
        version: bool = typer.Option(False, "--version", help="Print the version."),
        debug: bool = typer.Option(
            False, "--debug", help="Show the traceback of an internal fault."
        ),
    ) -> None:
        pass

    for name, module_name in COMMANDS.items():
        if only is None or name == only:
            module = import_module(module_name)
            if hasattr(module, "app"):
                app.add_typer(module.app, name=name)
            else:
                app.command(name)(getattr(module, name.replace("-", "_")))
    return app


def main(argv: Sequence[str] | None = None) -> NoReturn:
    """Runs one command line and ends the process with its exit code."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    if arguments[:1] in (["--version"], ["-V"]):
        print(f"waiter {__version__}")
        raise SystemExit(0)
    debug = "--debug" in arguments
    if debug:
        arguments.remove("--debug")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # a terminal that cannot show a name gets its code
            stream.reconfigure(errors="backslashreplace")
    gc.set_threshold(100_000, 20, 20)  # a short life makes many values and little garbage
    signal.signal(signal.SIGTERM, _terminated)
    code = run(arguments, debug=debug)
    _leave(code)


def run(arguments: list[str], *, debug: bool = False) -> int:
    """The exit code of one command line; every exception becomes its text here."""
    from waiter_cli.exits import Exit

    as_json = "--json" in arguments
    try:
        return _invoke(arguments)
    except BrokenPipeError:
        _close_stdout()
        return Exit.OK
    except KeyboardInterrupt:
        print("waiter: interrupted", file=sys.stderr)
        return Exit.INTERRUPTED
    except _Terminated:
        print("waiter: terminated", file=sys.stderr)
        return Exit.TERMINATED
    except Exception as error:
        if debug:
            import traceback

            traceback.print_exc()
        from waiter_cli.output import report_error

        try:
            return report_error(error, as_json=as_json)
        except BrokenPipeError:
            _close_stdout()
            return Exit.INTERNAL


def _invoke(arguments: list[str]) -> int:
    from waiter_cli.exits import Exit

    only = next((word for word in arguments if not word.startswith("-")), None)
    app = make_app(only if only in COMMANDS else None)
    from typer.main import get_command

    command = get_command(app)
    try:
        result = command.main(arguments, prog_name="waiter", standalone_mode=False)
    except SystemExit as leaving:
        if "Pacify" in type(sys.stdout).__name__:  # Typer's answer to a closed pipe
            raise BrokenPipeError from None
        return leaving.code if isinstance(leaving.code, int) else 0
    sys.stdout.flush()
    if result == Exit.INTERRUPTED:  # Typer's answer to Ctrl-C
        raise KeyboardInterrupt
    return int(result) if isinstance(result, int) else 0


class _Terminated(BaseException):
    """SIGTERM came."""


def _terminated(signum: int, frame: object) -> None:
    raise _Terminated


def _close_stdout() -> None:
    """Points stdout at nothing, so that the interpreter's last flush is quiet."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def _leave(code: int) -> NoReturn:
    """Ends the process; at once where a thread of clingo's may still run.

    Such a thread, ended by the interpreter on its way out, takes the process down with it. clingo
    has threads of its own that Python does not count, so whatever was cut short ends this way.
    """
    import threading

    from waiter_cli.exits import Exit

    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except BrokenPipeError:
        _close_stdout()
    cut_short = code in (Exit.INTERRUPTED, Exit.TERMINATED, Exit.UNDECIDED)
    if cut_short or threading.active_count() > 1:
        os._exit(code)
    raise SystemExit(code)
