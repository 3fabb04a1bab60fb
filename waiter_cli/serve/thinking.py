"""What an executive asks of the planner, from the parts of one process. Entry point `Thinker`.

Nothing is started for a search and nothing is loaded twice.  The quick tests come from the bounds,
the plans from the SPARC program, checked by executing them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from waiter_cli.agenda import PlannerAnswer
from waiter_cli.problem import Problem, Reason
from waiter_cli.situation import Goal

if TYPE_CHECKING:
    from waiter_cli.layout import Layout
    from waiter_cli.plan import Plan
    from waiter_cli.search import Domain, Translator
    from waiter_cli.situation import State

__all__ = ["Thinker"]


@dataclass
class Thinker:
    """The planner of one domain; ``time_limit`` is in seconds for each search.

    ``searches`` and ``late`` count the searches, and those that the limit ended.
    """

    translator: Translator
    domain: Domain
    time_limit: float | None = None
    searches: int = 0
    late: int = 0

    def plan(self, problem: Problem) -> PlannerAnswer:
        """The shortest plan, or the best one found in time, or why there is none."""
        from waiter_cli.planning import find_plan
        from waiter_cli.search import SearchOptions

        self.searches += 1
        options = SearchOptions(time_limit=self.time_limit)
        answer = find_plan(problem, self.translator, self.domain, options)
        result = answer.result
        self.late += result.limit == "time"
        found = answer.plan
        if found is None and result.limit is not None:
            found = self.makeshift(problem)
        return PlannerAnswer(
            result.status.value,
            found,
            result.minimal,
            result.reasons,
            result.limit,
            result.bounds,
        )

    def warm_up(self, layout: Layout, state: State) -> None:
        """Loads all that a search needs, by one that costs next to nothing; counts for nothing."""
        from waiter_cli.planning import find_plan
        from waiter_cli.search import SearchOptions

        near = layout.neighbours()[state.agent]
        if near:
            goal = Goal("at", node=near[0])
            problem = Problem(layout, state, (), state, (goal,))
            find_plan(problem, self.translator, self.domain, SearchOptions(time_limit=1.0))

    def makeshift(self, problem: Problem) -> Plan | None:
        """Some legal plan that reaches the goals, put together without a search; None: no idea."""
        if not self.domain.built_in:
            return None
        from waiter_cli.bounds import find_bounds
        from waiter_cli.verify import run

        found = find_bounds(problem).plan
        return found if found is not None and run(problem, found).valid else None

    def impossible(self, problem: Problem) -> tuple[Reason, ...]:
        """Why no plan of any length exists, as far as that can be told without a search."""
        if not self.domain.built_in:
            return ()
        from waiter_cli.bounds.floor import Floor, standing
        from waiter_cli.bounds.impossible import find_reasons
        from waiter_cli.bounds.needs import find_needs

        needs, staff = find_needs(problem), standing(problem)
        return find_reasons(problem, needs, Floor(problem, staff.fixed.values()), staff)

    def least(self, problem: Problem) -> int:
        """A length that no plan falls short of; 0 where nothing is known."""
        if not self.domain.built_in:
            return 0
        from waiter_cli.bounds import find_bounds

        return find_bounds(problem).lower
