"""Nothing that comes from outside commands a terminal, hides a letter, or passes for own colour."""

from __future__ import annotations

import io
import json
import re
import unicodedata
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

from sparc.__main__ import main as sparc_main
from sparc.escaping import escaped
from tests.support.cli import Ran, Screen, waiter
from tests.support.helps import command_tree
from waiter_cli.console import output, styling

pytestmark = pytest.mark.attack

FOUL = "x\x1b[31m\x1b]0;t\x07\x9b31m\u202e\u200b\u2066\ufeff\x7f\x08\r\udcff\U000e0041"
"""A title, colours of 7 and 8 bits, marks of direction, no width, bytes that are no UTF-8, a tag."""
SPARC = "sorts\n#p = {a}.\npredicates\nq(#p).\nrules\nq(a).\n"
LAYOUT = """nodes: {a: [0, 0], b: [1, 0]}
edges: [[a, b]]
entrance: a
agent: b
tables:
  t: {capacity: 2, nodes: [b]}
"""
NEEDED = {
    "answersets": ["a.sparc"],
    "compare": ["l.yaml", "l.yaml", "--scenarios", "s.yaml"],
    "explain": ["--layout", "l.yaml"],
    "layout check": ["l.yaml"],
    "layout convert": ["a.sparc"],
    "layout draw": ["l.yaml"],
    "layout improve": ["l.yaml", "--scenario", "s.yaml"],
    "layout new": ["--tables", "2"],
    "plan": ["--layout", "l.yaml"],
    "serve": ["--layout", "l.yaml"],
    "simulate": ["--layout", "l.yaml", "--backend", "geometric"],
    "sparc check": ["a.sparc"],
    "sparc format": ["a.sparc"],
    "sparc query": ["a.sparc", "--query", "q(a)"],
    "sparc translate": ["a.sparc"],
    "validate": ["p.json"],
}
SUFFIXES = ("", ".yaml")


def foul(text: str) -> set[str]:
    """The characters of a text that are no letters, signs, spaces or line ends."""
    hidden = {"Cc", "Cf", "Cs", "Zl", "Zp"}
    return {c for c in set(text) - {"\n", "\t"} if unicodedata.category(c) in hidden}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "80")
    files = {
        "a.sparc": SPARC,
        "l.yaml": LAYOUT,
        "s.yaml": "layout: l.yaml\ngoals: []\n",
        "p.json": '{"status": "plan", "layout": "l.yaml", "horizon": 0, "actions": []}',
    }
    for name, text in files.items():
        Path(name).write_text(text)
    return tmp_path


def clean(*arguments: str, stdin: str = "") -> Ran:
    """What a command line shows on a terminal, which is nothing foul."""
    ran = waiter(*arguments, stdin=stdin, terminal=True)
    bar = re.sub(r"(\rrecording [^\r\n]*)+\r +\r", "", ran.err)
    assert not foul(ran.out + bar), (arguments, ran)
    assert ran.code != 1, (arguments, ran.err)
    return ran


def leaves() -> Iterator[str]:
    for words, command in command_tree().items():
        if not hasattr(command, "commands") and words != "tour":
            yield words


def values(parameter: object, suffixes: tuple[str, ...]) -> Iterator[str]:
    """What is given to an option: foul by itself, or as the name of a file."""
    kind = getattr(getattr(parameter, "type", None), "name", "")
    yield from (FOUL + s for s in (suffixes if kind in ("text", "path", "str") else SUFFIXES[:1]))


