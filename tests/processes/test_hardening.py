"""Surroundings that are not at their best: no home, odd locales and names, streams that lead nowhere."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.jar import JAR, JAR_MARKS
from tests.support.odd_files import LAYOUT, PROGRAM, SCENARIO, TITLE, fingerprints, write_odd_files
from tests.support.processes import at_once, started, surroundings, waiter_process
from tests.support.sampling import mostly_slow
from waiter_cli.file_access.locate import data_folder

pytestmark = pytest.mark.skipif(os.name != "posix", reason="streams and names as POSIX has them")


@pytest.fixture(scope="module")
def odd(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The odd files, and a plan of theirs."""
    folder = write_odd_files(tmp_path_factory.mktemp("odd"))
    planned = waiter_process("plan", "--scenario", SCENARIO, "--json", cwd=folder)
    (folder / "-plan é.json").write_text(planned.out, encoding="utf-8")
    return folder


def is_clean(ran: Any) -> bool:
    """Whether nothing of Python shows."""
    said = ran.out + ran.err
    return not any(word in said for word in ("Traceback", "internal fault", "Unicode", "Errno"))


# -- no home ----------------------------------------------------------------------------------

NOBODY = """\
import pwd
def getpwuid(number):
    raise KeyError(number)
pwd.getpwuid = getpwuid
from waiter_cli.app import main
main()
"""
HOMES = ("HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME")
WORK = [
    ("plan", "--scenario", "b4"),
    ("answersets", "--scenario", "b4"),
    ("sparc", "check", "--", PROGRAM),
    ("sparc", "query", "--query", "edge(a,b)", "--", PROGRAM),
    ("sparc", "query", "--", PROGRAM),
    ("simulate", "--scenario", "b4", "--headless"),
    ("doctor",),
]


