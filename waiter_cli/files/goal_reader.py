"""Observations and goals, from scenarios, JSON lines and the command line → values.

Entry points `read_observations`, `read_goals`, `read_before`.  Tables, nodes and objects are
looked up here; customers when the problem is posed, since who is inside depends on what is seen.
"""

from __future__ import annotations

from collections.abc import Iterable

from waiter_cli.errors import Where
from waiter_cli.files.names import Names, read_table_objects, stocked
from waiter_cli.files.own_terms import OWN_GOALS, read_term, whole_terms
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.state import Goal, Observation
from waiter_cli.spelling import did_you_mean, suggest
from waiter_cli.yaml_reading.node_reader import NodeReader, is_empty
from waiter_cli.yaml_reading.yaml_tree import Listing, Mapping, Node, Scalar

__all__ = [
    "GOALS",
    "OBSERVATIONS",
    "read_before",
    "read_goal",
    "read_goals",
    "read_observation",
    "read_observations",
    "read_one_goal",
    "unknown_customer",
]

OBSERVATIONS = ("enter", "leave", "bill", "at", "order", "ready", "empty", "free", "obs")
GOALS = (
    "seated", "paid", "at", "ordered", "sent", "served", "filled", "chairs", "serve", *OWN_GOALS
)  # fmt: skip


def unknown_customer(
    goal: Goal, name: str, inside: Iterable[str], tables: Iterable[str]
) -> tuple[str, str]:
    """Returns the fault of a goal whose party is not inside, and the mend."""
    known = list(inside)
    if goal.kind == "paid":
        hint = did_you_mean(name, [*sorted(tables), *known])
        return f"unknown table or customer {name}", hint or "let somebody enter"
    hint = did_you_mean(name, known) or "nobody is inside; let somebody enter"
    table = suggest(name, sorted(tables))
    if table is not None and suggest(name, known) is None:
        hint = f"if a table is meant: {_beside(table)}"
    return f"unknown customer {name}", hint


def _beside(table: str) -> str:
    return f"{{seated: {{party: c1, table: {table}}}}}"


# -- observations ---------------------------------------------------------------------------


def read_observations(reader: NodeReader, node: Node, names: Names) -> tuple[Observation, ...]:
    """Returns a list of observations, or a single one."""
    items = (node,) if isinstance(node, Mapping) else reader.items(node, "observe") or ()
    observations: list[Observation] = []
    for item in items:
        observations += read_observation(reader, item, names)
    return tuple(observations)


def read_observation(reader: NodeReader, node: Node, names: Names) -> list[Observation]:
    """Returns one observation; a mapping with several entries becomes several."""
    node = whole_terms(node) if isinstance(node, Mapping) else node
    entries = reader.entries(node, "an observation")
    if entries == ():
        reader.fault(node.where, "an observation of nothing", "for example: bill: table1")
    observations: list[Observation] = []
    for key, value in entries or ():
        if key.text not in OBSERVATIONS:
            reader.unknown_key(key, "an observation", OBSERVATIONS)
        else:
            observations += _observation(reader, key, value, names)
    return observations


def _observation(reader: NodeReader, key: Scalar, node: Node, names: Names) -> list[Observation]:
    kind, where = key.text, key.where
    match kind:
        case "enter" | "leave":
            what = "the party that enters" if kind == "enter" else "the party that leaves"
            mend = (
                None if kind == "enter" else "name who leaves; what is free again: {free: table1}"
            )
            members = names.party(reader, node, what, mend)
            if is_empty(node):
                reader.fault(node.where, f"{what} is nobody", "name the customers: [c1, c2]")
            if kind == "enter":
                place = node.where if isinstance(node, Listing) else where
                return [Observation(kind, tuple(n for n, _ in members), place)] if members else []
            return [Observation(kind, (name,), place) for name, place in members]
        case "bill" | "free":
            table = reader.known(node, kind, "table", names.tables)
            return [] if table is None else [Observation(kind, (table,), node.where)]
        case "obs":
            term = read_term(reader, node, "an observation", "spilled(table1)")
            return [] if term is None else [Observation(kind, (term,), node.where)]
        case "order":
            stocked(reader, names.layout, where, "order")
            table = reader.known(node, kind, "table", names.tables)
            return [] if table is None else [Observation(kind, (table,), node.where)]
        case "ready" | "empty":
            if not stocked(reader, names.layout, where, kind):
                return []
            kinds = names.layout.objects if kind == "ready" else REFILLABLES
            pairs = read_table_objects(reader, names, node, kind, kinds)
            return [Observation(kind, (table, item), place) for table, item, place in pairs]
    observations: list[Observation] = []
    staff = frozenset({*(names.robots or ("agent",)), *names.waiters})
    for who, value in reader.entries(node, "at") or ():
        name = reader.known(who, "at", "waiter", staff)
        at = reader.known(value, f"the place of {who.text}", "node", names.nodes)
        if name is not None and at is not None:
            observations.append(Observation("at", (name, at), who.where))
    return observations


# -- goals ----------------------------------------------------------------------------------


def read_goals(reader: NodeReader, node: Node, names: Names) -> tuple[Goal, ...]:
    """Returns a list of goals, or a single one."""
    items = (node,) if isinstance(node, Mapping) else reader.items(node, "goals") or ()
    return tuple(goal for item in items for goal in read_goal(reader, item, names))


