"""Finds probable mistakes in a legal program: TypedProgram → warnings, with `find_warnings`.

A rule without any ground instance under the sorts says nothing; so does a comparison with a name
that no sort has.  Several ``_`` in one rule are several variables here, and a single one in the
original system.

>>> from sparc import check, parse
>>> text = "sorts #a = 1..3. #b = 7..9. predicates p(#a). q(#b). rules q(7). p(X) :- q(X). "
>>> [str(warning) for warning in find_warnings(check(parse(text)))]
['this rule has no instance: X would have to be in #b and in #a, which share no element']

Instances are those of `sparc.checking.rule_instances`.  Follows the SPARC manual, "Type warnings".
"""

from __future__ import annotations

from collections.abc import Iterator

from sparc.checking.leaving_sorts import LeavingSorts
from sparc.checking.rule_instances import InstanceSearch, terms_of
from sparc.checking.slip_warnings import mentions, predicate_slips, rule_slips
from sparc.checking.typed_program import TypedProgram, variables
from sparc.errors import SparcWarning
from sparc.syntax.tree import (
    BodyItem,
    CrRule,
    Head,
    Optimize,
    RangeFact,
    Rule,
    Statement,
    WeakConstraint,
)

__all__ = ["WarningSearch", "find_warnings"]


def find_warnings(typed: TypedProgram) -> tuple[SparcWarning, ...]:
    """Returns every warning about the program, in the order of the text."""
    looker = WarningSearch(typed)
    naturals: dict[int, set[str]] = {}
    for (index, _), names in typed.naturals.items():
        naturals.setdefault(index, set()).update(names)
    statements = typed.program.statements
    warnings: list[SparcWarning] = []
    for index, statement in enumerate(statements):
        warnings += looker.of(statement, naturals.get(index, set()))
    warnings += predicate_slips(typed, map(mentions, statements))
    return tuple(sorted(warnings, key=lambda warning: warning.span.start if warning.span else -1))


class WarningSearch:
    """Looks through the statements of a program, each by itself."""

    def __init__(self, typed: TypedProgram) -> None:
        self.typed = typed
        self._instances = InstanceSearch(typed)
        self.leaving = LeavingSorts(self._instances)

    def of(self, statement: Statement, naturals: set[str]) -> tuple[SparcWarning, ...]:
        """Returns the warnings about a statement, ``naturals`` being its variables over ``#nat``.

        Raises `SourceError` where a sort is too large to be looked through.
        """
        return (*self.of_instances(statement, naturals), *self.of_text(statement))

    def of_text(self, statement: Statement) -> tuple[SparcWarning, ...]:
        """Returns the warnings for which hardly any sort is looked at."""
        head, body = _parts(statement)
        return (
            *_anonymous_warnings(statement, head, body),
            *rule_slips(self.typed, statement, head, body),
        )

    def of_instances(self, statement: Statement, naturals: set[str]) -> tuple[SparcWarning, ...]:
        """Returns the warnings about the values that its variables can have; the rest of `of`."""
        search = self._instances
        if isinstance(statement, RangeFact):
            return tuple(search.empty_range(statement))
        search.naturals = naturals
        head, body = _parts(statement)
        return (
            *search.unknown_names(body),
            *search.empty_parts(statement, head, body),
            *self.leaving.warnings(head, body),
        )


def _parts(statement: Statement) -> tuple[Head, tuple[BodyItem, ...]]:
    """Returns the head and the body of a statement."""
    if isinstance(statement, Rule | CrRule):
        return statement.head, statement.body
    if isinstance(statement, WeakConstraint):
        return (), statement.body
    if isinstance(statement, Optimize):
        return (), statement.atoms
    return (), ()


# ------------------------------------------------------------------ anonymous variables


def _anonymous_warnings(
    statement: Statement, head: Head, body: tuple[BodyItem, ...]
) -> Iterator[SparcWarning]:
    """Yields several ``_`` in one rule."""
    places = [each.span for each in variables(terms_of(head, body)) if each.name == "_"]
    if len(places) > 1:
        yield SparcWarning(
            f"this rule has {len(places)} anonymous variables, each a variable of its own",
            places[1] or statement.span,
            "the original system takes them for one: keep one, and give the others names",
        )
