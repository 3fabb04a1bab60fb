"""Plans in plain words: what a person reads beside a term of SPARC."""

from __future__ import annotations

from waiter_cli.plan import Action
from waiter_cli.situation import Party, State

__all__ = ["describe", "people"]


def people(party: Party) -> str:
    """A party in words, such as ``c1`` or ``the party of c2 (4)``."""
    return party[0] if len(party) == 1 else f"the party of {party[0]} ({len(party)})"


def _whole(state: State, customer: str) -> str:
    return people(state.party_of(customer) or (customer,))


def describe(action: Action, state: State) -> str:
    """What an action means, done in ``state``."""
    match action.name, action.arguments:
        case "go_to", (_, node):
            return f"walk from {state.agent} to {node}"
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
