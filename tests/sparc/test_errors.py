"""Faults: their place, message and mend in one line, alone and several together."""

from __future__ import annotations

import pytest

from sparc.errors import (
    LimitError,
    MissingToolError,
    NumberError,
    RefusedProgramError,
    RuleError,
    SolverError,
    SourceError,
    SourceErrors,
    SparcSyntaxError,
    too_large,
)
from sparc.source import Source, Span

SPAN = Span(Source("p.sparc", "one\ntwo three\n"), 8, 13)


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (SourceError("wrong"), "wrong"),
        (SourceError("wrong", hint="mend it"), "wrong; mend it"),
        (SourceError("wrong", SPAN), "p.sparc:2:5: wrong"),
        (RuleError("wrong", SPAN, "mend it"), "p.sparc:2:5: wrong; mend it"),
    ],
)
def test_a_fault_is_one_line(error: SourceError, said: str) -> None:
    assert str(error) == said
    assert error.args == (error.message,)


def test_several_faults_are_lines_in_their_order() -> None:
    errors = SourceErrors([SourceError("one"), SourceError("two", hint="mend it")])
    assert str(errors) == "one\ntwo; mend it" and len(errors.errors) == 2
    assert not isinstance(errors, SourceError)


def test_what_was_refused_and_what_is_missing_say_more() -> None:
    refused = RefusedProgramError("unsafe variable")
    assert refused.details == "unsafe variable" and "clingo refused" in refused.message
    missing = MissingToolError("java", "no Java", "get it")
    assert (missing.tool, missing.hint) == ("java", "get it")
    assert isinstance(missing, SolverError) and isinstance(NumberError("x"), LimitError)
    assert SparcSyntaxError("x").expected is None


def test_a_program_is_too_large_where_some_fault_says_so() -> None:
    assert too_large([LimitError("deep"), NumberError("far")])
    assert too_large([RuleError("wrong"), LimitError("deep")])
    assert not too_large([RuleError("wrong")])
