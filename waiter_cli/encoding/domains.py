"""Finds domains: a built-in name, a template file, or a folder that holds ``domain.sparc``.

Entry points `find_domain`, `require_program` and `require_plans`.
"""

from __future__ import annotations

import os
import re
from dataclasses import replace

from sparc.lazy_dataclass import dataclass
from sparc.source import Source
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.file_access.locate import BuiltIn, data_folder, read_text
from waiter_cli.file_access.sparc_file import require_no_other_kind
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.source_file import File

__all__ = [
    "BUILT_IN",
    "KNOWN_IN_PYTHON",
    "Domain",
    "domain_for",
    "domain_for_layout",
    "domain_in",
    "domain_of_words",
    "find_domain",
    "require_plans",
    "require_program",
]

BUILT_IN = ("housekeeping", "report", "restaurant")
KNOWN_IN_PYTHON = ("report", "restaurant")
"""Those whose rules are in Python, too; any other says by itself what comes of an action."""
_FILE, _FLEET = "domain.sparc", "fleet.sparc"
# Patterns as text: they are for domains that are not built in, and take a while to compile.
_COMMENT = r"%[^\n]*"
_MEANT = {"goal": "when all goals hold", "occurs": "what the robot may do"}
_RULE = {
    "goal": "goal(I) :- not missing(I).",
    "occurs": "{ occurs(A, I) : possible(A, I) } 1 :- #step(I), not over(I).",
}
_SECTION = r"(?:^|[\s.])(?:sorts|predicates|rules)(?=\s)"
_START = "`waiter domain show --source` prints the restaurant's, to start from"


def find_domain(name: str) -> Domain:
    """Returns the domain of that name or at that path; a file of that name wins, a folder does not.

    For a `BuiltIn` name, which nobody typed, no file is looked for.

    ``-`` is standard input.  Raises `InputError` where there is none, where it cannot be read, or
    where it holds no program.
    """
    if name in BUILT_IN and (isinstance(name, BuiltIn) or not os.path.isfile(name)):
        path = os.path.join(data_folder("domains"), name, _FILE)
        with open(path, encoding="utf-8") as built_in:
            template = Source(f"domains/{name}/{_FILE}", built_in.read())
        return Domain(str(name), template, built_in=name in KNOWN_IN_PYTHON)
    inner = os.path.join(name, _FILE)
    file = read_text(inner if os.path.isfile(inner) else name, "domain")
    return domain_in(file, name)


def domain_for(problem: Problem, domain: Domain) -> Domain:
    """Returns the domain with the rules for as many robots as the problem has.

    The built-in one called restaurant has rules of their own for several; any other has to have a
    slot ``agents``.
    """
    return domain_for_layout(problem.layout, domain)


def domain_for_layout(layout: Layout, domain: Domain) -> Domain:
    """Returns the domain, like `domain_for`, for any problem in a restaurant."""
    if not layout.agents or not domain.built_in or domain.name != "restaurant":
        return domain
    path = os.path.join(data_folder("domains"), domain.name, _FLEET)
    with open(path, encoding="utf-8") as several:
        return replace(domain, template=Source(f"domains/{domain.name}/{_FLEET}", several.read()))


def domain_of_words(problem: Problem, domain: Domain) -> Domain:
    """Returns the domain; where the problem speaks of fluents and facts, as one of the user's own.

    What we know of our domains beyond their rules is not true of such a problem.
    """
    if not problem.has_own_words:
        return domain
    return replace(domain_for(problem, domain), built_in=False)


def domain_in(file: File, name: str) -> Domain:
    """Returns the user's domain in a file that was read; raises `InputError` where it holds no program."""
    source = Source(file.shown, file.text)
    require_no_other_kind(source)
    template = require_program(source)
    return Domain(name, template, built_in=False, path=file.path)


def require_plans(domain: Domain) -> Domain:
    """Returns the domain again; raises `InputError` where its program cannot say what a plan is.

    A search reads the plan off ``occurs(ACTION, STEP)`` and asks when ``goal(STEP)`` holds.
    """
    if domain.built_in:
        return domain
    bare = re.sub(_COMMENT, "", domain.template.text)
    for name, form in (("occurs", "occurs(#action, #step)"), ("goal", "goal(#step)")):
        if not re.search(rf"(?<![\w#]){name}\s*\(", bare):
            said = f"no plans in this program: it has no predicate {form}"
            hint = f"{_START}; `waiter answersets FILE` shows what a program says by itself"
            raise InputError([Fault(Where(domain.template.name, 1, 1), said, hint)])
        _require_rule(name, domain.template, bare)
    return domain


def _require_rule(name: str, template: Source, bare: str) -> None:
    """Raises `InputError` where no statement has a predicate in its head: then nothing is a plan."""
    use = rf"(?<![\w#]){name}\s*\("
    heads = [
        re.split(r":-|:~", text)[0] for text in re.split(r"(?<!\.)\.(?!\.)", bare) if name in text
    ]
    if any(re.search(rf"{use}\s*[^#\s]", head) for head in heads):
        return
    lines = template.text.split("\n")
    index, line = next(
        (k, line) for k, line in enumerate(lines) if re.search(use, line.partition("%")[0])
    )
    column = line.index(name) + 1
    said = f"no plans in this program: no rule says {_MEANT[name]}"
    where = Where(template.name, template.first_line + index, column)
    raise InputError([Fault(where, said, f"write one: {_RULE[name]}", line.rstrip())])


def require_program(template: Source) -> Source:
    """Returns the template again; raises `InputError` where it is empty or a piece of a program."""
    bare = re.sub(_COMMENT, lambda comment: " " * len(comment[0]), template.text)
    if re.search(_SECTION, bare):
        return template
    before = bare[: len(bare) - len(bare.lstrip())]
    if before == bare:
        said = "the file has comments only" if template.text.strip() else "the file is empty"
        raise InputError([Fault(Where(template.name, 1, 1), said, f"write a domain; {_START}")])
    line = before.count("\n")
    column = len(before) - before.rfind("\n")
    message = 'expected the section word "sorts" or "predicates", and no section is in this file'
    hint = f"rules of your own go to the end of a whole domain; {_START}"
    excerpt = template.text.split("\n")[line].rstrip()
    raise InputError([Fault(Where(template.name, line + 1, column), message, hint, excerpt)])


@dataclass(frozen=True)
class Domain:
    """A template and what is known of it: ``built_in`` ones are monotone and have caps, and their
    rules are in Python, too.

    ``path`` is the template's, None for a built-in one and for standard input.
    """

    name: str
    template: Source
    built_in: bool = True
    path: str | None = None
