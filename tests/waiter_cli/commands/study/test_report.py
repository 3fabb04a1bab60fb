"""``waiter study report``: prose first, a page that needs nothing else, evenings that play again."""

from __future__ import annotations

import re
import shlex
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.helps import run_line
from tests.support.studies import table, write_study
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.study.store import Store
from waiter_cli.study.studies import RunResult, runs_of
from waiter_cli.study.study_file import read_study_file

pytest.importorskip("numpy")


def invented(folder: Path, name: str = "invented") -> str:
    """A store of 20 evenings in which a second robot saves one or two parties; one run failed."""
    study = write_study(folder, "1..20", "agents: [1, 2]")
    study.write_text(study.read_text().replace("name: quick", f"name: {name}"))
    read = read_study_file(str(study))
    path = str(folder / "s.db")
    with Store(path, writing=True) as store:
        store.plan(read, "1")
        for run in runs_of(read, "1"):
            lost = 5 + run.seed % 7 - (0 if run.layout.agents == 1 else 1 + run.seed % 2)
            figures: dict[str, float] = dict.fromkeys(FIGURES, 1)
            figures |= {"lost": lost, "lost_unseated": lost, "wait_seat_mean": 60.0 * lost}
            if run.seed == 20 and run.layout.agents == 2:
                store.record(run, RunResult(run.key, "failed", "so it goes"))
            else:
                store.record(run, RunResult(run.key, "done", None, figures, 1.0))
    return path


def test_prose_comes_first(tmp_path: Path) -> None:
    ran = waiter("study", "report", invented(tmp_path))
    assert ran.code == 0 and not ran.err
    first, second, *rest = ran.out.splitlines()
    assert first == "invented: 39 of 40 runs on 20 evenings."
    begin = "- With a second robot 1.5 parties fewer leave unseated an evening (1.3 to 1."
    assert second.startswith(begin)
    assert "- 1 evening is left out of this: a run of the pair is not done." in rest
    assert "- 1 run is not done and left out; waiter study show says why." in rest
    assert any(line.startswith("- For comparison, 1 robot: of 1.0 parties") for line in rest)


def test_the_document(tmp_path: Path) -> None:
    found = waiter("study", "report", invented(tmp_path), "--json").json()
    (comparison,) = found["comparisons"]
    lost = next(each for each in comparison["differences"] if each["figure"] == "lost_unseated")
    assert lost["verdict"] == "less" and lost["low"] < lost["mean"] < lost["high"] < 0
    assert lost["sentence"] == found["sentences"][0]
    assert len(found["worst"]) == 10
    assert [one["lost"] for one in found["worst"]] == sorted(
        (one["lost"] for one in found["worst"]), reverse=True
    )


class Page(HTMLParser):
    """What a page would load, run, or leave open."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.open: list[str] = []
        self.ids: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "br", "img", "link", "input"):
            self.open.append(tag)
        self.ids += [value or "" for name, value in attributes if name == "id"]
        self.loaded += [
            f"{tag} {name}={value}"
            for name, value in attributes
            if name in ("src", "href", "xlink:href") and not (value or "").startswith("#")
        ]
        if tag in ("script", "link", "iframe", "object"):
            self.loaded.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_the_page_needs_nothing_else(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    store, path = invented(tmp_path, "'a <b>bold</b> & name'"), tmp_path / "r.html"
    ran = waiter("study", "report", store, "-o", str(path))
    assert (ran.code, ran.err) == (0, f"wrote {path}\n")
    text = path.read_text()
    page = Page(text)
    assert page.loaded == [] and page.open == []
    assert len(page.ids) == len(set(page.ids))
    assert "<title>a &lt;b&gt;bold&lt;/b&gt; &amp; name</title>" in text
    assert text.count("<svg") == 4 and "fewer leave unseated" in text
    assert "url(http" not in text and "@import" not in text and str(tmp_path) in text
    waiter("study", "report", store, "-o", str(path))
    assert path.read_text() == text, "equal stores give equal pages"


def test_pictures_have_the_colours_of_the_page(tmp_path: Path) -> None:
    """Dark where the reader's system is: text and axes are those of the page, grounds are clear."""
    pytest.importorskip("matplotlib")
    store, path = invented(tmp_path), tmp_path / "r.html"
    waiter("study", "report", store, "-o", str(path))
    text = path.read_text()
    assert "prefers-color-scheme: dark" in text
    for chart in text.split("<svg")[1:]:
        picture = chart.partition("</svg>")[0]
        assert "currentColor" in picture and "var(--line)" in picture
        assert not {"#000000", "#ffffff", "#111213", "#e1e2e3"} & set(
            re.findall("#[0-9a-f]{6}", picture)
        )


