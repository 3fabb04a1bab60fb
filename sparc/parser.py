"""Reads a SPARC program: Source → Program, with :func:`parse`.

The parser is written by hand, one method a grammar rule, under the rule's name in
``grammar.txt``.  It stops at the first fault.  Where input may nest (terms, set expressions,
conditions of records) it keeps its own stack instead of calling itself, and no tree it returns is
deeper than ``MAX_DEPTH``: whoever walks a tree may recurse.

>>> program = parse(Source("x.sparc", "predicates\\np().\\nrules\\np :- not -p.\\n"))
>>> program.statements[0].body[0].operand
Atom(name='p', arguments=(), negated=True)

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Syntax; section by section in the order
directives, sorts, predicates, rules, display.
"""

from __future__ import annotations

import gc

from sparc.errors import SourceError, SparcSyntaxError
from sparc.lexer import SECTION_WORDS
from sparc.reader import BINDING, DIRECTIVES
from sparc.source import Source
from sparc.statement_parser import StatementParser
from sparc.syntax import (
    ConstDirective,
    DisplayItem,
    DisplaySort,
    MaxintDirective,
    PredicateDeclaration,
    Program,
    SortDefinition,
    SortName,
)

__all__ = ["parse"]


def parse(source: Source) -> Program:
    """The tree of the program ``source``.

    Raises :class:`SparcSyntaxError` at the first fault, or :class:`LimitError` for a program
    that is too large, nested too deeply, or has a number beyond ``MAX_NUMBER``.
    """
    parser = _Parser(source)
    collecting = gc.isenabled()
    gc.disable()  # a tree has no cycles, and looking for some doubles the time of a long program
    try:
        return parser.program()
    finally:
        if collecting:
            gc.enable()


