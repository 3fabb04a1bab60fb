"""The commands that were promised, and where under ``tests/`` each promise is checked.

- commands and their options: here
- names, paths, ``-``, goals: `contract/test_names`; files: `files/test_layout_reader`,
  `files/test_scenario_reader`
- variables of the environment: `contract/test_names`; the jar: `translators/test_jar_store`
- ``--json``: `contract/test_json`; key by key in `support/documents`
- exit codes: `contract/test_exits`; limits: `contract/test_limits`
- signals, streams, colour: `processes/test_endings`, `processes/test_hardening`,
  `console/test_streams`
- situations: `problems/test_pose`, `files/test_scenario_reader`, `rules/test_validator`
- ``plan``: `commands/test_plan`, `planning/test_strategies`, `encoding/test_tie_breaks`
- ``answersets``: `commands/test_answersets`, `answersets/test_timeline`
- ``simulate``: `commands/test_simulate`, `simulation/test_run`
- ``serve``: `serve/test_session`, `serve/test_journal`, `execution/test_executive`,
  `diagnosis/test_diagnose`
- ``explain``, ``validate``: `explanation/test_explain`, `commands/test_validate`
- ``domain``: `commands/test_domain`
- ``layout``: `layout/test_check`, `layout/test_draw`, `layout/test_new`, `layout_tools/test_layout_schema`,
  `layout_tools/test_convert`, `layout_tools/test_improve`
- ``compare``: `commands/test_compare`
- ``sparc``: `sparc/test_check`, `sparc/test_translate`, `sparc/test_query`, `sparc/test_fetch_jar`,
  `sparc/test_explain`, `sparc/test_why`, `translators/test_jar_store`
- ``studio``: `commands/test_studio`
- ``study``: `study/test_study_file`, `study/test_run_study`, `study/test_run`, `study/test_show`,
  `study/test_report`, `study/test_comparisons`
- ``list``: `commands/test_listing`
- ``doctor``, ``tour``: `commands/test_doctor`, `commands/test_tour`
- help, completion, manual: `commands/test_help`, `command_line/test_completion`
"""

from __future__ import annotations

import re
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.helps import command_tree
from tests.support.paths import ROOT

TREE = command_tree()
SITUATION = "--layout --scenario --enter --bill --goal"
SEARCH = "--translator --sparc-jar --search --max-steps --time-limit --domain --verbose -v"

# Every command, the arguments it takes, and the options that were promised of it.
PROMISED: dict[str, tuple[str, str]] = {
    "plan": ("", f"{SITUATION} {SEARCH} --json"),
    "answersets": (
        "PROGRAM?",
        f"{SITUATION} {SEARCH} --json --grep -n --steps --only --horizon --why",
    ),
    "simulate": ("", f"--layout --scenario --plan --headless --record {SEARCH} --json"),
    "serve": ("", f"--layout --scenario --journal --listen {SEARCH} --json"),
    "studio": ("", "--layout --scenario --journal --seed --port --no-open --speed --json"),
    "explain": ("", f"{SITUATION} {SEARCH} --why-not --json"),
    "validate": ("PLAN.json", "--layout --scenario --json"),
    "domain new": ("NAME", "--from --output --json"),
    "domain test": ("", "--domain --json"),
    "domain show": ("", "--domain --json"),
    "layout check": ("LAYOUT", "--json"),
    "layout draw": ("LAYOUT?", "--svg --png --json"),
    "layout new": ("", "--json"),
    "layout schema": ("", "--json"),
    "layout convert": ("PROGRAM", "--json"),
    "layout improve": ("LAYOUT", "--json"),
    "compare": ("A B?", "--scenarios --agents --json"),
    "study run": (
        "STUDY.yaml",
        "--output -o --workers --scheduler --csv --parquet --retry --time-limit --memory-limit --json",
    ),
    "study report": ("FILE", "--output -o --json"),
    "study show": ("FILE", "--layout-of --scenario-of --json"),
    "sparc check": ("PROGRAM", "--translator --sparc-jar --time-limit --json"),
    "sparc translate": ("PROGRAM", "--translator --sparc-jar --time-limit --json"),
    "sparc query": ("PROGRAM", "--translator --sparc-jar --time-limit --json"),
    "sparc why": ("PROGRAM LITERAL", "--set --time-limit --memory-limit --json"),
    "sparc explain": ("PROGRAM", "--all --time-limit --memory-limit --json"),
    "sparc format": ("FILE...", "--in-place --json"),
    "sparc lsp": ("", ""),
    "sparc fetch-jar": ("", "--json"),
    "list": ("", "--json"),
    "doctor": ("", "--json"),
    "tour": ("", ""),
}


