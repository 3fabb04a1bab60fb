"""Whatever the text, the parser ends soon with a tree or with a fault that can be shown."""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from itertools import chain

import pytest

from sparc.diagnostics import as_dict, render
from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.cursor import MAX_FAULTS
from sparc.syntax.parser import parse
from sparc.syntax.printer import print_program
from tests.sparc.syntax.test_printer import WRITTEN
from tests.support.cases import CASES, read_cases

VOCABULARY = """
a b p q f X Y _ n 0 1 7 12 #a #b #nat #count #sum #minimize #maximize #const #maxint #show
not and or sorts predicates rules display . .. , ; : :- :+ :~ | @ # ( ) { } [ ] = == != < <=
> >= + - * / % $ " ' \\ ~ ! é 007 2x _y #S %* *%
"""
WORDS = VOCABULARY.split()
CHARACTERS = "abpXY_019#.,;:|@(){}[]=!<>+-*/%~ \t\r\n\f\x00'\"\\$&é\ufeff大"

GOOD = [WRITTEN] + [
    case.source.text for path in sorted(CASES.glob("syntax_*.sparc")) for case in read_cases(path)
]


def characters(random_: random.Random) -> str:
    """Any characters at all."""
    return "".join(random_.choices(CHARACTERS, k=random_.randrange(120)))


def decoded_bytes(random_: random.Random) -> str:
    """A file of any bytes, as a reader that forgives would decode it."""
    return random_.randbytes(random_.randrange(120)).decode("utf-8", "replace")


def words(random_: random.Random) -> str:
    """Words of the language in no order, with or without space between them."""
    between = random_.choice(["", " ", "\n"])
    start = random_.choice(
        ["", "rules ", "predicates rules ", "sorts #a = ", "predicates rules p:-"]
    )
    return start + between.join(random_.choices(WORDS, k=random_.randrange(40)))


def mutations(random_: random.Random) -> str:
    """A program that was right, or nearly so, with a few changes."""
    text = random_.choice(GOOD)
    for _ in range(random_.randint(1, 4)):
        first = random_.randrange(len(text) + 1)
        last = min(len(text), first + random_.choice([0, 1, 1, 2, 8]))
        piece = random_.choice(
            ["", " ", "\n", random_.choice(WORDS), random_.choice(CHARACTERS), text[first:last] * 2]
        )
        text = text[:first] + piece + text[last:]
    return text


def repetitions(random_: random.Random) -> str:
    """Pieces that open, close or go on, very often."""
    start = random_.choice(["", "predicates rules p(", "sorts #a = ", "predicates rules p :- "])
    piece = "".join(random_.choices(WORDS, k=random_.randint(1, 4)))
    return start + piece * random_.choice([50, 500, 3000])


def check_fault(error: SourceError, text: str) -> None:
    """A fault has a place in the text, and can be shown."""
    assert error.span is not None, text
    assert 0 <= error.span.start <= error.span.end <= len(text), text
    assert error.message.isprintable(), text
    assert error.hint is None or error.hint.isprintable(), text
    assert render(error).startswith("fuzz:"), text
    assert as_dict(error)["line"] == text[: error.span.start].count("\n") + 1, text


def try_out(make: Callable[[random.Random], str], seeds: Sequence[int]) -> tuple[int, int]:
    """Parses what ``make`` makes; the numbers of trees and of faults."""
    trees = 0
    for seed in seeds:
        text = make(random.Random(seed))
        began = time.process_time()
        try:
            program = parse(Source("fuzz", text))
        except SourceErrors as found:
            assert 1 < len(found.errors) <= MAX_FAULTS, text
            for error in found.errors:
                check_fault(error, text)
        except SourceError as error:
            check_fault(error, text)
        else:
            trees += 1
            assert parse(Source("printed", print_program(program))) == program, text
        assert time.process_time() - began < 2, text[:200]
    return trees, len(seeds) - trees


MAKERS = [characters, decoded_bytes, words, mutations, repetitions]


@pytest.mark.parametrize("make", MAKERS, ids=lambda make: make.__name__)
def test_any_text(make: Callable[[random.Random], str]) -> None:
    trees, faults = try_out(make, range(40 if make is repetitions else 400))
    assert faults > 0
    assert trees > 0 or make is not mutations


@pytest.mark.slow
@pytest.mark.parametrize("make", MAKERS, ids=lambda make: make.__name__)
def test_any_text_at_length(make: Callable[[random.Random], str]) -> None:
    few = make is repetitions
    seeds = chain(range(40 if few else 400), range(10_000, 10_600 if few else 60_000))
    trees, faults = try_out(make, list(seeds))
    assert faults > trees / 10
