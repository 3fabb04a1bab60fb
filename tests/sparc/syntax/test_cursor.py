"""What a fault of syntax says to do, whatever was expected there."""

from __future__ import annotations

import pytest

from sparc.errors import SourceError
from sparc.source import Source
from sparc.syntax.parser import parse

HEAD = "sorts\n#s = {a, b}.\npredicates\np(#s).\nq(#s, #s).\nok().\nrules\n"


@pytest.mark.parametrize(
    ("rule", "mend"),
    [
        ("p(a) p(b).", 'is a comma, a dot or an operator missing before "p"?'),
        ("q(a b).", 'is a comma, a dot or an operator missing before "b"?'),
        ("ok :- p(X) q(X, a).", 'is a comma, a dot or an operator missing before "q"?'),
        ("p(a)., ok.", "the statement ended with the dot: leave one of the two out"),
        ("ok :- p(a)..", 'one dot ends a statement: write "."'),
        ("p(a)..\np(b).", 'one dot ends a statement: write "."'),
        ("ok :- #S(X).", "write #s"),
    ],
)
def test_the_mend(rule: str, mend: str) -> None:
    with pytest.raises(SourceError) as caught:
        parse(Source("x", f"{HEAD}{rule}\n"))
    assert caught.value.hint == mend


@pytest.mark.parametrize("rule", ["q(a, 1..2).", "ok :- q(a..b, X)."])
def test_a_range_is_told_as_one(rule: str) -> None:
    with pytest.raises(SourceError) as caught:
        parse(Source("x", f"{HEAD}{rule}\n"))
    assert "a range stands only" in (caught.value.hint or "")
