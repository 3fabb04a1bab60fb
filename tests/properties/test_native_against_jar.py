"""The same program has the same answer sets here and with sparc.jar, its known defects apart."""

from __future__ import annotations

import pytest

from sparc.errors import SourceError, SourceErrors
from tests.support.answer_corpus import answer_sets, examples
from tests.support.jar import needs_jar
from tests.support.jar_runner import jar_answer_sets, many_jar_answer_sets
from tests.support.random_programs import random_program
from tests.support.sampling import mostly_slow

BATCH = 25
MOST_SETS = 400


def ours(program: str) -> tuple[str, ...] | None:
    """Our answer sets, None when we refuse the program."""
    try:
        return answer_sets(program, models=MOST_SETS, time_limit=20)
    except (SourceError, SourceErrors):
        return None


def compare(programs: list[str]) -> None:
    found = [ours(program) for program in programs]
    small = [index for index, sets in enumerate(found) if len(sets or ()) < MOST_SETS]
    theirs = many_jar_answer_sets(programs[index] for index in small)
    for index, expected in zip(small, theirs, strict=True):
        assert found[index] == expected, programs[index]


def corpus() -> list[str]:
    """The programs on which the two must agree."""
    return [example.source.text for example in examples() if example.jar_differs is None]


@needs_jar
@pytest.mark.wide
def test_many_in_one_java_say_what_each_says_alone() -> None:
    sort = "sorts #s = {a, b}. predicates p(#s). rules "
    programs = [f"{sort} p(X) | -p(X).", f"{sort} p(c).", f"{sort} p(a). -p(a).", "nonsense", sort]
    found = many_jar_answer_sets(programs)
    assert found == [jar_answer_sets(program) for program in programs]
    assert [sets if sets is None else len(sets) for sets in found] == [4, None, 0, None, 1]


@needs_jar
@pytest.mark.parametrize("first", mostly_slow([0, 10], 0))
def test_a_sample_of_the_corpus(first: int) -> None:
    compare(corpus()[first::20])


@needs_jar
@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, len(corpus()), BATCH))
def test_corpus(first: int) -> None:
    compare(corpus()[first : first + BATCH])


@needs_jar
@pytest.mark.wide
@pytest.mark.parametrize("first", mostly_slow(range(0, 200, 20), 0))
def test_random_programs(first: int) -> None:
    compare([random_program(seed) for seed in range(first, first + 20)])


@needs_jar
@pytest.mark.slow
@pytest.mark.parametrize("first", range(1000, 3000, BATCH))
def test_many_random_programs(first: int) -> None:
    compare([random_program(seed) for seed in range(first, first + BATCH)])


def test_random_programs_say_something() -> None:
    """Most random programs are accepted, and many have several answer sets."""
    found = [ours(random_program(seed)) for seed in range(60)]
    assert sum(sets is not None for sets in found) > 50
    assert sum(len(sets or ()) > 1 for sets in found) > 5
    assert sum(len(sets or ()) == 1 for sets in found) > 20
