"""The front door: the commands of `waiter`, and the one place where exceptions become text.

``waiter --version`` is answered before Typer is imported, and only the module of the command
that was asked for is imported at all.
"""

from __future__ import annotations

import os
import sys


def _no_memory() -> None:
    """Ends the process where little more than Python itself has room; allocates nothing."""
    if "--json" in sys.argv:
        os.write(1, b'{"status": "undecided", "limit": "memory"}\n')
    os.write(2, b"waiter: undecided: the memory ran out\n")
    os._exit(4)


try:
    import gc
    import signal
    import time
    from collections import deque
    from collections.abc import Callable, Sequence
    from importlib import import_module

    from sparc.limits import OverLimit, end, hard_limit, pending, starved
    from sparc.memory_guard import FAULT, STARVED
    from waiter_cli import __version__
    from waiter_cli.console.streams import drop_stdout, lost_output, prepare
except MemoryError:
    _no_memory()

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from types import FrameType
    from typing import Any, NoReturn

    import typer

__all__ = ["COMMANDS", "main", "make_app", "run"]

# name -> module with a function of that name (dashes as underscores), or with a Typer app.
COMMANDS = {
    "plan": "waiter_cli.commands.plan",
    "explain": "waiter_cli.commands.explain",
    "answersets": "waiter_cli.commands.answersets",
    "serve": "waiter_cli.commands.serve",
    "simulate": "waiter_cli.commands.simulate",
    "studio": "waiter_cli.commands.studio",
    "validate": "waiter_cli.commands.validate",
    "domain": "waiter_cli.commands.domain",
    "sparc": "waiter_cli.commands.sparc.app",
    "layout": "waiter_cli.commands.layout.app",
    "compare": "waiter_cli.commands.compare",
    "study": "waiter_cli.commands.study.app",
    "list": "waiter_cli.commands.listing",
    "doctor": "waiter_cli.commands.doctor",
    "tour": "waiter_cli.commands.tour",
}


