"""Listings of answer sets: what is kept tells them apart, and the end says what is known."""

from __future__ import annotations

import time

import pytest

from sparc.source import Source
from sparc.syntax.parser import parse
from waiter_cli.answersets import enumerate as enumerating
from waiter_cli.answersets.enumerate import AnswerListing, prepare, shown_names, timeline_of
from waiter_cli.answersets.timeline import Filter, Order, read_patterns
from waiter_cli.errors import InputError
from waiter_cli.translators.native import NativeTranslator

PROGRAM = """\
sorts
#node = {a, b}.
#step = 0..1.
#alias = #step.
#fluent = at(#node).
predicates
holds(#fluent, #step).
mark(#node).
rules
holds(at(a), 0).
holds(at(a), 1) | holds(at(b), 1).
mark(a) | mark(b).
"""


def listing(text: str = PROGRAM, *patterns: str, **options: object) -> AnswerListing:
    program, timeline = prepare(Source("p.sparc", text), NativeTranslator())
    return AnswerListing(program, timeline, Filter(read_patterns(patterns)), **options)


def told(found: AnswerListing) -> list[list[str]]:
    return sorted(sorted(map(str, answer_set.literals)) for answer_set in found)


def test_each_is_listed_once() -> None:
    found = listing()
    assert len(told(found)) == 4
    assert (found.satisfiable, found.complete, found.limit_reached) == (True, True, None)


def test_sets_are_one_when_they_agree_in_what_is_kept() -> None:
    assert told(listing(PROGRAM, "^mark")) == [["mark(a)"], ["mark(b)"]]


def test_sets_are_one_when_they_agree_in_a_projection() -> None:
    found = told(listing(projection=frozenset({"mark"})))
    assert [[text for text in texts if "mark" in text] for texts in found] == [
        ["mark(a)"],
        ["mark(b)"],
    ]


def test_a_limit_leaves_it_open_that_there_are_more() -> None:
    found = listing(limit=3)
    assert len(told(found)) == 3
    assert not found.complete and not found.open_end
    exact = listing(limit=4)
    assert len(told(exact)) == 4 and exact.complete


def test_no_time_is_told() -> None:
    found = listing(deadline=time.monotonic() - 1)
    assert told(found) == []
    assert (found.satisfiable, found.limit_reached) == (None, "time")


def test_too_little_memory_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(self: AnswerListing) -> object:
        raise MemoryError

    monkeypatch.setattr(AnswerListing, "_search", full)
    found = listing()
    assert told(found) == [] and found.limit_reached == "memory"


def test_an_inconsistent_program_has_none() -> None:
    found = listing(PROGRAM + ":- mark(a).\n:- mark(b).\n")
    assert told(found) == []
    assert (found.satisfiable, found.complete) == (False, True)


def test_a_pattern_in_the_other_case_is_noticed() -> None:
    found = listing(PROGRAM, "^MARK")
    assert told(found) == [[]]
    assert found.overlooked()
    other = listing(PROGRAM, "^none")
    assert told(other) == [[]] and not other.overlooked()


def test_sorts_with_an_element_that_is_shown_are_named_as_in_sparc() -> None:
    program, _ = prepare(Source("p.sparc", PROGRAM), NativeTranslator())
    assert shown_names(program) == {"holds", "mark"}
    shown, _ = prepare(Source("p.sparc", PROGRAM + "display\nmark. #node.\n"), NativeTranslator())
    assert shown_names(shown) == {"mark", "#node"}


def test_the_sort_of_time_may_be_named() -> None:
    tree = parse(Source("p.sparc", PROGRAM))
    assert timeline_of(tree, Order("#step")).has_steps
    with pytest.raises(InputError) as told_by:
        timeline_of(tree, Order("stepp"))
    fault = told_by.value.faults[0]
    assert fault.message == "--time-sort: the program has no sort #stepp"
    assert fault.hint == "did you mean #step?"


def test_no_more_is_looked_for_than_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    """A listing that has what was asked for does not look for one more without an end."""
    monkeypatch.setattr(enumerating, "MORE_SECONDS", 0.05)
    pigeons = PROGRAM.replace("mark(a) | mark(b).", "").replace(
        "sorts\n", "sorts\n#hole = 1..10.\n#bird = 1..11.\n"
    ).replace("rules\n", "in(#bird, #hole).\nrules\n") + (
        "mark(a) | mark(b).\n1 {in(B, H) : #hole(H)} 1 :- mark(a), #bird(B).\n"
        ":- in(B, H), in(C, H), B != C.\n"
    )
    found = listing(pigeons, "^mark", limit=1)
    began = time.monotonic()
    assert told(found) == [["mark(b)"]]
    assert found.open_end and time.monotonic() - began < 5
