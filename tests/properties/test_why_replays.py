"""Every literal in and out of the answer sets of random programs: its explanation replays."""

from __future__ import annotations

from random import Random

import pytest

import sparc
from tests.support.random_programs import random_program
from tests.support.replaying import all_literals, faults_of
from tests.support.sampling import mostly_wide


def replayed(first: int, wanted: int) -> None:
    """``wanted`` literals of the programs from seed ``first`` on."""
    seed, done = first, 0
    while done < wanted:
        text = random_program(seed)
        seed += 1
        try:
            typed = sparc.check(sparc.parse(text))
            found = list(sparc.solve(typed, models=2))
        except (sparc.SourceError, sparc.SourceErrors):
            continue
        if not found:
            continue
        literals = sorted(set(all_literals(typed, 8)) | {str(each) for each in found[0].literals})
        literals = [each for each in literals if not each.startswith("#")]
        chosen = Random(seed).sample(literals, min(len(literals), 30))
        assert faults_of(text, chosen) == [], f"seed {seed - 1}\n{text}"
        done += len(chosen)


@pytest.mark.parametrize("least", mostly_wide([120, 300], 120))
def test_explanations_replay(least: int) -> None:
    replayed(1, least)


@pytest.mark.slow
def test_ten_thousand_explanations_replay() -> None:
    replayed(1, 300)
    replayed(1000, 10_000)
