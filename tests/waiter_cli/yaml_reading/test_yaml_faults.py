"""What no YAML file may hold, whatever else stands in it."""

from __future__ import annotations

import pytest

from waiter_cli.yaml_reading.yaml_faults import forbidden


def test_of_ascii_only_what_is_printed_and_white_space_may_stand_there() -> None:
    for code in range(128):
        allowed = chr(code) in "\t\n\r" or 0x20 <= code <= 0x7E
        assert (forbidden(chr(code)) is None) == allowed, hex(code)


@pytest.mark.parametrize("character", ["\x80", "\x9f", "\ud800", "\ufffe", "\uffff"])
def test_beyond_ascii_some_are_forbidden(character: str) -> None:
    trouble = forbidden(f"name: {character}")
    assert trouble is not None and trouble.at == 6


@pytest.mark.parametrize("character", ["\x85", "\xa0", "é", "\ue000", "\ufffd", "\U0001f37d"])
def test_and_others_are_not(character: str) -> None:
    assert forbidden(f"name: {character}") is None
