"""Commands of `waiter`: reads their options and lists them in their help.

Classes `Command` and `CommandGroup`; `grouped` puts the options of a long list under headings, which `groups_of` reads.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from typer import BadParameter
from typer.core import TyperCommand, TyperGroup

from waiter_cli.errors import Fault, InputError

__all__ = ["Command", "CommandGroup", "grouped", "groups_of", "takes_literal"]

_TIMES = {2: "twice", 3: "three times"}


_Function = TypeVar("_Function", bound=Callable[..., Any])


def grouped(groups: Mapping[str, Sequence[str]]) -> Callable[[_Function], _Function]:
    """Marks the function of a command: heading → names of parameters, in the order of the help."""

    def mark(function: _Function) -> _Function:
        function.__dict__["groups"] = groups
        return function

    return mark


def groups_of(command: Any, parameters: Sequence[Any]) -> list[tuple[str, list[Any]]]:
    """Headings and the options below each; without `grouped` all stand under ``Options``.

    An option that no group names stands at the end of the last one.
    """
    options = [each for each in parameters if each.param_type_name == "option"]
    groups = getattr(command.callback, "groups", {"Options": ()})
    by_name = {option.name: option for option in options}
    found = [(title, [by_name.pop(name) for name in names if name in by_name])
             for title, names in groups.items()]  # fmt: skip
    found[-1][1].extend(by_name.values())
    return [(title, below) for title, below in found if below]


class Command(TyperCommand):
    """A command that refuses an option given more often than it can be meant.

    Options that take a list are collected; a switch may be said again, but not together with its
    opposite.  Of any other option only the last value would count, and the others would be lost
    without a word.
    """

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Arguments first, then options under their headings."""
        parameters = self.get_params(ctx)
        arguments = [each for each in parameters if each.param_type_name == "argument"]
        for title, below in [("Arguments", arguments), *groups_of(self, parameters)]:
            rows = [row for each in below if (row := each.get_help_record(ctx)) is not None]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """Returns the pieces of the usage line; what must be given stands bare, as in other tools."""
        pieces = super().collect_usage_pieces(ctx)
        return [piece[1:-1] if piece.startswith("{") else piece for piece in pieces]

    def make_parser(self, ctx: Any) -> Any:
        """Returns Typer's parser, which raises `InputError` for an option that is given again."""
        parser = super().make_parser(ctx)
        parse = parser.parse_args

        def parse_each_once(args: list[str]) -> tuple[dict[str, Any], list[str], list[Any]]:
            if getattr(self.callback, "takes_literal", False):
                args = _literals_last(args, self.get_params(ctx))
            typed = tuple(args)  # the parser uses its list up
            values, rest, order = parse(args)
            if not ctx.resilient_parsing and not any(each.is_eager for each in order):
                faults = _repeated(order, typed)
                if faults:
                    raise InputError(faults)
                if rest and not ctx.allow_extra_args:
                    raise _ExtraArguments(rest, ctx)
            return values, rest, order

        parser.parse_args = parse_each_once  # type: ignore[method-assign]
        return parser


class CommandGroup(TyperGroup):
    """A list of commands whose error for an unknown one tells which."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Returns the command that the first word names, and the other words."""
        known = self.get_command(ctx, args[0]) is not None
        if not known and args[0][:1] != "-" and not ctx.resilient_parsing:
            raise _UnknownCommand(args[0], ctx)
        return super().resolve_command(ctx, args)


class _UnknownCommand(BadParameter):
    """No command has that name."""

    def __init__(self, name: str, ctx: Any) -> None:
        super().__init__(f"No such command {name!r}", ctx)
        self.unknown_command = name

    def format_message(self) -> str:
        """Returns the message by itself."""
        return self.message


class _ExtraArguments(BadParameter):
    """Words that no argument of the command takes."""

    def __init__(self, words: Sequence[str], ctx: Any) -> None:
        plural = "" if len(words) == 1 else "s"
        super().__init__(f"Got unexpected extra argument{plural} ({' '.join(words)})", ctx)
        self.extra_words = tuple(words)

    def format_message(self) -> str:
        """Returns the message by itself."""
        return self.message


def takes_literal(function: _Function) -> _Function:
    """Marks the function of a command one of whose arguments may be a literal such as ``-p(a)``."""
    function.__dict__["takes_literal"] = True
    return function


_NEGATIVE = re.compile(r"-[a-z]\w*\s*(\(.*\))?\s*(,.*)?\.?", re.DOTALL)
"""A negative literal, or several of which the first is negative."""


def _literals_last(args: Sequence[str], parameters: Sequence[Any]) -> list[str]:
    """Returns the arguments, negative literals behind ``--``, where they are taken for no options."""
    if "--" in args:
        return list(args)
    options = {name for each in parameters for name in (*each.opts, *each.secondary_opts)}
    literals = [each for each in args if _NEGATIVE.fullmatch(each) and each not in options]
    if not literals:
        return list(args)
    return [each for each in args if each not in literals] + ["--", *literals]


def _repeated(order: Sequence[Any], typed: Sequence[str]) -> list[Fault]:
    """Returns a fault for every option that is in ``order`` more often than it can be meant."""
    faults = []
    for option in dict.fromkeys(order):
        number = sum(each is option for each in order)
        if number < 2 or option.param_type_name != "option" or option.multiple:
            continue
        name = max(option.opts, key=len)
        if not option.is_flag:
            faults.append(
                Fault(
                    None, f"{name} is given {_TIMES.get(number, f'{number} times')}", "give it once"
                )
            )
        elif {*option.opts} & {*typed} and {*option.secondary_opts} & {*typed}:
            message = f"{name} and {option.secondary_opts[0]} exclude each other"
            faults.append(Fault(None, message, "leave one of them out"))
    return faults
