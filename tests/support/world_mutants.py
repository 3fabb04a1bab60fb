"""The rules of the simulated world, changed one at a time: what its checks must notice.

`world_mutants` makes one mutant for each refusal of an action that is dropped or is always given,
and for each statement of an effect, or of what happens by itself, that is deleted.  `probes` are
runs whose outcome is known: services that succeed, and plans that break one rule each.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

from tests.support.playing import play
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Observation
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation import world as worlds
from waiter_cli.simulation.outcome import Rules

__all__ = ["Mutant", "Probe", "changed", "probes", "world_mutants"]

SOURCE = Path(worlds.__file__).read_text(encoding="utf-8")
EVENTS = ("_leave", "suffer", "tick_over", "_sit", "_fill_at_bar")
PLACES = ("_away", "_not_at_bar")


@dataclass(frozen=True)
class Mutant:
    """The module of the world with one change; ``rule`` is the function that has it.

    The module is made when it is asked for, since few of all mutants are tried by default.
    """

    rule: str
    change: str
    make: Callable[[], ast.Module] = field(repr=False)

    def __str__(self) -> str:
        return f"{self.rule}: {self.change}"


@dataclass(frozen=True)
class Probe:
    """A run: the checks that fail in it, none of them where all is well; how much news is refused."""

    name: str
    problem: Problem
    plan: tuple[str, ...] | None = None
    fails: frozenset[str] = frozenset()
    timed: tuple[TimedEvent, ...] = ()
    refused: int = 0
    inject: tuple[str, ...] = ()

    def noticed(self) -> tuple[str, ...]:
        """What is not as it should be: checks that fail, news refused or believed wrongly."""
        rules = Rules(on_failure="stop") if self.fails else Rules()
        run = play(self.problem, self.plan, rules=rules, timed=self.timed, inject=self.inject)
        failed = frozenset(failure.check for failure in run.outcome.failures)
        refused = sum("ignored" in event for event in run.events)
        lost = sorted(f"not {check}" for check in self.fails - failed)
        return (*sorted(failed - self.fails), *lost, *(["news"] if refused != self.refused else []))

    def is_about(self, mutant: Mutant) -> bool:
        """Whether the last action of an illegal plan is the one whose rule was changed."""
        return bool(self.fails and self.plan) and mutant.rule.endswith(
            f"_{self.plan[-1].partition('(')[0].removeprefix('give_').removesuffix('_to')}"
        )


@contextmanager
def changed(mutant: Mutant) -> Iterator[None]:
    """The world by a mutant's rules, for the time of the block."""
    space: dict[str, Any] = {"__name__": worlds.__name__}
    exec(compile(mutant.make(), worlds.__file__, "exec"), space)
    rules, methods = dict(worlds.RULES), {name: vars(worlds.World)[name] for name in _METHODS}
    space["Violation"] = worlds.Violation
    for name in _METHODS:
        setattr(worlds.World, name, vars(space["World"])[name])
    worlds.RULES.update(space["RULES"])
    try:
        yield
    finally:
        worlds.RULES.update(rules)
        for name, method in methods.items():
            setattr(worlds.World, name, method)


_METHODS = (*EVENTS, *PLACES)


# ---------------------------------------------------------------- mutants


def world_mutants() -> list[Mutant]:
    """All of them, in the order of the module."""
    found = []
    for function in _functions(_as_it_is()):
        if function.name.startswith("_no_") or function.name in PLACES:
            found += _refusals(function)
        elif function.name in EVENTS or f"_no{function.name}" in _names():
            found += _statements(function)
    return found


@cache
def _as_it_is() -> ast.Module:
    return ast.parse(SOURCE)


@cache
def _names() -> set[str]:
    return {function.name for function in _functions(_as_it_is())}


def _functions(tree: ast.Module) -> Iterator[ast.FunctionDef]:
    for node in tree.body:
        inside = node.body if isinstance(node, ast.ClassDef) and node.name == "World" else [node]
        yield from (item for item in inside if isinstance(item, ast.FunctionDef))


def _in_copy(name: str) -> tuple[ast.Module, ast.FunctionDef]:
    tree = ast.parse(SOURCE)
    return tree, next(function for function in _functions(tree) if function.name == name)


def _refusals(function: ast.FunctionDef) -> Iterator[Mutant]:
    """Each reason to refuse: dropped, and given always."""
    for index, refusal in enumerate(_conditions(function)):
        for change, value in (("never", False), ("always", True)):
            make = partial(_with_condition, function.name, index, value)
            yield Mutant(function.name, f"{change} `{ast.unparse(refusal)}`", make)


