"""Which statements of a domain ever did something in a case."""

from __future__ import annotations

from functools import cache

from tests.support.domain_cases import LAYOUT, domain
from waiter_cli.domain_tests.case_reader import read_cases
from waiter_cli.domain_tests.coverage import Statement, find_coverage
from waiter_cli.domain_tests.programs import make_programs

TEMPLATE = domain("restaurant")[0]


@cache
def covered(cases: str) -> dict[str, Statement]:
    programs = make_programs(TEMPLATE, read_cases(LAYOUT + cases, "mine.yaml"))
    return {statement.text: statement for statement in find_coverage(TEMPLATE, programs)}


WALK = "  - {name: walk, when: ['go_to(agent, n1)'], exactly: 1}\n"
STAY = "  - {name: stay, when: [nothing], exactly: 1}\n"


def fired(cases: str) -> set[str]:
    return {text for text, statement in covered(cases).items() if statement.fired}


def test_a_walk_fires_what_staying_does_not() -> None:
    more = fired(WALK) - fired(STAY)
    assert any("occurs(go_to(agent" in text for text in more), more
    assert fired(WALK + STAY) == fired(WALK) | fired(STAY)


def test_what_nothing_is_about_never_fires() -> None:
    silent = {text for text, s in covered(WALK).items() if not s.fired}
    assert any("give_bill" in text or "bill" in text for text in silent)


def test_a_constraint_fires_where_it_forbids_something() -> None:
    both = (
        "  - {name: both, impossible: true, given: {state: {seated: {table1: [c1]}}, "
        "facts: ['holds(iswaiting(c1), 0)']}}\n"
    )
    constraints = {text for text in covered(WALK) if text.startswith(":-")}
    assert constraints & fired(both) and not constraints & fired(WALK)


def test_statements_have_their_places_in_order_and_their_sentences() -> None:
    found = list(covered(WALK).values())
    assert [statement.place for statement in found] == sorted(s.place for s in found)
    lines = TEMPLATE.text.split("\n")
    for statement in found:
        line, column = statement.place
        assert "".join(statement.text.split())[:8] in "".join(lines[line - 1 :][0:9]).replace(
            " ", ""
        )
        assert column >= 1
    assert sum(bool(statement.sentence) for statement in found) > len(found) / 2
