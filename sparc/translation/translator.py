"""Translates a typed program for clingo: TypedProgram → AspProgram, with `translate`.

Rules keep their shape; what SPARC adds is the sorts.  Every argument of an atom must lie in the
sort of its position, so a rule gets *guards*, atoms ``__s(t)`` over the elements of ``#s``:

    p(X) :- not q(X+1).            p(X):-not q(X+1),__s(X),__t(X+1).

A guard is left out where another literal implies it: whatever holds in an answer set is
well-sorted, so ``q(X)`` in the positive body says as much about X as its sort does.  Records are
taken apart (``at(R,L)`` is guarded by the sorts of R and L), so large record sorts are listed
only where a variable ranges over one and nothing else binds it.

Consistency-restoring rules become a choice and a weak constraint above all others:

    r : p(X) :+ q(X).              {___appl(r(X))}:-q(X).
                                   :~___appl(r(X)).[1@2,r(X)]
                                   p(X):-___appl(r(X)).

Names that begin with ``__`` are ours: ``__s`` for the sort ``#s``, ``___appl`` and ``___1`` for
the rest; no SPARC name begins so.
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.checking.typed_program import TypedProgram
from sparc.errors import LimitError, NumberError
from sparc.source import Span
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import (
    Atom,
    Choice,
    CrRule,
    DisplayItem,
    Head,
    Identifier,
    Number,
    Optimize,
    Program,
    RangeFact,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
    WeakConstraint,
)
from sparc.translation.asp_program import AspProgram
from sparc.translation.guards import NoInstance, is_anonymous
from sparc.translation.literals import Literals, global_names
from sparc.translation.sort_facts import interval

__all__ = ["APPLIED", "QUERY", "rule_labels", "translate", "translate_query"]

APPLIED = "___appl"
"""The auxiliary predicate whose atoms say which consistency-restoring rules were applied."""

QUERY = "___query"
"""The auxiliary predicate of `translate_query`."""

_TOP_LEVEL = 1_000_000_000  # above every level that a variable can take


def translate(typed: TypedProgram) -> AspProgram:
    """Returns the clingo program whose (optimal) answer sets, as shown, are those of ``typed``.

    Raises `LimitError` when a sort that must be listed is too large.
    """
    return _Translator(typed).program()


def translate_query(typed: TypedProgram, atoms: tuple[Atom, ...]) -> tuple[str, tuple[str, ...]]:
    """Rules to add to the translation that answer a query of some literals, and its variables.

    ``___query(V1,…,Vn)`` holds where the literals do; without variables it is ``___query(yes)``
    or, where the contrary of one of them holds, ``___query(no)``.
    """
    translator = _Translator(typed)
    names = tuple(global_names((), atoms))
    try:
        shown = [translator.positive(atom) for atom in atoms]
        if not names:
            lines = [f"{QUERY}(yes):-{','.join(shown)}."]
            for atom, literal in zip(atoms, shown, strict=True):
                contrary = literal[1:] if atom.negated else f"-{literal}"
                lines.append(f"{QUERY}(no):-{contrary}.")
            return "\n".join(lines), ()
        counted = [name for name in names if name not in translator.known]
        for name in counted:
            translator.require(Variable(name), typed.sorts["nat"].extent)
    except NoInstance:
        return "", names
    body = ",".join([*shown, *translator.guards])
    lines = [f"{QUERY}({','.join(names)}):-{body}.", *translator.facts.definitions()]
    return "\n".join(lines), names


def rule_labels(program: Program) -> dict[int, str]:
    """Returns a label for each consistency-restoring rule; those without get r_0, r_1, …"""
    rules = {
        index: statement
        for index, statement in enumerate(program.statements)
        if type(statement) is CrRule
    }
    used = {rule.label for rule in rules.values()}
    labels: dict[int, str] = {}
    number = 0
    for index, rule in rules.items():
        label = rule.label
        if label is None:
            while f"r_{number}" in used:
                number += 1
            label = f"r_{number}"
            number += 1
        labels[index] = label
    return labels


class _Translator(Literals):
    def __init__(self, typed: TypedProgram) -> None:
        super().__init__(typed)
        self.lines: list[str] = []
        self.spans: list[Span | None] = []
        self.has_preferences = False

    def program(self) -> AspProgram:
        statements = self.typed.program.statements
        labels = rule_labels(self.typed.program)
        level = self.cr_level()
        for self.index, statement in enumerate(statements):
            first = len(self.lines)
            try:
                if type(statement) is Rule:
                    self.rule(statement)
                else:
                    self.other(statement, labels, level)
            except NoInstance:
                pass
            except LimitError as error:
                if error.span is None:
                    error.span = statement.span
                raise
            self.spans.extend([statement.span] * (len(self.lines) - first))
        show = self.show()
        definitions = self.facts.definitions()
        self.lines.extend(definitions)
        self.spans.extend([None] * len(definitions))
        return AspProgram(
            "\n".join(self.lines),
            show,
            tuple(self.spans),
            self.has_preferences,
            self.typed.program.display is not None,
            tuple(self.places),
        )

    # ------------------------------------------------------------ statements

    def rule(self, rule: Rule) -> None:
        """``head :- body.``"""
        head, body = rule.head, rule.body
        if not body and type(head) is tuple and len(head) == 1:
            fact = self.ground_fact(head[0])
            if fact is not None:
                self.lines.append(fact)
                return
        self.begin()
        parts = self.body(body, head)
        shown = self.head(head)
        parts += self.guards
        if type(head) is tuple and _contrary(head):
            # "p | -p" is a choice between the two. As two rules it is no disjunction for clingo,
            # which saves it the work, and the fault, that come with one.
            positive, negative = shown.split("|")
            self.lines.append(f"{positive}:-{','.join([f'not {negative}', *parts])}.")
            self.lines.append(f"{negative}:-{','.join([f'not {positive}', *parts])}.")
            return
        if parts:
            self.lines.append(f"{shown}:-{','.join(parts)}.")
        else:
            self.lines.append(f"{shown}." if shown else ":-.")

    def other(self, statement: Statement, labels: dict[int, str], level: int) -> None:
        """Translates any statement but a plain rule."""
        self.begin()
        match statement:
            case RangeFact():
                self.range_fact(statement)
            case CrRule():
                self.cr_rule(statement, labels[self.index], level)
            case WeakConstraint():
                self.weak_constraint(statement)
            case Optimize():
                self.optimize(statement)

    def ground_fact(self, atom: Atom | SortAtom) -> str | None:
        """Returns the text of a fact whose arguments are single words, None when they are not."""
        assert isinstance(atom, Atom)
        constants = self.constants
        words = []
        for term in atom.arguments:
            kind = type(term)
            if kind is Identifier:
                name = term.name  # type: ignore[union-attr]
                words.append(str(constants.get(name, name)) if constants else name)
            elif kind is Number:
                words.append(str(term.value))  # type: ignore[union-attr]
            else:
                return None
        self.derived.add((atom.name, len(words), atom.negated))
        shown = f"{atom.name}({','.join(words)})." if words else f"{atom.name}."
        return "-" + shown if atom.negated else shown

    def range_fact(self, fact: RangeFact) -> None:
        """``p(m..n).``"""
        low, high = self.number(fact.low), self.number(fact.high)
        if low <= high:
            self.derived.add((fact.name, 1, fact.negated))
            self.lines.append(f"{'-' if fact.negated else ''}{fact.name}({interval(low, high)}).")

    def cr_rule(self, rule: CrRule, label: str, level: int) -> None:
        """``r : head :+ body.``; each ground instance that is applied costs 1 on the top level."""
        if not rule.head:
            return
        self.named = True
        try:
            body = tuple(self.with_names(item) for item in rule.body)
            head: Head
            if isinstance(rule.head, Choice):
                head = rule.head
            else:
                head = tuple(self.with_names(atom) for atom in rule.head)  # type: ignore[misc]
        finally:
            self.named = False
        parts = self.body(body, head)
        shown = self.head(head)
        names = global_names(head, body)
        name = f"{label}({','.join(names)})" if names else label
        applied = f"{APPLIED}({name})"
        condition = ",".join(parts + self.guards)
        self.lines.append(f"{{{applied}}}:-{condition}." if condition else f"{{{applied}}}.")
        self.lines.append(f":~{applied}.[1@{level},{name}]")
        self.lines.append(f"{shown}:-{applied}.")
        self.has_preferences = True

    def weak_constraint(self, statement: WeakConstraint) -> None:
        """``:~ body. [w:l]``: each ground instance that holds costs w on level l."""
        self.named = True
        try:
            body = tuple(self.with_names(item) for item in statement.body)
        finally:
            self.named = False
        parts = self.body(body, ())
        weight = "1" if statement.weight is None else self.term(statement.weight)
        level = "1" if statement.level is None else self.term(statement.level)
        parts += self.guards
        names = global_names((), body)
        terms = ",".join([f"{weight}@{level}", f"___w{self.index}", *names])
        if self.may_exceed(statement.weight or Number(1), names):
            counted = ",".join([weight, f"___w{self.index}", *names])
            parts.append(self.total(self.place(statement.span), f"(0,{level})", counted))
        self.lines.append(f":~{','.join(parts)}.[{terms}]")
        self.has_preferences = True

    def optimize(self, statement: Optimize) -> None:
        """``#minimize{weight@priority,terms : atoms}.``"""
        self.has_preferences = True
        atoms = [self.positive(atom) for atom in statement.atoms]
        self.naturals(0)
        terms = [self.term(term) for term in statement.parameters]
        word = "#maximize" if statement.maximize else "#minimize"
        names = [term.name for term in statement.parameters if isinstance(term, Variable)]
        if statement.parameters and self.may_exceed(statement.parameters[0], names):
            level = "0" if statement.priority is None else self.term(statement.priority)
            counted = f"{','.join(terms)},{word[1:]}"
            self.guards.append(self.total(self.place(statement.span), f"(0,{level})", counted))
        if statement.priority is not None:
            terms[0] += f"@{self.term(statement.priority)}"
        self.lines.append(f"{word}{{{','.join(terms)}: {','.join(atoms + self.guards)}}}.")

    def may_exceed(self, weight: Term, names: Iterable[str]) -> bool:
        """Returns whether the costs of a level may leave 32 bits, as far as its sorts can tell.

        clingo adds the costs of what holds always with 32 bits, and those of one literal.
        """
        others = tuple(Variable(name) for name in names if Variable(name) != weight)
        statements = self.typed.program.statements
        optimizing = sum(isinstance(each, WeakConstraint | Optimize) for each in statements)
        return self.most((weight, *others)) * optimizing > MAX_NUMBER

    def cr_level(self) -> int:
        """Returns a level above those of all other preferences, 2 at least."""
        level = 1
        has_cr_rules = any(type(each) is CrRule for each in self.typed.program.statements)
        for index, statement in enumerate(self.typed.program.statements):
            given: Term | None = None
            if type(statement) is Optimize:
                given = statement.priority
            elif type(statement) is WeakConstraint:
                given = statement.level
            if given is None:
                continue
            self.begin()
            self.index = index
            if isinstance(given, Variable):
                highest = max(_TOP_LEVEL, self.numbers(given.name)[1])
            else:
                highest = self.number(given)
            if highest >= MAX_NUMBER and has_cr_rules:
                raise NumberError(
                    f"no level is left above {highest} for consistency-restoring rules",
                    given.span,
                    "use smaller levels",
                )
            level = max(level, highest)
        return level + 1

    # ------------------------------------------------------------ display

    def show(self) -> str:
        """Returns the ``#show`` directives: what the display section names, or every
        derived literal.
        """
        lines = ["#show."]
        display = self.typed.program.display
        if display is None:
            lines += [
                f"#show {'-' if negated else ''}{name}/{arity}."
                for name, arity, negated in sorted(self.derived)
            ]
            return "\n".join(lines)
        for item in dict.fromkeys(display):
            self.begin()
            self.index = -1
            if isinstance(item, DisplayItem):
                line = self.show_item(item)
            else:
                sort = self.typed.sorts[item.name]
                name = self.facts.named_key(sort)
                if item.argument is None:
                    line = f"#show {name}/1."
                else:
                    shown = self.term(item.argument)
                    line = f"#show {name}({shown}):{name}({shown})."
            lines.append(line)
        return "\n".join(lines)

    def show_item(self, item: DisplayItem) -> str:
        """``p.``, ``-p.`` or ``p(t1,…,tn).``"""
        sign = "-" if item.negated else ""
        arity = len(self.predicates[item.name])
        if not item.arguments:
            return f"#show {sign}{item.name}/{arity}."
        self.named = True
        try:
            shown = self.positive(
                Atom(item.name, item.arguments, item.negated, item.span, item.name_span)
            )
        except NoInstance:
            return ""
        finally:
            self.named = False
        return f"#show {shown}: {','.join([shown, *self.guards])}."


def _contrary(head: tuple[Atom | SortAtom, ...]) -> bool:
    """Returns whether a head is an atom or its strong negation: no answer set has both."""
    if len(head) != 2:
        return False
    a, b = head
    if (a.name, a.arguments) != (b.name, b.arguments) or a.negated == b.negated:
        return False
    return not any(map(is_anonymous, a.arguments))  # these are different variables
