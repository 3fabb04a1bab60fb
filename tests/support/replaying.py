"""Replays explanations without the code that made them: instances are read again and tried by the solver.

Entry point `faults_of`: what is wrong with the explanations of some literals of one answer set.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import product
from typing import Any

import sparc
from sparc.explaining.absence import Absence, FailedRule
from sparc.explaining.derivation import Derivation
from sparc.explaining.why import Why, why
from sparc.sorts.extents import listing
from sparc.sorts.values import text as value_text
from sparc.syntax.printer import print_statement
from sparc.syntax.tree import Aggregate, Arithmetic, Atom, Choice, Naf, Number, Rule, Variable

__all__ = ["all_literals", "faults_of"]


def all_literals(typed: Any, most: int = 40) -> list[str]:
    """Ground literals of each predicate and sign, at most so many of each."""
    found = []
    for name, signature in typed.predicates.items():
        values = [
            [value_text(v) for v in listing(sort.extent, sort.name, None)]
            for sort in signature.sorts
        ]
        terms = list(product(*values))
        for row in terms[:: max(1, len(terms) // most)]:
            shown = f"{name}({','.join(row)})" if row else name
            found += [shown, f"-{shown}"]
    return found


def faults_of(text: str, literals: Iterable[str], number: int = 1) -> list[str]:
    """One sentence for each thing that is wrong."""
    program = sparc.parse(sparc.Source("p.sparc", text))
    typed = sparc.check(program)
    bare = sparc.check(replace(program, display=None))
    sets = list(sparc.solve(bare, models=number))
    true = {str(each) for each in sets[number - 1].literals}
    out: list[str] = []
    replayer = _Replayer(program, typed, true, out)
    for literal in literals:
        found = why(bare, literal, number=number)
        before = len(out)
        if found.holds is not (literal in true):
            out.append(f"holds is {found.holds}")
        elif found.holds:
            replayer.derivations(found)
        elif found.because_not is not None:
            replayer.absence(found.because_not)
        out[before:] = [f"{literal}: {each}" for each in out[before:]]
    replayer.try_bodies()
    return out


class _Replayer:
    def __init__(self, program: Any, typed: Any, true: set[str], out: list[str]) -> None:
        self.program = program
        self.typed = typed
        self.true = true
        self.out = out
        self.bodies: dict[str, bool] = {}

    # ------------------------------------------------------------ in

    def derivations(self, found: Why) -> None:
        """Each step is an instance of its rule, and bottom up they give the literal."""
        nodes = [node for node in _nodes(found.because) if node.place is not None]
        literals = [node.literal for node in nodes]
        if len(set(literals)) != len(literals):
            self.out.append("something is shown twice")
        derived: set[str] = set()
        while True:
            ready = {n.literal for n in nodes if all(self.given(p, derived) for p in n.premises)}
            if ready <= derived:
                break
            derived |= ready
        if found.literal not in derived or not derived >= set(literals):
            self.out.append(f"the premises give {sorted(derived)} only")
        if not derived <= self.true:
            self.out.append(f"{derived - self.true} is not in the answer set")
        for node in nodes:
            self.step(node)

    def given(self, premise: Derivation, derived: set[str]) -> bool:
        if premise.literal.startswith("not "):
            return premise.literal[4:] not in self.true
        return premise.literal in derived

    def step(self, node: Derivation) -> None:
        """The instance is one of the rule at the place, and the premises are its body."""
        rule = self.rule_at(node.place)
        if not isinstance(rule, Rule) and not hasattr(rule, "head"):
            return  # a range fact
        instance = self.read(str(node.instance))
        if instance is None:
            return
        heads = [rule.head]
        if isinstance(rule.head, Choice):
            heads = [Choice((element,), None, None) for element in rule.head.elements]
        ground = (instance.head, instance.body)
        if not any(_matches((head, rule.body), ground, {}) for head in heads):
            self.out.append(f"{node.instance} is no instance of {node.place}")
        head = instance.head
        atoms = [each.atom for each in head.elements] if isinstance(head, Choice) else head
        if node.literal not in map(_text, atoms):
            self.out.append(f"{node.instance} does not give {node.literal}")
        wanted = {_text(each) for each in instance.body if isinstance(each, (Atom, Naf))}
        wanted = {each for each in wanted if "#" not in each}
        shown = {premise.literal for premise in node.premises}
        aggregates = any(isinstance(each, Aggregate) for each in instance.body)
        choice = isinstance(head, Choice)
        if not (wanted <= shown if aggregates or choice else wanted == shown):
            self.out.append(f"the premises of {node.instance} are {shown}")
        self.bodies[_body(instance.body)] = True

    def rule_at(self, place: Any) -> Any:
        return next(
            s
            for s in self.program.statements
            if (s.span.location.line, s.span.location.column) == (place.line, place.column)
        )

    def read(self, text: str) -> Any:
        """An instance as a rule; None where it has a number that cannot be written."""
        if re.search(r"(?<![\w)])-\d", text):
            return None
        shown = text.removesuffix(" :+").replace(" :+ ", " :- ")
        source = sparc.Source("i", f"predicates rules {shown}.\n")
        try:
            (statement,) = sparc.parse(source).statements
        except (sparc.SourceError, sparc.SourceErrors):
            # a+1, or a number compared with a name: an instance, and no text of a program
            assert re.search(r"\w\)?[-+*/]|[<>]", shown), shown
            return None
        return statement

    # ------------------------------------------------------------ out

    def absence(self, absent: Absence) -> None:
        """What is absent is; each rule listed fails where it is said to."""
        form = re.compile(_form(absent.literal))
        if any(map(form.fullmatch, self.true)):
            self.out.append(f"{absent.literal} is in the answer set")
        for failed in absent.rules:
            self.failure(absent, failed)

    def failure(self, absent: Absence, failed: FailedRule) -> None:
        if failed.note == "not in the range":
            return
        text = failed.instance if " :- " in failed.instance or " :+" in failed.instance else ""
        if failed.note in ("not chosen", "not needed"):
            instance = self.read(failed.instance)
            if instance is not None:
                self.bodies[_body(instance.body)] = True
            return
        ground = not re.search(r"\b[A-Z_]\w*", failed.failed)
        parsed = self.read(f":- {failed.failed}") if ground else None
        if parsed is not None and not failed.note:
            self.bodies[_body(parsed.body)] = False
        if failed.counted is not None and not failed.note:
            self.bodies |= dict.fromkeys(failed.counted.elements, True)
        if not text:
            return
        match failed.then:
            case Absence():
                self.absence(failed.then)
                if failed.then.literal != failed.failed:
                    self.out.append(f"{failed.failed} is followed to {failed.then.literal}")
            case Derivation():
                if failed.then.literal not in self.true:
                    self.out.append(f"{failed.then.literal} does not hold")

    # ------------------------------------------------------------ the solver's word

    def try_bodies(self) -> None:
        """Bodies hold, or do not, where the literals of the answer set are facts."""
        head = header(self.program)
        names = {}
        for body, holds in self.bodies.items():
            if body and self.legal(head, body):
                names[f"yes{len(names)}"] = (body, holds)
            elif body and holds and "#" not in body:  # in an aggregate it counts nothing
                self.out.append(f"{body} cannot be written")
        declared = "".join(f"{name}().\n" for name in names)
        rules = [f"{literal}." for literal in sorted(self.true)]
        rules += [f"{name} :- {body}." for name, (body, _) in names.items()]
        (answer,) = sparc.solve("\n".join([f"{head}{declared}rules", *rules, ""]))
        true = {str(each) for each in answer.literals}
        for name, (body, holds) in names.items():
            if (name in true) is not holds:
                self.out.append(f"{body} {'fails' if holds else 'holds'}")

    def legal(self, head: str, body: str) -> bool:
        """Whether a body can be written at all: a ground term outside its sort cannot."""
        try:
            sparc.check(sparc.parse(f"{head}rules\n:- {body}.\n"))
        except sparc.SourceErrors:
            return False
        return True


def header(program: Any) -> str:
    """Directives, sorts and predicates as text, and nothing behind them."""
    lines = [print_statement(each) for each in program.directives]
    lines += ["sorts", *map(print_statement, program.sorts)]
    lines += ["predicates", *map(print_statement, program.predicates)]
    return "\n".join(lines) + "\n"


def _nodes(roots: Iterable[Derivation]) -> Iterator[Derivation]:
    todo = list(roots)
    while todo:
        node = todo.pop()
        yield node
        todo.extend(node.premises)


def _text(item: Any) -> str:
    return print_statement(Rule((), (item,))).removesuffix(".").removeprefix(":- ")


def _form(literal: str) -> str:
    """A literal as a regular expression; a variable is any term, the same one everywhere."""
    seen: set[str] = set()
    out = ""
    for part in re.split(r"(?<!\w)([A-Z_]\w*)", literal.replace(" ", "")):
        if not re.fullmatch(r"[A-Z_]\w*", part):
            out += re.escape(part)
        elif part in seen:
            out += f"(?P={part})"
        else:
            seen.add(part)
            out += f"(?P<{part}>.+)"
    return out


def _body(items: Any) -> str:
    return print_statement(Rule((), items)).removesuffix(".").removeprefix(":- ").removeprefix(":-")


# -- matching ------------------------------------------------------------------------------


def _matches(rule: Any, ground: Any, values: dict[str, Any]) -> bool:
    """Whether ``ground`` is the rule with one value for each variable; sums are left to the solver."""
    if isinstance(rule, Variable):
        return rule.name == "_" or values.setdefault(rule.name, ground) == ground
    if isinstance(rule, Arithmetic):
        return isinstance(ground, (Arithmetic, Number))
    if isinstance(rule, tuple):
        return (
            isinstance(ground, tuple)
            and len(rule) == len(ground)
            and all(_matches(a, b, values) for a, b in zip(rule, ground, strict=True))
        )
    if isinstance(rule, Aggregate):
        return isinstance(ground, Aggregate)
    if hasattr(rule, "__dataclass_fields__") or hasattr(rule, "span"):
        if type(rule) is not type(ground):
            return False
        fields = [f for f in type(rule).__annotations__ if not f.endswith("span")]
        return all(_matches(getattr(rule, f), getattr(ground, f), values) for f in fields)
    return bool(rule == ground)
