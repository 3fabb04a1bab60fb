"""Reads a SPARC program: Source → Program, with :func:`parse`.

The parser is written by hand, one method a grammar rule, under the rule's name in
``grammar.txt``.  It finds every fault of syntax: behind one it goes on with the next statement
(:mod:`sparc.syntax.recovery`).  Where input may nest (terms, set expressions, conditions of records) it
keeps its own stack instead of calling itself, and no tree it returns is deeper than
``MAX_DEPTH``: whoever walks a tree may recurse.

>>> program = parse(Source("x.sparc", "predicates\\np().\\nrules\\np :- not -p.\\n"))
>>> program.statements[0].body[0].operand
Atom(name='p', arguments=(), negated=True)

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Syntax; section by section in the order
directives, sorts, predicates, rules, display.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable

from sparc.errors import Edit, SourceError, SourceErrors
from sparc.garbage import count_all_as_old
from sparc.source import Source
from sparc.spelling import nearest
from sparc.syntax.cursor import DIRECTIVES
from sparc.syntax.lexer import SECTION_WORDS, Lexemes
from sparc.syntax.section_parser import SectionParser
from sparc.syntax.tree import (
    ConstDirective,
    DisplayItem,
    DisplaySort,
    MaxintDirective,
    PredicateDeclaration,
    Program,
    SortDefinition,
    Statement,
)

__all__ = ["ProgramParser", "in_order", "parse"]

_DIRECTIVES, _SORTS, _PREDICATES, _RULES, _DISPLAY = range(-1, 4)
_EXPECTED = {
    _DIRECTIVES: 'the section word "sorts" or "predicates"',
    _SORTS: 'a sort definition or the section word "predicates"',
    _PREDICATES: 'a predicate declaration or the section word "rules"',
    _RULES: "a rule or the end of the file",
    _DISPLAY: "an item to display or the end of the file",
}


def parse(source: Source) -> Program:
    """Returns the tree of the program ``source``.

    Raises the fault of syntax: a :class:`SparcSyntaxError`, or a :class:`LimitError` for a
    program that is too large, nested too deeply, or has a number beyond ``MAX_NUMBER``.  Where
    there are several, raises :class:`SourceErrors` with all of them (``MAX_FAULTS`` at most).
    """
    parser = ProgramParser(source)
    program = parser.program()
    if not parser.faults:
        return program
    if len(parser.faults) == 1:
        raise parser.faults[0]
    raise SourceErrors(in_order(parser.faults))


def in_order(faults: Iterable[SourceError]) -> list[SourceError]:
    """Returns faults in the order of the text."""
    return sorted(faults, key=lambda fault: fault.span.start if fault.span is not None else 0)


class ProgramParser(SectionParser):
    """Reads whole programs."""

    __slots__ = ("declarations", "definitions", "items", "opening", "reached", "rules")

    def __init__(self, source: Source, lexemes: Lexemes | None = None) -> None:
        super().__init__(source, lexemes)
        self.opening: tuple[ConstDirective | MaxintDirective, ...] = ()
        self.definitions: list[SortDefinition] = []
        self.declarations: list[PredicateDeclaration] = []
        self.rules: list[Statement] = []
        self.items: list[DisplayItem | DisplaySort] | None = None

    def recover(self, error: SourceError, first: int) -> None:
        """Keeps the fault that is meant, and moves on to the next statement.

        Raises :class:`SourceErrors` when there are ``MAX_FAULTS``.
        """
        from sparc.syntax.slips import recover  # only for faults: it costs time to load

        recover(self, error, first)

    def program(self) -> Program:
        """``program = directives ["sorts" sort_definitions] "predicates" predicate_declarations
        "rules" statements ["display" display] END``

        Keeps the faults; raises the one behind which nothing can be read.
        """
        collecting = gc.isenabled()
        gc.disable()  # a tree has no cycles, and looking for some doubles the time of a long program
        try:
            self.sections()
        finally:
            if collecting:
                count_all_as_old()
                gc.enable()
        return self.tree()

    def sections(self) -> None:
        """Reads one section after the other."""
        self.opening = self.directives()
        self.reached = section = _DIRECTIVES
        while True:
            if self.kinds[self.at] == "section":
                section = self.opened(section)
            elif self.kinds[self.at] != "end":
                section = self.slipped(section)
                self.reached = max(self.reached, section)
            else:
                break
            self.contents(section)
        if section < _RULES and not self.faults:
            self.keep(self.misplaced(_EXPECTED[section]))

    def tree(self) -> Program:
        """Returns what was read of the program until now."""
        return Program(
            self.opening,
            tuple(self.definitions),
            tuple(self.declarations),
            tuple(self.rules),
            None if self.items is None else tuple(self.items),
            self.source,
        )

    def contents(self, section: int) -> None:
        """Reads what belongs into a section, up to what does not."""
        if section == _SORTS:
            self.definitions += self.sort_definitions()
        elif section == _PREDICATES:
            self.declarations += self.predicate_declarations()
        elif section == _RULES:
            self.rules += self.statements()
        elif section == _DISPLAY:
            self.items = [*(self.items or ()), *self.display()]

    def opened(self, section: int) -> int:
        """Returns the section whose word comes next, behind ``section``; the word is read."""
        found = SECTION_WORDS.index(self.texts[self.at])
        before = self.reached
        if found != before + 1 and (before, found) != (_DIRECTIVES, _PREDICATES):
            self.keep(self.misplaced(_EXPECTED[section]))
        self.reached = max(before, found)
        self.at += 1
        return found

    def slipped(self, section: int) -> int:
        """Returns the section to go on with, where neither its contents nor a section word follow.

        The fault is kept; what cannot be read in any section is skipped.
        """
        first = self.at
        fault = self.misplaced(_EXPECTED[section])
        if "section" not in self.kinds and not {*map(str.lower, self.texts)} & {*SECTION_WORDS}:
            self.keep(fault)
            raise SourceErrors(self.faults) if len(self.faults) > 1 else fault
        near = self.near_section()
        if near is not None:
            self.at += 2 if self.kinds[first + 1] in (":", ".") else 1
            fault.edit = Edit(self.starts[first], self.end(self.at - 1), SECTION_WORDS[near])
            self.keep(fault)
            return near
        if self.texts[first] in DIRECTIVES:
            self.keep(fault)
            self.directives()
            return section
        home = self.home(section)
        if (
            home is None
            or home == section
            or (home > section and self.is_ahead(SECTION_WORDS[home]))
        ):
            self.recover(fault, first)
            return section
        self.reported = first
        if home > section:
            word, start = SECTION_WORDS[home], self.starts[first]
            if home != _SORTS:
                fault.hint = f'write the section word "{word}" before this'
            if home == section + 1 or (section, home) == (_DIRECTIVES, _PREDICATES):
                fault.edit = Edit(start, start, f"{word}\n")
        self.keep(fault)
        if home > section:
            return home
        self.contents(home)  # a few that are misplaced, and then the section goes on
        if self.at == first:
            self.recover(fault, first)
        return section

    def near_section(self) -> int | None:
        """Returns the section whose word is misspelt here, None when none is."""
        following = self.kinds[self.at + 1]
        if self.texts[self.at] in SECTION_WORDS and following == "sort name":
            return SECTION_WORDS.index(self.texts[self.at])
        if self.kinds[self.at] not in ("identifier", "variable") or following in ("(", "="):
            return None
        near = self.near_word()
        return SECTION_WORDS.index(near) if near is not None else None

    def near_word(self) -> str | None:
        """Returns the section word that the next word is nearly."""
        return nearest(self.texts[self.at].lower(), SECTION_WORDS)

    def home(self, section: int) -> int | None:
        """Returns the section that the next statement belongs to, by its looks; None when unknown."""
        at = self.at
        kind = self.kinds[at]
        if kind in ("sort name", "#"):
            word = at + (2 if kind == "#" else 1)
            return _SORTS if self.kinds[word] == "=" else _RULES if section < _RULES else None
        from sparc.syntax.recovery import has_rule_sign, statement_end

        if has_rule_sign(self, at):
            return _RULES
        if kind == "identifier" and section < _PREDICATES:
            inside = self.kinds[at : statement_end(self, at, at)]
            return _PREDICATES if "sort name" in inside or inside[1:3] == ["(", ")"] else None
        return _RULES if kind == "identifier" and section == _PREDICATES else None

    def misplaced(self, expected: str) -> SourceError:
        """Returns the fault that neither a statement nor the right section word follows."""
        kind, text = self.kinds[self.at], self.texts[self.at]
        sections = (
            "the sections are sorts, predicates, rules and display, in this order; "
            "predicates and rules must be there, though they may be empty"
        )
        hint = None
        if kind in ("section", "end"):
            hint = sections
        elif text in DIRECTIVES:
            hint = "directives come first, before the sorts"
        elif text in SECTION_WORDS:
            hint = f'white space must follow the section word "{text}"'
        elif kind == "sort name":
            hint = "sorts are defined in the first section, behind the word sorts"
        elif f"#{text}" in DIRECTIVES:
            hint = f"directives begin with #: write #{text}"
        elif kind == "identifier" and self.kinds[self.at + 1] == "=":
            hint = f"sort names begin with #: write #{text}"
        elif kind in ("identifier", "variable"):
            near = self.near_word()
            hint = f'did you mean "{near}"?' if near else None if self.at else sections
        return self.unexpected(expected, hint)
