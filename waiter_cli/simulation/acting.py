"""Carries out one action at a time and checks it: before, while and after. Class `Actor`."""

from __future__ import annotations

from random import Random
from typing import Any

from waiter_cli.encoding.declarations import (
    SECONDS,
    declarations_of,
    declared_words,
    place_of,
    words_for,
)
from waiter_cli.encoding.domains import Domain
from waiter_cli.execution.protocols import Controller
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Party
from waiter_cli.room.motion import gesture, write_script
from waiter_cli.room.room import Room
from waiter_cli.simulation.body import Body, OngoingAction, Shown
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.driver import Driver
from waiter_cli.simulation.event_log import Reporter
from waiter_cli.simulation.outcome import EVENT_OF, Rules, RunEnded, ShownAction, words
from waiter_cli.simulation.world import RULES, Violation, World

__all__ = ["MAX_FAILURES", "NEAR_ENOUGH", "Actor", "details_of", "wrong_seats"]

MAX_FAILURES = 8
"""Actions that may fail one after the other."""
ONLY_OURS = "the room knows the restaurant's own actions only; look at the plan with waiter plan"
IDLE = 2.0
"""Seconds that an idle step takes."""
NEAR_ENOUGH = {"kinematic": 0.02, "physics": 0.10}
"""Metres that an arrival may be beside its node, by drive."""