def test_only_common_evenings_are_set_side_by_side(tmp_path: Path) -> None:
    """The busiest evenings of one layout reach a limit: it does not look better for that."""
    pytest.importorskip("matplotlib")
    study, store = write_study(tmp_path, "1..8", "speed: 0.8"), str(tmp_path / "s.db")
    study.write_text(study.read_text().replace("[report]", "[report, bistro]"))
    read = read_study_file(str(study))
    with Store(store, writing=True) as opened:
        opened.plan(read, "1")
        for run in runs_of(read, "1"):
            worse = run.layout.label == "bistro"
            figures = {**dict.fromkeys(FIGURES, 1.0), "lost": run.seed + worse}
            slow = worse and run.seed > 6
            result = ("limit", "too long", None) if slow else ("done", None, figures)
            opened.record(run, RunResult(run.key, *result))
    ran = waiter("study", "report", store, "-o", str(tmp_path / "r.html"), "--json")
    best = ran.json()["best"]
    assert [(one["layout"], one["lost"]) for one in best] == [("report", 3.5), ("bistro", 4.5)]
    assert ran.json()["sentences"][-1].startswith("What takes too long is often what is busiest")
    text = (tmp_path / "r.html").read_text()
    assert "of the 6 evenings of which all combinations have a run that is done" in text
    assert "<td>report</td><td>0.8</td><td>6</td><td>3.5</td>" in text


def test_layouts_are_ranked_and_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    study, store = write_study(tmp_path, "1..5", "speed: 0.8"), str(tmp_path / "s.db")
    generated = "[report, {generate: {tables: 3, name: cafe, seeds: 1..2}}]"
    study.write_text(study.read_text().replace("[report]", generated))
    waiter("study", "run", str(study), "-o", store)
    ran = waiter("study", "report", store, "-o", str(tmp_path / "r.html"), "--json")
    best = ran.json()["best"]
    assert {one["layout"] for one in best} == {"report", "cafe_1", "cafe_2"}
    assert [one["lost"] for one in best] == sorted(one["lost"] for one in best)
    text = (tmp_path / "r.html").read_text()
    assert all(f"Floor plan of {one['layout']}" in text for one in best)


@pytest.mark.wide
@pytest.mark.parametrize("changed", [False, True], ids=["as it was", "scenario changed"])
def test_the_line_plays_the_evening_again(
    changed: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    study = write_study(tmp_path, "1..2", "speed: 0.8")
    study.write_text(study.read_text().replace("[report]", "[{generate: {tables: 3, seeds: 4}}]"))
    waiter("study", "run", "study.yaml", "-o", "a store.db")
    if changed:
        (tmp_path / "quick.yaml").write_text("nothing: of the kind")
    worst = waiter("study", "report", "a store.db", "--json").json()["worst"][0]
    line = worst["replay"]
    assert ("--scenario-of" in line) == changed
    if changed:
        before, _, line = line.partition("; ")
        assert run_line(before).code == 0
    ran = run_line(f"{line} --json")
    assert ran.code == 0, ran.err
    (row,) = (row for row in table(tmp_path / "a store.db") if row["number"] == worst["run"])
    assert ran.json()["figures"] == {name: row[name] for name in FIGURES}
    assert shlex.split(line)[0] == "waiter"


@pytest.mark.parametrize(("module", "page"), [("numpy", False), ("matplotlib", True)])
def test_what_is_missing_is_named(
    module: str, page: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = invented(tmp_path)
    monkeypatch.setitem(sys.modules, module, None)
    ran = waiter("study", "report", store, *(["-o", str(tmp_path / "r.html")] if page else []))
    assert ran.code == 5 and f"{module}\n  hint: " in ran.err
    assert not (tmp_path / "r.html").exists()
