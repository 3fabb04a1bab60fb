"""Template, cases → `CaseProgram` values: programs that many cases share. Entry point `make_programs`.

Cases with the same restaurant, horizon and names become one program, translated and grounded
once.  What is given in a case holds under the atom ``__case(K)``, its ``facts`` under
``__facts(K)``, so that one case after another can be looked at::

    holds(currentlocation(agent, n1), 0).      becomes
    holds(currentlocation(agent,n1),0):-__case(3).

**Goals.**  A plan ends when its goals hold, and without goals they hold at once.  So that this does
not get in the way of a case that names none, it gets the goal 0, which is reached at the last step
and not before: ``required(0). reached(0, H).``, in domains that declare these predicates.

The literals of the cases are checked against the sorts of their program, by `claims`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.source import Origin, Source, Span
from sparc.translation.asp_program import AspProgram
from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.domain_tests.claims import Claims, ClaimsReader
from waiter_cli.encoding.own_words import observed_lines
from waiter_cli.encoding.slots import SITUATION, SLOTS, parts_of
from waiter_cli.encoding.template import fill_template, slot_names
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from sparc.checking.typed_program import TypedProgram

__all__ = ["CaseProgram", "Place", "make_programs", "statement_place"]

Place = tuple[int, int]
"""Line and column of a statement in the template."""


@dataclass(frozen=True)
class CaseProgram:
    """One program and the cases it decides; ``indices`` are theirs in the whole run.

    ``lines`` is the clingo text; ``places`` has for each line the statement of the template that
    it translates, None for what comes from a case or from the restaurant.
    """

    cases: tuple[Case, ...]
    claims: tuple[Claims, ...]
    indices: tuple[int, ...]
    typed: TypedProgram
    lines: tuple[str, ...]
    places: tuple[Place | None, ...]

    def asp(self, lines: Sequence[str] | None = None) -> AspProgram:
        """Returns the program for clingo, or a variant of its lines, with every atom shown."""
        externals = f"#external __case(0..{len(self.cases) - 1}). "
        externals += f"#external __facts(0..{len(self.cases) - 1})."
        return AspProgram("\n".join([*(self.lines if lines is None else lines), externals]), "")


def make_programs(template: Source, cases: Sequence[Case]) -> tuple[CaseProgram, ...]:
    """Returns the programs that decide the cases.

    Raises `InputError` with every fault of the cases' literals, and `SourceErrors` or
    `SourceError` where the domain or a fact is wrong.
    """
    slots = slot_names(template)
    groups: dict[object, list[int]] = {}
    for index, case in enumerate(cases):
        groups.setdefault(_key(case, slots), []).append(index)
    faults: list[Fault] = []
    programs = [
        _program(template, [cases[i] for i in group], group, faults) for group in groups.values()
    ]
    if faults:
        raise InputError(sorted(faults))
    return tuple(programs)


def statement_place(span: Span, template: str) -> Place | None:
    """Returns the place of a statement in the template of that name.

    None where it comes from elsewhere.
    """
    origin = span.source.origin(span.start)
    if origin is None or not origin.verbatim or origin.name != template:
        return None
    place = span.location
    return place.line, place.column


# ------------------------------------------------------------ the shared program


def _key(case: Case, slots: tuple[str, ...]) -> object:
    """Returns a key that the cases of one program have in common."""
    parts = parts_of(case.problem)
    made = []
    for name in slots:
        if name in SLOTS and name not in SITUATION:
            for line in SLOTS[name](case.problem, case.horizon):
                head, brace, names = line.text.partition("{")
                made.append((head, tuple(sorted(names.rstrip("}.").split(", "))) if brace else ()))
    return case.horizon, parts, case.offer is None, tuple(made)


def _program(
    template: Source, cases: list[Case], indices: list[int], faults: list[Fault]
) -> CaseProgram:
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse
    from sparc.translation.translator import translate

    name = template.name
    source, guards = _assemble(template, cases)
    typed = check(parse(source))
    asp = translate(typed)
    if asp.has_preferences:
        hint = "test the domain without its preferences"
        raise InputError([Fault(Where(name), "cases know no preferences among answer sets", hint)])
    lines: list[str] = []
    places: list[Place | None] = []
    for line, span in zip(asp.text.split("\n"), asp.line_spans, strict=True):
        guard = None if span is None else guards[span.source.line_index(span.start)]
        lines.append(line if guard is None else _guarded(line, guard))
        places.append(None if span is None else statement_place(span, name))
    for number, case in enumerate(cases):
        if not case.has_goals:
            lines += _goals_aside(typed, number, case.horizon)
    places += [None] * (len(lines) - len(places))
    reader = ClaimsReader(typed, faults)
    claims = tuple(reader.claims(case) for case in cases)
    return CaseProgram(tuple(cases), claims, tuple(indices), typed, tuple(lines), tuple(places))


def _assemble(template: Source, cases: list[Case]) -> tuple[Source, list[str | None]]:
    """Returns the program of several cases; for each of its lines the atom under which it holds."""
    first = cases[0]
    offer = None if first.offer is None else Plan((), first.horizon)
    filled = fill_template(template, first.problem, first.horizon, offer, SITUATION)
    own: list[tuple[str, Origin | None, str]] = []
    for number, case in enumerate(cases):
        for text, origin in _given_lines(case.problem, case.horizon, template, case.where):
            own.append((text, origin, f"__case({number})"))
        for step, said in enumerate(case.offer or ()):
            if said.text:
                own.append((*_written(said, f"offered({said.text}, {step})"), f"__case({number})"))
        for fact in case.facts:
            own.append((*_written(fact, fact.text), f"__facts({number})"))
    texts = filled.text.split("\n")
    start = next((i for i, text in enumerate(texts) if text.split("%")[0].strip() == "rules"), None)
    if start is None:
        hint = "give the word rules a line of its own"
        raise InputError([Fault(Where(template.name), "no line begins the rules", hint)])
    at = start + 1
    guards: list[str | None] = [None] * len(texts)
    origins = list(filled.origins)
    texts[at:at] = [text for text, _, _ in own]
    origins[at:at] = [origin for _, origin, _ in own]
    guards[at:at] = [guard for _, _, guard in own]
    return Source(filled.name, "\n".join(texts), 1, tuple(origins)), guards


def _written(said: SparcText, text: str) -> tuple[str, Origin]:
    """Returns a statement of a case as a line of the program, and where it comes from."""
    line = " ".join(text.split("\n")).rstrip()
    line += "" if line.endswith(".") else "."
    return line, Origin(said.where.name, said.where.line, said.where.column, said.excerpt or line)


def _given_lines(
    problem: Problem, horizon: int, template: Source, where: Where
) -> Iterable[tuple[str, Origin]]:
    for name in slot_names(template):
        if name in SITUATION:
            observed = observed_lines(template, problem) if name == "observations" else []
            for line in (*SLOTS[name](problem, horizon), *observed):
                place = line.where if line.where is not None and line.where.line else where
                yield line.text, Origin(place.name, place.line, place.column, line.text)


def _guarded(line: str, guard: str) -> str:
    """Returns a rule that holds under ``guard`` only."""
    rule = line.rstrip(".")
    return f"{rule},{guard}." if ":-" in line else f"{rule}:-{guard}."


def _goals_aside(typed: TypedProgram, number: int, horizon: int) -> list[str]:
    """Returns the rules that keep the goals of a domain out of the way of a case that names none."""
    required, reached = typed.predicates.get("required"), typed.predicates.get("reached")
    if required is None or len(required.sorts) != 1 or 0 not in required.sorts[0].extent:
        return []
    if reached is None or len(reached.sorts) != 2:
        return []
    return [f"required(0):-__case({number}).", f"reached(0,{horizon}):-__case({number})."]
