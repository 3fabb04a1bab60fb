"""The cases' situations, judged by rules in Python that know no SPARC: the same can be done."""

from __future__ import annotations

from tests.support.domain_cases import domain
from waiter_cli.domain_tests.ground_cases import GroundCases
from waiter_cli.domain_tests.programs import make_programs
from waiter_cli.model.plan import Action, Plan
from waiter_cli.rules.actions import begin, legal_actions
from waiter_cli.rules.validator import run

TEMPLATE, CASES = domain("restaurant")
PLAIN = [case for case in CASES if not case.facts and case.offer is None]


def test_what_is_possible_first() -> None:
    compared = 0
    for program in make_programs(TEMPLATE, [case for case in PLAIN if not case.has_goals]):
        bench = GroundCases(program)
        for number, case in enumerate(program.cases):
            bench.select(number)
            possible = {
                str(symbol.arguments[0])
                for symbol, step in bench.actions
                if step == 0 and bench.possible([(symbol, True)])
            }
            state = begin(case.problem)
            assert possible == {a.text for a in legal_actions(case.problem, state, 0)}, case.where
            compared += len(possible)
    assert compared > 150


def test_what_happens_can_happen_or_cannot() -> None:
    compared = 0
    for case in PLAIN:
        if case.when is None:
            continue
        actions = [
            Action(step, *_parts(said.text)) for step, said in enumerate(case.when) if said.text
        ]
        # Once the goals hold it does not matter what others do.
        end = len(actions) if case.has_goals else len(case.when)
        verdict = run(case.problem, Plan(tuple(actions), end))
        legal = verdict.misstep is None and (verdict.valid or not case.has_goals)
        assert legal is not case.impossible, (case.where, verdict)
        compared += 1
    assert compared > 50


def _parts(text: str) -> tuple[str, tuple[str, ...]]:
    name, _, rest = text.partition("(")
    return name, tuple(word.strip() for word in rest.rstrip(")").split(","))
