"""Studies small enough for tests: evenings of seconds, and players that misbehave."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

from waiter_cli.study.store import Store
from waiter_cli.study.studies import RunLimits, RunResult, StudyRun

__all__ = ["QUICK", "limited", "table", "unruly", "unstable", "write_study"]

QUICK = """\
name: quick
guests: {arrivals: {per_hour: 40}, order_after: 0.2, cook: 0.2, eat: 0.2, bill_after: 0, patience: 3}
minutes: 4
"""


def write_study(folder: Path, seeds: str = "1..3", vary: str = "speed: [0.6, 0.8]") -> Path:
    """Writes a study of evenings of four minutes, each of which takes some ten milliseconds."""
    (folder / "quick.yaml").write_text(QUICK)
    path = folder / "study.yaml"
    path.write_text(
        f"name: quick\nlayouts: [report]\nvary: {{{vary}}}\n"
        f"evenings: {{scenario: quick.yaml, seeds: {seeds}}}\n"
    )
    return path


def table(path: Path) -> list[dict[str, Any]]:
    """The table of a store, without times."""
    with Store(str(path)) as store:
        return [{k: v for k, v in row.items() if k != "seconds"} for row in store.rows()]


def unruly(run: StudyRun, limits: RunLimits) -> RunResult:
    """Plays by the seed: 1 dies, 2 hangs, 3 eats memory, 4 raises, others are done."""
    match run.seed:
        case 1:
            os._exit(7)
        case 2:
            time.sleep(3600)
        case 3:
            eaten = []
            while len(eaten) < 128:  # 2 GB: whoever does not look ends, too
                eaten.append(b"x" * (1 << 24))
                time.sleep(0.01)
        case 4:
            raise RuntimeError("so it goes")
    return RunResult(run.key, "done", None, {"parties": run.seed})


def limited(run: StudyRun, limits: RunLimits) -> RunResult:
    """Reaches a limit with seed 2; says which process it was in."""
    status = "limit" if run.seed == 2 else "done"
    return RunResult(run.key, status, None, {"parties": os.getpid()})


def unstable(run: StudyRun, limits: RunLimits) -> RunResult:
    """Plays; its process dies the first time, as a file beside the scenario remembers."""
    mark = Path(run.scenario).parent / f"died-{run.number}"
    if not mark.exists():
        mark.touch()
        os._exit(9)
    return RunResult(run.key, "done", None, {"parties": run.seed})
