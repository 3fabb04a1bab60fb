"""Names and where they come from: files and built-ins, from any folder; ``-``; goals; the environment."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.sampling import mostly_slow
from waiter_cli import __version__
from waiter_cli.file_access.locate import built_in, data_folder

# A restaurant that no built-in looks like: its one table has room for nine.
OWN = """\
name: own
nodes: {a: [0, 0], b: [2, 0]}
edges: [[a, b]]
entrance: a
tables: {big: {capacity: 9, nodes: [b], at: [3.5, 0]}}
agent: a
"""
PROGRAM = "sorts\n#s = {a, b}.\npredicates\np(#s).\nrules\np(a) | p(b).\n"


@cache
def b1_plan() -> str:
    """The document of a plan of a built-in scenario."""
    return waiter("plan", "--scenario", "b1", "--json").out


@cache
def b1_program() -> str:
    """Its program."""
    return waiter("plan", "--scenario", "b1", "--show", "sparc").out


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to stand in."""
    monkeypatch.chdir(tmp_path)
    for variable in ("WAITER_SPARC_JAR", "WAITER_TRANSLATOR"):
        monkeypatch.delenv(variable, raising=False)
    return tmp_path


# -- files and built-ins -------------------------------------------------------------------------


@pytest.mark.parametrize("name", built_in("layout"))
def test_every_layout_is_known_by_its_name_everywhere(name: str) -> None:
    for line in (
        ("plan", "--layout", name, "--json"),
        ("layout", "check", name, "--json"),
        ("layout", "draw", name, "--json"),
    ):
        ran = waiter(*line)
        assert (ran.code, ran.json()["layout"]) == (0, name)


@pytest.mark.parametrize("name", built_in("scenario"))
def test_every_scenario_is_known_by_its_name_everywhere(name: str) -> None:
    assert waiter("plan", "--scenario", name, "--show", "sparc").code == 0


@pytest.mark.parametrize("name", built_in("domain"))
def test_every_domain_is_known_by_its_name_everywhere(name: str) -> None:
    assert waiter("domain", "show", "--domain", name).code == 0
    assert waiter("plan", "--scenario", "b4", "--domain", name, "--json").json()["domain"] == name


OWN_NAMES = ["report", "own.yaml", "sub/own.yaml", "sub folder/öwn"]


@pytest.mark.parametrize("name", mostly_slow(OWN_NAMES, "report", "sub folder/öwn"))
def test_a_file_comes_before_a_built_in(name: str, folder: Path) -> None:
    """Whatever it is called, in the folder where one is or by its whole path."""
    path = folder / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(OWN)
    for given in (name, str(path)):
        for line in (
            ("plan", "--layout", given, "--enter", "9", "--json"),
            ("answersets", "--layout", given, "--enter", "9", "--json"),
            ("explain", "--layout", given, "--enter", "9", "--json"),
            ("simulate", "--layout", given, "--enter", "9", "--json"),
            ("layout", "check", given, "--json"),
            ("layout", "draw", given, "--json"),
        ):
            ran = waiter(*line)
            assert ran.code == 0, ran.err
            assert ran.json().get("layout", "own") == "own"
        assert '"layout": "own"' in waiter("serve", "--layout", given).out
        compared = waiter("compare", given, "report", "--scenario", "e.yaml", "--json")
        assert "e.yaml" in compared.json()["errors"][0]["message"], "both layouts were found"


def test_a_scenario_file_comes_before_a_built_in(folder: Path) -> None:
    (folder / "b1").write_text("{layout: report, goals: [{at: n2}]}")
    assert waiter("plan", "--scenario", "b1", "--json").json()["horizon"] == 1


def test_a_domain_file_comes_before_a_built_in(folder: Path) -> None:
    """What only knows our own rules stays out then."""
    template = Path(data_folder("domains")) / "restaurant" / "domain.sparc"
    shutil.copy(template, folder / "restaurant")
    document = waiter("plan", "--scenario", "b4", "--domain", "restaurant", "--json").json()
    assert (document["validated"], document["horizon"]) == ("domain", 1)
    (folder / "restaurant").unlink()
    (folder / "restaurant").mkdir()
    shutil.copy(template, folder / "restaurant")
    document = waiter("plan", "--scenario", "b4", "--domain", "restaurant", "--json").json()
    assert document["validated"] is True, "a folder is no file"
    document = waiter("plan", "--scenario", "b4", "--domain", "./restaurant", "--json").json()
    assert document["validated"] == "domain"


