"""Random small inconsistent programs, and their causes and mends by trying every set of statements."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from random import Random

import sparc

__all__ = ["brute_force", "inconsistent_programs"]

HEADER = "sorts\n#n = 0..2.\n#s = {a,b}.\npredicates\np(#n). q(#n). r(#s). t().\nrules\n"
ATOMS = ("p(0)", "p(1)", "q(1)", "q(2)", "r(a)", "r(b)", "t")
WIDE = ("p(X)", "q(X)", "p(X+1)", "q(X-1)", "p(Y)", "r(Z)", "r(a)", "t", "q(1)")


class _Writer:
    def __init__(self, seed: int) -> None:
        self.draw = Random(seed)

    def atom(self, wide: bool) -> str:
        return self.draw.choice(("", "", "", "-")) + self.draw.choice(WIDE if wide else ATOMS)

    def literal(self, wide: bool) -> str:
        return self.draw.choice(("", "", "not ")) + self.atom(wide)

    def statement(self) -> str:
        draw = self.draw
        wide = draw.random() < 0.4
        body = ", ".join(self.literal(wide) for _ in range(draw.choice((0, 1, 1, 2, 3))))
        if draw.random() < 0.1:
            body = f"{body}{', ' if body else ''}#count{{N : p(N)}} {draw.choice('<>=')} 1"
        kind = draw.random()
        if kind < 0.3 and body:
            head, sign = "", ":-"
        elif kind < 0.45:
            bounds = draw.choice((("", ""), ("1", ""), ("1", "1"), ("2", "")))
            wanted = draw.choice(("p(V)", "q(V) : p(V)", "r(a); r(b)", "t; -t; p(0)"))
            head, sign = f"{bounds[0]}{{{wanted}}}{bounds[1]}", ":-"
        elif kind < 0.55:
            head, sign = f"{self.atom(False)} | {self.atom(False)}", ":-"
        elif kind < 0.6:
            head, sign = self.atom(False), ":+"
        elif kind < 0.65:
            return "#minimize{1,N : p(N)}."
        else:
            head, sign = self.atom(wide), ":-"
        if wide:  # every variable has its sort
            body = f"p(X), q(Y), r(Z){', ' if body else ''}{body}" if draw.random() < 0.3 else body
        if not body:
            return f"{head} :+ ." if sign == ":+" else f"{head}."
        return f"{head} {sign} {body}.".strip()


def inconsistent_programs(first: int, number: int) -> Iterator[tuple[int, sparc.Program]]:
    """Pairs (seed, program): the next ``number`` inconsistent ones from seed ``first`` on."""
    seed = first
    while number:
        writer = _Writer(seed)
        lines = [writer.statement() for _ in range(writer.draw.randint(4, 7))]
        text = HEADER + "".join(f"{line}\n" for line in dict.fromkeys(lines))
        try:
            program = sparc.parse(sparc.Source(f"seed{seed}", text))
            sparc.check(program)
        except (sparc.SourceError, sparc.SourceErrors):
            pass
        else:
            if not _has_answer_set(program):
                number -= 1
                yield seed, program
        seed += 1


def _has_answer_set(program: sparc.Program) -> bool:
    return bool(list(sparc.solve(program, models=1)))


def _consistent_sets(program: sparc.Program) -> set[frozenset[int]]:
    indices = range(len(program.statements))
    return {
        frozenset(chosen)
        for size in range(len(indices) + 1)
        for chosen in combinations(indices, size)
        if _has_answer_set(
            replace(program, statements=tuple(program.statements[i] for i in chosen))
        )
    }


def brute_force(program: sparc.Program) -> tuple[set[frozenset[int]], set[frozenset[int]]]:
    """Causes and mends.

    The smallest sets such that no program between them and the whole has an answer set, and the
    smallest without which the program has one; by inclusion.
    """
    consistent = _consistent_sets(program)
    indices = range(len(program.statements))
    causes = {
        frozenset(chosen)
        for size in range(len(indices) + 1)
        for chosen in combinations(indices, size)
        if not any(kept.issuperset(chosen) for kept in consistent)
    }
    return _least(causes), _least({frozenset(indices) - kept for kept in consistent})


def _least(sets: set[frozenset[int]]) -> set[frozenset[int]]:
    return {one for one in sets if not any(other < one for other in sets)}
