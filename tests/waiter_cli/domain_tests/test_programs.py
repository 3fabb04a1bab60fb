"""Cases put into programs: which share one, where their lines come from, and goals set aside."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from sparc.source import Source
from tests.support.domain_cases import LAYOUT, domain
from waiter_cli.domain_tests.case_reader import read_cases
from waiter_cli.domain_tests.programs import CaseProgram, make_programs, statement_place
from waiter_cli.errors import InputError

TEMPLATE = domain("restaurant")[0]
WALK = "  - {name: walk, when: ['go_to(agent, n1)'], exactly: 1}\n"
STAY = "  - {name: stay, when: [nothing], exactly: 1}\n"
FAR = "  - {name: far, when: [nothing, nothing], exactly: 1}\n"


def programs(cases: str, template: Source = TEMPLATE) -> Sequence[CaseProgram]:
    return make_programs(template, read_cases(LAYOUT + cases, "mine.yaml"))


def test_cases_of_one_length_share_a_program_and_others_do_not() -> None:
    first, second = programs(WALK + FAR + STAY)
    assert (first.indices, second.indices) == ((0, 2), (1,))
    assert [case.name for case in first.cases] == ["walk", "stay"]
    assert len(first.claims) == 2 and first.claims[1].when == (None,)


def test_cases_with_other_guests_share_one_and_those_of_another_room_do_not() -> None:
    guests = "  - {name: guests, given: {state: {waiting: [[c1]]}}, when: [nothing], exactly: 1}\n"
    other = "  - {name: room, when: [nothing], exactly: 1, layout: {nodes: [x], edges: [], entrance: x, tables: {}, agent: x}}\n"
    assert [program.indices for program in programs(WALK + guests + other)] == [(0, 1), (2,)]


def test_what_is_given_holds_in_its_case_only() -> None:
    (program,) = programs(WALK + STAY)
    given = [line for line in program.lines if "__case(1)" in line]
    assert given and all(line.endswith("__case(1).") for line in given)
    assert "#external __case(0..1)." in program.asp().text
    assert program.asp(["a."]).text.startswith("a.\n")


def test_facts_hold_under_a_name_of_their_own() -> None:
    (program,) = programs(
        "  - {name: facts, given: {facts: ['occurs(go_to(agent, n1), 0)']}, exactly: 1}\n"
    )
    assert [line for line in program.lines if "__facts(0)" in line] == [
        "occurs(go_to(agent,n1),0):-__facts(0)."
    ]


def test_a_case_without_goals_gets_one_that_is_reached_at_its_end() -> None:
    (program,) = programs(WALK)
    assert program.lines[-2:] == ("required(0):-__case(0).", "reached(0,1):-__case(0).")
    (asked,) = programs("  - {name: goal, given: {goals: [{at: n1}]}, exactly: 1}\n")
    assert not [line for line in asked.lines if line.startswith("reached(0,")]


def test_lines_know_the_statement_that_they_translate() -> None:
    (program,) = programs(WALK)
    assert len(program.lines) == len(program.places)
    texts = TEMPLATE.text.split("\n")
    known = {place for place in program.places if place is not None}
    assert len(known) > 20
    for line, column in known:
        assert texts[line - 1][column - 1 :].strip() and not texts[line - 1].startswith("%")
    statement = program.typed.program.statements[-1]
    assert statement_place(statement.span, "another.sparc") is None


def test_a_template_without_rules_is_refused() -> None:
    with pytest.raises(InputError) as caught:
        programs(WALK, Source("d.sparc", "sorts\n#s = {a}.\npredicates\np(#s).\n"))
    assert "no line begins the rules" in str(caught.value)


def test_all_faults_of_all_cases_come_at_once() -> None:
    wrong = "  - {name: one, when: ['go_too(agent, n1)'], exactly: 1}\n  - {name: two, then: ['hold(x, 1)']}\n"
    with pytest.raises(InputError) as caught:
        programs(wrong)
    assert len(caught.value.faults) == 2
