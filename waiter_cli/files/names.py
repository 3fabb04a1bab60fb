"""Names of nodes, tables, waiters and customers, looked up as a file is read."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from waiter_cli.errors import Where
from waiter_cli.model.layout import Layout
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Listing, Node, Scalar

__all__ = ["Names", "fresh_customers", "read_table_objects", "stocked"]


def fresh_customers(taken: Iterable[str]) -> Iterator[str]:
    """Yields c1, c2, … without the names that are taken.

    >>> from itertools import islice
    >>> list(islice(fresh_customers({"c2"}), 3))
    ['c1', 'c3', 'c4']
    """
    used = set(taken)
    number = 0
    while True:
        number += 1
        if (name := f"c{number}") not in used:
            yield name


class Names:
    """The names a scenario may use: those of the layout, and customers and waiters of its own."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.nodes = frozenset(node.name for node in layout.nodes)
        self.tables = frozenset(table.name for table in layout.tables)
        self.robots = tuple(name for name, _ in layout.agents)
        self.waiters = {name for name, _ in layout.waiters}
        self.customers: set[str] = set()
        self._kinds = dict.fromkeys(self.nodes, "node")
        self._kinds |= dict.fromkeys(self.tables, "table")
        self._kinds |= dict.fromkeys(layout.objects, "object")
        self._kinds |= dict.fromkeys(self.waiters, "waiter")
        self._kinds |= dict.fromkeys(self.robots, "robot")

    def adopt(self, kind: str, names: Iterable[str]) -> None:
        """Adopts names that were checked before, such as those of a scenario that was read."""
        for name in names:
            self._kinds.setdefault(name, kind)
            (self.waiters if kind == "waiter" else self.customers).add(name)

    def taken(self) -> set[str]:
        """Returns every name that a new customer cannot have."""
        return set(self._kinds) | self.customers

    def declare(
        self, reader: NodeReader, node: Node, kind: str, mend: str | None = None
    ) -> str | None:
        """Returns the name of a ``customer`` or ``waiter``.

        A fault where something else is called so.
        """
        name = reader.name(node, f"a {kind}")
        if name is None:
            return None
        other = self._kinds.setdefault(name, kind)
        if other != kind:
            article = "an" if other == "object" else "a"
            message = f"{name} is {article} {other}, so no {kind} can be called that"
            reader.fault(node.where, message, mend or f"give the {kind} another name")
            return None
        (self.waiters if kind == "waiter" else self.customers).add(name)
        return name

    def party(
        self, reader: NodeReader, node: Node, what: str, mend: str | None = None
    ) -> tuple[tuple[str, Where], ...]:
        """Customers of one party, each named once; a single name stands for itself.

        ``mend`` is what to do about a name that is not a customer's.
        """
        if isinstance(node, Scalar) and not node.is_nothing:
            if node.plain and node.text.isdigit():
                reader.wrong(node, what, "a list of customers", "name them: [c1, c2]")
                return ()
            items: tuple[Node, ...] = (node,)
        else:
            items = reader.items(node, what, "name the customers: [c1, c2]") or ()
        places: dict[str, Where] = {}
        for item in items:
            name = self.declare(reader, item, "customer", mend)
            if name is None:
                continue
            if name in places:
                reader.fault(item.where, f"{name} is named twice in one party", "once is enough")
            places.setdefault(name, item.where)
        return tuple(places.items())


def stocked(
    reader: NodeReader, layout: Layout, where: Where, what: str, item: str | None = None
) -> bool:
    """Returns whether the layout has a bar, and that object; a fault for what needs them otherwise."""
    if layout.bar is None:
        mend = "add bar: [NODE] to the layout, or leave this out"
        reader.fault(where, f"{what} needs a bar, and the layout has none", mend)
        return False
    if item is not None and item not in layout.objects:
        known = ", ".join(layout.objects) or "nothing"
        reader.fault(where, f"the layout has no object {item}", f"its objects are: {known}")
        return False
    return True


def read_table_objects(
    reader: NodeReader, names: Names, node: Node, what: str, kinds: Collection[str]
) -> tuple[tuple[str, str, Where], ...]:
    """Returns pairs (table, object) of a mapping ``{table1: plate, table2: [plate, jug]}``."""
    objects: dict[tuple[str, str], Where] = {}
    for key, value in reader.entries(node, what) or ():
        table = reader.known(key, what, "table", names.tables)
        for item in value.items if isinstance(value, Listing) else (value,):
            name = reader.known(item, f"what is {what}", "object", kinds)
            if name is None or table is None:
                continue
            if not stocked(reader, names.layout, item.where, what, name):
                continue
            if (table, name) in objects:
                reader.fault(item.where, f"{what}: {name} of {table} is listed twice")
            objects.setdefault((table, name), item.where)
    return tuple((table, item, where) for (table, item), where in objects.items())
