"""What `waiter plan` costs: the recorded scenes, every strategy, the translators, the start-up.

    python benchmarks/bench_plan.py [--runs N]

Everything is measured in one run on one machine, so that the ratios mean something.  Where Java
and sparc.jar are found, the original loop (a Java run for every horizon) is measured beside it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from benchmarks.measure import WAITER, Figures, measure, once, table

# The recorded scenes, and the steps of the plans that the original found for them: its loop ran
# Java for n = 2, 3, … up to these.
SCENES = {"b1": 7, "b2": 4, "b3": 3, "b4": 5}
STRATEGIES = ("binary", "gallop", "linear", "minimize")


def original_loop(scene: str, jar: str, folder: str) -> float:
    """Wall seconds of the original's search: the report's modelling, Java for n = 2, 3, …"""
    from waiter_cli.encoding.domains import find_domain
    from waiter_cli.encoding.template import fill_template
    from waiter_cli.problems.from_options import read_problem

    problem, template = read_problem(None, scene)[0], find_domain("report").template
    environment = {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"]}
    path = os.path.join(folder, "program.sparc")
    start = time.perf_counter()
    for horizon in range(2, SCENES[scene] + 1):
        with open(path, "w") as file:
            file.write(fill_template(template, problem, horizon).text + "\n")
        done = subprocess.run(
            ["java", "-jar", jar, path, "-A", "-n", "1"],
            capture_output=True, text=True, env=environment, check=False,
        )  # fmt: skip
    if "occurs" not in done.stdout:
        raise SystemExit(f"the original loop found no plan for {scene}")
    return time.perf_counter() - start


def find_jar() -> str | None:
    """The jar, where it and Java are found."""
    from waiter_cli.errors import MissingError
    from waiter_cli.translators.jar import jar_translator
    from waiter_cli.translators.jar_store import find_jar as find

    try:
        jar_translator()
        return str(find().path)
    except MissingError as missing:
        print(f"without the original: {missing.message}\n")
        return None


def scenes(runs: int, jar: str | None, folder: str) -> None:
    """Target 1: the recorded scenes as whole processes."""
    base = measure([sys.executable, "-c", "import clingo, typer, yaml"], runs)
    rows = []
    for scene in SCENES:
        ours = measure([*WAITER, "plan", "--scenario", scene], runs)
        loop = original_loop(scene, jar, folder) if jar else None
        rows.append(
            (
                scene,
                ours.wall,
                base.wall,
                ours.wall / base.wall,
                loop or "-",
                loop / ours.wall if loop else "-",
            )
        )
    print("the recorded scenes, wall seconds of whole processes")
    table(("scene", "waiter plan", "bare imports", "ratio", "Java loop", "times faster"), rows)


def strategies(runs: int, jar: str | None) -> None:
    """Every strategy and both domains on the recorded scenes, and the jar as the translator."""
    rows = []
    for scene in SCENES:
        row: list[object] = [scene]
        for domain in ("restaurant", "report"):
            for strategy in STRATEGIES:
                command = [*WAITER, "plan", "--scenario", scene, "--domain", domain]
                row.append(measure([*command, "--search", strategy], runs).wall)
        if jar:
            command = [*WAITER, "plan", "--scenario", scene, "--translator", "jar"]
            os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp()
            row.append(once(command).wall)
            row.append(measure(command, runs).wall)
        rows.append(row)
    print("every strategy, wall seconds of whole processes; jar: first run, and from its cache")
    table(
        (
            "scene",
            *STRATEGIES,
            *(f"report {s}" for s in STRATEGIES),
            *(("jar", "cached") if jar else ()),
        ),
        rows,
    )


def translation(jar: str | None, folder: str) -> None:
    """Target 3: the same programs through our translator and through the jar."""
    from sparc.checking.checker import check
    from sparc.source import Source
    from sparc.syntax.parser import parse
    from sparc.translation.translator import translate

    os.environ["PATH"] = folder + os.pathsep + os.environ["PATH"]  # the jar asks for clingo
    path, out = os.path.join(folder, "program.sparc"), os.path.join(folder, "out.lp")
    rows = []
    for size in (20, 200, 2000, 20000):
        # a record sort of `size` terms, listed because a condition restricts it
        rules = " ".join(f"q{i}(X) :- p(X), not r(X)." for i in range(10))
        names = ", ".join(f"e{i}" for i in range(size // 10))
        text = (
            f"sorts\n#a = {{{names}}}.\n#b = 1..11.\n#s = f(#a(X), #b(Y)).\n#t = #s - {{f(e0, 11)}}.\n"
            f"predicates\np(#t). r(#t). {' '.join(f'q{i}(#t).' for i in range(10))}\nrules\n"
            f"p(f(X, 1)) :- #a(X). r(f(e0, 2)). {rules}\n"
        )
        with open(path, "w") as file:
            file.write(text)
        start = time.perf_counter()
        count = max(1, 2000 // size)
        for _ in range(count):
            program = translate(check(parse(Source("bench", text))))
        inside = (time.perf_counter() - start) / count
        ours = translated([*WAITER, "sparc", "translate", path, "-o", out], out)
        theirs = translated(["java", "-jar", jar, path, "-o", out], out) if jar else None
        rows.append(
            (
                f"{size}",
                inside,
                theirs.wall if theirs else "-",
                theirs.wall / inside if theirs else "-",
                ours.wall,
                ours.memory,
                theirs.memory if theirs else "-",
                len(program.text),
            )
        )
    print("translation, seconds and peak MB, by ground terms of the largest sort")
    table(
        (
            "terms",
            "native",
            "jar (process)",
            "times faster",
            "native process",
            "native MB",
            "jar MB",
            "characters out",
        ),
        rows,
    )


def translated(command: list[str], out: str) -> Figures:
    """Medians of three runs of a translator, each of which must write ``out`` anew."""
    found = []
    for _ in range(3):
        if os.path.exists(out):
            os.remove(out)
        found.append(once(command))
        if not os.path.getsize(out):
            raise SystemExit(f"nothing was translated by {' '.join(command)}")
    return Figures(
        sorted(f.wall for f in found)[1],
        sorted(f.cpu for f in found)[1],
        max(f.memory for f in found),
    )


def start_up(runs: int) -> None:
    """Target 5: what it takes to say something about oneself."""
    bare = measure([sys.executable, "-c", "pass"], runs * 2)
    rows: list[tuple[str, Figures]] = [
        ("python -c pass", bare),
        ("waiter --version", measure([*WAITER, "--version"], runs * 2)),
        ("waiter --help", measure([*WAITER, "--help"], runs * 2)),
    ]
    print("start-up, whole processes")
    table(
        ("command", "wall s", "ratio", "MB"),
        [(n, f.wall, f.wall / bare.wall, f.memory) for n, f in rows],
    )


def main() -> None:
    """Runs all parts."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=5)
    runs = parser.parse_args().runs
    jar = find_jar()
    with tempfile.TemporaryDirectory() as folder:
        launcher = os.path.join(folder, "clingo")
        with open(launcher, "w") as file:
            file.write(f'#!/bin/sh\nexec "{sys.executable}" -m clingo "$@"\n')
        os.chmod(launcher, 0o755)
        start_up(runs)
        scenes(runs, jar, folder)
        translation(jar, folder)
        strategies(runs, jar)


if __name__ == "__main__":
    main()
