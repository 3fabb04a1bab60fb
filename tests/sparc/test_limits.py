"""The timer of the limits: it raises wherever that is harmless, and touches nothing that is not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from sparc import limits
from tests.support.paths import ROOT

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")


def child(text: str, folder: Path | None = None) -> list[str]:
    """The lines that a program prints, which ends without a fault and says nothing else."""
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(ROOT), str(folder or ROOT)]))
    ran = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, env=environment, timeout=60
    )
    assert (ran.returncode, ran.stderr) == (0, ""), ran
    return ran.stdout.split()


def test_the_handler_opens_and_imports_nothing() -> None:
    text = """
import sys, time
from sparc import limits
seen, within = [], False
def hook(event, arguments):
    if within and event.split(".")[0] in ("open", "import", "os", "ctypes", "exec", "compile"):
        seen.append(event)
sys.addaudithook(hook)
look, count = limits._look, 0
def looking(number, frame):
    global within, count
    within, count = True, count + 1
    try:
        look(number, frame)
    finally:
        within = False
limits._look, limits._PERIOD = looking, 0.001
limits.begin(None, None)
begun = time.monotonic()
while count <= 5 and time.monotonic() < begun + 20:
    pass
limits.end()
print(count > 5, *seen)
"""
    assert child(text) == ["True"]


def test_an_import_is_brought_to_its_end(tmp_path: Path) -> None:
    (tmp_path / "slow_to_import.py").write_text(
        "import time\nbegun = time.monotonic()\n"
        "while time.monotonic() < begun + 0.4: pass\nwhole = True\n"
    )
    text = """
import sys
from sparc import limits
limits._LATER = 0.0
limits.begin(0.05)
try:
    import slow_to_import
    while True: pass
except limits.OverLimit as over:
    limits.end()
    print(over.limit, sys.modules["slow_to_import"].whole)
"""
    assert child(text, tmp_path) == ["time", "True"]


def test_a_limit_lost_in_a_finalizer_is_raised_again() -> None:
    text = """
import time
from sparc import limits
class Slow:
    def __del__(self):
        begun = time.monotonic()
        while time.monotonic() < begun + 0.3: pass
limits._LATER = 0.0
begun = time.monotonic()
limits.begin(0.05)
try:
    it = Slow(); del it
    while True: pass
except limits.OverLimit:
    limits.end()
print(time.monotonic() - begun < 5)
"""
    assert child(text) == ["True"]


@pytest.mark.parametrize(
    ("table", "group"),
    [
        (b"", b""),
        (b"0::/\n", b""),
        (b"0::/user.slice/a\xff\n", b"/user.slice/a\xff"),
        (b"12:cpu,cpuacct:/x\n4:memory:/docker/abc\n", b"/docker/abc"),
        (b"nothing of the kind", b""),
    ],
)
def test_the_control_group(table: bytes, group: bytes) -> None:
    assert limits._group(table) == group


def test_what_cannot_be_read_has_no_number() -> None:
    assert limits._number(b"/proc/no/such/file") is None
    assert limits._number(b"/proc") is None


def test_no_garbage_is_looked_for_on_the_way_out_of_a_limit() -> None:
    text = """
import gc
from sparc import limits
limits._LATER = 0.0
seen = []
gc.callbacks.append(lambda phase, about: seen.append(phase))
made = []
gc.disable()
try:
    limits.begin(0.05)
    while True: made.append([])
except limits.OverLimit:
    seen.clear()
    gc.enable()
    kept = [[] for _ in range(100)]
    print(len(seen), gc.get_freeze_count() > 0)
    limits.settle()
    limits.end()
    print(gc.get_freeze_count())
"""
    assert child(text) == ["0", "True", "0"]


def test_no_alarm_comes_at_the_end_of_the_process() -> None:
    """Python takes its handlers of signals away first, and its modules afterwards."""
    text = (
        "import sys, time\nfrom sparc import limits\n"
        "class Slow:\n    def __del__(self, sleep=time.sleep): sleep(0.5)\n"
        "slow = Slow()\nlimits.begin(60)\nsys.exit(3)"
    )
    assert subprocess.run([sys.executable, "-c", text], check=False).returncode == 3
