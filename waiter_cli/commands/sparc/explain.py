"""``waiter sparc explain``: why a program is inconsistent, and what would mend it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    MemoryLimitOption,
    TimeLimitOption,
)
from waiter_cli.commands.sparc.program import ProgramArgument

if TYPE_CHECKING:
    from sparc.explaining.explain import Cause, CauseMember, Inconsistency
    from sparc.explaining.places import StatementPlace

__all__ = ["explain"]


def explain(
    program: ProgramArgument,
    every: Annotated[
        bool, typer.Option("--all", help="List every cause, not only those that share nothing.")
    ] = False,
    constants: ConstantOption = None,
    as_json: JsonOption = False,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
) -> int:
    """Say why a program has no answer set, and what would mend it.

    A cause is a minimal set of statements that leaves no answer set, whatever
    else is left out. A mend is a least set of statements without which there
    is one; each was tried.

    \b
    Examples:
      waiter sparc explain family.sparc
      waiter sparc explain family.sparc --all --json
    """
    import sparc
    from sparc.limits import begin
    from waiter_cli.console.output import print_json
    from waiter_cli.errors import Exit
    from waiter_cli.file_access.sparc_file import read_program

    begin(time_limit, memory_limit)
    source = read_program(program, constants)
    inconsistency = sparc.explain(source, every=every, time_limit=time_limit)
    if as_json:
        print_json(_document(inconsistency))
    else:
        _print(inconsistency, source.name, every)
    answered = inconsistency.consistent or (
        inconsistency.consistent is False and bool(inconsistency.causes)
    )
    return Exit.OK if answered else Exit.UNDECIDED


def _document(found: Inconsistency) -> dict[str, Any]:
    limit = {} if found.limit is None else {"limit": found.limit}
    pairs = [[list(pair) for pair in cause.contraries] for cause in found.causes]
    status = {True: "consistent", False: "inconsistent", None: "undecided"}[found.consistent]
    return {
        "status": status,
        "complete": found.complete,
        **limit,
        "causes": [[_member(each) for each in cause.members] for cause in found.causes],
        "mends": [{"without": [each.as_dict() for each in mend.without]} for mend in found.mends],
        **({"contraries": pairs} if any(pairs) else {}),  # of each cause
    }


def _member(member: CauseMember) -> dict[str, Any]:
    sentence = {"sentence": member.place.sentence}
    return {**member.place.as_dict(), **sentence, "instances": list(member.instances)}


# ------------------------------------------------------------------ for people


def _print(found: Inconsistency, name: str, every: bool) -> None:
    from waiter_cli.console.output import say
    from waiter_cli.console.styling import styled

    if found.consistent:
        say(f"{name} is {styled('consistent', 'green')}: it has an answer set.")
        return
    if found.consistent is False:
        say(f"{name} is {styled('inconsistent', 'red')}: it has no answer set.")
    for number, cause in enumerate(found.causes, 1):
        label = f"Cause {number} of {len(found.causes)}" if len(found.causes) > 1 else "The cause"
        say("")
        say(f"{styled(label, 'bold')}: these leave no answer set, whatever else is left out.")
        _print_cause(cause)
    if len(found.causes) > 1 and not every:
        say("")
        say("The causes share no statement, so each has to be mended.")
    if found.mends:
        say("")
        say(f"{styled('There is an answer set', 'bold')} (fewest changes first)")
        for mend in found.mends:
            places = "\n      and ".join(_line(place) for place in mend.without)
            say(f"  without {places}", hang=4)
    if not found.complete:
        say("waiter: " + _open(found), sys.stderr)


def _open(found: Inconsistency) -> str:
    """Returns in words what was not finished."""
    if found.limit is None:
        return "there are more causes or mends than these."
    reached = f"the {found.limit} limit was reached"
    if found.consistent is None:
        return f"{reached}: whether there is an answer set is open."
    if not found.causes:
        return f"{reached}: there is no answer set; the cause is open."
    return f"{reached}: further causes, instances and mends are open."


def _print_cause(cause: Cause) -> None:
    from waiter_cli.console.output import say
    from waiter_cli.console.styling import styled

    for member in cause.members:
        say(f"  {_line(member.place)}", hang=4)
        if member.place.sentence:
            say(f"      {styled(member.place.sentence, 'dim')}", hang=0)
        if member.is_sort:
            lost = ", ".join(member.instances)
            say(f"      this sort is too small: {lost} would hold with a larger one", hang=2)
            if member.larger:
                say(f"      with this one the cause is mended: {member.larger}", hang=2)
        else:
            for instance in member.instances:
                if f"{instance}." != member.place.text:
                    say(f"      as in: {instance}", hang=2)
    for positive, negative in cause.contraries:
        say(f"  {positive} and {negative} contradict each other: no answer set has both.")


def _line(place: StatementPlace) -> str:
    return f"{place.file}:{place.line}: {place.text}"
