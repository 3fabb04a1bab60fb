"""Finds every fault of a program that can be read: Program → TypedProgram, with `check`.

One method per rule of the language.  All faults are gathered and raised together as
`SourceErrors`, in the order of the text; a name that is unknown is reported where it stands and
then leaves its surroundings alone.

>>> from sparc.syntax.parser import parse
>>> from sparc.source import Source
>>> check(parse(Source("x", "sorts #s = {a}. predicates p(#t). rules p(b). ")))
Traceback (most recent call last):
sparc.errors.SourceErrors: unknown sort #t

Follows the SPARC manual, "Type errors" and "Syntax"; variables as in "Safety of rules".
"""

from __future__ import annotations

from sparc.checking.arguments import (
    RESERVED_PREDICATES,
    ArgumentChecker,
    Scope,
    as_written,
    variables_into,
)
from sparc.checking.number_limit import NumberLimit
from sparc.checking.typed_program import Signature, TypedProgram, is_ground
from sparc.errors import (
    LimitError,
    NumberError,
    PredicateError,
    RuleError,
    SortError,
    SourceError,
    SourceErrors,
)
from sparc.sorts.definitions import SortTable
from sparc.source import Span
from sparc.spelling import nearest
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    ConstDirective,
    CrRule,
    DisplayItem,
    DisplaySort,
    Head,
    Identifier,
    Literal,
    Naf,
    Number,
    Optimize,
    PredicateDeclaration,
    Program,
    RangeFact,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
    WeakConstraint,
)

__all__ = ["DEFAULT_MAXINT", "Checker", "check", "check_literal", "nested_too_deeply"]

DEFAULT_MAXINT = 2000
"""The largest number of ``#nat`` and of the text where no ``#maxint`` says otherwise."""


def check(program: Program) -> TypedProgram:
    """Returns the program with its sorts and predicates; raises `SourceErrors` with every fault."""
    checker = Checker(program)
    try:
        checker.run()
    except RecursionError:
        checker.errors.append(nested_too_deeply())
    if checker.errors:
        raise SourceErrors(sorted(checker.errors, key=_place))
    return checker.typed()


def nested_too_deeply() -> LimitError:
    """Returns the fault that the checker cannot follow a program."""
    return LimitError("the program is nested too deeply to be checked")


def check_literal(typed: TypedProgram, atom: Atom) -> None:
    """Raises `SourceErrors` when ``atom`` does not fit the declarations (as a query)."""
    checker = Checker(typed.program)
    checker.constants = dict(typed.constants)
    checker.maxint = typed.maxint
    checker.table.sorts = dict(typed.sorts)
    checker.predicates = dict(typed.predicates)
    try:
        checker.atom(atom, Scope())
    except LimitError as error:
        error.span = error.span or atom.span
        raise
    if checker.errors:
        raise SourceErrors(checker.errors)


def _place(error: SourceError) -> int:
    return -1 if error.span is None else error.span.start


