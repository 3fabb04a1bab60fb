"""Constants from outside: they give way in place, new ones come before, slips are told."""

from __future__ import annotations

import pytest

import sparc
from sparc.errors import SourceError
from sparc.source import Source
from sparc.syntax.constants import set_constants

TEXT = "#const n = 2.\n#const last = 9.\nsorts\n#s = 1..n.\npredicates\np(#s).\nrules\np(n).\n"
SOURCE = Source("p.sparc", TEXT)


def answer(source: Source) -> str:
    (found,) = sparc.solve(sparc.check(sparc.parse(source)))
    return str(found)


def test_a_setting_wins_over_the_directive() -> None:
    assert answer(SOURCE) == "{p(2)}" and answer(set_constants(SOURCE, ["n=7"])) == "{p(7)}"


def test_a_constant_without_a_directive_is_new() -> None:
    source = Source("p.sparc", TEXT.replace("#const n = 2.\n", "\n"))
    assert answer(set_constants(source, [" n = 3 "])) == "{p(3)}"


def test_every_place_stays_where_it_is() -> None:
    source = set_constants(SOURCE, ["n=7", "last=1"])
    (statement,) = sparc.parse(source).statements
    assert str(statement.span.location) == "p.sparc:8:1"
    assert source.text.endswith(TEXT[TEXT.index("sorts") :])


def test_nothing_set_is_the_same_source() -> None:
    assert set_constants(SOURCE, []) is SOURCE


@pytest.mark.parametrize(
    ("settings", "message", "hint"),
    [
        (["n"], "-c n: not the value of a constant", "write -c n=7"),
        (["n=07"], "-c n=07: not the value of a constant", "write -c n=7"),
        (["N=7"], "-c N=7: not the value of a constant", "write -c n=7"),
        (["n=99999999999"], "-c n=99999999999: not the value", "write -c n=7"),
        (["n=1", "n=2"], "-c n=2: the constant n is given twice", ""),
        (["lost=1"], "the program has no constant lost", "did you mean last?"),
        (["zzz=1"], "the program has no constant zzz", "its constants are n, last"),
    ],
)
def test_slips_are_told(settings: list[str], message: str, hint: str) -> None:
    with pytest.raises(SourceError) as caught:
        set_constants(SOURCE, settings)
    assert message in caught.value.message and (caught.value.hint or "").startswith(hint)
