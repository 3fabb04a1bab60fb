"""``waiter list``: the layouts, scenarios and domains that come with it, a line each."""

from __future__ import annotations

from itertools import takewhile
from typing import TYPE_CHECKING, Any

from waiter_cli.commands.options import JsonOption

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["list"]


def list(as_json: JsonOption = False) -> int:
    """List the layouts, scenarios and domains that come with it, a line each.

    Their names stand wherever a file of yours may stand: --layout bistro,
    --scenario lunch, --domain report.

    \b
    Examples:
      waiter list
      waiter list --json
    """
    from waiter_cli.console.output import print_json, print_table, say
    from waiter_cli.console.styling import styled
    from waiter_cli.file_access.locate import built_in

    document = {
        "layouts": [_layout(name) for name in built_in("layout")],
        "scenarios": [_scenario(name) for name in built_in("scenario")],
        "domains": [_domain(name) for name in built_in("domain")],
    }
    if as_json:
        print_json(document)
        return 0
    for number, (kind, each) in enumerate(document.items()):
        if number:
            say("")
        rows = [(one["name"], one["about"], _figures(kind, one)) for one in each]
        print_table((kind, "", ""), rows, right=(), prose=1)
    say(f"\n{styled('waiter layout draw NAME', 'bold')} draws a layout.")
    return 0


def _layout(name: str) -> dict[str, Any]:
    """Returns a layout in figures."""
    from waiter_cli.files.layout_reader import read_layout_file

    layout = read_layout_file(name)
    assert layout.origin is not None
    return {
        "name": name,
        "about": _first_sentence(layout.origin.text, "#"),
        "file": layout.file,
        "nodes": len(layout.nodes),
        "edges": len(layout.edges),
        "tables": len(layout.tables),
        "seats": sum(table.capacity for table in layout.tables),
        "waiters": len(layout.waiters),
        "bar": layout.bar is not None,
    }


def _scenario(name: str) -> dict[str, Any]:
    """Returns a scenario in figures: guests that are there or come in, and wishes at the start."""
    from waiter_cli.file_access.locate import read_text
    from waiter_cli.files.scenario_reader import read_scenario_file
    from waiter_cli.problems.pose import pose_problem

    layout, scenario = read_scenario_file(name)
    problem = pose_problem(layout, scenario)
    parties = [*problem.state.parties()]
    parties += [observation.arguments for event in scenario.events for observation in event.observations
                if observation.kind == "enter"]  # fmt: skip
    return {
        "name": name,
        "about": _first_sentence(read_text(name, "scenario").text, "#"),
        "file": scenario.file,
        "layout": layout.name,
        "guests": sum(map(len, parties)),
        "goals": len(problem.goals),
        "events": len(scenario.events),
    }


def _domain(name: str) -> dict[str, Any]:
    """Returns a domain in figures; its template is a program as it stands."""
    from sparc.syntax.parser import parse
    from waiter_cli.encoding.domains import find_domain

    template = find_domain(name).template
    program = parse(template)
    return {
        "name": name,
        "about": _first_sentence(template.text, "%"),
        "file": template.name,
        "sorts": len(program.sorts),
        "predicates": len(program.predicates),
        "rules": len(program.statements),
    }


def _first_sentence(text: str, mark: str) -> str:
    """Returns the first sentence of the comment that a file begins with."""
    comment = takewhile(lambda line: line.startswith(mark), text.splitlines())
    said = " ".join(line.lstrip(mark).strip() for line in comment)
    sentence, stop, _ = said.partition(". ")
    return sentence.strip() + stop.strip()


def _figures(kind: str, one: dict[str, Any]) -> str:
    """Returns the figures that a line has room for."""
    match kind:
        case "layouts":
            return _counts(one, ("node", "table", "seat"))
        case "scenarios":
            return f"{one['layout']}, {_counts(one, ('guest', 'goal'))}"
    return _counts(one, ("sort", "rule"))


def _counts(one: dict[str, Any], nouns: Sequence[str]) -> str:
    from waiter_cli.model.wording import counted

    numbers = [(one[f"{noun}s"], noun) for noun in nouns]
    return ", ".join(counted(number, noun) for number, noun in numbers)
