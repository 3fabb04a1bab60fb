"""Reads the section ``rules``: tokens → rules, choices, weak constraints, optimize statements.

>>> from sparc.source import Source
>>> [atom.name for atom in StatementParser(Source("", "p | q :- r.")).statements()[0].head]
['p', 'q']

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Rules; each method has its grammar rule.
"""

from __future__ import annotations

from sparc.errors import SourceError
from sparc.syntax.cursor import BINDING, RELATIONS
from sparc.syntax.literal_parser import AFTER_TERM, AGGREGATES, OPTIMIZE, LiteralParser
from sparc.syntax.term_parser import TERM_STARTS, Operand
from sparc.syntax.tree import (
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    CrRule,
    Guard,
    Head,
    Identifier,
    Literal,
    Number,
    Optimize,
    RangeFact,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
    WeakConstraint,
)

__all__ = ["StatementParser"]


class StatementParser(LiteralParser):
    """Reads rules and whatever else stands among them."""

    __slots__ = ()

    def statements(self) -> tuple[Statement, ...]:
        """``statements = {statement}``"""
        statements: list[Statement] = []
        kinds = self.kinds
        while kinds[self.at] not in ("end", "section"):
            first = self.at
            try:
                statements.append(self.statement())
            except SourceError as error:
                self.recover(error, first)
        return tuple(statements)

    def statement(self) -> Statement:
        """``statement = rule | range_fact | weak_constraint | optimize``"""
        at = self.at
        kind = self.kinds[at]
        text = self.texts[at]
        if kind == ":~":
            return self.weak_constraint()
        if text in OPTIMIZE and (self.kinds[at + 1] == "{" or text not in self.sorts):
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
        [IDENTIFIER ":"] ":+" body "."``
        """
        head: Head = ()
        if self.kinds[self.at] not in ((":-", ":+") if label is None else (":+",)):
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
        """Returns the fault that a head goes on where it cannot."""
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
        elif kind in AFTER_TERM:
            hint = "a comparison cannot be a head; to forbid its opposite write a constraint :- …"
        elif kind == ":":
            hint = 'write ":-" before a body; a label has no arguments, and a condition stands in a choice'
        elif kind == "{":
            hint = "the bound of a choice is a number, a constant, a variable or arithmetic"
        return self.unexpected(expected, hint, may_end=True)

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
            if following == "{" or following in AFTER_TERM:
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
        if kind == "sort name" and not (text in AGGREGATES and self.kinds[at + 1] == "{"):
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
        """``choice = [bound [relation]] "{" choice_element {";" choice_element} "}"
        [[relation] bound]``

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
                raise self.unexpected('a bound, ":-", ":+" or "."', may_end=True)
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
            hint = "only a predicate with one argument may have a range; "
            hint += "elsewhere write a variable of a sort: q(X,2) :- #s(X)."
        self.expect(")", '")"', hint)
        hint = None
        if self.kinds[self.at] in (":-", ":+", "|", ","):
            hint = "a range stands only in a fact p(m..n). of its own; in a rule use a sort"
        self.expect(".", '"."', hint)
        text, span = self.texts[name], self.span(first)
        return RangeFact(text, low, high, negated, span, self.token_span(name))

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
                raise self.unexpected(
                    "a number, a constant or a variable",
                    f"what is counted stands before the colon: {word}{{X : cost(X)}}.",
                )
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
        elif self.kinds[self.at] in AFTER_TERM:
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
