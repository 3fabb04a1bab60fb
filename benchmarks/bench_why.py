"""What explaining costs beside solving: `sparc.explain` and `sparc.why`, in one process.

    python benchmarks/bench_why.py [--runs N] [--programs N]

The corpus: restaurants with too few steps, or a constraint too many, and random inconsistent programs.
Explaining is measured beside one refutation of the same program, from its text; `why` beside one
solution, for literals in the answer set and out of it.  The targets are ratios of at most 10 and 2, by
the median.  Then what an editor waits for: a text of a thousand lines examined after a key, of which
the target is 50 ms.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

import sparc
from benchmarks.measure import table
from sparc.syntax.printer import print_program
from tests.support.inconsistent_programs import inconsistent_programs
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.template import fill_template
from waiter_cli.problems.from_options import read_problem

SCENARIOS = ("b1", "b2", "b3", "b4")


def restaurants() -> Iterator[tuple[str, str, str]]:
    """Triples (name, consistent program, inconsistent program)."""
    template = find_domain("restaurant").template
    for name in SCENARIOS:
        problem, _ = read_problem(None, name, enter=(), bills=(), goals=())
        horizon = 1
        while not solved(fill_template(template, problem, horizon).text):
            horizon += 1
        whole = fill_template(template, problem, horizon).text
        short = fill_template(template, problem, horizon - 1).text
        yield name, whole, short
        planted = ":- occurs(go_to(A, N), I).\n\ndisplay\n"
        broken = whole.replace("display\n", planted, 1)
        if not solved(broken):
            yield f"{name}, planted", whole, broken


def solved(text: str) -> bool:
    """Whether a program has an answer set."""
    return bool(list(sparc.solve(text, models=1)))


def median(work: Callable[[], object], runs: int) -> float:
    """Milliseconds of processor time."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        work()
        times.append((time.process_time() - start) * 1000)
    return statistics.median(times)


def examining(runs: int) -> tuple[int, float]:
    """Returns the lines of a text, and what the language server takes to examine it."""
    from sparc.language_server.document import Document

    more = "".join(
        f"% Note {i}.\nwalks({i % 5}) :- holds(isfree(_), {i % 5}), holds(isserved(T), {i % 5}).\n"
        for i in range(300)
    )
    template = find_domain("restaurant").template
    text = template.text.replace("\ndisplay", f"\n{more}\ndisplay")
    before = Document("domain.sparc", text)
    return text.count("\n"), median(lambda: Document("domain.sparc", text + " ", before), runs)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--programs", type=int, default=40)
    options = parser.parse_args()
    rows = []
    explained: list[float] = []
    asked: list[float] = []
    for name, whole, broken in restaurants():
        refutation = median(lambda text=broken: solved(text), options.runs)  # type: ignore[misc]
        explaining = median(lambda text=broken: sparc.explain(text), options.runs)  # type: ignore[misc]
        solution = median(lambda text=whole: solved(text), options.runs)  # type: ignore[misc]
        answer = next(iter(list(sparc.solve(whole, models=1)))).literals
        literals = sorted(map(str, answer))[:: max(1, len(answer) // 4)]
        literals += [each[1:] if each.startswith("-") else f"-{each}" for each in literals]
        whys = [
            median(lambda t=whole, one=one: sparc.why(t, one), 1)  # type: ignore[misc]
            for one in literals
        ]
        why = statistics.median(whys)
        explained.append(explaining / refutation)
        asked.append(why / solution)
        rows.append(
            [name, f"{refutation:.0f}", f"{explaining:.0f}", f"{explained[-1]:.1f}",
             f"{solution:.0f}", f"{why:.0f}", f"{asked[-1]:.2f}"]
        )  # fmt: skip
    for seed, program in inconsistent_programs(1, options.programs):
        text = print_program(program)
        refutation = median(lambda text=text: solved(text), options.runs)  # type: ignore[misc]
        explaining = median(lambda text=text: sparc.explain(text), options.runs)  # type: ignore[misc]
        explained.append(explaining / refutation)
        del seed
    rows.append(
        [
            f"{options.programs} random",
            "",
            "",
            f"{statistics.median(explained[len(rows) :]):.1f}",
            "",
            "",
            "",
        ]
    )
    table(["program", "refute, ms", "explain, ms", "ratio", "solve, ms", "why, ms", "ratio"], rows)
    print(f"median: explain {statistics.median(explained):.1f}, why {statistics.median(asked):.2f}")
    lines, after_a_key = examining(max(5, options.runs))
    print(f"{lines} lines examined in an editor: {after_a_key:.0f} ms")


if __name__ == "__main__":
    main()
