"""Hypothesis strategies for SPARC trees: only such as some program text is read into.

Trees need not pass the type check: names are used without being declared.  What the grammar
asks for holds (no arithmetic on symbols, no order between numbers and symbols, and so on), for
the constants in ``CONSTANTS``, which every program defines.
"""

from __future__ import annotations

from hypothesis import strategies as st

from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    And,
    Arithmetic,
    Atom,
    Choice,
    ChoiceElement,
    Comparison,
    Concatenation,
    ConditionTest,
    ConstDirective,
    CrRule,
    DisplayItem,
    DisplaySort,
    Guard,
    Identifier,
    IdentifierList,
    IdentifierRange,
    MaxintDirective,
    Naf,
    Not,
    Number,
    NumericRange,
    Optimize,
    Or,
    PredicateDeclaration,
    Program,
    RangeFact,
    Record,
    RecordSort,
    RecordSortArgument,
    Rule,
    SetExpression,
    SortAtom,
    SortDefinition,
    SortName,
    TermSet,
    Variable,
    WeakConstraint,
)

__all__ = ["CONSTANTS", "programs", "sort_expressions", "statements", "terms"]

CONSTANTS = ("n", "rules")
"""Constants of every generated program; one is spelled like a section word."""

RESERVED = {"not", "and", "or"}
RESERVED_SORTS = {"const", "maxint", "count", "sum", "min", "max", "show", "hide", "avg", "times"}


def tuples(items: st.SearchStrategy, least: int = 1, most: int = 3) -> st.SearchStrategy[tuple]:
    """Tuples of ``least`` to ``most`` items."""
    return st.lists(items, min_size=least, max_size=most).map(tuple)


names = st.one_of(
    st.sampled_from(["a", "b", "p", "nota", "v", "display", "sorts", "predicates", "x_1"]),
    st.from_regex(r"[a-z][A-Za-z0-9_]{0,4}", fullmatch=True).filter(lambda n: n not in RESERVED),
)
symbols = names.filter(lambda name: name not in CONSTANTS)
sort_names = names.filter(lambda n: n not in RESERVED_SORTS)
variable_names = st.one_of(
    st.sampled_from(["X", "Y", "_"]), st.from_regex(r"[A-Z][A-Za-z0-9_]{0,3}", fullmatch=True)
)

# ------------------------------------------------------------------ terms

variables = st.builds(Variable, variable_names)
numbers = st.builds(Number, st.one_of(st.integers(0, 9), st.integers(0, MAX_NUMBER)))
constants = st.builds(Identifier, st.sampled_from(CONSTANTS))
identifiers = st.builds(Identifier, st.one_of(names, st.sampled_from(CONSTANTS)))
numeric_leaves = st.one_of(variables, numbers, constants)
numeric_terms = st.recursive(
    numeric_leaves,
    lambda inner: st.builds(Arithmetic, st.sampled_from("+-*/"), inner, inner),
    max_leaves=5,
)
terms = st.recursive(
    st.one_of(numeric_terms, identifiers),
    lambda inner: st.builds(Record, names, tuples(inner)),
    max_leaves=4,
)
ground_terms = st.recursive(
    st.one_of(numbers, identifiers),
    lambda inner: st.builds(Record, names, tuples(inner)),
    max_leaves=4,
)
values = st.one_of(numbers, identifiers)

# ------------------------------------------------------------------ sorts

numeric_ranges = st.one_of(
    st.builds(NumericRange, numbers, values),
    st.builds(NumericRange, values, numbers),
    st.builds(NumericRange, constants, constants),
)
symbol_terms = st.builds(Identifier, symbols)
identifier_ranges = st.one_of(
    st.builds(IdentifierRange, symbol_terms, identifiers),
    st.builds(IdentifierRange, identifiers, symbol_terms),
)
sort_references = st.builds(SortName, sort_names)
operators = st.sampled_from(["=", "!=", "<", "<=", ">", ">="])
conditions = st.recursive(
    st.builds(ConditionTest, variables, operators, variables),
    lambda inner: st.one_of(
        st.builds(Not, inner),
        st.builds(And, tuples(inner, 2)),
        st.builds(Or, tuples(inner, 2)),
    ),
    max_leaves=6,
)
record_sorts = st.builds(
    RecordSort,
    names,
    tuples(st.builds(RecordSortArgument, sort_references, st.none() | variables)),
    st.none() | conditions,
)
term_sets = st.builds(TermSet, tuples(ground_terms, 0))
set_expressions = st.recursive(
    st.one_of(sort_references, term_sets, record_sorts),
    lambda inner: st.builds(SetExpression, st.sampled_from("+-*"), inner, inner),
    max_leaves=8,
)
concatenations = st.builds(
    Concatenation,
    tuples(
        st.one_of(
            numeric_ranges,
            identifier_ranges,
            st.builds(IdentifierList, tuples(identifiers)),
            sort_references,
        )
    ),
)
sort_expressions = st.one_of(numeric_ranges, identifier_ranges, set_expressions, concatenations)