def read_before(reader: NodeReader, node: Node, names: Names) -> tuple[tuple[Goal, Goal], ...]:
    """Returns pairs of goals, the first of each to be reached before the second."""
    pairs: list[tuple[Goal, Goal]] = []
    form = "[{paid: table1}, {seated: c4}]"
    for item in reader.items(node, "before", f"write - {form}") or ():
        pair = item.items if isinstance(item, Listing) else ()
        if len(pair) != 2:
            reader.wrong(item, "an entry of before", f"a pair of goals: {form}", f"write {form}")
            continue
        first = read_one_goal(reader, pair[0], names)
        second = read_one_goal(reader, pair[1], names)
        if first is not None and second is not None:
            pairs.append((first, second))
    return tuple(pairs)


def read_one_goal(reader: NodeReader, node: Node, names: Names) -> Goal | None:
    """Returns a single goal; several in one entry are a fault."""
    found = read_goal(reader, node, names)
    if len(found) > 1:
        reader.fault(node.where, f"{len(found)} goals where one is expected", "give one")
    return found[0] if found else None


def read_goal(reader: NodeReader, node: Node, names: Names) -> list[Goal]:
    """Returns the goal of an entry.

    Several where it names several things: ``{chairs: {t1: 2, t2: 4}}``.
    """
    if not isinstance(node, Mapping):
        reader.wrong(node, "a goal", "a mapping (kind: what)", "for example: seated: [c1]")
        return []
    node = whole_terms(node)
    if len(node.entries) != 1:
        hint = "begin each with a dash: - seated: [c1]"
        what = "a goal of nothing" if not node.entries else f"{len(node.entries)} goals in one"
        reader.fault(node.where, what, hint)
    goals: list[Goal] = []
    for key, value in node.entries:
        if key.text not in GOALS:
            reader.unknown_key(key, "a goal", GOALS)
        else:
            goals += _goal(reader, key, value, names)
    return goals


def _goal(reader: NodeReader, key: Scalar, node: Node, names: Names) -> list[Goal]:
    kind, where = key.text, key.where
    match kind:
        case "seated":
            return _seated(reader, node, names)
        case "serve":
            members = names.party(
                reader, node, "the party to serve", "name a customer of the party"
            )
            party = tuple(name for name, _ in members)
            return [Goal(kind, party=party, where=node.where)] if party else []
        case "paid":
            return _paid(reader, node, names)
        case "at":
            return _at(reader, node, names)
        case "chairs":
            return _chairs(reader, node, names)
        case "holds" | "holds_not":
            term = read_term(reader, node, f"the goal {kind}", "isdirty(table1)")
            return [] if term is None else [Goal(kind, fluent=term, where=node.where)]
    if not stocked(reader, names.layout, where, f"the goal {kind}"):
        return []
    if kind in ("served", "filled") and not isinstance(node, Scalar):
        kinds = REFILLABLES if kind == "filled" else names.layout.objects
        pairs = read_table_objects(reader, names, node, kind, kinds)
        return [Goal(kind, table=table, item=item, where=place) for table, item, place in pairs]
    if kind == "filled":
        reader.wrong(node, "filled", "a table with its object", "for example: {table1: jug}")
        return []
    table = reader.known(node, kind, "table", names.tables)
    return [] if table is None else [Goal(kind, table=table, where=node.where)]


def _at(reader: NodeReader, node: Node, names: Names) -> list[Goal]:
    """A node where the robot, or some robot, is to stand; with several robots also by name."""
    if not (names.robots and isinstance(node, Mapping)):
        at = reader.known(node, "the agent's place", "node", names.nodes)
        return [] if at is None else [Goal("at", node=at, where=node.where)]
    goals: list[Goal] = []
    if not node.entries:
        reader.fault(node.where, "a place for nobody", "write {at: n4}")
    for who, value in node.entries:
        name = reader.known(who, "at", "robot", names.robots)
        place = reader.known(value, f"the place of {who.text}", "node", names.nodes)
        if name is not None and place is not None:
            goals.append(Goal("at", node=place, robot=name, where=who.where))
    return goals


def _seated(reader: NodeReader, node: Node, names: Names) -> list[Goal]:
    if is_empty(node):
        reader.fault(node.where, "a seat for nobody", "name the customers: [c1, c2]")
        return []
    if not isinstance(node, Mapping):
        mend = f"name the party; a table goes beside it: {_beside('table1')}"
        members = names.party(reader, node, "the party to seat", mend)
        return _party_goal(members, None, node.where)
    keys = reader.mapping(node, "seated", ("party", "table"))
    if keys is None or "party" not in keys:
        reader.fault(node.where, "a seat for nobody", "write {party: c1, table: table1}")
        return []
    members = names.party(
        reader, keys["party"], "the party to seat", "name a customer of the party"
    )
    table = None
    if "table" in keys:
        table = reader.known(keys["table"], "table", "table", names.tables)
        if table is None:
            return []
    return _party_goal(members, table, node.where)


def _party_goal(
    members: tuple[tuple[str, Where], ...], table: str | None, where: Where
) -> list[Goal]:
    if not members:
        return []
    return [Goal("seated", party=tuple(n for n, _ in members), table=table, where=where)]


def _paid(reader: NodeReader, node: Node, names: Names) -> list[Goal]:
    if isinstance(node, Scalar) and node.text in names.tables:
        return [Goal("paid", table=node.text, where=node.where)]
    name = reader.name(node, "a table or customer")
    return [] if name is None else [Goal("paid", party=(name,), where=node.where)]


def _chairs(reader: NodeReader, node: Node, names: Names) -> list[Goal]:
    goals: list[Goal] = []
    for key, value in reader.entries(node, "the goal chairs") or ():
        table = reader.known(key, "chairs", "table", names.tables)
        number = reader.integer(value, f"chairs of {key.text}", 0, 1000)
        if table is not None and number is not None:
            goals.append(Goal("chairs", table=table, number=number, where=key.where))
    return goals
