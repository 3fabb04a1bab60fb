"""Words of a domain of one's own in scenarios: facts, fluents, observations and goals."""

from __future__ import annotations

import pytest

from waiter_cli.errors import LayoutError, Where
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.own_terms import plain_term
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.state import Fact, Goal, Observation

HALL = read_layout(
    "{nodes: [a, b], edges: [[a, b]], entrance: a, agent: a, "
    "tables: {t1: {capacity: 2, nodes: [b]}}}",
    "hall.yaml",
)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("isdirty(t1)", "isdirty(t1)"),
        (" on ( b1 , pile( 3 ) ) ", "on(b1,pile(3))"),
        ("raining", "raining"),
        ("on(b1", None),
        ("on(b1))", None),
        ("on(,b1)", None),
        ("on()", None),
        ("on(B)", None),
        ("a b", None),
        ("a(b) c", None),
        ("a(07)", None),
        ("7", None),
        ("a. b", None),
        ("a :- b", None),
        ("f(" * 13 + "a" + ")" * 13, None),
        ("a" * 401, None),
        ("", None),
    ],
)
def test_terms(text: str, found: str | None) -> None:
    assert plain_term(text) == found


def test_every_key_of_ones_own_is_read() -> None:
    scenario = read_scenario(
        """
state: {fluents: [isdirty(t1), 'on(b1, b2)', on(b2, t1)]}
observe: [{obs: spilled(t1)}, {obs: fell(b1, b2)}]
facts: ['holds(isdirty(t1), 0).', heavy(b1), -heavy(b2)]
goals:
  - holds: on(b1, t1)
  - {holds_not: on(b2, b1)}
before: [[{holds: isdirty(t1)}, {holds_not: isdirty(t1)}]]
events: [{time: 3, obs: spilled(t1)}]
""",
        "s.yaml",
        HALL,
    )
    assert scenario.state.fluents == ("isdirty(t1)", "on(b1,b2)", "on(b2,t1)")
    assert scenario.observe == (
        Observation("obs", ("spilled(t1)",)),
        Observation("obs", ("fell(b1,b2)",)),
    )
    facts = ("holds(isdirty(t1),0)", "heavy(b1)", "-heavy(b2)")
    assert scenario.facts == tuple(map(Fact, facts))
    assert scenario.goals == (
        Goal("holds", fluent="on(b1,t1)"),
        Goal("holds_not", fluent="on(b2,b1)"),
    )
    assert scenario.goals[1].as_dict() == {"holds_not": "on(b2,b1)"}
    assert scenario.events[0].observations == (Observation("obs", ("spilled(t1)",)),)


@pytest.mark.parametrize(
    ("text", "place", "said", "mend"),
    [
        ("state: {fluents: [Dirty(t1)]}", (1, 19), "no term", "for example"),
        ("state: {fluents: [d(t1), d(t1)]}", (1, 26), "listed twice", "leave one out"),
        ("goals: [{holds: }]", (1, 17), "must be a term", "isdirty(table1)"),
        ("goals: [{holds: 'on(b1'}]", (1, 17), "no term", "bracket stays open"),
        ("observe: [{obs: [a]}]", (1, 17), "must be a term", "spilled(table1)"),
        ("facts: ['p(X) :- q(X)']", (1, 9), "is no fact", "rules belong into the domain"),
        ("goals: [{hold: isdirty(t1)}]", (1, 10), "unknown key hold", "did you mean holds?"),
    ],
)
def test_every_fault_has_its_place(text: str, place: tuple[int, int], said: str, mend: str) -> None:
    with pytest.raises(LayoutError) as raised:
        read_scenario(text, "s.yaml", HALL)
    (fault,) = raised.value.faults
    assert fault.where == Where("s.yaml", *place)
    assert said in fault.message and mend in (fault.hint or "")
