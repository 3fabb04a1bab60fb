"""Proves that a domain of one's own has no plan of any length: `Problem` → reasons. Entry point `prove_no_plan`.

*What can ever come about.*  Let L be the literals that hold at the first two steps of some answer set.
From any choice of literals of L as a state, look at what one step more can make hold, and add it to L,
until nothing is new.  Literals that hold from the start and that no step ends are in every choice.  A state of a real plan is one of these choices, and what holds after it is found
with it; so where no choice, and no step from one, reaches the goals, no plan of any length does.

*Every state.*  That leaves out which literals hold together.  Where the goals are within its reach,
the states are looked at one by one, if they are not too many.

*What is relaxed.*  The statements that fix absolute steps, or steps more than one apart, are constraints
of time: such constraints are left out, which can only let more come about.  Facts about step 0 hold there
only.  A rule that is neither of one step nor from one to the next leaves the question open, and so do a
timetable and preferences among answer sets: then the answer is None.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from typing import TYPE_CHECKING

from waiter_cli.encoding.domains import Domain, domain_for
from waiter_cli.encoding.template import fill_template
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.wording import goal_text
from waiter_cli.planning.step_form import OpenQuestion, StepForm

if TYPE_CHECKING:
    import clingo

    from sparc.checking.typed_program import TypedProgram
    from sparc.solving.clingo_solver import Grounding
    from sparc.translation.asp_program import AspProgram

__all__ = ["prove_no_plan"]

_MOST = 50_000  # literals that are looked at


def prove_no_plan(
    problem: Problem,
    domain: Domain,
    deadline: float | None = None,
    required: Action | None = None,
    most_states: int = 0,
) -> tuple[Reason, ...] | None:
    """Returns why no plan of any length exists; None where that is not proved by ``deadline``.

    With ``required``, of those in which that action occurs.  Where all that can come about, taken
    together, has the goals, up to ``most_states`` states are looked at one by one.
    Horizon 0 has to be refuted already.  Raises what the domain's program raises where it is wrong.
    """
    from sparc.checking.checker import check
    from sparc.solving.clingo_threads import Abandoned
    from sparc.syntax.parser import parse
    from sparc.translation.translator import translate

    if problem.layout.timetable:
        return None
    typed = check(parse(fill_template(domain_for(problem, domain).template, problem, 1)))
    asp = translate(typed)
    if asp.has_preferences or "goal" not in typed.predicates:
        return None
    try:
        reach = _Reach(typed, asp, deadline)
        if not reach.goals():
            return _reasons(problem, reach)
        if required is None:
            return _by_states(problem, reach, most_states)
        if reach.happens(required):
            return None
        said = f"{required.text}: nothing that can come about from here lets it happen"
        return (Reason(said),)
    except (OpenQuestion, Abandoned):
        return None


def _reasons(problem: Problem, reach: _Reach) -> tuple[Reason, ...]:
    """Returns the goals that can never hold, or that they never hold together."""
    if reach.empty:
        return (Reason("the situation and the rules of the domain contradict each other"),)
    return _never(problem, lambda number: reach.holds(f"reached({number},__S)"))


def _never(problem: Problem, can_hold: Callable[[int], bool]) -> tuple[Reason, ...]:
    """Returns a reason for each goal that cannot hold, by its number; or one for all together."""
    reasons = []
    for number, goal in enumerate(problem.all_goals(), 1):
        if not can_hold(number):
            text = goal_text(goal, in_sentence=True)
            message = f"{text}: nothing that can come about from here makes it so"
            reasons.append(Reason(message, goal.where))
    if not reasons:
        message = "nothing that can come about from here makes all goals hold at one step"
        reasons.append(Reason(message, next((g.where for g in problem.goals if g.where), None)))
    return tuple(reasons)


def _by_states(problem: Problem, reach: _Reach, most: int) -> tuple[Reason, ...] | None:
    """Returns the goals that hold in no state that can come about, or that they never hold together."""
    if not most:
        return None
    from waiter_cli.planning.reached_states import StepPrograms, can_reach_goals

    form = reach.form
    counts = {name: len(extents) for name, extents in reach.inputs.items()}
    programs = StepPrograms(
        reach.start,
        reach.later,
        {name: counts[name] for name in sorted(form.carried)},
        {name: counts[name] for name in sorted(form.frozen)},
        reach.literals,
    )
    held = can_reach_goals(programs, most, reach.deadline)
    return None if held is None else _never(problem, held.__contains__)


# ---------------------------------------------------------------- what can come about


class _Reach:
    """The literals that can come about, found step by step.  ``empty``: there is no first step at all."""

    def __init__(self, typed: TypedProgram, asp: AspProgram, deadline: float | None) -> None:
        self.form = form = StepForm(typed)
        self.deadline = deadline
        self.inputs = {
            name: [sort.extent for sort in typed.predicates[name].sorts[: -1 if timed else None]]
            for timed, names in ((True, form.carried), (False, form.frozen))
            for name in sorted(names)
        }
        self.literals = list(self.domain())
        lines = list(zip(asp.text.split("\n"), asp.line_spans, strict=True))
        self.start = [line for line, span in lines if span not in form.demands]
        self.later = [line for line, span in lines if span not in form.left_out]
        self.first = self.ground(self.start, [self.news(name, (0, 1)) for name in form.carried]
                                 + [self.news(name, None) for name in form.frozen])  # fmt: skip
        self.any = self.ground(self.later, [self.chosen(name, timed=True) for name in form.carried]
                               + [self.news(name, (1,)) for name in form.carried]
                               + [self.chosen(name, timed=False) for name in form.frozen])  # fmt: skip
        self.empty = not self.keep_first(form)

    def keep_first(self, form: StepForm) -> bool:
        """Begins with what holds at once as that which always does; returns whether there is a first step."""
        import clingo

        held: list[clingo.Symbol] = []
        for model in self.models(self.first, []):
            held = list(model.symbols(atoms=True))
        for symbol in held:
            if symbol.name in form.frozen:
                inner = symbol.arguments
            elif symbol.name in form.carried and symbol.arguments[-1].number == 0:
                inner = symbol.arguments[:-1]
            else:
                continue
            tag = clingo.Function("n" if symbol.negative else "p")
            self.assign("__keep", [tag, clingo.Function(symbol.name, inner)], True)
        return bool(held)

    def assign(self, name: str, arguments: Sequence[clingo.Symbol], value: bool) -> None:
        import clingo

        for each in (self.first, self.any):
            each.control.assign_external(clingo.Function(name, arguments), value)

    def domain(self) -> Iterator[str]:
        """Yields the literals that are looked at, without their steps."""
        from sparc.sorts.values import text

        left = _MOST
        for name, extents in self.inputs.items():
            size = 1
            for extent in extents:
                size *= extent.bound()
            left -= size
            if left < 0:
                raise OpenQuestion
            for values in product(*extents):
                yield _term(name, ",".join(map(text, values)))

    def arguments(self, name: str) -> str:
        return ",".join(f"X{k}" for k in range(len(self.inputs[name])))

    def news(self, name: str, steps: tuple[int, ...] | None) -> str:
        """Returns the rules by which a literal is new."""
        lines = []
        inner = self.arguments(name)
        for step in steps or (None,):
            after = inner if step is None else f"{inner},{step}" if inner else f"{step}"
            for sign, tag in (("", "p"), ("-", "n")):
                said = f"{tag},{_term(name, inner)}"
                literal = f"{sign}{_term(name, after)}"
                lines.append(f"__new({said}) :- {literal}, not __in({said}).")
                lines.append(f"__lost({said}) :- __keep({said}), not {literal}.")
        return "\n".join(lines)

    def chosen(self, name: str, *, timed: bool) -> str:
        """Returns the rules by which any choice of the known literals is a state."""
        lines = []
        inner = self.arguments(name)
        after = f"{inner},0" if timed and inner else "0" if timed else inner
        for sign, tag in (("", "p"), ("-", "n")):
            literal = f"{sign}{_term(name, after)}"
            said = f"{tag},{_term(name, inner)}"
            lines.append(f"{{ {literal} }} :- __in({said}).")
            lines.append(f":- __keep({said}), not {literal}.")
        return "\n".join(lines)

    def ground(self, lines: list[str], more: list[str]) -> Grounding:
        """Returns a grounding of these lines, with the literals that are known as externals."""
        from sparc.solving.clingo_solver import Grounding
        from sparc.translation.asp_program import AspProgram

        extra = [
            *more,
            "__some_new :- __new(T,L).",
            "__some_new :- __lost(T,L).",
            "{ __look }.",
            ":- __look, not __some_new.",
        ]
        extra += ["__goal :- goal(I).", "{ __wish }.", ":- __wish, not __goal."]
        extra += [f"__domain({literal})." for literal in self.literals]
        extra.append("#external __in(T,L) : __domain(L), T = (p;n).")
        extra.append("#external __keep(T,L) : __domain(L), T = (p;n).")
        grounding = Grounding(
            AspProgram("\n".join(lines), ""),
            extra="\n".join(extra),
            show="#show __new/2. #show __lost/2.",
        )
        grounding.ground(self.deadline)
        return grounding

    # ------------------------------------------------------------ asking

    def goals(self) -> bool:
        """Returns whether the goals can hold at some step, once all is found that can come about."""
        while True:
            if self.possible(self.first, ["__wish"]) or self.possible(self.any, ["__wish"]):
                return True
            if not (self.grow(self.first) or self.grow(self.any)):
                return False

    def happens(self, action: Action) -> bool:
        """Returns whether an action can occur at some step, once all is found that can come about."""
        while not self.holds(f"occurs({action.text},__S)"):
            if not (self.grow(self.first) or self.grow(self.any)):
                return False
        return True

    def grow(self, grounding: Grounding) -> bool:
        """Adds what one model has that was not known, and takes what it lacks from what always holds.

        Returns whether there was such a model.
        """

        symbols: list[clingo.Symbol] = []
        for model in self.models(grounding, ["__look"]):
            symbols = list(model.symbols(shown=True))
        for new in symbols:
            if new.name == "__new":
                self.assign("__in", new.arguments, True)
            else:
                self.assign("__keep", new.arguments, False)
        return bool(symbols)

    def holds(self, atom: str) -> bool:
        """Returns whether an atom can hold at some step; ``__S`` in it stands for the step."""
        import clingo

        for grounding in (self.first, self.any):
            for step in (0, 1):
                symbol = clingo.parse_term(atom.replace("__S", str(step)))
                if any(True for _ in self.models(grounding, [symbol])):
                    return True
        return False

    def possible(self, grounding: Grounding, wanted: list[str]) -> bool:
        return any(True for _ in self.models(grounding, list(wanted)))

    def models(
        self, grounding: Grounding, wanted: Iterable[str | clingo.Symbol]
    ) -> Iterator[clingo.Model]:
        import clingo

        if self.deadline is not None and time.monotonic() > self.deadline:
            raise OpenQuestion
        asked = [
            (clingo.Function(each) if isinstance(each, str) else each, True) for each in wanted
        ]
        yield from grounding.models(limit=1, assumptions=asked, deadline=self.deadline)
        if grounding.outcome.satisfiability.value == "unknown":
            raise OpenQuestion


def _term(name: str, inner: str) -> str:
    return f"{name}({inner})" if inner else name
