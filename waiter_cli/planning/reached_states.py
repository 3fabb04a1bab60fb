"""Explores every state that a program of one step can reach. Entry point `can_reach_goals`.

A state is what holds at a step, with all that is carried on.  The first states are those after the
first step; what follows on each is found by solving, with the state assumed literal by literal.  So
a finite world is known to its end, and where no state has the goals, no plan of any length has them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from sparc.lazy_dataclass import dataclass
from waiter_cli.planning.step_form import OpenQuestion

if TYPE_CHECKING:
    import clingo

    from sparc.solving.clingo_solver import Grounding

__all__ = ["StepPrograms", "can_reach_goals"]

_State: TypeAlias = "frozenset[clingo.Symbol]"
_SIGNS = (("", "p"), ("-", "n"))


@dataclass(frozen=True)
class StepPrograms:
    """The lines of a program's first step, and those of any step; steps are 0 and 1.

    ``carried`` are predicates with a step that a state is made of, ``frozen`` those without, each with
    the number of its other arguments; ``literals`` are all their atoms, without steps.
    """

    first: Sequence[str]
    later: Sequence[str]
    carried: Mapping[str, int]
    frozen: Mapping[str, int]
    literals: Sequence[str]


def can_reach_goals(
    programs: StepPrograms, most: int, deadline: float | None
) -> frozenset[int] | None:
    """Returns the goals that hold in some state, where no state has all; None where one has.

    Raises `OpenQuestion` where there are more than ``most`` states, or where time is up.
    """
    first = _ground(programs, programs.first, [], deadline)
    later = _ground(programs, programs.later, _chosen(programs), deadline)
    literals = _literals(programs, later)
    states: dict[_State, None] = {}
    reached: set[int] = set()
    todo: list[_State | None] = [None]
    while todo:
        state = todo.pop()
        grounding = first if state is None else later
        assumed = [] if state is None else [n if s in state else -n for s, n in literals.items()]
        for shown in _outcomes(grounding, assumed, deadline):
            named = {symbol.name for symbol in shown}
            if "__goal" in named:
                return None
            reached |= {s.arguments[0].number for s in shown if s.name == "__reached"}
            after = frozenset(s for s in shown if s.name == "__after")
            if after not in states:
                states[after] = None
                todo.append(after)
                if len(states) > most:
                    raise OpenQuestion
    return frozenset(reached)


def _outcomes(
    grounding: Grounding, assumed: Sequence[int], deadline: float | None
) -> Iterator[frozenset[clingo.Symbol]]:
    """Yields what is shown of each model, each once."""
    for model in grounding.models(limit=0, assumptions=assumed, deadline=deadline):
        yield frozenset(model.symbols(shown=True))
    if grounding.outcome.satisfiability.value == "unknown":
        raise OpenQuestion


def _ground(
    programs: StepPrograms, lines: Sequence[str], more: Sequence[str], deadline: float | None
) -> Grounding:
    from sparc.solving.clingo_solver import Grounding
    from sparc.translation.asp_program import AspProgram

    extra = [*more, *_after(programs), "__goal :- goal(I). __reached(G) :- reached(G,1)."]
    extra += ["#defined reached/2.", *(f"__domain({literal})." for literal in programs.literals)]
    # What is shown is told apart by #project, since --project=show does not see names with a "_" first.
    shown = ("__after/2", "__goal/0", "__reached/1")
    extra += [f"#project {name}." for name in shown]
    grounding = Grounding(
        AspProgram("\n".join(lines), ""),
        extra="\n".join(extra),
        show=" ".join(f"#show {name}." for name in shown),
        options=("--project=project",),
    )
    grounding.ground(deadline)
    return grounding


def _after(programs: StepPrograms) -> Iterator[str]:
    """Yields the rules that say of what the state at step 1 is made."""
    for bare, _, after in _forms(programs):
        for sign, tag in _SIGNS:
            yield f"__after({tag},{bare}) :- {sign}{after}."


def _chosen(programs: StepPrograms) -> list[str]:
    """Returns the rules by which anything may hold at step 0."""
    return [
        f"{{ {sign}{before} }} :- __domain({bare})."
        for bare, before, _ in _forms(programs)
        for sign, _ in _SIGNS
    ]


def _forms(programs: StepPrograms) -> Iterator[tuple[str, str, str]]:
    """Yields of each predicate of a state an atom without step, at step 0, and at step 1."""
    for timed, names in ((True, programs.carried), (False, programs.frozen)):
        for name, count in names.items():
            inner = [f"X{k}" for k in range(count)]
            bare = _atom(name, inner)
            before, after = (
                (_atom(name, [*inner, "0"]), _atom(name, [*inner, "1"])) if timed else (bare, bare)
            )
            yield bare, before, after


def _atom(name: str, arguments: Sequence[str]) -> str:
    return f"{name}({','.join(arguments)})" if arguments else name


def _literals(programs: StepPrograms, later: Grounding) -> dict[clingo.Symbol, int]:
    """Returns the literals of clingo's of what holds at step 0, by the ``__after`` they had before."""
    import clingo

    literals = {}
    zero = clingo.Number(0)
    for atom in later.control.symbolic_atoms:
        symbol = atom.symbol
        timed = symbol.name in programs.carried
        if not timed and symbol.name not in programs.frozen:
            continue
        if timed and symbol.arguments[-1] != zero:
            continue
        inner = symbol.arguments[:-1] if timed else symbol.arguments
        tag = clingo.Function("n" if symbol.negative else "p")
        literals[clingo.Function("__after", [tag, clingo.Function(symbol.name, inner)])] = (
            atom.literal
        )
    return literals
