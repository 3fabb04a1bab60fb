"""``waiter plan``, from the front door: what is printed, the JSON, and the exit codes."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.planning import SCENES
from tests.support.sampling import mostly_wide


def test_the_first_line_of_the_readme() -> None:
    ran = waiter("plan", "--layout", "report", "--enter", "1")
    assert ran.code == 0
    assert "seat(agent,c1,table1)" in ran.out
    assert "walk from n1 to n2" in ran.out
    assert "7 steps" in ran.out and "Minimal" in ran.out
    assert max(map(len, ran.out.splitlines()[:-1])) < 80


@pytest.mark.parametrize(("name", "steps"), SCENES.items())
def test_json_has_the_shape_of_the_contract(name: str, steps: int) -> None:
    document = waiter("plan", "--scenario", name, "--json").json()
    assert document["status"] == "plan"
    assert document["layout"] == "report"
    assert (document["horizon"], document["minimal"], document["bounds"]) == (
        steps,
        True,
        [steps, steps],
    )
    assert [action["step"] for action in document["actions"]] == list(range(steps))
    for action in document["actions"]:
        assert action["text"] == f"{action['name']}({','.join(map(str, action['args']))})"
    assert document["search"]["strategy"] == "binary"
    assert document["search"]["proof"] in ("unsat", "bound")
    assert {"horizon", "result", "seconds"} == set(document["search"]["horizons"][0])
    assert document["translator"] == "native"
    assert document["validated"] is True


def test_the_scenes_chain(tmp_path: Path) -> None:
    """The final state of one scene is the state of the next: 7, 4, 1 and 1 steps again."""
    import yaml

    news = [
        {"enter": ["c1"]},
        {"enter": ["c2", "c3", "c4", "c5"]},
        {"bill": "table1"},
        {"bill": "table2"},
    ]
    state: dict = {}
    lengths = []
    for number, observation in enumerate(news):
        file = tmp_path / f"scene{number}.yaml"
        file.write_text(
            yaml.safe_dump({"layout": "report", "state": state, "observe": [observation]})
        )
        document = waiter("plan", "--scenario", file, "--json").json()
        lengths.append(document["horizon"])
        state = document["final_state"]
    assert lengths == [7, 4, 1, 1]
    assert state["paid"] == ["table1", "table2"]


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--scenario", "too_big"], "party of 6"),
        (["--scenario", "blocked_aisle"], "where w1 stands"),
        (["--scenario", "unwanted_bill"], "nobody can sit at table2"),
        (["--layout", "walled_off", "--enter", "2"], "no path of edges leads"),
    ],
)
def test_what_is_impossible_is_proved_and_explained(arguments: list[str], reason: str) -> None:
    ran = waiter("plan", *arguments)
    assert ran.code == 3
    assert reason in ran.out
    document = waiter("plan", *arguments, "--json").json()
    assert document["status"] == "no_plan"
    first = document["reasons"][0]
    assert reason in " ".join(r["message"] for r in document["reasons"])
    assert first["file"].endswith(".yaml") and first["line"] > 0 and first["column"] > 0


def test_a_contradiction_is_neither_a_plan_nor_an_error() -> None:
    ran = waiter("plan", "--layout", "report", "--goal", "at: n1", "--json")
    assert ran.json()["horizon"] == 0
    import yaml

    text = yaml.safe_dump({"layout": "report", "observe": [{"at": {"w1": "n1"}}]})
    ran = waiter("plan", "--scenario", "-", "--json", stdin=text)
    assert ran.code == 3
    assert ran.json()["status"] == "contradiction"
    assert ran.json()["reasons"]


def test_a_surprise_is_said_to_have_come_about_somehow() -> None:
    text = (
        "{layout: report, state: {waiters: {w1: n7}}, observe: [{at: {w1: n4}}], goals: [{at: n3}]}"
    )
    ran = waiter("plan", "--scenario", "-", "--json", stdin=text)
    (explanation,) = ran.json()["diagnosis"]
    (event,) = explanation["events"]
    assert (ran.code, event["name"], event["args"]) == (0, "walks", ["w1", "n4"])
    assert (
        "may have come about so:\n  w1 walked from n7 to n4"
        in waiter("plan", "--scenario", "-", stdin=text).out
    )
    expected = text.replace("{at: {w1: n4}}", "{at: {w1: n7}}")
    assert "diagnosis" not in waiter("plan", "--scenario", "-", "--json", stdin=expected).json()


def test_text_and_a_document_exclude_each_other() -> None:
    ran = waiter("plan", "--scenario", "b1", "--show", "asp", "--json")
    assert (ran.code, ran.json()["status"]) == (2, "error")


def test_limits_are_told_apart() -> None:
    ran = waiter("plan", "--scenario", "b1", "--max-steps", "3", "--json")
    assert ran.code == 4
    document = ran.json()
    assert (document["status"], document["limit"], document["minimal"]) == (
        "undecided",
        "max_steps",
        False,
    )
    ran = waiter("plan", "--scenario", "lunch", "--time-limit", "0", "--search", "linear", "--json")
    assert ran.code == 4
    assert ran.json()["limit"] == "time"


@pytest.mark.parametrize(
    ("arguments", "file", "hint"),
    [
        (["--layout", "reprt"], "--layout", "report"),
        (["--layout", "report", "--bill", "tabel1"], "--bill", "table1"),
        (["--layout", "report", "--goal", "seated: [c9"], "--goal", ""),
        (["--layout", "report", "--domain", "nosuch"], "--domain", "restaurant"),
        ([], None, "--layout"),
    ],
)
def test_wrong_input_is_told_with_its_mend(
    arguments: list[str], file: str | None, hint: str
) -> None:
    ran = waiter("plan", *arguments)
    assert ran.code == 2
    assert ran.out == ""
    assert "Traceback" not in ran.err
    document = waiter("plan", *arguments, "--json")
    assert document.code == 2
    error = document.json()["errors"][0]
    assert error["file"] == file
    assert hint in (error["hint"] or "")


@pytest.mark.parametrize("stage", ["sparc", "asp", "tokens", "ast", "sorts"])
def test_a_stage_is_shown_as_text(stage: str) -> None:
    ran = waiter("plan", "--scenario", "b1", "--show", stage, "--horizon", "3")
    assert ran.code == 0
    assert len(ran.out) > 500


def test_verbose_tells_the_stages_on_stderr() -> None:
    ran = waiter("plan", "--scenario", "b2", "-v")
    assert "translate" in ran.err and "ground" in ran.err
    assert "translate" not in ran.out


def test_a_domain_of_ones_own_is_searched_by_its_program_alone(tmp_path: Path) -> None:
    """Nothing but the program is known of it: no bounds, no static test; it plays the plan itself."""
    from waiter_cli.encoding.domains import find_domain

    own = tmp_path / "own.sparc"
    own.write_text(find_domain("restaurant").template.text)
    document = waiter("plan", "--scenario", "b2", "--domain", own, "--json").json()
    assert (document["horizon"], document["validated"]) == (4, "domain")
    found = {p["horizon"]: p["result"] for p in document["search"]["horizons"]}
    assert (found[3], found[4], document["minimal"]) == ("unsat", "sat", True)
    ran = waiter("plan", "--scenario", "too_big", "--domain", own, "--max-steps", "9", "--json")
    assert (ran.code, ran.json()["status"]) == (3, "no_plan")
    (reason,) = ran.json()["reasons"]
    assert "nothing that can come about" in reason["message"] and reason["line"] == 9
    limits = ("--search", "linear", "--max-steps", "1", "--json")
    ran = waiter("plan", "--scenario", "b2", "--domain", own, *limits)
    assert (ran.code, ran.json()["limit"]) == (4, "max_steps")


@pytest.mark.parametrize(
    ("old", "form"),
    [("occurs(", "occurs(#action, #step)"), ("goal(", "goal(#step)")],
)
def test_a_program_without_plans_is_no_domain(old: str, form: str, tmp_path: Path) -> None:
    from waiter_cli.encoding.domains import find_domain

    own = tmp_path / "own.sparc"
    text = find_domain("restaurant").template.text
    own.write_text(text.replace(f" {old}", f" x{old}").replace(f"\n{old}", f"\nx{old}"))
    for command in (("plan",), ("explain",), ("answersets",), ("simulate",)):
        ran = waiter(*command, "--scenario", "b2", "--domain", own)
        assert ran.code == 2, command
        assert f"error: no plans in this program: it has no predicate {form}\n" in ran.err


def test_no_plan_points_to_the_explanation_where_no_file_can_be_named(tmp_path: Path) -> None:
    layout = tmp_path / "line.yaml"
    layout.write_text(
        "nodes: {a: [0, 0], b: [2, 0], c: [4, 0]}\nedges: [[a, b], [b, c]]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 1, nodes: [c]}}\nwaiters: {w: c}\ntimetable: {w: {1: b}}\n"
    )
    ran = waiter("plan", "--layout", layout, "--goal", "at: c")
    assert ran.code == 3
    pointer = "waiter explain, with the same options, says what it takes together"
    assert (pointer in ran.out) == (".yaml:" not in ran.out)


def test_actions_that_the_restaurant_does_not_know_have_words_and_places(
    tmp_path: Path,
) -> None:
    from waiter_cli.encoding.domains import find_domain

    own = tmp_path / "own.sparc"
    own.write_text(find_domain("restaurant").template.text.replace("go_to", "walk_to"))
    ran = waiter("plan", "--scenario", "b2", "--domain", own)
    heading, first = ran.out.splitlines()[:2]
    assert heading.split() == ["step", "action", "in", "words", "at"]
    assert re.fullmatch(r"   0  walk_to\(agent,n\d\) +walk to n\d +n\d", first)


def test_a_fault_of_ones_own_domain_is_placed(tmp_path: Path) -> None:
    from waiter_cli.encoding.domains import find_domain

    text = find_domain("restaurant").template.text.replace(
        "near(#table, #step).", "near(#tabel, #step)."
    )
    own = tmp_path / "own.sparc"
    own.write_text(text)
    ran = waiter("plan", "--scenario", "b1", "--domain", own)
    assert ran.code == 2
    line = text.splitlines().index(next(x for x in text.splitlines() if "#tabel," in x)) + 1
    assert f"{own}:{line}:6: error:" in ran.err
    assert "did you mean #table" in ran.err


def _start(*arguments: str, stdout: int = subprocess.PIPE) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "waiter_cli", *arguments],
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.getcwd()},
    )


HARD = ["plan", "--layout", "report_large", "--enter", "4", "--enter", "4", "--enter", "2", "--domain", "report", "--search", "linear"]  # fmt: skip


@pytest.mark.parametrize("sent", mostly_wide([signal.SIGINT, signal.SIGTERM], signal.SIGTERM))
def test_a_signal_ends_it_soon(sent: signal.Signals) -> None:
    process = _start(*HARD)
    time.sleep(1.5)
    assert process.poll() is None
    start = time.monotonic()
    process.send_signal(sent)
    _, err = process.communicate(timeout=10)
    assert time.monotonic() - start < 5.0  # a second where nothing else runs
    assert process.returncode == 128 + sent
    assert "Traceback" not in err


def test_a_closed_pipe_is_quiet() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    process = _start("plan", "--scenario", "b1", "--json", stdout=writer)
    os.close(writer)
    _, err = process.communicate(timeout=20)
    assert err == ""


def test_version_is_answered_without_typer() -> None:
    code = (
        "import sys\nfrom waiter_cli.app import main\n"
        "try: main(['--version'])\nexcept SystemExit as e: assert e.code == 0\n"
        "assert not {'typer', 'clingo', 'yaml', 'rich'} & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert json.dumps(done.stdout).startswith('"waiter ')


def test_help_needs_none_of_the_heavy_imports() -> None:
    code = (
        "import sys\nfrom waiter_cli.app import run\nassert run(['--help']) == 0\n"
        "assert not {'clingo', 'yaml', 'rich', 'numpy', 'pybullet', 'PIL'} & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_search_is_not_disturbed_by_another_in_the_same_folder(tmp_path: Path) -> None:
    running = [_start("plan", "--scenario", name, "--json") for name in ("b1", "b2", "b3", "b4")]
    horizons = [json.loads(process.communicate(timeout=60)[0])["horizon"] for process in running]
    assert horizons == [7, 4, 1, 1]


def test_watch_plans_again_when_a_file_changes(tmp_path: Path) -> None:
    """A fault in between is shown, and watching goes on."""
    from waiter_cli.file_access.locate import data_folder

    layout = tmp_path / "l.yaml"
    text = Path(data_folder("layouts"), "report.yaml").read_text()

    def save(text: str) -> None:
        """Whole at once, as editors do: half a file would be a change of its own."""
        (tmp_path / "new").write_text(text)
        os.replace(tmp_path / "new", layout)

    save(text)
    process = _start("plan", "--layout", str(layout), "--enter", "1", "--json", "--watch")
    assert process.stdout is not None
    assert json.loads(process.stdout.readline())["horizon"] == 7
    save("name: [")
    assert json.loads(process.stdout.readline())["status"] == "error"
    save(text.replace("agent: n1", "agent: n2"))
    assert json.loads(process.stdout.readline())["horizon"] == 6
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=10)
    assert process.returncode == 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--scenario", "b2", "--bill", "table1"), "the bill of table1"),
        (("--scenario", "b1", "--enter", "2"), "the party of c2"),
        (("--layout", "report", "--enter", "1", "--goal", "at: n6"), "the party of c1"),
        (("--scenario", "b2", "--bill", "table1", "--goal", "paid: table1"), None),
        (("--layout", "report", "--enter", "1"), None),
    ],
)
def test_what_is_seen_and_not_wanted_is_said(arguments: tuple[str, ...], said: str | None) -> None:
    ran = waiter("plan", *arguments)
    assert ran.code == 0
    assert (said in ran.err and "add a --goal" in ran.err) if said else not ran.err


def test_a_layout_given_as_a_scenario_is_recognized(tmp_path: Path) -> None:
    path = tmp_path / "hall.yaml"
    path.write_text(waiter("layout", "new", "--tables", "2", "--nodes", "6").out)
    ran = waiter("plan", "--scenario", str(path))
    assert ran.code == 2 and "this is a layout: give it with --layout" in ran.err


def test_a_long_line_is_shown_about_its_fault() -> None:
    goal = "{seated: [c1], " + "x: 1, " * 400 + "}"
    ran = waiter("plan", "--layout", "-", stdin="name: a\nnodes: " + goal + "\n")
    assert ran.code == 2
    assert max(map(len, ran.err.splitlines())) < 200
