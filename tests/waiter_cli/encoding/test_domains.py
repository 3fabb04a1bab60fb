"""Domains by name, file or folder, and what a program must have to plan by it."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from sparc.source import Source
from tests.support.paths import ROOT
from tests.support.rule_cases import HALL, START, posed
from waiter_cli.encoding.domains import (
    BUILT_IN,
    Domain,
    domain_for,
    domain_of_words,
    find_domain,
    require_plans,
    require_program,
)
from waiter_cli.errors import InputError
from waiter_cli.model.state import Goal

PLANS = """\
sorts
#step = 0..1.
#action = {wave}.
predicates
occurs(#action, #step).
goal(#step).
rules
occurs(wave, 0).
goal(1).
"""


def own(text: str) -> Domain:
    return Domain("mine", Source("mine.sparc", text), built_in=False)


@pytest.mark.parametrize("name", BUILT_IN)
def test_built_in_ones_are_known_by_name(name: str) -> None:
    domain = find_domain(name)
    assert domain.name == name and domain.template.name == f"domains/{name}/domain.sparc"


def test_a_folder_or_a_file_is_a_domain_of_ones_own(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(ROOT / "domains" / "report", tmp_path / "mine"))
    for given in (folder, folder / "domain.sparc"):
        domain = find_domain(str(given))
        assert not domain.built_in and domain.template.text == (folder / "domain.sparc").read_text()


def test_one_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError) as told:
        find_domain("restaurnt")
    assert "restaurant" in str(told.value)
    with pytest.raises(InputError):
        find_domain(str(tmp_path))


def test_several_robots_have_rules_of_their_own() -> None:
    restaurant, report = find_domain("restaurant"), find_domain("report")
    several = posed(START, layout=replace(HALL, agents=(("r", "a"), ("s", "b"))))
    assert domain_for(posed(START), restaurant) is restaurant
    assert domain_for(several, restaurant).template.name == "domains/restaurant/fleet.sparc"
    assert domain_for(several, report) is report


def test_words_of_ones_own_make_a_domain_ones_own() -> None:
    restaurant = find_domain("restaurant")
    assert domain_of_words(posed(START), restaurant).built_in
    assert not domain_of_words(posed(START, Goal("holds", fluent="on(a)")), restaurant).built_in


def test_a_program_says_what_a_plan_is() -> None:
    assert require_plans(own(PLANS)).name == "mine"


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (PLANS.replace("occurs", "does"), "1:1", "no plans in this program: it has no predicate occurs(#action, #step)"),
        (PLANS.replace("goal", "end"), "1:1", "no plans in this program: it has no predicate goal(#step)"),
        (PLANS.replace("goal(1).", ""), "6:1", "no plans in this program: no rule says when all goals hold"),
        (PLANS.replace("occurs(wave, 0).", ""), "5:1", "no plans in this program: no rule says what the robot may do"),
        (PLANS.replace("goal(1).", "% goal(1)."), "6:1", "no plans in this program: no rule says when all goals hold"),
    ],
)  # fmt: skip
def test_what_it_lacks_is_told_at_its_place(text: str, place: str, message: str) -> None:
    with pytest.raises(InputError) as told:
        require_plans(own(text))
    (fault,) = told.value.faults
    assert (str(fault.where), fault.message) == (f"mine.sparc:{place}", message)


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("", "1:1", "the file is empty"),
        ("% nothing\n", "1:1", "the file has comments only"),
        ("% mine\n\n p(a).\n", "3:2", 'expected the section word "sorts" or "predicates", and no section is in this file'),
    ],
)  # fmt: skip
def test_what_is_no_program_is_told(text: str, place: str, message: str) -> None:
    with pytest.raises(InputError) as told:
        require_program(Source("mine.sparc", text))
    (fault,) = told.value.faults
    assert (str(fault.where), fault.message) == (f"mine.sparc:{place}", message)
