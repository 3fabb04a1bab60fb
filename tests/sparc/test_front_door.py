"""The front door: `import sparc` and `python -m sparc`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import sparc
from sparc.__main__ import main

CHOICE = "sorts #n = 1..3. predicates p(#n). rules 1{p(X)}2. "


def run(*arguments: str, text: str | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], input=text, capture_output=True, text=True, check=False
    )


def test_importing_loads_nothing() -> None:
    code = "import sys, sparc; print([m for m in sys.modules if m.startswith('sparc.') or m == 'clingo'])"
    assert run("-c", code).stdout.strip() == "[]"


def test_translating_does_not_load_clingo() -> None:
    code = f"import sys, sparc; sparc.to_asp({CHOICE!r}); print('clingo' in sys.modules)"
    assert run("-c", code).stdout.strip() == "False"


def test_functions_stay_functions_when_their_modules_are_loaded() -> None:
    code = (
        "import sparc; from sparc import checking, solving, translation; "
        "import sparc.checking.checker, sparc.translation.translator, sparc.solving.query; "
        "print(callable(sparc.check), callable(sparc.translate), callable(sparc.query))"
    )
    assert run("-c", code).stdout.strip() == "True True True"


def test_every_name_of_the_front_door_is_there() -> None:
    assert [name for name in sparc.__all__ if getattr(sparc, name) is None] == []


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="nothing"):
        sparc.nothing  # noqa: B018


def test_stages_can_be_entered_anywhere() -> None:
    program = sparc.parse(CHOICE)
    typed = sparc.check(program)
    for stage in (CHOICE, sparc.Source("x", CHOICE), program, typed):
        assert sum(1 for _ in sparc.solve(stage)) == 6
        assert "p(X)" in sparc.to_asp(stage).text


def test_answer_sets_come_as_they_are_found() -> None:
    """The first of 2^100 answer sets comes at once."""
    text = "sorts #n = 1..100. predicates p(#n). rules {p(X)}. "
    answers = sparc.solve(text)
    assert next(answers) is not None
    assert answers.satisfiable and not answers.complete


@pytest.mark.parametrize(
    ("models", "seen", "complete"), [(0, 6, True), (2, 2, False), (6, 6, True), (9, 6, True)]
)
def test_models(models: int, seen: int, complete: bool) -> None:
    answers = sparc.solve(CHOICE, models=models)
    assert len(list(answers)) == seen
    assert answers.satisfiable
    assert answers.complete is complete


def test_models_count_what_is_shown() -> None:
    text = "sorts #n = 1..8. predicates p(#n). q(). rules {p(X)}. {q}. display\nq."
    assert len(list(sparc.solve(text, models=5))) == 2


def test_inconsistency() -> None:
    answers = sparc.solve("predicates p(). rules p. :- p. ")
    assert list(answers) == []
    assert answers.satisfiable is False and answers.complete


def test_a_time_limit_leaves_it_undecided() -> None:
    """Eleven pigeons in ten holes cannot be decided in a tenth of a second."""
    text = (
        "sorts #p = 1..13. #h = 1..12. predicates at(#p,#h). rules\n"
        "1{at(P,H)}1 :- #p(P). :- at(P,H), at(Q,H), P < Q. "
    )
    start = time.monotonic()
    answers = sparc.solve(text, time_limit=0.3)
    assert list(answers) == []
    assert answers.satisfiable is None and not answers.complete
    assert time.monotonic() - start < 5


def test_costs_come_with_optimal_sets() -> None:
    text = "sorts #n = 1..3. predicates p(#n). rules 1{p(X)}1. #minimize{X : p(X)}. "
    (answer,) = sparc.solve(text)
    assert answer.cost == (1,)


def test_that_no_smaller_support_exists_is_proved_from_below() -> None:
    """Forty pairs, one of each has to be given: a search from above tries all of them."""
    text = (
        "sorts #n = 1..40. predicates p(#n). q(#n). rules\n"
        "p(X) :+ . q(X) :+ . :- not p(X), not q(X). "
    )
    answers = sparc.solve(text, models=1, time_limit=20)
    (answer,) = answers
    assert answer.cost == (40,)
    assert len(answer.literals) == 40


def write(tmp_path: Path, text: str) -> str:
    path = tmp_path / "program.sparc"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_main_prints_answer_sets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([write(tmp_path, CHOICE + "\n:- p(1).\n:- p(2).")]) == 0
    assert capsys.readouterr().out == "{p(3)}\n"


def test_main_reports_inconsistency(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([write(tmp_path, "predicates p().\nrules\n:- not p.\n")]) == 3
    assert "inconsistent" in capsys.readouterr().err


def test_main_reports_all_faults(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    name = write(tmp_path, "sorts #s = {a}.\npredicates p(#s).\nrules\np(b).\nq(a).\n")
    assert main([name]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert f"{name}:4:1: error: b is not in sort #s" in captured.err
    assert f"{name}:5:1: error: unknown predicate q/1" in captured.err


@pytest.mark.parametrize("stage", ["tokens", "sparc", "ast", "sorts", "asp"])
def test_main_shows_stages(stage: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([write(tmp_path, CHOICE), "--show", stage]) == 0
    assert "n" in capsys.readouterr().out


def test_main_asks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([write(tmp_path, CHOICE), "--query", "p(X)"]) == 0
    assert capsys.readouterr().out == "unknown\n"


@pytest.mark.parametrize("content", [b"\xff\xfe", None])
def test_main_reports_files_it_cannot_read(
    content: bytes | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "x.sparc"
    if content is not None:
        path.write_bytes(content)
    assert main([str(path)]) == 2
    assert "x.sparc" in capsys.readouterr().err


def test_module_reads_standard_input() -> None:
    done = run("-m", "sparc", "-", "-n", "1", text=CHOICE)
    assert done.returncode == 0 and done.stdout.startswith("{p(")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is full")
@pytest.mark.parametrize(
    ("stream", "message"),
    [(">/dev/full", "cannot write the output: no space"), (">&-", "standard output is closed")],
)
def test_answer_sets_that_cannot_be_printed(stream: str, message: str) -> None:
    line = f'echo "sorts #s = {{a}}. predicates p(#s). rules p(a)." | "$0" -m sparc - {stream}'
    done = subprocess.run(
        ["sh", "-c", line, sys.executable], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr and "Traceback" not in done.stderr


@pytest.mark.skipif(os.name != "posix", reason="streams as POSIX has them")
@pytest.mark.parametrize(
    ("rules", "status", "out"), [("p(a).", 0, "{p(a)}\n"), ("p(a). :- p(a).", 3, ""), ("p(", 2, "")]
)
def test_without_a_stream_for_faults(rules: str, status: int, out: str) -> None:
    line = f'echo "sorts #s = {{a}}. predicates p(#s). rules {rules}" | "$0" -m sparc - 2>&-'
    command = ["sh", "-c", line, sys.executable]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stdout) == (status, out)


@pytest.mark.skipif(os.name != "posix", reason="signals and pipes as POSIX has them")
@pytest.mark.parametrize(("end", "status"), [("close", 0), ("interrupt", 130)])
def test_a_listing_that_is_cut_short_ends_quietly(end: str, status: int) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "sparc", "-"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdin and process.stdout and process.stderr
    process.stdin.write("sorts #n = 1..30. predicates p(#n). rules p(X) | -p(X) :- #n(X).")
    process.stdin.close()
    assert process.stdout.readline().startswith("{")
    if end == "interrupt":
        process.send_signal(signal.SIGINT)
        process.stdout.read()
    process.stdout.close()
    assert (process.wait(60), process.stderr.read()) == (status, "")


def test_the_time_limit_holds_while_clingo_prepares_the_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from sparc.solving import clingo_solver as native

    ends = threading.Event()
    begin = native.clingo.Control.solve

    def slowly(self: Any, *args: Any, **more: Any) -> Any:
        ends.wait(60)
        return begin(self, *args, **more)

    monkeypatch.setattr(native.clingo.Control, "solve", slowly)
    answers = sparc.solve(sparc.check(sparc.parse("predicates p(). rules p.")), time_limit=0.2)
    assert list(answers) == []
    assert (answers.satisfiable, answers.complete) == (None, False)
    ends.set()


def test_a_program_whose_search_was_abandoned_is_not_asked_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """clingo takes the process down when a second search begins, or the first is left open."""
    from sparc.solving import clingo_solver as native

    begin = native.clingo.Control.solve
    go_on, begun, closed = threading.Event(), [], threading.Event()

    class Handle:
        def __init__(self, handle: Any) -> None:
            self.handle = handle

        def cancel(self) -> None:
            self.handle.cancel()

        def __enter__(self) -> Any:
            return self.handle.__enter__()

        def __exit__(self, *ended: Any) -> Any:
            self.handle.__exit__(*ended)
            closed.set()

    def slowly(self: Any, *args: Any, **more: Any) -> Any:
        begun.append(self)
        go_on.wait(60)
        return Handle(begin(self, *args, **more))

    monkeypatch.setattr(native.clingo.Control, "solve", slowly)
    grounding = native.Grounding(sparc.to_asp("predicates p(). rules p."))
    grounding.ground()
    for _ in range(2):
        assert list(grounding.models(deadline=time.monotonic() + 0.1)) == []
        assert grounding.outcome.satisfiability is native.Satisfiability.UNKNOWN
    assert len(begun) == 1
    go_on.set()
    assert closed.wait(60)
