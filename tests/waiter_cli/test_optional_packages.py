"""The line that installs what is missing: for the Python that runs, and the same everywhere."""

from __future__ import annotations

import re
import shlex
import sys
from importlib import metadata, util
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from waiter_cli import optional_packages as extras
from waiter_cli.errors import MissingError


def installed(monkeypatch: pytest.MonkeyPatch, yes: bool) -> None:
    """Makes `waiter` seem to be installed, or to run from a checkout."""

    def version(name: str) -> str:
        if yes:
            return "0.1.0"
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", version)


def test_pip_is_that_of_the_running_interpreter(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert shlex.split(extras.pip_line("a", "b[c]")) == [
        sys.executable, "-m", "pip", "install", "a", "b[c]",
    ]  # fmt: skip


def test_the_short_name_stands_where_the_shell_finds_this_interpreter(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    python = tmp_path / "python"
    python.write_text("#!/bin/sh\n")
    python.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert not extras.pip_line("a").startswith("python ")
    monkeypatch.setattr(sys, "executable", str(python))
    assert extras.pip_line("a") == "python -m pip install a"


def test_an_environment_without_pip_is_served_by_uv(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    real = util.find_spec
    monkeypatch.setattr(util, "find_spec", lambda name: None if name == "pip" else real(name))
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "-m pip install a" in extras.pip_line("a")
    uv = tmp_path / "uv"
    uv.write_text("#!/bin/sh\n")
    uv.chmod(0o755)
    assert extras.pip_line("a") == f"uv pip install --python {shlex.quote(sys.executable)} a"


def test_an_extra_is_named_where_waiter_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    installed(monkeypatch, True)
    assert extras.extra_line("sim").endswith(" -m pip install 'waiter-planner[sim]'")
    installed(monkeypatch, False)
    assert extras.extra_line("sim").endswith(" -m pip install pybullet numpy")


def test_the_packages_of_the_extras_are_those_of_the_project() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for extra, packages in extras.EXTRAS.items():
        found = re.search(rf"^{extra} = \[(.*?)\]$", text, re.MULTILINE | re.DOTALL)
        assert found is not None
        names = re.findall(r'"([\w-]+)', found[1])
        assert tuple(names) == packages


@pytest.mark.parametrize("here", [True, False], ids=["installed", "checkout"])
def test_the_line_is_the_same_everywhere(
    here: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    from waiter_cli.commands.doctor import examine
    from waiter_cli.labels import lettering
    from waiter_cli.pictures import ffmpeg as encoder
    from waiter_cli.simulation import bullet

    installed(monkeypatch, here)
    for name in ("PIL", "PIL.ImageDraw", "imageio_ffmpeg", "pybullet"):
        monkeypatch.setitem(sys.modules, name, None)
    record = extras.extra_line("record")
    drawn = waiter("layout", "draw", "report", "--png", str(tmp_path / "a.png"))
    assert f"hint: {record} (or " in drawn.err
    for module in (lettering.require, encoder._program):
        with pytest.raises(MissingError) as missing:
            module()
        assert missing.value.mend == record
    mends = {found.name: found.mend for found in examine() if found.mend}
    assert mends["Pillow"] == mends["imageio-ffmpeg"] == record
    if extras.has_pybullet_wheels():
        assert mends["pybullet"] == bullet.mend() == extras.extra_line("sim")
