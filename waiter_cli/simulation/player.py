"""Plays what is decided in a simulated restaurant, checks it, and says what happened.

Entry point `Player`.  Decide, act, observe, decide again: decisions come from a `Mind`, effects from
a `World` of its own, motion from scripts, clearances from a `Backend`.  Time passes in ticks of a
sixtieth of a second and never looks at a clock, so equal inputs give equal events.

Checks, by name: ``preconditions``, ``effects``, ``edge``, ``arrival``, ``clearance``, ``chairs``,
``shared_node``, ``final_state``, ``goals``.
"""

from __future__ import annotations

from math import hypot
from typing import Any

from waiter_cli.execution.decision import Refused
from waiter_cli.files.documents import goals_document
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Party
from waiter_cli.model.wording import describe
from waiter_cli.room.motion import gesture, write_script
from waiter_cli.simulation.clearance import REACH
from waiter_cli.simulation.driving import Driver
from waiter_cli.simulation.outcome import (
    EVENT_OF,
    RunEnded,
    RunOutcome,
    ShownAction,
    differences,
    pending_document,
    told,
    words,
)
from waiter_cli.simulation.world import RULES, Violation

__all__ = ["Player"]

MAX_FAILURES = 8
ONLY_OURS = "the room knows the restaurant's own actions only; look at the plan with waiter plan"
MAX_STEPS = 20_000
IDLE = 2.0
"""Seconds that an idle step takes."""


