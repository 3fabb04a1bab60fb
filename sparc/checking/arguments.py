"""Checks that each argument of each atom fits its sort: the part of `sparc.check` about atoms.

`ArgumentChecker` has one method per rule of the manual; faults go to its ``errors``.  On the way
it notes in a `Scope` where variables occur.
"""

from __future__ import annotations

from sparc.checking.typed_program import Signature, Undefined, evaluate, has_arithmetic
from sparc.errors import PredicateError, RuleError, SortError, SourceError
from sparc.sorts.definitions import SortTable
from sparc.sorts.extents import EVERY, Extent, Listed, Sort
from sparc.sorts.values import Value, text
from sparc.source import Span
from sparc.spelling import nearest
from sparc.syntax.cursor import QUANTIFIER_MEND, QUANTIFIERS
from sparc.syntax.tree import Arithmetic, Atom, Identifier, Number, Record, SortAtom, Term, Variable

__all__ = ["RESERVED_PREDICATES", "ArgumentChecker", "Scope", "as_written", "variables_into"]

RESERVED_PREDICATES = frozenset(("appl", "has_grounding", "warning", "exit"))


class Scope:
    """The variables of a statement or element, by where they occur.

    ``bound``: as argument of an atom, or in a record there; ``counted``: in arithmetic;
    ``bare``: elsewhere (a comparison, a guard).  Each anonymous variable is its own: it is never
    in ``bound``, as it cannot occur twice.
    """

    __slots__ = ("anonymous", "bare", "bound", "counted")

    def __init__(self) -> None:
        self.bound: set[str] = set()
        self.counted: set[str] = set()
        self.bare: set[str] = set()
        self.anonymous = False


