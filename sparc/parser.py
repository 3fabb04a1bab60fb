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
from sparc.reader import BINDING, DIRECTIVES, RELATIONS
from sparc.sort_parser import SortParser
from sparc.source import Source
from sparc.syntax import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    ConstDirective,
    CrRule,
    DisplayItem,
    DisplaySort,
    Guard,
    Head,
    Identifier,
    Literal,
    MaxintDirective,
    Naf,
    Number,
    Optimize,
    PredicateDeclaration,
    Program,
    RangeFact,
    Rule,
    SortAtom,
    SortDefinition,
    SortName,
    Statement,
    Term,
    Variable,
    WeakConstraint,
)
from sparc.term_parser import TERM_STARTS, Operand

__all__ = ["parse"]

_AFTER_TERM = frozenset(RELATIONS) | frozenset(BINDING)
_AGGREGATES = {"#count": "count", "#sum": "sum", "#min": "min", "#max": "max"}
_OPTIMIZE = ("#minimize", "#maximize")
_FOREIGN = frozenset(
    ("#external", "#include", "#script", "#program", "#defined", "#project")
    + ("#heuristic", "#theory", "#import", "#times", "#avg", "#disjoint")
)  # words of other languages; each may still name a sort
_FOREIGN = frozenset(
    ("#external", "#include", "#script", "#program", "#defined", "#project")
    + ("#heuristic", "#theory", "#import", "#times", "#avg", "#disjoint")
)  # words of other languages; each may still name a sort


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


