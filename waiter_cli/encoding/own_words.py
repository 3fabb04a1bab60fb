"""Words of a domain's own: what is observed under its names, and whether it has what a problem says.

Entry points `observed_lines`, `require_own_words`.  A template that declares an observable of one of
the names of `OBSERVABLES` is told of it as ``obs(has_left(table1), true, 0).``; one that does not, is not.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from typing import TYPE_CHECKING

from sparc.source import Source
from waiter_cli.encoding.facts import ProgramLine
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation
from waiter_cli.spelling import did_you_mean

if TYPE_CHECKING:
    from sparc.checking.typed_program import TypedProgram
    from sparc.sorts.extents import Extent
    from sparc.sorts.values import Value

__all__ = [
    "KEY_OF_FLUENT", "OBSERVABLES", "observed_lines", "require_own_words", "unknown_term"
]  # fmt: skip

OBSERVABLES = {
    "leave": "has_left",
    "order": "ready_to_order",
    "ready": "stands_ready",
    "empty": "seen_empty",
    "free": "seen_free",
    "at": "seen_at",
}
"""The name of a kind of observation in a program, beside has_entered, group and bill_wave."""

KEY_OF_FLUENT = {
    "currentlocation": "agent",
    "iswaiting": "waiting",
    "iswith": "with_agent",
    "isattable": "seated",
    "aretogether": "seated",
    "haspaid": "paid",
    "wantsbill": "wants_bill",
    "readytoorder": "ready_to_order",
    "hasorder": "ordered",
    "issent": "sent",
    "isserved": "served",
    "isready": "ready",
    "iscarrying": "carrying",
    "isempty": "empty",
    "has_chairs": "chairs",
}
"""The key of a state that says what a fluent says."""
_COMMENT = r"%[^\n]*"


# ---------------------------------------------------------------- what is observed


@lru_cache(maxsize=16)
def _declared(template: Source) -> dict[str, str]:
    """Returns the observables of ours that a template declares, each with the sort of its first argument."""
    bare = re.sub(_COMMENT, "", template.text)
    declared = {}
    for name in OBSERVABLES.values():
        if form := re.search(rf"(?<![\w#]){name}\s*\(\s*#(\w+)", bare):
            declared[name] = form[1]
    return declared


def observed_lines(template: Source, problem: Problem) -> list[ProgramLine]:
    """Returns what was observed as facts of a program, as far as its template has names for it."""
    declared = _declared(template)
    lines = []
    for observation in problem.observations:
        if observation.kind == "obs":
            lines.append(
                ProgramLine(f"obs({observation.arguments[0]}, true, 0).", observation.where)
            )
            continue
        name = OBSERVABLES.get(observation.kind, "")
        if name not in declared:
            continue
        term = _term(name, declared[name], observation, problem)
        if term is not None:
            lines.append(ProgramLine(f"obs({term}, true, 0).", observation.where))
    return lines


def _term(name: str, sort: str, seen: Observation, problem: Problem) -> str | None:
    first = seen.arguments[0]
    match seen.kind:
        case "leave" if sort == "table":
            table = problem.before_observations.table_of(first)
            return None if table is None else f"{name}({table})"
        case "leave":
            party = problem.before_observations.party_of(first)
            return f"{name}({party[0] if party else first})"
        case "ready" | "empty":
            return f"{name}({seen.arguments[1]}, {first})"
    return f"{name}({', '.join(seen.arguments)})"


# ---------------------------------------------------------------- what a domain has


def require_own_words(problem: Problem, filled: Source) -> None:
    """Raises `InputError` with every term of the problem that a domain has no words for.

    ``filled`` is its program without what the problem says of the situation.
    """
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse

    words = _Words(check(parse(filled)), filled.name)
    for fluent in problem.state.fluents:
        words.state(fluent, _place(problem, fluent))
    for goal in problem.all_goals():
        if goal.fluent is not None:
            words.term("holds", goal.fluent, goal.where)
    for observation in problem.observations:
        if observation.kind == "obs":
            words.term("obs", observation.arguments[0], observation.where)
    for fact in problem.facts:
        words.fact(fact.text, fact.where)
    if words.faults:
        raise InputError(sorted(dict.fromkeys(words.faults)))


def _place(problem: Problem, fluent: str) -> Where | None:
    places = dict(problem.state_where)
    return places.get(f"fluents.{fluent}", places.get("fluents"))


def unknown_term(typed: TypedProgram, predicate: str, term: str) -> tuple[str, str | None] | None:
    """Returns why a term is none of the first sort of a predicate, and the mend; None where it is one."""
    words = _Words(typed, "")
    if words.term(predicate, term, None):
        return None
    (fault,) = words.faults
    return fault.message, fault.hint


class _Words:
    """Looks up terms among the declarations of a program; faults are kept."""

    def __init__(self, typed: TypedProgram, domain: str) -> None:
        self.typed = typed
        self.domain = domain
        self.faults: list[Fault] = []

    def state(self, fluent: str, where: Where | None) -> None:
        """Looks up a fluent of a state's: it has to be inertial, and no other key may say it."""
        name = fluent.partition("(")[0]
        if name in KEY_OF_FLUENT:
            hint = f"say it under {KEY_OF_FLUENT[name]}: in the state"
            self.faults.append(Fault(where, f"{name} is no fluent of the domain's own", hint))
            return
        sort = self.typed.sorts.get("inertial_fluent")
        if self.term("holds", fluent, where) and sort is not None:
            if _value(fluent) not in sort.extent:
                hint = "what is defined by other fluents follows from them; leave it out"
                self.faults.append(Fault(where, f"{fluent} is no inertial fluent", hint))

    def term(self, predicate: str, term: str, where: Where | None) -> bool:
        """Returns whether a term is of the first sort of ``predicate``; a fault is noted."""
        found = self.typed.predicates.get(predicate)
        if found is None or not found.sorts:
            said = f"the domain {self.domain} has no predicate {predicate}(…), and so no {term}"
            self.faults.append(Fault(where, said, f"declare it under predicates: {predicate}"))
            return False
        extent = found.sorts[0].extent
        value = _value(term)
        if value in extent:
            return True
        kind = {"holds": "fluent", "obs": "observable"}.get(predicate, "action")
        self.faults.append(Fault(where, *self._unknown(value, extent, kind)))
        return False

    def fact(self, text: str, where: Where | None) -> None:
        """Looks up a literal; its terms first, since more can be said of them."""
        from sparc.checking.checker import check_literal
        from sparc.errors import SourceError, SourceErrors
        from sparc.solving.query import parse_query

        inner = re.match(r"-?(holds|obs)\((.*),[^,]*\)$", text)
        if inner and inner[1] == "holds" and not self.term("holds", inner[2], where):
            return
        try:
            check_literal(self.typed, parse_query(text))
        except SourceErrors as wrong:
            self.faults += [Fault(where, one.message, one.hint) for one in wrong.errors]
        except SourceError as one:
            self.faults.append(Fault(where, one.message, one.hint))

    def _unknown(self, value: Value, extent: Extent, kind: str) -> tuple[str, str | None]:
        """Returns what is wrong with a term that is in no sort, and the mend."""
        from sparc.sorts.values import text

        name, given = (str(value[0]), value[1:]) if isinstance(value, tuple) else (str(value), ())
        forms = {arity for called, arity in extent.signatures() if called == name}
        names = {called for called, _ in extent.signatures()} | _plain_names(extent)
        if not forms and name not in names:
            return f"the domain has no {kind} {name}", did_you_mean(name, names, kind)
        if len(given) not in forms:
            hint = f"write {self._form(name, max(forms), extent)}" if forms else f"write {name}"
            return f"{text(value)} has another form", hint
        for box in extent.boxes(name, len(given)) or ():
            for sort, part in zip(box.arguments, given, strict=True):
                if part not in sort.extent:
                    said = f"{text(part)} is no {sort.name.lstrip('#')}, in {text(value)}"
                    return said, did_you_mean(text(part), _listed(sort.extent))
        return f"{text(value)} is no {kind} of the domain", None

    def _form(self, name: str, arity: int, extent: Extent) -> str:
        boxes = extent.boxes(name, arity) or ()
        sorts = [sort.name.lstrip("#") for sort in boxes[0].arguments] if boxes else ["…"] * arity
        return f"{name}({', '.join(map(str.upper, sorts))})"


def _plain_names(extent: Extent) -> set[str]:
    return {value for value in _values(extent) if isinstance(value, str)}


def _listed(extent: Extent) -> list[str]:
    from sparc.sorts.values import text

    return [text(value) for value in _values(extent)]


def _values(extent: Extent) -> Iterable[Value]:
    from itertools import islice

    return islice(extent, 2000) if extent.bound() < 100_000 else ()


def _value(term: str) -> Value:
    """Returns the value that a ground term spells."""
    tokens = re.findall(r"\w+|[(),]", term)

    def read() -> Value:
        word = tokens.pop(0)
        name: Value = int(word) if word.isdigit() else word
        if not tokens or tokens[0] != "(":
            return name
        parts: list[Value] = [name]
        while tokens.pop(0) != ")":
            parts.append(read())
        return tuple(parts)

    return read()
