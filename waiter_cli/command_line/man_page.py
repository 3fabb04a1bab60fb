"""``waiter --man``: the manual page, made of the same texts as ``--help``."""

from __future__ import annotations

from collections.abc import Iterator
from inspect import cleandoc
from typing import Any

from waiter_cli.command_line.command import groups_of

__all__ = ["manual"]

EXITS = """\
0: a plan; consistent; valid
1: a defect of waiter's own (--debug shows the traceback)
2: usage or input is wrong
3: proved: no plan of any length, inconsistent, an invalid plan
4: undecided: the time, the memory or --max-steps came first
5: something is missing here; the message says how to get it
130, 143: interrupted, terminated"""
VARIABLES = """\
WAITER_SPARC_JAR: where sparc.jar is
WAITER_TRANSLATOR: native or jar, where --translator is not given
NO_COLOR: no colour, not even on a terminal"""


def manual(command: Any, version: str) -> str:
    """Returns the page in the language of ``man``; ``command`` is the whole tree of commands.

    Show it with ``waiter --man | man -l -``.
    """
    brief = cleandoc(command.help).split("\n")[0].rstrip(".")
    lines = [f'.TH WAITER 1 "" "waiter {version}"', ".SH NAME", f"waiter \\- {brief}"]
    lines += [".SH SYNOPSIS", ".B waiter", "COMMAND [OPTIONS]", ".SH DESCRIPTION"]
    lines += [*_text(command.help), *_options(command), ".SH COMMANDS"]
    for words, each in _tree(command, "waiter"):
        lines += [f'.SS "{words}{_arguments(each)}"', *_text(each.help), *_options(each)]
    for title, text in (("EXIT STATUS", EXITS), ("ENVIRONMENT", VARIABLES)):
        lines.append(f".SH {title}")
        for name, meaning in (line.split(": ", 1) for line in text.splitlines()):
            lines += [".TP", f".B {_plain(name)}", _plain(meaning)]
    return "\n".join(lines) + "\n"


def _tree(command: Any, words: str) -> Iterator[tuple[str, Any]]:
    for name, inner in getattr(command, "commands", {}).items():
        yield f"{words} {name}", inner
        yield from _tree(inner, f"{words} {name}")


def _arguments(command: Any) -> str:
    names = [p.metavar or p.name.upper() for p in command.params if p.param_type_name == "argument"]
    return "".join(f" {name}" for name in names)


def _text(text: str) -> Iterator[str]:
    """Yields paragraphs; those that begin with a backspace keep their lines."""
    for paragraph in cleandoc(text).split("\n\n"):
        as_it_is = paragraph.startswith("\b")
        yield from (".PP", *([".nf"] if as_it_is else []))
        yield from (_plain(line) for line in paragraph.lstrip("\b\n").split("\n"))
        yield from [".fi"] if as_it_is else []


def _options(command: Any) -> Iterator[str]:
    """Yields the options, under their headings where there is more than one."""
    groups = groups_of(command, command.params)
    for title, below in groups:
        if len(groups) > 1:
            yield from (".PP", f".I {_plain(title)}")
        for parameter in below:
            names = ", ".join([*parameter.opts, *parameter.secondary_opts])
            choices = "|".join(getattr(parameter.type, "choices", ()))
            value = "" if parameter.is_flag else f" {parameter.metavar or choices}"
            yield from (".TP", f".B {_plain(names + value)}", _plain(parameter.help))


def _plain(text: str) -> str:
    """Returns a text in which nothing is a command of the formatter."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return f"\\&{text}" if text.startswith((".", "'")) else text