def test_the_tests_of_the_table_are_there() -> None:
    names = re.findall(r"`(\w+/test_\w+)`", __doc__)
    there = {f"{path.parent.name}/{path.stem}" for path in (ROOT / "tests").rglob("test_*.py")}
    assert len(names) > 20 and set(names) <= there


def test_these_are_the_commands() -> None:
    leaves = {words for words, each in TREE.items() if words and not hasattr(each, "commands")}
    assert leaves == set(PROMISED)
    assert {words.split()[0] for words in leaves} == set(TREE[""].commands)


@pytest.mark.parametrize("words", PROMISED)
def test_a_command_takes_what_was_promised(words: str) -> None:
    arguments, options = PROMISED[words]
    parameters = TREE[words].params
    taken = {name for each in parameters for name in (*each.opts, *each.secondary_opts)}
    assert set(options.split()) <= taken
    names = [
        (each.metavar or "").strip("[]") + ("" if each.required else "?")
        for each in parameters
        if each.param_type_name == "argument"
    ]
    assert names == arguments.split()


def test_the_strategies() -> None:
    (search,) = (each for each in TREE["plan"].params if "--search" in each.opts)
    assert {"binary", "linear"} <= set(search.type.choices)
    (translator,) = (each for each in TREE["plan"].params if "--translator" in each.opts)
    assert set(translator.type.choices) == {"native", "jar"}


# -- situations, end to end --------------------------------------------------------------------

SITUATIONS: dict[str, tuple[str, list[str], dict[str, Any]]] = {
    "a bill wanted at a free table is given once a party sits there": (
        "{layout: report, observe: [{bill: table2}, {enter: [c1, c2]}], state: {agent: n5}}",
        ["pick(agent,c1)", "go_to(agent,n6)", "seat(agent,c1,table2)", "give_bill(agent,table2)"],
        {"paid": ["table2"], "seated": {"table2": ["c1", "c2"]}},
    ),
    "a new bill makes a table unpaid again": (
        "{layout: report, state: {agent: n6, seated: {table1: [c1]}, paid: [table1]}, "
        "observe: [{bill: table1}], goals: [{paid: table1}]}",
        ["give_bill(agent,table1)"],
        {"paid": ["table1"]},
    ),
    "a customer stands for the table of the party": (
        "{layout: report, state: {agent: n6, seated: {table1: [a, b]}, wants_bill: [table1]}, "
        "goals: [{paid: b}]}",
        ["give_bill(agent,table1)"],
        {"paid": ["table1"]},
    ),
    "any member stands for a party, the first-listed in what is said": (
        "{layout: report, state: {agent: n5, waiting: [[zoe, abe]]}, goals: [{seated: abe}]}",
        ["pick(agent,zoe)", "go_to(agent,n6)", "seat(agent,zoe,table1)"],
        {"seated": {"table1": ["zoe", "abe"]}},
    ),
    "who leaves takes the party along, and its table is as new": (
        "{layout: report, state: {agent: n6, seated: {table1: [a, b]}, paid: [table1]}, "
        "observe: [{leave: [b]}], goals: [{at: n6}]}",
        [],
        {"agent": "n6", "waiters": {"w1": "n7"}},
    ),
    "what comes before comes strictly before": (
        "{layout: report, state: {agent: n6, with_agent: [a]}, goals: [{seated: a}], "
        "before: [[{at: n5}, {seated: a}]]}",
        ["go_to(agent,n5)", "go_to(agent,n6)", "seat(agent,a,table1)"],
        {"seated": {"table1": ["a"]}},
    ),
    "what is observed wins over what was believed": (
        "{layout: report, state: {agent: n1}, observe: [{at: {agent: n3}}], goals: [{at: n4}]}",
        ["go_to(agent,n4)"],
        {"agent": "n4"},
    ),
    "left-out goals serve everybody": (
        "{layout: report, state: {agent: n6, seated: {table1: [a]}, with_agent: [b]}, "
        "observe: [{bill: table1}]}",
        ["give_bill(agent,table1)", "seat(agent,b,table2)"],
        {"paid": ["table1"], "seated": {"table1": ["a"], "table2": ["b"]}},
    ),
    "no goals at all are reached": ("{layout: report, goals: []}", [], {"agent": "n1"}),
}