class ArgumentChecker:
    """Checks atoms against declared predicates and sorts."""

    def __init__(self, maxint: int) -> None:
        self.errors: list[SourceError] = []
        self.constants: dict[str, int] = {}
        self.table = SortTable(self.constants, maxint)
        self.table.errors = self.errors
        self.predicates: dict[str, Signature] = {}
        self.misdeclared: set[str] = set()
        self._known: dict[Value, bool] = {}
        self._signatures: set[tuple[str, int]] | None = None

    def signature(self, name: str, arity: int, span: Span) -> Signature | None:
        """Returns the predicate ``name/arity``; None, and an error, when there is none."""
        signature = self.predicates.get(name)
        if signature is None:
            if name not in self.misdeclared:
                self.errors.append(self.unknown_predicate(name, arity, span))
            return None
        if len(signature.sorts) != arity:
            expected = len(signature.sorts)
            line = f" at line {signature.span.location.line}" if signature.span else ""
            self.errors.append(
                PredicateError(
                    f"predicate {name} has {expected} argument{'s' * (expected != 1)},"
                    f" found {arity}",
                    span,
                    f"it is declared{line} as {signature}",
                )
            )
            return None
        return signature

    def unknown_predicate(self, name: str, arity: int, span: Span) -> PredicateError:
        """Returns the error that a predicate was not declared."""
        near = nearest(name, self.predicates)
        if name in RESERVED_PREDICATES:
            hint = f"{name} is built in and cannot be used in rules"
        elif name in self.table.sorts:
            hint = f"#{name} is a sort: write #{name}(…), or declare a predicate {name}"
        elif name in QUANTIFIERS:
            hint = QUANTIFIER_MEND
        elif near is not None:
            span_of = self.predicates[near].span
            line = f" (declared at line {span_of.location.line})" if span_of else ""
            hint = f"did you mean {near}{line}?"
        else:
            hint = "declare it in the section predicates"
        return PredicateError(f"unknown predicate {name}/{arity}", span, hint)

    def atom(self, atom: Atom, scope: Scope) -> None:
        """The predicate is declared, and each argument fits its sort."""
        arguments = atom.arguments
        signature = self.predicates.get(atom.name)
        if signature is None or len(signature.sorts) != len(arguments):
            self.signature(atom.name, len(arguments), atom.span)
            for term in arguments:
                self.occurs(term, scope)
            return
        for index, term in enumerate(arguments):
            kind = type(term)
            if kind is Variable:
                scope.bound.add(term.name)  # type: ignore[union-attr]
            elif kind is Identifier:
                name = term.name  # type: ignore[union-attr]
                if self.constants.get(name, name) not in signature.sorts[index].extent:
                    self.ill_sorted(atom, index, term, signature.sorts[index])
            elif kind is Number:
                if term.value not in signature.sorts[index].extent:  # type: ignore[union-attr]
                    self.ill_sorted(atom, index, term, signature.sorts[index])
            else:
                self.compound(atom, index, term, signature.sorts[index], scope)
        scope.bound.discard("_")

    def occurs(self, term: Term, scope: Scope) -> None:
        """Notes the variables of an argument."""
        if type(term) is Variable:
            if term.name != "_":
                scope.bound.add(term.name)
        elif type(term) is Arithmetic:
            variables_into(term, scope.counted)
            scope.counted.discard("_")
        elif isinstance(term, Record):
            for argument in term.arguments:
                self.occurs(argument, scope)

    def compound(self, atom: Atom, index: int, term: Term, sort: Sort, scope: Scope) -> None:
        """An argument that is a record or arithmetic."""
        self.occurs(term, scope)
        try:
            value = evaluate(term, self.constants)
        except Undefined as error:
            if isinstance(term, Arithmetic) or error.by_zero:
                self.errors.append(PredicateError(str(error), error.span))
            return
        if value is not None:
            # A record whose arithmetic leads out of the sort has no instance, and is no error.
            if value not in sort.extent and not (type(value) is tuple and has_arithmetic(term)):
                self.ill_sorted(atom, index, term, sort)
        elif isinstance(term, Record):
            self.program_term(atom, index, term, term)
        elif not sort.extent.has_number():
            self.errors.append(
                PredicateError(
                    f"{as_written(term)} is a number, but sort #{sort.name} has none"
                    f" (argument {index + 1} of {atom.name})",
                    atom.span,
                    "use an element of the sort, or declare another sort",
                )
            )

    def program_term(self, atom: Atom, index: int, whole: Term, term: Record) -> None:
        """A record with variables has the form of some record, its ground parts are elements."""
        self.table.asked.add(EVERY)
        if self._signatures is None:
            self._signatures = set()
            for sort in self.table.sorts.values():
                self._signatures |= sort.signatures()
        if (term.name, len(term.arguments)) not in self._signatures:
            if self.table.faulty:
                return
            near = nearest(term.name, {name for name, _ in self._signatures})
            arities = sorted(arity for name, arity in self._signatures if name == term.name)
            if arities:
                hint = f"{term.name} has {' or '.join(map(str, arities))} arguments"
            else:
                hint = f"did you mean {near}?" if near else "add it to a sort"
            self.errors.append(
                PredicateError(
                    f"no sort has a record {term.name} with {len(term.arguments)}"
                    f" argument{'s' * (len(term.arguments) != 1)}"
                    f" (argument {index + 1} of {atom.name})",
                    atom.span,
                    hint,
                )
            )
            return
        for part in term.arguments:
            if type(part) is Variable or has_arithmetic(part):
                continue
            if isinstance(part, Record):
                self.program_term(atom, index, whole, part)
                continue
            value = evaluate(part, self.constants)
            if value is not None and not self.is_anywhere(value):
                near = nearest(str(value), self.elements())
                self.errors.append(
                    PredicateError(
                        f"{text(value)} is no element of any sort (in argument {index + 1} of"
                        f" {atom.name})",
                        atom.span,
                        f"did you mean {near}?" if near else f"it stands in {as_written(whole)}",
                    )
                )

    def is_anywhere(self, value: Value) -> bool:
        """Returns whether some sort has the element, at least inside a record of a set."""
        if self.table.faulty:
            return True
        known = self._known.get(value)
        if known is None:
            known = any(value in sort.extent for sort in self.table.sorts.values())
            if not known:
                known = any(value in nested for nested in map(_nested, self._listed()))
            self._known[value] = known
        return known

    def _listed(self) -> list[Listed]:
        extents: list[Listed] = []
        stack: list[Extent] = [sort.extent for sort in self.table.sorts.values()]
        while stack:
            extent = stack.pop()
            if isinstance(extent, Listed):
                if not extent.basic:
                    extents.append(extent)
            else:
                for name in ("parts", "left", "right"):
                    part = getattr(extent, name, ())
                    stack.extend(part if isinstance(part, tuple) else [part])
        return extents

    def elements(self) -> list[str]:
        """Returns the identifiers of the small sorts, for suggestions."""
        return [
            value
            for sort in self.table.sorts.values()
            if sort.extent.basic and sort.extent.bound() <= 1000
            for value in sort.extent
            if type(value) is str
        ]

    def ill_sorted(self, atom: Atom, index: int, term: Term, sort: Sort) -> None:
        """The error that a ground argument is outside its sort."""
        value = evaluate(term, self.constants)
        assert value is not None
        hint = None
        if type(value) is str and sort.extent.basic and sort.extent.bound() <= 1000:
            near = nearest(value, [v for v in sort.extent if type(v) is str])
            hint = f"did you mean {near}?" if near else None
        hint = hint or _argument_outside(value, sort)
        if hint is None:
            others = [other.name for other in self.table.sorts.values() if value in other.extent][
                :3
            ]
            line = f" (line {sort.span.location.line})" if sort.span else ""
            hint = f"#{sort.name}{line} does not have it"
            if others:
                hint += f"; {', '.join('#' + name for name in others)} " + (
                    "does" if len(others) == 1 else "do"
                )
            elif type(value) is str and len(value) == 1:
                hint += f"; variables begin with a capital letter: {value.upper()}"
        shown = text(value)
        if len(shown) > 60:
            shown = shown[:57] + "…"
        self.errors.append(
            PredicateError(
                f"{shown} is not in sort #{sort.name} (argument {index + 1} of {atom.name})",
                atom.span,
                hint,
            )
        )

    def sort_atom(self, atom: SortAtom, scope: Scope, *, binds: bool) -> None:
        """``#s(t)``: a known sort, one argument, and in the sort if it is ground."""
        for term in atom.arguments:
            if binds:
                self.occurs(term, scope)
            else:
                self.side(term, scope)
        if atom.negated:
            self.errors.append(
                RuleError(
                    f"-#{atom.name} has no meaning: a sort has no strong negation",
                    atom.span,
                    f"write not #{atom.name}(…)",
                )
            )
            return
        sort = self.table.named(atom.name, atom.name_span)
        if len(atom.arguments) != 1:
            self.errors.append(
                RuleError(
                    f"sort atom #{atom.name} needs one argument, found {len(atom.arguments)}",
                    atom.span,
                    f"write #{atom.name}(X)",
                )
            )
            return
        if sort is None:
            return
        try:
            value = evaluate(atom.arguments[0], self.constants)
        except Undefined as error:
            self.errors.append(RuleError(str(error), error.span))
            return
        if value is not None and value not in sort.extent:
            self.errors.append(
                SortError(
                    f"{text(value)} is not in sort #{sort.name}",
                    atom.span,
                    "a sort atom over a ground term is either always true or a mistake",
                )
            )

    def sort_atom_in_head(self, atom: SortAtom) -> None:
        """A sort is defined by its definition, not by rules."""
        if atom.name in self.table.sorts or atom.name in self.table.faulty:
            hint: str | None = f"add the element to the definition of #{atom.name}"
        else:
            near = nearest(atom.name, self.predicates)
            hint = f"did you mean {near}, without #?" if near else None
        self.errors.append(
            RuleError(f"sort atom #{atom.name} cannot stand in a head", atom.span, hint)
        )

    def side(self, term: Term, scope: Scope) -> None:
        """Notes the variables of one side of a comparison, which is checked against no sort."""
        if type(term) is Variable:
            if term.name == "_":
                scope.anonymous = True
            else:
                scope.bare.add(term.name)
        elif type(term) is Arithmetic:
            variables_into(term, scope.counted)
            scope.counted.discard("_")
        elif isinstance(term, Record):
            for argument in term.arguments:
                self.side(argument, scope)


