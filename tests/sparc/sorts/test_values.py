"""Ground terms in compact form: written, compared, and there and back."""

from __future__ import annotations

import pytest

from sparc.answer_sets import GroundTerm
from sparc.sorts.values import (
    Value,
    as_value,
    compare,
    from_ground,
    is_identifier,
    spells_value,
    text,
    to_ground,
)


@pytest.mark.parametrize(
    ("value", "written"), [(3, "3"), (-3, "-3"), ("a", "a"), (("f", 1, ("g", "b")), "f(1,g(b))")]
)
def test_a_term_is_written_and_comes_back(value: Value, written: str) -> None:
    assert text(value) == written == str(to_ground(value))
    assert from_ground(to_ground(value)) == value


def test_an_identifier_is_a_term_without_arguments() -> None:
    assert to_ground("a") == GroundTerm("a") and to_ground(("f", 1)) == GroundTerm("f", (1,))


@pytest.mark.parametrize(
    ("left", "operator", "right", "holds"),
    [
        (1, "<", 2, True), (2, "<=", 2, True), (9, ">", 10, False), ("b", ">", "a", True),
        ("a", ">=", "b", False), ("9", "<", "a", True), (1, "<", "a", False), ("a", ">", 1, False),
        (1, "!=", "a", True), (("f", 1), "=", ("f", 1), True), (("f", 1), "<", ("f", 2), False),
    ],
)  # fmt: skip
def test_comparisons(left: Value, operator: str, right: Value, holds: bool) -> None:
    assert compare(left, operator, right) is holds


def test_words_spell_numbers_and_identifiers() -> None:
    assert as_value("12") == 12 and as_value("a1") == "a1"
    assert spells_value("0") and spells_value("10") and not spells_value("01")
    assert is_identifier("a_B1") and not any(map(is_identifier, ("A", "_a", "1a", "é", "a b", "")))