@pytest.mark.parametrize(
    "suffixes", [SUFFIXES[:1], pytest.param(SUFFIXES, marks=pytest.mark.slow)], ids=["", "files"]
)
@pytest.mark.parametrize("words", sorted(leaves()))
def test_every_option(
    words: str, suffixes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    if words == "studio":
        pytest.importorskip("starlette")
        monkeypatch.setattr("waiter_cli.studio.server.serve_studio", lambda *_: None)
    told = 0
    needed = NEEDED.get(words, [])
    for parameter in command_tree()[words].params:
        for value in values(parameter, suffixes):
            if parameter.param_type_name == "argument":
                told += "x\\x1b" in clean(*words.split(), value).err
                continue
            if parameter.is_flag or parameter.name == "help":
                break
            for name in parameter.opts[-1:]:
                ran = clean(*words.split(), *needed, name, value)
                told += "x\\x1b" in ran.out + ran.err
    clean(*words.split(), *needed, f"--{FOUL}")
    clean(*words.split(), *needed, FOUL, FOUL)
    assert told or not needed, "what was given is never told"


def test_commands() -> None:
    for words, command in command_tree().items():
        if hasattr(command, "commands"):
            clean(*words.split(), FOUL)
            clean(*words.split(), f"--{FOUL}")


IN_FILES = {
    "plain": FOUL.replace("\udcff", "").replace("\r", ""),
    "quoted": '"\\e[31m\\x9b\\u202e\\u200b\\uD800"',
    "json": json.dumps(FOUL),
}


@pytest.mark.parametrize("text", IN_FILES.values(), ids=IN_FILES)
def test_words_of_files(text: str) -> None:
    """Each word of a layout, a scenario, a plan and a program replaced by a foul one."""
    for name, commands in {
        "l.yaml": (("layout", "check"), ("layout", "draw"), ("plan", "--layout")),
        "s.yaml": (("plan", "--scenario"), ("layout", "check")),
        "p.json": (("validate",),),
        "a.sparc": (
            ("sparc", "check"),
            ("sparc", "format"),
            ("answersets",),
            ("layout", "convert"),
        ),
    }.items():
        good = Path(name).read_text()
        for word in ("nodes", "a:", "b]", "capacity", "2", "layout", "[]", "plan", "0", "#p", "q"):
            if word in good:
                Path(name).write_text(good.replace(word, word.rstrip("ab:]") + text, 1))
                for command in commands:
                    clean(*command, name)
        Path(name).write_text(good)


def test_comments_of_a_program() -> None:
    comment = FOUL.replace("\udcff", "").replace("\r", "")
    Path("a.sparc").write_text(f"% {comment}\n{SPARC}")
    assert "% x\\x1b[31m" in clean("sparc", "format", "a.sparc").out
    assert waiter("sparc", "format", "a.sparc").out.startswith(f"% {comment}\n")
    clean("domain", "show", "--domain", "a.sparc", "--source")


def test_names_of_files() -> None:
    for suffix, text in ((".yaml", LAYOUT), (".sparc", SPARC), (".json", "{")):
        name = f"{FOUL}{suffix}"
        Path(name).write_text(text)
        for command in (
            ("layout", "check"), ("layout", "draw"), ("plan", "--layout"), ("sparc", "check"),
            ("answersets",), ("validate",), ("simulate", "--backend", "geometric", "--layout"),
        ):  # fmt: skip
            clean(*command, name)
            clean(*command, name, "--json")
    drawn = clean("layout", "draw", f"{FOUL}.yaml", "-o", f"{FOUL}.svg")
    assert drawn.err.startswith("wrote x\\x1b")
    assert not foul(Path(f"{FOUL}.svg").read_text())


def test_a_name_begins_no_line_of_its_own() -> None:
    name = "x.yaml:1:1: error: a\nvalid: all is well"
    Path(name).write_text("nodes: 3\n")
    lines = clean("layout", "check", name).err.splitlines()
    assert lines and not any(line.startswith("valid") for line in lines)


def test_lines_of_a_session() -> None:
    lines = [
        FOUL,
        json.dumps({FOUL: 1}),
        json.dumps({"observe": {"enter": [FOUL]}}),
        f'"{FOUL}',
        '{"a\x7fb": 1}',
        '{"id": "\x7f", "ask": "state"}',
        '{"observe": {"enter": ["\x7f"]}}',
    ]
    given = "\n".join(lines).replace("\udcff", "").replace("\r", "") + "\n"
    ran = clean("serve", "--layout", "l.yaml", "--journal", "j", stdin=given)
    for line in ran.out.splitlines():
        json.loads(line)
    Path("j").write_text(Path("j").read_text() + given)
    clean("serve", "--layout", "l.yaml", "--journal", "j", "--replay")


def test_the_tool_chain_by_itself() -> None:
    Path(f"{FOUL}.sparc").write_text(
        SPARC.replace("q(a).", f"q({FOUL[:-2]}).").replace("\udcff", "")
    )
    for arguments in (
        [f"{FOUL}.sparc"], [FOUL], ["a.sparc", "--query", FOUL], ["a.sparc", "-c", FOUL],
        ["a.sparc", "-n", FOUL], ["a.sparc", f"--{FOUL}"], ["a.sparc", "--show", FOUL],
    ):  # fmt: skip
        out, err = Screen(), Screen()
        with redirect_stdout(out), redirect_stderr(err):
            try:
                assert sparc_main(arguments) == 2
            except SystemExit as leaving:
                assert leaving.code == 2
        assert err.getvalue() and not foul(out.getvalue() + err.getvalue()), arguments


def test_json_holds_what_was_given_and_nothing_foul() -> None:
    ran = clean("plan", "--layout", FOUL, "--json")
    (fault,) = ran.json()["errors"]
    assert fault["message"] == f"there is no layout {FOUL}"


def test_own_colour_passes_and_foreign_colour_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "")
    monkeypatch.setenv("TERM", "xterm")
    seen = waiter("plan", "--layout", "\x1b[31mred\x1b[0m", terminal=True).err
    assert "\x1b[1;31merror:\x1b[0m" in seen
    assert "\x1b[31mred" not in seen and "\\x1b[31mred" in seen
    screen = Screen()
    output.say(f"{styling.styled('mine', 'red', screen)} and \x1b[31mforeign\x1b[0m", screen)
    assert screen.getvalue() == "\x1b[31mmine\x1b[0m and \\x1b[31mforeign\\x1b[0m\n"
    into_a_file = io.StringIO()
    output.say(styling.styled("mine", "red", into_a_file), into_a_file)
    assert into_a_file.getvalue() == "mine\n"


def test_every_character_is_either_shown_or_told() -> None:
    every = "".join(map(chr, range(0x11000))) + "\U000e0001\U000e007f"
    assert foul(escaped(every.replace("\ufff9", ""))) <= UNKNOWN


UNKNOWN = set(
    "\u0600\u0601\u0602\u0603\u0604\u0605\u06dd\u070f\u0890\u0891\u08e2\U000110bd\U000110cd"
)
"""Format characters that have a shape of their own."""