def _argument_outside(value: Value, sort: Sort) -> str | None:
    """Returns which argument of a record is outside its sort, None where it is not one alone."""
    if type(value) is not tuple:
        return None
    name, *parts = value
    for box in sort.extent.boxes(str(name), len(parts)) or ():
        pairs = list(zip(box.arguments, parts, strict=True))
        outside = [(k, each) for k, each in enumerate(pairs, 1) if each[1] not in each[0].extent]
        if len(outside) == 1:
            ((number, (own, part)),) = outside
            line = f" (line {own.span.location.line})" if own.span else ""
            own_name = own.name.lstrip("#")
            return f"argument {number} of {name} is of #{own_name}{line}, which lacks {text(part)}"
    return None


def variables_into(term: Term, found: set[str]) -> None:
    """Adds the names of the variables of a term."""
    if type(term) is Variable:
        found.add(term.name)
    elif isinstance(term, Record):
        for argument in term.arguments:
            variables_into(argument, found)
    elif isinstance(term, Arithmetic):
        variables_into(term.left, found)
        variables_into(term.right, found)


def _nested(extent: Listed) -> set[Value]:
    """Returns all arguments, at any depth, of the records of a set."""
    values: set[Value] = set()
    stack: list[Value] = [value for value in extent.values if type(value) is tuple]
    while stack:
        value = stack.pop()
        if type(value) is tuple:
            stack.extend(value[1:])
            values.update(value[1:])
    return values


def as_written(term: Term) -> str:
    """Returns a term as the text has it, on one line and not too long."""
    text = " ".join(term.span.text.split()) if term.span is not None else "the term"
    return text if len(text) <= 60 else text[:57] + "…"
