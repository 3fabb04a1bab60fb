"""Rules of a domain as causes of "no plan", held against every set of them in a world of blocks.

With the causes of one conflict alone, all other candidates taken away, no plan of any length exists;
with one of them less there is one.  The oracle solves the domain's text with lines left out, at a
horizon that no shortest plan passes: three blocks have thirteen states.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable
from pathlib import Path
from random import Random

import pytest

import waiter_cli
from sparc.source import Source
from tests.support.paths import ROOT
from tests.support.sampling import widened
from waiter_cli.encoding.domains import Domain
from waiter_cli.encoding.template import fill_template
from waiter_cli.explanation.causes_and_changes import Cause, causes_of, without
from waiter_cli.explanation.explain import Explanation
from waiter_cli.explanation.forbidding_rules import forbidding_rules, permitting_rules
from waiter_cli.model.problem import Problem

BLOCKS = (ROOT / "tests" / "support" / "domains" / "blocks.sparc").read_text()
STATES = 13
POOL = (
    ":- occurs(put(agent, c, floor), I).",
    "-occurs(put(agent, B, a), I) :- #step(I), #block(B).",
    ":- holds(on(B, c), I).",
    ":- holds(on(a, floor), I), holds(on(b, floor), I).",
    "blocked(floor, I) :- holds(on(b, floor), I).",
    "blocked(a, I) :- #step(I).",
    "-occurs(put(agent, B, floor), I) :- holds(on(B, a), I).",
    ":- occurs(put(agent, a, P), I), P != floor.",
    "blocked(b, I) :- holds(covered(a), I).",
)
STARTS = (
    ("on(a, floor)", "on(b, a)", "on(c, b)"),
    ("on(a, floor)", "on(b, floor)", "on(c, a)"),
    ("on(b, floor)", "on(a, b)", "on(c, floor)"),
)
GOALS = ("on(a, b)", "on(b, c)", "on(c, a)", "on(b, a)", "on(c, floor)")


def world(seed: int, folder: Path) -> tuple[Problem, Domain]:
    """A start and goals, and the blocks with some more rules, all by chance."""
    chance = Random(seed)
    rules = chance.sample(POOL, chance.randint(2, 5))
    text = BLOCKS.replace("\ndisplay\n", "\n" + "\n".join(rules) + "\n\ndisplay\n")
    start = ", ".join(f"'{each}'" for each in chance.choice(STARTS))
    goals = ", ".join(f"{{holds: '{each}'}}" for each in chance.sample(GOALS, 2))
    scenario = folder / f"s{seed}.yaml"
    scenario.write_text(f"layout: report\nstate: {{fluents: [{start}]}}\ngoals: [{goals}]\n")
    problem = waiter_cli.pose_problem(*waiter_cli.read_scenario(str(scenario)))
    return problem, Domain("b.sparc", Source("b.sparc", text), built_in=False)


def has_plan(problem: Problem, domain: Domain, gone: list[Cause]) -> bool:
    """Whether there is a plan without these causes, by solving once."""
    import sparc

    lines = domain.template.text.split("\n")
    for cause in gone:
        if cause.rule is None:
            continue
        text, at = cause.rule.place.text, cause.rule.place.line - 1
        if cause.kind == "permit":
            head = text.partition(" :-")[0]
            lines[at : at + 2] = [f"{head}.", ""]
        else:
            assert lines[at].strip() == text
            lines[at] = ""
    relaxed = without(problem, [cause for cause in gone if cause.rule is None])
    source = fill_template(Source("b.sparc", "\n".join(lines)), relaxed, STATES)
    return next(iter(sparc.solve(source)), None) is not None


def judge(problem: Problem, domain: Domain) -> Explanation:
    """What is told of a world without a plan, all of it rightly."""
    found = waiter_cli.explain(problem, domain=domain)
    assert found.result.status.value == "no_plan"
    assert found.conflicts
    rules = [("rule", each) for each in forbidding_rules(problem, domain)]
    if any(cause.kind == "permit" for cause in found.causes):
        rules += [("permit", each) for each in permitting_rules(problem, domain)]
    candidates = [Cause(kind, "", rule.where, lambda p: p, rule) for kind, rule in rules]
    candidates += causes_of(problem)
    for causes in found.conflicts:
        told = {(cause.kind, cause.where) for cause in causes}
        others = [each for each in candidates if (each.kind, each.where) not in told]
        assert not has_plan(problem, domain, others), "the causes do not suffice"
        for cause in candidates:
            if (cause.kind, cause.where) in told:
                assert has_plan(problem, domain, [*others, cause]), "a cause can be spared"
                if len(found.conflicts) == 1:
                    assert has_plan(problem, domain, [cause]), "a cause is not necessary"
    return found


def judge_all(seeds: Iterable[int], folder: Path) -> list[Explanation]:
    told = []
    for seed in seeds:
        gc.collect()  # groundings that nobody needs are large, and do not count as many objects
        problem, domain = world(seed, folder)
        if not has_plan(problem, domain, []):
            try:
                told.append(judge(problem, domain))
            except AssertionError as wrong:
                raise AssertionError(f"world({seed}): {wrong}") from wrong
    return told


@pytest.mark.parametrize("seeds", widened((3, 6), (3, 6, 10)))
def test_rules_that_are_blamed_are_necessary_and_suffice(
    seeds: tuple[int, ...], tmp_path: Path
) -> None:
    told = judge_all(seeds, tmp_path)
    kinds = {cause.kind for found in told for cause in found.causes}
    assert len(told) == len(seeds) and kinds == {"rule", "permit", "goal"}


@pytest.mark.slow
@pytest.mark.parametrize("first", range(100, 500, 50))
def test_rules_that_are_blamed_in_hundreds_of_worlds(first: int, tmp_path: Path) -> None:
    assert len(judge_all(range(first, first + 50), tmp_path)) > 20
