"""Plans in plain words: what a person reads beside a term of SPARC."""

from __future__ import annotations

from collections.abc import Iterable

from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Party, State

__all__ = ["counted", "describe", "goal_text", "in_words", "people"]


def people(party: Party) -> str:
    """Returns a party in words, such as ``c1`` or ``the party of c2 (4)``."""
    return party[0] if len(party) == 1 else f"the party of {party[0]} ({len(party)})"


def _whole(state: State, customer: str) -> str:
    return people(state.party_of(customer) or (customer,))


def describe(action: Action, state: State) -> str:
    """Returns the meaning of an action done in ``state``, in words."""
    match action.name, action.arguments:
        case "go_to", (_, node):
            return f"walk from {state.stations()[action.arguments[0]]} to {node}"
        case "pick", (_, customer):
            return f"ask {_whole(state, customer)} to follow"
        case "seat", (_, customer, table):
            return f"seat {_whole(state, customer)} at {table}"
        case "give_bill", (_, table):
            return f"give {table} its bill"
        case "take_order", (_, table):
            return f"take the order of {table}"
        case "send_order", (_, table):
            return f"send the order of {table} to the kitchen"
        case "take_up", (_, item, table):
            return f"take up the {item} for {table}"
        case "bring", (_, item, table):
            return f"bring the {item} to {table}"
        case "refill", (_, item, table):
            return f"take the empty {item} of {table} along"
        case "bring_chairs", (_, table, number):
            return f"bring chairs: {table} now has {number}"
    return action.text


def in_words(names: Iterable[str], last: str = "and") -> str:
    """Returns names as a list in a sentence; ``last`` joins the last one.

    >>> in_words(["a", "b", "c"]), in_words(["a", "b"], "or"), in_words(["a"])
    ('a, b and c', 'a or b', 'a')
    """
    *before, end = names or ("",)
    return f"{', '.join(before)} {last} {end}" if before else end


def counted(number: int | float | str, noun: str) -> str:
    """Returns a number with its noun, which is in the plural unless there is one.

    >>> counted(1, "step"), counted(2, "step"), counted("0.50", "metre")
    ('1 step', '2 steps', '0.50 metres')
    """
    return f"{number} {noun}{'' if str(number) == '1' else 's'}"


def goal_text(goal: Goal, *, in_sentence: bool = False) -> str:
    """Returns the goal as one would write it in a scenario, in one line.

    ``in_sentence`` leaves out what YAML alone needs.

    >>> goal_text(Goal("seated", party=("c1", "c2"))), goal_text(Goal("paid", table="table1"))
    ('seated: [c1, c2]', 'paid: table1')
    >>> goal_text(Goal("served", table="table1", item="jug"), in_sentence=True)
    'served table1 jug'
    """
    ((kind, value),) = goal.as_dict().items()
    after = "" if in_sentence else ":"
    if isinstance(value, list):
        return f"{kind}{after} [{', '.join(value)}]"
    if isinstance(value, dict):
        pairs = ", ".join(f"{key}{after} {what}" for key, what in value.items())
        return f"{kind} {pairs}" if in_sentence else f"{kind}: {{{pairs}}}"
    return f"{kind}{after} {value}"
