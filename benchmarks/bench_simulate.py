"""``waiter simulate``: how much faster than real time, with and without pictures, and its memory.

    python benchmarks/bench_simulate.py

Ratios of one run on one machine.  Targets: without pictures 100 times real time and 60 simulated
seconds in under a second, start of the process included; seen from above 5 times at 12 frames a
second; in perspective 1.5 times at full quality and 4 at draft; a layered frame 5 times cheaper than
a whole one; at most 300 MB, however long the run; a step by a domain's own rules, warm, in 20 ms.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from dataclasses import replace

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [ROOT, os.path.dirname(os.path.abspath(__file__))]

from measure import WAITER, once  # noqa: E402

from tests.support.playing import play  # noqa: E402
from waiter_cli.model.problem import Problem  # noqa: E402
from waiter_cli.model.scenario import TimedEvent  # noqa: E402
from waiter_cli.model.state import Observation  # noqa: E402
from waiter_cli.problems.from_options import read_problem  # noqa: E402

MINUTE = ("simulate", "--scenario", os.path.join(ROOT, "examples", "four-scenes.yaml"))


def evening(minutes: float) -> tuple[Problem, list[TimedEvent]]:
    """Guests who come and go for so many minutes."""
    problem = replace(read_problem("report_large", None)[0], everybody=True)
    events = []
    for k in range(int(minutes)):
        party = (f"a{k}", f"b{k}")
        events.append(TimedEvent(60.0 * k, (Observation("enter", party),)))
        if k:
            events.append(TimedEvent(60.0 * k + 1, (Observation("leave", (f"a{k - 1}",)),)))
    return problem, events


def loop(backend: str) -> None:
    problem, events = evening(20)
    began = time.perf_counter()
    run = play(problem, timed=events, backend=backend, watch=lambda run: None)
    took = time.perf_counter() - began
    row(f"loop without pictures, {backend}", run.outcome.seconds / took, 100, "x real time")


def row(what: str, value: float, target: float, unit: str, *, least: bool = True) -> None:
    met = value >= target if least else value <= target
    sign = "≥" if least else "≤"
    print(f"{what:52} {value:9.1f} {unit:14} target {sign} {target:g} {'met' if met else 'MISSED'}")


def films() -> None:
    cases = (("2d", "full", 5.0), ("3d", "full", 1.5), ("3d", "draft", 4.0))
    with tempfile.TemporaryDirectory() as folder:
        for view, quality, target in cases:
            out = os.path.join(folder, f"{view}{quality}.mp4")
            found = once([*WAITER, *MINUTE, "--record", out, "--view", view, "--quality", quality])
            row(
                f"film, {view} {quality}, 1260x720 at 12 fps",
                53.3 / found.wall,
                target,
                "x real time",
            )


def frames() -> None:
    """A layered frame against a whole one of the same scene and size."""
    from waiter_cli.pictures.scene3d import Scene3D
    from waiter_cli.pictures.snapshot import Snapshot, take
    from waiter_cli.room.room import build_room

    problem = read_problem(None, "b2")[0]
    moments: list[Snapshot] = []

    def keep(run: object) -> None:
        if run.clock.ticks % 5 == 0:  # type: ignore[attr-defined]
            moments.append(take(run))  # type: ignore[arg-type]

    play(problem, watch=keep)
    room = build_room(problem.layout)
    scene = Scene3D(room, 960, 720)
    scene.draw(moments[0])
    began = time.perf_counter()
    for moment in moments:
        scene.draw(moment)
    layered = (time.perf_counter() - began) / len(moments)
    scene.furnish()
    began = time.perf_counter()
    for _ in range(5):
        scene.studio.shoot(scene.camera, (0, 0, 960, 720), scene.fine)
    whole = (time.perf_counter() - began) / 5
    row(
        f"whole frame {1000 * whole:.0f} ms, layered {1000 * layered:.1f} ms",
        whole / layered,
        5,
        "x cheaper",
    )


def memory() -> None:
    found = once([*WAITER, *MINUTE])
    row(
        f"53 simulated seconds, whole process ({found.cpu:.2f} s CPU)",
        found.wall,
        1.0,
        "s",
        least=False,
    )
    code = (
        "import sys; sys.path[:0] = ['.', 'benchmarks']; from bench_simulate import long_film; "
        "long_film(float(sys.argv[1]))"
    )
    peaks = []
    for minutes in (1, 20):
        found = once([sys.executable, "-c", code, str(minutes)])
        peaks.append(found.memory)
        row(f"peak memory of a 3d film of {minutes} min", found.memory, 300, "MB", least=False)
    row("growth from 1 to 20 minutes", peaks[1] - peaks[0], 30, "MB", least=False)


def own_rules() -> None:
    """A plan on `report` executed by the domain itself, once its programs are ground."""
    import waiter_cli
    from waiter_cli.domain_execution.domain_rules import DomainRules
    from waiter_cli.encoding.domains import find_domain
    from waiter_cli.rules.validator import run

    problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), enter=[2])
    plan = waiter_cli.plan(problem).plan
    assert plan is not None
    rules = DomainRules(find_domain("restaurant"))
    run(problem, plan, rules)
    began = time.process_time()
    run(problem, plan, rules)
    step = 1000 * (time.process_time() - began) / (plan.horizon + 1)
    row("a step by the domain's own rules", step, 20, "ms", least=False)


def long_film(minutes: float) -> None:
    """Records a long evening, few frames a second."""
    from waiter_cli.pictures.film import open_film
    from waiter_cli.room.room import build_room

    problem, events = evening(minutes)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "a.mp4")
        room = build_room(problem.layout)
        with open_film(room, (out,), "3d", "auto", 4.0, "1260x720", "full", gui=False) as film:
            holder: list[object] = []

            def watch(run: object) -> None:
                holder[:] = [run]
                film.watch(run)

            run = play(problem, timed=events, watch=watch)
            film.finish(holder[0], run.outcome)


if __name__ == "__main__":
    loop("geometric")
    loop("pybullet")
    own_rules()
    memory()
    films()
    frames()
