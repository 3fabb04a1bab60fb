"""Finds minimal sets of causes that leave no plan: `Problem`, `Domain` → sets of `Cause`.

Entry point `find_conflicts`.  Whether there is a plan is asked of whoever plans, a `Judge`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol

from waiter_cli.encoding.domains import Domain, domain_of_words
from waiter_cli.explanation.causes_and_changes import Cause, causes_of, without
from waiter_cli.model.problem import Problem

__all__ = ["Judge", "find_conflicts"]

_MOST_CONFLICTS = 4
_WISHES = ("goal", "order")


class Judge(Protocol):
    """Tells whether there is a plan; ``undecided`` is true from when that was not settled on."""

    undecided: bool

    def solvable(self, problem: Problem, domain: Domain) -> bool:
        """Returns whether there is a plan by a domain, as far as that was settled."""


def find_conflicts(problem: Problem, domain: Domain, judge: Judge) -> tuple[tuple[Cause, ...], ...]:
    """Returns sets of causes that leave no plan, each of them minimal; at most `_MOST_CONFLICTS`.

    With only one set's causes, all others taken away, there is no plan; with one of them less there
    is.  What is found first is told first.  Where there is a single set, each of its causes is
    necessary in the problem as it was given.  Otherwise no one of them need be: a plan needs
    something of each set to go, so sets are looked for in what is left without one of another's
    causes (Reiter's tree of hitting sets).

    Of a domain of one's own those rules are causes that only forbid.  Where some set is of wishes
    alone, so are the rules that say when an action is possible.
    """
    search = _ConflictSearch(
        problem, domain, judge, [*_rules(problem, domain), *causes_of(problem)]
    )
    conflicts = search.run()
    bare = any(all(cause.kind in _WISHES for cause in causes) for causes in conflicts)
    permits = list(_rules(problem, domain, permitting=True)) if bare else []
    if judge.undecided or not permits:
        return conflicts
    search = _ConflictSearch(problem, domain, judge, [*search.candidates, *permits])
    return search.run()


def _rules(problem: Problem, domain: Domain, *, permitting: bool = False) -> Iterator[Cause]:
    """Yields the rules of a domain of one's own that forbid, or those that permit, as causes."""
    if domain_of_words(problem, domain).built_in:
        return
    from waiter_cli.explanation.forbidding_rules import forbidding_rules, permitting_rules

    for rule in (permitting_rules if permitting else forbidding_rules)(problem, domain):
        message = f"the rule {rule.text}"
        yield Cause("permit" if permitting else "rule", message, rule.where, lambda p: p, rule)


class _ConflictSearch:
    def __init__(
        self, problem: Problem, domain: Domain, judge: Judge, candidates: Sequence[Cause]
    ) -> None:
        self.problem = problem
        self.domain = domain
        self.judge = judge
        self.candidates = tuple(candidates)

    def run(self) -> tuple[tuple[Cause, ...], ...]:
        """Returns the sets."""
        conflicts: list[tuple[Cause, ...]] = []
        gone: list[frozenset[int]] = [frozenset()]
        for dropped in gone:
            if len(conflicts) == _MOST_CONFLICTS or self.judge.undecided:
                break
            sets = [frozenset(map(self.candidates.index, causes)) for causes in conflicts]
            known = next((one for one in sets if not one & dropped), None)
            if known is None:
                left = [c for k, c in enumerate(self.candidates) if k not in dropped]
                causes = self.minimal(left)
                if not causes:
                    continue
                conflicts.append(causes)
                known = frozenset(map(self.candidates.index, causes))
            gone += [one for k in sorted(known) if (one := dropped | {k}) not in gone]
        return tuple(conflicts)

    def minimal(self, left: list[Cause]) -> tuple[Cause, ...]:
        """Returns a set of these causes that leaves no plan, of which none can be spared.

        Empty if none does.
        """
        if not self.hopeless(left):
            return ()
        for kind in dict.fromkeys(cause.kind for cause in left):
            left = self.spared(left, [cause for cause in left if cause.kind == kind])
        return tuple(left)

    def spared(self, left: list[Cause], some: list[Cause]) -> list[Cause]:
        """Returns what is left without those of ``some`` that can be spared: all at once, or by halves."""
        rest = [cause for cause in left if cause not in some]
        if self.hopeless(rest):
            return rest
        if len(some) == 1:
            return left
        middle = len(some) // 2
        return self.spared(self.spared(left, some[:middle]), some[middle:])

    def hopeless(self, kept: Sequence[Cause]) -> bool:
        """Returns whether there is no plan where all causes but these are taken away."""
        from waiter_cli.explanation.forbidding_rules import without_rules

        gone = [cause for cause in self.candidates if cause not in kept]
        rules = [cause.rule for cause in gone if cause.rule is not None]
        domain = without_rules(self.domain, rules) if rules else self.domain
        return not self.judge.solvable(without(self.problem, gone), domain)