def make_app(only: str | None = None) -> typer.Typer:
    """Returns the Typer application with every command, or with one."""
    import typer

    app = typer.Typer(
        name="waiter",
        help="""Plans for a robot waiter, proved minimal, from a restaurant in YAML.

        \b
        Examples:
          waiter plan --layout report --enter 1
          waiter tour
        """,
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    )

    @app.callback()
    def waiter(
        version: bool = typer.Option(False, "--version", help="Print the version."),
        debug: bool = typer.Option(
            False, "--debug", help="Show the traceback of an internal fault."
        ),
        man: bool = typer.Option(
            False, "--man", help="Print the manual page: waiter --man | man -l -."
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
    _shape(app)
    return app


def _shape(app: typer.Typer) -> None:
    """Makes each command a `Command`, each group a `CommandGroup`; lists show whole first sentences."""
    from waiter_cli.command_line.command import Command, CommandGroup

    app.info.cls = CommandGroup
    for command in app.registered_commands:
        command.cls = Command
        doc = (command.callback.__doc__ or "").strip() if command.callback is not None else ""
        command.short_help = command.short_help or " ".join(doc.partition("\n\n")[0].split())
    for group in app.registered_groups:
        if group.typer_instance is not None:
            _shape(group.typer_instance)


def main(argv: Sequence[str] | None = None) -> NoReturn:
    """Runs one command line and ends the process with its exit code."""
    speaks = True
    try:
        _handle_signals(_signalled)
        prepare()
        gc.set_threshold(100_000, 20, 20)  # a short life makes many values and little garbage
        arguments = list(sys.argv[1:] if argv is None else argv)
        if hard_limit() is not None and hasattr(os, "fork"):
            from waiter_cli.console.limit_report import guarded

            guarded(arguments)
            speaks = False  # the parent does
        debug = "--debug" in arguments
        arguments = [word for word in arguments if word != "--debug"]
        code = run(arguments, debug=debug)
        if not speaks:
            lost_output()
            os._exit(FAULT if code == 1 else code)
        _handle_signals(lambda number, frame: os._exit(128 + number))
    except MemoryError:
        if speaks:
            _no_memory()
        os._exit(STARVED)
    except (KeyboardInterrupt, _Terminated) as signalled:  # just before or just after
        code = 130 if isinstance(signalled, KeyboardInterrupt) else 143
    _leave(code)


def run(arguments: list[str], *, debug: bool = False) -> int:
    """Runs one command line and returns its exit code; every exception becomes text here."""
    from waiter_cli.errors import Exit

    try:
        code = _run(arguments, debug)
    except BrokenPipeError:
        drop_stdout()
        code = Exit.OK
    except KeyboardInterrupt:
        # On a terminal the cursor stands behind ^C, or behind a question.
        print(f"{chr(10) if sys.stderr.isatty() else ''}waiter: interrupted", file=sys.stderr)
        code = Exit.INTERRUPTED
    except _Terminated:
        print("waiter: terminated", file=sys.stderr)
        code = Exit.TERMINATED
    finally:
        end()
    return code


def _run(arguments: list[str], debug: bool) -> int:
    """Returns the exit code; results that could not be written are a fault like any other."""
    from waiter_cli.errors import Exit

    as_json = "--json" in arguments
    try:
        code = _invoke(arguments)
        lost = lost_output()
    except BrokenPipeError:
        raise
    except OverLimit as over:
        _cut_short.append(over)
        return _undecided(arguments, over.limit)
    except Exception as error:
        if _first is not None:  # numpy, for one, makes an ImportError of a signal
            raise _ending(_first[0]) from error
        limit = "memory" if starved(error) else pending()
        if limit is not None:
            return _undecided(arguments, limit)
        if debug:
            import traceback

            from waiter_cli.console.output import print_text

            print_text(traceback.format_exc(), sys.stderr, end="")
        lost = lost_output() if isinstance(error, OSError) else None
        if lost is None:
            from waiter_cli.boundary import report_error

            try:
                code = report_error(error, as_json=as_json)
                lost = lost_output()
            except BrokenPipeError:
                code = Exit.INPUT
            except OSError as fault:
                lost = lost_output() or fault
    if lost is None:
        return code
    print(
        f"waiter: cannot write the output: {(lost.strerror or str(lost)).lower()}", file=sys.stderr
    )
    return Exit.INPUT


_cut_short: deque[BaseException] = deque(maxlen=1)
"""What was under way when a limit came: to free a million nodes would take as long as making them."""


def _undecided(arguments: list[str], limit: str) -> int:
    """Reports that a limit ended a command that could not report it itself."""
    from waiter_cli.console.limit_report import undecided

    end()
    return undecided(arguments, limit)


_made: dict[str | None, Any] = {}
"""The commands that were made until now, by the name of the only one in each."""


def _command(only: str | None) -> Any:
    """Returns what runs a command line; made once in a process, which may run several."""
    if only not in _made:
        from typer.main import get_command

        from waiter_cli.command_line.numbers import read_strictly

        _made[only] = read_strictly(get_command(make_app(only)))
    return _made[only]


def _invoke(arguments: list[str]) -> int:
    if arguments[:1] == ["-V"] or "--version" in (*arguments[:1], *arguments[-1:]):
        print(f"waiter {__version__}")
        return 0
    if arguments[:1] in (["--show-completion"], ["--install-completion"]):
        from waiter_cli.command_line.completion import completion

        return completion(arguments[0], "".join(arguments[1:2]) or None)
    from waiter_cli.errors import Exit

    if "_WAITER_COMPLETE" in os.environ:  # a candidate and its description stay on one line
        os.environ["COLUMNS"] = "1000"
    only = next((word for word in arguments if not word.startswith("-")), None)
    command = _command(only if only in COMMANDS else None)
    from typer import Abort

    if arguments == ["--man"]:
        from waiter_cli.command_line.man_page import manual

        sys.stdout.write(manual(command, __version__))
        return 0
    try:
        result = command.main(arguments, prog_name="waiter", standalone_mode=False, obj=run)
    except Abort as abort:  # the end of input, where a question was asked
        if isinstance(abort.__cause__, EOFError):  # no question: Typer makes no difference
            raise abort.__cause__ from None
        raise KeyboardInterrupt from None
    except SystemExit as leaving:
        if "Pacify" in type(sys.stdout).__name__:  # Typer's answer to a closed pipe
            raise BrokenPipeError from None
        return leaving.code if isinstance(leaving.code, int) else 0
    if result == Exit.INTERRUPTED and not isinstance(result, Exit):  # Typer's answer to Ctrl-C
        raise KeyboardInterrupt
    return int(result) if isinstance(result, int) else 0


# ------------------------------------------------------------------ the end


class _Terminated(BaseException):
    """SIGTERM came."""


IMPATIENCE = 1.0
"""So many seconds after a signal another one ends the process at once."""

_first: tuple[int, float] | None = None
"""The signal that came first, and when."""


def _handle_signals(handler: Callable[[int, FrameType | None], object]) -> None:
    """Installs a handler of Ctrl-C and SIGTERM, unless the process was started to ignore them."""
    for signum in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(signum) is not signal.SIG_IGN:
            signal.signal(signum, handler)


def _signalled(signum: int, frame: FrameType | None) -> None:
    """Lets the work end as after an error, so that children are ended and half a file is removed.

    Signals come in pairs (``timeout`` sends one to the process and one to its group): a second
    one must not disturb what the first has begun.
    """
    global _first
    now = time.monotonic()
    if _first is None:
        _first = signum, now
        raise _ending(signum)
    if now - _first[1] > IMPATIENCE:
        os._exit(128 + signum)


def _ending(signum: int) -> BaseException:
    """Returns the exception that a signal raises."""
    return KeyboardInterrupt() if signum == signal.SIGINT else _Terminated()


def _is_measured() -> bool:
    """Returns whether a profiler, a debugger or a coverage tool watches the process."""
    if sys.gettrace() is not None or sys.getprofile() is not None:
        return True
    monitoring = getattr(sys, "monitoring", None)  # since Python 3.12
    return monitoring is not None and any(monitoring.get_tool(tool) for tool in range(6))


def _leave(code: int) -> NoReturn:
    """Ends the process, immediately where a thread of clingo's may still run.

    Such a thread, ended by the interpreter on its way out, takes the process down with it. clingo
    has threads of its own that Python does not count, so whatever was cut short ends this way.
    Otherwise what is registered for the exit is done first.  The interpreter takes nothing apart,
    value by value: that would take a seventh of the time of a plan.
    """
    import _thread  # `threading` does not count what `sparc` starts without it

    from waiter_cli.errors import Exit

    lost_output()  # after a signal, what was found before it
    cut_short = code in (Exit.INTERRUPTED, Exit.TERMINATED, Exit.UNDECIDED)
    if not cut_short and _thread._count() == 0:
        if _is_measured():
            raise SystemExit(code)  # somebody measures, and wants to say what
        import atexit

        atexit._run_exitfuncs()
        lost_output()
    try:
        sys.stderr.flush()
    except OSError:  # there is nobody left to tell
        code = code or Exit.INPUT
    os._exit(code)
