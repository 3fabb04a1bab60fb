"""A plan remembers its layout and its domain: found again where unchanged, told where changed."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import Ran, waiter
from waiter_cli.file_access.locate import data_folder
from waiter_cli.files.plan_origin import remember

SECRET = "root:x:0:0: a secret of somebody else"


@pytest.fixture
def cafe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A layout and a plan for it in the working folder."""
    monkeypatch.chdir(tmp_path)
    text = (Path(data_folder("layouts")) / "report.yaml").read_text()
    Path("cafe.yaml").write_text(text.replace("name: report", "name: cafe"))
    Path("plan.json").write_text(waiter("plan", "-l", "cafe.yaml", "--enter", "1", "--json").out)
    return tmp_path


def rewrite(**keys: Any) -> None:
    plan = json.loads(Path("plan.json").read_text())
    Path("plan.json").write_text(json.dumps({**plan, **keys}))


def readers(plan: str = "plan.json", *more: str) -> list[Ran]:
    return [
        waiter("validate", plan, *more),
        waiter("simulate", "--plan", plan, "--backend", "geometric", *more),
        waiter("layout", "draw", "--plan", plan, *more[1:]),
    ]


def test_what_stands_in_the_plan(cafe: Path) -> None:
    plan = json.loads(Path("plan.json").read_text())
    digest = hashlib.sha256(Path("cafe.yaml").read_bytes()).hexdigest()
    assert plan["layout"] == "cafe" and plan["domain"] == "restaurant"
    assert plan["layout_file"] == {"path": "cafe.yaml", "digest": f"sha256:{digest}"}
    rules = Path(data_folder("domains")) / "restaurant" / "domain.sparc"
    digest = hashlib.sha256(rules.read_bytes()).hexdigest()
    assert plan["domain_file"] == {"digest": f"sha256:{digest}"}


def test_what_comes_with_waiter_has_no_path() -> None:
    plan = waiter("plan", "-l", "report", "--enter", "1", "--json").json()
    assert set(plan["layout_file"]) == {"digest"}


def test_the_path_is_relative_to_the_working_folder(cafe: Path) -> None:
    assert remember("", str(cafe / "cafe.yaml"))["path"] == "cafe.yaml"
    inner = cafe / "inner"
    inner.mkdir()
    os.chdir(inner)
    assert remember("", str(cafe / "cafe.yaml"))["path"] == os.path.join("..", "cafe.yaml")


def test_the_layout_is_found_again(cafe: Path) -> None:
    for ran in readers():
        assert (ran.code, ran.err) == (0, "")


def test_from_the_folder_of_the_plan_from_the_working_folder_and_beside_it(cafe: Path) -> None:
    Path("plans").mkdir()
    shutil.copy("plan.json", "plans/plan.json")
    assert waiter("validate", "plans/plan.json").code == 0  # the working folder
    text = Path("plan.json").read_text()
    assert waiter("validate", "-", stdin=text).code == 0
    shutil.copy("cafe.yaml", "plans/cafe.yaml")
    os.chdir("/")
    assert waiter("validate", str(cafe / "plans" / "plan.json")).code == 0  # the plan's folder
    os.chdir(cafe)
    rewrite(layout_file={**json.loads(text)["layout_file"], "path": "far/away/cafe.yaml"})
    assert waiter("validate", "plan.json").code == 0  # beside it
    Path("cafe.yaml").unlink()
    for ran in readers():
        assert ran.code == 2 and "is not there: far/away/cafe.yaml" in ran.err


def test_a_changed_layout_is_told_and_not_taken(cafe: Path) -> None:
    with Path("cafe.yaml").open("a") as file:
        file.write("# another day\n")
    for ran in readers():
        assert (ran.code, ran.out) == (2, "")
        assert "plan.json:1:" in ran.err
        assert "the layout cafe.yaml has changed since the plan was made" in ran.err
        assert "--layout cafe.yaml" in ran.err
    said = "the layout cafe.yaml has changed since the plan was made"
    ran = waiter("validate", "plan.json", "-l", "cafe.yaml")
    assert ran.code == 0 and f"note: {said}" in ran.out
    ran = waiter("simulate", "--plan", "plan.json", "-l", "cafe.yaml", "--backend", "geometric")
    assert ran.code == 0 and ran.err == f"waiter: {said}\n"
    ran = waiter("layout", "draw", "cafe.yaml", "--plan", "plan.json", "--json")
    assert ran.json()["note"] == said