def test_a_scenario_names_its_layout_from_where_it_lies(folder: Path) -> None:
    (folder / "rooms").mkdir()
    (folder / "rooms" / "own.yaml").write_text(OWN)
    (folder / "rooms" / "evening.yaml").write_text("{layout: own.yaml, observe: [{enter: [x]}]}")
    for command in ("plan", "explain", "answersets", "simulate"):
        assert waiter(command, "--scenario", "rooms/evening.yaml", "--json").code == 0
    ran = waiter("plan", "--scenario", "rooms/evening.yaml", "--layout", "report", "--json")
    assert ran.json()["layout"] == "report", "--layout wins"


# -- standard input ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "given"),
    [
        ("plan --layout - --enter 9", OWN),
        ("plan --scenario -", "{layout: report, observe: [{enter: [a]}]}"),
        ("plan --layout report --scenario -", "{observe: [{enter: [a]}]}"),
        ("answersets -", PROGRAM),
        ("answersets --layout - --enter 9", OWN),
        ("answersets --scenario -", "{layout: report, observe: [{enter: [a]}]}"),
        ("explain --layout - --enter 9", OWN),
        ("explain --scenario -", "{layout: report, observe: [{enter: [a]}]}"),
        ("simulate --layout - --enter 9", OWN),
        ("simulate --scenario -", "{layout: report, observe: [{enter: [a]}]}"),
        ("simulate --plan -", b1_plan),
        ("validate -", b1_plan),
        ("validate - --layout report", b1_plan),
        ("layout check -", OWN),
        ("layout draw -", OWN),
        ("layout draw --plan -", b1_plan),
        ("layout draw report --scenario -", "{state: {agent: n2}}"),
        ("layout convert -", b1_program),
        ("layout improve - --scenario e.yaml", OWN),
        ("compare - own.yaml --scenario e.yaml", OWN),
        ("sparc check -", PROGRAM),
        ("sparc translate -", PROGRAM),
        ("sparc query - -q p(X)", PROGRAM),
    ],
)
def test_a_dash_reads_standard_input(
    line: str, given: str | Callable[[], str], folder: Path
) -> None:
    (folder / "own.yaml").write_text(OWN)
    (folder / "e.yaml").write_text("{observe: [{enter: [x, y]}]}")
    ran = waiter(*line.split(), stdin=given if isinstance(given, str) else given())
    assert ran.code == 0, ran.err
    assert waiter(*line.split(), stdin="]").code == 2, "it is read"


# -- goals and parties of the command line -------------------------------------------------------


@pytest.mark.parametrize(
    "goal", ["{paid: table1}", "paid: table1", "paid:   table1", '{"paid": "table1"}', "{paid: c1}"]
)
def test_braces_around_a_goal_are_optional(goal: str) -> None:
    ran = waiter("plan", "--scenario", "b3", "--goal", goal, "--json")
    assert (ran.code, ran.json()["horizon"]) == (0, 1)


def test_parties_and_bills_are_given_as_often_as_wanted() -> None:
    line = ("plan", "--layout", "report", "--enter", "2", "--enter", "1", "--bill", "table1")
    document = waiter(*line, "--goal", "at: n6", "--goal", "at: n6", "--json").json()
    assert document["initial_state"]["waiting"] == [["c1", "c2"], ["c3"]]
    assert document["initial_state"]["wants_bill"] == ["table1"]
    assert {"at": "n6"} in document["goals"]


# -- the environment -----------------------------------------------------------------------------


