"""Programs of cases → which statements of the domain ever did something. Entry point `find_coverage`.

A rule *fires* in a case when its body is true in one of the case's answer sets.  A constraint fires
when it forbids something: with it alone relaxed there is an answer set that breaks it::

    head :- body.     becomes  head:-body.  and  __fired(7):-body.
    :- body.          becomes  :-body,not __relaxed(7).  and  __fired(7):-body.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sparc.lazy_dataclass import dataclass
from sparc.source import Source
from waiter_cli.domain_tests.ground_cases import GroundCases
from waiter_cli.domain_tests.programs import CaseProgram, Place
from waiter_cli.domain_tests.sentences import read_blocks, sentence_at

__all__ = ["Statement", "find_coverage"]


@dataclass(frozen=True)
class Statement:
    """A statement of a template: its place and text there, and the sentence that explains it."""

    place: Place
    text: str
    sentence: str
    fired: bool


def find_coverage(template: Source, programs: Sequence[CaseProgram]) -> tuple[Statement, ...]:
    """Returns each statement that is part of some case's program, in order, with whether it fired."""
    places: set[Place] = {p for program in programs for p in program.places if p is not None}
    numbers = {place: number for number, place in enumerate(sorted(places))}
    open_rules: set[int] = set(numbers.values())
    for program in programs:
        open_rules -= _fired(program, numbers, open_rules)
    texts = _texts(programs)
    blocks = read_blocks(template.text)
    return tuple(
        Statement(place, texts[place], sentence_at(blocks, place[0]), number not in open_rules)
        for place, number in numbers.items()
    )


def _texts(programs: Iterable[CaseProgram]) -> dict[Place, str]:
    from waiter_cli.domain_tests.programs import statement_place

    texts: dict[Place, str] = {}
    for program in programs:
        source = program.typed.program.source
        for statement in program.typed.program.statements:
            place = statement_place(statement.span, source.name)
            if place is not None:
                texts.setdefault(place, " ".join(statement.span.text.split()))
    return texts


def _fired(program: CaseProgram, numbers: dict[Place, int], wanted: set[int]) -> set[int]:
    """Returns those of the wanted statements that fire in a case of one program."""
    import clingo

    lines, constraints = _instrumented(program, numbers)
    bench = GroundCases(program, program.asp(lines))
    atoms = {
        symbol.arguments[0].number: symbol
        for atom in bench.control.symbolic_atoms.by_signature("__fired", 1)
        if (symbol := atom.symbol)
    }
    left = {number for number in atoms if number in wanted}
    fired: set[int] = set()
    for number, claims in enumerate(program.claims):
        if not left:
            break
        bench.select(number)
        base = bench.happening(claims.when) if program.cases[number].when is not None else []
        shown: set[int] = set()
        model = bench.model(base)
        if model is not None:
            shown = {one for one in left if atoms[one] in model}
            rules = left - constraints - shown
            shown |= {one for one in rules if bench.possible([*base, (atoms[one], True)])}
        for one in left & constraints:
            relaxed = clingo.Function("__relaxed", [clingo.Number(one)])
            bench.control.assign_external(relaxed, True)
            if bench.possible([*base, (atoms[one], True)]):
                shown.add(one)
            bench.control.assign_external(relaxed, False)
        fired |= shown
        left -= shown
    return fired


def _instrumented(
    program: CaseProgram, numbers: dict[Place, int]
) -> tuple[list[str], frozenset[int]]:
    """Returns the lines that tell which statements fire, and the numbers of those
    that are constraints.
    """
    lines: list[str] = []
    constraints: set[int] = set()
    for line, place in zip(program.lines, program.places, strict=True):
        if place is None:
            lines.append(line)
            continue
        number = numbers[place]
        head, _, body = line.rstrip(".").partition(":-")
        if head:
            lines.append(line)
            lines.append(f"__fired({number}):-{body}." if body else f"__fired({number}).")
        else:
            constraints.add(number)
            lines.append(f":-{body},not __relaxed({number}).")
            lines.append(f"#external __relaxed({number}).")
            lines.append(f"__fired({number}):-{body}.")
    return lines, frozenset(constraints)
