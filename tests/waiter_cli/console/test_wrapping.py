"""What a person reads: broken at words on a terminal, whole lines in a pipe, the same words in both."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.terminal import Terminal
from waiter_cli.console.styling import printable, styled
from waiter_cli.console.wrapping import cells, table_lines, wrapped


def shown(columns: int, *command: str, **variables: str) -> tuple[list[str], int]:
    """The lines that a command shows on a terminal of that width, without styles, and its exit code."""
    with Terminal(*command, columns=columns, **variables) as terminal:
        code = terminal.end(60)
    progress = r"\r\x1b\[2K[^\r\n]*(?=\r\x1b)|\r\x1b\[2K"  # of a search on a busy machine
    text = re.sub(rf"{progress}|\x1b\[[0-9;]*m", "", terminal.seen)
    return text.replace("\r\n", "\n").splitlines(), code


# -- text -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("one two", "one two"),
        ("one two three four five six seven", "one two three four\n  five six seven"),
        ("  one two three four five six", "  one two three four\n    five six"),
        ("first line\nand a second one, longer", "first line\nand a second one,\n  longer"),
        ("of a/very/long/path/to/some.yaml it says", "of\n  a/very/long/path/to/some.yaml\n  it says"),
        ("a file.yaml:12:3: error: no node", "a file.yaml:12:3:\n  error: no node"),
        ("a mean wait of 9 or 9.6 s.", "a mean wait of 9 or\n  9.6 s."),
        ("nothing: run waiter plan --help", "nothing: run\n  waiter plan --help"),
        ("write 'seated: [c1, c2]' or a", "write\n  'seated: [c1, c2]'\n  or a"),
        ("one  two columns     and more", "one  two columns\n  and more"),
        ("é" * 9 + " " + "é" * 10, "é" * 9 + " " + "é" * 10),
        ("食" * 5 + " " + "食" * 5, "食" * 5 + "\n  " + "食" * 5),
    ],
)  # fmt: skip
def test_lines_are_broken_at_words(text: str, expected: str) -> None:
    assert wrapped(text, 20) == expected


def test_styles_take_no_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("waiter_cli.console.styling._wants_colour", lambda stream: True)
    text = f"{styled('one two three', 'bold')} four"
    assert printable(wrapped(text, 20)) == "\x1b[1mone two three\x1b[0m four"


def test_a_hanging_indent_leaves_room_for_words() -> None:
    lines = wrapped("head  " + "word " * 8, 30, 25).split("\n")
    assert lines[1].startswith(" " * 14 + "word")
    assert all(len(line) <= 30 for line in lines)


# -- tables -----------------------------------------------------------------------------------

HEADINGS = ("step", "action", "in words", "at")
ROWS = [
    ("0", "go_to(agent,n2)", "walk from n1 to n2", "n1"),
    ("1", "pick(agent,c1)", "ask the party of c1 (4) to follow", "n2"),
]


def test_a_table_that_fits_is_left_alone() -> None:
    whole = table_lines(HEADINGS, ROWS)
    assert table_lines(HEADINGS, ROWS, prose=2, width=max(map(len, whole))) == whole


@pytest.mark.parametrize("width", [58, 50, 42])
def test_the_column_of_prose_gives_way(width: int) -> None:
    lines = table_lines(HEADINGS, ROWS, prose=2, width=width)
    assert max(map(len, lines)) <= width
    assert len(lines) > len(table_lines(HEADINGS, ROWS))
    assert Counter(" ".join(lines).split()) == Counter(
        " ".join(table_lines(HEADINGS, ROWS)).split()
    )
    assert all(line.startswith("   ") for line in lines[1:])


def test_columns_are_counted_in_cells() -> None:
    first, second = table_lines(("a", "b"), [("食", "x")], right=())
    assert cells(first) == cells(second) == 5


# -- commands ---------------------------------------------------------------------------------

COMMANDS = [
    ("plan", "--layout", "report", "--enter", "3", "--search", "linear"),
    ("plan", "--scenario", "blocked_aisle"),
    ("plan", "--layout", "report", "--enter", "1", "--max-steps", "3"),
    ("explain", "--scenario", "blocked_aisle"),
    ("explain", "--scenario", "b1", "--why-not", "go_to(agent,n0)"),
    ("layout", "check", "report"),
    ("compare", "report", "report_large", "--scenario", "b2"),
    ("simulate", "--scenario", "nope"),
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_no_line_is_wider_than_the_terminal(command: tuple[str, ...]) -> None:
    lines, code = shown(60, *command)
    piped = waiter(*command)
    assert code == piped.code
    assert Counter(" ".join(lines).split()) == Counter(f"{piped.out} {piped.err}".split())
    assert max(map(len, f"{piped.out}\n{piped.err}".splitlines())) > 60, "nothing to break"
    assert [line for line in lines if len(line) > 60 and " " in line.strip()] == []


@pytest.mark.wide
def test_the_plan_of_a_long_evening_fits_80_columns() -> None:
    lines, _ = shown(80, "plan", "--scenario", "lunch", TERM="xterm-256color")
    assert max(map(len, lines)) <= 80
    assert lines[0].split() == ["step", "action", "in", "words", "at"]
    assert "  19  send_order(agent,table1)      send the order of table1 to the       bar1" in lines


def test_the_lines_of_a_file_are_cut_to_the_terminal(tmp_path: Path) -> None:
    layout = tmp_path / "x.yaml"
    nodes = ", ".join(f"n{k}" for k in range(60))
    layout.write_text(f"nodes: [{nodes}]\nedges: []\nentrance: n0\nagent: n0\nnode: {nodes} x\n")
    program = tmp_path / "x.sparc"
    program.write_text("sorts\npredicates\nrules\n" + "p(a), " * 40 + ":- q.\n")
    for command in (("layout", "check", str(layout)), ("sparc", "check", str(program))):
        lines, code = shown(70, *command)
        assert code == 2
        assert any(" | " in line and "…" in line for line in lines)
        assert max(len(line) for line in lines if " | " in line) <= 70


def test_the_tour_and_the_doctor_fit_their_terminal() -> None:
    with Terminal("tour", columns=50) as terminal:
        terminal.expect("[Enter]")
        head = terminal.seen.replace("\r\n", "\n").split("\n$ waiter")[0]
        terminal.type("\x04")
        terminal.end()
    assert len(head.splitlines()) == 3 and max(map(len, head.splitlines())) <= 50
    lines, _ = shown(60, "doctor")
    assert [line for line in lines if len(line) > 60 and " " in line.strip()] == []


def test_a_terminal_without_a_size_has_80_columns() -> None:
    lines, _ = shown(0, "explain", "--scenario", "blocked_aisle")
    assert 60 < max(map(len, lines)) <= 80


def test_validate_breaks_its_reasons(tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    document = waiter("plan", "--layout", "report", "--enter", "1", "--json").out
    plan.write_text(
        document.replace("go_to(agent,n3)", "go_to(agent,n7)").replace('"n3"]', '"n7"]')
    )
    lines, code = shown(40, "validate", "--layout", "report", str(plan))
    assert code == 3
    assert max(map(len, lines)) <= 40


def test_a_verdict_about_a_program_is_broken(tmp_path: Path) -> None:
    program = tmp_path / "family.sparc"
    program.write_text("sorts\n#p = {ann, ben}.\npredicates\nparent(#p, #p).\nrules\n")
    lines, code = shown(len(str(program)) + 13, "sparc", "check", str(program))
    assert code == 0
    assert lines == [f"{program}: no fault in", "  1 sort, 1 predicate, 0 rules."]


def test_a_line_that_installs_something_is_never_broken() -> None:
    """It has the path of an interpreter in it, and is there to be copied."""
    for folder in ("/bin", f"/home/{'long/' * 20}bin"):
        command = f"{folder}/python3.11 -m pip install 'waiter-planner[record]'"
        lines = wrapped(f"  hint: {command} (or draw to a file that ends in .svg)", 80, 6)
        assert command in lines
        assert [line for line in lines.splitlines() if command not in line and len(line) > 80] == []