@pytest.mark.parametrize("title", SITUATIONS)
def test_the_plan_in_a_situation(title: str) -> None:
    text, actions, after = SITUATIONS[title]
    ran = waiter("plan", "--scenario", "-", "--json", stdin=text)
    document = ran.json()
    assert ran.code == 0
    assert sorted(each["text"] for each in document["actions"]) == sorted(actions)
    assert (document["horizon"], document["minimal"]) == (len(actions), True)
    assert after.items() <= document["final_state"].items()
    assert waiter("validate", "-", stdin=ran.out).code == 0


def test_steps_of_waiting_have_no_entry() -> None:
    """They count, though: the way is free once the timetable has the other waiter leave."""
    layout = (
        "nodes: [a, b, c, home]\nedges: [[a, b], [b, c], [b, home]]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 2, nodes: [c]}}\nwaiters: {w: b}\ntimetable: {w: {4: home}}\n"
    )
    document = waiter("plan", "--layout", "-", "--goal", "at: c", "--json", stdin=layout).json()
    steps = [(each["step"], each["text"]) for each in document["actions"]]
    assert steps == [(4, "go_to(agent,b)"), (5, "go_to(agent,c)")]
    assert (document["horizon"], document["minimal"], document["bounds"][1]) == (6, True, 6)
    assert document["final_state"]["waiters"] == {"w": "home"}


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("goals: [{paid: table1}]", 3, "table1 has not paid and does not want its bill"),
        ("observe: [{bill: table1}]", 3, "nobody can sit at table1"),
        ("state: {waiting: [[a], [b]]}\ngoals: [{seated: [a, b]}]", 2, "belong to two parties"),
        ("state: {agent: n7}", 2, "both stand on n7"),
        ("state: {waiting: [[a]]}\nobserve: [{enter: [a]}]", 3, "is inside already"),
        ("observe: [{at: {w1: n1}}]", 3, "cannot both stand on n1"),
        ("observe: [{order: table1}]", 2, "needs a bar"),
    ],
)
def test_what_cannot_be_planned(text: str, code: int, said: str) -> None:
    ran = waiter("plan", "--layout", "report", "--scenario", "-", "--json", stdin=text)
    document = ran.json()
    faults = document["reasons"] if code == 3 else document["errors"]
    assert ran.code == code
    assert said in faults[0]["message"]
    assert (faults[0]["file"], faults[0]["line"]) == ("<stdin>", text.count("\n") + 1)


def test_a_final_state_is_a_scenarios_state() -> None:
    """The next scenario starts from it, whatever holds."""
    made = waiter("plan", "--scenario", "lunch", "--json").json()
    text = {"layout": "bistro", "state": made["final_state"], "goals": []}
    again = waiter("plan", "--scenario", "-", "--json", stdin=str(text).replace("'", '"')).json()
    assert again["initial_state"] == again["final_state"] == made["final_state"]
