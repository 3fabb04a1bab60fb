"""The key ``guests`` of a scenario: when guests come, how many, and how they are."""

from __future__ import annotations

import pytest

from tests.support.reading import reading
from waiter_cli.files.guests_reader import read_guests
from waiter_cli.model.guest_model import GuestModel, Span
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Mapping


def read(text: str) -> tuple[GuestModel | None, list[str]]:
    def both(reader: NodeReader, root: Mapping) -> GuestModel | None:
        keys = {key.text: node for key, node in root.entries}
        return read_guests(reader, keys.get("guests"), keys.get("minutes"))

    return reading(text, both)


def test_guests_by_the_hour() -> None:
    found, told = read(
        "minutes: 120\nguests:\n  arrivals: {per_hour: 20}\n  sizes: {1: 1, 2: 3}\n"
        "  order_after: [2, 6]\n  eat: {mean: 20, sd: 5}\n  cook: 8\n  patience: 15\n  refills: 1\n"
    )
    assert told == [] and found is not None
    assert (found.minutes, found.per_hour, found.patience, found.refills) == (
        120.0,
        20.0,
        15.0,
        1.0,
    )
    assert found.sizes == ((1, 0.25), (2, 0.75))
    assert found.order_after == Span("uniform", 2.0, 6.0)
    assert found.eat == Span("normal", 20.0, 5.0)
    assert found.cook == Span("uniform", 8.0, 8.0)


def test_guests_at_given_times_end_with_the_last() -> None:
    found, told = read("guests: {arrivals: {at: [[7.5, 4], [0, 2]]}}\n")
    assert told == [] and found is not None
    assert found.at == ((0.0, 2), (7.5, 4)) and found.minutes == 7.5


def test_no_guests() -> None:
    assert read("x: 1\n") == (None, [])
    assert read("guests:\n") == (None, [])
    assert read("minutes: 3\n") == (None, ["1:10: minutes without guests"])


@pytest.mark.parametrize(
    ("guests", "fault"),
    [
        (
            "{arrivals: {per_hour: 20}}",
            "1:9: guests come by the hour, and nothing says for how long",
        ),
        ("{sizes: {1: 1}}", "1:9: guests without arrivals"),
        ("{arrivals: {}}", "1:20: arrivals has per_hour or at, one of the two"),
        ("{arrivals: {at: [[0, 2]]}, sizes: {1: 0}}", "1:43: sizes gives no party a share"),
        ("{arrivals: {at: [[0, 2]]}, eat: [6, 2]}", "1:41: eat ends before it begins"),
        ("{arrivals: {at: [[0, 2]]}, eat: {sd: 2}}", "1:41: eat has no mean"),
    ],
)
def test_a_fault_stands_at_its_place(guests: str, fault: str) -> None:
    found, told = read(f"guests: {guests}\n")
    assert found is None and told == [fault]


@pytest.mark.parametrize(
    "guests",
    ["{arrivals: {at: [3]}}", "{arrivals: {at: [[0, 0]]}}", "{arrivals: {per_hour: -1}}",
     "{arrivals: {at: [[0, 2]]}, eat: soon}", "{arrivals: {at: [[0, 2]]}, eat: [1]}",
     "{arrival: {per_hour: 2}}"],
)  # fmt: skip
def test_what_cannot_be_is_a_fault(guests: str) -> None:
    found, told = read(f"minutes: 9\nguests: {guests}\n")
    assert found is None and told
