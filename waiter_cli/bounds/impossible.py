"""Finds why no plan can exist, whatever its length: `Problem` → reasons, without any search.

Entry point `find_reasons`.  Tables are never freed and waiters without a timetable stand for ever,
so what cannot be reached, fitted or matched now never can.  Sound always; for seating and bills
without a timetable complete too (an order of goals is only looked at pair by pair).
"""

from __future__ import annotations

from waiter_cli.bounds.distances import FAR, Staff, WalkDistances
from waiter_cli.bounds.goal_order import order_reasons
from waiter_cli.bounds.matching import cover
from waiter_cli.bounds.reasons import (
    Barriers,
    party_text,
    place_of_bill,
    place_of_goal,
    place_of_party,
    place_of_waiter,
)
from waiter_cli.bounds.required_tasks import Chain, Guest, Needs
from waiter_cli.bounds.service_chains import BAR_LINKS
from waiter_cli.errors import Where
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Party
from waiter_cli.model.wording import in_words

__all__ = ["find_reasons"]


def find_reasons(
    problem: Problem, needs: Needs, floor: WalkDistances, staff: Staff
) -> tuple[Reason, ...]:
    """Returns the reasons why ``problem`` has no plan; empty when none was found."""
    return _Inquiry(problem, needs, floor, staff).find()


