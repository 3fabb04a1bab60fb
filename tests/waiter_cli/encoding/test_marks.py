"""Marks of templates: which lines are marks, and that all readers of templates agree on it."""

from __future__ import annotations

import pytest

from sparc.source import Source
from waiter_cli.domain_tests.sentences import read_blocks
from waiter_cli.encoding.marks import Mark, MarkKind, mark_of
from waiter_cli.encoding.template import fill_pieces, read_template, slot_names
from waiter_cli.errors import InputError


@pytest.mark.parametrize(
    ("line", "mark"),
    [
        ("%{ nodes", Mark(MarkKind.SLOT, "nodes")),
        ("   %{nodes  ", Mark(MarkKind.SLOT, "nodes")),
        ("%? bar", Mark(MarkKind.PART, "bar")),
        ("%{", Mark(MarkKind.SLOT)),
        ("%}", Mark(MarkKind.SLOT_END)),
        ("  %.  ", Mark(MarkKind.PART_END)),
        ("%} and more", None),
        ("%...", None),
        ("% { nodes", None),
        ("p(a). %{ nodes", None),
        ("", None),
    ],
)
def test_a_line_is_a_mark_or_not(line: str, mark: Mark | None) -> None:
    assert mark_of(line) == mark


def test_slots_are_named_in_order_inside_parts_too() -> None:
    template = Source("t", "%{ steps\n%}\n%? bar\n%{ bar\n%}\n%? order\n%{ goals\n%}\n%.\n%.\n")
    assert slot_names(template) == ("steps", "bar", "goals")


def test_a_template_may_have_slots_of_its_own() -> None:
    template = Source("t", "a.\n%{ own\nexample.\n%}\nb.")
    pieces = read_template(template, frozenset({"own"}), frozenset())
    assert fill_pieces("t", pieces, lambda name: ()).text == "a.\nb."
    with pytest.raises(InputError, match="unknown slot own"):
        read_template(template)


def test_comments_that_only_look_like_marks_are_shown() -> None:
    (block,) = read_blocks("rules\n%} is no mark\na.")
    assert block.sentence == "} is no mark"