def _with_condition(name: str, index: int, value: bool) -> ast.Module:
    """The module in which a reason to refuse always has this value."""
    tree, function = _in_copy(name)
    condition = _conditions(function)[index]
    for node in ast.walk(function):
        for key, child in ast.iter_fields(node):
            if child is condition:
                setattr(node, key, ast.Constant(value))
            elif isinstance(child, list) and condition in child:
                child[child.index(condition)] = ast.Constant(value)
    return ast.fix_missing_locations(tree)


def _conditions(function: ast.FunctionDef) -> list[ast.expr]:
    """What makes the function refuse: first arguments of ``_no``, tests of ``if``."""
    found: list[ast.expr] = []
    for node in ast.walk(function):
        if isinstance(node, ast.If):
            found.append(node.test)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            found += node.args[:1] if node.func.id == "_no" else []
    return sorted(found, key=lambda node: (node.lineno, node.col_offset))


def _statements(function: ast.FunctionDef) -> Iterator[Mutant]:
    """Each statement that changes something, deleted; each test, turned round."""
    for index, statement in enumerate(_changes(function)):
        if isinstance(statement, ast.If):
            said = f"not `{ast.unparse(statement.test)}`"
        else:
            said = f"without `{ast.unparse(statement)}`"
        yield Mutant(function.name, said, partial(_without, function.name, index))


def _without(name: str, index: int) -> ast.Module:
    """The module without a statement, or with a test turned round."""
    tree, function = _in_copy(name)
    node = _changes(function)[index]
    if isinstance(node, ast.If):
        node.test = ast.UnaryOp(ast.Not(), node.test)
    else:
        for parent in ast.walk(function):
            body = getattr(parent, "body", None)
            if isinstance(body, list) and node in body:
                body[body.index(node)] = ast.copy_location(ast.Pass(), node)
    return ast.fix_missing_locations(tree)


