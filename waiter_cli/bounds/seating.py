"""Chooses a table for each party: costs of every choice, and the cheapest one.

Entry point `Seating`.  Leading a party costs the walk from the entrance to the table and back again
(for a party that follows already: from the start to the table and to the entrance), and the deeds
that this table asks of it: chairs to bring, wishes to serve there.  The way back of the last one is
not always walked; `relaxed_route` makes up for it.
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import FAR, WalkDistances
from waiter_cli.bounds.matching import Assignment, cheapest
from waiter_cli.bounds.required_tasks import Chain, Needs
from waiter_cli.bounds.service_chains import BAR_LINKS
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Party

__all__ = ["TableChoice", "Seating"]


@dataclass(frozen=True)
class TableChoice:
    """The settled part of a seating: tables used by somebody, by nobody.

    Where the led party sits or not.

    ``once`` are tables of which a route must not make use twice.
    """

    must: frozenset[str] = frozenset()
    never: frozenset[str] = frozenset()
    led_at: str | None = None
    led_never: frozenset[str] = frozenset()
    once: tuple[str, ...] = ()


_MUST = 1 << 12
"""Taken off the cost of tables that must be used; more than any plan costs, less than `FAR`."""


class Seating:
    """The parties to be led (rows) and the tables (columns) they can have.

    Rows: guests, the led party if it must make way, then parties that only might be seated because
    a table must be used (`optional`; each has a column of its own, to stay where it is).
    """

    def __init__(self, problem: Problem, needs: Needs, floor: WalkDistances) -> None:
        self.problem, self.needs, self.floor = problem, needs, floor
        self.start = floor.number[problem.state.agent]
        sitting = dict(needs.now.seated)
        self.tables = [
            table
            for table in problem.layout.tables
            if table.name not in sitting and floor.nodes_of[table.name]
        ]
        self.index = {table.name: k for k, table in enumerate(self.tables)}
        self.chairs = {table.name: table.chairs for table in problem.layout.tables}
        self.chairs |= dict(needs.now.chairs)
        self.parties: list[Party] = [guest.party for guest in needs.guests]
        self.asks: list[dict[str, tuple[Chain, ...]]] = [dict(g.asks) for g in needs.guests]
        self.allowed: list[set[str]] = [
            self._servable(g.tables, dict(g.asks)) for g in needs.guests
        ]
        waiting = any(not guest.led for guest in needs.guests)
        for party in needs.spare:
            if party == needs.now.with_agent and (waiting or needs.forced):
                self._add(party)
        self.required = len(self.parties)
        if needs.forced:
            for party in needs.spare:
                if party not in self.parties:
                    self._add(party)
        self.led = next((k for k, p in enumerate(self.parties) if p == needs.now.with_agent), None)
        self.deeds = {
            (link.name, link.table, link.item) for chain in needs.chains for link in chain.sure
        }
        self.costs = [self._row(k) for k in range(len(self.parties))]

    def _add(self, party: Party) -> None:
        self.parties.append(party)
        self.asks.append({})
        self.allowed.append({t.name for t in self.tables if t.capacity >= len(party)})

    def _servable(self, tables: Iterable[str], asks: dict[str, tuple[Chain, ...]]) -> set[str]:
        bar = bool(self.floor.bar)
        return {
            name
            for name in tables
            if bar or not any(k.name in BAR_LINKS for c in asks.get(name, ()) for k in c.sure)
        }

    def extra(self, row: int, name: str) -> int:
        """Returns the deeds that seating this party at that table asks for, beside pick and seat."""
        count = 0
        if self.chairs[name] < len(self.parties[row]):
            count += ("bring_chairs", name, "") not in self.deeds
        for chain in self.asks[row].get(name, ()):
            for link in chain.sure:
                key = (link.name, link.table, link.item)
                count += link.is_deed and key not in self.deeds
        return count

    def loop(self, row: int, node: int) -> int:
        """Returns the steps walked for a party that is seated from ``node``, back to the entrance.

        From where no way leads back only the last party can be seated: nothing is counted for it.
        """
        back = self.floor.column(self.floor.door)[node]
        if self.floor.one_way and back >= FAR:
            back = 0
        if row == self.led:
            return self.floor.row(self.start)[node] + (back if self.returns else 0)
        return self.floor.row(self.floor.door)[node] + back

    @property
    def returns(self) -> bool:
        """Returns whether the way from the led party's table goes on to the entrance."""
        return any(k != self.led for k in range(len(self.parties)))

    def _row(self, row: int) -> list[int]:
        optional = row >= self.required
        costs = []
        for table in self.tables:
            name = table.name
            allowed = name in self.allowed[row] and (not optional or name in self.needs.forced)
            cost = FAR
            if allowed:
                cost = min(self.loop(row, node) for node in self.floor.nodes_of[name])
            if cost < FAR:
                cost += self.extra(row, name)
                if optional:
                    cost += 1 if row == self.led else 2
            costs.append(min(cost, FAR))
        own = [FAR] * (len(self.parties) - self.required)
        if optional:
            own[row - self.required] = 0
        return costs + own

    def solve(self, choice: TableChoice) -> Assignment | None:
        """Returns the cheapest assignment that keeps to ``choice``; forced tables are always used.

        Its cost has `_MUST` put back; prices and slacks are those of the changed costs.
        """
        used = {*self.needs.forced, *choice.must}
        if not used <= self.index.keys():
            return None
        needed = {self.index[name] for name in used}
        closed = {self.index[name] for name in choice.never}
        if not self.parties:
            return None if needed else Assignment((), 0, (), (), ())
        costs = []
        for row, line in enumerate(self.costs):
            shut = closed
            if row == self.led and choice.led_at is not None:
                keep = self.index[choice.led_at]
                shut = set(range(len(line))) - {keep}
            elif row == self.led:
                shut = closed | {self.index[name] for name in choice.led_never}
            elif choice.led_at is not None:
                shut = closed | {self.index[choice.led_at]}
            costs.append(
                [
                    FAR if column in shut or cost >= FAR else cost - _MUST * (column in needed)
                    for column, cost in enumerate(line)
                ]
            )
        assignment = cheapest(costs, FAR)
        if assignment is None or not needed <= set(assignment.column):
            return None
        back = assignment.cost + _MUST * len(needed)
        return Assignment(assignment.column, back, assignment.rows, assignment.columns, costs)

    def picks_and_seats(self) -> int:
        """Returns the number of actions of picking and seating that are needed in any case."""
        led = self.led is not None and self.led < self.required
        return 2 * self.required - led
