"""What a problem says in the words of its domain: looked up in it, and observed under its names."""

from __future__ import annotations

import pytest

import waiter_cli
from tests.support.own_domains import dirty_domain
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.own_words import observed_lines
from waiter_cli.encoding.template import fill_template
from waiter_cli.errors import InputError
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.problem import Problem

LAYOUT = waiter_cli.read_layout("bistro")
HAS_LEFT = "holds(isdirty(T), I) :- obs(has_left(T), true, I)."
SPILLED = "holds(isdirty(T), I) :- obs(spilled(T), true, I)."


def problem(text: str) -> Problem:
    return waiter_cli.pose_problem(LAYOUT, read_scenario(text, "s.yaml", LAYOUT))


def test_everything_observed_reaches_a_program_that_has_a_name_for_it() -> None:
    posed = problem("""
state: {seated: {table1: [c1, c2], table2: [c3]}, waiting: [[c9]]}
observe:
  - leave: c2
  - leave: c9
  - order: table2
  - free: table3
  - at: {agent: mid2}
  - obs: spilled(table3)
""")
    lines = [line.text for line in observed_lines(dirty_domain().template, posed)]
    assert lines == [
        "obs(has_left(table1), true, 0).",
        "obs(ready_to_order(table2), true, 0).",
        "obs(seen_free(table3), true, 0).",
        "obs(seen_at(agent, mid2), true, 0).",
        "obs(spilled(table3), true, 0).",
    ]
    assert observed_lines(dirty_domain().template, posed)[0].where is not None


@pytest.mark.parametrize("domain", ["restaurant", "report"])
def test_shipped_programs_are_as_they_were(domain: str) -> None:
    posed = problem("{state: {seated: {table1: [c1]}}, observe: [{leave: c1}, {free: table1}]}")
    assert observed_lines(find_domain(domain).template, posed) == []


def test_what_is_observed_makes_a_fluent_true() -> None:
    text = "{state: {seated: {table1: [c1]}}, observe: [{leave: c1}], "
    text += "goals: [{holds: isdirty(table1)}, {holds_not: isdirty(table2)}, {at: south2}]}"
    answer = waiter_cli.plan(problem(text), domain=dirty_domain(HAS_LEFT))
    assert answer.plan is not None and answer.plan.horizon == 2
    assert waiter_cli.plan(problem(text), domain=dirty_domain(), max_steps=3).plan is None


def test_facts_and_fluents_hold_at_the_start() -> None:
    text = (
        "{state: {fluents: [isdirty(table1)]}, facts: ['holds(isdirty(table2), 0)'], "
        "goals: [{holds: isdirty(table1)}, {holds: isdirty(table2)}]}"
    )
    answer = waiter_cli.plan(problem(text), domain=dirty_domain())
    assert answer.plan is not None and answer.plan.horizon == 0
    assert answer.document()["facts"] == ["holds(isdirty(table2),0)"]
    start = answer.document()["initial_state"]
    assert start["fluents"] == ["isdirty(table1)", "isdirty(table2)"]


@pytest.mark.wide
def test_a_shipped_domain_takes_goals_about_its_fluents() -> None:
    posed = problem("{goals: [{holds: isfree(table1)}, {at: mid2}]}")
    near = waiter_cli.pose_problem(LAYOUT, goals=["at: mid2"])
    plan, least = waiter_cli.plan(posed).plan, waiter_cli.plan(near).plan
    assert plan is not None and least is not None and plan.horizon == least.horizon


@pytest.mark.parametrize(
    ("text", "place", "said", "hint"),
    [
        (
            "goals: [{holds: isdirty(tabel1)}]",
            "s.yaml:1:17",
            "tabel1 is no table, in isdirty(tabel1)",
            "did you mean table1?",
        ),
        (
            "goals: [{holds: isdrity(table1)}]",
            "s.yaml:1:17",
            "the domain has no fluent isdrity",
            "did you mean isdirty?",
        ),
        (
            "goals: [{holds: isdirty}]",
            "s.yaml:1:17",
            "isdirty has another form",
            "write isdirty(TABLE)",
        ),
        (
            "observe: [{obs: spiled(table1)}]",
            "s.yaml:1:17",
            "the domain has no observable spiled",
            "did you mean spilled?",
        ),
        (
            "state: {fluents: [isattable(c1, table1)]}",
            "s.yaml:1:19",
            "isattable is no fluent of the domain's own",
            "say it under seated: in the state",
        ),
        (
            "state: {fluents: [isfree(table1)]}",
            "s.yaml:1:19",
            "isfree(table1) is no inertial fluent",
            "leave it out",
        ),
        (
            "facts: ['holds(isdirty(table1), 7)']",
            "s.yaml:1:9",
            "7 is not in sort #step",
            "",
        ),
        ("facts: ['hold(isdirty(table1), 0)']", "s.yaml:1:9", "hold", "holds"),
    ],
)
def test_what_a_domain_does_not_know(text: str, place: str, said: str, hint: str) -> None:
    with pytest.raises(InputError) as raised:
        waiter_cli.plan(problem(text), domain=dirty_domain())
    (fault,) = raised.value.faults
    assert str(fault.where) == place
    assert said in fault.message and hint in (fault.hint or "")


def test_a_domain_that_takes_no_situation_says_so() -> None:
    domain = find_domain("restaurant")
    bare = domain.template.text.replace("%{ state", "%{ bar")
    from dataclasses import replace

    from sparc.source import Source

    own = replace(domain, template=Source("own.sparc", bare), built_in=False)
    with pytest.raises(InputError, match="it has no slot state"):
        fill_template(own.template, problem("goals: [{holds: isfree(table1)}]"), 1)
