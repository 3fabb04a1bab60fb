"""What `layout check` says where several robots start."""

from __future__ import annotations

import re

from tests.support.paths import ROOT
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.advice import advise

REPORT = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")


def said(agents: str, *gone: str) -> list[str]:
    """What is remarked of the report's restaurant with these robots, and without some of its paths."""
    text = re.sub(r"(?m)^agent: .*$", f"agents: {{{agents}}}", REPORT)
    for edge in gone:
        text = text.replace(f"  - [{edge}]\n", "")
    return [remark.fault.message for remark in advise(read_layout(text, "two.yaml"))]


def test_a_dead_end_is_used_where_one_robot_can_wait_for_another() -> None:
    alone = [remark.fault.message for remark in advise(read_layout(REPORT, "one.yaml"))]
    assert [each for each in alone if "n0 is a dead end" in each]
    for agents in ("r1: n4, r2: n0", "r1: n4, r2: n1"):
        assert not [each for each in said(agents) if each.startswith(("n0 ", "node n0 "))]


def test_what_the_second_robot_can_reach_can_be_reached() -> None:
    apart = ("n4, n5",)
    assert not [each for each in said("r1: n4, r2: n0", *apart) if "cannot be reached" in each]
    lost = said("r1: n4, r2: n3", *apart)
    assert "node n6 cannot be reached from n4 or n3, where the robots start" in lost
