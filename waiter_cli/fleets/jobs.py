"""Goals as jobs for one robot each: `Problem` → jobs in stages. Entry point `find_jobs`.

Whoever picks a party up seats it, whoever takes an order sends it, whoever takes something up brings
it.  A job is dealt to one robot from its first stage to its last, though a plate that comes of an order
may be brought by another one than sent the order.
"""

from __future__ import annotations

from collections.abc import Iterator

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party

__all__ = ["Job", "Jobs", "Stage", "find_jobs"]


@dataclass(frozen=True)
class Stage:
    """An action and the nodes it can be done on; without a name it is enough to be there."""

    name: str
    arguments: tuple[str, ...]
    nodes: tuple[str, ...]


@dataclass(frozen=True)
class Job:
    """Stages in their order; ``robot`` names the one that has to do it, None: any.

    A party that is led to a table is ``party``; its last stage is then open, the table is one of
    ``tables``.  ``hands`` says that hands are full from the first stage on.
    """

    stages: tuple[Stage, ...]
    robot: str | None = None
    party: Party = ()
    tables: tuple[str, ...] = ()
    hands: bool = False

    @property
    def deeds(self) -> int:
        """Returns how many actions but walking it takes, the seat of a party included."""
        return sum(bool(stage.name) for stage in self.stages) + bool(self.party)


@dataclass(frozen=True)
class Jobs:
    """All jobs, and the node on which each named robot has to stand in the end.

    ``anywhere`` are nodes on which some robot has to stand then.
    """

    jobs: tuple[Job, ...]
    ends: dict[str, str]
    anywhere: tuple[str, ...] = ()


def find_jobs(problem: Problem) -> Jobs | None:
    """Returns the jobs of a problem, None where some goal is not made of such jobs.

    Goals that hold already make none.
    """
    from waiter_cli.rules.actions import holds

    found: dict[object, Job] = {}
    ends: dict[str, str] = {}
    anywhere: dict[str, None] = {}
    for goal in problem.goals:
        if goal.kind == "at":
            if goal.robot is not None and ends.setdefault(goal.robot, goal.node or "") != goal.node:
                return None
            if goal.robot is None:
                anywhere[goal.node or ""] = None
            continue
        if holds(goal, problem.state, problem):
            continue
        made = _Maker(problem, goal)
        jobs = list(made.jobs())
        if not jobs or not made.known:
            return None
        for key, job in jobs:
            if key not in found or len(found[key].stages) < len(job.stages):
                found[key] = job
    return Jobs(tuple(found.values()), ends, tuple(anywhere))


class _Maker:
    """Makes the jobs of one goal; ``known`` turns false where it is not made of jobs."""

    def __init__(self, problem: Problem, goal: Goal) -> None:
        self.problem, self.goal, self.state = problem, goal, problem.state
        self.layout = problem.layout
        self.known = True

    def jobs(self) -> Iterator[tuple[object, Job]]:
        goal, state = self.goal, self.state
        match goal.kind:
            case "seated":
                yield from self._party()
            case "paid":
                table = goal.table or state.table_of(goal.party[0])
                seated = table is not None and table in dict(state.seated)
                if table is not None and seated and table in state.wants_bill:
                    yield ("bill", table), Job((self._at(table, "give_bill", table),))
            case "ordered" | "sent" | "served" if goal.item in (None, "plate"):
                yield from self._order(goal.table or "")
            case "served" | "filled":
                yield from self._thing(goal.table or "", goal.item or "")
            case "chairs":
                if not self.lacks_party(goal.table or ""):
                    number = str(goal.number)
                    stage = self._at(goal.table or "", "bring_chairs", goal.table or "", number)
                    yield ("chairs", goal.table), Job((stage,))

    def lacks_party(self, table: str) -> bool:
        """Returns whether so many chairs cannot be brought there."""
        return (self.goal.number or 0) > self.layout.table(table).capacity

    def _at(self, table: str, name: str, *arguments: str) -> Stage:
        return Stage(name, arguments, self.layout.table(table).nodes)

    def _bar(self, name: str, *arguments: str) -> Stage:
        nodes = self.layout.bar.nodes if self.layout.bar is not None else ()
        return Stage(name, arguments, nodes)

    def _party(self) -> Iterator[tuple[object, Job]]:
        party, sitting = self.goal.party, dict(self.state.seated)
        fits = tuple(
            table.name
            for table in self.layout.tables
            if table.name not in sitting
            and table.capacity >= len(party)
            and self.goal.table in (None, table.name)
        )
        led = next((robot.name for robot in self.state.robots if robot.leads == party), None)
        if not fits or (led is None and party not in self.state.waiting):
            return
        pick = () if led else (Stage("pick", (party[0],), (self.layout.entrance,)),)
        yield ("party", party), Job(pick, led, party, fits)

    def _order(self, table: str) -> Iterator[tuple[object, Job]]:
        goal, state = self.goal, self.state
        holder = next((robot.name for robot in state.robots if table in robot.orders), None)
        send = self._bar("send_order", table)
        fresh = table in state.ready_to_order and table in dict(state.seated)
        if holder is not None and fresh:  # another robot may take it anew
            self.known = False
        if goal.kind in ("ordered", "sent"):
            if holder is not None and goal.kind == "sent":
                yield ("order", table), Job((send,), holder)
            elif fresh:
                take = self._at(table, "take_order", table)
                yield ("order", table), Job((take,) if goal.kind == "ordered" else (take, send))
            return
        at_once = self.problem.instant_kitchen and "plate" in self.layout.objects
        if goal.item is None and (holder is not None or fresh) and at_once:
            plate = (table, "plate")
            if holder is None and (plate in state.ready or plate in state.carried()):
                self.known = False  # that plate will do, without an order
            stages = (send,) if holder is not None else (self._at(table, "take_order", table), send)
            up, bring = (
                self._bar("take_up", "plate", table),
                self._at(table, "bring", "plate", table),
            )
            yield ("order", table), Job((*stages, up, bring), holder)
            return
        yield from self._thing(table, "plate")

    def _thing(self, table: str, item: str) -> Iterator[tuple[object, Job]]:
        state, thing = self.state, (table, item)
        bring = self._at(table, "bring", item, table)
        filled = (self._bar(""),) if thing in state.empty and item != "plate" else ()
        carrier = next((robot.name for robot in state.robots if robot.carries == thing), None)
        if carrier is not None:
            self.known = self.known and thing not in state.ready
            yield ("thing", table, item), Job((*filled, bring), carrier, hands=True)
        elif thing in state.ready:
            self.known = self.known and thing not in state.empty
            up = self._bar("take_up", item, table)
            yield ("thing", table, item), Job((up, bring), hands=True)
        elif thing in state.empty:
            refill = self._at(table, "refill", item, table)
            yield ("thing", table, item), Job((refill, *filled, bring), hands=True)
