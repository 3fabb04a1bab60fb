"""What became of each case, and what is so where it failed: in every answer set, in none, in some."""

from __future__ import annotations

import pytest

from tests.support.domain_cases import restaurant_verdicts


def failures(case: str) -> list[str]:
    (verdict,) = restaurant_verdicts(f"  - {{name: a case, {case}}}\n")
    assert verdict.passed is not bool(verdict.failures)
    return [
        failure.message + (f" | {failure.instead}" if failure.instead else "")
        for failure in verdict.failures
    ]


HERE = "'holds(currentlocation(agent, n1), 1)'"
THERE = "'holds(currentlocation(agent, n2), 1)'"
WALK = "when: ['go_to(agent, n1)']"


@pytest.mark.parametrize(
    "case",
    [
        f"{WALK}, then: [{HERE}], never: [{THERE}]",
        f"some: [{HERE}, {THERE}]",
        f"{WALK}, exactly: 1",
        "when: ['give_bill(agent, table1)'], impossible: true",
        "never: ['holds(currentlocation(agent, N), 1)'], given: {state: {agent: n1}}, when: [nothing]"
        .replace("N)", "n3)"),
    ],
)  # fmt: skip
def test_what_is_so_passes(case: str) -> None:
    assert failures(case) == []


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (
            f"{WALK}, then: [{THERE}]",
            "holds(currentlocation(agent, n2), 1) does not hold | instead: ",
        ),
        (f"then: [{HERE}]", "holds(currentlocation(agent, n1), 1) does not hold"),
        (f"{WALK}, never: [{HERE}]", "holds(currentlocation(agent, n1), 1) holds"),
        (
            f"never: [{HERE}]",
            "holds(currentlocation(agent, n1), 1) holds, where occurs(go_to(agent, n1), 0)",
        ),
        (f"{WALK}, some: [{THERE}]", "holds(currentlocation(agent, n2), 1) holds in no answer set"),
        (f"{WALK}, exactly: 2", "there are 1, not exactly 2 answer sets"),
        ("exactly: 1", "there are more than 1, not exactly 1 answer set"),
        (f"{WALK}, impossible: true", "impossible, but there is an answer set: it can happen"),
        (
            "when: ['give_bill(agent, table1)'], exactly: 1",
            "give_bill(agent, table1) is impossible at step 0",
        ),
        (
            "when: ['give_bill(agent, table1)', nothing], impossible: true",
            "it is impossible already before its last step",
        ),
    ],
)
def test_what_is_not_so_fails_and_says_what_is(case: str, said: str) -> None:
    (failure,) = failures(case)
    assert failure.startswith(said)


def test_the_first_impossible_step_is_named_with_what_is_possible() -> None:
    (failure,) = failures("when: ['go_to(agent, n1)', 'go_to(agent, n3)'], exactly: 1")
    assert failure.startswith("go_to(agent, n3) is impossible at step 1 | possible then: ")
    assert "go_to(agent, n2)" in failure


def test_verdicts_come_in_the_order_of_the_cases() -> None:
    cases = "".join(
        f"  - {{name: n{k}, when: [{', '.join(['nothing'] * (1 + k % 2))}], exactly: 1}}\n"
        for k in range(4)
    )
    found = restaurant_verdicts(cases)
    assert [verdict.case.name for verdict in found] == ["n0", "n1", "n2", "n3"]
    assert all(verdict.passed for verdict in found)
