"""Limits under attack: numbers that are none, input without end, memory that ends anywhere."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

import pytest

from sparc import limits
from tests.support.cli import waiter
from tests.support.processes import waiter_process
from tests.support.sampling import mostly_wide
from waiter_cli import find_translator
from waiter_cli.encoding.domains import find_domain
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.problems.pose import pose_problem

pytestmark = pytest.mark.attack

NOT_NUMBERS = (
    "nan", "inf", "-inf", "infinity", "-1", "0x10", "1_0", "", " ", "1e400", "9" * 400, "٣", "²",
    "1,5", "0x1p3", "NaN",
)  # fmt: skip


@contextmanager
def at_most(more: int) -> Iterator[None]:
    """Lets this process take only ``more`` bytes of address space than it has."""
    with open("/proc/self/statm", encoding="ascii") as file:
        now = int(file.read().split()[0]) * resource.getpagesize()
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (now + more, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _numeric_options() -> list[tuple[str, str]]:
    """Every option of every command that takes a number."""
    from typer.main import get_command

    from waiter_cli.app import make_app

    found: list[tuple[str, str]] = []

    def walk(command: Any, path: str) -> None:
        for name, inner in getattr(command, "commands", {}).items():
            walk(inner, f"{path} {name}".strip())
        for parameter in command.params:
            if parameter.type.name.split()[0] in ("int", "float"):
                found.append((path, parameter.opts[0]))

    walk(get_command(make_app()), "")
    return found


OPTIONS = _numeric_options()


EACH_OPTION = pytest.mark.parametrize(
    ("command", "option"), OPTIONS, ids=[" ".join(o) for o in OPTIONS]
)


@EACH_OPTION
def test_a_number_of_an_option_is_a_number(command: str, option: str) -> None:
    """By default each option is given another four of what is no number."""
    first = OPTIONS.index((command, option))
    for text in (NOT_NUMBERS * 2)[4 * first % len(NOT_NUMBERS) :][:4]:
        refused_as_number(command, option, text)


@pytest.mark.slow
@EACH_OPTION
def test_every_number_of_an_option_is_a_number(command: str, option: str) -> None:
    for text in NOT_NUMBERS:
        refused_as_number(command, option, text)


def refused_as_number(command: str, option: str, text: str) -> None:
    ran = waiter(*command.split(), f"{option}={text}")
    assert ran.code == 2, (text, ran)
    assert option in ran.err and "Traceback" not in ran.err, (text, ran.err)


def test_the_table_has_the_options_that_matter() -> None:
    assert {("plan", "--time-limit"), ("simulate", "--fps"), ("layout new", "--seed")} <= set(
        OPTIONS
    )


@pytest.mark.parametrize("text", NOT_NUMBERS)
@pytest.mark.parametrize("option", ["-n", "--time-limit"])
def test_python_m_sparc_reads_numbers_as_strictly(
    option: str, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    from sparc.__main__ import main

    with pytest.raises(SystemExit) as ended:
        main(["no.sparc", f"{option}={text}" if option[1] == "-" else f"{option}{text}"])
    assert ended.value.code == 2
    assert "is not a" in capsys.readouterr().err or not text


@pytest.mark.parametrize(
    "arguments",
    [
        ["simulate", "--scenario", "b1", "--size", "640x²"],
        ["simulate", "--scenario", "b1", "--size", "1_000x640"],
        ["simulate", "--scenario", "b1", "--size", "9" * 5000 + "x640"],
        ["simulate", "--scenario", "b1", "--inject", "enter:²@1"],
        ["simulate", "--scenario", "b1", "--inject", "enter:1@nan"],
        ["simulate", "--scenario", "b1", "--inject", "enter:1@1_0"],
        ["simulate", "--scenario", "b1", "--inject", "stall:inf@1"],
        ["plan", "--layout", "report", "--enter", "²"],
        ["plan", "--layout", "report", "--enter", "nan"],
        ["serve", "--layout", "report", "--listen", "127.0.0.1:" + "9" * 5000],
        ["serve", "--layout", "report", "--listen", "127.0.0.1:+80"],
        ["serve", "--layout", "report", "--listen", "127.0.0.1:1_0"],
        ["answersets", "--scenario", "b1", "--steps", "٣.."],
        ["answersets", "--scenario", "b1", "--steps", "9" * 5000],
        ["explain", "--scenario", "b1", "--why-not", "bring_chairs(agent,table1,²)"],
    ],
    ids=lambda arguments: " ".join(arguments)[:60],
)
def test_numbers_within_options_are_read_as_strictly(arguments: list[str]) -> None:
    ran = waiter(*arguments)
    assert ran.code == 2 and "Traceback" not in ran.err, ran


@pytest.mark.parametrize(
    "number", ["nan", ".nan", "inf", ".inf", "1_0", "0x10", "1e400", "٣", '""']
)
def test_numbers_of_a_layout_are_read_as_strictly(number: str) -> None:
    text = f"nodes: {{a: [{number}, 0], b: [1, 1]}}\nedges: [[a, b]]\nentrance: a\nagent: a\n"
    ran = waiter("layout", "check", "-", stdin=text + "tables: {t: {capacity: 2, nodes: [b]}}\n")
    assert ran.code == 2 and "1:13: error" in ran.err, ran


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1_0", "0x1", "1e400"])
def test_numbers_of_lines_and_plans_are_read_as_strictly(number: str) -> None:
    ran = waiter("serve", "--layout", "report", stdin=f'{{"done": {number}}}\n')
    assert ran.code == 0 and '"error"' in ran.out.splitlines()[1], ran
    ran = waiter("validate", "--layout", "report", "-", stdin=f'{{"horizon": {number}}}\n')
    assert ran.code == 2, ran


# -- input without end ----------------------------------------------------------------------

ENDLESS = pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no endless device here")


@ENDLESS
@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom"])
@pytest.mark.parametrize(
    "arguments",
    [
        "plan --layout FILE",
        "plan --layout report --scenario FILE",
        "plan --layout report --enter 1 --domain FILE",
        "explain --scenario FILE",
        "answersets FILE",
        "sparc check FILE",
        "sparc translate FILE",
        "sparc query FILE --query p(a)",
        "validate --layout report FILE",
        "simulate --layout report --plan FILE",
        "serve --layout FILE",
        "serve --layout report --journal FILE",
        "serve --replay FILE",
        "layout check FILE",
        "layout draw FILE",
        "layout draw report --plan FILE",
        "layout convert FILE",
        "compare report FILE --scenario b1",
        "domain test FILE",
    ],
)
def test_what_has_no_end_is_refused(arguments: str, device: str) -> None:
    with at_most(1 << 29):
        ran = waiter(*arguments.replace("FILE", device).split())
    assert ran.code == 2 and ran.err, ran


@ENDLESS
def test_standard_input_without_end_is_refused() -> None:
    commands = ("plan --layout -", "answersets -", "validate --layout report -", "sparc check -")
    for command in commands:
        with open("/dev/zero", "rb") as zero, at_most(1 << 29):
            ran = waiter(*command.split(), stdin=zero)
        assert ran.code == 2 and "larger than" in ran.err, (command, ran)


@ENDLESS
@pytest.mark.parametrize("file", ["/dev/zero", "-"])
def test_python_m_sparc_refuses_what_has_no_end(
    file: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from sparc.__main__ import main

    with open("/dev/zero") as zero, at_most(1 << 29):
        monkeypatch.setattr("sys.stdin", zero)
        assert main([file]) == 2
    assert "larger than" in capsys.readouterr().err


def test_pipes_among_the_files_of_a_folder_are_no_scenarios(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.yaml")
    (tmp_path / "b.yaml").write_text("layout: report\nobserve: [{enter: [c1]}]\n")
    ran = waiter("compare", "report", "bistro", "--scenarios", str(tmp_path))
    assert ran.code == 0, ran


@pytest.mark.parametrize("kind", ["folder", "socket"])
def test_what_is_no_file_is_refused(kind: str, tmp_path: Path) -> None:
    place = str(tmp_path / "it")
    if kind == "folder":
        os.mkdir(place)
    else:
        import socket

        socket.socket(socket.AF_UNIX).bind(place)
    for command in ("plan --layout", "explain --scenario", "answersets", "validate -l report",
                    "serve --replay", "serve -l report --journal", "layout check"):  # fmt: skip
        ran = waiter(*command.split(), place)
        assert ran.code == 2 and ran.err, (command, ran)


# -- time and memory ------------------------------------------------------------------------

BINARY = Path(sys.executable).with_name("waiter")
GROWING = """\
sorts
#n = 0..400.
predicates
q(#n). p(#n, #n, #n).
rules
q(X).
p(X, Y, Z) :- q(X), q(Y), q(Z), X+Y != Z.
"""


def process(
    *command: str | Path, space: int | None = None, folder: Path | None = None
) -> subprocess.CompletedProcess[str]:
    """What a process does that may take ``space`` bytes of address space."""

    def limited() -> None:
        if space is not None:
            resource.setrlimit(resource.RLIMIT_AS, (space, space))

    return subprocess.run(
        [*map(str, command)], cwd=folder, capture_output=True, text=True, timeout=120,
        preexec_fn=limited,
    )  # fmt: skip


def chain(nodes: int) -> str:
    """A layout whose nodes stand in a row."""
    names = ", ".join(f"n{i}: [{i % 200}, {i // 200}]" for i in range(nodes))
    edges = ", ".join(f"[n{i}, n{i + 1}]" for i in range(nodes - 1))
    table = f"t1: {{capacity: 2, nodes: [n{nodes - 1}], at: [-2, -2]}}"
    return f"nodes: {{{names}}}\nedges: [{edges}]\nentrance: n0\nagent: n{nodes // 2}\ntables: {{{table}}}\n"


@pytest.mark.wide
@pytest.mark.parametrize(
    ("command", "sizes"),
    [
        ("answersets c.sparc --json", (20, 60)),
        ("sparc query c.sparc -q q(1) --json", (40,)),
        ("plan --scenario b1 --json", (17, 60)),
        ("simulate --scenario b1 --json", (50,)),
        ("explain --scenario b1 --json", (30,)),
    ],
)
def test_memory_may_end_anywhere(command: str, sizes: tuple[int, ...], tmp_path: Path) -> None:
    memory_ends(command, sizes, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "sizes"),
    [
        ("answersets c.sparc --json", (30, 100, 200)),
        ("sparc query c.sparc -q q(1) --json", (60, 200)),
        ("plan --scenario b1 --json", (30, 90)),
        ("simulate --scenario b1 --json", (90,)),
    ],
)
def test_memory_may_end_in_more_places(
    command: str, sizes: tuple[int, ...], tmp_path: Path
) -> None:
    memory_ends(command, sizes, tmp_path)


def memory_ends(command: str, sizes: tuple[int, ...], tmp_path: Path) -> None:
    (tmp_path / "c.sparc").write_text(GROWING)
    for size in sizes:
        ran = process(BINARY, *command.split(), space=size << 20, folder=tmp_path)
        assert ran.returncode == 4, (size, ran)
        assert json.loads(ran.stdout)["limit"] == "memory", (size, ran)
        assert "Traceback" not in ran.stderr, (size, ran)


def test_memory_may_end_in_python_m_sparc(tmp_path: Path) -> None:
    (tmp_path / "c.sparc").write_text(GROWING)
    for size in (20, 60):
        ran = process(sys.executable, "-m", "sparc", tmp_path / "c.sparc", space=size << 20)
        assert ran.returncode == 4 and "memory" in ran.stderr, (size, ran)
        assert "Traceback" not in ran.stderr, (size, ran)


@pytest.mark.wide
def test_the_memory_limit_is_undecided(tmp_path: Path) -> None:
    (tmp_path / "c.sparc").write_text(GROWING)
    command = "answersets c.sparc --memory-limit 80M --json"
    ran = process(BINARY, *command.split(), folder=tmp_path)
    assert ran.returncode == 4 and json.loads(ran.stdout)["limit"] == "memory", ran
    ran = process(BINARY, *["plan", "--scenario", "b1", "--memory-limit", "1K", "--json"])
    assert ran.returncode == 4 and json.loads(ran.stdout)["limit"] == "memory", ran
    ran = process(BINARY, *["plan", "--scenario", "b1", "--memory-limit", "2G", "--json"])
    assert ran.returncode == 0, ran


@pytest.mark.parametrize("size", ["0", "nan", "-1", "inf", "1_0", "", "G", "2X", "0x10M", "9" * 30])
def test_a_memory_limit_is_a_size(size: str) -> None:
    ran = waiter("plan", "--scenario", "b1", f"--memory-limit={size}")
    assert ran.code == 2 and "is no size" in ran.err, ran


@pytest.mark.wide
def test_a_signal_ends_a_command_under_a_limit(tmp_path: Path) -> None:
    (tmp_path / "c.sparc").write_text(GROWING)
    with subprocess.Popen(
        ["sh", "-c", f"ulimit -v 4000000; exec {BINARY} answersets c.sparc"], cwd=tmp_path,
        stderr=subprocess.PIPE,
    ) as running:  # fmt: skip
        time.sleep(1.0)
        running.send_signal(signal.SIGTERM)
        assert running.wait(5) == 143


@pytest.mark.wide
def test_the_time_limit_holds_while_files_are_read(tmp_path: Path) -> None:
    rules = "".join(f"p({i % 1000}):-q({i * 7 % 1000}).\n" for i in range(30_000))
    text = f"sorts\n#n = 0..1000.\npredicates\np(#n). q(#n).\nrules\n{rules}"
    (tmp_path / "r.sparc").write_text(text)
    (tmp_path / "chain.yaml").write_text(chain(2000))
    for command in (
        "answersets r.sparc --json", "sparc check r.sparc --json", "sparc translate r.sparc --json",
        "sparc query r.sparc -q p(1) --json", "plan -l chain.yaml --enter 1 --json",
        "explain -l chain.yaml --enter 1 --json", "simulate -l chain.yaml --enter 1 --json",
    ):  # fmt: skip
        ran = process(BINARY, *command.split(), "--time-limit", "0.1", folder=tmp_path)
        assert ran.returncode == 4 and json.loads(ran.stdout)["limit"] == "time", (command, ran)


@pytest.mark.slow
@pytest.mark.parametrize("limit", [1, 2, 5, 10])
def test_the_time_limit_is_hardly_passed(limit: int, tmp_path: Path) -> None:
    rules = "".join(f"p({i % 1000}):-q({i * 7 % 1000}).\n" for i in range(300_000))
    text = f"sorts\n#n = 0..1000.\npredicates\np(#n). q(#n).\nrules\n{rules}"
    (tmp_path / "r.sparc").write_text(text)
    (tmp_path / "line.sparc").write_text(text.replace(").\n", ")."))
    (tmp_path / "chain.yaml").write_text(chain(10_000))
    (tmp_path / "crowd.yaml").write_text(crowd(3000))
    for command in (
        "simulate --scenario crowd.yaml --backend geometric",
        "answersets r.sparc", "sparc check r.sparc", "sparc check line.sparc",
        "plan -l chain.yaml --enter 1",
    ):  # fmt: skip
        begun = time.monotonic()
        process(BINARY, "plan", "--scenario", "b1")
        start = time.monotonic() - begun
        begun = time.monotonic()
        ran = process(BINARY, *command.split(), "--time-limit", str(limit), folder=tmp_path)
        assert time.monotonic() - begun < start + limit + 0.5, (command, ran)


def crowd(guests: int) -> str:
    """A scenario with so many guests at the entrance."""
    waiting = ", ".join(f"[g{k}]" for k in range(guests))
    return f"layout: bistro\nstate: {{waiting: [{waiting}]}}\ngoals: [{{seated: g1}}]\n"


@pytest.mark.wide
def test_the_time_limit_holds_while_people_come_in(tmp_path: Path) -> None:
    """They take more than a minute, long before anything is searched for."""
    (tmp_path / "crowd.yaml").write_text(crowd(3000))
    command = "simulate --scenario crowd.yaml --backend geometric --time-limit 0.5 --json"
    ran = process(BINARY, *command.split(), folder=tmp_path)
    assert (ran.returncode, json.loads(ran.stdout)["limit"]) == (4, "time"), ran


@pytest.mark.wide
@pytest.mark.parametrize("whole", [False, True])
def test_a_limit_that_came_in_a_search_ends_a_run(whole: bool) -> None:
    """Whoever only asked for a plan has an answer, and goes on."""
    problem = pose_problem(read_layout(chain(30), "chain.yaml"), goals=["at: n29"])
    planner = OnlinePlanner(
        find_translator(), find_domain("restaurant"), None, limited_as_a_whole=whole
    )
    limits.begin(0.0)
    limits.settle()
    time.sleep(0.3)
    try:
        with pytest.raises(limits.OverLimit) if whole else nullcontext():
            answer = planner.plan(problem)
            time.sleep(0.4)
            assert not whole and answer.limit == "time"
    finally:
        limits.end()


TICKING = """\
import sys
from sparc import limits
limits._PERIOD = 0.0003
from waiter_cli.app import main
main(sys.argv[1:])
"""


def _ticking(*arguments: str) -> None:
    """A command whose timer ticks all the time: it ends as always, or by its limit."""
    ran = process(sys.executable, "-c", TICKING, *arguments)
    assert ran.returncode in (0, 4), (arguments, ran)
    assert not ran.stderr or "undecided" in ran.stderr, (arguments, ran)


@pytest.mark.wide
@pytest.mark.parametrize("limit", ["time", "memory", "none"])
def test_the_timer_disturbs_no_import(limit: str) -> None:
    plan = ("plan", "--scenario", "b1", "--json")
    for number in range(2):
        _ticking(*plan, *_limit(limit, number))


@pytest.mark.slow
def test_the_timer_disturbs_no_import_however_often() -> None:
    for number in range(200):
        limit = ("time", "memory", "none", "time")[number % 4]
        _ticking("plan", "--scenario", "b1", "--json", *_limit(limit, number))


def _limit(kind: str, number: int) -> tuple[str, ...]:
    """A limit that is reached somewhere on the way."""
    if kind == "time":
        return ("--time-limit", f"{0.001 + number % 40 * 0.003:.4f}")
    return ("--memory-limit", f"{20 + number % 40}M") if kind == "memory" else ()


def test_checking_many_tables_looks_at_neighbours_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.layout_tools import advice as layout_advice

    def looks(side: int) -> int:
        spots = [(i, j) for i in range(side) for j in range(side)]
        nodes = ", ".join(f"n{i}_{j}: [{3 * i + 1.5}, {3 * j + 1.5}]" for i, j in spots)
        tables = ", ".join(
            f"t{i}_{j}: {{capacity: 2, nodes: [n{i}_{j}], at: [{3 * i}, {3 * j}]}}"
            for i, j in spots
        )
        text = f"nodes: {{{nodes}}}\nedges: []\nentrance: n0_0\nagent: n0_0\ntables: {{{tables}}}\n"
        count = 0

        def counted(one: Any, other: Any, slack: float = 0.01) -> bool:
            nonlocal count
            count += 1
            return False

        monkeypatch.setattr(layout_advice, "overlap", counted)
        list(layout_advice.physical(read_layout(text, "many.yaml")))
        return count

    assert looks(16) < 6 * looks(8)


@pytest.mark.wide
@pytest.mark.parametrize("across", mostly_wide([1, 20], 20))
def test_hundreds_of_robots_are_planned_for_or_given_up_in_time(
    tmp_path: Path, across: int
) -> None:
    """More than can be searched, or nested, however they stand."""
    nodes = range(400)
    edges = [f"[n{k}, n{k + across}]" for k in nodes if k + across < 400]
    edges += [f"[n{k}, n{k + 1}]" for k in nodes if across > 1 and (k + 1) % across]
    agents = ", ".join(f"r{k}: n{k}" for k in range(1, 300))
    layout = tmp_path / "many.yaml"
    layout.write_text(
        f"nodes: [{', '.join(f'n{k}' for k in nodes)}]\nedges: [{', '.join(edges)}]\n"
        f"entrance: n0\ntables: {{t: {{capacity: 2, nodes: [n5]}}}}\nagents: {{{agents}}}\n"
    )
    since = time.monotonic()
    goal = ("--goal", "at: {r1: n390, r299: n399}", "--time-limit", "2")
    # In a process of its own: a grounding that was given up takes memory until the process ends.
    ran = waiter_process("plan", "-l", str(layout), *goal, "--json")
    assert ran.code in (0, 4), ran.err
    assert ran.json()["status"] in ("plan", "undecided")
    assert time.monotonic() - since < 20
