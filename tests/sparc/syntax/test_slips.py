"""What people write who know another language, and the fault that is meant."""

from __future__ import annotations

import pytest

from sparc.source import Source
from tests.support.sparc_texts import faults

HEAD = (
    "sorts\n#p = {ann, ben}.\n#n = 1..9.\npredicates\nq(#p). r(#p). s(#n). e(#n,#n). z().\nrules\n"
)


@pytest.mark.parametrize(
    ("text", "place", "mend"),
    [
        ("r(X) <- q(X).", "7:6", 'write ":-"'),
        ("z <- q(ann).", "7:3", 'write ":-"'),
        ("z <= q(ann).", "7:3", 'write ":-"'),
        ("<- q(ann).", "7:1", 'write ":-"'),
        ("r(X) : - q(X).", "7:6", 'write ":-"'),
        (": - q(ann).", "7:1", 'write ":-"'),
        ("r(X) :– q(X).", "7:6", 'write ":-"'),
        ("r(X) := q(X).", "7:6", 'write ":-"'),
        ("r(X) ← q(X).", "7:6", 'write ":-"'),
        ("r(X) if q(X).", "7:6", 'write ":-"'),
        ("{q(X)} <- r(X).", "7:8", 'write ":-"'),
        ("r(X) | q(X) <- z.", "7:13", 'write ":-"'),
        ("q(X) => r(X).", "7:6", 'write ":-", with the conclusion first'),
        ("q(X), z -> r(X).", "7:9", 'write ":-", with the conclusion first'),
        ("z :- \\+ q(ann).", "7:6", 'write "not"'),
        ("z :- ~q(ann).", "7:6", 'negated by "not"'),
        ("z :- !q(ann).", "7:6", 'negated by "not"'),
        ("z :- ¬q(ann).", "7:6", 'write "not"'),
        ("z :- q(ann) & r(ann).", "7:13", "write a comma"),
        ("z :- q(ann) && r(ann).", "7:13", "write a comma"),
        ("z :- q(ann) /\\ r(ann).", "7:13", "write a comma"),
        ("z :- q(ann) ∧ r(ann).", "7:13", "write a comma"),
        ("z :- s(X), X mod 2 = 0.", "7:14", "X - X/Y*Y"),
        ("z :- s(X), 0 = X \\ 2.", "7:18", "X - X/Y*Y"),
        ("z :- s(X), X % 2 = 0.\nz.", "8:1", '"%" begins a comment'),
        ("z :- s(X), s(Y), X is Y+1.", "7:20", 'write "="'),
        ("z :- s(X), s(Y), X ≠ Y.", "7:20", 'write "!="'),
        ("z :- s(X), s(Y), X \\= Y.", "7:20", 'write "!="'),
        ("z :- s(X), X ≤ 3.", "7:14", 'write "<="'),
        ("z :- forall X q(X).", "7:6", "there are no quantifiers"),
        ("z :- forall q(X).", "7:6", "there are no quantifiers"),
        ("e(1..3,2).", "7:7", "a variable of a sort"),
        ("e(2,1..3).", "7:6", "a variable of a sort"),
        ("z :- count{X : q(X)} > 1.", "7:11", 'write "#count{…}"'),
        ("q(“ann”).", "7:3", "without quotes"),
        ("q(ann),\nq(ben).", "7:7", 'ends with "."'),
        ("z :- q(ann), not r(ann)\n-q(ann) :- z.", "7:24", 'ends with "."'),
        ("display\nq.\nr(X) :- q(X).\nz :- q(ann).", "9:1", "before the section display (line 7)"),
    ],
)  # fmt: skip
def test_what_people_write(text: str, place: str, mend: str) -> None:
    (fault,) = faults(Source("x", f"{HEAD}{text}\n"))
    assert fault.span and str(fault.span.location) == f"x:{place}"
    assert mend in (fault.hint or "")


@pytest.mark.parametrize(
    ("text", "place", "mend"),
    [
        ("z when q(ann).", "7:3", 'write ":-"'),
        ("z <== q(ann).", "7:3", 'write ":-"'),
        ("q(X) ⇒ r(X).", "7:6", 'write ":-", with the conclusion first'),
        ("not q(X) => r(X).", "7:10", 'write ":-", with the conclusion first'),
        ("{q(X)} => 1.", "7:9", 'write ">=" instead of "=>"'),  # the bound of a choice
        ("z :- exists X q(X).", "7:6", "there are no quantifiers"),
        ("z \\/ q(ann).", "7:3", 'write "|" in a head'),
        ("neg q(ann).", "7:1", 'write "-q", the sign touching the atom'),
        ("no\nq(ann).", "7:3", 'every statement ends with "."'),
        ("z :- q(ann),\nr(ben) :- z.", "7:12", "the next begins below"),
        ("q(ann),\n  r(ben) :- z.", "7:7", 'parted by "|"'),
        ("z :- s(X), X = 1\n-q(ann).", "7:17", 'every statement ends with "."'),
        ("z :- q(ann.", "7:11", 'close the bracket: ")"'),
        ("{q(X) : r(X).", "7:13", 'close the bracket: "}"'),
    ],
)
def test_a_slip_is_told_from_its_neighbours(text: str, place: str, mend: str) -> None:
    (fault,) = faults(Source("x", f"{HEAD}{text}\n"))
    assert fault.span and str(fault.span.location) == f"x:{place}"
    assert mend in (fault.hint or "")


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("Q(ann).", "q(ann)."),
        ("z :- -Q(X).", "z :- -q(X)."),
        ("q(Ann(x)).", "q(ann(x))."),
        ("q(ann),\nr(ben).", "q(ann).\nr(ben)."),
        ("z :- s(X), X = 1\n-q(ann).", "z :- s(X), X = 1.\n-q(ann)."),
        ("z :- #count{X : q(X) > 2.", "z :- #count{X : q(X)} > 2."),
        ("z :- #count{X : q(X), s(X) < 3.", "z :- #count{X : q(X), s(X)} < 3."),
        ("1{q(X) = 2.", "1{q(X)} = 2."),
        ("q(ann)\nr(ben).", "q(ann).\nr(ben)."),
    ],
)
def test_one_change_mends_it(text: str, mended: str) -> None:
    (fault,) = faults(Source("x", HEAD + text))
    assert fault.edit is not None
    changed = (HEAD + text)[: fault.edit.start] + fault.edit.new + (HEAD + text)[fault.edit.end :]
    assert changed == HEAD + mended
    assert not faults(Source("x", changed))


@pytest.mark.parametrize(
    "text",
    ["1 <= {q(X)}.", "{q(X)} <= 1.", "z :- s(X), X = 3\n - 2.", "all(X).", "q(ann) |\nr(ben)."],
)
def test_what_is_no_slip(text: str) -> None:
    assert not faults(Source("x", HEAD + text))


def test_a_statement_has_one_fault_and_the_next_is_read() -> None:
    text = "q(X) <- r(X), Z(.\nz.\nr(X) -> .\nneg z."
    places = [str(fault.span.location) for fault in faults(Source("x", HEAD + text)) if fault.span]
    assert places == ["x:7:6", "x:9:6", "x:10:1"]
