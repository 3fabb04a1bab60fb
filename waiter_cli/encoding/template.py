"""Template, `Problem`, horizon → `sparc.Source`: a SPARC program about one restaurant.

Entry points `read_template`, `fill_template`.  A template is a SPARC program with comment lines as marks::

    %{ nodes          up to the next line "%}": replaced by the slot of that name
    %? bar            up to its line "%.": kept only where the problem has that part; may nest

Every line of the result knows the line of the template or of the user's YAML that it came from.
Slots and parts are those of `waiter_cli.encoding.slots`; a template uses those it needs.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import cache, lru_cache

from sparc.lazy_dataclass import dataclass
from sparc.source import Origin, Source
from sparc.spelling import nearest
from waiter_cli.encoding.declarations import require_places
from waiter_cli.encoding.facts import ProgramLine
from waiter_cli.encoding.house_words import require_house_words
from waiter_cli.encoding.marks import Mark, MarkKind, mark_of
from waiter_cli.encoding.own_words import observed_lines, require_own_words
from waiter_cli.encoding.slots import PARTS, SITUATION, SLOTS, parts_of
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = [
    "TemplatePart",
    "TemplatePiece",
    "TemplateSlot",
    "fill_pieces",
    "fill_template",
    "read_template",
    "require_robots",
    "slot_names",
    "state_lines",
]


@dataclass(frozen=True)
class TemplateSlot:
    """A slot of a template: its name, and the line of its mark."""

    name: str
    line: int


@dataclass(frozen=True)
class TemplatePart:
    """An optional part of a template: its name, the line of its mark, and what stands in it."""

    name: str
    line: int
    pieces: tuple[TemplatePiece, ...]


# A template is a sequence of plain lines (number, text), slots and parts.
TemplatePiece = tuple[int, str] | TemplateSlot | TemplatePart


@cache
def read_template(
    source: Source,
    slots: frozenset[str] = frozenset(SLOTS),
    parts: frozenset[str] = frozenset(PARTS),
) -> tuple[TemplatePiece, ...]:
    """Returns the pieces of a template that may use these slots and parts.

    Raises `InputError` with every mark that is unknown, never closed or never begun.
    """
    reader = _TemplateReader(source, slots, parts)
    for number, text in enumerate(source.text.split("\n"), source.first_line):
        reader.line(number, text)
    return reader.finish()


class _TemplateReader:
    """Takes the lines of a template one by one; ``stack`` holds the parts that are open."""

    def __init__(self, source: Source, slots: frozenset[str], parts: frozenset[str]) -> None:
        self.source = source
        self.slots = slots
        self.parts = parts
        self.faults: list[Fault] = []
        self.stack: list[tuple[str, int, list[TemplatePiece]]] = [("", 0, [])]
        self.slot: TemplateSlot | None = None

    def line(self, number: int, text: str) -> None:
        mark = mark_of(text)
        if self.slot is not None:
            self._in_slot(self.slot, number, mark)
        elif mark is None:
            self.stack[-1][2].append((number, text))
        elif mark.kind is MarkKind.SLOT:
            self._must_be_known("slot", mark.name, self.slots, number)
            self.slot = TemplateSlot(mark.name, number)
        elif mark.kind is MarkKind.PART:
            self._must_be_known("part", mark.name, self.parts, number)
            self.stack.append((mark.name, number, []))
        elif mark.kind is MarkKind.PART_END and len(self.stack) > 1:
            name, start, pieces = self.stack.pop()
            self.stack[-1][2].append(TemplatePart(name, start, tuple(pieces)))
        else:
            what, begin = (
                ("slot", "%{ SLOT") if mark.kind is MarkKind.SLOT_END else ("part", "%? PART")
            )
            hint = f'remove this line, or write "{begin}" above'
            self._fault(number, f"a {what} ends that never began", hint)

    def _in_slot(self, slot: TemplateSlot, number: int, mark: Mark | None) -> None:
        """Takes a line between the marks of a slot: an example of what it is filled with, or the end."""
        if mark is None:
            return
        if mark.kind is MarkKind.SLOT_END:
            self.stack[-1][2].append(slot)
        else:
            message = f"slot {slot.name} is still open here"
            self._fault(number, message, 'close it with a line "%}"')
        self.slot = None

    def finish(self) -> tuple[TemplatePiece, ...]:
        if self.slot is not None:
            message = f"slot {self.slot.name} is never closed"
            self._fault(self.slot.line, message, 'add a line "%}" after it')
        for name, start, _ in self.stack[1:]:
            self._fault(start, f"part {name} is never closed", 'add a line "%." after it')
        if self.faults:
            raise InputError(sorted(self.faults))
        return tuple(self.stack[0][2])

    def _must_be_known(self, kind: str, name: str, known: frozenset[str], number: int) -> None:
        if name not in known:
            message = f"unknown {kind} {name}" if name else f"a {kind} without a name"
            self._fault(number, message, _nearest(name, known), name)

    def _fault(self, number: int, message: str, hint: str, name: str = "") -> None:
        """Adds a fault at the mark of a line, or at the name behind it."""
        text = self.source.text.split("\n")[number - self.source.first_line].rstrip()
        at = text.index("%")
        column = text.index(name, at + 2) + 1 if name else at + 1
        self.faults.append(Fault(Where(self.source.name, number, column), message, hint, text))


def slot_names(template: Source) -> tuple[str, ...]:
    """Returns the names of a template's slots, in their order.

    Raises `InputError` when a mark of the template is wrong.
    """
    names: list[str] = []
    todo = list(reversed(read_template(template)))
    while todo:
        piece = todo.pop()
        if isinstance(piece, TemplateSlot):
            names.append(piece.name)
        elif isinstance(piece, TemplatePart):
            todo.extend(reversed(piece.pieces))
    return tuple(names)


def _nearest(name: str, known: Iterable[str]) -> str:
    names = sorted(known)
    close = nearest(name, names)
    return f"did you mean {close}?" if close else f"known are {', '.join(names)}"


def fill_template(
    template: Source,
    problem: Problem,
    horizon: int,
    offer: Plan | None = None,
    without: Collection[str] = (),
) -> Source:
    """Returns the SPARC program for a problem with steps 0..``horizon``.

    With an ``offer`` the program may choose that plan's actions only, where the template has the
    parts ``choice`` and ``offer``: whether it accepts the plan is then quickly told.  The slots
    named in ``without`` stay empty.

    Raises `InputError` when a mark of the template is wrong, or when the problem asks for
    something that a slot of this template has no words for.
    """

    _require_words(template, problem)
    if problem.has_own_words and not SITUATION.issubset(without):
        _require_own(template, problem)

    def lines_of(name: str) -> Iterable[ProgramLine]:
        if name in without:
            return ()
        if name == "observations":
            return [*SLOTS[name](problem, horizon), *observed_lines(template, problem)]
        if name == "state":
            return state_lines(template, problem)
        return SLOTS[name](problem, horizon) if name != "offer" else _offer(offer)

    have = parts_of(problem) | {"choice" if offer is None else "offer"}
    return fill_pieces(template.name, read_template(template), lines_of, have)


def state_lines(template: Source, problem: Problem) -> list[ProgramLine]:
    """Returns what holds; without the chairs that the layout has, where a domain has no word for them."""
    lines = SLOTS["state"](problem, 0)
    if "has_chairs(" in template.text:
        return lines
    return [line for line in lines if not line.text.startswith("holds(has_chairs(")]


@lru_cache(maxsize=8)
def _require_own(template: Source, problem: Problem) -> None:
    """Raises `InputError` where the domain does not know what the problem says in its words."""
    names = frozenset(slot_names(template))
    if not names & {"state", "guest_state"}:
        message = "this domain takes no situation: it has no slot state"
        hint = 'add lines "%{ state" and "%}" to its rules'
        raise InputError([Fault(Where(template.name, 1, 1), message, hint)])
    require_own_words(problem, fill_template(template, problem, 1, None, SITUATION))


def _require_words(template: Source, problem: Problem) -> None:
    """Raises `InputError` where the layout has what the template has no words for."""
    layout = problem.layout
    require_places(template, layout)
    require_house_words(template, slot_names(template), problem)
    require_robots(template, layout)
    if not layout.one_way or "one_way" in (names := slot_names(template)) or "edges" not in names:
        return
    wheres = layout.edge_where or (None,) * len(layout.edges)
    where = next(w for edge, w in zip(layout.edges, wheres) if edge in layout.one_way)
    message = "this domain knows no one-way paths"
    hint = "give its template a slot one_way, as domains/restaurant has it, or write [n1, n2]"
    raise InputError([Fault(where, message, hint)])


def require_robots(template: Source, layout: Layout) -> None:
    """Raises `InputError` where the layout has several robots, and the template words for one only."""
    if layout.agents and "agents" not in slot_names(template):
        where = dict(layout.key_where).get("agents")
        message = "several robots: this domain is for one robot"
        raise InputError([Fault(where, message, "take --domain restaurant, or write agent: NODE")])


def fill_pieces(
    name: str,
    pieces: Sequence[TemplatePiece],
    lines_of: Callable[[str], Iterable[ProgramLine]],
    have: Collection[str] = (),
) -> Source:
    """Returns the program that the pieces of the template called ``name`` make.

    ``lines_of`` gives the lines of a slot by its name; of the parts those in ``have`` are kept.
    """
    lines: list[str] = []
    origins: list[Origin | None] = []
    todo: list[TemplatePiece] = list(reversed(pieces))
    while todo:
        piece = todo.pop()
        if isinstance(piece, TemplateSlot):
            for line in lines_of(piece.name):
                lines.append(line.text)
                origins.append(_origin(line, name, piece.line))
        elif isinstance(piece, TemplatePart):
            if piece.name in have:
                todo.extend(reversed(piece.pieces))
        else:
            number, text = piece
            lines.append(text)
            origins.append(Origin(name, number, verbatim=True))
    return Source(name, "\n".join(lines), 1, tuple(origins))


def _origin(line: ProgramLine, template: str, number: int) -> Origin:
    if line.where is not None and line.where.line:
        return Origin(line.where.name, line.where.line, line.where.column, line.text)
    return Origin(template, number, 1, line.text)


def _offer(plan: Plan | None) -> list[ProgramLine]:
    actions = plan.actions if plan is not None else ()
    return [ProgramLine(f"offered({action.text}, {action.step}).") for action in actions]
