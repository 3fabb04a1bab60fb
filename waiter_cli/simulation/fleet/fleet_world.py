"""The simulated restaurant with several robots: the rules of `World`, for whichever robot acts. Class `FleetWorld`."""

from __future__ import annotations

import dataclasses
from dataclasses import replace

from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Observation, Party, Robot, State
from waiter_cli.simulation.world import Violation, World

__all__ = ["FleetWorld", "Hands"]


@dataclasses.dataclass
class Hands:
    """One robot's place and hands: the party it leads, its ``load``; it ``walks`` once it is leaving its node."""

    node: str
    led: Party = ()
    load: tuple[str, str] | None = None
    walks: bool = False


class FleetWorld(World):
    """The restaurant as it is; ``who`` is the robot of which ``robot``, ``led`` and ``load`` speak."""

    def __init__(self, layout: Layout, state: State, instant_kitchen: bool = False) -> None:
        self.hands = {each.name: Hands(each.at, each.leads, each.carries) for each in state.robots}
        self.who = first = next(iter(self.hands))
        self.takers = {table: each.name for each in state.robots for table in each.orders}
        """The robot that took the order of a table."""
        alone = replace(
            state, agent=self.robot, with_agent=self.led, carrying=self.load,
            ordered=state.held_orders(), robots=(),
        )  # fmt: skip
        super().__init__(layout, alone, instant_kitchen)
        for name in self.hands:
            self.who = name
            self._fill_at_bar()
        self.who = first

    @property
    def robot(self) -> str:
        """The node of the robot that acts."""
        return self.hands[self.who].node

    @robot.setter
    def robot(self, node: str) -> None:
        self.hands[self.who].node = node

    @property
    def led(self) -> Party:
        """The party that follows it."""
        return self.hands[self.who].led

    @led.setter
    def led(self, party: Party) -> None:
        self.hands[self.who].led = party

    @property
    def load(self) -> tuple[str, str] | None:
        """The thing that it carries."""
        return self.hands[self.who].load

    @load.setter
    def load(self, load: tuple[str, str] | None) -> None:
        self.hands[self.who].load = load

    def fork(self) -> FleetWorld:
        """Does the same as `World.fork`."""
        other = super().fork()
        assert isinstance(other, FleetWorld)
        other.hands = {name: dataclasses.replace(hands) for name, hands in self.hands.items()}
        other.takers = dict(self.takers)
        return other

    def become(self, state: State) -> None:
        """Does the same as `World.become`; who knows the ``hands`` still knows them."""
        fresh = FleetWorld(self.layout, state, self.instant_kitchen)
        known = self.hands
        self.__dict__.update(fresh.__dict__)
        known.update(fresh.hands)
        self.hands = known

    # ------------------------------------------------------------ what is asked

    def loads(self) -> tuple[tuple[str, str], ...]:
        """Returns everything that is carried."""
        return tuple(each.load for each in self.hands.values() if each.load is not None)

    def leader_of(self, party: Party) -> str | None:
        """Returns the robot that a party follows."""
        return next((n for n, each in self.hands.items() if each.led and each.led == party), None)

    def party_of(self, customer: str) -> Party | None:
        """Does the same as `World.party_of`."""
        led = (each.led for each in self.hands.values() if customer in each.led)
        return super().party_of(customer) or next(led, None)

    def breach(self, action: Action) -> Violation | None:
        """Does the same as `World.breach`; whoever is leaving a node is in nobody's way there."""
        name = action.arguments[0] if action.arguments else ""
        if name not in self.hands:
            return Violation("preconditions", f"{action.text}: there is no robot {name}")
        self.who = name
        wrong = super().breach(action)
        if wrong is None and action.name == "send_order":
            table = action.arguments[1]
            if self.takers.get(table) != name:
                return Violation("preconditions", f"{name} has no order of {table}")
        if wrong is None and action.name == "go_to":
            node = action.arguments[1]
            for other, hands in self.hands.items():
                if other != name and hands.node == node and not hands.walks:
                    return Violation("shared_node", f"{other} stands on {node}")
        return wrong

    def disorder(self) -> Violation | None:
        """Does the same as `World.disorder`."""
        on_node: dict[str, str] = {}
        for name, hands in self.hands.items():
            other = name if hands.walks else on_node.setdefault(hands.node, name)
            if other != name:
                return Violation("shared_node", f"{other} and {name} both stand on {hands.node}")
        for name in self.hands:
            self.who = name
            if (wrong := super().disorder()) is not None:
                return wrong
        return None

    def met(self, goal: Goal) -> bool:
        """Does the same as `World.met`."""
        if goal.kind == "at":
            names = self.hands if goal.robot is None else (goal.robot,)
            return any(self.hands[name].node == goal.node for name in names)
        verdicts = []
        for name in self.hands:
            self.who = name
            verdicts.append(super().met(goal))
        return all(verdicts)

    def state(self) -> State:
        """Does the same as `World.state`."""
        alone = super().state()
        orders: dict[str, set[str]] = {name: set() for name in self.hands}
        for table in alone.ordered:
            orders[self.takers[table]].add(table)
        return replace(
            alone, agent="", with_agent=(), carrying=None, ordered=frozenset(),
            robots=tuple(
                Robot(name, each.node, each.led, each.load, frozenset(orders[name]))
                for name, each in self.hands.items()
            ),
        )  # fmt: skip

    # ------------------------------------------------------------ what happens

    def perform(self, action: Action) -> None:
        """Does the same as `World.perform`."""
        self.who = name = action.arguments[0]
        super().perform(action)
        self.hands[name].walks = False
        if action.name == "take_order":
            self.takers[action.arguments[1]] = name

    def suffer(self, seen: Observation) -> str | None:
        """Does the same as `World.suffer`."""
        first, *rest = seen.arguments
        match seen.kind:
            case "empty" if (first, rest[0]) in self.loads():
                self.changes += 1
                who = next(n for n, each in self.hands.items() if each.load == (first, rest[0]))
                return f"{who} carries the {rest[0]} of {first}"
            case "at":
                self.changes += 1
                taken = {who: node for who, node in self.staff.items() if who != first}
                taken |= {n: each.node for n, each in self.hands.items() if n != first}
                if rest[0] in taken.values():
                    return f"somebody stands on {rest[0]}"
                if first not in self.hands:
                    self.staff[first] = rest[0]
                    return None
                self.who = first
                self.robot = rest[0]
                self._fill_at_bar()
                return None
        return super().suffer(seen)

    def _leave(self, customer: str) -> str | None:
        party, table = self.party_of(customer), self.table_of(customer)
        self.who = self.leader_of(party or ()) or self.who
        found = super()._leave(customer)
        for hands in self.hands.values():
            if table is not None and hands.load == (table, "plate"):
                hands.load = None
        return found
