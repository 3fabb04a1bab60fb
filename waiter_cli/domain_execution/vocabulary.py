"""The words of a domain's own: `Domain` → `Vocabulary`, the terms that a person may tell or wish.

Entry point `vocabulary_of`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product
from typing import TYPE_CHECKING, NamedTuple

from sparc.lazy_dataclass import dataclass
from waiter_cli.domain_execution.step_program import step_source
from waiter_cli.encoding.domains import Domain, domain_for
from waiter_cli.encoding.own_words import KEY_OF_FLUENT, OBSERVABLES
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import State

if TYPE_CHECKING:
    from sparc.sorts.extents import Extent

__all__ = ["Form", "Phrase", "Vocabulary", "vocabulary_of"]

MOST_TERMS = 400
"""So many terms of a form are listed; whoever wants others writes them."""
HOUSE_OBSERVABLES = frozenset({*OBSERVABLES.values(), "has_entered", "group", "bill_wave"})
CUSTOMERS = "customer"


class Phrase(NamedTuple):
    """A term as SPARC writes it, and what it is about."""

    term: str
    about: tuple[str, ...] = ()


@dataclass(frozen=True)
class Form:
    """A name with the values that each of its arguments can have; None for the guests who are inside."""

    name: str
    arguments: tuple[tuple[str, ...] | None, ...] = ()

    def phrases(self, guests: Sequence[str]) -> Iterator[Phrase]:
        """Yields its terms, `MOST_TERMS` at most.

        >>> list(Form("spilled", (("table1",),)).phrases(()))
        [Phrase(term='spilled(table1)', about=('table1',))]
        >>> list(Form("raining").phrases(()))
        [Phrase(term='raining', about=())]
        """
        values = [guests if each is None else each for each in self.arguments]
        for given in islice(product(*values), MOST_TERMS):
            yield Phrase(f"{self.name}({','.join(given)})" if given else self.name, given)


@dataclass(frozen=True)
class Vocabulary:
    """The forms of a domain's own observables and inertial fluents; empty for a built-in domain."""

    observables: tuple[Form, ...] = ()
    fluents: tuple[Form, ...] = ()


def vocabulary_of(domain: Domain, layout: Layout, state: State) -> Vocabulary:
    """Returns what a domain has words for in a restaurant that a scenario has none for.

    Raises `InputError` where the template cannot be filled, `SourceErrors` where its program is wrong.
    """
    if domain.built_in:
        return Vocabulary()
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse

    problem = Problem(layout, state, (), state, ())
    typed = check(parse(step_source(domain_for(problem, domain).template, problem, 0)))
    seen, inertial = typed.predicates.get("obs"), typed.sorts.get("inertial_fluent")
    return Vocabulary(
        () if seen is None else _forms(seen.sorts[0].extent, HOUSE_OBSERVABLES),
        () if inertial is None else _forms(inertial.extent, KEY_OF_FLUENT),
    )


def _forms(extent: Extent, known: Mapping[str, str] | frozenset[str]) -> tuple[Form, ...]:
    """Returns the forms of a sort whose names are not ``known``, by name."""
    forms = []
    for name, arity in sorted(extent.signatures()):
        for records in () if name in known else extent.boxes(name, arity) or ():
            forms.append(Form(name, tuple(map(_values, records.arguments))))
    if extent.bound() < MOST_TERMS:
        plain = sorted(each for each in extent if isinstance(each, str) and each not in known)
        forms += [Form(name) for name in plain]
    return tuple(forms)


def _values(sort: object) -> tuple[str, ...] | None:
    """Returns the values of an argument as SPARC writes them."""
    from sparc.sorts.extents import Sort
    from sparc.sorts.values import text

    assert isinstance(sort, Sort)
    if sort.name == CUSTOMERS:
        return None
    return tuple(map(text, islice(sort.extent, MOST_TERMS)))
