"""Advice as people are told it: several in one, many in a number, a mend said once."""

from __future__ import annotations

import pytest

from waiter_cli.errors import Fault, Where
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.advice import Advice
from waiter_cli.layout_tools.advice_text import MANY, told, told_warnings

SEVERAL = "nodes {} cannot be reached"


def remark(kind: str, about: str, line: int, *, several: str = "", hint: str = "mend it") -> Advice:
    fault = Fault(Where("f.yaml", line, 3), f"{about} is wrong", hint)
    return Advice(kind, fault, about, several)


def messages(found: list[Advice], *, everything: bool = False) -> list[str]:
    return [fault.message for fault in told(found, everything=everything)]


def test_nothing_found_is_nothing_told() -> None:
    assert told([]) == []


def test_what_is_alone_is_told_as_it_is() -> None:
    assert messages([remark("bottleneck", "a", 1)]) == ["a is wrong"]


def test_what_has_one_plural_is_told_once_in_the_place_of_the_first() -> None:
    found = [remark("unreachable", name, k, several=SEVERAL) for k, name in enumerate("abc", 1)]
    (fault,) = told(found)
    assert fault.message == "nodes a, b (2:3) and c (3:3) cannot be reached"
    assert fault.where == Where("f.yaml", 1, 3)


@pytest.mark.parametrize("everything", [False, True])
def test_many_of_one_plural_are_three_and_a_number(everything: bool) -> None:
    found = [remark("unreachable", f"n{k}", k, several=SEVERAL) for k in range(1, MANY + 3)]
    (said,) = messages(found, everything=everything)
    assert (said == f"nodes n1, n2, n3 and {MANY - 1} more cannot be reached") is not everything


@pytest.mark.parametrize(("count", "lines"), [(MANY, MANY), (MANY + 1, 1)])
def test_many_of_one_kind_are_summed_up(count: int, lines: int) -> None:
    found = [remark("bottleneck", f"n{k}", k) for k in range(1, count + 1)]
    said = messages(found)
    assert len(said) == lines and len(messages(found, everything=True)) == count
    if lines == 1:
        assert said[0].startswith(f"{count} nodes are bottlenecks") and "n1, n2, n3" in said[0]


def test_a_dead_end_is_not_called_unused_as_well() -> None:
    dead, unused = remark("dead_end", "a", 1), remark("unused_node", "a", 1)
    assert len(told([dead, unused])) == 1
    assert len(told([dead, remark("unused_node", "b", 2)])) == 2


def test_a_mend_stands_after_the_last_remark_that_it_is_for() -> None:
    found = [
        remark("bottleneck", "a", 1, hint="one"), remark("bottleneck", "b", 2, hint="one"),
        remark("timetable", "c", 3, hint="two"),
    ]  # fmt: skip
    assert [fault.hint for fault in told(found)] == [None, "one", "two"]


def test_before_planning_only_what_cannot_be_reached_is_told() -> None:
    text = "nodes: [a, b, c]\nedges: [[a, b]]\nentrance: a\nagent: a\ntables: {t: {capacity: 2, nodes: [b]}}\n"
    (fault,) = told_warnings(read_layout(text, "f.yaml"))
    assert "c" in fault.message and "reached" in fault.message
