"""Who is left unserved at the end of a run, in words and in JSON."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.model.state import State
from waiter_cli.simulation.summary import unserved


@pytest.mark.parametrize(
    ("state", "said"),
    [
        (State("n1", seated=(("t1", ("c1",)),), served=frozenset({"t1"})), []),
        (
            State("n1", waiting=(("c2", "c3"), ("c1",))),
            ["the party of c2 (2) waits at the entrance", "c1 waits at the entrance"],
        ),
        (State("n1", with_agent=("c1",)), ["c1 follows the robot and has no table"]),
        (
            State("n1", wants_bill=frozenset({"t2", "t1"}), ready_to_order=frozenset({"t3"})),
            ["t1 wants its bill", "t2 wants its bill", "t3 is ready to order"],
        ),
        (State("n1", ordered=frozenset({"t1"})), ["the order of t1 is not sent"]),
        (
            State("n1", sent=frozenset({"t1", "t2"}), served=frozenset({"t2"})),
            ["the kitchen has not made what t1 ordered"],
        ),
        (
            State("n1", sent=frozenset({"t1"}), ready=frozenset({("t1", "plate")})),
            ["the plate for t1 is not brought"],
        ),
        (
            State("n1", sent=frozenset({"t1"}), carrying=("t1", "plate")),
            ["the robot still has the plate of t1"],
        ),
        (
            State("n1", empty=frozenset({("t1", "jug"), ("t2", "basket")}), carrying=("t1", "jug")),
            ["the robot still has the jug of t1", "the basket of t2 is empty"],
        ),
    ],
)
def test_who_calls(state: State, said: list[str]) -> None:
    assert [call.text for call in unserved(state)] == said


LEFT = """\
layout: report
state: {seated: {table1: [c1]}, wants_bill: [table1]}
observe:
  - enter: [c2, c3]
goals:
  - at: n2
"""


def test_the_summary_says_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("left.yaml").write_text(LEFT)
    play = ("simulate", "-s", "left.yaml", "--backend", "geometric")
    ran = waiter(*play)
    said = "the party of c2 (2) waits at the entrance; table1 wants its bill"
    assert ran.code == 0 and f"\n  unserved: {said}\n" in ran.out
    assert waiter(*play, "--json").json()["unserved"] == [
        {
            "kind": "waiting",
            "party": ["c2", "c3"],
            "text": "the party of c2 (2) waits at the entrance",
        },
        {"kind": "bill", "table": "table1", "text": "table1 wants its bill"},
    ]
    served = waiter("simulate", "-s", "b1", "--backend", "geometric")
    assert "unserved" not in served.out


def test_many_are_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    comes = "".join(f"  - enter: [g{n}]\n" for n in range(9))
    Path("full.yaml").write_text(f"layout: report\nobserve:\n{comes}goals:\n  - at: n2\n")
    ran = waiter("simulate", "-s", "full.yaml", "--backend", "geometric")
    line = next(line for line in ran.out.splitlines() if "unserved" in line)
    assert line.count("waits at the entrance") == 6 and line.endswith("; and 3 more")
