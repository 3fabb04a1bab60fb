"""OrderedJobs: all that every plan must do, in the words of a programme: `Needs`, `Seating` → `OrderedJobs`.

Entry point `find_ordered_jobs`.  Every plan does each of these, whatever else it does: visits tables, has
orders taken before its last visit of the bar, carries things from one place to another, leads
parties to tables.  A chain of an odd shape counts as visits of its places alone, which is less than
it takes, so that what is bounded by `OrderedJobs` is never bounded too high.  Not looked at are orders of
goals, those who move by a timetable, and what a party asks for once it sits.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.insertion import Builder, nodes_of
from waiter_cli.bounds.required_tasks import Chain
from waiter_cli.bounds.seating import Seating
from waiter_cli.bounds.service_chains import HAND_LINKS, Link

__all__ = ["Carrying", "OrderedJobs", "Nodes", "TableOrder", "Sitting", "find_ordered_jobs"]

Nodes = tuple[int, ...]


@dataclass(frozen=True)
class Carrying:
    """Something that is in the hands from one of the ``source`` nodes to one of ``target``.

    ``empty``: it is filled at the bar on the way.  ``held``: it is in the hands from the start.
    ``order`` is the index of the order that it was asked for in, -1: none.
    """

    source: Nodes
    target: Nodes
    empty: bool
    held: bool
    order: int = -1


@dataclass(frozen=True)
class TableOrder:
    """An order to be taken at one of ``nodes`` (none: it is taken already), then sent.

    ``table`` is one at which somebody must be seated first, empty where somebody sits.
    ``plate`` says whether its plate must be taken up afterwards, and nothing can be before.
    """

    nodes: Nodes
    table: str
    plate: bool


@dataclass(frozen=True)
class Sitting:
    """``count`` parties that are alike: what it costs them to sit at each table beyond the walk.

    ``least`` of them must be seated.  ``led``: the party that follows from the start.
    """

    count: int
    least: int
    costs: tuple[tuple[str, int], ...]
    led: bool = False


@dataclass(frozen=True)
class OrderedJobs:
    """Everything that the programme knows of a problem.

    ``deeds`` are the steps that every plan takes without walking; ``seats`` the nodes of each
    table that somebody may be led to; ``forced`` are those that somebody must be led to.
    ``whole`` says that nothing of the problem was left out or weakened.
    """

    start: int
    door: int
    bar: Nodes
    end: int | None
    deeds: int
    visits: tuple[Nodes, ...]
    orders: tuple[TableOrder, ...]
    carryings: tuple[Carrying, ...]
    sittings: tuple[Sitting, ...]
    seats: tuple[tuple[str, Nodes], ...]
    forced: frozenset[str]
    whole: bool


class _Reader:
    def __init__(self, builder: Builder) -> None:
        self.builder, self.seating, self.floor = builder, builder.seating, builder.floor
        self.visits: dict[Nodes, None] = {}
        self.orders: list[TableOrder] = []
        self.carryings: list[Carrying] = []
        self.whole = True

    def visit(self, nodes: Nodes) -> None:
        if nodes:
            self.visits.setdefault(tuple(sorted(nodes)))

    def chain(self, chain: Chain) -> None:
        """Enters a chain: an order to be taken and sent, then something to be carried."""
        floor, links = self.floor, chain.sure
        self.whole &= links == chain.links
        cut = next((k for k, link in enumerate(links) if _of_hands(link)), len(links))
        asked, carried = links[:cut], links[cut:]
        carrying = self.carrying(carried) if carried else None
        names = tuple(link.name for link in asked)
        is_order = names in (("take_order", "send_order"), ("send_order",))
        if (carried and carrying is None) or (names and carried and not is_order):
            self.weaken(chain)
            return
        if is_order:
            first = names[0] == "take_order"
            taken_at = nodes_of(floor, asked[0]) if first and not chain.seat_first else ()
            table = chain.table if first and chain.seat_first else ""
            self.orders.append(TableOrder(taken_at, table, carrying is not None))
            if carrying is not None:
                source, target = carrying.source, carrying.target
                carrying = Carrying(source, target, False, False, len(self.orders) - 1)
        else:
            for link in asked:
                self.stop(chain, link)
        if carrying is not None:
            self.carryings.append(carrying)

    def carrying(self, links: tuple[Link, ...]) -> Carrying | None:
        """Returns what these links carry, None where they are of an odd shape."""
        names = tuple(link.name for link in links)
        target = nodes_of(self.floor, links[-1])
        load = self.builder.needs.now.carrying
        held = load == (links[-1].table, links[-1].item)
        if not target or (held != (names[0] in ("fill", "bring"))):
            return None
        match names:
            case ("refill", "fill", "bring"):
                return Carrying(target, target, True, False)
            case ("take_up", "bring"):
                return Carrying(self.floor.bar, target, False, False)
            case ("fill", "bring"):
                return Carrying((), target, True, True)
            case ("bring",):
                return Carrying((), target, False, True)
        return None

    def stop(self, chain: Chain, link: Link) -> None:
        """Enters one link that only has to be done somewhere."""
        if link.name in ("give_bill", "take_order") and chain.seat_first:
            return  # it can be done where the party was seated, at once
        self.visit(nodes_of(self.floor, link))

    def weaken(self, chain: Chain) -> None:
        """Enters a chain as the places that it visits."""
        self.whole = False
        for link in chain.sure:
            self.stop(chain, link)

    def sittings(self) -> list[Sitting]:
        """Returns the parties to be led, those that are alike together."""
        seating = self.seating
        alike: dict[tuple[tuple[tuple[str, int], ...], bool, bool], int] = {}
        for row in range(len(seating.parties)):
            optional = row >= seating.required
            costs = []
            for table in seating.tables:
                if table.name not in seating.allowed[row]:
                    continue
                if optional and table.name not in seating.needs.forced:
                    continue
                deeds = 2 * optional + seating.extra(row, table.name)
                costs.append((table.name, deeds))
            self.whole &= not seating.asks[row]
            key = (tuple(costs), optional, row == seating.led)
            alike[key] = alike.get(key, 0) + 1
        return [
            Sitting(count, 0 if optional else count, costs, led)
            for (costs, optional, led), count in alike.items()
        ]


def _of_hands(link: Link) -> bool:
    return link.name in HAND_LINKS or link.name in ("fill", "bring")


def find_ordered_jobs(seating: Seating, builder: Builder) -> OrderedJobs:
    """Returns what every plan of a problem does, of which nothing is known to be impossible."""
    reader, needs, problem = _Reader(builder), seating.needs, seating.problem
    for chain in needs.chains:
        reader.chain(chain)
    deeds = sum(link.is_deed for chain in needs.chains for link in chain.sure)
    held = [carrying.held for carrying in reader.carryings]
    weak = bool(needs.now.carrying) and not any(held)
    return OrderedJobs(
        start=seating.start,
        door=seating.floor.door,
        bar=tuple(sorted(seating.floor.bar)),
        end=builder.end,
        deeds=deeds + seating.picks_and_seats(),
        visits=tuple(reader.visits),
        orders=tuple(reader.orders),
        carryings=tuple(reader.carryings),
        sittings=tuple(reader.sittings()),
        seats=tuple(
            (t.name, tuple(sorted(seating.floor.nodes_of[t.name]))) for t in seating.tables
        ),
        forced=frozenset(needs.forced),
        whole=reader.whole and not weak and not problem.layout.timetable and not problem.before,
    )
