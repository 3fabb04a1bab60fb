"""The event log: numbers, lines and what does not belong in it."""

from __future__ import annotations

import json

from tests.support.playing import play, scene


def test_numbers_are_given_to_a_thousandth() -> None:
    def numbers(value: object) -> list[float]:
        if isinstance(value, float):
            return [value]
        items = (
            value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        )
        return [number for item in items for number in numbers(item)]

    found = [number for event in play(scene("b1")).events for number in numbers(event)]
    assert found and all(round(number, 3) == number for number in found)


def test_the_log_is_json_that_reads_back() -> None:
    for line in play(scene("b4")).lines:
        assert json.loads(line)["schema"] == "waiter.sim/1"
        assert line.endswith("}\n") and "\n" not in line[:-1]
