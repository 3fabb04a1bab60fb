"""Each rule of the simulated world, changed by itself, is noticed by a check.

A fifth of the changes is in the default run.  With ``-s`` the tests print the table of changes and of the checks that notice them.
"""

from __future__ import annotations

import pytest

from tests.support.world_mutants import Mutant, Probe, changed, probes, world_mutants

PROBES = probes()
MUTANTS = world_mutants()

SAME = {
    "_no_seat: never `size > place.capacity`": "no table has more chairs than its capacity",
}
"""Changes that change nothing but a sentence, and why."""
CRASHES = {"suffer: not `inside`", "_leave: not `table is None`"}
"""Changes that make the rule itself impossible to carry out."""


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)
def test_the_world_as_it_is_does_what_the_probe_says(probe: Probe) -> None:
    assert not probe.noticed()


@pytest.mark.parametrize(
    "mutant",
    [
        pytest.param(mutant, id=str(mutant), marks=[pytest.mark.slow] * (number % 16 > 0))
        for number, mutant in enumerate(MUTANTS)
    ],
)
def test_a_changed_rule_is_noticed(mutant: Mutant) -> None:
    first = sorted(PROBES, key=lambda probe: (not probe.is_about(mutant), bool(probe.fails)))
    noticed: tuple[str, ...] = ()
    with changed(mutant):
        for probe in first:
            try:
                noticed = probe.noticed()
            except (IndexError, KeyError):
                assert str(mutant) in CRASHES
                noticed = ("crash",)
            if any(not word.startswith("not ") for word in noticed):
                break
    print(f"{mutant.rule} | {mutant.change} | {probe.name} | {', '.join(noticed) or 'nothing'}")
    assert bool(noticed) == (str(mutant) not in SAME)


def test_the_world_is_as_before() -> None:
    assert len(MUTANTS) >= 100
    assert not PROBES[0].noticed()
