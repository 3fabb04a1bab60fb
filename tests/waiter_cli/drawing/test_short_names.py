"""Names cut to their room: numbers stay, no two are the same, and what they mean is told."""

from __future__ import annotations

import pytest

from waiter_cli.drawing.short_names import cut, shorten, told


@pytest.mark.parametrize(
    ("name", "room", "short"),
    [
        ("table1", 6, "table1"), ("table1", 3, "t1"), ("table12", 2, "12"), ("terrace", 4, "terr"),
        ("n123456", 3, "n12"), ("w", 1, "w"),
    ],
)  # fmt: skip
def test_a_name_is_cut_and_its_number_stays(name: str, room: int, short: str) -> None:
    assert cut(name, room) == short and len(short) <= room


def test_a_name_is_unlike_those_that_are_taken_while_that_is_possible() -> None:
    taken: list[str] = []
    for _ in range(9):
        taken.append(shorten("terrace", 4, taken))
    assert taken[:3] == ["terr", "ter2", "ter3"] and len(set(taken)) == 9
    assert shorten("terrace", 1, ["t"]) == "t", "there is no room for another"


def test_few_are_told_one_by_one_and_many_of_a_kind_by_two() -> None:
    assert told({}) == ""
    assert told({"t1": "table1"}) == "short names: t1 is table1"
    many = {f"t{k}": f"table{k}" for k in range(1, 5)}
    assert told(many) == "short names: t1 is table1, t2 is table2 and so on"
    assert told({**many, "ba": "bar"}).endswith("and so on, ba is bar")


def test_another_number_is_no_kind() -> None:
    short = {"t2": "table1", "t3": "table2", "t4": "table3", "t5": "table4"}
    assert "and so on" not in told(short)
