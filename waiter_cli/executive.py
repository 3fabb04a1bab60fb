"""Observe, decide, act, again: events in, decisions out, without processes or clocks.

Entry point `Executive`.  It keeps what is believed at the next step, takes observations and
reports of what was done at any moment, and plans anew from the state at the next step; the effects
of an action that is running come first.  A plan that still leads to the goals and is still minimal
is kept.  ``waiter serve`` and ``waiter simulate`` drive the same one.

Steps count on through a whole run: the next step is the smallest number neither done nor failed.
What cannot be is `Refused`, and then nothing has changed.  All that an executive holds are
immutable values, so ``copy.copy`` makes an independent one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from waiter_cli.agenda import (
    Agenda,
    Choice,
    Pending,
    Planner,
    PlannerAnswer,
    Wanted,
    choose,
    whole_party,
)
from waiter_cli.layout import Layout
from waiter_cli.observing import observe, settle
from waiter_cli.plan import Action, Plan
from waiter_cli.problem import Problem, Reason
from waiter_cli.rules import Illegal, apply, holds, idle
from waiter_cli.situation import Goal, Observation, State, Where
from waiter_cli.verify import goal_text, run

__all__ = ["Decision", "Executive", "Explainer", "Explanation", "PlannerAnswer", "Refused"]

_SEEN = Where("<observed>")  # the place of waiters who are elsewhere than the layout says
TRAIL = 64  # so many of the agent's last places are kept for diagnosis


class Refused(Exception):
    """An event that cannot be; nothing has changed.  ``hint`` is the mend."""

    def __init__(self, message: str, hint: str | None = None, reasons: Sequence[Reason] = ()):
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.reasons = tuple(reasons)


@dataclass(frozen=True, slots=True)
class Explanation:
    """Events that nobody reported and that explain what was seen, best first by ``cost``.

    ``events`` are triples (step, name, arguments), by step; ``text`` says them in words, one each.
    ``state`` is what is to be believed then.
    """

    events: tuple[tuple[int, str, tuple[str, ...]], ...]
    text: tuple[str, ...]
    cost: int
    state: State


class Explainer(Protocol):
    """Finds out how observations can have come about; no explanation: an empty tuple.

    ``step`` is the step of ``state``; ``trail`` has the agent's places at earlier steps.
    """

    def __call__(
        self,
        layout: Layout,
        state: State,
        seen: Sequence[Observation],
        step: int,
        trail: Sequence[tuple[int, str]],
    ) -> tuple[Explanation, ...]: ...


@dataclass(frozen=True, slots=True)
class Decision:
    """What is to be done now.

    ``plan`` holds the remaining actions, a running one first, numbered through the whole run;
    ``horizon`` is the number of steps that remain, idle ones included.  ``status`` is ``plan``,
    ``no_plan`` or ``undecided``.  ``revision`` has grown whenever the plan changed, other than by
    steps being done.  ``pending`` wishes must wait; ``closed`` goals ended with their party;
    ``diagnosis`` lists explanations of what was seen last, the first of which is believed;
    ``abandoned`` is the running action that became impossible.
    """

    revision: int = 0
    plan: tuple[Action, ...] = ()
    horizon: int = 0
    minimal: bool = True
    status: str = "plan"
    reasons: tuple[Reason, ...] = ()
    limit: str | None = None
    pending: tuple[Pending, ...] = ()
    diagnosis: tuple[Explanation, ...] = ()
    closed: tuple[Goal, ...] = ()
    abandoned: Action | None = None


def _nothing_impossible(problem: Problem) -> tuple[Reason, ...]:
    return ()


class Executive:
    """The believed state of one run, what is wanted in it, and the plan.

    ``planner`` answers problems whose steps count from 0.  ``impossible`` is a quick test for
    problems without any plan, ``least`` a quick lower bound of a plan's length; both may be left
    out.  ``explain`` is asked where observations contradict what is believed, and where somebody
    is seen elsewhere; without it, contradictions are refused.  ``goals`` None or empty: serve everybody.
    The first decision is made at once, unless ``plan`` is false.
    """

    def __init__(
        self,
        layout: Layout,
        planner: Planner,
        *,
        state: State,
        goals: Sequence[Goal] | None = None,
        before: Sequence[tuple[Goal, Goal]] = (),
        prefer: Sequence[str] = (),
        instant_kitchen: bool = False,
        impossible: Callable[[Problem], tuple[Reason, ...]] = _nothing_impossible,
        least: Callable[[Problem], int] | None = None,
        explain: Explainer | None = None,
        plan: bool = True,
    ) -> None:
        self.layout = layout
        self.prefer = tuple(prefer)
        self.step = 0
        self.state = settle(state, layout)
        self.running: Action | None = None
        self.trail: tuple[tuple[int, str], ...] = ()
        self.decision = Decision()
        self._planner = planner
        self._impossible = impossible
        self._least = least
        self._explain = explain
        self._agenda = Agenda(tuple(goals or ()), tuple(before), instant_kitchen)
        self._track: tuple[Action, ...] = ()
        self._end = 0  # the step at which the plan's goals hold
        self._announced_end = 0  # as it was when the decision was made
        self.planned: Problem | None = None  # what the plan was made for; None: plan anew
        self.explained: tuple[Explanation, ...] = ()  # the last explanations that were needed
        self._diagnosis: tuple[Explanation, ...] = ()
        self._closed: tuple[Goal, ...] = ()
        self._notice()
        if plan:
            self.decide()

    # ------------------------------------------------------------ what is asked

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The goals that were given and are open; none: serve everybody."""
        return self._agenda.goals

    @property
    def agenda(self) -> Agenda:
        """The goals, their order, and how long each wish has been there."""
        return self._agenda

    # ------------------------------------------------------------ events

    def observe(self, seen: Sequence[Observation], *, plan: bool = True) -> Decision:
        """Believes what was seen, all of it now.

        Raises `Refused` where it contradicts what is believed and nothing explains it.
        """
        layout = self._layout_at(self.step)
        seen = _each_party_once(seen, self.state)
        after, reasons = observe(self.state, seen, layout)
        found: tuple[Explanation, ...] = ()
        if self._explain is not None and (reasons or self._seen_elsewhere(seen)):
            found = self._explain(layout, self.state, seen, self.step, self.trail)
            if found:
                after = found[0].state
        if reasons and not found:
            message = "; ".join(reason.message for reason in reasons)
            raise Refused(message, "what is believed stays as it was", reasons)
        inside = {name for party in after.parties() for name in party}
        gone = [name for party in self.state.parties() for name in party if name not in inside]
        self._agenda, closed = self._agenda.without_guests(gone)
        self._closed += closed
        self._diagnosis = found
        self.explained = found or self.explained
        self.planned = None
        self._become(after)
        return self._decided(plan)

    def started(self, step: int, *, plan: bool = True) -> Decision:
        """Notes that the action at ``step`` is running."""
        self._must_be_next(step)
        if self.running is not None:
            raise Refused(f"step {step} is running already", "report it done or failed")
        self.running = self._action_at(step)
        if self.running is None:
            raise Refused(f"there is no action at step {step}", "wait, and report the step done")
        self._diagnosis = ()
        return self._decided(plan)

    def done(self, step: int, *, plan: bool = True) -> Decision:
        """Believes that the action at ``step`` was done, with its effects."""
        self._must_be_next(step)
        self._must_be_planned(step)
        action = self.running or self._action_at(step)
        after = self._after(self.state, action, step)
        if isinstance(after, Illegal):
            hint = "report it failed, or what was observed first"
            raise Refused(f"step {step} cannot be done: {after.reason}", hint)
        self._track = tuple(action for action in self._track if action.step != step)
        self._pass(after)
        return self._decided(plan)

    def failed(self, step: int, reason: str = "", *, plan: bool = True) -> Decision:
        """Believes that the action at ``step`` had no effect; its number is used up.

        ``reason`` is for the record only: what it means for the world has to be observed.
        """
        self._must_be_next(step)
        self._must_be_planned(step)
        # The plan of an abandoned action begins at the step after it already.
        if self._ahead()[2] is None:
            later = (replace(a, step=a.step + 1) if a.step >= step else a for a in self._track)
            self._track = tuple(later)
            self._end += 1
        after = self._after(self.state, None, step)
        if isinstance(after, Illegal):  # whoever was due on the agent's node cannot have come
            after = self.state
        if self.layout.timetable:
            self.planned = None
        self._pass(after)
        return self._decided(plan)

    def add_goal(self, goal: Goal, *, plan: bool = True) -> Decision:
        """Wants one thing more; only what is wanted so is pursued then."""
        whole = whole_party(goal, self.state)
        if whole is None and goal.kind != "serve":
            raise Refused(f"unknown customer {goal.party[0]}", "nobody inside is called that")
        if whole is not None:
            stranger = next((name for name in goal.party if name not in whole.party), None)
            if stranger is not None:
                raise Refused(f"{goal.party[0]} and {stranger} are not of one party")
            goal = whole
        if self._index(goal) is not None:
            raise Refused(f"{goal_text(goal)} is wanted already")
        self._agenda = replace(self._agenda, goals=(*self._agenda.goals, goal))
        self.planned, self._diagnosis = None, ()
        return self._decided(plan)

    def drop_goal(self, goal: Goal, *, plan: bool = True) -> Decision:
        """Wants one thing no longer; without any goal left, everybody is served."""
        index = self._index(goal)
        if index is None:
            known = "; ".join(map(goal_text, self.goals)) or "none: everybody is served"
            raise Refused(f"{goal_text(goal)} is no goal", f"goals are {known}")
        goals = self._agenda.goals
        self._agenda = replace(self._agenda, goals=(*goals[:index], *goals[index + 1 :]))
        self.planned, self._diagnosis = None, ()
        return self._decided(plan)

    def change_layout(self, layout: Layout, *, plan: bool = True) -> Decision:
        """Goes on in a restaurant with other edges, such as one whose door is shut."""
        self.layout = layout
        self.planned, self._diagnosis = None, ()
        return self._decided(plan)

    # ------------------------------------------------------------ deciding

    def decide(self) -> Decision:
        """The decision for what is believed now; made anew only where something has changed."""
        start, base, abandoned = self._ahead()
        layout = self._layout_at(start)
        wanted = self._agenda.wanted(base, layout)
        self._agenda = self._agenda.aged(wanted)

        posts = dict(layout.waiters)
        moved = tuple(
            (f"waiters.{who}", _SEEN) for who, node in base.waiters if posts.get(who) != node
        )

        def pose(some: Wanted) -> Problem:
            goals = tuple(dict.fromkeys((*some.must, *some.wishes)))
            kitchen = self._agenda.instant_kitchen
            return Problem(
                layout, base, (), base, goals, some.before, self.prefer, kitchen, some.everybody,
                state_where=moved,
            )  # fmt: skip

        rest = self.remainder(start)
        if self.planned is not None and rest is not None and abandoned is None:
            kept, pending = _still_pending(wanted, self.decision.pending)
            problem = pose(kept)
            if _leads_there(problem, rest):
                old = self.decision
                known = PlannerAnswer(old.status, rest, old.minimal, old.reasons, old.limit)
                return self._settle(Choice(problem, known, pending), start, rest, None)

        def planner(problem: Problem) -> PlannerAnswer:
            if rest is not None and self._least is not None and _leads_there(problem, rest):
                if self._least(problem) == rest.horizon:
                    return PlannerAnswer("plan", rest, True, bounds=(rest.horizon, rest.horizon))
            return self._planner(problem)

        choice = choose(wanted, pose, planner, self._impossible)
        found = choice.answer.plan
        if rest is not None and choice.answer.status != "no_plan":
            no_longer = found is None or rest.horizon <= found.horizon
            if no_longer and _leads_there(choice.problem, rest):
                found = rest
        return self._settle(choice, start, found, abandoned)

    def adopt(self, decision: Decision) -> None:
        """Takes over a decision that was made earlier for what is believed now."""
        start, base, _ = self._ahead()
        layout = self._layout_at(start)
        wanted = self._agenda.wanted(base, layout)
        self._agenda = self._agenda.aged(wanted)
        kept, _ = _still_pending(wanted, decision.pending)
        goals = tuple(dict.fromkeys((*kept.must, *kept.wishes)))
        kitchen = self._agenda.instant_kitchen
        self.planned = Problem(
            layout, base, (), base, goals, kept.before, self.prefer, kitchen, kept.everybody
        )
        self.decision = decision
        self._track = decision.plan
        self._end = self._announced_end = self.step + decision.horizon
        self._closed = ()

    def resume(self, agenda: Agenda, decision: Decision) -> None:
        """Takes over the memory of another run; ``step``, ``state`` and the like are set already."""
        self._agenda = agenda
        self._diagnosis = ()
        self.adopt(decision)

    def _settle(
        self, choice: Choice, start: int, found: Plan | None, abandoned: Action | None
    ) -> Decision:
        """Makes the choice the decision of this moment."""
        answer = choice.answer
        status, reasons = answer.status, answer.reasons
        if not (choice.problem.goals or choice.problem.before) and choice.pending:
            # All that is wanted must wait: there is a plan for nothing only.
            reasons = tuple(dict.fromkeys(r for p in choice.pending for r in p.reasons))
            status = "no_plan"
        track: tuple[Action, ...] = (
            (self.running,) if self.running is not None and abandoned is None else ()
        )
        end = start
        if found is not None:
            track += tuple(replace(action, step=action.step + start) for action in found.actions)
            end = start + found.horizon
        told = tuple(action for action in self.decision.plan if action.step >= self.step)
        changed = (track, end) != (told, max(self._announced_end, start))
        self._track, self._end, self._announced_end = track, end, end
        self.planned = choice.problem
        self.decision = Decision(
            self.decision.revision + changed,
            track,
            end - self.step,
            answer.minimal and status == "plan",
            status,
            reasons,
            answer.limit,
            choice.pending,
            self._diagnosis,
            self._closed,
            abandoned,
        )
        self._closed = ()
        return self.decision

    def _decided(self, plan: bool) -> Decision:
        return self.decide() if plan else self.decision

    # ------------------------------------------------------------ what is believed

    def _ahead(self) -> tuple[int, State, Action | None]:
        """The step from which to plan, the state there, and a running action that cannot end."""
        if self.running is None:
            return self.step, self.state, None
        after = self._after(self.state, self.running, self.step)
        if not isinstance(after, Illegal):
            return self.step + 1, after, None
        waited = self._after(self.state, None, self.step)
        return self.step + 1, self.state if isinstance(waited, Illegal) else waited, self.running

    def _after(self, state: State, action: Action | None, step: int) -> State | Illegal:
        """The state one step later, or why there is none."""
        problem = self._world(state, step)
        try:
            if action is None:
                return idle(problem, state, 0)
            if action.name == "go_to" and action.arguments[1] == state.agent:
                return idle(problem, state, 0)  # it was seen to have arrived already
            return apply(problem, state, action, 0)
        except Illegal as fault:
            return fault

    def _world(self, state: State, step: int) -> Problem:
        """A problem without goals, for the rules: ``state`` at ``step``."""
        kitchen = self._agenda.instant_kitchen
        return Problem(self._layout_at(step), state, (), state, (), instant_kitchen=kitchen)

    def _layout_at(self, step: int) -> Layout:
        """The layout whose timetable counts from ``step``."""
        table = self.layout.timetable
        if not table or step == 0:
            return self.layout
        later = tuple((who, at - step, node) for who, at, node in table if at > step)
        return replace(self.layout, timetable=later)

    def _pass(self, after: State) -> None:
        """One step later."""
        self.trail = (*self.trail, (self.step, self.state.agent))[-TRAIL:]
        self.step += 1
        self.running = None
        self._diagnosis = ()
        self._become(after)

    def _become(self, after: State) -> None:
        self.state = after
        self._notice()

    def _notice(self) -> None:
        if self._agenda.before:
            problem = self._world(self.state, self.step)

            def now(goal: Goal) -> bool:
                whole = whole_party(goal, self.state)
                return whole is not None and holds(whole, self.state, problem)

            self._agenda = self._agenda.noticed(self.state, now)

    def _seen_elsewhere(self, seen: Sequence[Observation]) -> bool:
        places = {"agent": self.state.agent, **dict(self.state.waiters)}
        told = [o.arguments for o in seen if o.kind == "at"]
        return any(places.get(who) not in (None, node) for who, node in told)

    # ------------------------------------------------------------ the plan

    def _action_at(self, step: int) -> Action | None:
        return next((action for action in self._track if action.step == step), None)

    def remainder(self, start: int) -> Plan | None:
        """What is left of the plan from ``start`` on, its steps from 0; None when it is over."""
        if self._end < start:
            return None
        left = (replace(a, step=a.step - start) for a in self._track if a.step >= start)
        return Plan(tuple(left), self._end - start)

    def _must_be_next(self, step: int) -> None:
        if step != self.step:
            raise Refused(f"step {step} is out of order", f"the next step is {self.step}")

    def _must_be_planned(self, step: int) -> None:
        if self.running is None and self._end <= step:
            raise Refused(f"there is no action at step {step}", "the plan is empty")

    def _index(self, goal: Goal) -> int | None:
        """Where a goal stands among those that were given; parties are known by any member."""
        for index, other in enumerate(self.goals):
            if other == goal:
                return index
            if goal.party and set(goal.party) & set(other.party):
                if replace(other, party=goal.party) == goal:
                    return index
        return None


