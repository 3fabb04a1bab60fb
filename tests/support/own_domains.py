"""Domains of one's own for tests: the shipped restaurant with a few lines more."""

from __future__ import annotations

from sparc.source import Source
from waiter_cli.encoding.domains import Domain, find_domain

MORE_FLUENTS = "              + wantsbill(#table)\n              + isdirty(#table)."
MORE_OBSERVABLES = """            + spilled(#table)
            + has_left(#table) + ready_to_order(#table) + seen_free(#table)
            + seen_at(#employee, #node) + group(#customer, #customer).
"""


def dirty_domain(*rules: str) -> Domain:
    """The restaurant with dirty tables, with more that can be observed, and with more rules."""
    text = find_domain("restaurant").template.text
    lines = text.split("\n")
    at = next(k for k, line in enumerate(lines) if "+ wantsbill(#table)." in line)
    lines[at] = MORE_FLUENTS
    at = next(k for k, line in enumerate(lines) if "+ group(#customer, #customer)." in line)
    lines[at] = MORE_OBSERVABLES
    at = next(k for k, line in enumerate(lines) if line.strip() == "display")
    lines[at:at] = [*rules, ""]
    return Domain("dirty.sparc", Source("dirty.sparc", "\n".join(lines)), built_in=False)
