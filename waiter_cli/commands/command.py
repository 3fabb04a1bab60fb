"""How a command of `waiter` reads its options: each as often as it can be meant. Class `Command`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from typer.core import TyperCommand

from waiter_cli.exits import Fault, InputError

__all__ = ["Command"]

_TIMES = {2: "twice", 3: "three times"}


class Command(TyperCommand):
    """A command that refuses an option given more often than it can be meant.

    Options that take a list are collected; a switch may be said again, but not together with its
    opposite.  Of any other option only the last value would count, and the others would be lost
    without a word.
    """

    def make_parser(self, ctx: Any) -> Any:
        """Typer's parser, which raises `InputError` for an option that is given again."""
        parser = super().make_parser(ctx)
        parse = parser.parse_args

        def parse_each_once(args: list[str]) -> tuple[dict[str, Any], list[str], list[Any]]:
            typed = tuple(args)  # the parser uses its list up
            values, rest, order = parse(args)
            if not ctx.resilient_parsing and not any(each.is_eager for each in order):
                faults = _repeated(order, typed)
                if faults:
                    raise InputError(faults)
            return values, rest, order

        parser.parse_args = parse_each_once  # type: ignore[method-assign]
        return parser


def _repeated(order: Sequence[Any], typed: Sequence[str]) -> list[Fault]:
    """A fault for every option that is in ``order`` more often than it can be meant."""
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
