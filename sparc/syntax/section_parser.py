"""Reads the small sections of a program: directives, predicates, display.

>>> from sparc.source import Source
>>> SectionParser(Source("", "p(#a, #b). q().")).predicate_declarations()[1].name
'q'

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Syntax; each method has its grammar rule.
"""

from __future__ import annotations

from sparc.errors import SourceError, SparcSyntaxError
from sparc.spelling import nearest
from sparc.syntax.cursor import BINDING, DIRECTIVES
from sparc.syntax.lexer import SECTION_WORDS
from sparc.syntax.statement_parser import StatementParser
from sparc.syntax.tree import (
    ConstDirective,
    DisplayItem,
    DisplaySort,
    MaxintDirective,
    PredicateDeclaration,
    SortName,
)

__all__ = ["SectionParser"]


class SectionParser(StatementParser):
    """Reads what stands before and behind the rules."""

    __slots__ = ()

    # ------------------------------------------------------------ directives

    def directives(self) -> tuple[ConstDirective | MaxintDirective, ...]:
        """``directives = {"#const" IDENTIFIER "=" value "." | "#maxint" "=" value "."}``"""
        directives: list[ConstDirective | MaxintDirective] = []
        while self.texts[self.at] in DIRECTIVES:
            first = self.at
            try:
                directives.append(self.directive())
            except SourceError as error:
                self.recover(error, first)
                names = zip(self.kinds[first : self.at], self.texts[first : self.at])
                self.constants.update(text for kind, text in names if kind == "identifier")
        return tuple(directives)

    def directive(self) -> ConstDirective | MaxintDirective:
        """Returns one of the :meth:`directives`."""
        first = self.at
        word = self.texts[first]
        self.at += 1
        name = ""
        if word == "#const":
            name = self.texts[self.at]
            hint = None
            if self.kinds[self.at] == "variable":
                hint = f"constants begin with a lower-case letter: {name[0].lower()}{name[1:]}"
            self.expect("identifier", "the name of a constant (a lower-case identifier)", hint)
            self.constants.add(name)
        self.expect("=", '"="', f"write {word} {name} = 3." if name else None)
        hint = None
        if self.kinds[self.at] == "-":
            hint = "there are no negative numbers: write 0-n where the constant is used"
        value = self.value(hint)
        if self.kinds[self.at] in BINDING:
            raise self.unexpected(
                '"."', "a directive takes a plain number: work it out", may_end=True
            )
        hint = "each constant has a directive of its own" if self.kinds[self.at] == "," else None
        self.expect(".", '"."', hint)
        if word == "#const":
            return ConstDirective(name, value, self.span(first), self.token_span(first + 1))
        return MaxintDirective(value, self.span(first))

    # ------------------------------------------------------------ predicates

    def predicate_declarations(self) -> tuple[PredicateDeclaration, ...]:
        """``predicate_declarations = {IDENTIFIER "(" [sort_name {"," sort_name}] ")" "."}``"""
        declarations: list[PredicateDeclaration] = []
        names: set[str] = set()
        while self.kinds[self.at] == "identifier":
            first = self.at
            name = self.texts[first]
            if self.is_near_section() or self.is_rule(names):
                break
            names.add(name)
            try:
                declarations.append(self.predicate_declaration())
            except SourceError as error:
                self.recover(error, first)
        return tuple(declarations)

    def predicate_declaration(self) -> PredicateDeclaration:
        """Returns one of the :meth:`predicate_declarations`."""
        first = self.at
        name = self.texts[first]
        self.at += 1
        hint = None
        if self.kinds[self.at] == ".":
            hint = f"a predicate without arguments is declared {name}()."
        elif self.kinds[self.at] == "/":
            hint = f"the arguments are told by their sorts: {name}(#s,#t)."
        self.expect("(", '"("', hint)
        sorts: list[SortName] = []
        if self.kinds[self.at] != ")":
            sorts.append(self.sort_name())
            while self.kinds[self.at] == ",":
                self.at += 1
                sorts.append(self.sort_name())
        hint = None
        if self.kinds[self.at] in ("(", ":"):
            hint = "the arguments of a predicate are plain sort names"
        self.expect(")", '"," or ")"' if sorts else 'a sort name or ")"', hint)
        hint = 'each declaration ends with "."' if self.kinds[self.at] == "," else None
        self.expect(".", '"."', hint)
        return PredicateDeclaration(name, tuple(sorts), self.span(first), self.token_span(first))

    def is_near_section(self) -> bool:
        """Returns whether the next token is a section word that is misspelt."""
        word, following = self.texts[self.at], self.kinds[self.at + 1]
        if following in ("(", "."):
            return following == "." and word in SECTION_WORDS
        if self.on_new_line(self.at + 1):
            return nearest(word, SECTION_WORDS) is not None
        return word.rstrip("s") + "s" in SECTION_WORDS

    def is_rule(self, declared: set[str]) -> bool:
        """Returns whether a rule begins here, among the predicates that were ``declared``."""
        opens = self.kinds[self.at + 1] == "("
        is_plain = opens and self.kinds[self.at + 2] in ("sort name", "#", ")")
        known = self.texts[self.at] in declared
        if is_plain and not known:
            return False
        from sparc.syntax.recovery import has_rule_sign  # only for slips: it costs time to load

        if self.is_ahead("rules"):
            return False
        return (known and not is_plain) or has_rule_sign(self, self.at)

    def is_ahead(self, word: str) -> bool:
        """Returns whether a section is opened by its word further down."""
        sections = zip(self.kinds[self.at :], self.texts[self.at :])
        return ("section", word) in sections

    # ------------------------------------------------------------ display

    def display(self) -> tuple[DisplayItem | DisplaySort, ...]:
        """``display = {display_item "."}``"""
        items: list[DisplayItem | DisplaySort] = []
        opened = self.at - 1
        misplaced = False
        while self.kinds[self.at] not in ("end", "section"):
            first = self.at
            try:
                items.append(self.display_item())
            except SourceError as error:
                from sparc.syntax.recovery import has_rule_sign  # only for slips

                if not has_rule_sign(self, first):
                    self.recover(error, first)
                    continue
                self.at = first
                if not misplaced:
                    self.reported = first
                    self.keep(self.rule_in_display(opened))
                misplaced = True
                self.skipped_rule()
        return tuple(items)

    def rule_in_display(self, opened: int) -> SourceError:
        """Returns the fault that a rule stands behind the section word with the index ``opened``."""
        line = self.token_span(opened).location.line
        return self.fault(
            "a rule cannot stand in the section display",
            self.at,
            f"rules stand before the section display (line {line})",
        )

    def skipped_rule(self) -> None:
        """Reads a rule that stands in the wrong section, for its own faults."""
        first = self.at
        try:
            self.statement()
        except SourceError as error:
            self.recover(error, first)

    def display_item(self) -> DisplayItem | DisplaySort:
        """Returns one item of the section ``display``."""
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
        elif self.kinds[self.at] == "/":
            hint = f"write {text}. to show all of it"
        self.expect(".", '"."' if arguments is not None else '"(" or "."', hint)
        span, name_span = self.span(first), self.token_span(name)
        if is_sort:
            argument = arguments[0] if arguments else None
            return DisplaySort(text[1:], argument, span, name_span)
        return DisplayItem(text, arguments, negated, span, name_span)

    def not_displayed(self, negated: bool) -> SourceError:
        """Returns the fault that something cannot be displayed."""
        hint = None
        if negated and self.kinds[self.at] == "sort name":
            hint = "a sort has no negation"
        elif self.kinds[self.at] == "not":
            hint = "write -p to show the negative literals"
        return self.unexpected("a predicate or a sort to display", hint)