def test_the_variable_names_the_jar_unless_the_option_does(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("WAITER_SPARC_JAR", "by-variable.jar")
    jar = ("plan", "--scenario", "b4", "--translator", "jar")
    ran = waiter(*jar)
    assert ran.code == 5 and "WAITER_SPARC_JAR" in ran.err and "by-variable.jar" in ran.err
    ran = waiter(*jar, "--sparc-jar", "by-option.jar")
    assert ran.code == 5 and "by-option.jar" in ran.err and "by-variable" not in ran.err
    assert waiter("plan", "--scenario", "b4").code == 0, "nobody asks for it otherwise"


def test_the_variable_chooses_the_translator_unless_the_option_does(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("WAITER_SPARC_JAR", "nowhere.jar")
    monkeypatch.setenv("WAITER_TRANSLATOR", "jar")
    plan = ("plan", "--scenario", "b4", "--json")
    assert waiter(*plan).code == 5
    assert waiter(*plan, "--translator", "native").json()["translator"] == "native"
    monkeypatch.setenv("WAITER_TRANSLATOR", "java")
    ran = waiter(*plan)
    assert ran.code == 2 and "WAITER_TRANSLATOR" in ran.json()["errors"][0]["message"]


@pytest.mark.parametrize(
    "line", ["--version", "-V", "plan --version", "layout check --version", "--debug --version"]
)
def test_the_version(line: str) -> None:
    ran = waiter(*line.split())
    assert (ran.code, ran.out, ran.err) == (0, f"waiter {__version__}\n", "")


# -- names in the wrong place -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("plan b1", "did you mean --scenario b1? see waiter plan --help"),
        ("explain report b1 b2", "did you mean --layout report --scenario b1? see waiter explain"),
        ("simulate own.yaml", "did you mean --layout own.yaml? see"),
        ("serve evening.yaml", "did you mean --scenario evening.yaml? see"),
        ("plan nothing", "see waiter plan --help"),
        ("doctor b1", "see waiter doctor --help"),
        ("plan --scenario b1 --show token", "did you mean tokens? see waiter plan --help"),
        ("plan --scenario b1 --search galop", "did you mean gallop? see waiter plan --help"),
        ("plan --scenario b1 --show x", "see waiter plan --help"),
        ("plan --layout b1", "did you mean --scenario b1?"),
        ("plan --scenario report", "did you mean --layout report?"),
        ("layout check b1", "b1 is a scenario; built-in layouts are bistro, report"),
    ],
)
def test_what_is_meant_is_understood(line: str, hint: str, folder: Path) -> None:
    (folder / "own.yaml").write_text("name: own\nnodes: {a: [0, 0]}\n")
    (folder / "evening.yaml").write_text("goals: []\n")
    ran = waiter(*line.split())
    assert ran.code == 2
    assert f"  hint: {hint}" in ran.err
    assert waiter(*line.split(), "--json").json()["errors"][0]["hint"].startswith(hint)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("plan --entr 2", "No such option: --entr. Did you mean --enter?"),
        ("plan --sear x", "No such option: --sear. Did you mean --search?"),
        ("plan --layuot x", "No such option: --layuot. Did you mean --layout?"),
        ("plan --sc x", "No such option: --sc. Did you mean --scenario?"),
        ("plan --xyz", "No such option: --xyz"),
        ("pln", "No such command 'pln'. Did you mean plan?"),
        ("sim", "No such command 'sim'. Did you mean simulate?"),
        ("layout che", "No such command 'che'. Did you mean check?"),
        ("q", "No such command 'q'"),
    ],
)
def test_unknown_options_and_commands_are_told_the_nearest_alone(line: str, message: str) -> None:
    ran = waiter(*line.split())
    assert ran.code == 2
    assert f"waiter: {message}\n" in ran.err


@pytest.mark.parametrize(
    ("line", "argument"),
    [
        ("layout check nowhere.yaml", "LAYOUT"),
        ("layout draw nowhere.yaml", "LAYOUT"),
        ("layout draw nowhere.yaml --watch", "LAYOUT"),
        ("layout improve nowhere.yaml --scenario b1", "LAYOUT"),
        ("compare nowhere.yaml report --scenario b1", "A"),
        ("compare report nowhere.yaml --scenario b1", "B"),
        ("plan --layout nowhere.yaml", "--layout"),
        ("validate --layout nowhere.yaml plan.json", "--layout"),
    ],
)
def test_a_missing_layout_is_told_of_its_own_argument(
    line: str, argument: str, folder: Path
) -> None:
    (folder / "plan.json").write_text(
        b1_plan().replace('"layout": "report"', '"layout": "nowhere.yaml"')
    )
    ran = waiter(*line.split())
    assert ran.code == 2
    assert ran.err.startswith(f"{argument}: error: there is no layout nowhere.yaml\n")
