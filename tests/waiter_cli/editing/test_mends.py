"""Mends of remarks about a layout: each is tried, and helps."""

from __future__ import annotations

import pytest

from tests.support.paths import ROOT
from waiter_cli.editing.edits import edited_text
from waiter_cli.editing.mends import find_mends
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.advice import advise

LINE = """
nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [6, 0]}
edges: [[a, b], [b, c], [c, d]]
entrance: a
agent: a
tables:
"""


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (LINE + "  t: {capacity: 2, nodes: [c], at: [4, 1.5]}\n", "dead_end"),
        (LINE + "  t: {capacity: 2, nodes: [d], at: [5, 0.2]}\n", "edge_through_furniture"),
        (LINE + "  t: {capacity: 9, nodes: [d], at: [6, 1.5]}\n", "seats_do_not_fit"),
        (
            LINE.replace(", [c, d]", "") + "  t: {capacity: 2, nodes: [d], at: [6, 1.5]}\n",
            "unreachable",
        ),
        (
            LINE.replace("d: [6, 0]", "d: [6, 0], e: [4, -1]").replace("[c, d]", "[c, d], [c, e]")
            + "  t: {capacity: 2, nodes: [d], at: [6, 2]}\nwaiters: {w: c}\n",
            "blocked",
        ),
        (
            LINE.replace("[c, d]", "{from: c, to: d}")
            + "  t: {capacity: 2, nodes: [d], at: [6, 1.5]}\n",
            "no_way_back",
        ),
    ],
)
def test_a_remark_is_mended(text: str, kind: str) -> None:
    before = advise(read_layout(text, "x"))
    mends = find_mends(text, "x", seconds=20)
    mend = next(m for each, m in zip(before, mends, strict=True) if each.kind == kind)
    assert mend is not None
    after, _ = edited_text(text, mend.edits)
    about = next(each.about for each in before if each.kind == kind)
    assert (kind, about) not in {
        (each.kind, each.about) for each in advise(read_layout(after, "x"))
    }


def test_no_mend_is_offered_that_would_spoil_more() -> None:
    """In a walled-off restaurant a path joins what is cut off; the tables stay."""
    text = (ROOT / "layouts" / "walled_off.yaml").read_text(encoding="utf-8")
    for mend in find_mends(text, "x", seconds=20):
        if mend is not None:
            after, _ = edited_text(text, mend.edits)
            assert len(read_layout(after, "x").tables) == 2