@pytest.mark.wide
@pytest.mark.parametrize("home", mostly_slow(["unwritable", "nobody"], "nobody"))
def test_without_a_home_all_goes_on(home: str, odd: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way of every folder")
    nowhere = str(tmp_path / "file" / "sub") if home == "unwritable" else None
    variables = dict.fromkeys(HOMES, nowhere)
    begin = NOBODY if home == "nobody" else None

    def run(command: tuple[str, ...]) -> Any:
        return waiter_process(*command, cwd=odd, stdin="edge(X,Y)\n", begin=begin, **variables)

    for command, ran in zip(WORK, at_once(run, WORK)):
        assert ran.code == 0 and is_clean(ran), (command, ran)
    fetched = run(("sparc", "fetch-jar", "--yes", "--url", "file:///nowhere"))
    assert fetched.code == 5 and is_clean(fetched)
    assert ("no home folder" if home == "nobody" else "cannot write to") in fetched.err
    wanted = run(("plan", "--scenario", "b4", "--translator", "jar"))
    assert wanted.code == 5 and "hint: " in wanted.err and is_clean(wanted)
    assert not [name for name in os.listdir(odd) if "history" in name]


@pytest.mark.wide
@pytest.mark.parametrize("begin", [None, pytest.param(NOBODY, id="nobody")])
@pytest.mark.parametrize("jar", [pytest.param(JAR, marks=JAR_MARKS, id="jar")])
def test_translations_need_not_be_kept(begin: str | None, jar: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    nowhere = None if begin else str(tmp_path / "file" / "sub")
    command = ("plan", "--scenario", "b4", "--translator", "jar", "--sparc-jar", jar)
    ran = waiter_process(*command, begin=begin, **dict.fromkeys(HOMES, nowhere))
    assert (ran.code, ran.err) == (0, "") and "1 step" in ran.out


# -- odd locales ------------------------------------------------------------------------------

LOCALES: dict[str, dict[str, str | None]] = {
    "ascii": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "unknown": {"LC_ALL": "xx_YY.KOI8-R", "PYTHONUTF8": "0"},
    "posix": {"LC_ALL": "POSIX", "PYTHONIOENCODING": "ascii:strict"},
    "latin": {"LC_ALL": "C.UTF-8", "PYTHONIOENCODING": "latin-1"},
    "turkish": {"LC_ALL": None, "LANG": "tr_TR.UTF-8"},
}


@pytest.mark.wide
@pytest.mark.parametrize("locale", mostly_slow(LOCALES, "ascii"))
def test_in_any_locale(locale: str, odd: Path, tmp_path: Path) -> None:
    """What cannot be shown has its code, JSON stays JSON, files are in UTF-8."""
    (tmp_path / "wrong ö.yaml").write_text("tåbles: {}\n", encoding="utf-8")
    commands: list[tuple[object, ...]] = [
        ("plan", "--scenario", SCENARIO, "--json"),
        ("explain", "--scenario", SCENARIO),
        ("layout", "draw", "-o", tmp_path / "é.svg", "--scenario", SCENARIO),
        ("layout", "draw", "--", LAYOUT),
        ("layout", "check", "--json", "--", LAYOUT),
        ("layout", "check", "--json", tmp_path / "wrong ö.yaml"),
        ("validate", "--scenario", SCENARIO, "--", "-plan é.json"),
        ("sparc", "check", "--", PROGRAM),
        ("sparc", "translate", "-o", tmp_path / "é.lp", "--", PROGRAM),
        ("simulate", "--scenario", SCENARIO, "--events", "-"),
    ]

    def run(command: tuple[object, ...]) -> Any:
        process = started(*command, cwd=odd, environment=surroundings(**LOCALES[locale]))
        out, err = process.communicate(timeout=120)
        encoding = "latin-1" if locale == "latin" else "utf-8"
        return process.returncode, out.decode(encoding), err.decode(encoding)

    found = at_once(run, commands)
    for command, (code, out, err) in zip(commands, found):
        assert code == (2 if "wrong" in str(command[-1]) else 0), (command, err)
        assert not any(word in out + err for word in ("Traceback", "internal", "UnicodeE")), command
        if locale in ("ascii", "unknown", "posix"):
            assert out.isascii() and err.isascii(), command
        if "--json" in command:
            assert "layout" in json.loads(out) or json.loads(out)["status"] == "error"
    assert json.loads(found[0][1])["layout"] == json.loads(found[4][1])["layout"] == TITLE
    (error,) = [e for e in json.loads(found[5][1])["errors"] if "unknown key" in e["message"]]
    assert "tåbles" in error["message"] and error["file"].endswith("wrong ö.yaml")
    assert json.loads(found[9][1].splitlines()[0])["layout"] == TITLE
    assert "店" in (tmp_path / "é.svg").read_text(encoding="utf-8")
    assert "% -p ø\\nx. %s.sparc:7\n" in (tmp_path / "é.lp").read_text(encoding="utf-8")


def test_a_name_that_is_no_utf_8(tmp_path: Path) -> None:
    name = os.fsdecode(b"caf\xe9.sparc")
    (tmp_path / name).write_text("sorts #s = {a}. predicates p(#s). rules p(a).")
    ran = waiter_process("sparc", "translate", name, "-o", "out.lp", cwd=tmp_path)
    assert (ran.code, ran.err) == (0, "")
    assert "% caf\\xe9.sparc:1\n" in (tmp_path / "out.lp").read_text(encoding="utf-8")
    faulty = waiter_process("sparc", "check", f"x{name}", "--json", cwd=tmp_path).json()
    assert faulty["errors"][0]["file"] == f"x{name}"


# -- odd names, and inputs that stay as they are ----------------------------------------------


@pytest.mark.wide
def test_odd_names_and_inputs_that_stay_as_they_are(
    odd: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each command with files of odd names: it works, and changes no input and nothing shipped."""
    out = tmp_path / "%d out 'é\n"
    out.mkdir()
    evening = out / "n\n.yaml"
    inputs = (odd, Path(data_folder("layouts")), Path(data_folder("domains")))
    before = fingerprints(*inputs)
    lunch = '{"observe": {"enter": ["c2"]}}\n{"done": 0}\n'
    commands: list[tuple[object, ...]] = [
        ("plan", "--layout", LAYOUT, "--scenario", SCENARIO),
        ("explain", "--scenario", SCENARIO, "--why-not", "go_to(agent,c)"),
        ("answersets", "--scenario", SCENARIO),
        ("answersets", "--", PROGRAM),
        ("validate", "--layout", LAYOUT, "--", "-plan é.json"),
        ("layout", "check", "--", LAYOUT),
        ("layout", "draw", "--plan", "-plan é.json", "-o", out / "-é %d.png", "--", LAYOUT),
        ("layout", "draw", "-o", out / "-é\n.txt", "-o", out / "'.svg", "--", LAYOUT),
        ("layout", "convert", "--", PROGRAM),
        ("layout", "convert", "-o", out / "-c ü.yaml", "--", PROGRAM),
        ("layout", "new", "--scenario", "--layout", LAYOUT, "--parties", "1", "-o", evening),
        ("layout", "improve", "--scenario", SCENARIO, "--", LAYOUT),
        ("layout", "improve", "--scenario", SCENARIO, "-o", out / "-i\n.yaml", "--", LAYOUT),
        ("compare", "--scenario", SCENARIO, "--", LAYOUT, f"./{LAYOUT}"),
        ("sparc", "translate", "-o", out / "-t\n.lp", "--", PROGRAM),
        ("serve", "--scenario", SCENARIO, "--journal", out / "-j é\n"),
        ("simulate", "--scenario", SCENARIO, "--events", out / "-e é\n.jsonl"),
        ("simulate", "--plan", "-plan é.json", "--layout", LAYOUT, "--record", out / "'é\n.html"),
        ("domain", "show"),
    ]

    def run(command: tuple[object, ...]) -> Any:
        return waiter(*map(str, command), stdin=lunch)

    monkeypatch.chdir(odd)
    for command in commands:
        ran = run(command)
        assert ran.code == 0 and is_clean(ran), (command, ran)
    after: list[tuple[object, ...]] = [
        ("serve", "--replay", out / "-j é\n"),
        ("serve", "--scenario", SCENARIO, "--journal", out / "-j é\n"),
        ("layout", "check", out / "-i\n.yaml"),
        ("plan", "--scenario", evening),
    ]
    journal = fingerprints(out / "-j é\n")
    assert run(after.pop(0)).code == 0 and fingerprints(*journal) == journal, "only read"
    for command in after:
        ran = run(command)
        assert ran.code == 0 and is_clean(ran), (command, ran)
    program = (out / "-t\n.lp").read_text(encoding="utf-8").splitlines()
    assert [line for line in program if line and line[0] not in "%#e"] == []
    assert fingerprints(*inputs) == before


RECORDINGS = ["%03d 'é\n.gif", "-é %d.mp4", "frames %d é"]


@pytest.mark.parametrize("name", mostly_slow(RECORDINGS, *RECORDINGS[:1]))
def test_recordings_of_odd_names(name: str, odd: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    pytest.importorskip("PIL")
    before = sorted(os.listdir(odd))
    small = ("--view", "2d", "--backend", "geometric", "--size", "160x160", "--fps", "1")
    ran = waiter_process("simulate", "--scenario", "b4", *small, "--record", name, cwd=odd)
    assert ran.code == 0 and is_clean(ran) and name in ran.out
    assert sorted(os.listdir(odd)) == sorted([*before, name])
