"""The answer to a planning problem: a plan, or why there is none."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.encoding.domains import Domain
from waiter_cli.errors import Exit
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import State
from waiter_cli.planning.search_results import SearchResult, SearchStatus

if TYPE_CHECKING:
    from waiter_cli.model.diagnosis import Diagnosis

__all__ = ["PlanAnswer"]


@dataclass(frozen=True)
class PlanAnswer:
    """The result of a search, and the states that its plan passes through (one a step).

    ``start`` is the state at step 0 where a domain of the user's own makes more of what was seen than
    the problem's has.  ``diagnosis`` says how what was observed can have come about, where it is a surprise.
    """

    problem: Problem
    result: SearchResult
    translator: str
    domain: Domain
    states: tuple[State, ...] = ()
    validated: bool = True
    refusal: tuple[str, ...] = ()
    diagnosis: tuple[Diagnosis, ...] = ()
    start: State | None = None

    @property
    def plan(self) -> Plan | None:
        """The plan, when there is one."""
        return self.result.plan

    @property
    def exit_code(self) -> int:
        """Returns 0 for a plan, 3 where none exists or the observations cannot be, 4 undecided."""
        match self.result.status:
            case SearchStatus.PLAN:
                return Exit.OK
            case SearchStatus.UNDECIDED:
                return Exit.UNDECIDED
        return Exit.PROVED

    def __str__(self) -> str:
        """The actions, a line each; where there is no plan, how the search ended."""
        return str(self.plan) if self.plan is not None else self.result.status.value

    def _repr_html_(self) -> str:
        """Returns what a notebook shows: the plan as a list."""
        if self.plan is None:
            return f"<p>{self.result.status.value}</p>"
        return self.plan._repr_html_()

    def _repr_svg_(self) -> str | None:
        """Returns the plan drawn into its restaurant; None where there is no plan or no place to draw."""
        from waiter_cli.domain_execution.domain_rules import rules_for
        from waiter_cli.drawing.picture import draw_svg
        from waiter_cli.drawing.subject import make_subject
        from waiter_cli.errors import InputError

        if self.plan is None:
            return None
        start = self.problem.state
        try:
            rules = rules_for(self.problem, self.domain)
            played = (self.problem, self.plan)
            return draw_svg(
                make_subject(self.problem.layout, start, played, rules=rules, domain=self.domain)
            )
        except InputError:
            return None

    def steps(self) -> Iterator[tuple[Action, str, str]]:
        """Yields each action with its meaning and the node where it begins."""
        from waiter_cli.encoding.declarations import words_for

        assert self.plan is not None
        for action in self.plan.actions:
            if self.states:
                state = self.states[action.step]
                place = state.stations().get("".join(action.arguments[:1]), state.agent)
                yield action, words_for(self.domain, action, state), place
            else:
                yield action, "", ""

    def headline(self) -> str:
        """Returns a sentence for an answer without a plan."""
        lower = self.result.bounds[0]
        match self.result.status:
            case SearchStatus.NO_PLAN:
                return "No plan of any length exists."
            case SearchStatus.CONTRADICTION:
                return "What was observed contradicts what is known."
        match self.result.limit:
            case "time":
                why = "the time limit came first"
            case "memory":
                why = "the memory ran out"
            case _:
                why = f"no plan found within --max-steps {self.result.max_steps}"
                if not self.domain.built_in:
                    why += ", and no proof that none exists"
        found = f"Undecided: {why}; if there is a plan, it has at least {lower} steps."
        return f"{found}{self._lack()}"

    def _lack(self) -> str:
        """Returns which package would have helped, with a space before it; empty where none would."""
        lacking = self.result.lacking
        if not lacking:
            return ""
        return f" Better bounds take the package {lacking}: pip install {lacking}."

    def reason_lines(self) -> list[str]:
        """Returns the reasons, one line each, with its place."""
        return [f"{r.where}: {r.message}" if r.where else r.message for r in self.result.reasons]

    def proof_line(self) -> str:
        """Returns a sentence on why the plan is minimal."""
        result = self.result
        assert self.plan is not None
        tried = ", ".join(f"{p.horizon} {p.result}" for p in result.probes)
        tail = f" (horizons tried: {tried})" if tried else ""
        horizon = self.plan.horizon
        if not result.minimal:
            lower, upper = result.bounds
            limit = (
                f"--max-steps {result.max_steps}" if result.limit == "max_steps" else result.limit
            )
            sentence = f"Not proved minimal: the limit ({limit}) came first; {lower} to {upper} steps{tail}."
            return f"{sentence}{self._lack()}"
        if horizon == 0:
            return f"Minimal{tail}."
        if result.proof == "unsat":
            return f"Minimal: solving proved that {horizon - 1} are too few{tail}."
        return f"Minimal: a lower bound proves that {horizon - 1} are too few{tail}."

    def ties_line(self) -> str:
        """Returns a sentence where another plan as short may suit the preferences better, else an empty one."""
        if self.result.ties in (None, "proved"):
            return ""
        if self.problem.layout.agents:
            return "Whether as many steps take fewer actions was left open."
        wish = "the preferences" if self.problem.prefer else "its guests with smaller tables"
        spent = self.result.ties == "budget"
        why = (
            "choosing among them has a budget, which was spent" if spent else "the limit came first"
        )
        return f"Whether another plan as short suits {wish} better was left open: {why}."

    @property
    def fewest_actions(self) -> str:
        """Returns whether several robots do as little as can be in so many steps.

        ``proved``, ``best found`` (choosing ended first) or ``off`` (it was not looked for).
        """
        if self.plan is not None and not self.plan.actions:
            return "proved"
        known = {"proved": "proved", "budget": "best found", "limit": "best found"}
        return known.get(self.result.ties or "", "off")

    def _start(self) -> State:
        """The state at step 0; by a domain of one's own with what it makes of what was observed."""
        return self.problem.state if self.start is None else self.start

    def document(self) -> dict[str, Any]:
        """Returns the document of ``waiter plan --json``."""
        from waiter_cli.files.documents import (
            action_document,
            explanation_document,
            goals_document,
            message_document,
            order_document,
            state_document,
        )
        from waiter_cli.files.plan_origin import remember

        result, problem = self.result, self.problem
        document: dict[str, Any] = {
            "status": result.status.value,
            "layout": problem.layout.name,
        }
        origin = problem.layout.origin
        if self.plan is not None and origin is not None:
            document["layout_file"] = remember(origin.text, origin.path)
        document |= {
            "bounds": list(result.bounds),
            "initial_state": state_document(self._start(), problem.layout),
            "goals": goals_document(problem.goals),
            "before": order_document(problem.before),
        }
        if problem.instant_kitchen:
            document["instant_kitchen"] = True
        if problem.facts:
            document["facts"] = [fact.text for fact in problem.facts]
        if self.plan is not None:
            document["horizon"] = self.plan.horizon
            document["minimal"] = result.minimal
            document["actions"] = list(map(action_document, self.plan.actions))
            if problem.layout.agents:
                document["agents"] = [name for name, _ in problem.layout.agents]
            if self.states:
                document["final_state"] = state_document(self.states[-1], problem.layout)
        if result.status in (SearchStatus.NO_PLAN, SearchStatus.CONTRADICTION):
            document["reasons"] = [message_document(r.message, r.where) for r in result.reasons]
        if self.diagnosis:
            document["diagnosis"] = [explanation_document(each) for each in self.diagnosis]
        if result.status is SearchStatus.UNDECIDED:
            document["limit"] = result.limit
            document.setdefault("minimal", False)
            document.setdefault("actions", [])
        document["search"] = self._search_document()
        document["translator"] = self.translator
        document["domain"] = self.domain.name
        if self.plan is not None:
            template = self.domain.template
            document["domain_file"] = remember(template.text, self.domain.path)
        by_domain = self.validated and self.plan is not None and not self.domain.built_in
        document["validated"] = "domain" if by_domain else self.validated and self.plan is not None
        return document

    def _search_document(self) -> dict[str, Any]:
        """Returns what the document says of the search: its horizons, and what it proved."""
        result = self.result
        search: dict[str, Any] = {
            "strategy": result.strategy,
            "horizons": [
                {"horizon": p.horizon, "result": p.result, "seconds": p.seconds}
                for p in result.probes
            ],
            "seconds": round(result.seconds, 6),
        }
        if result.proof is not None:
            search["proof"] = result.proof
        if result.ties not in (None, "proved"):
            search["ties"] = result.ties
        if self.problem.layout.agents and self.plan is not None:
            search["fewest_actions"] = self.fewest_actions
        return search