class Checker(ArgumentChecker):
    """Checks the parts of one program; ``errors`` are the faults found until now."""

    def __init__(self, program: Program) -> None:
        super().__init__(DEFAULT_MAXINT)
        self.program = program
        self.maxint = DEFAULT_MAXINT
        self.labels: dict[str, Span] = {}
        self.naturals: dict[tuple[int, int], frozenset[str]] = {}
        self.index = 0
        self.limit = NumberLimit(program, DEFAULT_MAXINT)

    def run(self) -> None:
        """Checks the whole program."""
        self.open()
        for index, statement in enumerate(self.program.statements):
            self.index = index
            self.statement(statement)
        self.display()

    def typed(self) -> TypedProgram:
        """Returns the program with what was found of its sorts, predicates and variables."""
        return TypedProgram(
            self.program,
            self.constants,
            self.maxint,
            self.table.sorts,
            self.predicates,
            self.naturals,
        )

    def open(self) -> None:
        """Checks what stands before the rules."""
        program = self.program
        self.directives()
        self.table = SortTable(self.constants, self.maxint)
        self.table.errors = self.errors
        self.table.define_all(program.sorts)
        for declaration in program.predicates:
            self.declaration(declaration)
        self.look_for_large_numbers()
        self.number_limit((program.directives, program.sorts, program.predicates))

    def display(self) -> None:
        """Checks the section ``display``."""
        for item in self.program.display or ():
            if isinstance(item, DisplayItem):
                self.display_item(item)
            else:
                self.display_sort(item)
        self.number_limit(self.program.display)

    # ------------------------------------------------------------ directives and declarations

    def directives(self) -> None:
        """Constants have a value and are defined once; ``#maxint`` counts wherever it stands."""
        for directive in self.program.directives:
            value = directive.value
            if isinstance(value, Identifier) and value.name not in self.constants:
                near = nearest(value.name, self.constants)
                self.errors.append(
                    SortError(
                        f"unknown constant {value.name}",
                        value.span,
                        f"did you mean {near}?" if near else "define it above this line",
                    )
                )
                number = 0
            else:
                number = value.value if isinstance(value, Number) else self.constants[value.name]
                if number > MAX_NUMBER:
                    self.errors.append(
                        NumberError(f"numbers beyond {MAX_NUMBER} cannot be handled", value.span)
                    )
            if not isinstance(directive, ConstDirective):
                self.maxint = number
            elif directive.name in self.constants:
                self.errors.append(
                    SortError(
                        f"constant {directive.name} is defined twice",
                        directive.name_span,
                        "remove one of the definitions",
                    )
                )
            else:
                self.constants[directive.name] = number

    def declaration(self, declaration: PredicateDeclaration) -> None:
        """A predicate is declared once, over known sorts, and not under a reserved name."""
        name = declaration.name
        if name in RESERVED_PREDICATES:
            self.errors.append(
                PredicateError(
                    f"predicate {name} is built in and cannot be declared",
                    declaration.name_span,
                    "give it another name",
                )
            )
        known = self.predicates.get(name)
        if known is not None or name in self.misdeclared:
            at = f" at line {known.span.location.line}" if known and known.span else ""
            self.errors.append(
                PredicateError(
                    f"predicate {name} is declared twice",
                    declaration.name_span,
                    f"the first declaration is{at or ' above'}; a predicate has one, whatever"
                    " the number of its arguments",
                )
            )
            return
        sorts = [self.table.named(sort.name, sort.span) for sort in declaration.sorts]
        found = [sort for sort in sorts if sort is not None]
        if len(found) == len(sorts):
            self.predicates[name] = Signature(name, tuple(found), declaration.name_span)
        else:
            self.misdeclared.add(name)

    def look_for_large_numbers(self) -> None:
        """Looks through the text, whether a number in it may be too large."""
        self.limit = NumberLimit(self.program, self.maxint)

    def number_limit(self, part: object) -> None:
        """Checks that no number in a part of the tree is above ``#maxint``."""
        self.errors += self.limit.faults(part)

    # ------------------------------------------------------------ statements

    def statement(self, statement: Statement) -> None:
        """Checks one statement, that of the index ``index``."""
        try:
            self.parts(statement)
        except LimitError as error:  # a sort of it cannot be looked through
            error.span = error.span or statement.span
            self.errors.append(error)
        self.number_limit(statement)

    def parts(self, statement: Statement) -> None:
        """Checks the atoms and the variables of a statement.

        Raises `LimitError` where a sort is too large to be looked through.
        """
        kind = type(statement)
        if kind is Rule:
            self.rule(statement.head, statement.body, statement)  # type: ignore[union-attr]
        elif isinstance(statement, CrRule):
            self.cr_rule(statement)
        elif isinstance(statement, RangeFact):
            self.range_fact(statement)
        elif isinstance(statement, WeakConstraint):
            self.weak_constraint(statement)
        elif isinstance(statement, Optimize):
            self.optimize(statement)

    def rule(self, head: Head, body: tuple[BodyItem, ...], statement: Statement) -> Scope:
        """Checks that head and body fit the declarations, and that no variable is unrestricted."""
        scope = Scope()
        elements: list[ChoiceElement | AggregateElement] = []
        if type(head) is tuple:
            for atom in head:
                if type(atom) is Atom:
                    self.atom(atom, scope)
                elif isinstance(atom, SortAtom):
                    self.sort_atom_in_head(atom)
        elif isinstance(head, Choice):
            for guard in (head.left, head.right):
                if guard is not None:
                    variables_into(guard.bound, scope.bare)
            elements.extend(head.elements)
        for item in body:
            if type(item) is Atom:
                self.atom(item, scope)
            elif isinstance(item, Aggregate):
                for guard in (item.left, item.right):
                    if guard is not None:
                        variables_into(guard.bound, scope.bare)
                elements.extend(item.elements)
            else:
                self.literal(item, scope)
        unrestricted: set[str] = set()
        if scope.bare or scope.counted or scope.anonymous:
            unrestricted = self.settle(scope, 0, set())
        if elements:
            outer = scope.bound | scope.bare | scope.counted
            for number, element in enumerate(elements, 1):
                local = self.element(element)
                if local.bare or local.counted or local.anonymous:
                    inner = outer
                    if isinstance(element, AggregateElement):
                        inner = outer - {t.name for t in element.terms if isinstance(t, Variable)}
                    unrestricted |= self.settle(local, number, inner)
        if unrestricted:
            self.unrestricted(unrestricted, statement)
        return scope

    def settle(self, scope: Scope, number: int, outer: set[str]) -> set[str]:
        """Returns the unrestricted variables of a scope; those in arithmetic only become ``#nat``."""
        naturals = scope.counted - scope.bound - outer
        if naturals:
            self.naturals[self.index, number] = frozenset(naturals)
        unrestricted = scope.bare - scope.bound - scope.counted - outer
        if scope.anonymous:
            unrestricted.add("_")
        return unrestricted

    def unrestricted(self, names: set[str], statement: Statement) -> None:
        """Adds the fault that variables occur neither in an atom nor in arithmetic."""
        several = len(names) > 1
        self.errors.append(
            RuleError(
                f"unrestricted variable{'s' if several else ''} {', '.join(sorted(names))}:"
                f" {'they occur' if several else 'it occurs'} in no atom that gives"
                f" {'them' if several else 'it'} a sort",
                statement.span,
                "add a sort atom such as #s(" + min(names - {"_"}, default="X") + ")"
                + (" and give _ a name" if "_" in names else ""),
            )
        )  # fmt: skip

    def literal(self, item: Literal, scope: Scope) -> None:
        """Checks a literal of a body or a condition."""
        if type(item) is Atom:
            self.atom(item, scope)
        elif isinstance(item, Naf):
            if isinstance(item.operand, Atom):
                self.atom(item.operand, scope)
            else:
                self.sort_atom(item.operand, scope, binds=False)
        elif isinstance(item, SortAtom):
            self.sort_atom(item, scope, binds=True)
        elif isinstance(item, Comparison):
            self.side(item.left, scope)
            self.side(item.right, scope)

    def element(self, element: ChoiceElement | AggregateElement) -> Scope:
        """Returns an element of a choice or an aggregate, with its own variables."""
        local = Scope()
        if isinstance(element, ChoiceElement):
            if isinstance(element.atom, Atom):
                self.atom(element.atom, local)
            else:
                self.sort_atom_in_head(element.atom)
        else:
            for term in element.terms:
                self.tuple_term(term, local)
        for literal in element.condition:
            self.literal(literal, local)
        return local

    def tuple_term(self, term: Term, local: Scope) -> None:
        """The terms of an aggregate's tuple are variables or ground."""
        if type(term) is Variable:
            self.side(term, local)
        elif not is_ground(term):
            self.errors.append(
                RuleError(
                    f"{as_written(term)} is neither a variable nor ground",
                    term.span,
                    "use a variable here and compute its value in the condition",
                )
            )

    def cr_rule(self, statement: CrRule) -> None:
        """The label of a consistency-restoring rule is its own."""
        label = statement.label
        if label is not None:
            if label in self.labels:
                line = self.labels[label].location.line if self.labels[label] else "?"
                self.errors.append(
                    RuleError(
                        f"label {label} is used twice",
                        statement.label_span,
                        f"the first rule with it is at line {line}",
                    )
                )
            else:
                self.labels[label] = statement.label_span
        self.rule(statement.head, statement.body, statement)

    def range_fact(self, statement: RangeFact) -> None:
        """``p(m..n)``: a predicate of one argument, all numbers in its sort."""
        try:
            low, high = self.table.number(statement.low), self.table.number(statement.high)
        except SortError as error:
            self.errors.append(error)
            return
        signature = self.signature(statement.name, 1, statement.name_span)
        if signature is None:
            return
        extent = signature.sorts[0].extent
        values = range(low, high + 1)
        if len(values) > 5_000_000:
            self.errors.append(
                LimitError(f"the range {low}..{high} is too long to be listed", statement.span)
            )
            return
        missing = next((value for value in values if value not in extent), None)
        if missing is not None:
            self.errors.append(
                PredicateError(
                    f"{missing}, of the range {low}..{high}, is not in sort"
                    f" #{signature.sorts[0].name} (argument 1 of {statement.name})",
                    statement.span,
                    "shorten the range, or widen the sort",
                )
            )

    def weak_constraint(self, statement: WeakConstraint) -> None:
        """Checks that weight and level are numbers, or variables of the body."""
        scope = self.rule((), statement.body, statement)
        for what, term in (("weight", statement.weight), ("level", statement.level)):
            if isinstance(term, Variable):
                if term.name not in scope.bound | scope.counted | scope.bare:
                    self.errors.append(
                        RuleError(
                            f"variable {term.name}, the {what}, does not occur in the body",
                            term.span,
                            "use a variable of the body, or a number",
                        )
                    )
            elif term is not None:
                self.constant(term)

    def constant(self, term: Term) -> None:
        """A number or a known constant."""
        if isinstance(term, Number | Identifier):
            try:
                self.table.number(term)
            except SortError as error:
                self.errors.append(error)

    def optimize(self, statement: Optimize) -> None:
        """The parameters are numbers, or variables of the atoms."""
        scope = Scope()
        for atom in statement.atoms:
            self.atom(atom, scope)
        word = "#maximize" if statement.maximize else "#minimize"
        if not statement.parameters or not statement.atoms:
            self.errors.append(
                RuleError(
                    f"{word} needs a parameter and an atom",
                    statement.span,
                    f"write {word}{{X : cost(X)}}.",
                )
            )
        self.settle(scope, 0, set())
        for term in statement.parameters:
            if isinstance(term, Variable):
                if term.name not in scope.bound | scope.counted:
                    self.errors.append(
                        RuleError(
                            f"variable {term.name} does not occur in the atoms of {word}",
                            term.span,
                            "use a variable of the atoms behind the colon",
                        )
                    )
            else:
                self.constant(term)
        if statement.priority is not None:
            self.constant(statement.priority)

    # ------------------------------------------------------------ display

    def display_item(self, item: DisplayItem) -> None:
        """A declared predicate, with arguments that fit."""
        if item.arguments is None:
            if item.name not in self.predicates and item.name not in self.misdeclared:
                self.errors.append(self.unknown_display(item.name, item.name_span))
            return
        if item.name not in self.predicates and item.name not in self.misdeclared:
            self.errors.append(self.unknown_display(item.name, item.name_span))
            return
        self.atom(Atom(item.name, item.arguments, item.negated, item.span, item.name_span), Scope())

    def unknown_display(self, name: str, span: Span) -> PredicateError:
        """Returns the error that an undeclared predicate is displayed."""
        near = nearest(name, self.predicates)
        hint = f"did you mean {near}?" if near else "declare it in the section predicates"
        return PredicateError(f"unknown predicate {name} in the display section", span, hint)

    def display_sort(self, item: DisplaySort) -> None:
        """A known sort, with an element of it if the argument is ground."""
        argument = item.argument
        arguments = (argument,) if argument is not None else (Variable("X", item.span),)
        self.sort_atom(
            SortAtom(item.name, arguments, False, item.span, item.name_span), Scope(), binds=True
        )


# ------------------------------------------------------------------ helpers
