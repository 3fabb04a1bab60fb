"""Happenings while a plan is carried out: guests, bills, blocks, stalls. Class `Happenings`."""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.evenings.evening import Evening
from waiter_cli.evenings.injections import Injection
from waiter_cli.files.names import fresh_customers
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Observation, Party
from waiter_cli.problems.guests import names_in_use
from waiter_cli.room.room import Room
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import Body, OngoingAction, SimulatedClock
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.outcome import TICKS, Happening, sentence, told
from waiter_cli.simulation.world import World

__all__ = ["Happenings"]


class Happenings:
    """Events and injections that are still to come; each changes the world, and the controller is told.

    ``disturbed`` says whether anything has come that a plan made before knows nothing of, ``evening`` has
    the guests who come by chance, where some do.
    """

    def __init__(
        self,
        problem: Problem,
        timed: Sequence[TimedEvent],
        injections: Sequence[Injection],
        room: Room,
        *,
        clock: SimulatedClock,
        body: Body,
        world: World,
        crowd: Crowd,
        blocks: Blocks,
        deliberation: Deliberation,
        ongoing: OngoingAction,
        reporter: Reporter,
        guests: GuestModel | None = None,
        seed: int = 0,
    ) -> None:
        self.disturbed = False
        self._room, self._clock, self._body = room, clock, body
        self._world, self._crowd, self._blocks = world, crowd, blocks
        self._deliberation, self._ongoing, self._reporter = deliberation, ongoing, reporter
        self._coming = _in_order(timed, injections)
        self._names = fresh_customers(names_in_use(problem, timed))
        self.evening: Evening | None = None
        self._looked = -1  # the changes of the world when the guests looked last
        if guests is not None:
            self.evening = Evening(
                guests, seed, problem.layout, self._names, instant_kitchen=problem.instant_kitchen
            )

    def happen(self) -> None:
        """Lets happen what is due."""
        while self._coming and self._coming[0].time <= self._clock.time + 1e-9:
            happening = self._coming.pop(0)
            self.disturbed = True
            if happening.injection is None:
                self._observed(happening.seen, "observed")
            else:
                self._inject(happening.injection)
        if self.evening is not None:
            self._live(self.evening)

    def _live(self, evening: Evening) -> None:
        """Lets guests see what was done, and do what they do next."""
        time = self._clock.time
        if self._world.changes != self._looked:
            self._looked = self._world.changes
            evening.look(self._world.state(), time)
        for seen in evening.due(time):
            self.disturbed = True
            self._observed((seen,), "observed")

    def wait(self, *, skip: bool) -> bool:
        """Waits for what is still to come; False when nothing is, and everybody has come to rest.

        Where nobody looks on, time may ``skip`` ahead.
        """
        if self._crowd.busy():
            self._body.hold(0.25)
            return True
        upcoming = [happening.time for happening in self._coming]
        if self.evening is not None and self.evening.next_time is not None:
            upcoming.append(self.evening.next_time)
        upcoming += [b.until for b in self._blocks.standing() if b.until is not None and b.told]
        if not upcoming:
            return False
        if skip and not self._crowd.escorted():
            self._clock.skip_to(int(min(upcoming) * TICKS) - 1)
        self._body.hold(max(1 / TICKS, min(0.5, min(upcoming) - self._clock.time)))
        return True

    def _inject(self, injection: Injection) -> None:
        match injection.kind, injection.subject:
            case "block", (a, b):
                self._blocks.add((a, b), injection.amount)
                lasting = {} if injection.amount is None else {"seconds": injection.amount}
                self._reporter.say("injected", kind="block", edge=f"{a}-{b}", **lasting)
            case "stall", _:
                self._reporter.say("injected", kind="stall", seconds=injection.amount)
                self._body.stall(injection.amount or 0.0)
            case "leave", (who,):
                self._observed((Observation("leave", (who,)),), "injected")
            case "enter", (number,):
                party = self.fresh_party(int(number))
                self._observed((Observation("enter", party),), "injected")
            case "bill", (table,):
                self._observed((Observation("bill", (table,)),), "injected")

    def fresh_party(self, size: int) -> Party:
        """Returns so many guests named as nobody was before."""
        return tuple(next(self._names) for _ in range(size))

    def suffer(self, seen: Sequence[Observation]) -> None:
        """Lets something happen that whoever decides knows of already."""
        self.disturbed = True
        for one in seen:
            party = self._world.party_of(one.arguments[0]) if one.kind == "leave" else None
            if self._suffer(one) is None:
                self._show(one, party)
                self._reporter.say("observed", **told(one))
                if party:
                    self._reporter.say("left", party=list(party))

    def _observed(self, seen: Sequence[Observation], kind: str) -> None:
        """Changes the world by what is seen, and tells the controller what was possible of it."""
        possible: list[Observation] = []
        leaving: list[Party] = []
        for one in seen:
            party = self._world.party_of(one.arguments[0]) if one.kind == "leave" else None
            refusal = self._suffer(one)
            if refusal is not None:
                self._reporter.say(kind, **told(one), ignored=refusal)
                continue
            possible.append(one)
            leaving += [party] if party else []
            self._show(one, party)
        if not possible:
            return
        heard = [told(one) for one in possible]
        revision = self._deliberation.mind.decision.revision
        changed = self._deliberation.observe(possible).revision != revision
        for each in heard:
            answer = "replan" if changed else "the plan stands"
            self._reporter.say(kind, **each, answer=answer)
        for party in leaving:
            self._reporter.say("left", party=list(party))
        if self._ongoing.action is None:
            self._deliberation.compare()
        self._deliberation.tell(revision, "; ".join(sentence(one) for one in possible))

    def _suffer(self, seen: Observation) -> str | None:
        """Changes the world by one thing; returns why that cannot be."""
        return self.objection(seen) or self._world.suffer(seen)

    def objection(self, seen: Observation) -> str | None:
        """Returns why somebody cannot be seen somewhere, whatever the world is like; None where he can."""
        if seen.kind == "at" and self._acts(seen.arguments[0]):
            return "the robot knows better where it is while it acts"
        return None

    def _acts(self, who: str) -> bool:
        """Returns whether this is a robot at work."""
        return who == "agent" and self._ongoing.action is not None

    def _show(self, seen: Observation, party: Party | None) -> None:
        """Moves people as what happened has them move."""
        match seen.kind:
            case "enter":
                self._crowd.wait(seen.arguments, come_in=True)
            case "leave" if party:
                self._crowd.leave(party)
            case "at" if seen.arguments[0] == "agent":
                self._body.put(self._room.nodes[seen.arguments[1]])
            case "at":
                who, node = seen.arguments
                self._crowd.send(who, self._room.nodes[node], 0.0)


def _in_order(timed: Sequence[TimedEvent], injections: Sequence[Injection]) -> list[Happening]:
    found = [Happening(e.time, k, e.observations) for k, e in enumerate(timed)]
    later = [i for i in injections if i.kind != "slip"]
    found += [Happening(i.time, len(found) + k, (), i) for k, i in enumerate(later)]
    return sorted(found, key=lambda h: (h.time, h.order))
