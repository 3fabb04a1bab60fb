"""Every fault of a program is found, where it is, and none else."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sparc.checking.checker import check
from sparc.errors import LimitError, SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.tree import Number
from tests.support.cases import Case, case_parameters, check_case


def faults(source: Source) -> tuple[SourceError, ...]:
    try:
        check(parse(source))
    except SourceErrors as error:
        return error.errors
    except SourceError as error:
        return (error,)
    return ()


@pytest.mark.parametrize("case", case_parameters("check_*.sparc"))
def test_faults_are_found_where_they_are(case: Case) -> None:
    """And they come in the order of the text."""
    check_case(case, faults)
    places = [error.span.start for error in faults(case.source) if error.span]
    assert places == sorted(places)


def test_an_atom_is_marked_as_a_whole() -> None:
    text = "sorts #s = {a}.\npredicates\np(#s).\nrules\np(a) :- not -p(b).\n"
    (error,) = faults(Source("x", text))
    assert error.span is not None
    assert error.span.text == "-p(b)"
    assert str(error.span.location) == "x:5:13"


def test_deeply_built_sorts_are_refused_not_fatal() -> None:
    chain = "#s0 = {a}.\n" + "".join(f"#s{n + 1} = f(#s{n}).\n" for n in range(1000))
    found = faults(Source("x", f"sorts\n{chain}predicates p(#s1000).\nrules\n"))
    assert isinstance(found[0], LimitError)
    assert "levels deep" in found[0].message


def test_a_long_union_is_no_deep_one() -> None:
    chain = "#s0 = {a}.\n" + "".join(f"#s{n} = {{b{n}}}.\n" for n in range(1, 300))
    union = " + ".join(f"#s{n}" for n in range(300))
    assert not faults(
        Source("x", f"sorts\n{chain}#u = {union}.\npredicates p(#u).\nrules p(b299).")
    )


@pytest.mark.parametrize(
    ("program", "message"),
    [
        (
            "#maxint = 9000000. sorts #s = 1..9000000. predicates p(#s). rules p(1..9000000).",
            "the range 1..9000000 is too long to be listed",
        ),
        ("predicates p(). rules p. display q(a).", "unknown predicate q in the display section"),
        ("predicates p(). rules p. display q.", "unknown predicate q in the display section"),
    ],
)
def test_ranges_that_are_too_long_and_displays_of_nothing(program: str, message: str) -> None:
    assert [error.message for error in faults(Source("x", program))] == [message]


def test_a_number_that_no_text_could_have_is_refused_too() -> None:
    program = parse(Source("x", "#const n = 3. predicates p(). rules p."))
    (directive,) = program.directives
    huge = replace(program, directives=(replace(directive, value=Number(2**31)),))
    with pytest.raises(SourceErrors, match="numbers beyond 2147483647 cannot be handled"):
        check(huge)
