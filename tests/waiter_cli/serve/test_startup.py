"""How a live run begins in the situation of a scenario, by a domain of one's own."""

from __future__ import annotations

import pytest

import waiter_cli
from waiter_cli.errors import InputError
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.serve.startup import begin


def begun_with(fact: str) -> Executive:
    """The run in a scenario with one fact, by the rules of housekeeping."""
    layout = read_layout_file("report")
    text = f"name: dirty\nlayout: report\nfacts: ['{fact}']\ngoals: [{{at: n2}}]\n"
    domain = waiter_cli.find_domain("housekeeping")
    thinker = OnlinePlanner(waiter_cli.find_translator("native", None), domain)
    return begin(layout, read_scenario(text, "dirty.yaml", layout), thinker, None)


def test_what_a_fact_says_of_the_beginning_is_believed() -> None:
    assert begun_with("holds(isdirty(table1),0)").state.fluents == ("isdirty(table1)",)


def test_a_fact_that_is_for_good_is_kept() -> None:
    (fact,) = begun_with("areassociated(n3,table1)").belief.facts
    assert fact.text == "areassociated(n3,table1)"


def test_a_fact_about_what_is_done_is_refused_at_its_place() -> None:
    with pytest.raises(InputError, match="is about a step") as told:
        begun_with("-occurs(clean(agent,table1),0)")
    assert str(told.value.faults[0].where) == "dirty.yaml:3:9"