def _each_party_once(seen: Sequence[Observation], state: State) -> tuple[Observation, ...]:
    """The observations without a party's leaving being told again for its other members."""
    kept: list[Observation] = []
    gone: set[str] = set()
    for each in seen:
        if each.kind == "enter":
            gone.difference_update(each.arguments)
        elif each.kind == "leave":
            if each.arguments[0] in gone:
                continue
            party = state.party_of(each.arguments[0])
            gone.update(name for name in party or () if name != each.arguments[0])
        kept.append(each)
    return tuple(kept)


def _still_pending(
    wanted: Wanted, pending: Sequence[Pending]
) -> tuple[Wanted, tuple[Pending, ...]]:
    """What is wanted less what had to wait already, and that."""
    waiting = [p for p in pending if p.then is None and p.goal in wanted.wishes]
    waiting += [p for p in pending if p.then is not None and (p.goal, p.then) in wanted.before]
    goals = {p.goal for p in waiting if p.then is None}
    pairs = {(p.goal, p.then) for p in waiting if p.then is not None}
    kept = replace(
        wanted,
        wishes=tuple(goal for goal in wanted.wishes if goal not in goals),
        before=tuple(pair for pair in wanted.before if pair not in pairs),
    )
    return kept, (*wanted.waiting, *waiting)


def _leads_there(problem: Problem, plan: Plan) -> bool:
    """Whether a plan is possible and reaches the goals at its end and not before."""
    verdict = run(problem, plan)
    return verdict.valid and verdict.makespan == plan.horizon
