"""The examples run, and say plainly what is missing or wrong; none of them ends in a traceback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide

EXAMPLES = ROOT / "examples"


def example(name: str, *arguments: str, cwd: Path, **more: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **more}
    return subprocess.run(
        [sys.executable, str(EXAMPLES / name), *arguments],
        cwd=cwd, env=environment, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip


SITUATIONS = sorted(path.stem for path in EXAMPLES.glob("*.yaml"))
SITUATIONS += ["two-robots/lunch", "two-robots/swap"]
LONG = {"friday", "lunch"}  # whole evenings; that of two robots stays


@pytest.mark.parametrize("name", mostly_wide(SITUATIONS, *set(SITUATIONS) - LONG))
def test_a_situation_plays_to_its_end(name: str) -> None:
    path = EXAMPLES / f"{name}.yaml"
    ran = waiter("simulate", "--scenario", str(path), "--backend", "geometric", "--json")
    assert (ran.code, ran.err) == (0, "")
    assert ran.json()["status"] == "done" and not ran.json()["failed_checks"]


def test_two_robots_change_places_in_a_bay_only() -> None:
    swap = ("--scenario", str(EXAMPLES / "two-robots" / "swap.yaml"))
    without = ("--layout", str(EXAMPLES / "two-robots" / "aisle-without-bay.yaml"))
    plan = waiter("plan", *swap, "--json").json()
    assert (plan["horizon"], plan["minimal"]) == (6, True)
    ran = waiter("explain", *swap, *without)
    assert ran.code == 0 and "swap.yaml:9:10: r1 and r2 cannot pass each other" in ran.out


@pytest.mark.wide
@pytest.mark.parametrize(
    ("layout", "said"),
    [
        ("report", "    give_bill(agent,table1)\n"),
        ("bistro", "    give_bill(agent,table3)\n"),
        ("walled_off", "    later: no path of edges leads from n0 to table1"),
    ],
)
def test_the_gesture_client_serves_a_guest(layout: str, said: str, tmp_path: Path) -> None:
    ran = example("gesture_client.py", layout, cwd=tmp_path)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert said in ran.stdout


def test_the_gesture_client_ends_as_the_loop_does(tmp_path: Path) -> None:
    ran = example("gesture_client.py", "reprot", cwd=tmp_path)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert "did you mean report?" in ran.stderr and "Traceback" not in ran.stderr


def without(module: str, folder: Path) -> str:
    """A path for Python on which a module cannot be imported."""
    folder.mkdir()
    (folder / f"{module}.py").write_text(f"raise ImportError('gone', name={module!r})\n")
    return os.pathsep.join([str(folder), str(ROOT)])


@pytest.mark.parametrize("module", ["imageio_ffmpeg", "PIL"])
def test_the_film_names_what_is_missing(module: str, tmp_path: Path) -> None:
    path = without(module, tmp_path / "lacking")
    ran = example("film.py", "made", cwd=tmp_path, PYTHONPATH=path)
    assert (ran.returncode, ran.stdout) == (1, "")
    assert f"the film needs {module}, which is missing\n  hint: " in ran.stderr
    assert "pip install" in ran.stderr and "Traceback" not in ran.stderr
    assert not (tmp_path / "made").exists()


@pytest.mark.slow
def test_the_film_names_what_it_wrote(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    ran = example("film.py", "made", cwd=tmp_path)
    assert ran.returncode == 0, ran.stderr
    for name in ("replay.gif", "replay.png", "two-robots.gif"):
        assert f"{os.path.join('made', name)}: " in ran.stdout
        assert (tmp_path / "made" / name).stat().st_size < 1_500_000