class _Parser(StatementParser):
    """Reads whole programs."""

    __slots__ = ()

    # ------------------------------------------------------------ program and sections

    def program(self) -> Program:
        """``program = directives ["sorts" sort_definitions] "predicates" predicate_declarations
        "rules" statements ["display" display] END``
        """
        directives = self.directives()
        sorts: tuple[SortDefinition, ...] = ()
        if self.kinds[self.at] == "section" and self.texts[self.at] == "sorts":
            self.at += 1
            sorts = self.sort_definitions()
            self.section("predicates", 'a sort definition or the section word "predicates"')
        else:
            self.section("predicates", 'the section word "sorts" or "predicates"')
        predicates = self.predicate_declarations()
        self.section("rules", 'a predicate declaration or the section word "rules"')
        statements = self.statements()
        display = None
        if self.kinds[self.at] == "section" and self.texts[self.at] == "display":
            self.at += 1
            display = self.display()
        if self.kinds[self.at] != "end":
            where = "an item to display" if display is not None else "a rule"
            raise self.misplaced(f"{where} or the end of the file")
        return Program(directives, sorts, predicates, statements, display, self.source)

    def section(self, word: str, expected: str) -> None:
        """Reads the section word ``word``."""
        if self.kinds[self.at] != "section" or self.texts[self.at] != word:
            raise self.misplaced(expected)
        self.at += 1

    def misplaced(self, expected: str) -> SourceError:
        """The fault that neither a statement nor the right section word follows."""
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
        elif kind in ("identifier", "variable"):
            import difflib  # only for the message: it costs time to load

            near = difflib.get_close_matches(text.lower(), SECTION_WORDS, 1)
            hint = f'did you mean "{near[0]}"?' if near else None if self.at else sections
        return self.unexpected(expected, hint)

    def directives(self) -> tuple[ConstDirective | MaxintDirective, ...]:
        """``directives = {"#const" IDENTIFIER "=" value "." | "#maxint" "=" value "."}``"""
        found: list[ConstDirective | MaxintDirective] = []
        while (word := self.texts[self.at]) in DIRECTIVES:
            first = self.at
            self.at += 1
            name = ""
            if word == "#const":
                name = self.texts[self.at]
                self.expect("identifier", "the name of a constant (a lower-case identifier)")
                self.constants.add(name)
            self.expect("=", '"="')
            hint = None
            if self.kinds[self.at] == "-":
                hint = "there are no negative numbers: write 0-n where the constant is used"
            value = self.value(hint)
            if self.kinds[self.at] in BINDING:
                raise self.unexpected('"."', "a directive takes a plain number: work it out")
            self.expect(".", '"."')
            if word == "#const":
                span = self.span(first)
                found.append(ConstDirective(name, value, span, self.token_span(first + 1)))
            else:
                found.append(MaxintDirective(value, self.span(first)))
        return tuple(found)

    # ------------------------------------------------------------ predicates

    def predicate_declarations(self) -> tuple[PredicateDeclaration, ...]:
        """``predicate_declarations = {IDENTIFIER "(" [sort_name {"," sort_name}] ")" "."}``"""
        found: list[PredicateDeclaration] = []
        while self.kinds[self.at] == "identifier":
            first = self.at
            name = self.texts[first]
            if self.kinds[first + 1] not in ("(", ".") and name.rstrip("s") + "s" in SECTION_WORDS:
                raise self.misplaced("a predicate declaration")
            self.at += 1
            hint = None
            if self.kinds[self.at] == ".":
                hint = f"a predicate without arguments is declared {name}()."
            self.expect("(", '"("', hint)
            sorts: list[SortName] = []
            if self.kinds[self.at] != ")":
                sorts.append(self.sort_name())
                while self.kinds[self.at] == ",":
                    self.at += 1
                    sorts.append(self.sort_name())
            hint = None
            if self.kinds[self.at] == "(":
                hint = "the arguments of a predicate are plain sort names"
            self.expect(")", '"," or ")"' if sorts else 'a sort name or ")"', hint)
            self.expect(".", '"."')
            span = self.span(first)
            found.append(PredicateDeclaration(name, tuple(sorts), span, self.token_span(first)))
        return tuple(found)

    # ------------------------------------------------------------ display

    def display(self) -> tuple[DisplayItem | DisplaySort, ...]:
        """``display = {display_item "."}``"""
        found: list[DisplayItem | DisplaySort] = []
        while self.kinds[self.at] not in ("end", "section"):
            first = self.at
            kind = self.kinds[first]
            negated = kind == "-"
            if negated:
                if self.kinds[first + 1] == "identifier" and not self.touches_next(first):
                    raise self.negation_apart(first)
                self.at += 1
                kind = self.kinds[self.at]
            name = self.at
            is_sort = kind == "sort name" and not negated
            if kind != "identifier" and not is_sort:
                raise self.not_displayed(negated)
            text = self.texts[name]
            if is_sort:
                self.refuse_foreign("an item to display")
            self.at += 1
            arguments = self.arguments() if self.kinds[self.at] == "(" else None
            if is_sort and arguments is not None and len(arguments) != 1:
                raise SparcSyntaxError(
                    f"a sort has one argument, found {len(arguments)}",
                    self.span(name),
                    f"write {text}. or {text}(X).",
                )
            hint = None
            if self.kinds[self.at] == ",":
                hint = 'each item ends with "."'
            elif self.kinds[self.at] in ("/", ":-"):
                hint = f"write {text}. to show all of it"
            self.expect(".", '"."' if arguments is not None else '"(" or "."', hint)
            span, name_span = self.span(first), self.token_span(name)
            if is_sort:
                argument = arguments[0] if arguments else None
                found.append(DisplaySort(text[1:], argument, span, name_span))
            else:
                found.append(DisplayItem(text, arguments, negated, span, name_span))
        return tuple(found)

    def not_displayed(self, negated: bool) -> SourceError:
        """The fault that something cannot be displayed."""
        hint = None
        if negated and self.kinds[self.at] == "sort name":
            hint = "a sort has no negation"
        elif self.kinds[self.at] == "not":
            hint = "write -p to show the negative literals"
        elif self.kinds[self.at] == ":-":
            hint = "rules stand before the section display"
        return self.unexpected("a predicate or a sort to display", hint)
