"""A program that the jar would count wrongly is refused, all others pass."""

from __future__ import annotations

import pytest

from sparc.errors import NumberError
from sparc.solving.jar_numbers import refuse_overflow
from sparc.source import Source

HEAD = "#maxint = 100000.\nsorts\n#n = 0..100000.\npredicates\np(#n). q().\nrules\n"


@pytest.mark.parametrize(
    ("rule", "place", "message"),
    [
        ("p(90000). q :- p(X), X*X > 5.", "x:7:22", "90000*90000 is 8100000000, beyond 2147483647"),
        ("p(90000). p(X*X/X) :- p(X).", "x:7:13", "90000*90000 is 8100000000"),
    ],
)
def test_a_result_beyond_32_bits(rule: str, place: str, message: str) -> None:
    with pytest.raises(NumberError) as caught:
        refuse_overflow(Source("x", HEAD + rule))
    assert message in caught.value.message and "--translator native" in (caught.value.hint or "")
    assert caught.value.span is not None and str(caught.value.span.location) == place


@pytest.mark.parametrize(
    "rule",
    [
        "p(3). q :- p(X), X*X > 5.",
        "q :- p(X), X*X > 5.",
        "q.",
        "q :- r.",
        "q q.",
        "p(X) :- -p(X+1).",
    ],
    ids=["small", "without instance", "no arithmetic", "unknown", "no program", "negative"],
)
def test_what_passes(rule: str) -> None:
    refuse_overflow(Source("x", HEAD + rule))


def test_no_time_is_said() -> None:
    with pytest.raises(TimeoutError):
        refuse_overflow(Source("x", HEAD + "p(3). q :- p(X), X*X > 5."), time_limit=0.0)
