"""The least that any plan takes, and a plan near it: `Needs`, `Floor` → both.

Entry point `Estimate.find`.
"""

from __future__ import annotations

from waiter_cli.bounds.construct import Builder, nodes_of
from waiter_cli.bounds.floor import FAR, Floor, Staff
from waiter_cli.bounds.needs import Needs
from waiter_cli.bounds.seating import Seating
from waiter_cli.bounds.walk import write_plan
from waiter_cli.plan import Plan
from waiter_cli.problem import Problem

__all__ = ["Estimate"]


class Estimate:
    """Both bounds of one problem, of which nothing is known to be impossible."""

    def __init__(
        self, problem: Problem, needs: Needs, floor: Floor, staff: Staff, deadline: float | None
    ) -> None:
        self.problem, self.needs, self.floor, self.staff = problem, needs, floor, staff
        self.seating = Seating(problem, needs, floor)
        self.builder = Builder(self.seating, deadline)

    def find(self) -> tuple[int, Plan | None]:
        deeds = sum(link.is_deed for chain in self.needs.chains for link in chain.sure)
        deeds += self.seating.deeds_at_door()
        solved = self.seating.solve()
        lower = deeds
        if solved is None:
            return lower, None
        chosen = {
            row: self.seating.tables[column].name
            for row, column in enumerate(solved.column)
            if column < len(self.seating.tables)
        }
        tour = self.builder.build(chosen)
        if tour is None:
            return lower, None
        self.builder.improve(tour, lower)
        plan = write_plan(self.problem, self.floor, self.staff, tour.stops, self.builder.end)
        return lower, plan