class _Inquiry:
    def __init__(self, problem: Problem, needs: Needs, floor: WalkDistances, staff: Staff) -> None:
        self.problem, self.needs, self.floor, self.staff = problem, needs, floor, staff
        self.row = floor.row(floor.number[problem.state.agent])
        self.tables = {table.name: table for table in problem.layout.tables}
        self.sitting = dict(needs.now.seated)
        self.reasons: dict[Reason, None] = {}
        self.barriers = Barriers(problem, staff)
        self.blamed: set[tuple[str, ...]] = set()
        self.reached = {
            name: any(self.row[node] < FAR for node in nodes)
            for name, nodes in floor.nodes_of.items()
        }
        self.bar = any(self.row[node] < FAR for node in floor.bar)

    def say(self, message: str, where: Where | None) -> None:
        self.reasons[Reason(message, where)] = None

    def find(self) -> tuple[Reason, ...]:
        for waiter, node in sorted(self.staff.now.items()):
            if node == self.problem.state.agent:
                place = place_of_waiter(self.problem, waiter)
                self.say(f"{waiter} stands on {node}, where the agent is", place)
        for lost in self.needs.hopeless:
            self.say(lost.why, place_of_goal(self.problem, lost.goal))
        self.end()
        for chain in self.needs.chains:
            self.chain(chain)
        self.seating()
        if not self.reasons:
            for reason in order_reasons(self.problem, self.needs, self.floor):
                self.reasons[reason] = None
        return tuple(self.reasons)

    def blocked(self, what: str, nodes: tuple[str, ...], where: Where | None) -> None:
        for waiters, reason in self.barriers.before(what, nodes, where):
            if not waiters or waiters not in self.blamed:  # one cause is named once
                self.blamed.add(waiters)
                self.reasons[reason] = None

    def end(self) -> None:
        visits = [(k.node, c.ends[0]) for c in self.needs.chains for k in c.sure if k.node]
        if self.needs.end is not None:
            goals = [goal for goal in self.problem.goals if goal.kind == "at"]
            visits.append((self.needs.end, goals[0]))
        for node, goal in visits:
            if self.row[self.floor.number[node]] == FAR:
                self.blocked(node, (node,), place_of_goal(self.problem, goal))

    def table_blocked(self, name: str) -> None:
        table = self.tables[name]
        self.blocked(name, tuple(dict.fromkeys(table.nodes)), table.where)

    def tables_blocked(self, names: tuple[str, ...]) -> None:
        """None of several tables will do: says who is in the way, else that no path leads there."""
        if any(self.reached[name] for name in names):
            self.bar_blocked()
        nodes = {name: tuple(dict.fromkeys(self.tables[name].nodes)) for name in names}
        lost = [name for name in names if not self.reached[name]]
        behind = [name for name in lost if self.barriers.reached(()) & set(nodes[name])]
        for name in behind or lost:
            self.table_blocked(name)

    def bar_blocked(self) -> None:
        bar = self.problem.layout.bar
        if bar is not None:
            self.blocked("the bar", tuple(dict.fromkeys(bar.nodes)), bar.where)

    def chain(self, chain: Chain) -> None:
        at_table = any(link.table and link.name not in BAR_LINKS for link in chain.sure)
        if at_table and not self.reached[chain.table]:
            self.table_blocked(chain.table)
        if not self.bar and any(link.name in BAR_LINKS for link in chain.sure):
            self.bar_blocked()

    # ------------------------------------------------------------ seating

    def fits(self, party: Party) -> list[str]:
        """Returns the free tables within reach that are large enough."""
        return [
            name
            for name, table in self.tables.items()
            if name not in self.sitting and table.capacity >= len(party) and self.reached[name]
        ]

    def open_to(self, guest: Guest) -> list[str]:
        """Returns the tables at which a guest can be seated and be given what is wanted there."""
        asks = dict(guest.asks)
        return [
            name
            for name in guest.tables
            if self.reached[name]
            and (
                self.bar or not any(k.name in BAR_LINKS for c in asks.get(name, ()) for k in c.sure)
            )
        ]

    def seating(self) -> None:
        guests = list(self.needs.guests)
        led = self.needs.now.with_agent
        waiting = [guest for guest in guests if not guest.led]
        door_shut = self.row[self.floor.door] == FAR
        before = len(self.reasons)
        if waiting and door_shut:
            self.door_blocked()
        rows = [(guest.party, self.open_to(guest)) for guest in guests]
        for guest, (_, tables) in zip(guests, rows):
            if not tables:
                self.no_table(guest)
        if len(self.reasons) > before or not all(tables for _, tables in rows):
            return
        needs_pick = self.forced_tables(rows, door_shut) or bool(waiting)
        if led in self.needs.spare and needs_pick:
            rows.append((led, self.fits(led)))
            if not rows[-1][1]:
                message = f"{party_text(led)} with the agent fits no free table within reach"
                where = place_of_party(self.problem, led)
                self.say(f"{message}, so nobody else can be picked up", where)
                return
        if len(self.reasons) == before:
            self.match(rows)

    def door_blocked(self) -> None:
        door = self.problem.layout.entrance
        where = dict(self.problem.layout.key_where).get("entrance")
        self.blocked(f"the entrance {door}", (door,), where)

    def forced_tables(self, rows: list[tuple[Party, list[str]]], door_shut: bool) -> bool:
        """Looks for somebody to sit at each table where that is needed; whether to pick for it."""
        forced = [name for name in self.needs.forced if self.reached[name]]
        if not forced:
            return False
        rows = rows + [(party, self.fits(party)) for party in self.needs.spare]
        led = self.needs.now.with_agent
        if len(forced) == 1 and any(p == led and forced[0] in tables for p, tables in rows):
            return False
        able = [p for p, _ in rows if p == led or not door_shut]
        who = [[k for k, (p, t) in enumerate(rows) if p in able and name in t] for name in forced]
        for name, parties in zip(forced, who):
            if not parties:
                if door_shut and any(name in tables for _, tables in rows):
                    self.door_blocked()
                else:
                    where = self.forced_place(name)
                    self.say(f"nobody can sit at {name}, so {self.for_want_of(name)}", where)
        if all(who):
            _, stuck = cover(who)
            if stuck:
                names = [forced[index] for index in stuck]
                some = sorted({rows[k][0][0] for index in stuck for k in who[index]})
                message = f"{in_words(names)} must all be sat at, and only {in_words(some)} could"
                self.say(message, self.forced_place(names[-1]))
        return True

    def forced_place(self, name: str) -> Where | None:
        goal = next((g for c in self.needs.chains if c.table == name for g in c.ends), None)
        place = place_of_goal(self.problem, goal) if goal is not None else None
        return place or place_of_bill(self.problem, name)

    def for_want_of(self, name: str) -> str:
        kinds = {link.name for c in self.needs.chains if c.table == name for link in c.links}
        if "take_order" in kinds and "give_bill" not in kinds:
            return "its order can never be taken"
        return "its bill can never be given"

    def match(self, rows: list[tuple[Party, list[str]]]) -> None:
        columns = {name: index for index, name in enumerate(self.tables)}
        _, stuck = cover([[columns[name] for name in tables] for _, tables in rows])
        if not stuck:
            return
        group = [rows[index] for index in stuck]
        names = sorted({name for _, tables in group for name in tables}, key=columns.__getitem__)
        parties = in_words([party_text(party) for party, _ in group])
        are = "is" if len(names) == 1 else "are"
        message = f"{parties} need {len(group)} tables, and there {are} only {in_words(names)}"
        others = [name for name in self.sitting if self.would_do(name, group)]
        if others:
            sits = "somebody sits" if len(others) == 1 else "others sit"
            message += f" ({sits} at {in_words(others)})"
        self.say(message, place_of_party(self.problem, group[-1][0]))

    def would_do(self, name: str, group: list[tuple[Party, list[str]]]) -> bool:
        least = min(len(party) for party, _ in group)
        goals = [goal for guest in self.needs.guests for goal in guest.ends]
        named = any(goal.kind == "seated" and goal.table for goal in goals)
        return not named and self.tables[name].capacity >= least

    def no_table(self, guest: Guest) -> None:
        """Says why a guest alone finds no table."""
        problem, party = self.problem, guest.party
        where = place_of_party(problem, party)
        tables = list(dict.fromkeys(g.table for g in guest.ends if g.kind == "seated" and g.table))
        goal = guest.ends[0]
        if len(tables) > 1:
            message = f"{party_text(party)} cannot sit both at {tables[0]} and at {tables[1]}"
            self.say(message, place_of_goal(problem, goal))
            return
        if tables:
            self.not_there(guest, tables[0], next(g for g in guest.ends if g.table))
            return
        largest = max(self.tables.values(), key=lambda table: table.capacity, default=None)
        large = [n for n, table in self.tables.items() if table.capacity >= len(party)]
        if largest is None or not large:
            tail = f"the largest, {largest.name}, seats {largest.capacity}" if largest else "none"
            self.say(f"{party_text(party)} fits no table: {tail}", where)
            return
        free = [name for name in large if name not in self.sitting]
        if not free:
            fit = "large enough " if len(large) < len(self.tables) else ""
            taken = in_words(large)
            self.say(f"{party_text(party)} finds no free table: {taken} {fit}taken", where)
            return
        if guest.tables and not self.open_to(guest):
            self.tables_blocked(guest.tables)
            return
        self.say(self.why_not_served(party, goal), place_of_goal(problem, goal) or where)

    def why_not_served(self, party: Party, goal: Goal) -> str:
        if any(goal.kind == "paid" for goal in self.goals_of(party)):
            return f"no free table that seats {party_text(party)} wants its bill"
        return f"at no free table could {party_text(party)} be served to the end"

    def goals_of(self, party: Party) -> list[Goal]:
        return [g for guest in self.needs.guests if guest.party == party for g in guest.ends]

    def not_there(self, guest: Guest, name: str, goal: Goal) -> None:
        where, party = place_of_goal(self.problem, goal), guest.party
        table = self.tables[name]
        if name in self.sitting:
            by = self.sitting[name][0]
            self.say(
                f"{name} is not free for {party_text(party)}: the party of {by} sits there", where
            )
        elif table.capacity < len(party):
            self.say(
                f"{party_text(party)} does not fit {name}, which seats {table.capacity}", where
            )
        elif not self.reached[name]:
            self.table_blocked(name)
        elif name in guest.tables:
            self.bar_blocked()
        else:
            wish = next((g for g in guest.ends if g.kind in ("paid", "serve")), goal)
            place = place_of_goal(self.problem, wish)
            if wish.kind == "paid":
                self.say(f"{name} has not paid and does not want its bill", place)
            else:
                self.say(f"{party_text(party)} could not be served to the end at {name}", place)
