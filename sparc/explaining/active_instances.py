"""The ground instances of the statements of a cause that take part in it. Entry point `active_instances`.

Each instance gets a switch of its own, beside those of the statements outside the cause: an atom
that takes it away.

    p(X) :- q(X).            {___off(3,X)}:-q(X).        p(X):-q(X),not ___off(3,X).
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.checking.typed_program import TypedProgram
from sparc.explaining.instances import Binding, instance_text
from sparc.explaining.subsets import SubsetOracle, SwitchKey
from sparc.explaining.switches import ON, SwitchedProgram, conditional, parted
from sparc.syntax.tree import CrRule, RangeFact, Rule
from sparc.translation.literals import global_names

__all__ = ["SHOWN_INSTANCES", "active_instances", "global_variables", "shown_instances"]

SHOWN_INSTANCES = 3
"""How many instances of a statement are shown."""

_OFF = "___off"
_MOST_CHECKED = 60  # instances of a conflict of more are shown as the solver found it


def global_variables(typed: TypedProgram, index: int) -> list[str]:
    """Returns the variables of a statement that tell its instances apart, in order."""
    statement = typed.program.statements[index]
    if isinstance(statement, Rule | CrRule):
        return global_names(statement.head, statement.body)
    return []


def active_instances(
    typed: TypedProgram, program: SwitchedProgram, cause: Iterable[int], deadline: float | None
) -> dict[int, list[Binding]]:
    """By statement of ``cause``, values of the variables of its instances that take part.

    Without some of these instances there would be an answer set, unless they were too many to be
    looked at one by one.  Raises `Undecided` at the deadline.
    """
    members = frozenset(cause)
    names = {index: global_variables(typed, index) for index in members}
    lines: list[str] = []
    for index, line in program.lines:
        if index is None or index not in program.switches:
            lines.append(line)
        elif index not in members:
            lines.append(conditional(line, f"{ON}({index})"))
        else:
            off = f"{_OFF}({','.join([str(index), *names[index]])})"
            body = parted(line)[1]
            if isinstance(typed.program.statements[index], RangeFact):
                lines += [f"{{{_OFF}({index})}}.", conditional(line, f"not {off}")]
                continue
            lines.append(f"{{{off}}}:-{body}." if body else f"{{{off}}}.")
            lines.append(conditional(line, f"not {off}"))
    free = [f"{{{ON}({index})}}." for index in program.switches if index not in members]
    oracle = SubsetOracle(program.asp(lines, free), _OFF, when_on=False, deadline=deadline)
    conflict = oracle.conflict(oracle.switches)
    if conflict is None:
        return {}
    for key in sorted(conflict, key=str) if len(conflict) <= _MOST_CHECKED else ():
        if key in conflict:
            conflict = oracle.conflict(conflict - {key}) or conflict
    return _by_statement(conflict, names)


def _by_statement(
    found: Iterable[SwitchKey], names: dict[int, list[str]]
) -> dict[int, list[Binding]]:
    out: dict[int, list[Binding]] = {index: [] for index in names}
    for key in sorted(found, key=_order):
        index, *values = key
        assert isinstance(index, int)
        out[index].append(dict(zip(names[index], values, strict=True)))
    return out


def _order(key: SwitchKey) -> list[tuple[int, int, str]]:
    return [(0, part, "") if isinstance(part, int) else (1, 0, str(part)) for part in key]


def shown_instances(typed: TypedProgram, index: int, bindings: Iterable[Binding]) -> list[str]:
    """At most `SHOWN_INSTANCES` of the instances as text, each once."""
    statement = typed.program.statements[index]
    texts = dict.fromkeys(instance_text(statement, binding) for binding in bindings)
    return list(texts)[:SHOWN_INSTANCES]
