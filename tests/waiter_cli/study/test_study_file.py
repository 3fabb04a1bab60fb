"""A study's file: what it means, and what is wrong with it, each fault at its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.paths import ROOT
from tests.support.studies import QUICK
from waiter_cli.errors import LayoutError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.study.studies import runs_of
from waiter_cli.study.study_file import MOST_RUNS, read_study, read_study_file

EVENINGS = "evenings: {scenario: quick.yaml, seeds: 1..3}\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "quick.yaml").write_text(QUICK)
    (tmp_path / "mine.yaml").write_text(
        "{name: mine, nodes: [a, b, c], edges: [[a, b], [b, c]], entrance: a, agent: b,"
        " tables: {t: {capacity: 4, nodes: [c]}}}"
    )
    (tmp_path / "copy.yaml").write_text((tmp_path / "mine.yaml").read_text())
    (tmp_path / "comment.yaml").write_text("# hm\n" + (tmp_path / "mine.yaml").read_text())
    (tmp_path / "plain.yaml").write_text("{observe: [{enter: [c1]}]}")
    (tmp_path / "other.yaml").write_text("{state: {agent: n4}, minutes: 3}")
    return tmp_path


def test_the_whole_product_evening_by_evening(folder: Path) -> None:
    study = read_study(
        "name: a\nlayouts: [report, {generate: {tables: 3, nodes: 12, bar: yes, seeds: [1, 4..5]}}]\n"
        f"vary: {{agents: [1, 2], speed: [0.6, 0.8]}}\n{EVENINGS}",
        "a.yaml", str(folder),
    )  # fmt: skip
    assert (study.name, study.size, study.varied) == ("a", 48, ("layout", "agents", "speed"))
    runs = list(runs_of(study, "1"))
    assert len({run.key for run in runs}) == len(runs) == 48
    assert [run.number for run in runs] == list(range(1, 49))
    assert [run.seed for run in runs] == [seed for seed in (1, 2, 3) for _ in range(16)]
    labels = ["report", "generated_1", "generated_4", "generated_5"]
    assert [run.layout.label for run in runs[:16:4]] == labels
    assert [(run.layout.agents, run.speed) for run in runs[:4]] == [
        (1, 0.6), (1, 0.8), (2, 0.6), (2, 0.8),
    ]  # fmt: skip
    two = read_layout(runs[2].layout.text, "two")
    assert [name for name, _ in two.agents] == ["r1", "r2"]


def test_a_key_changes_with_all_that_decides_a_run(folder: Path) -> None:
    def key(text: str, version: str = "1") -> str:
        return next(runs_of(read_study(text, "a.yaml", str(folder)), version)).key

    one = f"layouts: [report]\n{EVENINGS}"
    first = key(one)
    assert first == key("name: another\n" + one)
    others = {
        key(one, "2"),
        key(one.replace("report", "mine.yaml")),
        key(one.replace("1..3", "2..3")),
        key(one + "vary: {speed: 0.5}\n"),
        key(one + "vary: {agents: 1}\n"),
    }
    (folder / "quick.yaml").write_text(QUICK + "# changed\n")
    others.add(key(one))
    assert len(others) == 6 and first not in others


FAULTS = {
    "": ["a.yaml:1:1: the file is empty"],
    "layouts: [report]\n": ["a.yaml:1:1: a study without evenings"],
    EVENINGS: ["a.yaml:1:1: a study without layouts"],
    f"layouts: [mine.yaml, copy.yaml]\n{EVENINGS}": [
        "a.yaml:1:22: layout copy.yaml is the same as mine.yaml"
    ],
    f"layouts: [mine.yaml, comment.yaml]\nvary: {{agents: [1, 2]}}\n{EVENINGS}": [
        "a.yaml:1:22: layout comment.yaml is the same as mine.yaml"
    ],
    "- report\n": ["a.yaml:1:1: a study must be a mapping (key: value), found a list of 1 item"],
    "layouts: [report]\nevenings: quick.yaml\n": [
        "a.yaml:2:11: evenings must be a mapping (key: value), found quick.yaml; write evenings: {"
    ],
    f"layouts: [report]\nvary: [1, 2]\n{EVENINGS}": [
        "a.yaml:2:7: vary must be a mapping (key: value), found a list of 2 items; write vary: {"
    ],
    f"layouts: [report]\nvary: {{agents: two}}\n{EVENINGS}": [
        "a.yaml:2:16: agents must be a whole number or a range, found two; write [1, 2]"
    ],
    f"layout: [report]\n{EVENINGS}": ["a.yaml:1:1: unknown key layout"],
    f"layouts: [{{generate: {{name: 'a b'}}}}]\n{EVENINGS}": [
        "a.yaml:1:29: a b is no name for a layout; write"
    ],
    f"layouts: []\n{EVENINGS}": ["a.yaml:1:10: layouts is empty"],
    f"layouts: [reprot]\n{EVENINGS}": ["a.yaml:1:11: there is no layout reprot"],
    f"layouts: [report, report]\n{EVENINGS}": ["a.yaml:1:19: layout report is listed twice"],
    f"layouts: [quick.yaml]\n{EVENINGS}": ["a.yaml:1:11: quick.yaml is a scenario, not a layout"],
    f"layouts: [{{generate: {{tables: 9, nodes: 3}}}}]\n{EVENINGS}": [
        "a.yaml:1:11: 9 tables cannot be laid out with 3 nodes"
    ],
    f"layouts: [{{generate: {{tabels: 9}}}}]\n{EVENINGS}": ["a.yaml:1:23: unknown key tabels"],
    f"layouts: [{{genrate: {{}}}}]\n{EVENINGS}": ["a.yaml:1:12: unknown key genrate"],
    f"layouts: [report]\nvary: {{speed: fast}}\n{EVENINGS}": ["a.yaml:2:15: speed must be"],
    f"layouts: [report]\nvary: {{speed: [1, 1]}}\n{EVENINGS}": ["a.yaml:2:19: speed: 1.0 is given"],
    f"layouts: [report]\nvary: {{agents: 0}}\n{EVENINGS}": ["a.yaml:2:16: agents must be"],
    f"layouts: [mine.yaml]\nvary: {{agents: 3}}\n{EVENINGS}": [
        "a.yaml:2:7: mine.yaml: there are places for 2 robots, not for 3"
    ],
    f"layouts: [report]\nvary: {{color: red}}\n{EVENINGS}": ["a.yaml:2:8: unknown key color"],
    "layouts: [report]\nevenings: {scenario: quick.yaml}\n": [
        "a.yaml:2:11: evenings without seeds"
    ],
    "layouts: [report]\nevenings: {seeds: 3..1}\n": [
        "a.yaml:2:11: evenings of no scenario", "a.yaml:2:19: seeds ends before it begins",
    ],
    "layouts: [report]\nevenings: {scenario: quick.yaml, seeds: 1-3}\n": [
        "a.yaml:2:41: seeds must be a whole number or a range"
    ],
    "layouts: [report]\nevenings: {scenario: plain.yaml, seeds: 1}\n": [
        "a.yaml:2:22: plain.yaml has no guests who come by chance"
    ],
    "layouts: [report, mine.yaml]\nevenings: {scenario: other.yaml, seeds: 1}\n": [
        "other.yaml:1:17: unknown node n4", "other.yaml:1:31: minutes without guests",
    ],
    f"layouts: [report]\nevenings: {{scenario: quick.yaml, seeds: 0..{MOST_RUNS}}}\n": [
        "a.yaml:2:41: seeds has 1000001 numbers"
    ],
    f"layouts: [report]\nvary: {{speed: [1, 2]}}\nevenings: {{scenario: quick.yaml, seeds: 1..{MOST_RUNS}}}\n": [
        "a.yaml:1:1: the study has 2000000 runs"
    ],
}  # fmt: skip


@pytest.mark.parametrize("text", FAULTS, ids=lambda text: text.replace("\n", "|")[:60])
def test_a_fault_stands_at_its_place(
    text: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    with pytest.raises(LayoutError) as caught:
        read_study(text, "a.yaml", None)
    told = [str(fault) for fault in caught.value.faults]
    assert len(told) == len(FAULTS[text])
    for fault, beginning in zip(told, FAULTS[text]):
        assert fault.startswith(beginning)
        assert "; " in fault or "is a scenario" in fault, "it says the mend"


def test_a_misspelt_study_is_no_scenario(folder: Path) -> None:
    (folder / "a.yaml").write_text(f"layout: [report]\n{EVENINGS}")
    with pytest.raises(LayoutError, match="unknown key layout in a study; did you mean layouts"):
        read_study_file(str(folder / "a.yaml"))


def test_what_is_no_study_is_called_what_it_is(folder: Path) -> None:
    with pytest.raises(LayoutError, match="this is a layout, not a study"):
        read_study_file(str(folder / "mine.yaml"))
    with pytest.raises(LayoutError, match="there is no study nowhere; give the path of a file"):
        read_study_file("nowhere")


def test_the_examples_are_read() -> None:
    two = read_study_file(str(ROOT / "examples" / "one-robot-or-two" / "study.yaml"))
    assert (two.name, two.size, two.varied) == ("one-robot-or-two", 48, ("agents",))
    study = read_study_file(str(ROOT / "examples" / "does-speed-pay" / "study.yaml"))
    assert (study.name, study.size, study.varied) == ("does-speed-pay", 72, ("layout", "speed"))
