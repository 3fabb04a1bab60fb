"""The help of every command: it has examples, they run, it fits a terminal and says one thing one way."""

from __future__ import annotations

import shutil
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.helps import command_tree, examples, run_line
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide
from tests.support.studies import QUICK, write_study
from waiter_cli.file_access.locate import data_folder

TREE = command_tree()
COMMANDS = sorted(TREE)

# Options of one name that ask for different things, and so are worded differently.
OWN_WORDS = {
    "--scenario": "compare and layout improve take several; layout new and schema are about one",
    "--plan": "played by simulate, drawn by layout draw",
    "--output": "what is written is something else",
    "--json": "serve speaks JSON anyhow, but not of faults",
    "--time-limit": "of one search, of each, of all",
    "--horizon": "of what is shown, of the answer sets",
    "--grep": "a pattern for literals, a text in rules",
    "--seed": "of a file, of a run",
    "--only": "predicates, kinds of changes",
    "--verbose": "stages of a search, pieces of advice",
    "--version": "of waiter, of sparc.jar",
    "--journal": "of the lines of serve, of all that happens in the studio",
    "--speed": "of the robot, of the time in the studio",
    "--domain": "that plans, or that validate plays a plan by",
}


def name_of(words: str) -> str:
    return words or "waiter"


@pytest.mark.parametrize("words", COMMANDS, ids=name_of)
def test_help_fits_a_terminal(words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    ran = waiter(*words.split(), "--help")
    assert (ran.code, ran.err) == (0, "")
    assert max(map(len, ran.out.splitlines())) <= 80
    assert waiter(*words.split(), "-h").out == ran.out


@pytest.mark.parametrize("words", ["", "domain", "layout", "sparc"], ids=name_of)
def test_lists_of_commands_have_whole_sentences(words: str) -> None:
    listed = " ".join(waiter(*words.split(), "--help").out.partition("Commands:")[2].split())
    for name in TREE[words].commands:
        first = TREE[f"{words} {name}".strip()].help.partition("\n\n")[0]
        assert f"{name} {' '.join(first.split())}" in listed


@pytest.mark.parametrize("words", COMMANDS, ids=name_of)
def test_everything_is_explained(words: str) -> None:
    command = TREE[words]
    assert command.help and command.help.split("\n")[0].strip().endswith((".", "?"))
    for parameter in command.params:
        assert parameter.help, f"{parameter.opts} of waiter {words} has no help"
        assert parameter.help.rstrip().endswith((".", "?", "]")), (
            f"{parameter.opts}: a sentence ends"
        )


@pytest.mark.parametrize("words", ["plan", "simulate", "serve", "answersets"])
def test_long_lists_of_options_stand_under_headings(words: str) -> None:
    """The six that everybody needs come first, every option has one place, and the page agrees."""
    from waiter_cli.command_line.command import groups_of

    command = TREE[words]
    groups = groups_of(command, command.params)
    assert groups[0][0] == "Options" and len(groups[0][1]) == 6
    assert {"layout", "scenario", "as_json"} <= {option.name for option in groups[0][1]}
    placed = [option for _, below in groups for option in below]
    options = [each for each in command.params if each.param_type_name == "option"]
    assert sorted(map(id, placed)) == sorted(map(id, options))
    _, _, listed = waiter(words, "--help").out.partition("\nOptions:\n")
    headings = [line[:-1] for line in listed.splitlines() if line and line[0] != " "]
    assert ["Options", *headings] == [title for title, _ in groups]
    first = listed.partition("\n\n")[0]
    for option in groups[0][1]:
        assert option.opts[0] in first
    assert listed.count("--help") == 1 and listed.splitlines()[-1].split()[1] == "--help"
    _, _, page = waiter("--man").out.partition(f'.SS "waiter {words}')
    page = page.partition(".SS ")[0]
    places = [page.index(f"\n.I {title}\n") for title, _ in groups]
    assert places == sorted(places)


def test_one_option_has_one_wording() -> None:
    said: dict[str, dict[str, list[str]]] = {}
    for words, command in TREE.items():
        for parameter in command.params:
            for option in parameter.opts:
                if option.startswith("--"):
                    said.setdefault(option, {}).setdefault(parameter.help, []).append(words)
    several = {option for option, texts in said.items() if len(texts) > 1}
    assert several == set(OWN_WORDS), {option: said[option] for option in several ^ set(OWN_WORDS)}


def test_short_options_mean_one_thing_within_a_command() -> None:
    for words, command in TREE.items():
        short = [o for p in command.params for o in p.opts if len(o) == 2]
        assert len(short) == len(set(short)), words


# -- the examples -----------------------------------------------------------------------------

FAMILY = """\
sorts
#person = {anna, ben, carla, dora}.
predicates
parent(#person, #person).
ancestor(#person, #person).
rules
parent(anna, ben). parent(ben, carla). parent(ben, dora).
ancestor(X, Y) :- parent(X, Y).
ancestor(X, Z) :- ancestor(X, Y), parent(Y, Z).
"""


TWO = """name: two
nodes: {door: [0, 0], aisle: [2, 0], back: [4, 0]}
edges: [[door, aisle], [aisle, back]]
entrance: door
tables: {table1: {capacity: 2, nodes: [back]}}
agents: {r1: aisle, r2: back}
"""


def make_file(name: str) -> None:
    """A file that an example reads."""
    path = Path(name)
    path.parent.mkdir(exist_ok=True)
    match name:
        case "family.sparc" | "blocks.sparc":
            path.write_text(FAMILY)
        case "restaurant.sparc":
            path.write_text(waiter("plan", "--scenario", "b1", "--show", "sparc").out)
        case "plan.json":
            path.write_text(waiter("plan", "--scenario", "b1", "--json").out)
        case "friday.yaml":
            path.write_text(QUICK)
        case "friday-study.yaml":
            write_study(path.parent, "1..2").rename(path)
        case "friday.db":
            make_file("friday-study.yaml")
            waiter("study", "run", "friday-study.yaml", "-o", name, "--workers", "1")
        case "my/domain.sparc":
            shutil.copytree(
                Path(data_folder("domains")) / "report", path.parent, dirs_exist_ok=True
            )
        case "two.yaml":
            path.write_text(TWO)
        case "cafe.yaml" | "my.yaml" | "bistro.yaml" | "bistro-new.yaml":
            shutil.copy(Path(data_folder("layouts")) / "report.yaml", path)
        case "evening.yaml":
            path.write_text("observe: [{enter: [c1, c2]}]\n")
        case "evenings":
            path.mkdir(exist_ok=True)
            shutil.copy(Path(data_folder("layouts")) / "scenarios" / "b2.yaml", path)


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What examples would wait for: a file that changes, a client, a download, a reader's Enter."""
    from waiter_cli.commands import watching
    from waiter_cli.commands.sparc import fetch_jar as sparc_fetching
    from waiter_cli.serve import sockets
    from waiter_cli.translators import jar_store

    looks = iter([[None], KeyboardInterrupt])

    def look(_: object) -> object:
        look = next(looks)
        if isinstance(look, list):
            return look
        raise look

    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(watching, "_stamps", look)
    monkeypatch.setattr(sockets, "listen_on", lambda *_: None)
    if find_spec("starlette") is not None:
        monkeypatch.setattr("waiter_cli.studio.server.serve_studio", lambda *_: None)
    monkeypatch.setattr(jar_store, "fetch", lambda *_, **__: None)
    monkeypatch.setattr(sparc_fetching, "_agreed", lambda _: True)


DOCUMENTED = {
    line
    for page in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    for line in page.read_text(encoding="utf-8").splitlines()
} - {"waiter sparc fetch-jar"}  # which is not run there


LONG = {
    "domain test",
    "layout improve",
    "serve",
    "simulate",
    "study",
    "study report",
    "study run",
    "study show",
}  # evenings, searches, and their like


@pytest.mark.parametrize("words", mostly_wide(COMMANDS, *set(COMMANDS) - LONG), ids=name_of)
def test_every_example_runs(words: str, elsewhere: None) -> None:
    """But for the lines that stand on a page of the documentation, and are run there."""
    lines = examples(TREE[words].help)
    assert lines, f"waiter {words} --help shows no example"
    for line in lines:
        assert f"waiter {words}".rstrip() in line
        if line in DOCUMENTED:
            continue
        if "--record" in line:
            if find_spec("imageio_ffmpeg") is None:
                continue
            line += " --view 2d --size 320x200 --fps 1"
        if "--study" in line:
            line += " --tries 1"
        if words == "studio" and find_spec("starlette") is None:
            continue
        if ".png" in line and find_spec("PIL") is None:
            continue
        written = [b for a, b in zip(line.split(), line.split()[1:]) if a in ("-o", ">")]
        for word in line.split():
            if word not in written and not Path(word).exists():
                make_file(word)
        ran = run_line(line)
        assert ran.code == 0, f"{line}\n{ran.err}"
        assert "Traceback" not in ran.err
        for name in written:
            assert Path(name).stat().st_size, line


def test_an_example_that_is_wrong_would_be_seen(elsewhere: None) -> None:
    assert run_line("waiter plan --layout nowhere").code == 2
    assert run_line("waiter plan --scenario b1 --json | waiter validate -").code == 0
    assert run_line("waiter plan --scenario b1 | waiter validate -").code == 2
    assert examples("Words.\n\nExamples:\n  waiter a\n  waiter b > c\n\nMore") == [
        "waiter a",
        "waiter b > c",
    ]
