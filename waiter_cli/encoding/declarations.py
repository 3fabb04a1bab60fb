"""Declarations in a domain's comments: `Domain` → `Declarations`. Entry points `declarations_of`, `words_for`.

A comment line that begins with ``%@`` says how an action looks, or what is known of the whole domain::

    %@ clean(agent,T): "wipe {T}" at T for 4 s as "wiping {T}"
    %@ monotone

The words are those of plans, the place is a table or node that the robot faces, the seconds are what it
takes in the simulated room, and the caption is what a film shows meanwhile.  All but the words may be
left out, and an action without a line has defaults.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from functools import cache, cached_property

from sparc.lazy_dataclass import dataclass, field
from sparc.source import Source
from waiter_cli.encoding.domains import Domain
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.state import State
from waiter_cli.model.wording import describe
from waiter_cli.spelling import did_you_mean

__all__ = [
    "SECONDS", "ActionLooks", "Declarations", "declarations_of", "declared_words", "place_of",
    "require_places", "words_for",
]  # fmt: skip

SECONDS = 2.0
"""What an action takes that says nothing of it."""
MOST_SECONDS = 3600.0
_FORM = 'write %@ clean(agent,T): "wipe {T}" at T for 4 s'
_ACTION = r"([a-z]\w*)\s*(?:\(([^()]*)\))?\s*:\s*"
_BRACKETS = r"\(((?:[^()]|\([^()]*\))*)\)"
_WORDS = r'"([^"]*)"'
_PLACE, _TIME, _CAPTION = r"\s+at\s+(\S+)", r"\s+for\s+(\S+)\s*s\b", r'\s+as\s+"([^"]*)"'


@dataclass(frozen=True)
class ActionLooks:
    """The looks of an action: its parameters, words, place (a parameter or a name), seconds, caption."""

    name: str
    parameters: tuple[str, ...]
    words: str
    place: str | None = None
    seconds: float = SECONDS
    caption: str | None = None
    where: Where = field(default=Where(""), compare=False)
    place_where: Where = field(default=Where(""), compare=False)

    def filled(self, text: str, arguments: tuple[str, ...]) -> str:
        """Returns a text with the arguments in place of the parameters in braces."""
        values = dict(zip(self.parameters, arguments))
        return re.sub(r"\{(\w+)\}", lambda found: values.get(found[1], found[0]), text)


@dataclass(frozen=True)
class Declarations:
    """The declarations of a domain: the looks of its actions by name and arity, and whether it is monotone."""

    deeds: tuple[ActionLooks, ...] = ()
    monotone: bool = False

    def deed(self, action: Action) -> ActionLooks | None:
        """Returns the looks of an action, None where nothing is declared."""
        key = (action.name, len(action.arguments))
        return next((d for d in self.deeds if (d.name, len(d.parameters)) == key), None)


def declarations_of(domain: Domain) -> Declarations:
    """Returns what a domain declares; raises `InputError` with every line that is no declaration."""
    return _read(domain.template)


@cache
def _read(template: Source) -> Declarations:
    reader = _Reader(template)
    for number, line in enumerate(template.text.split("\n"), template.first_line):
        if line.lstrip().startswith("%@"):
            reader.line(number, line)
    if reader.faults:
        raise InputError(sorted(reader.faults))
    return Declarations(tuple(reader.deeds), reader.monotone)


def _action_forms(text: str) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Returns the actions of a template, each name with the sorts of its arguments.

    They are the elements of the sort of ``occurs``, and of the sorts that it is made of.
    """
    bare = re.sub(r"%[^\n]*", "", text)
    bodies = dict(re.findall(r"#(\w+)\s*=(.*?)(?<!\.)\.(?!\.)", bare, re.DOTALL))
    occurs = re.search(r"(?<![\w#])occurs\s*\(\s*#(\w+)", bare)
    root = occurs[1] if occurs else "action"
    forms: dict[tuple[str, tuple[str, ...]], None] = {}
    waiting, seen = [root], {root}
    while waiting:
        body = bodies.get(waiting.pop(), "")
        for name, inner in re.findall(rf"([a-z]\w*)\s*{_BRACKETS}", body):
            sorts = tuple(part.partition("(")[0].strip() for part in inner.split(","))
            forms[name, sorts] = None
        flat = re.sub(_BRACKETS, " ", body)
        for names in re.findall(r"\{([^{}]*)\}", flat):
            forms.update({(name.strip(), ()): None for name in names.split(",")})
        new = [name for name in re.findall(r"#(\w+)", flat) if name not in seen]
        seen.update(new)
        waiting += new
    return tuple(forms)


