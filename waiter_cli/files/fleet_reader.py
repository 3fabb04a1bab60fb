"""Reads several robots of a state: the place of each, the party it leads, what it has. Class `FleetReader`.

``agents: {r1: n2}``, ``with_agent: {r1: [c1]}``, ``carrying: {r1: {table1: jug}}`` and
``ordered: {table1: r1}``.
"""

from __future__ import annotations

from collections.abc import Callable

from waiter_cli.errors import Where
from waiter_cli.files.names import Names, read_table_objects
from waiter_cli.model.state import Party, State
from waiter_cli.yaml_reading.node_reader import NodeReader, is_empty
from waiter_cli.yaml_reading.yaml_tree import Mapping, Node

__all__ = ["FleetReader"]

FORMS = {
    "agents": "{r1: NODE}",
    "with_agent": "{r1: [c1]}",
    "carrying": "{r1: {table1: jug}}",
    "ordered": "{table1: r1}",
}


class FleetReader:
    """Reads the keys of a state that are about robots; ``places`` and ``told`` are the state reader's."""

    def __init__(
        self,
        reader: NodeReader,
        names: Names,
        keys: dict[str, Node],
        places: dict[str, Where],
        told: set[str],
    ) -> None:
        self.reader, self.names, self.keys = reader, names, keys
        self.places, self.told = places, told
        self.robots = names.robots

    def require_forms(self) -> None:
        """Notes a fault where what is said of one robot is said of several, or the other way round."""
        if not self.robots:
            if "agents" in self.keys:
                message = "the layout has one robot, called agent"
                self.reader.fault(self.keys["agents"].where, message, "write agent: NODE")
            return
        if "agent" in self.keys:
            who = ", ".join(self.robots)
            message = f"the layout has several robots: {who}"
            hint = f"write agents: {{{self.robots[0]}: NODE}}"
            self.reader.fault(self.keys["agent"].where, message, hint)
        for key in ("with_agent", "carrying", "ordered"):
            node = self.keys.get(key)
            if node is not None and not isinstance(node, Mapping) and not is_empty(node):
                what = "which robot each party follows" if key == "with_agent" else "by robot"
                what = "a table and the robot that took its order" if key == "ordered" else what
                self.reader.wrong(node, key, f"a mapping, {what}", f"write {FORMS[key]}")

    def _entries(self, key: str) -> tuple[tuple[str, Node, Where], ...]:
        """The robots named under a key, with what is said of each."""
        node = self.keys.get(key)
        entries = []
        if isinstance(node, Mapping):
            for who, value in node.entries:
                name = self.reader.known(who, key, "robot", self.robots)
                if name is not None:
                    self.places[f"{key}.{name}"] = who.where
                    entries.append((name, value, who.where))
        return tuple(entries)

    def stations(self, base: State) -> tuple[tuple[str, str], ...]:
        """Returns where each robot stands, in the order of the layout."""
        found = {robot.name: robot.at for robot in base.robots}
        node = self.keys.get("agents")
        if node is not None and self.robots and not isinstance(node, Mapping):
            self.reader.wrong(node, "agents", "a mapping of robots to nodes", "write {r1: NODE}")
        for name, value, _ in self._entries("agents") if self.robots else ():
            at = self.reader.known(value, f"the place of {name}", "node", self.names.nodes)
            if at is not None:
                found[name] = at
                self.told.add(name)
        return tuple(found.items())

    def parties(self, read: Callable[[Node, str], Party]) -> dict[str, Party]:
        """Returns the party that each robot leads; ``read`` reads one."""
        entries = self._entries("with_agent")
        return {name: read(value, f"the party with {name}") for name, value, _ in entries}

    def carrying(self) -> dict[str, tuple[str, str]]:
        """Returns what each robot carries: its hands hold one thing, and one thing is in one hand."""
        loads: dict[str, tuple[str, str]] = {}
        layout = self.names.layout
        for name, value, where in self._entries("carrying") if layout.bar is not None else ():
            things = read_table_objects(
                self.reader, self.names, value, f"carrying by {name}", layout.objects
            )
            if len(things) > 1:
                self.reader.fault(things[1][2], f"{name} carries two things", "its hands hold one")
            for table, item, place in things[:1]:
                other = next((who for who, load in loads.items() if load == (table, item)), None)
                if other is not None:
                    message = f"{name} and {other} both carry the {item} for {table}"
                    self.reader.fault(where, message, "one of them does")
                loads[name] = (table, item)
                self.places[f"carrying.{table}.{item}"] = place
        return loads

    def orders(self, sent: frozenset[str]) -> dict[str, frozenset[str]]:
        """Returns the tables whose orders each robot holds, but for those that are ``sent``."""
        node = self.keys.get("ordered")
        tables: dict[str, frozenset[str]] = {}
        for key, value in node.entries if isinstance(node, Mapping) else ():
            table = self.reader.known(key, "ordered", "table", self.names.tables)
            robot = self.reader.known(
                value, f"who took the order of {key.text}", "robot", self.robots
            )
            if table is None or robot is None:
                continue
            self.places[f"ordered.{table}"] = key.where
            if table not in sent:
                tables[robot] = tables.get(robot, frozenset()) | {table}
        return tables
