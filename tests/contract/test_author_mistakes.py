"""What authors of a domain write wrongly, a row each: the place that is told, and the mend.

Every domain is the one that ``waiter domain new greeting`` begins, with one change.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.new_domain import begin_domain
from waiter_cli.file_access.locate import BuiltIn

LOOKS = '%@ greet(agent,T): "greet {T}" at T for 2 s as "greeting {T}"'
EFFECT = "holds(isgreeted(T), I+1) :- occurs(greet(agent, T), I)."
LAYOUT = (
    "{nodes: {n1: [0, 0], n2: [2, 0]}, edges: [[n1, n2]], entrance: n1, agent: n2, bar: [n1], "
    "tables: {table1: {capacity: 2, nodes: [n2]}}}"
)
SITUATION = "layout: layout.yaml\nstate: {agent: n2, seated: {table1: [ada]}}\n"
GREETED = "goals: [{holds: isgreeted(table1)}]\n"
CASES = f"layout: {LAYOUT}\ncases:\n  - name: one\n    given: {{state: {{agent: n2}}}}\n"
PLAN = '{"actions": [{"step": 0, "name": "%s", "args": [%s]}]}'
GREET = PLAN % ("greet", '"agent", "table1"')

# What is changed in the domain (old, new), and what has to be told: the line that the place is on
# as it is in the changed file, its column, and a part of what is said or of the mend.
IN_THE_DOMAIN = [
    ("mark_misspelt", "%{ goals", "%{ gaols", "%{ gaols", 4, "did you mean goals?"),
    ("mark_not_begun", "%{ edges\n", "", "%}", 1, 'write "%{ SLOT" above'),
    ("part_misspelt", "%? chairs\n% -", "%? chiars\n% -", "%? chiars", 4, "did you mean chairs?"),
    ("part_not_closed", "had(H, I).\n%.", "had(H, I).", "%? order\n% A", 1, 'add a line "%." after'),
    ("part_closed_twice", "% All goals hold at", "%.\n% All goals hold at", "%.\n% All", 1, "remove"),
    ("looks_of_no_action", LOOKS, LOOKS.replace("greet(", "great("), "%@ great", 4, "mean greet?"),
    ("looks_of_a_fluent", LOOKS, '%@ isgreeted(T): "w"', "%@ isg", 4, "did you mean greet?"),
    ("looks_with_too_few_arguments", LOOKS, '%@ greet(T): "w"', "%@ greet", 4,
     "it is greet(#agent, #table): a parameter for each argument"),
    ("looks_with_an_unknown_parameter", LOOKS, LOOKS.replace("{T}", "{X}", 1), "%@ greet", 4,
     "known: T, agent"),
    ("place_unknown", LOOKS, LOOKS.replace("at T", "at U"), "%@ greet", 4, "known: T, agent"),
    ("place_in_no_layout", LOOKS, LOOKS.replace("at T", "at tabel1"), "%@ greet", 35, "mean table1?"),
    ("seconds_missing", LOOKS, LOOKS.replace("for 2 s", "for s"), "%@ greet", 37, "for SECONDS s"),
    ("unit_missing", LOOKS, LOOKS.replace("for 2 s", "for 2"), "%@ greet", 37, "for SECONDS s"),
    ("seconds_as_a_word", LOOKS, LOOKS.replace("2 s", "two s"), "%@ greet", 41, "a number of seconds"),
    ("seconds_not_a_number", LOOKS, LOOKS.replace("2 s", "nan s"), "%@ greet", 41, "above 0"),
    ("seconds_below_none", LOOKS, LOOKS.replace("2 s", "-2 s"), "%@ greet", 41, "above 0"),
    ("seconds_without_end", LOOKS, LOOKS.replace("2 s", "1e9 s"), "%@ greet", 41, "up to 3600"),
    ("brace_open", LOOKS, LOOKS.replace('{T}"', '{T"', 1), "%@ greet", 27, "such as {T}"),
    ("parameter_twice", LOOKS, LOOKS.replace("(agent,T)", "(T,T)"), "%@ greet", 4, "of its own"),
    ("parts_in_another_order", LOOKS, LOOKS.replace("at T for 2 s", "for 2 s at T"), "%@ greet", 40,
     "in this order"),
    ("words_open", LOOKS, LOOKS.replace('T}"', "T}", 1), "%@ greet", 48, "in this order"),
    ("caption_without_quotes", LOOKS, LOOKS.replace('"greeting {T}"', "hi"), "%@ greet", 45, "CAPTION"),
    ("comment_behind_looks", LOOKS, f"{LOOKS} % note", "%@ greet", 63, "in this order"),
    ("parameter_in_capitals", LOOKS, LOOKS.replace("agent", "Agent").replace("T}", "agent}", 1),
     "%@ greet", 4, "did you mean Agent?"),
    ("monotone_with_more", "%@ monotone", "%@ monotone yes", "%@ mono", 4, "write %@"),
    ("monotone_in_capitals", "%@ monotone", "%@ Monotone", "%@ Mono", 4, "did you mean monotone?"),
    ("variable_in_small_letters", EFFECT, EFFECT.replace("(T)", "(t)"), "holds(isgreeted(t)", 1,
     "is not in sort #fluent"),
    ("comma_missing", EFFECT, EFFECT.replace("agent, T", "agent T"), EFFECT[:24], 48, 'expected ","'),
    ("another_arrow", EFFECT, EFFECT.replace(":-", "<-"), EFFECT[:24], 26, 'write ":-"'),
    ("bracket_open", EFFECT, EFFECT.replace("I+1)", "I+1"), EFFECT[:23], 25, 'expected ","'),
    ("predicate_undeclared", EFFECT, f"{EFFECT}\nsmile(T) :- #table(T).", "smile(T)", 1,
     "unknown predicate smile/1"),
    ("sort_misspelt", EFFECT, f"{EFFECT}\n:- #tabel(T), #step(I), I < 0, near(T, I).", ":- #tabel", 4,
     "did you mean #table"),
    ("step_left_out", EFFECT, EFFECT.replace(", I+1", ""), "holds(isgreeted(T))", 1,
     "predicate holds has 2 arguments"),
    ("predicate_misspelt", "goal(I) :- not missing(I).", "goal(I) :- not mising(I).", "goal(I) :-", 16,
     "did you mean missing"),
    ("negated_twice", EFFECT, EFFECT[:-1] + ", not not near(T, I).", EFFECT[:24], 61,
     "no double negation"),
    ("comma_of_another_alphabet", EFFECT, EFFECT.replace(",", "\uff0c", 1), "holds(isgreeted(T)", 19,
     "letters beyond a-z"),
    ("section_twice", "\nrules\n", "\nrules\nrules\n", "rules", 1, "in this order"),
    ("slot_in_a_slot", "%{ goals", "%{ goals\n%{ edges\n%}", "%{ edges", 1, 'a line "%}"'),
    ("words_without_quotes", LOOKS, "%@ greet(agent,T): greet", "%@ greet", 20, "give them in quotes"),
    ("looks_twice", LOOKS, f"{LOOKS}\n{LOOKS}\n%", "%@ greet", 4, "leave one of the two out"),
    ("declaration_misspelt", "%@ monotone", "%@ monotnoe", "%@ monot", 4, "did you mean monotone?"),
    ("action_in_no_sort", "+ greet(#agent, #table)", "", "%@ greet", 4, "has no action greet"),
    ("fluent_in_no_sort", "+ isgreeted(#table)", "", EFFECT, 1, "no sort has a record isgreeted"),
    ("argument_outside_its_sort", EFFECT, EFFECT.replace("(T)", "(table9)", 1),
     "holds(isgreeted(table9)", 1, "argument 1 of isgreeted is of #table"),
    ("fluent_misspelt", EFFECT, EFFECT.replace("isgreeted", "isgreted"), "holds(isgreted", 1,
     "did you mean isgreeted?"),
    ("action_without_its_agent", EFFECT, EFFECT.replace("agent, ", ""), EFFECT[:24], 29,
     "greet has 2 arguments"),
    ("dot_missing", EFFECT, EFFECT[:-1], EFFECT[:24], 55, 'every statement ends with "."'),
    ("sort_twice", "#boolean = {true, false}.", "#boolean = {true}.\n#boolean = {false}.",
     "#boolean = {false}.", 1, "the first definition is at line"),
    ("no_rule_for_goal", "goal(I) :- not missing(I).", "", "goal(#step).", 1,
     "write one: goal(I) :- not missing(I)."),
]  # fmt: skip

# The command that is run, the file that is wrong, its text, the place in it, what is told.
IN_ANOTHER_FILE = [
    ("goal_with_an_unknown_fluent", "plan", "s.yaml", SITUATION + "goals: [{holds: isgreted(table1)}]",
     "3:17", "did you mean isgreeted?"),
    ("goal_with_an_unknown_argument", "plan", "s.yaml",
     SITUATION + "goals: [{holds: isgreeted(tabel1)}]", "3:17", "did you mean table1?"),
    ("goal_with_too_many_arguments", "plan", "s.yaml",
     SITUATION + "goals: [{holds: 'isgreeted(table1,ada)'}]", "3:17", "write isgreeted(TABLE)"),
    ("goal_with_an_unknown_key", "plan", "s.yaml", SITUATION + "goals: [{hold: isgreeted(table1)}]",
     "3:10", "did you mean holds?"),
    ("fact_of_an_unknown_fluent", "plan", "s.yaml",
     SITUATION + "facts: ['holds(isgreted(table1), 0)']", "3:9", "did you mean isgreeted?"),
    ("fact_of_an_unknown_predicate", "plan", "s.yaml",
     SITUATION + "facts: ['hold(isgreeted(table1), 0)']", "3:9", "did you mean holds"),
    ("observation_unknown", "plan", "s.yaml", SITUATION + "observe: [{obs: spilled(table1)}]",
     "3:17", "known: bill_wave"),
    ("state_with_an_unknown_fluent", "plan", "s.yaml",
     "layout: layout.yaml\nstate: {agent: n2, fluents: [isgreted(table1)]}", "2:30", "isgreeted?"),
    ("event_unknown", "simulate", "s.yaml",
     SITUATION + "events: [{time: 1, obs: has_lift(table1)}]", "3:25", "did you mean has_left?"),
    ("case_with_an_unknown_action", "domain test", "cases/a.yaml",
     CASES + "    when: [great(agent, table1)]\n    then: [goal(1)]", "5:12", "did you mean greet?"),
    ("case_with_an_unknown_table", "domain test", "cases/a.yaml",
     CASES + "    when: [greet(agent, table7)]\n    then: [goal(1)]", "5:12", "did you mean table1?"),
    ("case_with_an_unknown_fluent", "domain test", "cases/a.yaml",
     CASES + "    then: [holds(isgreted(table1), 1)]", "5:12", "did you mean isgreeted?"),
    ("case_with_an_unknown_key", "domain test", "cases/a.yaml",
     CASES + "    whem: [greet(agent, table1)]", "5:5", "did you mean when?"),
]  # fmt: skip

# What a step is refused for: the change in the domain, the plan, the lines that are named, what is told.
IN_A_STEP = [
    ("effects_that_contradict", EFFECT, f"{EFFECT}\n-{EFFECT}", GREET, (EFFECT, f"-{EFFECT}"),
     "forbidden by"),
    ("effect_left_open", EFFECT, EFFECT.replace(" :-", " | -holds(isgreeted(T), I+1) :-"), GREET,
     ("holds(isgreeted(T), I+1) |",), "say which, under a condition"),
    ("effect_chosen", EFFECT, "{" + EFFECT.replace(" :-", "} :-"), GREET, ("{holds(isgreeted",),
     "say which, under a condition"),
    ("condition_that_fails", "near(T, I), -holds(isfree", "near(T, I), holds(isfree", GREET,
     ("possible(greet",), "needed by"),
    ("action_unknown", "", "", GREET.replace("greet", "great"), (), "did you mean greet?"),
    ("action_without_an_argument", "", "", PLAN % ("greet", '"table1"'), (),
     "write greet(AGENT, TABLE)"),
]  # fmt: skip


@pytest.fixture(scope="module")
def begun() -> str:
    return begin_domain(find_domain(BuiltIn("restaurant")).template, "greeting")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cases").mkdir()
    (tmp_path / "layout.yaml").write_text(LAYOUT)
    (tmp_path / "s.yaml").write_text(SITUATION + GREETED)
    (tmp_path / "cases" / "a.yaml").write_text(CASES + "    then: [goal(1)]")
    return tmp_path


def write(folder: Path, begun: str, old: str = "", new: str = "") -> str:
    """Writes the domain with a change, and returns its text."""
    assert old in begun
    text = begun.replace(old, new, 1) if old else begun
    (folder / "domain.sparc").write_text(text)
    return text


def line_of(text: str, start: str) -> int:
    """The number of the last line that begins so."""
    return ("\n" + text)[: ("\n" + text).rindex("\n" + start) + 1].count("\n")


def run(command: str) -> tuple[int, str]:
    options = {
        "plan": ["--scenario", "s.yaml", "--domain", "domain.sparc"],
        "simulate": ["--scenario", "s.yaml", "--domain", "domain.sparc", "--headless"],
        "validate": ["--scenario", "s.yaml", "--domain", "domain.sparc", "plan.json"],
        "domain test": ["--domain", "."],
    }
    ran = waiter(*command.split(), *options[command])
    return ran.code, ran.out + ran.err


@pytest.mark.parametrize(
    ("old", "new", "line", "column", "said"),
    [row[1:] for row in IN_THE_DOMAIN],
    ids=[row[0] for row in IN_THE_DOMAIN],
)
def test_a_mistake_in_a_domain(
    folder: Path, begun: str, old: str, new: str, line: str, column: int, said: str
) -> None:
    text = write(folder, begun, old, new)
    code, told = run("plan")
    assert code == 2 and "Traceback" not in told
    lines = {line_of(text, line)}
    if line == "%}":  # the first of several
        lines = {k for k, each in enumerate(text.split("\n"), 1) if each == line}
    assert any(f"domain.sparc:{number}:{column}: error: " in told for number in lines), told
    assert said in " ".join(told.split()), told


@pytest.mark.parametrize(
    ("command", "file", "text", "place", "said"),
    [row[1:] for row in IN_ANOTHER_FILE],
    ids=[row[0] for row in IN_ANOTHER_FILE],
)
def test_a_mistake_about_a_domain(
    folder: Path, begun: str, command: str, file: str, text: str, place: str, said: str
) -> None:
    write(folder, begun)
    (folder / file).write_text(text)
    code, told = run(command)
    assert code == 2 and f"{file}:{place}: error: " in told, told
    assert said in " ".join(told.split()), told


@pytest.mark.parametrize(
    ("old", "new", "plan", "lines", "said"),
    [row[1:] for row in IN_A_STEP],
    ids=[row[0] for row in IN_A_STEP],
)
def test_a_mistake_that_a_step_shows(
    folder: Path, begun: str, old: str, new: str, plan: str, lines: tuple[str, ...], said: str
) -> None:
    text = write(folder, begun, old, new)
    (folder / "plan.json").write_text(plan)
    code, told = run("validate")
    assert code == 3 and said in told, told
    for line in lines:
        assert f"domain.sparc:{line_of(text, line)}: " in told, told


def test_without_a_mistake_all_of_it_runs(folder: Path, begun: str) -> None:
    write(folder, begun)
    (folder / "plan.json").write_text(GREET)
    assert [run(command)[0] for command in ("plan", "simulate", "validate")] == [0, 0, 0]


def test_events_of_a_domain_need_one(folder: Path) -> None:
    (folder / "s.yaml").write_text(SITUATION + "events: [{time: 1, obs: has_left(table1)}]")
    ran = waiter("simulate", "--scenario", "s.yaml", "--headless")
    assert ran.code == 2 and "s.yaml:3:25: error: " in ran.err and "give --domain" in ran.err


@pytest.mark.parametrize(
    ("said", "place"),
    [
        ("goals: [{holds_not: isdirty(table1)}]", "2:21"),
        ("observe: [{obs: spilled(table1)}]", "2:17"),
        ("facts: ['holds(isdirty(table1), 0)']", "2:9"),
    ],
)
def test_a_run_by_the_rules_of_the_house_knows_no_other_words(
    folder: Path, said: str, place: str
) -> None:
    (folder / "s.yaml").write_text(f"layout: layout.yaml\n{said}\n")
    ran = waiter("serve", "--scenario", "s.yaml")
    assert ran.code == 2 and f"s.yaml:{place}: error: the rules of the restaurant" in ran.err
    assert "--domain" in ran.err
