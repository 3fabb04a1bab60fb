"""A program whose statements have switches: TypedProgram → `SwitchedProgram`, with `switched`.

    p(X) :- q(X).            p(X):-q(X),___on(3).        {___on(0..3)}.

An answer set then tells which statements are on, and is one of the program of these alone: a
search in which some switches are assumed to be on ranges over *every* program between those
statements and the whole.  Whether there is an answer set so becomes monotone: what is inconsistent
with some switches on stays so with more.

Consistency-restoring rules have no switch, since a program with one more of them has an answer set
wherever it has one without; preferences are left out, since they choose among answer sets only.
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.checking.typed_program import TypedProgram
from sparc.lazy_dataclass import dataclass
from sparc.syntax.tree import RangeFact, Rule
from sparc.translation.asp_program import AspProgram
from sparc.translation.translator import translate

__all__ = ["ON", "SwitchedProgram", "conditional", "parted", "switched"]

ON = "___on"
"""The auxiliary predicate of the switches: ``___on(i)`` for statement i."""

_PREFERENCES = (":~", "#minimize{", "#maximize{")


@dataclass(frozen=True)
class SwitchedProgram:
    """Lines of clingo, each with the index of its statement (None: sorts and the like).

    ``switches`` are the indices of the statements that have a switch and some ground instance at
    all; ``program`` is the plain translation.
    """

    program: AspProgram
    lines: tuple[tuple[int | None, str], ...]
    switches: tuple[int, ...]

    def asp(self, lines: Iterable[str], extra: Iterable[str] = ()) -> AspProgram:
        """Returns a program for clingo of these lines, that shows nothing."""
        return AspProgram("\n".join([*lines, *extra]), "#show.", places=self.program.places)

    def text(self) -> AspProgram:
        """Returns the program with a switch for every statement."""
        found = set(self.switches)
        lines = [
            conditional(line, f"{ON}({index})") if index in found else line
            for index, line in self.lines
        ]
        return self.asp(lines, [f"{{{ON}({index})}}." for index in self.switches])


def switched(typed: TypedProgram) -> SwitchedProgram:
    """Returns the translation of ``typed``, taken apart by statement."""
    program = translate(typed)
    statements = typed.program.statements
    at = {statement.span.start: index for index, statement in enumerate(statements)}
    lines: list[tuple[int | None, str]] = []
    indices: dict[int, None] = {}
    texts = program.text.split("\n") if program.text else []
    for text, span in zip(texts, program.line_spans, strict=True):
        index = None if span is None else at[span.start]
        if not text or text.startswith(_PREFERENCES):
            continue
        if index is not None and isinstance(statements[index], Rule | RangeFact):
            indices[index] = None
        lines.append((index, text))
    return SwitchedProgram(program, tuple(lines), tuple(indices))


def conditional(line: str, condition: str) -> str:
    """Returns the rule in ``line`` with one more condition.

    >>> conditional("p(a).", "c"), conditional("p(X):-q(X).", "c"), conditional(":-.", "c")
    ('p(a):-c.', 'p(X):-q(X),c.', ':-c.')
    """
    head, body = parted(line)
    return f"{head}:-{body},{condition}." if body else f"{head}:-{condition}."


def parted(line: str) -> tuple[str, str]:
    """Head and body of a rule as the translation writes it; each may be empty.

    >>> parted("p(X):-q(X)."), parted(":-q."), parted("p.")
    (('p(X)', 'q(X)'), ('', 'q'), ('p', ''))
    """
    head, _, body = line.removesuffix(".").partition(":-")
    return head, body
