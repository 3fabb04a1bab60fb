"""Template, `Problem`, horizon → `sparc.Source`: a SPARC program about one restaurant.

Entry point `fill_template`.  A template is a SPARC program with comment lines as marks::

    %{ nodes          up to the next line "%}": replaced by the slot of that name
    %? bar            up to its line "%.": kept only where the problem has that part; may nest

Every line of the result knows the line of the template or of the user's YAML that it came from.
Slots and parts are those of `waiter_cli.encoding.slots`; a template uses those it needs.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from functools import cache

from sparc.lazy_dataclass import dataclass
from sparc.source import Origin, Source
from waiter_cli.encoding.facts import ProgramLine
from waiter_cli.encoding.slots import PARTS, SLOTS, parts_of
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = ["fill_template", "read_template"]


@dataclass(frozen=True, slots=True)
class _Slot:
    name: str
    line: int
    default: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True)
class _Part:
    name: str
    line: int
    pieces: tuple[_Piece, ...]


# A template is a sequence of plain lines (number, text), slots and parts.
_Piece = tuple[int, str] | _Slot | _Part


@cache
def read_template(source: Source) -> tuple[_Piece, ...]:
    """The pieces of a template; raises `InputError` at a mark that is unknown or never closed."""
    faults: list[Fault] = []
    stack: list[tuple[str, int, list[_Piece]]] = [("", 0, [])]
    slot: tuple[str, int, list[tuple[int, str]]] | None = None
    lines = source.text.split("\n")

    def fault(number: int, message: str, hint: str, name: str = "") -> None:
        """At the mark in a line, or at the name behind it."""
        text = lines[number - source.first_line].rstrip()
        at = text.index("%")
        column = text.index(name, at + 2) + 1 if name else at + 1
        faults.append(Fault(Where(source.name, number, column), message, hint, text))

    for number, text in enumerate(lines, source.first_line):
        mark = text.strip() if text.lstrip().startswith("%") else ""
        if slot is not None:
            if mark == "%}":
                stack[-1][2].append(_Slot(slot[0], slot[1], tuple(slot[2])))
                slot = None
            elif mark.startswith(("%{", "%?")) or mark == "%.":
                fault(number, f"slot {slot[0]} is still open here", 'close it with a line "%}"')
                slot = None
            else:
                slot[2].append((number, text))
        elif mark.startswith("%{"):
            name = mark[2:].strip()
            if name not in SLOTS:
                message = f"unknown slot {name}" if name else "a slot without a name"
                fault(number, message, _nearest(name, SLOTS), name)
            slot = (name, number, [])
        elif mark.startswith("%?"):
            name = mark[2:].strip()
            if name not in PARTS:
                message = f"unknown part {name}" if name else "a part without a name"
                fault(number, message, _nearest(name, PARTS), name)
            stack.append((name, number, []))
        elif mark == "%.":
            if len(stack) == 1:
                fault(
                    number,
                    "a part ends that never began",
                    'remove this line, or write "%? PART" above',
                )
                continue
            name, start, pieces = stack.pop()
            stack[-1][2].append(_Part(name, start, tuple(pieces)))
        elif mark == "%}":
            fault(
                number, "a slot ends that never began", 'remove this line, or write "%{ SLOT" above'
            )
        else:
            stack[-1][2].append((number, text))
    if slot is not None:
        fault(slot[1], f"slot {slot[0]} is never closed", 'add a line "%}" after it')
    for name, start, _ in stack[1:]:
        fault(start, f"part {name} is never closed", 'add a line "%." after it')
    if faults:
        raise InputError(sorted(faults))
    return tuple(stack[0][2])


def _nearest(name: str, known: Iterable[str]) -> str:
    names = sorted(known)
    close = get_close_matches(name, names, 1)
    return f"did you mean {close[0]}?" if close else f"known are {', '.join(names)}"


def fill_template(
    template: Source, problem: Problem, horizon: int, offer: Plan | None = None
) -> Source:
    """The SPARC program for a problem with steps 0..``horizon``.

    With an ``offer`` the program may choose that plan's actions only, where the template has the
    parts ``choice`` and ``offer``: whether it accepts the plan is then quickly told.

    Raises `InputError` when a mark of the template is wrong, or when the problem asks for
    something that a slot of this template has no words for.
    """
    have = parts_of(problem) | {"choice" if offer is None else "offer"}
    lines: list[str] = []
    origins: list[Origin | None] = []
    todo: list[_Piece] = list(reversed(read_template(template)))
    while todo:
        piece = todo.pop()
        if isinstance(piece, _Slot):
            made = SLOTS[piece.name](problem, horizon) if piece.name != "offer" else _offer(offer)
            for line in made:
                lines.append(line.text)
                origins.append(_origin(line, template, piece.line))
        elif isinstance(piece, _Part):
            if piece.name in have:
                todo.extend(reversed(piece.pieces))
        else:
            number, text = piece
            lines.append(text)
            origins.append(Origin(template.name, number, verbatim=True))
    return Source(template.name, "\n".join(lines), 1, tuple(origins))


def _origin(line: ProgramLine, template: Source, number: int) -> Origin:
    if line.where is not None and line.where.line:
        return Origin(line.where.name, line.where.line, line.where.column, line.text)
    return Origin(template.name, number, 1, line.text)


def _offer(plan: Plan | None) -> list[ProgramLine]:
    actions = plan.actions if plan is not None else ()
    return [ProgramLine(f"offered({action.text}, {action.step}).") for action in actions]
