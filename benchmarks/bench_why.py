"""What explaining costs beside solving: `sparc.explain` and `sparc.why`, in one process.

    python benchmarks/bench_why.py [--runs N] [--programs N] [--keys N]

The corpus: restaurants with too few steps, or a constraint too many, and random inconsistent programs.
Explaining is measured beside one refutation of the same program, from its text; `why` beside one
solution, for literals in the answer set and out of it.  The targets are ratios of at most 10 and 2, by
the median.  Then what an editor waits for after a key in a text of a thousand lines, for which
the target is 50 ms: keys in a rule, such that it has a fault and that it has none, in declarations,
in sorts and constants.
"""

from __future__ import annotations

import argparse
import os
import random
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


def thousand_lines(arithmetic: bool) -> str:
    """Returns a program of 761 rules that are all different; many of them calculate, or all."""
    draw = random.Random(1)
    forms = [
        "at{a}(T, R, I) :- at{b}(T, R, I), not -at{a}(T, R, I).",
        "-at{a}(T, R1, I) :- at{a}(T, R2, I), R1 != R2.",
        "occurs(move(T, R), I) :- at{a}(T, R, I), cost{c}(T, C), C > 5.",
        "at{a}(T, R, I+1) :- at{b}(T, R, I), occurs(move(T, R), I), I < n.",
        "cost{c}(T, C+D) :- cost{d}(T, C), at{a}(T, _, D), C + D < 400.",
        ":- at{a}(T, R, I), cost{c}(T, C), C * 2 > I + 30.",
    ][3 if arithmetic else 0 :]
    lines = ["#const n = 20.", "sorts", "#step = 0..n.", "#room = [r][1..8].", "#thing = [t][1..30].",
             "#cost = 0..500.", "#act = move(#thing,#room) + lift(#thing).", "predicates"]  # fmt: skip
    lines += [f"at{i}(#thing, #room, #step)." for i in range(40)]
    lines += [f"cost{i}(#thing, #cost)." for i in range(20)]
    lines += ["occurs(#act, #step).", "rules"]
    for number in range(761):
        if number % 4 == 0:
            lines.append(f"% Note {number}: something is told here about the rule below.")
        a, b, c, d = (draw.randrange(most) for most in (40, 40, 20, 20))
        lines.append(draw.choice(forms).format(a=a, b=b, c=c, d=d))
    return "\n".join(lines) + "\n"


def typed(text: str, old: str | None, new: str, runs: int) -> str:
    """Milliseconds until the language server has examined a text in which ``new`` replaced ``old``
    (None: behind its end): median and 95th percentile.
    """
    from sparc.language_server.document import Document

    times = []
    for _ in range(runs):
        before = Document("x.sparc", text)
        after = text + new if old is None else text.replace(old, new, 1)
        times.append(median(lambda b=before, t=after: Document("x.sparc", t, b), 1))  # type: ignore[misc]
    times.sort()
    return f"{statistics.median(times):.0f} / {times[int(0.95 * len(times))]:.0f}"


def keys(runs: int) -> list[list[str]]:
    """Returns rows: the key, and the milliseconds (median / 95th percentile) in two programs."""
    texts = [thousand_lines(False), thousand_lines(True)]
    edits = [
        ("in a rule", "I < n.", "I < n, I > 0."),
        ("in a rule, a fault", "I < n.", "I < n, I >."),
        ("in a comment", "% Note 4:", "% Note 4, too:"),
        ("a new predicate", "predicates\n", "predicates\nnew(#thing).\n"),
        ("a fact more", "rules\n", "rules\ncost1(t1, 4).\n"),
        ("a display", None, "display\ncost1.\n"),
        ("in a sort", "0..500", "0..600"),
        ("in a sort of records", "+ lift(#thing)", "+ lift(#room)"),
        ("in a constant", "n = 20", "n = 21"),
    ]
    return [[name, *(typed(text, old, new, runs) for text in texts)] for name, old, new in edits]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--programs", type=int, default=40)
    parser.add_argument("--keys", type=int, default=20, help="how often each key is typed")
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
    print()
    table(
        ["a key in 1,000 lines", "761 rules, p50 / p95 ms", "all with arithmetic"],
        keys(options.keys),
    )


if __name__ == "__main__":
    main()