def _changes(function: ast.FunctionDef) -> list[ast.stmt]:
    """Statements with an effect on the world, and tests; not the making of names for later."""
    found: list[ast.stmt] = []
    for node in ast.walk(function):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            found.append(node)
        elif isinstance(node, ast.If):
            found.append(node)
        elif isinstance(node, ast.Assign | ast.AugAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            flat = [t for target in targets for t in getattr(target, "elts", [target])]
            if any(isinstance(target, ast.Attribute | ast.Subscript) for target in flat):
                found.append(node)
    return sorted(found, key=lambda node: (node.lineno, node.col_offset))


# ---------------------------------------------------------------- probes

HALL = """
name: hall
nodes: {door: [0, 0], hall: [2, 0], bar1: [4, 0], bar2: [6, 0], nook: [2, 2], deep: [2, 4]}
edges: [[door, hall], [hall, bar1], [bar1, bar2], [hall, nook], [nook, deep]]
entrance: door
agent: hall
waiters: {w1: deep}
tables:
  big: {capacity: 4, chairs: 2, nodes: [nook]}
  small: {capacity: 2, nodes: [hall]}
bar: {nodes: [bar1, bar2]}
objects: [plate, jug, basket]
"""
PLAIN = """
name: plain
nodes: {door: [0, 0], hall: [2, 0], nook: [2, 2]}
edges: [[door, hall], [hall, nook]]
entrance: door
agent: hall
tables:
  one: {capacity: 2, nodes: [hall]}
"""


def probes() -> list[Probe]:
    """The runs, the quick ones first."""
    hall, plain = read_layout(HALL, "hall"), read_layout(PLAIN, "plain")
    moving = read_layout(HALL + "timetable: {w1: {2: hall, 4: deep}}\n", "moving")
    found = []

    def legal(
        name: str, layout: Layout, text: str, *plan: str, timed: str = "", **state: Any
    ) -> None:
        problem = pose_problem(layout, read_scenario(text, name, layout))
        if state:
            problem = replace(problem, state=replace(problem.state, **state))
        found.append(Probe(name, problem, plan or None, timed=_timed(timed)))

    def illegal(
        name: str, layout: Layout, text: str, *plan: str, check: str = "preconditions", **state: Any
    ) -> None:
        legal(name, layout, text + "\ngoals: []", *plan, **state)
        found[-1] = replace(found[-1], fails=frozenset({check}))

    pick = ("go_to(agent,door)", "pick(agent,c1)")
    illegal("an edge that is not there", hall, "", "go_to(agent,deep)", check="edge")
    illegal("a node that is taken", hall, "state: {agent: nook}", "go_to(agent,deep)")
    illegal("picked from afar", hall, "observe: [enter: [c1]]", "pick(agent,c1)")
    illegal(
        "picked from a chair", hall, "state: {agent: door, seated: {small: [c1]}}", "pick(agent,c1)"
    )
    illegal(
        "two parties led",
        hall,
        "state: {agent: door}\nobserve: [enter: [c1], enter: [c2]]",
        "pick(agent,c1)",
        "pick(agent,c2)",
    )
    illegal(
        "picked though full",
        plain,
        "state: {agent: door, seated: {one: [c1]}}\nobserve: [enter: [c2]]",
        "pick(agent,c2)",
    )
    illegal("seated but not led", hall, "observe: [enter: [c1]]", "seat(agent,c1,small)")
    illegal(
        "seated from afar", hall, "state: {agent: door, with_agent: [c1]}", "seat(agent,c1,small)"
    )
    illegal(
        "seated where others sit",
        hall,
        "state: {with_agent: [c1], seated: {small: [c2]}}",
        "seat(agent,c1,small)",
    )
    illegal(
        "seated three on two",
        hall,
        "state: {with_agent: [c1, c2, c3]}",
        "seat(agent,c1,small)",
        check="chairs",
    )
    illegal(
        "seated on chairs not there",
        hall,
        "state: {agent: nook, with_agent: [c1, c2, c3]}",
        "seat(agent,c1,big)",
        check="chairs",
    )
    illegal("a bill not wanted", hall, "state: {seated: {small: [c1]}}", "give_bill(agent,small)")
    illegal(
        "a bill for nobody", hall, "", "give_bill(agent,small)", wants_bill=frozenset({"small"})
    )
    illegal(
        "a bill from afar",
        hall,
        "state: {agent: door, seated: {small: [c1]}, wants_bill: [small]}",
        "give_bill(agent,small)",
    )
    illegal(
        "an order without a bar",
        plain,
        "state: {seated: {one: [c1]}}",
        "take_order(agent,one)",
        ready_to_order=frozenset({"one"}),
    )
    illegal(
        "an order of nobody",
        hall,
        "",
        "take_order(agent,small)",
        ready_to_order=frozenset({"small"}),
    )
    illegal("an order too early", hall, "state: {seated: {small: [c1]}}", "take_order(agent,small)")
    illegal(
        "an order from afar",
        hall,
        "state: {agent: door, seated: {small: [c1]}, ready_to_order: [small]}",
        "take_order(agent,small)",
    )
    illegal(
        "sent what was not taken",
        hall,
        "state: {agent: bar1, seated: {small: [c1]}}",
        "send_order(agent,small)",
    )
    illegal(
        "sent from afar",
        hall,
        "state: {seated: {small: [c1]}, ordered: [small]}",
        "send_order(agent,small)",
    )
    illegal(
        "taken up from afar",
        hall,
        "state: {seated: {small: [c1]}, ready: {small: plate}}",
        "take_up(agent,plate,small)",
    )
    illegal(
        "taken up with full hands",
        hall,
        "state: {agent: bar1, seated: {small: [c1], big: [c2]}, carrying: {big: plate}, ready: {small: plate}}",
        "take_up(agent,plate,small)",
    )
    illegal(
        "taken up from nowhere",
        hall,
        "state: {agent: bar1, seated: {small: [c1]}}",
        "take_up(agent,plate,small)",
    )
    illegal(
        "brought without having", hall, "state: {seated: {small: [c1]}}", "bring(agent,plate,small)"
    )
    illegal(
        "brought empty",
        hall,
        "state: {seated: {small: [c1]}, empty: {small: jug}, carrying: {small: jug}}",
        "bring(agent,jug,small)",
    )
    illegal(
        "brought from afar",
        hall,
        "state: {agent: bar1, seated: {small: [c1]}, carrying: {small: plate}}",
        "bring(agent,plate,small)",
    )
    illegal(
        "a plate refilled",
        hall,
        "state: {seated: {small: [c1]}}",
        "refill(agent,plate,small)",
        empty=frozenset({("small", "plate")}),
    )
    illegal(
        "refilled though full", hall, "state: {seated: {small: [c1]}}", "refill(agent,jug,small)"
    )
    illegal(
        "refilled with full hands",
        hall,
        "state: {seated: {small: [c1], big: [c2]}, empty: {small: jug}, carrying: {big: plate}}",
        "refill(agent,jug,small)",
    )
    illegal(
        "refilled from afar",
        hall,
        "state: {agent: bar1, seated: {small: [c1]}, empty: {small: jug}}",
        "refill(agent,jug,small)",
    )
    illegal("chairs where all are", plain, "", "bring_chairs(agent,one,2)")
    illegal(
        "chairs beyond the capacity",
        hall,
        "state: {agent: nook}",
        "bring_chairs(agent,big,5)",
        check="chairs",
    )
    illegal(
        "chairs taken away",
        hall,
        "state: {agent: nook}",
        "bring_chairs(agent,big,1)",
        check="chairs",
    )
    illegal("chairs from afar", hall, "", "bring_chairs(agent,big,3)")

    legal("one seated", hall, "observe: [enter: [c1, c2]]")
    legal("chairs brought", hall, "observe: [enter: [c1, c2, c3]]")
    legal("a bill", hall, "state: {agent: nook, seated: {small: [c1]}}\nobserve: [bill: small]")
    legal("a jug", hall, "state: {seated: {big: [c1, c2]}}\nobserve: [empty: {big: jug}]")
    legal(
        "a plate",
        hall,
        "state: {seated: {small: [c1]}}\nobserve: [order: small]\ninstant_kitchen: true",
    )
    legal(
        "a colleague in the way",
        moving,
        "state: {agent: nook, seated: {small: [c1]}}\nobserve: [bill: small]",
    )
    legal(
        "a colleague passes",
        moving,
        "goals: [at: bar1]",
        *("go_to(agent,bar1)", "go_to(agent,bar2)") * 2,
        "go_to(agent,bar1)",
    )
    follow = HALL.replace("{w1: deep}", "{w1: nook, w2: deep}")
    for table in ("{w1: {1: hall}, w2: {1: nook}}", "{w1: {1: hall, 2: door}, w2: {1: nook}}"):
        follows = read_layout(f"{follow}timetable: {table}\n", "follows")
        legal(f"held up: {table}", follows, "goals: [at: bar2]")
        found[-1] = replace(found[-1], inject=("slip:0.6",))
    legal(
        "who follows leaves", hall, "observe: [enter: [c1], enter: [c2]]", *pick, timed="7 leave c1"
    )
    led = "state: {with_agent: [c1], seated: {big: [c9]}, carrying: {big: plate}, sent: [big]}"
    legal("who is led leaves", hall, led, timed="0.1 leave c1")
    legal("whose plate is carried leaves", hall, led, timed="0.1 leave c9")
    legal("who sits leaves", hall, led, timed="0.1 enter c8; 3 leave c8")
    jug = "state: {agent: hall, seated: {big: [c1, c2]}, carrying: {big: jug}, empty: {big: jug}}\ngoals: []"
    legal("put at the bar with an empty jug", hall, jug, timed="0 at agent bar1")
    legal("put elsewhere", hall, jug, timed="0 at agent nook")
    for line in (
        "0 at agent deep", "0 at w1 hall", "0 order small", "0 empty big jug", "0 enter c1", "0 leave c7", "0 free big",
    ):  # fmt: skip
        legal(f"refused: {line}", hall, jug, timed=line)
        found[-1] = replace(found[-1], refused=1)
    for timed in (
        "1 enter c5 c6", "1 leave c1", "1 leave c9", "1 bill big", "1 order big", "1 empty big jug",
        "1 ready big plate", "1 ready small jug", "1 free small", "1 at w1 bar1", "3 leave c2",
        "0.5 ready small plate; 6 leave c9",
    ):  # fmt: skip
        for sent in ("[]", "[big, small]"):
            text = f"state: {{seated: {{big: [c1], small: [c9]}}, sent: {sent}}}\nobserve: [enter: [c2]]"
            legal(f"news: {timed}", hall, text, timed=timed)
            found[-1] = replace(found[-1], refused=timed == "1 free small")
    for scene in ("b1", "b2", "b3", "b4", "lunch"):
        found.append(Probe(scene, replace(read_problem(None, scene)[0], prefer=())))
    return found


def _timed(text: str) -> tuple[TimedEvent, ...]:
    found = []
    for part in filter(None, (piece.strip() for piece in text.split(";"))):
        seconds, kind, *names = part.split()
        found.append(TimedEvent(float(seconds), (Observation(kind, tuple(names)),)))
    return tuple(found)
