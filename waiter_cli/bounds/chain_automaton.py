"""Chains of stops as one machine: how far each is, and what can be done on reaching a node.

Entry point `build_machine`: the certain links of `Needs` → `Machine`.  A state of it is one number.
Looked at alone it forgets who sits where: what follows a seat at once costs no walk and is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.insertion import Builder, nodes_of
from waiter_cli.bounds.required_tasks import Chain
from waiter_cli.bounds.service_chains import HAND_LINKS, Link

__all__ = ["Course", "Machine", "build_machine"]


@dataclass(frozen=True)
class Course:
    """A chain as the relaxation sees it: which task, and of each link its index and nodes.

    ``held`` says that the hands are full from the start.  All orders are sent together: such a
    course stands for ``also`` (pairs of task and index) and comes after other courses, by number.
    """

    task: int
    links: tuple[Link, ...]
    indices: tuple[int, ...]
    nodes: tuple[tuple[int, ...], ...]
    held: bool = False
    after: tuple[int, ...] = ()
    also: tuple[tuple[int, int], ...] = ()


class Machine:
    """The chains together: a state is a number; `arrive` is what can be done on reaching a node."""

    def __init__(self, courses: Sequence[Course]) -> None:
        """``count`` bounds the number of states that can come about."""
        self.courses = courses
        self.units: list[int] = []
        unit = 1
        for course in courses:
            self.units.append(unit)
            unit *= len(course.links) + 1
        self.size = unit
        self.done = sum(u * len(c.links) for u, c in zip(self.units, courses))
        self.hold: list[list[bool]] = []
        for course in courses:
            held = [course.held]
            for link in course.links:
                now = link.name in HAND_LINKS or (held[-1] and link.name != "bring")
                held.append(now)
            self.hold.append(held)
        hands = [k for k, held in enumerate(self.hold) if any(held)]
        self.choosy = len(hands) > 1
        self.hands = hands
        idle = [held.count(False) for held in self.hold]
        self.count = prod(idle) + sum(
            self.hold[k].count(True) * prod(idle[:k] + idle[k + 1 :]) for k in hands
        )
        self._arrive: dict[tuple[int, int], tuple[int, ...]] = {}
        self._targets: dict[int, tuple[int, ...]] = {}

    def waits(self, progress: list[int], course: Course) -> bool:
        """Returns whether something else must be done before this course can go on."""
        return any(progress[k] < len(self.courses[k].links) for k in course.after)

    def progress(self, state: int) -> list[int]:
        """Returns the number of links done of each course."""
        counts = []
        for course in self.courses:
            state, done = divmod(state, len(course.links) + 1)
            counts.append(done)
        return counts

    def free(self, progress: list[int]) -> bool:
        """Returns whether the hands are free."""
        return not any(self.hold[k][progress[k]] for k in self.hands)

    def arrive(self, state: int, node: int) -> tuple[int, ...]:
        """Returns the states that can be had at ``node``, the most advanced one first."""
        key = (state, node)
        states = self._arrive.get(key)
        if states is None:
            states = self._arrive[key] = self._closure(state, node)
        return states

    def _closure(self, state: int, node: int) -> tuple[int, ...]:
        reached = {self._advance(state, node)}
        queue = list(reached)
        for here in queue:
            progress = self.progress(here)
            if not self.hands or not self.free(progress):
                continue
            for k in self.hands:
                course, done = self.courses[k], progress[k]
                if done < len(course.links) and node in course.nodes[done]:
                    if course.links[done].name in HAND_LINKS:
                        after = self._advance(here + self.units[k], node)
                        if after not in reached:
                            reached.add(after)
                            queue.append(after)
        if not self.choosy:
            return (max(queue),)
        return tuple(queue)

    def _advance(self, state: int, node: int) -> int:
        """Does everything at ``node`` that needs no free hands."""
        progress = self.progress(state)
        for k, course in enumerate(self.courses):
            done = progress[k]
            if course.after and self.waits(progress, course):
                continue
            while done < len(course.links) and node in course.nodes[done]:
                if course.links[done].name in HAND_LINKS:
                    break
                done += 1
                state += self.units[k]
            progress[k] = done
        return state

    def targets(self, state: int) -> tuple[int, ...]:
        """Returns the nodes where something can be done next."""
        open_nodes = self._targets.get(state)
        if open_nodes is None:
            progress = self.progress(state)
            free = self.free(progress)
            nodes: dict[int, None] = {}
            for k, course in enumerate(self.courses):
                done = progress[k]
                if done < len(course.links) and not self.waits(progress, course):
                    if free or course.links[done].name not in HAND_LINKS:
                        nodes.update(dict.fromkeys(course.nodes[done]))
            open_nodes = self._targets[state] = tuple(nodes)
        return open_nodes


def build_machine(builder: Builder, most: int) -> Machine:
    """Returns the certain links of all chains, or of so many that ``most`` states tell them apart.

    Those that fill the hands come first, and of each kind those farthest from the entrance.
    """
    chains = builder.chains({})
    courses = [_course(builder, number, chain) for number, chain in chains.items()]
    courses = [course for course in courses if course.links]
    home = builder.floor.row(builder.floor.door)

    def rank(course: Course) -> tuple[bool, int]:
        hands = course.held or any(link.name in HAND_LINKS for link in course.links)
        return not hands, -max(min(home[node] for node in nodes) for nodes in course.nodes)

    courses.sort(key=rank)
    machine = Machine(_merged(courses))
    while machine.count > most:
        courses.pop()
        machine = Machine(_merged(courses))
    return machine


def _course(builder: Builder, number: int, chain: Chain) -> Course:
    """Returns a chain as the machine sees it."""
    skipped: list[str] = ["give_bill", "take_order"] if chain.seat_first else []
    if chain.table in builder.seating.index:
        skipped.append("bring_chairs")
    kept: list[tuple[int, Link]] = []
    position = 0
    for index, link in enumerate(chain.links):
        if position < len(chain.sure) and link == chain.sure[position]:
            position += 1
            if link.name not in skipped:
                kept.append((index, link))
    names = [link.name for _, link in kept]
    held = "bring" in names and not {"take_up", "refill"} & set(names[: names.index("bring")])
    return Course(
        number,
        tuple(link for _, link in kept),
        tuple(index for index, _ in kept),
        tuple(nodes_of(builder.floor, link) for _, link in kept),
        held,
    )


def _merged(courses: list[Course]) -> list[Course]:
    """Returns the same with all orders sent at once: a visit of the bar after the
    last was taken will do.
    """
    found: list[Course] = []
    also: list[tuple[int, int]] = []
    after: list[int] = []
    bar: tuple[int, ...] = ()
    link = None
    for course in courses:
        names = [link.name for link in course.links]
        if names[-1] != "send_order" or len(names) > 2:
            found.append(course)
            continue
        also.append((course.task, course.indices[-1]))
        bar, link = course.nodes[-1], course.links[-1]
        if len(names) == 2:
            after.append(len(found))
            found.append(
                Course(course.task, course.links[:1], course.indices[:1], course.nodes[:1])
            )
    if link is not None:
        together = Course(-1, (link,), (0,), (bar,), after=tuple(after), also=tuple(also))
        found.append(together)
    return found