class _Parser(SortParser):
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

    # ------------------------------------------------------------ literals and bodies

    def body(self) -> tuple[BodyItem, ...]:
        """``body = body_item {"," body_item}``"""
        if self.kinds[self.at] == ".":
            raise self.unexpected("a literal", "write the body, or leave the connective out")
        items: list[BodyItem] = [self.body_item(True)]
        while self.kinds[self.at] == ",":
            self.at += 1
            items.append(self.body_item(True))
        return tuple(items)

    def literals(self) -> tuple[Literal, ...]:
        """``literals = body_item {"," body_item}``

        The condition of an element: no aggregate.
        """
        items: list[Literal] = []
        while not items or self.kinds[self.at] == ",":
            if items:
                self.at += 1
            item = self.body_item(False)
            assert not isinstance(item, Aggregate)
            items.append(item)
        return tuple(items)

    def body_item(self, aggregates: bool) -> BodyItem:
        """``body_item = atom | negated | sort_atom | naf | comparison | aggregate``

        An aggregate only where ``aggregates`` are allowed.
        """
        at = self.at
        kind = self.kinds[at]
        if kind == "identifier":
            following = self.kinds[at + 1]
            if following == "(":
                self.at += 1
                arguments = self.arguments()
                if self.kinds[self.at] in _AFTER_TERM:
                    return self.comparison(aggregates, at)
                return Atom(self.texts[at], arguments, False, self.span(at), self.token_span(at))
            if following in _AFTER_TERM:
                return self.comparison(aggregates, at)
            return self.atom()
        if kind == "not":
            return self.naf()
        if kind == "sort name":
            if self.texts[at] in _AGGREGATES and self.kinds[at + 1] == "{":
                return self.aggregate(None, at, aggregates)
            return self.sort_atom(False)
        if kind == "-":
            item = self.negated()
            if self.kinds[self.at] in _AFTER_TERM:
                self.at = at
                raise self.no_term(False)
            return item
        if kind in TERM_STARTS:
            return self.comparison(aggregates, at)
        hint = None
        if kind == "#":
            hint = "write a sort name without space after #"
        elif kind == "." and self.kinds[at - 1] == ",":
            hint = "leave out the comma before the dot"
        raise self.unexpected("a literal", hint)

    def atom(self) -> Atom:
        """``atom = IDENTIFIER [arguments]``

        An atom without ``-``.
        """
        at = self.at
        name = self.texts[at]
        if self.kinds[at] != "identifier":
            raise self.unexpected("an atom")
        self.at += 1
        arguments: tuple[Term, ...] = ()
        if self.kinds[self.at] == "(":
            arguments = self.arguments()
        return Atom(name, arguments, False, self.span(at), self.token_span(at))

    def negated(self) -> Atom | SortAtom:
        """``negated = "-" atom | "-" sort_atom``

        The ``-`` touches what it negates.
        """
        at = self.at
        following = self.kinds[at + 1]
        if following not in ("identifier", "sort name"):
            if following in ("number", "variable", "("):
                raise self.no_term(False)
            if following == "-":
                raise self.unexpected("an atom", '"-" stands once: "- -p" is p')
            self.at += 1
            raise self.unexpected('an atom after "-"')
        if not self.touches_next(at):
            word = self.texts[at + 1]
            raise self.unexpected("an atom", f'write "-{word}" without a space after "-"')
        self.at += 1
        if following == "sort name":
            return self.sort_atom(True)
        atom = self.atom()
        return Atom(atom.name, atom.arguments, True, self.span(at), atom.name_span)

    def sort_atom(self, negated: bool) -> SortAtom:
        """``sort_atom = SORT [arguments]``

        The checker wants one argument.
        """
        at = self.at
        text = self.texts[at]
        self.refuse_foreign("a literal")
        self.at += 1
        arguments: tuple[Term, ...] = ()
        if self.kinds[self.at] == "(":
            arguments = self.arguments()
        elif text in _AGGREGATES and self.kinds[self.at] != "{":
            raise self.unexpected(f'"{{" after {text}')
        span = self.span(at - 1 if negated else at)
        return SortAtom(text[1:], arguments, negated, span, self.token_span(at))

    def refuse_foreign(self, expected: str) -> None:
        """Raises when the next token is a directive, or a word of another language."""
        word = self.texts[self.at]
        if word in DIRECTIVES:
            raise self.unexpected(expected)
        if word in self.sorts:
            return
        if word in _OPTIMIZE:
            raise self.unexpected(expected, f"{word}{{…}}. is a statement of its own")
        if word in ("#show", "#hide"):
            hint = "what is shown goes into the section display, behind the rules"
            raise self.unexpected(expected, hint)
        if word in _FOREIGN:
            raise self.unexpected(expected, f"SPARC has no {word}")

    def naf(self) -> Naf:
        """``naf = "not" (atom | negated | sort_atom)``"""
        at = self.at
        self.at += 1
        kind = self.kinds[self.at]
        if self.touches_next(at):
            if kind == "(":
                raise self.fault(
                    'expected white space after "not", found "("',
                    self.at,
                    "write not p(X), without parentheses around the atom",
                )
            if kind != "bad":
                word = self.texts[self.at]
                if kind == "-" and self.touches_next(self.at):
                    word += self.texts[self.at + 1]
                raise self.fault(
                    f'expected white space after "not", found {self.found(self.at)}',
                    self.at,
                    f"write not {word}",
                )
        operand: Atom | SortAtom
        hint = None
        if kind == "identifier":
            operand = self.atom()
        elif kind == "-":
            operand = self.negated()
        elif kind == "sort name" and self.kinds[self.at + 1] != "{":
            operand = self.sort_atom(False)
        else:
            if kind == "not":
                hint = '"not" stands once before an atom: there is no double negation'
            elif kind == "sort name":
                hint = "an aggregate cannot be negated: turn its comparison round"
            elif kind in TERM_STARTS:
                hint = "a comparison cannot be negated: turn it round, < into >= and so on"
            raise self.unexpected('an atom after "not"', hint)
        if self.kinds[self.at] in _AFTER_TERM:
            raise self.unexpected(
                '"," or the end of the body',
                "a comparison cannot be negated: turn it round, < into >= and so on",
            )
        return Naf(operand, self.span(at))

    def comparison(self, aggregates: bool, first: int) -> Comparison | Aggregate:
        """``comparison = term relation term``

        Or an aggregate with a guard on the left.
        """
        self.at = first
        left = self.compound_term(False)
        relation = RELATIONS.get(self.kinds[self.at])
        if relation is None:
            hint = None
            if self.texts[self.at] in _AGGREGATES:
                hint = "a guard needs a comparison: write 1 <= #count{…}"
            elif self.kinds[self.at] == "{":
                hint = "a choice {…} stands only in a head; to count in a body use #count"
            raise self.unexpected('a comparison such as "=" or "<"', hint)
        operator_at = self.at
        self.at += 1
        if self.texts[self.at] in _AGGREGATES and self.kinds[self.at + 1] == "{":
            guard = Guard(relation, left, self.span(first))
            return self.aggregate(guard, first, aggregates)
        right = self.compound_term(False)
        if self.kinds[self.at] in RELATIONS:
            raise self.unexpected(
                '"," or the end of the body',
                "a comparison has two sides: write X < Y, Y < Z instead of X < Y < Z",
            )
        if relation not in ("=", "!=") and (
            (isinstance(left, (Number, Arithmetic)) and self.is_symbolic(right))
            or (isinstance(right, (Number, Arithmetic)) and self.is_symbolic(left))
        ):
            raise self.fault(
                f'"{self.texts[operator_at]}" compares a number with a symbolic term',
                operator_at,
                'between these only "=" and "!=" are allowed',
            )
        return Comparison(left, relation, right, self.span(first))

    def aggregate(self, left: Guard | None, first: int, allowed: bool) -> Aggregate:
        """``aggregate = [term relation] ("#count" | "#sum" | "#min" | "#max") "{"
        aggregate_element {";" aggregate_element} "}" [relation term]``

        The guard on the left, if any, has been read.
        """
        if not allowed:
            raise self.unexpected(
                "a literal", "an aggregate stands only in a body, not in a condition"
            )
        function = _AGGREGATES[self.texts[self.at]]
        self.at += 1
        elements: list[AggregateElement] = []
        while not elements or self.kinds[self.at] == ";":
            self.at += 1
            elements.append(self.aggregate_element())
        self.expect("}", '",", ";" or "}"')
        right = None
        at = self.at
        relation = RELATIONS.get(self.kinds[at])
        if relation is not None:
            self.at += 1
            right = Guard(relation, self.compound_term(False), self.span(at))
        elif self.kinds[at] in TERM_STARTS:
            raise self.unexpected(
                'a comparison, "," or "."', "a guard needs a comparison: #count{…} <= 2"
            )
        return Aggregate(function, tuple(elements), left, right, self.span(first))

    def aggregate_element(self) -> AggregateElement:
        """``aggregate_element = term {"," term} ":" literals``"""
        first = self.at
        terms = [self.compound_term(False)]
        while self.kinds[self.at] == ",":
            self.at += 1
            terms.append(self.compound_term(False))
        hint = self.touching_negation()
        if self.kinds[self.at] in ("}", ";"):
            hint = "each element has a condition: X : p(X)"
        self.expect(":", '"," or ":"', hint)
        condition = self.literals()
        return AggregateElement(tuple(terms), condition, self.span(first))

    def touching_negation(self) -> str | None:
        """What to do about ``:-`` where ``:`` and an atom with ``-`` are meant."""
        return 'part ":" and "-": write ": -p"' if self.kinds[self.at] == ":-" else None

    # ------------------------------------------------------------ heads and statements

    def statements(self) -> tuple[Statement, ...]:
        """``statements = {statement}``"""
        found: list[Statement] = []
        kinds = self.kinds
        while kinds[self.at] not in ("end", "section"):
            found.append(self.statement())
        return tuple(found)

    def statement(self) -> Statement:
        """``statement = rule | range_fact | weak_constraint | optimize``"""
        at = self.at
        kind = self.kinds[at]
        text = self.texts[at]
        if kind == ":~":
            return self.weak_constraint()
        if text in _OPTIMIZE and (self.kinds[at + 1] == "{" or text not in self.sorts):
            return self.optimize()
        name = at + 1 if kind == "-" else at
        if (
            self.kinds[name + 3] == ".."
            and self.kinds[name + 1] == "("
            and self.kinds[name] == "identifier"
        ):
            return self.range_fact()
        label = None
        if kind == "identifier" and self.kinds[at + 1] == ":":
            label = text
            self.at += 2
        return self.rule(at, label)

    def rule(self, first: int, label: str | None) -> Rule | CrRule:
        """``rule = head [":-" body] "." | ":-" body "." | [IDENTIFIER ":"] head ":+" [body] "." |
        ":+" body "."``
        """
        head: Head = ()
        if label is not None or self.kinds[self.at] not in (":-", ":+"):
            head = self.head()
        kind = self.kinds[self.at]
        body: tuple[BodyItem, ...] = ()
        if kind == ":+" or (kind == ":-" and label is None):
            self.at += 1
            if kind == ":-" or not head or self.kinds[self.at] != ".":
                body = self.body()
            self.end_of_body()
            if kind == ":-":
                return Rule(head, body, self.span(first))
            label_span = self.token_span(first)
            return CrRule(label, head, body, self.span(first), label_span)
        if label is not None:
            raise self.unexpected(
                '":+"', "only a consistency-restoring rule has a label: r : head :+ body."
            )
        if kind != ".":
            raise self.after_head(head)
        self.at += 1
        return Rule(head, (), self.span(first))

    def end_of_body(self) -> None:
        """Reads the dot behind a body."""
        hint = None
        if self.kinds[self.at] == "(":
            hint = "a parenthesis stands only in arithmetic and behind a name"
        self.expect(".", '"," or "."', hint)

    def after_head(self, head: Head) -> SourceError:
        """The fault that a head goes on where it cannot."""
        kind, text = self.kinds[self.at], self.texts[self.at]
        expected, hint = '"|", ":-", ":+" or "."', None
        if isinstance(head, Choice):
            expected = '":-", ":+" or "."'
            if kind == "|":
                hint = "a choice cannot stand in a disjunction"
            elif kind in (",", ";"):
                hint = "a rule has one choice: write a rule for each"
            elif kind == "{":
                hint = "a rule has one choice; does the one before end with a dot?"
        elif kind in (",", ";", "or") or (text == "v" and not self.on_new_line(self.at)):
            hint = 'the atoms of a disjunction are parted by "|"; '
            hint += "for several conclusions write a rule for each"
        elif kind in _AFTER_TERM:
            hint = "a comparison cannot be a head; to forbid its opposite write a constraint :- …"
        elif kind == ":":
            hint = "a label has no arguments; a condition stands only inside a choice"
        elif kind == "{":
            hint = "the bound of a choice is a number, a constant, a variable or arithmetic"
        return self.unexpected(expected, hint)

    def head(self) -> Head:
        """``head = choice | head_atom {"|" head_atom}``"""
        at = self.at
        kind = self.kinds[at]
        if kind == "{":
            return self.choice()
        if kind in ("variable", "number", "("):
            return self.choice()
        if kind == "identifier":
            following = self.kinds[at + 1]
            if following == "{" or following in _AFTER_TERM:
                return self.choice()
        atoms = [self.head_atom()]
        while self.kinds[self.at] == "|":
            self.at += 1
            atoms.append(self.head_atom())
        return tuple(atoms)

    def head_atom(self) -> Atom | SortAtom:
        """``head_atom = atom | negated | sort_atom``

        The checker refuses the sort atom.
        """
        at = self.at
        kind, text = self.kinds[at], self.texts[at]
        if kind == "identifier":
            return self.atom()
        if kind == "-":
            return self.negated()
        if kind == "sort name" and not (text in _AGGREGATES and self.kinds[at + 1] == "{"):
            self.refuse_foreign("a rule")
            return self.sort_atom(False)
        hint = None
        if kind == "sort name":
            hint = "an aggregate stands only in a body"
        elif kind == "not":
            hint = '"not" cannot stand in a head: move the literal into the body'
        elif kind == "{" and self.kinds[at - 1] == "|":
            hint = "a choice cannot stand in a disjunction"
        elif kind == "[":
            hint = "the weight of a weak constraint follows its dot: :~ body. [w:l]"
        elif kind == "#":
            hint = "write the name without space after #"
        raise self.unexpected("the head of a rule" if hint is None else "an atom", hint)

    def choice(self) -> Choice:
        """``choice = [bound [relation]] "{" choice_element {";" choice_element} "}" [[relation]
        bound]``

        A bound without a relation means ``<=``.
        """
        first = self.at
        left = None
        if self.kinds[first] != "{":
            bound = self.bound()
            relation = RELATIONS.get(self.kinds[self.at])
            if relation is not None:
                self.at += 1
            if self.kinds[self.at] != "{":
                raise self.unexpected(
                    '"{" of a choice',
                    "a rule begins with an atom, a choice, or :-"
                    if relation is None
                    else "a comparison cannot be a head; write a constraint, :- X >= Y",
                )
            left = Guard(relation or "<=", bound, self.span(first))
        elements: list[ChoiceElement] = []
        while not elements or self.kinds[self.at] == ";":
            self.at += 1
            elements.append(self.choice_element())
        mend = self.touching_negation()
        if self.kinds[self.at] in (",", "|"):
            mend = 'part the elements of a choice by ";"'
        expected = '",", ";" or "}"' if elements[-1].condition else '":", ";" or "}"'
        self.expect("}", expected, mend)
        right = None
        at = self.at
        kind = self.kinds[at]
        relation = RELATIONS.get(kind)
        if relation is not None:
            self.at += 1
            right = Guard(relation, self.bound(), self.span(at))
        elif kind in TERM_STARTS:
            if kind == "identifier" and self.texts[at] not in self.constants:
                raise self.unexpected('a bound, ":-", ":+" or "."')
            right = Guard("<=", self.bound(), self.span(at))
        return Choice(tuple(elements), left, right, self.span(first))

    def bound(self) -> Term:
        """``bound = term``

        A bound is no symbolic term.
        """
        first = self.at
        term = self.compound_term(False)
        if self.is_symbolic(term):
            span = self.span(first)
            self.raise_symbolic(
                Operand(term, span.start, span.end, 1),
                "the bound of a choice is a number, a constant, a variable or arithmetic",
            )
        return term

    def choice_element(self) -> ChoiceElement:
        """``choice_element = head_atom [":" literals]``"""
        first = self.at
        if self.kinds[first] == "}":
            raise self.unexpected("an atom", "a choice has an element at least")
        atom = self.head_atom()
        condition: tuple[Literal, ...] = ()
        if self.kinds[self.at] == ":":
            self.at += 1
            condition = self.literals()
        return ChoiceElement(atom, condition, self.span(first))

    def range_fact(self) -> RangeFact:
        """``range_fact = ["-"] IDENTIFIER "(" value ".." value ")" "."``"""
        first = self.at
        negated = self.kinds[first] == "-"
        if negated:
            if not self.touches_next(first):
                raise self.negation_apart(first)
            self.at += 1
        name = self.at
        self.at += 2
        low = self.value()
        self.at += 1
        hint = "there are no negative numbers in a range" if self.kinds[self.at] == "-" else None
        high = self.value(hint)
        if self.kinds[self.at] in BINDING:
            hint = "the ends of a range are numbers or constants: work it out"
        elif self.kinds[self.at] == ",":
            hint = "only a predicate with one argument may have a range"
        self.expect(")", '")"', hint)
        hint = None
        if self.kinds[self.at] in (":-", ":+", "|", ","):
            hint = "a range stands only in a fact p(m..n). of its own; in a rule use a sort"
        self.expect(".", '"."', hint)
        text, span = self.texts[name], self.span(first)
        return RangeFact(text, low, high, negated, span, self.token_span(name))

    def negation_apart(self, at: int) -> SourceError:
        """The fault that ``-`` does not touch the name behind it."""
        word = self.texts[at + 1]
        return self.unexpected("an atom", f'write "-{word}" without a space after "-"')

    def weak_constraint(self) -> WeakConstraint:
        """``weak_constraint = ":~" body "." ["[" weight "]"]``"""
        first = self.at
        self.at += 1
        body = self.body()
        self.end_of_body()
        weight = level = None
        if self.kinds[self.at] == "[":
            opened = self.at
            self.at += 1
            if self.kinds[self.at] not in (":", "]"):
                weight = self.parameter()
            if self.kinds[self.at] == ":":
                self.at += 1
                if self.kinds[self.at] != "]":
                    level = self.parameter()
            hint = None
            if self.kinds[self.at] == "@":
                hint = "weight and level are parted by a colon: [w:l]"
            elif self.kinds[self.at] in BINDING:
                hint = "weight and level are single numbers, constants or variables"
            self.expect("]", '":" or "]"' if level is None else '"]"', hint)
            if weight is None and level is None:
                raise self.fault(
                    "expected a weight or a level between the brackets", opened, "write [1:1]"
                )
            if self.kinds[self.at] == ".":
                raise self.unexpected(
                    "the next rule", "the dot stands before the brackets: :~ body. [w:l]"
                )
        return WeakConstraint(body, weight, level, self.span(first))

    def parameter(self) -> Variable | Number | Identifier:
        """``parameter = VARIABLE | value``"""
        at = self.at
        if self.kinds[at] == "variable":
            return self.variable("a variable")
        if self.kinds[at] in ("number", "identifier") and self.kinds[at + 1] != "(":
            return self.value()
        hint = "there is no unary minus" if self.kinds[at] == "-" else None
        raise self.unexpected("a number, a constant or a variable", hint)

    def optimize(self) -> Optimize:
        """``optimize = ("#minimize" | "#maximize") "{" parameter ["@" value] {"," parameter ["@"
        value]} ":" optimized_atom {"," optimized_atom} "}" "."``
        """
        first = self.at
        word = self.texts[first]
        self.at += 1
        if self.kinds[self.at] != "{":
            raise self.unexpected(f'"{{" after {word}')
        parameters: list[Term] = []
        priority, priority_index = None, 0
        while not parameters or self.kinds[self.at] == ",":
            self.at += 1
            if self.kinds[self.at] == ":":
                raise self.unexpected("a number, a constant or a variable")
            parameters.append(self.parameter())
            if self.kinds[self.at] == "@":
                if priority is not None:
                    raise self.unexpected('"," or ":"', "only one parameter has a priority")
                self.at += 1
                priority, priority_index = self.value(), len(parameters) - 1
        hint = self.touching_negation()
        if self.kinds[self.at] in BINDING:
            hint = f"a parameter of {word} is a single number, constant or variable"
        elif self.kinds[self.at] in ("}", ";"):
            hint = f"the atoms that are counted follow a colon: {word}{{X : cost(X)}}."
        self.expect(":", '",", "@" or ":"', hint)
        atoms: list[Atom] = []
        while not atoms or self.kinds[self.at] == ",":
            if atoms:
                self.at += 1
            atoms.append(self.optimized_atom(word))
        hint = None
        if self.kinds[self.at] == ";":
            hint = f"{word} has one element: write a statement for each"
        elif self.kinds[self.at] in _AFTER_TERM:
            hint = f"there are no comparisons in {word}: define an atom by a rule"
        self.expect("}", '"," or "}"', hint)
        hint = None
        if self.kinds[self.at] == ":-":
            hint = f"{word} has no body: put the atoms behind the colon inside the braces"
        self.expect(".", '"."', hint)
        return Optimize(
            word == "#maximize",
            tuple(parameters),
            priority,
            tuple(atoms),
            self.span(first),
            priority_index,
        )

    def optimized_atom(self, word: str) -> Atom:
        """``optimized_atom = atom | negated``"""
        kind = self.kinds[self.at]
        if kind == "identifier":
            return self.atom()
        if kind == "-" and self.kinds[self.at + 1] != "sort name":
            atom = self.negated()
            assert isinstance(atom, Atom)
            return atom
        raise self.unexpected(
            "an atom", f"{word} takes atoms only: define one by a rule and count it here"
        )

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
