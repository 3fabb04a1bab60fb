"""Minimal causes and least mends of an inconsistency, by questions to a `SubsetOracle`.

A *cause* is a minimal set of switches that leave no answer set while they are on; a *mend* is a
least set of switches that must be off in some answer set.  Entry points: `shrink`,
`independent_causes`, `all_causes` and `mends`.

`all_causes` is the algorithm MARCO (Liffiton, Previti, Malik and Mutz 2016): a map of the subsets
that nothing is known of yet; each of them is shrunk to a cause, or grown to what lies beside a
mend, and cut off the map.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sparc.explaining.subsets import SubsetOracle, SwitchKey
from sparc.explaining.switches import ON
from sparc.translation.asp_program import AspProgram

__all__ = ["all_causes", "independent_causes", "mends", "shrink"]

Keys = frozenset[SwitchKey]


def shrink(oracle: SubsetOracle, conflict: Keys) -> Keys:
    """Returns a minimal cause inside ``conflict``, a set that leaves no answer set.

    Each member is left out once: it is needed where the others do have an answer set then.
    """
    needed: set[SwitchKey] = set()
    rest = sorted(conflict, key=_order)
    while rest:
        tried = rest.pop()
        smaller = oracle.conflict([*needed, *rest])
        if smaller is None:
            needed.add(tried)
        else:
            rest = [key for key in rest if key in smaller]
            # What was needed beside more is needed still: a core without it would have been found.
    return frozenset(needed)


def independent_causes(oracle: SubsetOracle) -> Iterator[Keys]:
    """Yields causes that share no statement, until what is left of the program has an answer set."""
    free: set[SwitchKey] = set()
    while True:
        conflict = oracle.conflict([key for key in oracle.switches if key not in free])
        if conflict is None:
            return
        cause = shrink(oracle, conflict)
        yield cause
        if not cause:
            return
        free |= cause


def all_causes(oracle: SubsetOracle, known: Iterable[Keys] = ()) -> Iterator[Keys]:
    """Yields every cause that is not among ``known``, one after the other."""
    everything = frozenset(oracle.switches)
    lines = [f"{{{ON}({key[0]})}}." for key in oracle.switches]
    terms = ";".join(f"1,{key[0]}: {ON}({key[0]})" for key in oracle.switches)
    map_ = SubsetOracle(
        AspProgram("\n".join([*lines, f"#maximize{{{terms}}}."]), "#show."),
        ON,
        deadline=oracle.deadline,
        options=("--opt-strategy=usc",),
    )
    for cause in known:
        map_.add(_not_all(cause))
    while (seed := map_.most_on()) is not None:
        conflict = oracle.conflict(seed)
        if conflict is None:  # a greatest set with an answer set, as seeds are greatest
            map_.add(_some(everything - seed))
            continue
        cause = shrink(oracle, conflict)
        yield cause
        map_.add(_not_all(cause))
        if not cause:
            return


def mends(oracle: SubsetOracle) -> Iterator[Keys]:
    """Yields least sets of switches without which there is an answer set, those of fewest first.

    ``oracle`` has a preference for as many as possible; it is changed.
    """
    everything = frozenset(oracle.switches)
    while (most := oracle.most_on()) is not None:
        mend = everything - most
        yield mend
        if not mend:
            return
        oracle.add(_some(mend))


def _not_all(keys: Keys) -> str:
    """Returns the constraint that these are not all on."""
    return f":-{','.join(f'{ON}({key[0]})' for key in sorted(keys, key=_order))}."


def _some(keys: Keys) -> str:
    """Returns the constraint that some of these is on."""
    return f":-{','.join(f'not {ON}({key[0]})' for key in sorted(keys, key=_order))}."


def _order(key: SwitchKey) -> tuple[tuple[int, int, str], ...]:
    return tuple((0, part, "") if isinstance(part, int) else (1, 0, str(part)) for part in key)
