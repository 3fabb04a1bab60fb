"""Scenarios that do not fit a domain of one's own: each command tells the same, at the same place."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import Ran, waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_slow

DOMAINS = ROOT / "tests" / "support" / "domains"
LINES = {
    "trolley": {
        "layout": "report",
        "state": "{agent: n5, fluents: [atdesk(novel)]}",
        "goals": "[{holds: 'onshelf(novel, table1)'}]",
    },
    "blocks": {
        "layout": "report",
        "state": "{fluents: ['on(a, floor)', 'on(b, a)', 'on(c, b)']}",
        "goals": "[{holds: 'on(a, b)'}]",
    },
}
NOVEL = "holds: 'onshelf(novel, table1)'"
# The domain, a line of the scenario, the place that is told, and a part of what is said.
WRONG = [
    ("trolley", "state: {fluents: ['onshelf(atlas, table9)']}", "2:19", "table9 is no table"),
    ("trolley", "state: {fluents: [onshelf(atlas)]}", "2:19", "write onshelf(BOOK, TABLE)"),
    ("trolley", "state: {fluents: [onshlf(atlas)]}", "2:19", "did you mean onshelf?"),
    ("trolley", "state: {fluents: ['currentlocation(agent, n1)']}", "2:19", "no fluent of the domain's"),
    ("trolley", "state: {waiting: [[x, y]]}", "2:18", "no word for waiting"),
    ("trolley", "state: {seated: {table1: [x]}}", "2:17", "no word for seated"),
    ("trolley", "goals: [{holds: onshelf(novel)}]", "3:17", "write onshelf(BOOK, TABLE)"),
    ("trolley", "goals: [{paid: table1}]", "3:16", "no word for the goal paid"),
    ("trolley", "observe: [{obs: retuned(atlas)}]", "4:17", "did you mean returned?"),
    ("trolley", "observe: [{obs: 'returned(atlas, table1)'}]", "4:17", "write returned(BOOK)"),
    ("trolley", "observe: [{enter: [x, y]}]", "4:19", "no word for enter"),
    ("trolley", "observe: [{bill: table1}]", "4:18", "no word for bill"),
    ("trolley", "facts: ['holds(atdesk(novl),0)']", "4:9", "novl is no book"),
    ("trolley", "facts: ['atdesk(novel)']", "4:9", "unknown predicate atdesk/1"),
    ("trolley", f"before: [[{{holds: atdesk(novel)}}, {{{NOVEL}}}]]", "4:43", "no word for before"),
    ("blocks", "state: {fluents: [covered(a)]}", "2:19", "no inertial fluent"),
    ("blocks", "goals: [{holds: 'on(floor, a)'}]", "3:17", "floor is no block"),
    ("blocks", "observe: [{obs: fell(a)}]", "4:17", "no predicate obs(…)"),
]  # fmt: skip
COMMANDS = ("plan", "explain", "answersets", "simulate", "serve")


def write(folder: Path, domain: str, *changed: str) -> tuple[str, ...]:
    """Writes a scenario of a domain with lines changed, and returns its options."""
    lines = dict(LINES[domain])
    lines.update(line.split(": ", 1) for line in changed)  # type: ignore[arg-type]
    scenario = folder / "s.yaml"
    scenario.write_text("".join(f"{key}: {value}\n" for key, value in lines.items()))
    return ("--scenario", str(scenario), "--domain", str(DOMAINS / f"{domain}.sparc"))


def run(command: str, options: tuple[str, ...]) -> Ran:
    more = {"simulate": ("--backend", "geometric"), "answersets": ("--horizon", "1")}
    return waiter(command, *options, *more.get(command, ()))


@pytest.mark.parametrize(
    ("domain", "line", "place", "said"), WRONG, ids=[row[1][:30] for row in WRONG]
)
def test_what_a_domain_has_no_words_for(
    tmp_path: Path, domain: str, line: str, place: str, said: str
) -> None:
    options = write(tmp_path, domain, line)
    for command in COMMANDS:
        ran = run(command, options)
        assert ran.code == 2, (command, ran.out, ran.err)
        assert f"s.yaml:{place}: error: " in ran.err and said in ran.err, (command, ran.err)


@pytest.mark.parametrize(
    "line",
    mostly_slow(
        ["goals: []", f"goals: [{{{NOVEL}}}, {{{NOVEL}}}]", "observe: [{obs: returned(atlas)}]"],
        f"goals: [{{{NOVEL}}}, {{{NOVEL}}}]",
    ),
)
def test_empty_goals_and_twice_the_same(tmp_path: Path, line: str) -> None:
    options = write(tmp_path, "trolley", line)
    for command in ("plan", "explain", "simulate", "serve"):
        assert run(command, options).code == 0, command


def test_twice_the_same_goal_and_guests_who_belong_together(tmp_path: Path) -> None:
    """Two goals of one party are one goal, and those after it stay what they are."""
    scenario = tmp_path / "s.yaml"
    scenario.write_text(
        "layout: report\nstate: {agent: n5, waiting: [[ada, ben]]}\n"
        "goals: [{seated: [ada]}, {seated: [ada, ben]}, {at: n3}]\n"
    )
    ran = waiter("serve", "--scenario", str(scenario), stdin='{"ask": "why"}\n')
    assert ran.code == 0, ran.err
    wanted = [each["goal"] for each in json.loads(ran.out.splitlines()[-1])["why"]["goals"]]
    assert wanted == [{"seated": ["ada", "ben"]}, {"at": "n3"}]


ENDED = ("state: {agent: n5, fluents: ['onshelf(atlas, table1)']}", "observe: [{obs: returned(atlas)}]",
         "goals: [{holds: 'onshelf(atlas, table2)'}]")  # fmt: skip


def test_a_fluent_that_what_was_seen_has_ended_is_no_contradiction(tmp_path: Path) -> None:
    """``plan`` knew that; ``explain`` and ``answersets`` said that there is no plan."""
    options = write(tmp_path, "trolley", *ENDED)
    steps = json.loads(waiter("plan", *options, "--json").out)["horizon"]
    assert f"There is a plan of {steps} steps" in waiter("explain", *options).out
    assert waiter("answersets", *options, "--json").json()["satisfiable"]


@pytest.mark.wide
def test_facts_hold_through_a_whole_run(tmp_path: Path) -> None:
    """What holds at the start, and what holds for good, in a plan, a simulation and a live run alike."""
    text = (DOMAINS / "blocks.sparc").read_text()
    text = text.replace("predicates\n", "predicates\nglued(#block).\n", 1)
    text = text.replace("\ndisplay", "\n:- occurs(put(agent, B, P), I), glued(B).\n\ndisplay")
    (tmp_path / "glue.sparc").write_text(text)
    scenario = tmp_path / "s.yaml"
    scenario.write_text(
        "layout: report\nstate: {fluents: ['on(a, floor)', 'on(b, floor)']}\n"
        "facts: ['holds(on(c, floor), 0)', glued(a)]\ngoals: [{holds_not: 'on(b, floor)'}]\n"
    )
    options = ("--scenario", str(scenario), "--domain", str(tmp_path / "glue.sparc"))
    ran = waiter("serve", *options, stdin='{"goal": {"holds": "on(a, b)"}}\n{"ask": "state"}\n')
    told = [json.loads(line) for line in ran.out.splitlines()]
    assert told[1].get("status") == "no_plan" or told[1].get("pending"), told[1]
    assert "on(c,floor)" in told[2]["state"]["fluents"]
    scenario.write_text(scenario.read_text().replace("glued(a)", "glued(b)"))
    assert waiter("simulate", *options, "--backend", "geometric").code != 0