class _Reader:
    def __init__(self, template: Source) -> None:
        self.template = template
        self.deeds: list[ActionLooks] = []
        self.monotone = False
        self.faults: list[Fault] = []

    @cached_property
    def forms(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The actions of the template; only a domain with declarations has them looked up."""
        return _action_forms(self.template.text)

    def fault(self, number: int, column: int, message: str, hint: str | None) -> None:
        line = self.template.text.split("\n")[number - self.template.first_line].rstrip()
        self.faults.append(Fault(Where(self.template.name, number, column), message, hint, line))

    def line(self, number: int, line: str) -> None:
        at = line.index("%@") + 2
        text = line[at:].strip()
        column = line.index(text, at) + 1 if text else at + 1
        if text == "monotone":
            self.monotone = True
            return
        if re.fullmatch(r"\w+", text):
            hint = did_you_mean(text, ("monotone",)) or _FORM
            self.fault(number, column, f"unknown declaration {text}", hint)
            return
        head = re.match(_ACTION, text)
        if head is None:
            self.fault(number, column, "this declares nothing", _FORM)
            return
        words = re.match(_WORDS, text[head.end() :])
        if words is None:
            place = column + head.end()
            self.fault(number, place, f"{head[1]} has no words", f"give them in quotes: {_FORM}")
            return
        self.deed(number, column, head, words, text[head.end() + words.end() :])

    def deed(
        self, number: int, column: int, head: re.Match[str], words: re.Match[str], rest: str
    ) -> None:
        """Reads an action's line behind its words."""
        name = head[1]
        parameters = tuple(p.strip() for p in head[2].split(",")) if head[2] else ()
        start = column + head.end() + words.end()
        found: dict[str, str] = {}
        columns: dict[str, int] = {}
        offset = 0
        for key, pattern in (("at", _PLACE), ("for", _TIME), ("as", _CAPTION)):
            part = re.match(pattern, rest[offset:])
            if part is not None:
                columns[key] = start + offset + part.start(1)
                found[key] = part[1]
                offset += part.end()
        before = len(self.faults)
        if left := rest[offset:].strip():
            hint = 'behind the words come at PLACE, for SECONDS s and as "CAPTION", in this order'
            self.fault(number, start + rest.index(left), f"{left} is not understood", hint)
        self.check_parameters(number, column, name, parameters, words[1], found)
        self.check_braces(number, column + head.end() + 1, words[1])
        self.check_braces(number, columns.get("as", column), found.get("as", ""))
        seconds = self.seconds(number, columns.get("for", column), found.get("for"))
        self.check_form(number, column, name, parameters)
        if any(d.name == name and len(d.parameters) == len(parameters) for d in self.deeds):
            self.fault(number, column, f"{name} is declared twice", "leave one of the two out")
        if len(self.faults) == before:
            place, caption = found.get("at"), found.get("as")
            where = Where(self.template.name, number, column)
            there = Where(self.template.name, number, columns.get("at", column))
            self.deeds.append(
                ActionLooks(name, parameters, words[1], place, seconds, caption, where, there)
            )

    def check_form(self, number: int, column: int, name: str, parameters: Collection[str]) -> None:
        forms = [form for form in self.forms if form[0] == name]
        if not forms:
            names = {known for known, _ in self.forms}
            hint = did_you_mean(name, sorted(names)) or "add it to the sort #action"
            self.fault(number, column, f"the domain has no action {name}", hint)
        elif all(len(sorts) != len(parameters) for _, sorts in forms):
            one = f"{name}({', '.join(forms[0][1])})" if forms[0][1] else name
            many = len(parameters)
            said = f"{name} is no action with {many} argument{'' if many == 1 else 's'}"
            self.fault(number, column, said, f"it is {one}: a parameter for each argument")

    def check_braces(self, number: int, column: int, text: str) -> None:
        """Checks that each brace of a text, which begins at ``column``, belongs to a parameter."""
        stray = re.search(r"[{}]", re.sub(r"\{\w*\}", lambda whole: " " * len(whole[0]), text))
        if stray is not None:
            hint = "write a parameter in braces, such as {T}"
            said = f"a brace {stray[0]} stands alone"
            self.fault(number, column + stray.start(), said, hint)

    def check_parameters(
        self,
        number: int,
        column: int,
        name: str,
        parameters: Collection[str],
        words: str,
        found: dict[str, str],
    ) -> None:
        twice = [one for k, one in enumerate(parameters) if one in list(parameters)[:k]]
        for each in dict.fromkeys(twice):
            said = f"{name} has two parameters {each}"
            self.fault(number, column, said, "give each argument a name of its own")
        texts = (words, found.get("as", ""))
        used = [each for text in texts for each in re.findall(r"\{(\w*)\}", text)]
        place = found.get("at", "")
        used += [place] if place[:1].isupper() else []
        for each in used:
            if each not in parameters:
                hint = did_you_mean(each, sorted(parameters)) or f"its parameters go into {name}(…)"
                self.fault(number, column, f"{name} has no parameter {each or '{}'}", hint)

    def seconds(self, number: int, column: int, text: str | None) -> float:
        if text is None:
            return SECONDS
        try:
            value = float(text)
        except ValueError:
            value = -1.0
        if not 0 < value <= MOST_SECONDS:
            hint = f"give a number of seconds above 0, up to {MOST_SECONDS:.0f}"
            self.fault(number, column, f"it cannot take {text} s", hint)
        return value


def declared_words(domain: Domain | None, action: Action, *, caption: bool = False) -> str | None:
    """Returns the words that a domain declares of an action, None where it declares none.

    With ``caption``, what a film shows meanwhile.
    """
    deed = None if domain is None else declarations_of(domain).deed(action)
    if deed is None:
        return None
    text = deed.caption if caption and deed.caption is not None else deed.words
    return deed.filled(text, action.arguments)


def words_for(domain: Domain | None, action: Action, state: State, *, caption: bool = False) -> str:
    """Returns what an action means, in words: as declared, as the house says it, or its own name.

    With ``caption``, what a film shows meanwhile; without a domain, as the house says it.
    """
    declared = declared_words(domain, action, caption=caption)
    if declared is not None:
        return declared
    told = describe(action, state)
    if told != action.text:
        return told
    rest = [name for name in action.arguments if name != "agent"]
    return " ".join([action.name.replace("_", " "), *rest])


def require_places(template: Source, layout: Layout) -> None:
    """Raises `InputError` with every fixed place of a template that a layout does not have."""
    known = [table.name for table in layout.tables] + [node.name for node in layout.nodes]
    faults = []
    for deed in _read(template).deeds:
        if deed.place is None or deed.place in (*deed.parameters, *known):
            continue
        said = f"{deed.name} is done at {deed.place}, which is no table or node of {layout.name}"
        mend = "give one of its parameters, a table or a node"
        hint = did_you_mean(deed.place, [*deed.parameters, *known]) or mend
        faults.append(Fault(deed.place_where, said, hint))
    if faults:
        raise InputError(sorted(faults))


def place_of(domain: Domain, action: Action, layout: Layout) -> str | None:
    """Returns the table or node at which an action is done, None where none is known.

    Undeclared, it is the first of the arguments that is one.
    """
    known = {table.name for table in layout.tables} | {node.name for node in layout.nodes}
    deed = declarations_of(domain).deed(action)
    if deed is not None and deed.place is not None:
        value = dict(zip(deed.parameters, action.arguments)).get(deed.place, deed.place)
        return value if value in known else None
    return next((name for name in action.arguments if name in known), None)