class Actor:
    """Plays the steps of a run.  ``done`` and ``failed`` count actions.

    ``slip`` is the probability that an action is in vain.
    """

    def __init__(
        self,
        room: Room,
        rules: Rules,
        slip: float,
        *,
        body: Body,
        world: World,
        crowd: Crowd,
        driver: Driver,
        deliberation: Deliberation,
        ongoing: OngoingAction,
        reporter: Reporter,
        shown: Shown,
        domain: Domain | None = None,
    ) -> None:
        self.done = self.failed = 0
        self._domain = domain
        self._room, self._rules, self._slip = room, rules, slip
        self._body, self._world, self._crowd, self._driver = body, world, crowd, driver
        self._deliberation, self._ongoing = deliberation, ongoing
        self._reporter, self._shown = reporter, shown
        self._rng = Random(f"slip {rules.seed}")
        self._failed_in_a_row = 0

    @property
    def _mind(self) -> Controller:
        return self._deliberation.mind

    def step(self, action: Action) -> None:
        """Carries out the next action of the plan, or idles until it is due."""
        if action.step > self._mind.step:
            self.idle()
            return
        self._ongoing.begin(action)
        self._shown.deeds.append(ShownAction(action.step, action.text, "now"))
        self._reporter.say("action_start", action=action.text)
        wrong = self._world.breach(action)
        if wrong is not None:
            self._refuse(action, wrong)
            return
        self._mind.started(action.step)
        self._send_staff()
        if self._slip and self._rng.random() < self._slip:
            self._play_slip(action)
            return
        home = self._world.robot
        why = self._play(action)
        if why is None:
            wrong = self._world.breach(action)
            why = wrong.reason if wrong is not None else None
        if why is None:
            self._succeed(action)
            return
        if action.name == "go_to":
            self._driver.back_to((home,))
        self._fail(action, why)

    def idle(self) -> None:
        """Does nothing for a step; colleagues go where their timetable has them."""
        step, revision = self._mind.step, self._mind.decision.revision
        self._send_staff()
        self._body.hold(IDLE)
        if self._mind.decision.revision != revision:
            # News came in between: there may be something to do at this very step.
            return
        self._world.tick_over(step + 1)
        self._check_order()
        self._mind.done(step)
        self._deliberation.compare()
        self._deliberation.tell(revision, "the plan goes on otherwise")

    def _send_staff(self) -> None:
        """Colleagues who are due elsewhere at the next step set out."""
        for who, node in self._world.expected(self._mind.step + 1).items():
            self._crowd.send(who, self._room.nodes[node], IDLE)

    # ------------------------------------------------------------ motion

    def _play(self, action: Action) -> str | None:
        """Drives the robot, or plays a gesture; returns why it came to nothing."""
        if action.name == "go_to":
            return self._driver.drive(action.arguments[1])
        place = self._place(action)
        for move in write_script(action, self._body.pose, self._room, self._rules.speed, place):
            if move.kind == "gesture":
                self._shown.saying = self._says(action)
                if action.name not in RULES:
                    move = gesture(self._body.pose, self._seconds(action))
                if action.name == "seat":
                    chairs = self._room.chairs[action.arguments[2]]
                    seconds = self._crowd.sit(self._world.led, chairs)
                    move = gesture(self._body.pose, max(move.seconds, seconds + 0.4))
            ended = self._body.play(move)
            if ended is not None:
                self._shown.saying = ""
                if action.name == "seat":  # whoever is still here follows on
                    self._follow_again()
                return ended if isinstance(ended, str) else "the way is blocked"
        self._shown.saying = ""
        return None

    def _follow_again(self) -> None:
        inside = [name for name in self._world.led if name in self._crowd.people]
        self._crowd.follow(inside, self._body.pose)

    def _play_slip(self, action: Action) -> None:
        """The action has no effect: wheels spin, or the deed is done in vain."""
        told = self._own_words(action)
        self._reporter.say("injected", kind="slip", action=action.text, **told)
        self._shown.banner = f"slipped: to {self._in_words(action)} had no effect"
        self._body.play(gesture(self._body.pose, 1.0))
        self._fail(action, "slipped, without effect")

    # ------------------------------------------------------------ outcomes

    def _refuse(self, action: Action, wrong: Violation) -> None:
        """An action that cannot be done now fails at once."""
        told = self._own_words(action)
        self._reporter.say(
            "precondition_failed",
            action=action.text,
            check=wrong.check,
            reason=wrong.reason,
            **told,
        )
        self._reporter.fail(wrong)
        if (
            action.name not in RULES and self._domain is None
        ):  # of a domain of one's own: it would fail every time
            self._shown.deeds[-1].state = "failed"
            self.failed += 1
            raise RunEnded("failed", f"{action.text} cannot be played: {ONLY_OURS}")
        self._fail(action, wrong.reason)

    def _succeed(self, action: Action) -> None:
        step = action.step
        party = self._party_in(action)
        self._world.perform(action)
        details = self._arrive(action, party)
        self._world.tick_over(step + 1)
        self._reporter.say(EVENT_OF.get(action.name, "acted"), **details)
        self._check_order()
        revision = self._mind.decision.revision
        self._deliberation.done(step)
        self._deliberation.compare()
        self._reporter.say("action_end", action=action.text)
        self._shown.deeds[-1].state = "done"
        self._ongoing.action, self._failed_in_a_row = None, 0
        self.done += 1
        self._deliberation.tell(revision, "the plan goes on otherwise")

    def _arrive(self, action: Action, party: Party) -> dict[str, Any]:
        """Moves people as the effects have them move; returns the details of the event."""
        match action.name, action.arguments:
            case "go_to", (_, node):
                error = self._body.away(self._room.nodes[node])
                if error > NEAR_ENOUGH[self._rules.drive]:
                    beside = f"{error:.3f} m beside {node} at arrival"
                    self._reporter.fail(Violation("arrival", beside))
                return {"node": node, "error_m": round(error, 3)}
            case "pick", _:
                self._crowd.follow(party, self._body.pose)
            case "seat", (_, _, table):
                wrong = wrong_seats(self._room, self._world, self._crowd, party, table)
                if wrong is not None:
                    self._reporter.fail(wrong)
        if action.name not in RULES:
            return {"action": action.text, "text": self._says(action)}
        return details_of(action, party, self._room, self._world)

    def _says(self, action: Action) -> str:
        """Returns the caption of an action: the robot's words, or what its domain declares."""
        declared = declared_words(self._domain, action, caption=True)
        if declared is None and action.name in RULES:
            return words(action)
        return declared or self._in_words(action)

    def _in_words(self, action: Action) -> str:
        return words_for(self._domain, action, self._mind.state)

    def _own_words(self, action: Action) -> dict[str, str]:
        """Returns the words of an action of a domain of one's own, as events have them."""
        return {} if self._domain is None else {"text": self._in_words(action)}

    def _place(self, action: Action) -> str | None:
        """Returns where an action of a domain of one's own is done, as far as that is known."""
        if self._domain is None or action.name in RULES:
            return None
        return place_of(self._domain, action, self._world.layout)

    def _seconds(self, action: Action) -> float:
        """Returns how long an action of a domain of one's own takes."""
        looks = None if self._domain is None else declarations_of(self._domain).deed(action)
        return SECONDS if looks is None else looks.seconds

    def _fail(self, action: Action, why: str) -> None:
        """An action failed: the run stops, or the rest is planned anew."""
        self.failed += 1
        self._failed_in_a_row += 1
        self._shown.deeds[-1].state = "failed"
        told = self._own_words(action)
        self._reporter.say("action_failed", action=action.text, reason=why, **told)
        self._ongoing.action = None
        self._shown.banner = f"could not {self._in_words(action)}: {why}"
        if self._rules.on_failure == "stop":
            raise RunEnded("failed", f"{action.text} failed: {why}")
        if self._failed_in_a_row >= MAX_FAILURES:
            raise RunEnded("gave_up", f"gave up after {MAX_FAILURES} failures in a row: {why}")
        revision = self._mind.decision.revision
        self._world.tick_over(action.step + 1, failed=True)
        self._deliberation.failed(action.step, why)
        self._deliberation.compare()
        self._deliberation.tell(revision, why)
        self._body.hold(0.8)
        self._shown.banner = ""

    # ------------------------------------------------------------ checks

    def _check_order(self) -> None:
        wrong = self._world.disorder()
        if wrong is not None:
            self._reporter.fail(wrong)

    def _party_in(self, action: Action) -> Party:
        if action.name not in ("pick", "seat"):
            return ()
        return self._world.party_of(action.arguments[1]) or ()


def details_of(action: Action, party: Party, room: Room, world: World) -> dict[str, Any]:
    """Returns what the event of a deed tells: whom it was about, and with what."""
    match action.name, action.arguments:
        case "pick", _:
            return {"party": list(party)}
        case "seat", (_, _, table):
            seats, chairs = world.tables[table].seats, room.chairs[table]
            named = {who: chairs[k].name for who, k in seats.items() if k < len(chairs)}
            return {"party": list(party), "table": table, "chairs": named}
        case "bring_chairs", (_, table, number):
            return {"table": table, "number": int(number)}
        case (("take_up" | "bring" | "refill"), (_, item, table)):
            return {"object": item, "table": table}
    return {"table": action.arguments[1]}


def wrong_seats(
    room: Room, world: World, crowd: Crowd, party: Party, table: str
) -> Violation | None:
    """Returns a fault unless everybody of a party sits on a chair of a table that is there, one each."""
    places = room.chairs[table][: world.tables[table].chairs]
    there = {(chair.x, chair.y) for chair in places}
    sitting = crowd.seated_on()
    taken = [sitting.get(name) for name in party]
    if None in taken or len(set(taken)) < len(taken) or not set(taken) <= there:
        return Violation("chairs", f"the party of {party[0]} does not sit on chairs of {table}")
    return None
