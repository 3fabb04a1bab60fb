"""A domain of one's own begins as one that runs: from the shipped ones, and from what was begun."""

from __future__ import annotations

import pytest

import waiter_cli
from sparc import check, find_warnings, parse
from sparc.source import Source
from waiter_cli.encoding.domains import Domain, find_domain
from waiter_cli.encoding.new_domain import begin_domain
from waiter_cli.encoding.template import read_template
from waiter_cli.errors import InputError
from waiter_cli.file_access.locate import data_folder

RESTAURANT = find_domain("restaurant").template


def begun(source: Source = RESTAURANT, name: str = "mine") -> Source:
    return Source("mine.sparc", begin_domain(source, name))


def test_it_plans_with_its_own_action() -> None:
    domain = Domain("mine.sparc", begun(), built_in=False)
    problem = waiter_cli.pose_problem(
        waiter_cli.read_layout("report"), goals=["holds: isgreeted(table1)"], enter=[2]
    )
    plan = waiter_cli.plan(problem, domain=domain).plan
    assert plan is not None
    assert [action.name for action in plan.actions][-2:] == ["seat", "greet"]


@pytest.mark.parametrize("file", ["domain.sparc", "fleet.sparc"])
def test_it_is_a_program_without_warnings(file: str) -> None:
    with open(f"{data_folder('domains')}/restaurant/{file}", encoding="utf-8") as shipped:
        source = begun(Source(file, shipped.read()))
    assert read_template(source)
    assert not find_warnings(check(parse(source)))


def test_what_is_new_is_marked_and_the_rest_is_kept() -> None:
    old = RESTAURANT.text.split("\n")
    new = begun().text.split("\n")
    kept = [line for line in old if line in new]
    assert len(old) - len(kept) == 3  # the last lines of three sorts have no full stop any more
    added = [line for line in new if line not in old]
    assert sum("mine" in line for line in added) >= 8


def test_a_name_is_an_observable_once() -> None:
    more = RESTAURANT.text.replace(
        "+ bill_wave(#table) ", "+ bill_wave(#table) + has_left(#table) "
    )
    assert begun(Source("more.sparc", more)).text.count("has_left(#table)") == 1


def test_there_is_nothing_to_begin_from() -> None:
    with pytest.raises(InputError, match="it lacks #basic_fluent, #basic_action"):
        begun(find_domain("report").template)
