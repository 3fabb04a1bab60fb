"""What people write who begin with SPARC, a file each: the place that is told, and the mend."""

from __future__ import annotations

import pytest

import sparc
from sparc.errors import SourceError, SourceErrors, SparcWarning
from sparc.source import Source
from tests.support.paths import ROOT

FOLDER = ROOT / "tests" / "sparc" / "mistakes"
MISTAKES = [  # the file, line and column, a part of the mend
    ("aggregate_in_round_brackets", "13:10", 'an aggregate has braces: #count{X : p(X)}'),
    ("aggregate_without_hash", "11:12", 'write "#count{…}", with #'),
    ("ampersand", "11:19", 'write a comma between literals'),
    ("and_as_a_word", "11:19", 'in a body write ","'),
    ("arguments_swapped", "11:1", '#person (line 2) does not have it; #nat, #num do'),
    ("arithmetic_in_a_range", "5:13", 'the ends of a range are numbers or constants, without arithmetic'),
    ("arity_for_sorts", "7:5", 'the arguments are told by their sorts: male(#s,#t).'),
    ("arrow_from_a_pdf", "11:8", 'write ":-"'),
    ("arrow_left", "11:8", 'write ":-"'),
    ("arrow_right", "11:9", 'write ":-", with the conclusion first'),
    ("arrow_with_space", "11:8", 'write ":-"'),
    ("bracket_closed_twice", "13:7", 'no bracket is open here: leave out ")"'),
    ("choice_with_commas", "11:9", 'part the elements of a choice by ";"'),
    ("colon_for_the_body", "11:8", 'write ":-" before a body'),
    ("comma_before_a_bracket", "7:14", 'leave out the comma before the bracket'),
    ("comma_before_dot", "11:20", 'leave out the comma before the dot'),
    ("comma_before_not_forgotten", "13:21", 'is a comma missing before "not"?'),
    ("comparison_as_a_head", "11:5", 'write a constraint'),
    ("const_without_hash", "1:1", 'directives begin with #: write #const'),
    ("constant_defined_too_late", "3:1", 'directives come first, before the sorts'),
    ("constant_with_a_capital", "1:8", 'constants begin with a lower-case letter: n'),
    ("constant_without_equals", "1:10", 'write #const n = 3.'),
    ("constants_with_a_comma", "1:13", 'each constant has a directive of its own'),
    ("declarations_with_commas", "7:14", 'each declaration ends with "."'),
    ("double_ampersand", "11:19", 'write a comma between literals'),
    ("double_not", "11:15", 'there is no double negation'),
    ("equal_or_greater_turned", "11:23", 'write ">=" instead of "=>"'),
    ("forall", "11:7", 'derive what breaks it, bad :- p(X), not q(X).'),
    ("greek_less_or_equal", "11:22", 'write "<="'),
    ("if_as_a_word", "11:8", 'write ":-"'),
    ("if_then", "13:1", 'write ":-", with the conclusion first'),
    ("is", "11:22", 'write "=" instead of "is"'),
    ("label_without_colon", "13:4", 'a label has ":" behind it: r1 : male'),
    ("lower_case_variable", "11:1", 'variables begin with a capital letter: X'),
    ("misspelt_constant", "11:1", 'did you mean ben?'),
    ("misspelt_predicate", "11:11", 'did you mean parent (declared at line 5)?'),
    ("modulo", "11:22", 'the remainder of X and Y is X - X/Y*Y'),
    ("named_arguments", "7:14", 'the arguments of a predicate are plain sort names'),
    ("negation_with_a_word", "11:1", 'write "-old", the sign touching the atom'),
    ("negative_range", "5:9", 'there are no negative numbers in a range'),
    ("no_closing_bracket", "11:9", 'close the bracket: ")"'),
    ("no_dot", "11:10", 'every statement ends with "."'),
    ("not_in_a_head", "11:1", '"not" cannot stand in a head: move the literal into the body'),
    ("number_outside_its_sort", "11:1", '#num (line 3) does not have it; #nat does'),
    ("percent_of_another_language", "11:11", 'a comment begins with "%"'),
    ("predicate_never_given", "7:1", 'write a fact or a rule for old, or a choice'),
    ("predicate_without_sorts", "4:5", 'sort names begin with #: write #person'),
    ("prolog_negation", "11:20", 'write "not"'),
    ("prolog_unequal", "11:27", 'write "!="'),
    ("quoted_name", "11:5", 'write an identifier, such as main_hall'),
    ("range_as_an_argument_sort", "9:14", 'a sort stands here by its name'),
    ("range_in_several_arguments", "11:11", 'elsewhere write a variable of a sort'),
    ("range_turned", "2:11", 'write 1..9'),
    ("range_with_a_dash", "5:9", 'a range has two dots: 1..5'),
    ("rules_behind_display", "9:1", 'rules stand before the section display (line 7)'),
    ("rules_forgotten", "5:1", 'write the section word "rules" before this'),
    ("section_with_a_colon", "1:1", 'white space must follow the section word "sorts"'),
    ("sections_forgotten", "1:1", 'sorts are defined in the first section, behind the word sorts'),
    ("semicolon_for_and", "11:18", 'literals are parted by ","'),
    ("set_without_braces", "5:9", 'a set is written in braces, its elements parted by commas: {hall, …}'),
    ("singleton_variable", "11:21", 'write _ if any element will do'),
    ("sort_in_round_brackets", "2:12", 'a set is written in braces: {ann}, {a, b}'),
    ("sort_inside_of_a_set", "5:10", 'unite it with a sort, #s + {a}'),
    ("sort_with_a_colon", "5:7", 'write "=": #room = …'),
    ("sort_without_hash", "2:1", 'sort names begin with #: write #person'),
    ("sorts_united_by_a_bar", "5:17", 'sorts have union +, difference - and intersection *'),
    ("three_dots", "5:12", 'two dots stand between the ends of a range: 1..9'),
    ("too_few_arguments", "11:11", 'it is declared at line 5 as parent(#person, #person)'),
    ("too_many_arguments", "11:11", 'it is declared at line 6 as male(#person)'),
    ("two_arrows", "11:19", 'a statement ends with "." before the next one begins'),
    ("unknown_sort", "4:5", 'did you mean #person (declared at line 2)?'),
    ("unsafe_head", "11:5", 'write _ if any element will do'),
    ("upper_case_constant", "11:6", 'is the constant ben meant? If not, write _'),
    ("upper_case_predicate", "11:1", 'names of predicates begin with a lower-case letter: old'),
    ("where_for_a_condition", "5:35", 'a condition stands behind ":"'),
]  # fmt: skip


def findings(name: str) -> list[SourceError]:
    """The faults of a program, or its warnings where it has none."""
    source = Source(name, (FOLDER / f"{name}.sparc").read_text(encoding="utf-8"))
    try:
        return list(sparc.find_warnings(sparc.check(sparc.parse(source))))
    except SourceErrors as errors:
        return list(errors.errors)
    except SourceError as error:
        return [error]


@pytest.mark.parametrize(("name", "place", "mend"), MISTAKES, ids=[row[0] for row in MISTAKES])
def test_a_mistake_is_told_with_its_place_and_its_mend(name: str, place: str, mend: str) -> None:
    found = findings(name)
    told = [
        error for error in found if error.span and str(error.span.location) == f"{name}:{place}"
    ]
    assert any(mend in (error.hint or "") for error in told), list(map(str, found))
    line = f":{place.split(':')[0]}:"
    others = [error for error in found if line not in str(error)]
    assert all(isinstance(error, SparcWarning) for error in others), "a follow-up fault"


def test_every_file_has_its_row() -> None:
    assert {path.stem for path in FOLDER.glob("*.sparc")} == {name for name, _, _ in MISTAKES}
    assert len(MISTAKES) >= 40