class Player(Driver):
    """One run, from `run`."""

    def run(self) -> RunOutcome:
        """Plays until the goals are reached, or nothing more can be done."""
        self._say(
            "start",
            layout=self.problem.layout.name,
            backend=self.backend.name,
            drive=self.rules.drive,
            seed=self.rules.seed,
            speed=self.rules.speed,
            goals=goals_document(self.problem.goals),
            plan=[action.text for action in self.mind.decision.plan],
        )
        for seen in self.problem.observations:
            self._say("observed", at_start=True, **told(seen))
        self._tell(None)
        if (wrong := self.world.disorder()) is not None:
            self._fail(wrong)
        try:
            self._loop()
            status, why, limit = "done", None, None
            self._hold(0.5)
            self._judge()
        except RunEnded as stop:
            status, why, limit = stop.status, stop.why, stop.limit
            self.banner = self.banner or stop.why
            self._hold(1.0, stop=False)
        if self.failures:
            status, why, limit = "failed", why or self.failures[0].reason, None
        pending = tuple(pending_document(wish) for wish in self.mind.decision.pending)
        extra: dict[str, Any] = {"why": why} if why else {}
        if pending:
            extra["pending"] = list(pending)
        measured = self.min_clearance < REACH
        self._say(
            "end", status=status, **extra, failed_checks=len(self.failures),
            min_clearance=round(self.min_clearance, 2) if measured else None,
        )  # fmt: skip
        return RunOutcome(
            status, why, round(self.time, 3), self.mind.step, self._done_actions,
            self._failed_actions, self._replans, self.log.count,
            round(self.min_clearance, 3) if measured else None, self.nearest,
            tuple(self.failures), self.world.state(), pending, self.backend.name, limit,
        )  # fmt: skip

    def _loop(self) -> None:
        while True:
            self._happen()
            if self.mind.step > MAX_STEPS:
                raise RunEnded("gave_up", f"gave up after {MAX_STEPS} steps")
            decision = self.mind.decision
            if decision.plan:
                self._step(decision.plan[0])
            elif decision.horizon > 0:
                self._idle()
            elif not self._wait_for_news():
                self._conclude()
                return

    def _conclude(self) -> None:
        decision = self.mind.decision
        if decision.status == "undecided":
            if self._unmet():
                most = self.rules.max_steps
                steps = "--max-steps" if most is None else f"--max-steps {most}"
                limit = {"time": "the time limit", "max_steps": steps}
                within = limit.get(decision.limit or "", "the memory there is")
                why = f"gave up: no plan was found within {within}"
                raise RunEnded("gave_up", why, decision.limit)
            return  # a plan that is not known to be minimal has served, too
        if decision.status == "no_plan" or decision.pending:
            told = [r.message for r in decision.reasons]
            told += [r.message for wish in decision.pending for r in wish.reasons]
            why = "; ".join(dict.fromkeys(told)) or "no plan exists"
            raise RunEnded("gave_up", f"gave up: {why}")

    def _step(self, action: Action) -> None:
        if action.step > self.mind.step:
            self._idle()
            return
        home = self.world.robot
        self._action, self._abandoned = action, False
        self.deeds.append(ShownAction(action.step, action.text, "now"))
        self._say("action_start", action=action.text)
        wrong = self.world.breach(action)
        if wrong is not None:
            self._say(
                "precondition_failed", action=action.text, check=wrong.check, reason=wrong.reason
            )
            self._fail(wrong)
            if action.name not in RULES:  # of a domain of one's own: it would fail every time
                self.deeds[-1].state = "failed"
                self._failed_actions += 1
                raise RunEnded("failed", f"{action.text} cannot be played: {ONLY_OURS}")
            self._failed(action, wrong.reason)
            return
        self.mind.started(action.step)
        self._due_staff()
        if self._slip and self._rng.random() < self._slip:
            self._slipped(action)
            return
        why = self._drive(action) if action.name == "go_to" else self._deed(action)
        if why is None:
            wrong = self.world.breach(action)
            why = wrong.reason if wrong is not None else None
        if why is not None:
            if action.name == "go_to":
                self._back_to((home,))
            self._failed(action, why)
            return
        self._succeeded(action)

    def _succeeded(self, action: Action) -> None:
        step = action.step
        chairs = self.room.chairs
        party = self._party_in(action)
        self.world.perform(action)
        details: dict[str, Any] = {}
        match action.name, action.arguments:
            case "go_to", (_, node):
                at = self.room.nodes[node]
                error = hypot(self.pose[0] - at[0], self.pose[1] - at[1])
                allowed = 0.02 if self.rules.drive == "kinematic" else 0.10
                details = {"node": node, "error_m": round(error, 3)}
                if error > allowed:
                    self._fail(Violation("arrival", f"{error:.3f} m beside {node} at arrival"))
            case "pick", _:
                self.crowd.follow(party, self.pose)
                details = {"party": list(party)}
            case "seat", (_, _, table):
                seats = self.world.tables[table].seats
                named = {
                    who: chairs[table][k].name for who, k in seats.items() if k < len(chairs[table])
                }
                details = {"party": list(party), "table": table, "chairs": named}
                self._check_seats(party, table)
            case "bring_chairs", (_, table, number):
                details = {"table": table, "number": int(number)}
            case (("take_up" | "bring" | "refill"), (_, item, table)):
                details = {"object": item, "table": table}
            case _, (_, table):
                details = {"table": table}
        self.world.tick_over(step + 1)
        self._say(EVENT_OF[action.name], **details)
        wrong = self.world.disorder()
        if wrong is not None:
            self._fail(wrong)
        revision = self.mind.decision.revision
        try:
            self.mind.done(step)
        except Refused as refusal:
            self._fail(Violation("effects", f"what was done is not believed: {refusal.message}"))
            raise RunEnded("failed", refusal.message) from None
        self._compare()
        self._say("action_end", action=action.text)
        self.deeds[-1].state = "done"
        self._action, self._failed_in_a_row = None, 0
        self._done_actions += 1
        self._tell(revision, "the plan goes on otherwise")

    def _failed(self, action: Action, why: str) -> None:
        self._failed_actions += 1
        self._failed_in_a_row += 1
        self._disturbed = True
        self.deeds[-1].state = "failed"
        self._say("action_failed", action=action.text, reason=why)
        self._action = None
        self.banner = f"could not {describe(action, self.mind.state)}: {why}"
        if self.rules.on_failure == "stop":
            raise RunEnded("failed", f"{action.text} failed: {why}")
        if self._failed_in_a_row >= MAX_FAILURES:
            raise RunEnded("gave_up", f"gave up after {MAX_FAILURES} failures in a row: {why}")
        revision = self.mind.decision.revision
        self.world.tick_over(action.step + 1, failed=True)
        self.mind.failed(action.step, why)
        if self._shut is not None:
            self._plan_without(self._shut)
            self._shut = None
        self._compare()
        self._tell(revision, why)
        self._hold(0.8)
        self.banner = ""

    def _idle(self) -> None:
        """Nothing is done for a step; colleagues go where their timetable has them."""
        step, revision = self.mind.step, self.mind.decision.revision
        self._due_staff()
        self._hold(IDLE)
        if self.mind.decision.revision != revision:
            # News came in between: there may be something to do at this very step.
            return
        self.world.tick_over(step + 1)
        if (wrong := self.world.disorder()) is not None:
            self._fail(wrong)
        self.mind.done(step)
        self._compare()
        self._tell(revision, "the plan goes on otherwise")

    def _due_staff(self) -> None:
        """Colleagues who are due elsewhere at the next step set out."""
        for who, node in self.world.expected(self.mind.step + 1).items():
            self._walk_staff(who, node, seconds=IDLE)

    def _deed(self, action: Action) -> str | None:
        """Plays a gesture; why it came to nothing, None when it did not."""
        moves = write_script(action, self.pose, self.room, self.rules.speed)
        for move in moves:
            if move.kind == "gesture":
                self.saying = words(action)
                if action.name == "seat":
                    table = self.room.chairs[action.arguments[2]]
                    seconds = self.crowd.sit(self.world.led, table)
                    move = gesture(self.pose, max(move.seconds, seconds + 0.4))
            ended = self._move(move)
            if ended is not None:
                self.saying = ""
                if action.name == "seat":  # whoever is still here follows on
                    self._follow_again()
                return ended if isinstance(ended, str) else "the way is blocked"
        self.saying = ""
        return None

    def _follow_again(self) -> None:
        inside = [name for name in self.world.led if name in self.crowd.people]
        self.crowd.follow(inside, self.pose)

    def _slipped(self, action: Action) -> None:
        """The action has no effect: wheels spin, or the deed is done in vain."""
        self._say("injected", kind="slip", action=action.text)
        self.banner = f"slipped: to {describe(action, self.mind.state)} had no effect"
        self._move(gesture(self.pose, 1.0))
        self._failed(action, "slipped, without effect")

    def _check_seats(self, party: Party, table: str) -> None:
        """Everybody of a party really sits, on chairs of that table that are there, one each."""
        places = self.room.chairs[table][: self.world.tables[table].chairs]
        there = {(chair.x, chair.y) for chair in places}
        sitting = self.crowd.seated_on()
        taken = [sitting.get(name) for name in party]
        if None in taken or len(set(taken)) < len(taken) or not set(taken) <= there:
            self._fail(
                Violation("chairs", f"the party of {party[0]} does not sit on chairs of {table}")
            )

    def _party_in(self, action: Action) -> Party:
        if action.name not in ("pick", "seat"):
            return ()
        return self.world.party_of(action.arguments[1]) or ()

    def _judge(self) -> None:
        """At the end: the goals hold, and the world is as a plan made before has it."""
        words = "is still wanted" if self.problem.everybody else "does not hold"
        for goal in self._unmet():
            self._fail(Violation("goals", f"the goal {goal.as_dict()} {words} at the end"))
        if self.predicted is not None and not self._disturbed:
            different = differences(self.world.state(), self.predicted)
            if different:
                self._fail(
                    Violation("final_state", f"the plan's final state is another: {different}")
                )

    def _unmet(self) -> list[Goal]:
        """The goals that do not hold now; those of a party that left unexpectedly do not count."""
        met, party_of = self.world.met, self.world.party_of
        if self.problem.everybody:
            from waiter_cli.problems.everybody import serve_everybody

            kitchen = self.problem.instant_kitchen
            wanted = serve_everybody(self.world.state(), self.problem.layout, kitchen, {})
            return [goal for goal in wanted if not met(goal)]
        closed = self.mind.decision.closed
        return [
            goal
            for goal in self.problem.goals
            if goal not in closed
            and not (goal.party and party_of(goal.party[0]) is None and self._disturbed)
            and not met(goal)
        ]
