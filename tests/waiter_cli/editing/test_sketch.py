"""What is understood of a text that is no layout, or not yet."""

from __future__ import annotations

import contextlib
import random

from tests.support.paths import ROOT
from waiter_cli.editing.sketch import sketch
from waiter_cli.errors import InputError
from waiter_cli.studio.layout_view import view_of

BITS = [*"[]{}:,-#&*!|>'\"% \n~x9é", "null", "\n  - ", "[1, 2]", "{a: b}", "nodes:\n"]


def test_any_text_is_drawn_as_far_as_it_is_understood() -> None:
    """Texts with slips in them never break the drawing; what is wrong is listed."""
    chance = random.Random(3)
    report = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    for _ in range(150):
        text = report
        for _ in range(chance.randint(1, 3)):
            at = chance.randrange(len(text))
            gone = chance.choice((0, 0, chance.randint(1, 9)))
            text = text[:at] + chance.choice(BITS) + text[at + gone :]
        view = view_of(text, "x")
        assert view["valid"] or view["findings"]
        with contextlib.suppress(InputError):
            sketch(text)


def test_half_a_layout_is_half_a_drawing() -> None:
    view = view_of("nodes: {a: [0, 0], b: [2, 0]}\nedges: [[a, b], [b, c], [a]]\n", "x")
    assert not view["valid"]
    assert view["room"]["nodes"] == {"a": (0, 0), "b": (2, 0)}
    assert view["room"]["edges"] == [["a", "b"]]
    assert view["things"]["lines"] == {"node a": 1, "node b": 1, "path a b": 2}


def test_deep_and_hostile_texts_are_told_at_once() -> None:
    for text in ("[" * 300_000, "a: &x [1]\nb: *x\n", "{a: " * 100_000, "\0", "- 1"):
        view = view_of(text, "x")
        assert not view["valid"] and view["findings"]