# ------------------------------------------------------------------ literals

atoms = st.builds(Atom, names, tuples(terms, 0), st.booleans())
sort_atoms = st.builds(SortAtom, sort_names, tuples(terms, 0, 2), st.booleans())


def symbolic(term: object) -> bool:
    """Whether a term is a record or an identifier that is no constant."""
    return isinstance(term, Record) or (isinstance(term, Identifier) and term.name not in CONSTANTS)


def comparable(item: Comparison) -> bool:
    """Whether the sides of a comparison may stand beside its operator."""
    sides = (item.left, item.right)
    mixed = any(map(symbolic, sides)) and any(isinstance(s, (Number, Arithmetic)) for s in sides)
    return item.operator in ("=", "!=") or not mixed


literals = st.one_of(
    atoms,
    sort_atoms,
    st.builds(Naf, st.one_of(atoms, sort_atoms)),
    st.builds(Comparison, terms, operators, terms).filter(comparable),
)
guards = st.none() | st.builds(Guard, operators, terms)
bounds = st.none() | st.builds(Guard, operators, numeric_terms)
aggregates = st.builds(
    Aggregate,
    st.sampled_from(["count", "sum", "min", "max"]),
    tuples(st.builds(AggregateElement, tuples(terms), tuples(literals, 1, 2)), 1, 2),
    guards,
    guards,
)
bodies = tuples(st.one_of(literals, literals, aggregates), 1, 3)

# ------------------------------------------------------------------ statements

head_atoms = st.builds(Atom, names, tuples(terms, 0), st.booleans()) | st.builds(
    SortAtom, sort_names, tuples(terms, 0, 2)
)
choices = st.builds(
    Choice, tuples(st.builds(ChoiceElement, head_atoms, tuples(literals, 0, 2))), bounds, bounds
)
heads = tuples(head_atoms) | choices
no_body = st.just(())
parameters = st.one_of(variables, numbers, identifiers)


@st.composite
def optimizations(draw: st.DrawFn) -> Optimize:
    """``#minimize`` and ``#maximize``, the priority behind any parameter."""
    found = draw(tuples(parameters))
    priority = draw(st.none() | values)
    index = draw(st.integers(0, len(found) - 1)) if priority is not None else 0
    return Optimize(draw(st.booleans()), found, priority, draw(tuples(atoms)), priority_index=index)


statements = st.one_of(
    st.builds(Rule, heads, no_body | bodies),
    st.builds(Rule, no_body, bodies),
    st.builds(RangeFact, names, values, values, st.booleans()),
    st.builds(CrRule, st.none() | names, heads, no_body | bodies),
    st.builds(CrRule, st.none(), no_body, bodies),
    st.builds(WeakConstraint, bodies, st.none() | parameters, st.none() | parameters),
    optimizations(),
)
display_items = st.one_of(
    st.builds(DisplayItem, names, st.none() | tuples(terms), st.booleans()),
    st.builds(DisplaySort, sort_names, st.none() | terms),
)

# ------------------------------------------------------------------ programs

fixed = tuple(ConstDirective(name, Number(index)) for index, name in enumerate(CONSTANTS))
directives = st.just(fixed) | st.builds(
    lambda value: (*fixed, MaxintDirective(value)), st.one_of(numbers, constants)
)
programs = st.builds(
    Program,
    directives,
    tuples(st.builds(SortDefinition, sort_names, sort_expressions), 0),
    tuples(st.builds(PredicateDeclaration, names, tuples(sort_references, 0)), 0),
    tuples(statements, 0, 4),
    st.none() | tuples(display_items, 0),
)
