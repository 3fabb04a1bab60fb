"""One grounded program in which case after case is looked at."""

from __future__ import annotations

import pytest

from sparc.solving.query import parse_query
from tests.support.domain_cases import LAYOUT, domain
from waiter_cli.domain_tests.case_reader import read_cases
from waiter_cli.domain_tests.ground_cases import GroundCases
from waiter_cli.domain_tests.programs import make_programs

CASES = """\
  - {name: here, when: ['go_to(agent, n1)'], exactly: 1}
  - {name: there, given: {state: {agent: n3}}, when: [nothing], exactly: 1}
  - {name: facts, given: {facts: ['occurs(go_to(agent, n3), 0)']}, when: [nothing], exactly: 1}
"""


@pytest.fixture(scope="module")
def bench() -> GroundCases:
    (program,) = make_programs(domain("restaurant")[0], read_cases(LAYOUT + CASES, "mine.yaml"))
    return GroundCases(program)


def at(bench: GroundCases, node: str, step: int = 0) -> bool:
    """Whether the robot can be at a node in the case that is selected."""
    symbol = bench.symbol(parse_query(f"holds(currentlocation(agent, {node}), {step})"))
    assert symbol is not None
    return bench.possible([(symbol, True)])


def test_one_case_holds_at_a_time(bench: GroundCases) -> None:
    bench.select(0)
    assert at(bench, "n2") and not at(bench, "n3")
    bench.select(1)
    assert at(bench, "n3") and not at(bench, "n2")
    bench.select(0)
    assert at(bench, "n2")


def test_facts_can_be_left_out(bench: GroundCases) -> None:
    walks = bench.symbol(parse_query("occurs(go_to(agent, n3), 0)"))
    assert walks is not None
    bench.select(2)
    assert not bench.possible([(walks, False)])
    bench.select(2, facts=False)
    assert bench.possible([(walks, False)])


def test_what_happens_happens_alone(bench: GroundCases) -> None:
    bench.select(0)
    claims = bench.program.claims[0]
    assumed = bench.happening(claims.when)
    assert [str(symbol) for symbol, true in assumed if true] == ["occurs(go_to(agent,n1),0)"]
    assert len(assumed) == len(bench.actions) > 3
    model = bench.model(assumed)
    assert model is not None and sum(symbol.name == "occurs" for symbol in model) == 1
    assert bench.happening(claims.when, only=0) == []


def test_as_many_answer_sets_as_are_asked_for(bench: GroundCases) -> None:
    bench.select(0)
    assert len(bench.models([], 2)) == 2 and len(bench.models([], 0)) >= 3
    everything = [(symbol, True) for symbol, _ in bench.actions]
    assert bench.model(everything) is None


def test_a_literal_with_variables_stands_for_all_that_it_fits(bench: GroundCases) -> None:
    def matching(text: str) -> set[str]:
        return {str(symbol) for symbol in bench.matching(parse_query(text))}

    assert matching("holds(currentlocation(agent, n1), 1)") == {
        "holds(currentlocation(agent,n1),1)"
    }
    found = matching("holds(currentlocation(agent, N), 1)")
    assert found == {f"holds(currentlocation(agent,n{k}),1)" for k in (1, 2, 3)}
    assert matching("holds(currentlocation(N, N), 1)") == set(), "one variable is one value"
    assert all(text.startswith("-") for text in matching("-holds(currentlocation(agent, N), I)"))


def test_a_ground_literal_has_its_symbol(bench: GroundCases) -> None:
    assert str(bench.symbol(parse_query("-holds(currentlocation(agent, n1), 1)"))) == (
        "-holds(currentlocation(agent,n1),1)"
    )
    assert bench.symbol(parse_query("holds(currentlocation(agent, N), 1)")) is None