def test_a_built_in_of_that_name_is_not_taken_for_it(cafe: Path) -> None:
    """A plan of a layout from standard input that calls itself report, or of an older report."""
    text = (Path(data_folder("layouts")) / "report.yaml").read_text() + "# mine\n"
    ran = waiter("plan", "-l", "-", "--enter", "1", "--json", stdin=text)
    Path("plan.json").write_text(ran.out)
    ran = waiter("validate", "plan.json")
    assert ran.code == 2 and "made for another layout called report, or an older one" in ran.err
    assert waiter("validate", "plan.json", "-l", "report").code == 0


def test_nothing_of_a_foreign_file_is_shown(cafe: Path) -> None:
    """A plan may name any file; without its digest nothing of it is read out."""
    Path("secret").write_text(SECRET)
    Path("pipe").parent.mkdir(exist_ok=True)
    os.mkfifo("pipe")
    digest = json.loads(Path("plan.json").read_text())["layout_file"]["digest"]
    for path in ("secret", str(cafe / "secret"), "/dev/zero", "pipe", "/", "a\0b", "é" * 300):
        rewrite(layout_file={"path": path, "digest": digest})
        for ran in readers():
            assert ran.code == 2
            assert "secret of" not in ran.out + ran.err
    Path("latin").write_bytes(b"name: caf\xe9")
    rewrite(layout_file={"path": "latin", "digest": digest})
    assert "has changed" in waiter("validate", "plan.json").err


@pytest.mark.parametrize("memory", [{"path": "cafe.yaml"}, {"digest": "sha256:1"}, [], {"x": 1}])
def test_a_memory_made_wrong_is_wrong_input(cafe: Path, memory: Any) -> None:
    rewrite(layout_file=memory)
    ran = waiter("validate", "plan.json")
    assert ran.code == 2 and ran.err.startswith("plan.json:1:")


def test_a_plan_from_before_is_read_as_ever(cafe: Path) -> None:
    plan = waiter("plan", "-l", "report", "--enter", "1", "--json").json()
    del plan["layout_file"], plan["domain_file"]
    Path("plan.json").write_text(json.dumps(plan))
    for ran in readers():
        assert (ran.code, ran.err) == (0, "")


def test_the_domain_is_found_again(cafe: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(Path(data_folder("domains")) / "restaurant", "mine")
    given = ("-l", "cafe.yaml", "--enter", "1", "--domain", "mine", "--json")
    Path("plan.json").write_text(waiter("plan", *given).out)
    plan = json.loads(Path("plan.json").read_text())
    assert plan["domain"] == "mine"
    assert plan["domain_file"]["path"] == os.path.join("mine", "domain.sparc")

    from waiter_cli.execution import online_planner as thinking

    made = thinking.OnlinePlanner
    used = []

    def noting(translator: Any, domain: Any, *more: Any, **others: Any) -> Any:
        used.append((domain.template.name, domain.built_in))
        return made(translator, domain, *more, **others)

    monkeypatch.setattr(thinking, "OnlinePlanner", noting)
    play = ("simulate", "--plan", "plan.json", "--backend", "geometric")
    assert waiter(*play).code == 0
    assert waiter(*play, "--domain", "restaurant").code == 0
    rules = os.path.join("domains", "restaurant", "domain.sparc")
    assert used == [(os.path.join("mine", "domain.sparc"), False), (rules, True)]
    with Path("mine/domain.sparc").open("a") as file:
        file.write("% more\n")
    said = f"the domain {os.path.join('mine', 'domain.sparc')} has changed since the plan was made"
    ran = waiter(*play)
    assert ran.code == 2 and said in ran.err and "--domain mine" in ran.err
    ran = waiter("validate", "plan.json")  # which plays it by that domain
    assert ran.code == 2 and said in ran.err and "--domain mine" in ran.err
    shutil.rmtree("mine")
    assert "is not there: mine" in waiter(*play).err
