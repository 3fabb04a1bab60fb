"""``waiter sparc explain``: the words, the codes, and the restaurant broken in ten ways."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.sampling import mostly_wide

CLASH = "sorts\n#s = {a, b}.\npredicates\np(#s).\nrules\n% It is so.\np(a).\n\n-p(X) :- p(X).\n"


def test_what_a_person_reads(tmp_path: Path) -> None:
    file = tmp_path / "clash.sparc"
    file.write_text(CLASH)
    ran = waiter("sparc", "explain", str(file))
    assert ran.code == 0
    said = " ".join(ran.out.split())
    for words in (
        f"{file} is inconsistent",
        f"{file}:7: p(a). It is so.",
        f"{file}:9: -p(X) :- p(X). as in: -p(a) :- p(a)",
        "p(a) and -p(a) contradict each other",
        f"without {file}:7: p(a).",
    ):
        assert words in said
    assert "Traceback" not in ran.err


def test_a_program_that_is_consistent() -> None:
    ran = waiter("sparc", "explain", "-", stdin=CLASH.replace("-p(X) :- p(X).", ""))
    assert (ran.code, ran.out) == (0, "<stdin> is consistent: it has an answer set.\n")


def test_time_that_is_up() -> None:
    ran = waiter("sparc", "explain", "-", "--time-limit", "0", "--json", stdin=CLASH)
    assert ran.code == 4
    assert ran.json() | {"limit": "time"} == {
        "status": "undecided", "complete": False, "limit": "time", "causes": [], "mends": [],
    }  # fmt: skip


@cache
def restaurant() -> str:
    """A problem of the restaurant, with steps enough."""
    return waiter("plan", "--scenario", "b1", "--show", "sparc").out


# What is done to the program: (what is taken out, what is put there), and a text at the place to blame.
BREAKS = {
    "a constraint against walking": ("display\n", ":- occurs(go_to(A, N), I).\n\ndisplay\n", ":- occurs(go_to(A, N), I)."),
    "a constraint against picking": ("display\n", ":- occurs(pick(A, C), I).\n\ndisplay\n", ":- occurs(pick(A, C), I)."),
    "a constraint against sitting": ("display\n", ":- holds(isattable(C, T), I).\n\ndisplay\n", ":- holds(isattable(C, T), I)."),
    "a count that is too small": ("display\n", ":- #count{A, I : occurs(A, I)} > 2.\n\ndisplay\n", ":- #count{A, I : occurs(A, I)} > 2."),
    "a contrary fact": ("display\n", "-holds(currentlocation(agent, n1), 0).\n\ndisplay\n", "-holds(currentlocation(agent, n1), 0)."),
    "a contrary rule": ("display\n", "-occurs(A, I) :- occurs(A, I).\n\ndisplay\n", "-occurs(A, I) :- occurs(A, I)."),
    "a fact too many": ("display\n", "-success.\n\ndisplay\n", "-success."),
    "too few steps": ("#step = 0..10.", "#step = 0..4.", "#step = 0..4."),
    "hardly any steps": ("#step = 0..10.", "#step = 0..2.", "#step = 0..2."),
    "no goal is ever reached": ("goal(I) :- not missing(I).", "", ":- not success."),
}  # fmt: skip


@pytest.mark.parametrize("name", mostly_wide(BREAKS, *list(BREAKS)[-3:]))
def test_a_broken_restaurant(name: str) -> None:
    old, new, blamed = BREAKS[name]
    whole = restaurant()
    assert whole.count(old) == 1
    broken = whole.replace(old, new)
    ran = waiter("sparc", "explain", "-", "--json", stdin=broken)
    document = ran.json()
    assert (ran.code, document["status"], document["complete"]) == (0, "inconsistent", True)
    lines = {each["line"] for cause in document["causes"] for each in cause}
    assert broken.split("\n").index(blamed) + 1 in lines
    assert document["mends"] and all(mend["without"] for mend in document["mends"])
