"""The help of every command, as tests read it: the tree of commands, and the examples in its texts."""

from __future__ import annotations

import re
import shlex
from functools import cache
from typing import Any

from tests.support.cli import Ran, waiter
from waiter_cli.app import make_app

__all__ = ["command_tree", "examples", "run_line"]


@cache
def command_tree() -> dict[str, Any]:
    """Every command and group by its words: ``""`` is `waiter` itself, then ``layout check``."""
    from typer.main import get_command

    found: dict[str, Any] = {}

    def visit(words: tuple[str, ...], command: Any) -> None:
        found[" ".join(words)] = command
        for name, inner in getattr(command, "commands", {}).items():
            visit((*words, name), inner)

    visit((), get_command(make_app()))
    return found


def examples(text: str) -> list[str]:
    """The command lines under ``Examples:`` in a help text."""
    _, _, below = text.partition("Examples:\n")
    lines = re.match(r"(?:[ \t]+\S[^\n]*\n?)*", below)
    return [line.strip() for line in lines[0].splitlines()] if lines else []


def run_line(line: str, stdin: str = "") -> Ran:
    """Runs a line as a shell would: programs joined by ``|``, with ``<`` and ``>``.

    The programs are `waiter`, in this process, and ``echo``.  The first that ends with another code
    than 0 ends it.
    """
    lexer = shlex.shlex(line, posix=True, punctuation_chars="|<>")
    lexer.whitespace_split = True
    ran = Ran(0, stdin, "")
    said = ""
    for program in _parted(list(lexer), "|"):
        given, target = ran.out, None
        while len(program) > 2 and program[-2] in ("<", ">"):
            *program, sign, name = program
            if sign == ">":
                target = name
            else:
                with open(name, encoding="utf-8") as file:
                    given = file.read()
        name, *arguments = program
        ran = Ran(0, f"{arguments[0]}\n", "") if name == "echo" else waiter(*arguments, stdin=given)
        assert name in ("echo", "waiter"), line
        said += ran.err
        if target is not None:
            with open(target, "w", encoding="utf-8") as file:
                file.write(ran.out)
        if ran.code:
            break
    return Ran(ran.code, ran.out, said)


def _parted(words: list[str], sign: str) -> list[list[str]]:
    parts: list[list[str]] = [[]]
    for word in words:
        if word == sign:
            parts.append([])
        else:
            parts[-1].append(word)
    return parts
