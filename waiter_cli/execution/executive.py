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
from dataclasses import replace
from typing import TypeVar

from waiter_cli.errors import Where
from waiter_cli.execution.agenda import (
    Agenda,
    Planner,
    PlannerAnswer,
    Selection,
    Wanted,
    choose,
    still_pending,
    whole_party,
)
from waiter_cli.execution.belief import Belief, is_elsewhere
from waiter_cli.execution.decision import Decision, Diagnoser, Refused
from waiter_cli.execution.protocols import PlannerProtocol, rules_of
from waiter_cli.files.goal_reader import unknown_customer
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Fact, Goal, Observation, State
from waiter_cli.model.wording import goal_text
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.observations import each_party_once, settle
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.rules.validator import run
from waiter_cli.spelling import did_you_mean

__all__ = ["Executive"]

_Kind = TypeVar("_Kind", bound="Executive")

_SEEN = Where("<observed>")  # the place of waiters who are elsewhere than the layout says


def _mend(seen: Sequence[Observation], state: State) -> str:
    """Returns a mend for impossible observations: the known name nearest to an unknown one."""
    inside = [name for party in state.parties() for name in party]
    gone = [o.arguments[0] for o in seen if o.kind == "leave" and o.arguments[0] not in inside]
    near = did_you_mean(gone[0], inside, listed="inside") if gone else None
    kept = "what is believed stays as it was"
    return kept if near is None else f"{near}; {kept}"


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
        explain: Diagnoser | None = None,
        rules: Rulebook = HOUSE,
        plan: bool = True,
        facts: tuple[Fact, ...] = (),
    ) -> None:
        self.belief = Belief(
            layout,
            settle(state, layout),
            instant_kitchen=instant_kitchen,
            rules=rules,
            facts=facts,
        )
        self.prefer = tuple(prefer)
        self.decision = Decision()
        self._planner = planner
        self._impossible = impossible
        self._least = least
        self._explain = explain
        self._agenda = Agenda(tuple(goals or ()), tuple(before), instant_kitchen)
        self._edges = layout.edges  # those of the restaurant, shut ones too
        self._track: tuple[Action, ...] = ()
        self._end = 0  # the step at which the plan's goals hold
        self._announced_end = 0  # as it was when the decision was made
        self.planned: Problem | None = None  # what the plan was made for; None: plan anew
        self.explained: tuple[Diagnosis, ...] = ()  # the last explanations that were needed
        self._diagnosis: tuple[Diagnosis, ...] = ()
        self._closed: tuple[Goal, ...] = ()
        self._notice()
        if plan:
            self.decide()

    @classmethod
    def of_problem(
        cls: type[_Kind], problem: Problem, brain: PlannerProtocol, planner: Planner | None = None
    ) -> _Kind:
        """Returns the executive for a problem, not yet decided; ``planner`` may plan in place of the brain."""
        return cls(
            problem.layout,
            planner or brain.plan,
            state=problem.state,
            goals=None if problem.everybody else problem.goals,
            before=problem.before,
            prefer=problem.prefer,
            instant_kitchen=problem.instant_kitchen,
            impossible=brain.impossible,
            least=brain.least,
            rules=rules_of(brain),
            plan=False,
            facts=problem.facts,
        )

    # ------------------------------------------------------------ what is asked

    @property
    def layout(self) -> Layout:
        """Returns the restaurant; its timetable counts from the start of the run."""
        return self.belief.layout

    @property
    def state(self) -> State:
        """Returns the state believed at the next step, before a running action's effects."""
        return self.belief.state

    @property
    def step(self) -> int:
        """Returns the next step: the smallest number neither done nor failed."""
        return self.belief.step

    @step.setter
    def step(self, step: int) -> None:
        self.belief = replace(self.belief, step=step)

    @property
    def shut(self) -> tuple[tuple[str, str], ...]:
        """Returns the edges of the restaurant that are not planned with."""
        return tuple(edge for edge in self._edges if edge not in self.layout.edges)

    @property
    def running(self) -> Action | None:
        """Returns the action that is running, None when none is known to."""
        return self.belief.running

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Returns the goals that were given and are open; none: serve everybody."""
        return self._agenda.goals

    @property
    def agenda(self) -> Agenda:
        """Returns the goals, their order, and how long each wish has been there."""
        return self._agenda

    # ------------------------------------------------------------ events

    def observe(self, seen: Sequence[Observation], *, plan: bool = True) -> Decision:
        """Believes what was seen, all of it now.

        Raises `Refused` where it contradicts what is believed and nothing explains it.
        """
        belief = self.belief
        layout = belief.layout_at(belief.step)
        before = belief.with_arrival(seen)
        seen = each_party_once(seen, before)
        after, reasons = belief.rules.observe(before, seen, layout)
        diagnosis: tuple[Diagnosis, ...] = ()
        if self._explain is not None and (reasons or is_elsewhere(before, seen)):
            diagnosis = self._explain(layout, before, seen, belief.step, belief.trail)
            if diagnosis:
                after = diagnosis[0].state
        if reasons and not diagnosis:
            message = "; ".join(reason.message for reason in reasons)
            raise Refused(message, _mend(seen, before), reasons)
        inside = {name for party in after.parties() for name in party}
        gone = [name for party in self.state.parties() for name in party if name not in inside]
        self._agenda, closed = self._agenda.without_guests(gone)
        self._closed += closed
        self._diagnosis = diagnosis
        self.explained = diagnosis or self.explained
        self.planned = None
        self.belief = replace(belief, state=after)
        self._notice()
        return self._decided(plan)

    def started(self, step: int, *, plan: bool = True) -> Decision:
        """Notes that the action at ``step`` is running."""
        self._must_be_next(step)
        if self.running is not None:
            raise Refused(f"step {step} is running already", "report it done or failed")
        action = self._action_at(step)
        if action is None:
            raise Refused(f"there is no action at step {step}", "wait, and report the step done")
        self.belief = replace(self.belief, running=action)
        self._diagnosis = ()
        return self._decided(plan)

    def done(self, step: int, *, plan: bool = True) -> Decision:
        """Believes that the action at ``step`` was done, with its effects."""
        self._must_be_next(step)
        self._must_be_planned(step)
        action = self.running or self._action_at(step)
        after = self.belief.after(action)
        if isinstance(after, Illegal):
            hint = "report it failed, or what was observed first"
            raise Refused(f"step {step} cannot be done: {after.reason}", hint)
        self._track = tuple(action for action in self._track if action.step != step)
        self._pass(after)
        return self._decided(plan)

    def failed(self, step: int, reason: str = "", *, plan: bool = True) -> Decision:
        """Believes that the action at ``step`` had no effect; its number is used up.

        A colleague whose timetable has him on the robot's node by then comes a step later.
        ``reason`` is for the record only: what it means for the world has to be observed.
        """
        self._must_be_next(step)
        self._must_be_planned(step)
        # The plan of an abandoned action begins at the step after it already.
        if self.belief.ahead()[2] is None:
            later = (replace(a, step=a.step + 1) if a.step >= step else a for a in self._track)
            self._track = tuple(later)
            self._end += 1
        if self.layout.timetable:
            self.planned = None
        after = self.belief.after_failure()
        self.belief = self.belief.held_up()
        self._pass(after)
        return self._decided(plan)

    def add_goal(self, goal: Goal, *, plan: bool = True) -> Decision:
        """Wants one thing more; only what is wanted so is pursued then."""
        whole = whole_party(goal, self.state)
        if whole is None and goal.kind != "serve":
            inside = [name for party in self.state.parties() for name in party]
            tables = [table.name for table in self.layout.tables]
            raise Refused(*unknown_customer(goal, goal.party[0], inside, tables))
        if whole is not None:
            stranger = next((name for name in goal.party if name not in whole.party), None)
            if stranger is not None:
                raise Refused(f"{goal.party[0]} and {stranger} are not of one party")
            goal = whole
        if self._index(goal) is not None:
            raise Refused(f"{goal_text(goal)} is wanted already")
        if goal.fluent is not None:
            unknown = self.belief.rules.unknown_words(replace(self.belief.world(), goals=(goal,)))
            if unknown:
                raise Refused(unknown[0].message, "what is wanted stays as it was", unknown)
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
        self.belief = replace(self.belief, layout=layout)
        self.planned, self._diagnosis = None, ()
        return self._decided(plan)

    def block(self, edge: tuple[str, str], *, plan: bool = True) -> Decision:
        """Goes on without an edge, named in either direction."""
        known = self._edge(edge)
        if known in self.shut:
            raise Refused(f"the path {known[0]}-{known[1]} is blocked already")
        return self._shut_only((*self.shut, known), plan)

    def clear(self, edge: tuple[str, str], *, plan: bool = True) -> Decision:
        """Goes on with an edge that was blocked."""
        known = self._edge(edge)
        if known not in self.shut:
            raise Refused(f"the path {known[0]}-{known[1]} is not blocked")
        return self._shut_only(tuple(each for each in self.shut if each != known), plan)

    def _edge(self, edge: tuple[str, str]) -> tuple[str, str]:
        """Returns an edge as the layout lists it; raises `Refused` where it has none such."""
        for known in self._edges:
            if set(known) == set(edge):
                return known
        near = [f"{a}-{b}" for a, b in self._edges if a in edge or b in edge]
        hint = f"paths there: {', '.join(near[:8])}" if near else None
        raise Refused(f"there is no path {'-'.join(edge)}", hint)

    def _shut_only(self, shut: tuple[tuple[str, str], ...], plan: bool) -> Decision:
        edges = tuple(edge for edge in self._edges if edge not in shut)
        return self.change_layout(replace(self.layout, edges=edges, edge_where=()), plan=plan)

    # ------------------------------------------------------------ deciding

    def decide(self) -> Decision:
        """Returns the decision for what is believed now.

        Made anew only where something has changed.
        """
        start, base, abandoned = self.belief.ahead()
        wanted = self._agenda.wanted(base, self.layout)
        self._agenda = self._agenda.aged(wanted)

        def pose(some: Wanted) -> Problem:
            return self._pose(some, start, base)

        rest = self.remainder(start)
        if self.planned is not None and rest is not None and abandoned is None:
            kept, pending = still_pending(wanted, self.decision.pending)
            problem = pose(kept)
            if self._leads_there(problem, rest):
                old = self.decision
                known = PlannerAnswer(old.status, rest, old.minimal, old.reasons, old.limit)
                return self._settle(Selection(problem, known, pending), start, rest, None)

        def planner(problem: Problem) -> PlannerAnswer:
            if rest is not None and self._least is not None and self._leads_there(problem, rest):
                if self._least(problem) == rest.horizon:
                    return PlannerAnswer("plan", rest, True, bounds=(rest.horizon, rest.horizon))
            return self._planner(problem)

        choice = choose(wanted, pose, planner, self._impossible)
        plan = choice.answer.plan
        if rest is not None and choice.answer.status != "no_plan":
            no_longer = plan is None or rest.horizon <= plan.horizon
            if no_longer and self._leads_there(choice.problem, rest):
                plan = rest
        return self._settle(choice, start, plan, abandoned)

    def adopt(self, decision: Decision) -> None:
        """Takes over a decision that was made earlier for what is believed now."""
        start, base, _ = self.belief.ahead()
        wanted = self._agenda.wanted(base, self.layout)
        self._agenda = self._agenda.aged(wanted)
        kept, _ = still_pending(wanted, decision.pending)
        self.planned = self._pose(kept, start, base)
        self.decision = decision
        self._track = decision.plan
        self._end = self._announced_end = self.step + decision.horizon
        self._closed = ()

    def resume(self, belief: Belief, agenda: Agenda, decision: Decision) -> None:
        """Takes over the memory of another run."""
        self.belief = belief
        self._agenda = agenda
        self._diagnosis = ()
        self.adopt(decision)

    def live_on(self, past: Agenda) -> None:
        """Takes over at which moments the goals of ``before`` first held, before this run."""
        self._agenda = replace(self._agenda, first_held=past.first_held, moment=past.moment)

    def _pose(self, wanted: Wanted, start: int, base: State) -> Problem:
        """Returns the problem of what is wanted, its steps counted from ``start``,
        where ``base`` holds.
        """
        layout = self.belief.layout_at(start)
        posts = dict(layout.waiters)
        moved = tuple(
            (f"waiters.{who}", _SEEN) for who, node in base.waiters if posts.get(who) != node
        )
        return Problem(
            layout=layout,
            before_observations=base,
            observations=(),
            state=base,
            goals=tuple(dict.fromkeys((*wanted.must, *wanted.wishes))),
            before=wanted.before,
            prefer=self.prefer,
            instant_kitchen=self._agenda.instant_kitchen,
            everybody=wanted.everybody,
            state_where=moved,
            facts=self.belief.facts,
        )

    def _settle(
        self, choice: Selection, start: int, found: Plan | None, abandoned: Action | None
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

    def _pass(self, after: State) -> None:
        """Moves one step on."""
        self.belief = self.belief.passed(after)
        self._diagnosis = ()
        self._notice()

    def _notice(self) -> None:
        """Remembers which goals of ``before`` hold now."""
        if self._agenda.before:
            world, state = self.belief.world(), self.state

            def now(goal: Goal) -> bool:
                whole = whole_party(goal, state)
                return whole is not None and self.belief.rules.holds(whole, state, world)

            self._agenda = self._agenda.noticed(now)

    # ------------------------------------------------------------ the plan

    def _action_at(self, step: int) -> Action | None:
        return next((action for action in self._track if action.step == step), None)

    def remainder(self, start: int) -> Plan | None:
        """Returns the rest of the plan from ``start`` on, its steps from 0; None when it is over."""
        if self._end < start:
            return None
        left = (replace(a, step=a.step - start) for a in self._track if a.step >= start)
        return Plan(tuple(left), self._end - start)

    def outlook(self) -> tuple[Problem, Plan, int] | None:
        """Returns the problem, what is left of its plan, and the step from which both count."""
        if self.planned is None:
            return None
        start = self.step + (self.running is not None)
        left = (replace(a, step=a.step - start) for a in self.decision.plan if a.step >= start)
        end = max(0, self.step + self.decision.horizon - start)
        return self.planned, Plan(tuple(left), end), start

    def _must_be_next(self, step: int) -> None:
        if step != self.step:
            raise Refused(f"step {step} is out of order", f"the next step is {self.step}")

    def _must_be_planned(self, step: int) -> None:
        if self.running is None and self._end <= step:
            raise Refused(f"there is no action at step {step}", "the plan is empty")

    def _index(self, goal: Goal) -> int | None:
        """Returns the index of a goal among those that were given; parties are known by any member."""
        for index, other in enumerate(self.goals):
            if other == goal:
                return index
            if goal.party and set(goal.party) & set(other.party):
                if replace(other, party=goal.party) == goal:
                    return index
        return None

    def _leads_there(self, problem: Problem, plan: Plan) -> bool:
        """Returns whether a plan is possible and reaches the goals at its end and not before."""
        verdict = run(problem, plan, self.belief.rules)
        return verdict.valid and verdict.makespan == plan.horizon
