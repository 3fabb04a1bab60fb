"""Reads a foil, an action as a person writes it → `Action`. Entry point `read_foil`."""

from __future__ import annotations

import re

from sparc.numerals import whole
from sparc.spelling import nearest
from waiter_cli.encoding.domains import Domain
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem

__all__ = ["read_foil"]

LOOKED_AT = 5000  # actions of a domain among which the nearest is looked for
PLACE = Where("--why-not")
FORM = re.compile(r"\s*([a-z]\w*)\s*\(\s*([^()]*?)\s*\)\s*\.?\s*")


def read_foil(text: str, problem: Problem, domain: Domain) -> Action:
    """Returns the action that a person wrote, such as ``seat(agent,c2,table1)``.

    A built-in domain knows parties by any member, and ``agent`` may be left out where there is one robot.  A domain of the
    user's own says itself what an action is: an element of the sort of the first argument of ``occurs``.
    Raises `InputError` where it is no action, or names what is not there.
    """
    return _known(text, problem) if domain.built_in else _own(text, problem, domain)


def _own(text: str, problem: Problem, domain: Domain) -> Action:
    from itertools import islice

    import sparc
    from sparc.checking.typed_program import Undefined, evaluate
    from sparc.solving.query import parse_query
    from sparc.sorts.values import text as written
    from waiter_cli.encoding.template import fill_template

    program = sparc.check(sparc.parse(fill_template(domain.template, problem, 1)))
    occurs = program.predicates.get("occurs")
    if occurs is None or len(occurs.sorts) != 2:
        raise InputError([Fault(PLACE, f"{domain.name} has no actions: it declares no occurs/2")])
    actions = occurs.sorts[0].extent
    try:
        (term, _) = parse_query(f"occurs({text.strip().removesuffix('.')},0)").arguments
        value = evaluate(term, program.constants)
    except (sparc.SourceError, sparc.SourceErrors, Undefined, ValueError):
        value = None
    if "%" not in text and isinstance(value, (str, tuple)) and value in actions:
        name, *arguments = (value,) if isinstance(value, str) else value
        return Action(0, str(name), tuple(map(written, arguments)))
    some = [written(action) for action in islice(actions, LOOKED_AT)]
    close = nearest("".join(text.split()), some)
    names = dict.fromkeys(action.partition("(")[0] for action in some)
    hint = f"did you mean {close}?" if close else f"its actions are {', '.join(names)}"
    raise InputError([Fault(PLACE, f"{text} is no action of {domain.name}", hint)])


def _known(text: str, problem: Problem) -> Action:
    match = FORM.fullmatch(text)
    forms = {
        "go_to": ("node",), "pick": ("customer",), "seat": ("customer", "table"),
        "give_bill": ("table",), "take_order": ("table",), "send_order": ("table",),
        "take_up": ("object", "table"), "bring": ("object", "table"),
        "refill": ("object", "table"), "bring_chairs": ("table", "number"),
    }  # fmt: skip
    if match is None:
        robot = problem.state.crew()[0].name
        hint = f"write it as seat({robot},c2,table1)"
        raise InputError([Fault(PLACE, f"{text!r} is no action", hint)])
    name, arguments = match[1], [word.strip() for word in match[2].split(",")]
    if name not in forms:
        close = nearest(name, forms)
        hint = f"did you mean {close}?" if close else f"known are {', '.join(forms)}"
        raise InputError([Fault(PLACE, f"unknown action {name}", hint)])
    arguments = [*_robot(arguments, 1 + len(forms[name]), problem), *arguments]
    if len(arguments) != 1 + len(forms[name]):
        first = "ROBOT" if problem.state.robots else "agent"
        wanted = ",".join((first, *(form.upper() for form in forms[name])))
        raise InputError([Fault(PLACE, f"{name} has other arguments", f"write {name}({wanted})")])
    known = {
        "robot": [robot.name for robot in problem.state.crew()],
        "node": [node.name for node in problem.layout.nodes],
        "table": [table.name for table in problem.layout.tables],
        "customer": [name for party in problem.state.parties() for name in party],
        "object": list(problem.layout.objects),
    }
    for kind, word in zip(("robot", *forms[name]), arguments, strict=True):
        if kind == "number":
            if whole(word) is None or not word.isdigit():
                raise InputError(
                    [Fault(PLACE, f"{word} is no number of chairs", "write a whole number")]
                )
        elif word not in known[kind]:
            close = nearest(word, known[kind])
            others = f"known are {', '.join(known[kind])}" if known[kind] else f"there is no {kind}"
            hint = f"did you mean {close}?" if close else others
            raise InputError([Fault(PLACE, f"unknown {kind} {word}", hint)])
    leaders = {c: party[0] for party in problem.state.parties() for c in party}
    return Action(0, name, tuple(leaders.get(word, word) for word in arguments))


def _robot(arguments: list[str], wanted: int, problem: Problem) -> list[str]:
    """Returns the name of the robot that was left out, which only a single one can be."""
    if problem.state.robots or arguments[:1] == ["agent"] or len(arguments) == wanted:
        return []
    return ["agent"]
