"""What is said of small inconsistent programs: `found`, of rules behind the declarations `SORTS`."""

from __future__ import annotations

import sparc
from sparc.explaining.explain import Inconsistency

__all__ = ["SORTS", "found"]

SORTS = (
    "sorts\n#s = {a,b}.\n#n = 0..4.\npredicates\np(#s). q(#s). r(#n). total(#n). t(). u().\nrules\n"
)


def found(rules: str, **options: bool) -> Inconsistency:
    return sparc.explain(SORTS + rules, **options)
